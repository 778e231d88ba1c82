#include "cases/homogenise/homogenise.hpp"

#include <fmt/format.h>

#include <ostream>

#include "cases/cell/case.hpp"
#include "cases/cloth/law_table.hpp"
#include "cases/input/wrong_entry.hpp"
#include "cases/runs/results_folder.hpp"
#include "cases/runs/stop_message.hpp"
#include "cases/yarns/design.hpp"
#include "core/error.hpp"
#include "core/yarn/homogenise.hpp"

namespace gambeson {
namespace {

CellCase rodsOf(const HomogeniseArguments& a) {
  CellCase c = readCellCase(a.file, a.overrides);
  if (c.yarns != YarnModel::rod)
    sayInCase(c.file, c.overrides, InputError({"", 0, "yarns"}, "is not tabulated; allowed for homogenise: rod"));
  const auto refuse = [&](const char* key, const char* reason) {
    sayInCase(c.file, c.overrides, InputError({"", 0, key}, reason));
  };
  if (c.friction) refuse("friction", "has no energy to be tabulated; allowed for homogenise: none");
  if (c.quarter) refuse("extent", "quarter does not bend; allowed for homogenise: full");
  return c;
}

HomogeniseOptions optionsOf(const HomogeniseArguments& a, const CellCase& c) {
  HomogeniseOptions o;
  o.range = {a.e11, a.e22, {2 * a.e12[0], 2 * a.e12[1]}};
  o.tension_error = a.tension_error;
  o.shear_error = a.shear_error;
  o.most_nodes = a.most_nodes;
  o.rigidity_by_strain = !a.rigidity_at_rest;
  o.shrink = a.shrink;
  o.equilibrium = equilibriumOptions(c.solver);
  return o;
}

/// Keys of the core as options of the command.
[[noreturn]] void sayOfOptions(const InputError& e) {
  for (const auto& [key, option] :
       {std::pair("range.e11", "--e11"), std::pair("range.e22", "--e22"), std::pair("range.g12", "--e12"),
        std::pair("most_nodes", "--nodes"), std::pair("errors", "--tension-error, --shear-error")})
    if (e.where().file.empty() && e.where().key == key) throw InputError({"command line", 0, option}, e.reason());
  throw e;
}

std::string percent(double part) { return fmt::format("{:.3g} %", 100 * part); }

std::string inWords(const HomogeniseOptions& o) {
  return fmt::format("errors wanted: tension {}, shear {}; at most {} nodes; rigidity {}; tolerance {:g}",
                     percent(o.tension_error), percent(o.shear_error), o.most_nodes,
                     o.rigidity_by_strain ? "by strain" : "at rest", o.equilibrium.tolerance);
}

}  // namespace

int homogeniseCell(const HomogeniseArguments& a, std::ostream& out) {
  const CellCase c = rodsOf(a);
  checkOutput(a.law, "--output", inputsOf(c));
  useThreads(a.threads);
  const StopMessage stopped("stopped by a signal; nothing is written");
  const HomogeniseOptions options = optionsOf(a, c);
  HomogenisedCell made;
  try {
    made = homogenise(RodCell(rodDesign(c)), options);
  } catch (const InputError& e) {
    sayOfOptions(e);
  } catch (const RunError& e) {
    throw RunError(fmt::format("{}; a smaller range (--e11, --e22, --e12) may do, or --shrink", e.what()));
  }
  LawFile law;
  law.table = made.table;
  law.provenance.cell = caseIdentity(c);
  law.provenance.cell_name = c.name;
  law.provenance.made_by = "gambeson " GAMBESON_VERSION;
  law.provenance.options = inWords(options);
  law.provenance.error_tension = made.tension_error;
  law.provenance.error_shear = made.shear_error;
  law.provenance.compared_at = made.checked;
  writeLawTable(a.law, law);

  const std::array<std::vector<double>, 3>& nodes = made.table.membrane.nodes;
  out << fmt::format(
      "{}: {} x {} x {} nodes, E11 {:g} to {:g}, E22 {:g} to {:g}, E12 {:g} to {:g}\n"
      "Estimated errors from {} cells between the nodes: tension {} of {:.4g} N/m, shear {} of {:.4g} N/m\n",
      a.law.string(), nodes[0].size(), nodes[1].size(), nodes[2].size(), made.range[0][0], made.range[0][1],
      made.range[1][0], made.range[1][1], 0.5 * made.range[2][0], 0.5 * made.range[2][1], made.checked,
      percent(made.tension_error), made.largest_tension_N_per_m, percent(made.shear_error), made.largest_shear_N_per_m);
  if (!made.reached)
    throw RunError(
        fmt::format("the errors wanted ({} of tension, {} of shear) were not reached with {} nodes: {} holds "
                    "a table whose errors are {} and {}; more --nodes, or a smaller range, may do",
                    percent(a.tension_error), percent(a.shear_error), a.most_nodes, a.law.string(),
                    percent(made.tension_error), percent(made.shear_error)));
  return 0;
}

}  // namespace gambeson
