#include "cases/yarns/rules.hpp"

#include <fmt/format.h>

#include <cmath>

#include "cases/input/wrong_entry.hpp"
#include "cases/yarns/design.hpp"
#include "core/error.hpp"

namespace gambeson::schema {
namespace {

Entry memberOf(const Entry& parent, const std::string& key) { return parent.member(*parent.node.find(key)); }

/// Of hexahedra, before anything is built.
void checkSolidSize(const Entry& root, const CellDesign& c, const Weave& weave) {
  constexpr long kCells = 60000;
  const YarnMeshing& mesh = c.solids->mesh;
  const long spacings = c.quarter ? 2 : 2L * weave.warps * weave.wefts;
  const long cells = spacings * mesh.along * mesh.across * mesh.across;
  if (cells <= kCells) return;
  const std::string reason =
      fmt::format("{} x {} x {} hexahedra along {} spacings of yarns are {}; allowed: at most {}", mesh.across,
                  mesh.across, mesh.along, spacings, cells, kCells);
  if (const JsonNode* solids = root.node.find("solids")) root.member(*solids).failAt("across", reason);
  memberOf(root, "weave").fail(reason);
}

/// Keys that are of rods, in a case that may have been written in full.
void checkSolid(const Entry& root, CellDesign& c) {
  if (c.yarns != YarnModel::solid) {
    if (c.solids) memberOf(root, "solids").fail("goes with yarns solid");
    return;
  }
  if (!c.solids) c.solids = SolidsCase{};
  if (c.compression) memberOf(root, "compression").fail("goes with yarns rod or truss: solids give way by themselves");
  if (c.by_section) memberOf(root, "touch").fail("section goes with yarns rod: solids touch by their surfaces");
  const CellSolver usual;
  if (c.solver.pieces_per_spacing != usual.pieces_per_spacing)
    memberOf(root, "solver").failAt("pieces_per_spacing", "goes with yarns rod; with yarns solid: solids.along");
  if (c.solver.iterations != usual.iterations)
    memberOf(root, "solver").failAt("iterations", "goes with yarns rod; with yarns solid: solids.iterations");
  if (!c.friction) return;
  if (c.friction->stick_stiffness_N_per_m3)
    memberOf(root, "friction").failAt("stick_stiffness", "goes with yarns rod; with yarns solid: solids.penalty");
  const bool rubs = c.friction->coefficient > 0;
  if (rubs && c.solids->method == SolidContactMethod::multipliers)
    memberOf(root, "solids")
        .failAt("contact_method",
                "multipliers know no friction; allowed with it: augmented or "
                "penalty");
  if (rubs && c.solids->method == SolidContactMethod::penalty && c.solids->bound != FrictionBound::coupled)
    memberOf(root, "solids")
        .failAt("contact_method",
                "penalty keeps no pressure of a pass before; allowed with friction: \"friction_bound\": "
                "\"coupled\"");
}

/// What is counted before anything is built: sections of yarns, and pairs of them near crossings.
void checkSize(const Entry& root, const CellDesign& c, const Weave& weave) {
  constexpr long kSections = 40000, kPairs = 4000000;
  const long crossings = static_cast<long>(weave.warps) * weave.wefts, n = c.solver.pieces_per_spacing;
  const long sections = 2 * crossings * n, beside = c.by_section ? sections * (4 * n + 1) : 0,
             pairs = crossings * (2 * n + 1) * (2 * n + 1) + beside;
  if (sections <= kSections && pairs <= kPairs) return;
  const std::string reason = fmt::format(
      "{} pieces between the crossings of {} x {} yarns give {} sections and {} pairs of them; allowed: at most {} and "
      "{}",
      n, weave.warps, weave.wefts, sections, pairs, kSections, kPairs);
  if (const JsonNode* solver = root.node.find("solver")) root.member(*solver).failAt("pieces_per_spacing", reason);
  memberOf(root, "weave").fail(reason);
}

void checkTruss(const Entry& root, const CellDesign& c) {
  constexpr double kTouch = 0.01;
  if (c.yarns != YarnModel::truss) return;
  if (c.weave.pattern != WeavePattern::plain)
    memberOf(root, "weave").failAt("pattern", "the truss is of a plain weave; allowed with yarns truss: plain");
  if (!c.contact)
    memberOf(root, "contact").fail("the truss is joined at its crossings; allowed with yarns truss: true");
  if (c.holds_faces) memberOf(root, "faces").fail("held goes with yarns rod: a truss has no sections in its faces");
  if (c.by_section) memberOf(root, "touch").fail("section goes with yarns rod: a truss is joined at its crossings");
  if (c.friction) memberOf(root, "friction").fail("goes with yarns rod: a truss is joined at its crossings");
  if (c.quarter) memberOf(root, "extent").fail("quarter goes with yarns rod: a truss is one crossing");
  // A case that was written in full says what is usual.
  const CellSolver& s = c.solver;
  const CellSolver usual;
  for (const auto& [key, other] :
       {std::pair("pieces_per_spacing", s.pieces_per_spacing != usual.pieces_per_spacing),
        std::pair("tolerance", s.tolerance != usual.tolerance),
        std::pair("iterations", s.iterations != usual.iterations), std::pair("halvings", s.halvings != usual.halvings)})
    if (other) memberOf(root, "solver").failAt(key, "goes with yarns rod: a truss is solved to rounding");
  double amplitudes = 0, halves = 0;
  for (const int d : {along_weft, along_warp}) {
    amplitudes += c.yarn(d).shape.amplitude_m;
    halves += c.yarn(d).shape.half_thickness_m;
  }
  if (!(std::abs(amplitudes - halves) <= kTouch * halves))
    memberOf(root, "weft")
        .failAt("amplitude", fmt::format("the amplitudes of weft and warp add up to {:.6g} m, and a truss touches at "
                                         "rest; allowed: within {:g} % of the half thicknesses, {:.6g} m",
                                         amplitudes, 100 * kTouch, halves));
}

}  // namespace

void applyDesignRules(const Entry& root, CellDesign& c) {
  if (!c.warp) c.warp = c.weft;
  if (!c.height_m) c.height_m = 2 * (c.weft.shape.half_thickness_m + c.warp->shape.half_thickness_m);
  checkSolid(root, c);
  if (c.contact && !c.compression && c.yarns != YarnModel::solid)
    root.failAt("compression",
                "is required with contact: how yarns give way to each other, such as {\"half_force\": "
                "\"5 N\"}");
  if (!c.contact && c.compression) memberOf(root, "compression").fail("goes with contact, which is false");
  if (!c.contact && c.by_section) memberOf(root, "touch").fail("section goes with contact, which is false");
  if (!c.contact && c.friction) memberOf(root, "friction").fail("goes with contact, which is false");
  checkTruss(root, c);
  try {
    if (c.yarns == YarnModel::solid) {
      checkSolidSize(root, c, weaveOf(c.weave));
    } else {
      checkSize(root, c, weaveOf(c.weave));
    }
  } catch (const InputError& e) {
    sayAt(root, e);
  }
}

}  // namespace gambeson::schema
