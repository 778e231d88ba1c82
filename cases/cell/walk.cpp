#include "cases/cell/walk.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace gambeson {
RestStiffness restStiffness(const CellEngine& engine) {
  RestStiffness rest;
  try {
    const auto specimen = engine.specimen();
    specimen->bring({});
    rest.membrane_N_per_m = specimen->membraneTangent();
    rest.bending_Nm = specimen->bendingStiffness();
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
