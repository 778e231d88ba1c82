#include "core/motion/step_method.hpp"

#include "core/contact/projection.hpp"
#include "core/error.hpp"
#include "core/math/parallel.hpp"
#include "core/motion/step_contact.hpp"
#include "core/motion/step_rows.hpp"

namespace gambeson {
namespace {

MethodStep methodStep(const Model& m, double dt, const StepWork& w) {
  return {m.surface.WT,
          m.inverse_mass,
          m.surface.area_m2,
          m.density_kg_per_m2,
          m.place,
          m.obstacles,
          w.stage.start.obstacles,
          w.stage.end.obstacles,
          w.x0,
          m.contact,
          dt};
}

RowLayer rowLayer(const Model& m, const ContactRow& row) { return {layerOf(m, row), standsOut(m, row)}; }

}  // namespace

void checkMethod(const Model& m) {
  if (m.contact.followsMotion())
    throw InputError({"", 0, "contact.friction"},
                     "this contact.method knows Coulomb's friction; allowed with it: a number");
  if (m.strain_limit.mode != LimitMode::none)
    throw InputError({"", 0, "contact.method"}, "goes without limits of strain; allowed with them: together");
  if (m.structure)
    throw InputError({"", 0, "contact.method"}, "goes with worn cloth; allowed in a structure: together");
  if (m.contact.method == ContactMethod::penalty && !(m.contact.penalty_Pa_per_m > 0))
    throw InputError({"", 0, "contact.penalty"}, "is required with the method penalty; allowed: > 0 Pa/m");
  if (m.contact.method == ContactMethod::projection) checkProjection(m.surface.WT, m.obstacles);
}

void prepareRows(const Model& m, double dt, StepWork& w) {
  const MethodStep step = methodStep(m, dt, w);
  forAll(Each::sum, static_cast<int>(w.rows.size()), [&](int k) {
    if (m.method->takes(w.rows[k])) m.method->prepare(step, rowLayer(m, w.rows[k]), w.rows[k]);
  });
}

ContactSolve solveByMethod(const Model& m, double dt, StepWork& w) {
  w.row_layer.clear();
  for (const ContactRow& row : w.rows) w.row_layer.push_back(rowLayer(m, row));
  return solveByMethod(*m.method, methodStep(m, dt, w), {w.rows, w.row_layer}, w.velocity, w.warm, w.impulses,
                       w.contact, w.method);
}

bool givesBack(const Model& m, const ContactRow& row) {
  return m.contact.method == ContactMethod::penalty && m.method->takes(row);
}

}  // namespace gambeson
