#pragma once
/// Public data about collisions, as the Continuous-Collision-Detection collections keep it: query files, frames, truth.

#include <array>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/math/vec.hpp"

namespace gambeson::collision {

enum class PairKind { kPointTriangle, kEdgeEdge };

struct Query {
  std::array<Vec3, 4> x0, x1;  ///< (p, a, b, c) or (a, b, c, d)
  std::optional<bool> truth;
  /// How far a coordinate of the file is from its double, at most. 0: all are doubles. Otherwise each point is within
  /// sqrt(3) of it, and a test with 2 sqrt(3) more separation misses nothing that the file means.
  double rounding = 0;
};

/// The kind that a file's path names: edge-edge or ee, vertex-face or vf. Throws InputError where it names none.
PairKind kindOfPath(const std::filesystem::path& file);

/// Query files: 8 rows a query (the four points at the start, then at the end), each three rational coordinates as
/// numerator,denominator and perhaps a seventh column with the truth, the same in all 8 rows.
std::vector<Query> readQueries(const std::filesystem::path& csv);

/// Frames: PLY, text or binary of either byte order, any scalar types; other elements and properties are skipped.
struct Frame {
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 3>> faces;
};
Frame readPly(const std::filesystem::path& ply);

/// Unique edges (smaller, larger vertex), in order of the larger vertex, then the smaller: the order of their ids.
std::vector<std::array<int, 2>> edgesOf(const Frame& frame);

/// Pairs of ids into [vertices | edges | faces]; truth: one value for each pair (or query).
std::vector<std::array<int, 2>> readPairs(const std::filesystem::path& json);
std::vector<bool> readTruth(const std::filesystem::path& json);

/// The listed pairs between two frames of one mesh.
std::vector<Query> queriesOf(const Frame& start, const Frame& end, const std::vector<std::array<int, 2>>& pairs,
                             PairKind kind);

}  // namespace gambeson::collision
