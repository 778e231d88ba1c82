/// Detail of measure.hpp: how deep the cloth's surface itself lies in the body, between the samples that contact sees,
/// and how far seams gape.

#include <algorithm>

#include "cases/wear/results/measure.hpp"
#include "cases/wear/scene/placed_bodies.hpp"
#include "core/error.hpp"

namespace gambeson {
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
  const SparseRows W = s.model->cloth->finer(fineness, s.samples_per_cell);
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

std::optional<SeamGap> widestSeamGap(const Scenario& s, const RecordingReader& recording) {
  const SewnRows rows = s.model->cloth->sewnRows();
  if (rows.empty()) return std::nullopt;
  const auto count = static_cast<std::size_t>(rows.pairs.rows());
  std::vector<Vec3> gap(count);
  SeamGap widest;
  for (int k = 0; k < recording.frameCount(); ++k) {
    if (!(recording.time(k) > 1e-9)) continue;
    const Frame frame = recording.frame(k);
    const std::vector<Vec3> q = controlPointsOf(frame, static_cast<std::size_t>(rows.pairs.column_count));
    rows.pairs.multiply<Vec3>(q, gap);
    for (std::size_t i = 0; i < count; ++i) {
      if (!(norm(gap[i]) > widest.cells * rows.cell_m[i])) continue;
      Vec3 side{};  // the hats of one side, which are positive, sum to 1
      for (int e = rows.pairs.offsets[i]; e < rows.pairs.offsets[i + 1]; ++e)
        if (rows.pairs.values[e] > 0) side += rows.pairs.values[e] * q[static_cast<std::size_t>(rows.pairs.columns[e])];
      widest = {norm(gap[i]), norm(gap[i]) / rows.cell_m[i], frame.time_s, side};
    }
  }
  return widest;
}

}  // namespace gambeson
