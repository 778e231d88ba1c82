#include "cases/cell/walk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "core/error.hpp"

namespace gambeson {
namespace {

/// M/k of a cylinder whose arcs run along a direction.
double bendingOf(const CellEngine& engine, double curvature_per_m, double direction_rad) {
  CellTarget to;
  to.load.curvature_per_m = curvature_per_m;
  to.load.direction_rad = direction_rad;
  const CellStep step = engine.specimen()->bring(to);
  if (!step.reached) throw RunError("the cell cannot be bent at rest: " + step.why);
  return step.point.resultants.moment_N / curvature_per_m;
}

}  // namespace

RestStiffness restStiffness(const CellEngine& engine, const CellCase& c) {
  constexpr double kBend = 1e-3;
  RestStiffness rest;
  try {
    const auto specimen = engine.specimen();
    specimen->bring({});
    rest.membrane_N_per_m = specimen->membraneTangent();
    if (!engine.bends()) return rest;
    double half_m = 0;
    for (const int d : {along_weft, along_warp})
      half_m = std::max(half_m, c.yarn(d).shape.amplitude_m + c.yarn(d).shape.half_thickness_m);
    const double k = kBend / half_m, weft = bendingOf(engine, k, 0), warp = bendingOf(engine, k, std::numbers::pi / 2),
                 bias = bendingOf(engine, k, std::numbers::pi / 4);
    rest.bending_Nm = {weft, warp, 2 * bias - 0.5 * (weft + warp)};
  } catch (const RunError& e) {
    rest.why = e.what();
  }
  return rest;
}

WalkedPath walk(const CellEngine& engine, const PathCase& path, CellShapesKept kept,
                const std::function<void()>& each) {
  WalkedPath walked;
  const auto specimen = engine.specimen();
  for (const double part : partsOf(path)) {
    CellStep step = specimen->bring(targetOf(path.load, part));
    if (!step.reached) {
      walked.reached = false;
      walked.why = fmt::format("at {:.4g} of its way {}", part, step.why);
      break;
    }
    walked.rows.push_back({part, step.point, {}});
    if (kept == CellShapesKept::all) walked.rows.back().shape = specimen->shape();
    each();
  }
  // Where a step failed yarns stand wherever it gave up; the rows end before.
  if (walked.reached && kept == CellShapesKept::last) walked.rows.back().shape = specimen->shape();
  return walked;
}

}  // namespace gambeson
