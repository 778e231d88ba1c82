#include "exact/scene_intersections.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>

#include "core/contact/scene_check.hpp"
#include "core/motion/step.hpp"

namespace gambeson::exact {

SceneIntersections::SceneIntersections(const Model& model, const Stage& stage, int levels)
    : model_(model), stage_(stage), triangles_(model.surface.triangles), obstacle_(model.surface.size(), 0) {
  for (int o = 0; o < static_cast<int>(model.obstacles.size()); ++o) {
    const Shape& shape = model.obstacles[o].shape;
    const auto* mesh = std::get_if<TriangleMesh>(&shape);
    const TriangleMesh inscribed = mesh ? TriangleMesh{} : ellipsoidMesh(std::get<Ellipsoid>(shape), levels);
    if (!mesh) mesh = &inscribed;
    const int first = static_cast<int>(obstacle_.size());
    first_triangle_.push_back(static_cast<int>(triangles_.size()));
    obstacle_.resize(obstacle_.size() + mesh->vertices.size(), 1);
    obstacle_of_.resize(obstacle_of_.size() + mesh->vertices.size(), o);
    local_.insert(local_.end(), mesh->vertices.begin(), mesh->vertices.end());
    for (const auto& [a, b, c] : mesh->triangles) triangles_.push_back({first + a, first + b, first + c});
  }
}

Intersections SceneIntersections::at(std::span<const Vec3> p, double time_s) const {
  std::vector<Vec3> x;
  samplePositions(model_, p, x);
  return ofSamples(x, time_s);
}

Intersections SceneIntersections::ofSamples(std::span<const Vec3> samples, double time_s) const {
  assert(static_cast<int>(samples.size()) == model_.surface.size());
  std::vector<Placement> placed(model_.obstacles.size()), anchors(model_.anchor_count);
  stage_.placements(time_s, placed, anchors);
  std::vector<Vec3> x(samples.begin(), samples.end());
  x.reserve(obstacle_.size());
  for (std::size_t k = 0; k < local_.size(); ++k) x.push_back(placed[obstacle_of_[k]] * local_[k]);
  std::size_t first = samples.size();
  const DeformedVertices vertices = deformedVertices(model_, stage_, time_s);
  for (std::size_t o = 0, k = 0; o < vertices.size(); ++o, first = samples.size() + k) {
    std::copy(vertices[o].begin(), vertices[o].end(), x.begin() + static_cast<std::ptrdiff_t>(first));
    while (k < local_.size() && obstacle_of_[k] == static_cast<int>(o)) ++k;
  }
  Intersections found = intersections(x, triangles_, obstacle_);
  const ContactMesh& mesh = model_.collisions.mesh;
  const auto across = [&](const IntersectingPair& p) {
    return p.shared == 0 && p.b < static_cast<int>(model_.surface.triangles.size()) &&
           mesh.hangTogether(triangles_[p.a], triangles_[p.b]);
  };
  std::copy_if(found.pairs.begin(), found.pairs.end(), std::back_inserter(found.across_seams), across);
  std::erase_if(found.pairs, across);
  // A body's own triangles are the case's, not the simulation's.
  std::erase_if(found.collapsed, [&](int t) { return obstacle_[triangles_[t][0]]; });
  return found;
}

std::string SceneIntersections::name(int triangle) const {
  const auto after = std::upper_bound(first_triangle_.begin(), first_triangle_.end(), triangle);
  const auto& [a, b, c] = triangles_[triangle];
  const int cloth = model_.surface.size();
  if (a < cloth)
    return "cloth " + std::to_string(triangle) + " (samples " + std::to_string(a) + " " + std::to_string(b) + " " +
           std::to_string(c) + ")";
  const std::size_t o = static_cast<std::size_t>(after - first_triangle_.begin()) - 1;
  return model_.obstacles[o].segment + " " + std::to_string(triangle - first_triangle_[o]);
}

std::string SceneIntersections::name(const IntersectingPair& pair) const {
  return name(pair.a) + " with " + name(pair.b) + ", sharing " + std::to_string(pair.shared) + " vertices";
}

}  // namespace gambeson::exact
