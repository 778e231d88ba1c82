#pragma once
/// The exact checker applied to a model: samples of the cloth as a step leaves them, obstacles where the stage has
/// them. Triangles on both sides of a sewn seam (sewnTwins) touch there, and by what the chords of both borders differ
/// pass through each other: they are told apart.

#include <string>

#include "core/motion/model.hpp"
#include "exact/intersections.hpp"

namespace gambeson::exact {

/// Cloth with itself and with every obstacle. An ellipsoid is the mesh inscribed in it (`levels` of ellipsoidMesh):
/// what meets the mesh meets the ellipsoid.
class SceneIntersections {
 public:
  SceneIntersections(const Model& model, const Stage& stage, int levels = 4);

  /// Samples W T p of the free points p in double precision.
  Intersections at(std::span<const Vec3> p, double time_s) const;
  Intersections at(const State& state) const { return at(state.p, state.time_s); }
  /// The same for positions of the samples, from wherever.
  Intersections ofSamples(std::span<const Vec3> x, double time_s) const;

  /// "cloth 17 (samples 1 2 3) with sphere 5, sharing 0 vertices".
  std::string name(const IntersectingPair& pair) const;
  std::string name(int triangle) const;

 private:
  const Model& model_;
  const Stage& stage_;
  std::vector<std::array<int, 3>> triangles_;
  std::vector<char> obstacle_;       ///< per vertex
  std::vector<Vec3> local_;          ///< of the vertices after the cloth's, in their obstacle's frame
  std::vector<int> obstacle_of_;     ///< of the vertices after the cloth's
  std::vector<int> first_triangle_;  ///< of each obstacle
};

}  // namespace gambeson::exact
