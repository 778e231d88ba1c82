#include "tryon/projecting.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>

#include "core/error.hpp"

namespace gambeson {
namespace {

/// The centre in the shape's frame: of an ellipsoid its own, of a mesh that of its surface's area.
Vec3 centreOf(const Shape& shape) {
  const auto* mesh = std::get_if<TriangleMesh>(&shape);
  if (!mesh) return {};
  Vec3 sum;
  double area = 0;
  for (const auto& [i, j, k] : mesh->triangles) {
    const Vec3 &a = mesh->vertices[i], &b = mesh->vertices[j], &c = mesh->vertices[k];
    const double w = norm(cross(b - a, c - a));
    sum += w / 3 * (a + b + c);
    area += w;
  }
  return area > 0 ? sum / area : sum;
}

/// Scaled by k about the point `centre` of the shape: x = R (k s (p - centre)) + X * centre.
Placement scaled(const Placement& X, const Vec3& centre, double k) {
  return {X.rotation, X * centre - X.rotation * (k * X.scale * centre), k * X.scale};
}

}  // namespace

std::vector<Placement> shrinkToFree(const ProximityQuery& query, std::span<const Obstacle> obstacles,
                                    std::span<const Placement> standing, std::span<const Vec3> samples,
                                    double clearance_m) {
  if (!(clearance_m > 0) || !std::isfinite(clearance_m))
    throw InputError({"", 0, "clearance_m"}, std::to_string(clearance_m) + ", must be positive");
  assert(obstacles.size() == standing.size());
  std::vector<Placement> out(standing.begin(), standing.end());
  std::set<std::string> stuck;
  for (std::size_t o = 0; o < obstacles.size(); ++o) {
    const Vec3 centre = centreOf(obstacles[o].shape);
    const auto free = [&](const Placement& X, const Vec3& x) {
      return query.signedDistance(static_cast<int>(o), X, x) >= clearance_m;
    };
    std::vector<Vec3> touching;
    for (const Vec3& x : samples)
      if (!free(standing[o], x)) touching.push_back(x);
    if (touching.empty()) continue;
    // A mesh need not contain the segments to its centre; samples that it did not touch are then looked at as well.
    const bool convex = std::holds_alternative<Ellipsoid>(obstacles[o].shape);
    const auto allFree = [&](double k) {
      const Placement X = scaled(standing[o], centre, k);
      const auto freeOf = [&](const Vec3& x) { return free(X, x); };
      return std::all_of(touching.begin(), touching.end(), freeOf) &&
             (convex || std::all_of(samples.begin(), samples.end(), freeOf));
    };
    // Down in steps of 2 % to the first that frees, so that a mesh's largest free size is found and not another one.
    double blocked = 1, k = 0.98;
    while (k >= least_projecting_scale && !allFree(k)) {
      blocked = k;
      k *= 0.98;
    }
    if (k < least_projecting_scale) {
      stuck.insert(obstacles[o].segment);
      continue;
    }
    while (blocked - k > 1e-4) {
      const double middle = 0.5 * (k + blocked);
      (allFree(middle) ? k : blocked) = middle;
    }
    out[o] = scaled(standing[o], centre, k);
  }
  if (!stuck.empty()) {
    std::string names;
    for (const std::string& s : stuck) names += (names.empty() ? "" : ", ") + s;
    throw RunError("virtual projecting cannot free the garment of: " + names + ". Even at " +
                   std::to_string(static_cast<int>(std::lround(100 * least_projecting_scale))) +
                   " % of their size the cloth passes within " + std::to_string(1000 * clearance_m) +
                   " mm of them: place the garment around the body, or give it more ease");
  }
  return out;
}

double grownPart(double phase) {
  const double s = std::clamp(phase, 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

std::vector<Placement> placementsDuringGrowth(std::span<const Placement> standing, std::span<const Placement> shrunk,
                                              double phase) {
  assert(standing.size() == shrunk.size());
  const double w = grownPart(phase);
  std::vector<Placement> out;
  for (std::size_t i = 0; i < standing.size(); ++i) {
    const Placement &a = shrunk[i], &b = standing[i];
    out.push_back(
        w >= 1 ? b : Placement{b.rotation, a.origin + w * (b.origin - a.origin), a.scale + w * (b.scale - a.scale)});
  }
  return out;
}

}  // namespace gambeson
