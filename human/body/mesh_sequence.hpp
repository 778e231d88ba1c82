#pragma once
/// A body as snapshots of its surface (Zheng 2013, 6.1: a mesh for each frame), continuous in velocity between them.

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/contact/obstacle.hpp"

namespace gambeson {

struct SequenceOptions {
  std::filesystem::path folder;  ///< of one mesh file for each frame, in the order of the numbers in their names
  double rate_Hz = 30;
  double scale = 1;
  double begin_s = 0;       ///< when the first frame is there
  std::string forward, up;  ///< axes of the files ("x", "-y", ...) that point along our x and z; empty: x and z
};

/// One mesh at even times: where its vertices are in each frame.
struct Snapshots {
  double rate_Hz = 30, begin_s = 0;
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::vector<Vec3>> frames;
};

/// Between two frames each vertex goes along the cubic with the frames' central differences as velocities (Catmull and
/// Rom 1974); it starts at rest in the first and ends at rest in the last frame, where it stays before and after: C¹ at
/// all times.
class MeshSequence {
 public:
  /// Throws InputError with file and key: fewer than two frames, frames of other vertices or triangles.
  explicit MeshSequence(const SequenceOptions& options);
  /// Of what another one has read.
  explicit MeshSequence(Snapshots snapshots) : snapshots_(std::move(snapshots)) {}
  const Snapshots& snapshots() const { return snapshots_; }
  const std::vector<std::array<int, 3>>& triangles() const { return snapshots_.triangles; }
  int frames() const { return static_cast<int>(snapshots_.frames.size()); }
  double end_s() const { return snapshots_.begin_s + (frames() - 1) / snapshots_.rate_Hz; }
  /// Outward in the first frame where it is closed.
  TriangleMesh first() const { return {snapshots_.frames.front(), snapshots_.triangles}; }
  void at(double time_s, std::span<Vec3> x) const;

 private:
  Snapshots snapshots_;
};

/// The files of a folder that are meshes, "walk_9.obj" before "walk_10.obj". Throws InputError.
std::vector<std::filesystem::path> framesIn(const std::filesystem::path& folder);

}  // namespace gambeson
