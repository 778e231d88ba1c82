/// Detail of measure.hpp: how deep the cloth's surface itself lies in the body, between the samples that contact sees.

#include <algorithm>

#include "cases/wear/results/measure.hpp"
#include "cases/wear/scene/placed_bodies.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

/// The surface at `fineness` points where the samples have one, along each direction, less what is trimmed off: rows of
/// basis functions.
SparseRows finerSurface(const Garment& garment, int fineness, const std::vector<int>& samples_per_cell) {
  SparseRows rows;
  int first = 0;
  for (std::size_t p = 0; p < garment.patches.size(); ++p) {
    const NurbsPatch& patch = garment.patches[p];
    const int per_cell = fineness * std::max(1, samples_per_cell[p]);  // 0: Greville points, one per cell
    const bool trimmed = p < garment.trims.size() && !garment.trims[p].loops.empty();
    // Just inside of the patch's border, for a loop may run along it.
    const auto inward = [](const KnotVector& k, double at) { return at + 1e-6 * (0.5 * (k.front() + k.back()) - at); };
    const auto parameters = [&](const KnotVector& knots) {
      const std::vector<double> ends = breakpoints(knots);
      std::vector<double> at;
      for (std::size_t c = 0; c + 1 < ends.size(); ++c)
        for (int i = 0; i < per_cell; ++i) at.push_back(ends[c] + (ends[c + 1] - ends[c]) * i / per_cell);
      at.push_back(ends.back());
      return at;
    };
    for (const double v : parameters(patch.v))
      for (const double u : parameters(patch.u)) {
        if (trimmed && !isKept(patch, garment.trims[p], {inward(patch.u, u), inward(patch.v, v)})) continue;
        const SurfaceBasis basis = surfaceBasis(patch, u, v);
        for (std::size_t k = 0; k < basis.columns.size(); ++k) rows.add(first + basis.columns[k], basis.values[0][k]);
        rows.endRow();
      }
    first += patch.size();
  }
  rows.column_count = first;
  return rows;
}

}  // namespace

std::vector<Vec3> controlPointsOf(const Frame& frame, std::size_t count) {
  const auto field = std::find_if(frame.control_fields.begin(), frame.control_fields.end(),
                                  [](const Field& f) { return f.name == "position"; });
  if (field == frame.control_fields.end() || field->data.size() != 3 * count)
    throw RunError("the recording has no control points that fit the garment");
  std::vector<Vec3> q(count);
  for (std::size_t i = 0; i < count; ++i) q[i] = {field->data[3 * i], field->data[3 * i + 1], field->data[3 * i + 2]};
  return q;
}

SurfaceDepth surfaceDepth(const Scenario& s, const RecordingReader& recording) {
  constexpr int fineness = 4;
  const SparseRows W = finerSurface(s.model->shell.garment(), fineness, s.samples_per_cell);
  const auto n = static_cast<std::size_t>(W.rows());
  SurfaceDepth depth;
  depth.points = W.rows();
  std::vector<Vec3> x(n);
  const std::vector<double> reach(n, 0);
  std::vector<Contact> inside;
  PlacedBodies placed(s);
  // Without triangles to look at, only whether a point is inside of a mesh is asked, and of points that were outside
  // and have gone less than their distance since not even that.
  MeshCandidates known;
  known.first.assign(n + 1, 0);
  for (int k = 0; k < recording.frameCount(); ++k) {
    if (!(recording.time(k) > 1e-9)) continue;
    const Frame frame = recording.frame(k);
    const std::vector<Vec3> q = controlPointsOf(frame, static_cast<std::size_t>(W.column_count));
    W.multiply<Vec3>(q, x);
    placed.moveTo(frame.time_s);
    std::fill(known.outside_of.begin(), known.outside_of.end(), 0);  // what deforms keeps no distances
    s.model->proximity->near(placed.placements(), placed.placements(), x, reach, inside, &known, placed.surfaces());
    for (const Contact& c : inside)
      if (-c.gap_m > depth.deepest_m) depth.deepest_m = -c.gap_m, depth.time_s = frame.time_s;
  }
  return depth;
}

}  // namespace gambeson
