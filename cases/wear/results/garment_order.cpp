/// Detail of measure.hpp: whether garments that are worn over each other lie in their order.

#include <algorithm>
#include <array>
#include <cmath>

#include "cases/wear/results/measure.hpp"
#include "cases/wear/scene/placed_bodies.hpp"
#include "core/contact/bounding_tree.hpp"
#include "core/contact/triangle.hpp"

namespace gambeson {
namespace {

constexpr double reach_m = 0.03;           ///< cloth that is farther does not lie on cloth
constexpr double least_covered_m2 = 2e-3;  ///< garments that touch along an edge only have no order
constexpr int most_looks = 40;             ///< frames that are looked at

/// Of each garment, by the triangles of the surface.
struct GarmentTriangles {
  std::vector<std::size_t> of_sample;
  std::vector<std::vector<std::array<int, 3>>> triangles;
};

GarmentTriangles trianglesByGarment(const Scenario& s) {
  const Surface& surface = s.model->surface;
  GarmentTriangles garments;
  for (int i = 0; i < surface.size(); ++i)
    garments.of_sample.push_back(
        static_cast<std::size_t>(s.model->cloth->patches()[static_cast<std::size_t>(surface.patch[i])].garment));
  garments.triangles.resize(s.definition.garments.size());
  for (const std::array<int, 3>& t : surface.triangles)
    garments.triangles[garments.of_sample[static_cast<std::size_t>(t[0])]].push_back(t);
  return garments;
}

std::vector<Vec3> normalsOf(const Surface& surface, const std::vector<Vec3>& x) {
  std::vector<Vec3> n(x.size());
  for (const std::array<int, 3>& t : surface.triangles) {
    const Vec3 area = cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]);
    for (int corner : t) n[static_cast<std::size_t>(corner)] += area;
  }
  for (Vec3& v : n)
    if (norm(v) > 0) v *= 1 / norm(v);
  return n;
}

/// +1 for a garment whose normals point away from the bodies, -1 for one whose normals point to them.
std::vector<double> outward(const Scenario& s, const GarmentTriangles& garments, const Frame& frame) {
  constexpr double step_m = 1e-3;
  const std::vector<Vec3> x = vectorsOf(frame.positions), n = normalsOf(s.model->surface, x);
  PlacedBodies bodies(s);
  bodies.moveTo(frame.time_s);
  std::vector<double> away(garments.triangles.size(), 0);
  for (std::size_t i = 0; i < x.size(); i += 7) {
    const double here = bodies.nearest(x[i]).distance_m;
    if (std::abs(here) < 0.1) away[garments.of_sample[i]] += bodies.nearest(x[i] + step_m * n[i]).distance_m - here;
  }
  for (double& a : away) a = a < 0 ? -1 : 1;
  return away;
}

/// The share of the higher garment that has the lower one in front of it, of what has it on either side. In front is
/// what shows its inner side: where the body folds, belly against thigh, a higher garment also has the outer side of a
/// lower one before it.
double wrongShare(const Scenario& s, const GarmentTriangles& garments, std::size_t lower, std::size_t higher,
                  const std::vector<Vec3>& x, const std::vector<Vec3>& n, const std::vector<double>& sign) {
  const std::vector<std::array<int, 3>>& under = garments.triangles[lower];
  std::vector<Box> boxes(under.size());
  for (std::size_t t = 0; t < under.size(); ++t)
    for (int corner : under[t]) boxes[t].add(x[static_cast<std::size_t>(corner)]);
  const BoundingTree tree(boxes);
  double behind = 0, in_front = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (garments.of_sample[i] != higher) continue;
    Vec3 nearest = x[i], outer{};
    double best2 = reach_m * reach_m;
    bool any = false;
    tree.nearest(x[i], best2, [&](int t, double& least2) {
      const std::array<int, 3>& c = under[static_cast<std::size_t>(t)];
      const TrianglePoint p = closestOnTriangle({x[c[0]], x[c[1]], x[c[2]]}, x[i]);
      if (!(p.dist2_m2 < least2)) return;
      least2 = p.dist2_m2;
      nearest = p.position;
      outer = sign[lower] * cross(x[c[1]] - x[c[0]], x[c[2]] - x[c[0]]);
      any = true;
    });
    const double rises = sign[higher] * dot(x[i] - nearest, n[i]);
    // Beside an edge of the lower garment it has none on either side, nor where both are in one place.
    if (!any || std::abs(rises) < std::max(1e-5, 0.5 * std::sqrt(best2))) continue;
    (rises > 0 || dot(x[i] - nearest, outer) > 0 ? behind : in_front) += s.model->surface.area_m2[i];
  }
  return behind + in_front > least_covered_m2 ? in_front / (behind + in_front) : 0;
}

}  // namespace

void measureGarmentOrder(const Scenario& s, const RecordingReader& recording, Measured& out) {
  const std::size_t count = s.definition.garments.size();
  if (!s.human || count < 2 || recording.frameCount() == 0) return;
  const GarmentTriangles garments = trianglesByGarment(s);
  for (std::size_t higher = 1; higher < count; ++higher)
    for (std::size_t lower = 0; lower < higher; ++lower)
      out.garment_order.push_back({s.definition.garments[lower].name, s.definition.garments[higher].name, 0, 0});
  const std::vector<double> sign = outward(s, garments, recording.frame(0));
  const int stride = 1 + recording.frameCount() / most_looks, last = recording.frameCount() - 1;
  for (int k = last % stride; k <= last; k += stride) {
    if (recording.time(k) < -1e-9) continue;
    const Frame frame = recording.frame(k);
    const std::vector<Vec3> x = vectorsOf(frame.positions), n = normalsOf(s.model->surface, x);
    std::size_t at = 0;
    for (std::size_t higher = 1; higher < count; ++higher)
      for (std::size_t lower = 0; lower < higher; ++lower) {
        GarmentOrderMeasure& m = out.garment_order[at++];
        const double wrong = wrongShare(s, garments, lower, higher, x, n, sign);
        if (wrong > m.largest) m.largest = wrong, m.time_s = frame.time_s;
      }
  }
}

}  // namespace gambeson
