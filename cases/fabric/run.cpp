#include "cases/fabric/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ostream>

#include "cases/cloth/card_library.hpp"
#include "cases/cloth/fabric_input.hpp"
#include "cases/cloth/fields.hpp"
#include "cases/fabric/fit_card.hpp"
#include "cases/fabric/raw_loop.hpp"
#include "cases/fabric/results.hpp"
#include "cases/runs/results_folder.hpp"
#include "core/error.hpp"
#include "core/io/own_file.hpp"

namespace gambeson {
namespace {

using Json = nlohmann::ordered_json;

/// Whether --fit names a raw loop of bending; else measurements (JSON), or nothing.
bool fitsLoop(const FabricOptions& o) { return !o.loop.empty() && o.loop.extension() != ".json"; }

/// Puts what the measurements say into the card.
std::vector<FittedNumber> fitMeasurements(const FabricOptions& o, FabricCard& card) {
  if (o.loop.empty() || fitsLoop(o)) return {};
  const Measurements measured = readMeasurements(o.loop);
  try {
    return fitCard(measured, card);
  } catch (const InputError& e) {
    throw InputError({o.loop.string(), 0, e.where().key}, e.reason());
  }
}

/// What a raw loop makes of the bending of a card's fabric: its stops, the same about all axes.
LoopFit bendByFit(const FabricOptions& o, const FabricCard& card, std::vector<LoopSample>& raw, CardFabric& c) {
  if (card.tensile && card.tensile->law == TensileLaw::curve)
    throw InputError({o.card.string(), 0, "tensile.law"},
                     "a law of curves is elastic, and takes no loop of bending; allowed with --fit: secant");
  raw = readLoop(o.loop);
  LoopFit fit;
  try {
    fit = fitStops(raw);
  } catch (const InputError& e) {
    throw InputError({o.loop.string(), 0, ""}, e.reason());
  }
  FrictionInBending law;
  law.shape = fit.stops.shape;
  law.weft_Nm = law.warp_Nm = fit.stops.last_Nm;
  law.twist_Nm = 0.5 * fit.stops.last_Nm;
  law.first_Nm = {fit.stops.first_Nm, fit.stops.first_Nm, 0.5 * fit.stops.first_Nm};
  law.span_per_m.fill(fit.stops.span_per_m);
  IsotropicHysteresisBending isotropic{law};
  isotropic.check([&](const std::string&, const std::string& reason) {
    throw InputError({o.loop.string(), 0, ""}, "gives no law of bending: " + reason);
  });
  c = fabricOf(card, &isotropic);
  c.derived.push_back(fmt::format("bending: stops of the raw loop {}, in place of B and 2HB", o.loop.string()));
  c.assumed.push_back("one loop about all axes: that of the raw loop");
  return fit;
}

/// The fabric as cases write it.
Json fabricJson(const FabricCase& fabric) {
  const schema::FabricInput in = schema::restoreFabric(fabric);
  const schema::Object table = schema::fabricTable();
  return Json::parse(schema::toText(schema::writeObject(table, &in)));
}

std::string fabricFile(const FabricOptions& o, const FabricCard& card, const CardFabric& c,
                       const std::optional<LoopFit>& fit, const std::vector<FittedNumber>& numbers) {
  Json provenance{{"card", o.card.filename().string()},      {"name", card.name},          {"source", card.source},
                  {"program", "gambeson " GAMBESON_VERSION}, {"from_the_card", c.derived}, {"assumed", c.assumed}};
  if (fit)
    provenance["raw_loop"] = {{"file", o.loop.filename().string()},
                              {"points", fit->points},
                              {"rms_N", fit->rms_N},
                              {"largest_N", fit->largest_N},
                              {"amplitude_N", fit->amplitude_N}};
  for (const FittedNumber& n : numbers)
    provenance["fitted"][n.name] = {{"file", o.loop.filename().string()},
                                    {"value", n.value / n.per_unit},
                                    {"error", n.error / n.per_unit},
                                    {"unit", n.unit},
                                    {"points", n.points},
                                    {"rms_SI", n.rms}};
  return Json{{"fabric", fabricJson(c.fabric)}, {"provenance", provenance}}.dump(2) + "\n";
}

std::vector<LabTest> testsOf(const FabricOptions& o, const FabricCard& card) {
  return o.tests.empty() ? testsOf(card) : o.tests;
}

std::vector<double> directionsOf(const FabricOptions& o, LabTest test, const FabricCard& card) {
  if (test == LabTest::drape) return {0};  // a disc has all of them
  if (!o.directions_deg.empty()) return o.directions_deg;
  return !fitsLoop(o) || test != LabTest::bending ? directionsOf(test, card) : std::vector<double>{0};
}

Json testJson(const MeasuredTest& test) {
  Json readings = Json::array();
  for (const Reading& r : test.readings) {
    Json one{{"name", r.name}, {"unit", r.unit}, {"measured", r.measured / r.per_unit}, {"measured_SI", r.measured}};
    if (r.card) {
      one["card"] = *r.card / r.per_unit;
      if (r.share)
        one["difference_points"] = 100 * (r.measured - *r.card);
      else if (*r.card != 0)
        one["difference"] = r.measured / *r.card - 1;
    }
    readings.push_back(one);
  }
  Json all{{"test", test.title()},
           {"direction_deg", test.direction_deg},
           {"loop", test.stem() + ".csv"},
           {"picture", test.stem() + ".svg"},
           {"lost_J_per_m2", test.loop.back().lost_J_per_m2},
           {"readings", readings}};
  if (test.drapes) {
    const laboratory::DrapeSeries& series = *test.drapes;
    for (const laboratory::Draped& d : series.starts)
      all["starts"].push_back({{"coefficient", d.coefficient},
                               {"nodes", d.nodes},
                               {"at_rest", d.at_rest},
                               {"unbalanced", d.unbalanced},
                               {"steps", d.steps}});
    all["spread_points"] = 100 * series.spread();
    all["mesh_points"] = 100 * series.mesh();
    all["cells"] = series.cells;
    all["coarser_cells"] = series.coarser_cells;
    all["at_rest"] = series.atRest();
    all["self_crossings"] = series.crossings();
  }
  if (!test.notes.empty()) all["notes"] = test.notes;
  return all;
}

/// A picture that fails takes no numbers with it.
void drawDrape(const FabricCard& card, const MeasuredTest& test, const std::filesystem::path& png, std::ostream& out) {
  try {
    writePng(drapePicture(card, test), png);
  } catch (const RunError& e) {
    out << fmt::format("  The picture {} could not be drawn: {}\n", png.filename().string(), e.what());
  }
}

/// All tests of a fabric; each is said as soon as it is done.
void openLaboratory(const FabricOptions& o, const FabricCard& card, const CardFabric& c,
                    const std::vector<LoopSample>& raw, std::ostream& out) {
  const std::string specimen = specimenText(o.specimen);
  out << specimen << "\n\n";
  Json tests = Json::array();
  for (const LabTest kind : testsOf(o, card))
    for (const double direction : directionsOf(o, kind, card)) {
      const MeasuredTest test = measureTest(kind, direction, card, c, o.specimen);
      out << testTable(test) << '\n';
      out.flush();
      writeOwnFile(o.out / (test.stem() + ".csv"), loopCsv(test));
      writeOwnFile(o.out / (test.stem() + ".svg"), loopPicture(card, test, raw, specimen));
      if (test.drapes) drawDrape(card, test, o.out / (test.stem() + ".png"), out);
      tests.push_back(testJson(test));
    }
  const Json all{{"card", card.name},    {"source", card.source}, {"program", "gambeson " GAMBESON_VERSION},
                 {"specimen", specimen}, {"assumed", c.assumed},  {"tests", tests}};
  writeOwnFile(o.out / "laboratory.json", all.dump(2) + "\n");
  out << fmt::format("The loops, their pictures and laboratory.json are in {}\n", o.out.string());
}

/// Everything that is going to be written, before anything is computed.
void checkOutputs(const FabricOptions& o, const FabricCard& card) {
  Paths inputs;
  if (!isLibraryName(o.card.string())) inputs.push_back(o.card);
  if (!o.loop.empty()) inputs.push_back(o.loop);
  if (!o.fabric.empty()) checkOutput(o.fabric, "--output", inputs);
  if (o.out.empty()) return;
  requireFolder(o.out);
  for (const LabTest test : testsOf(o, card))
    for (const double direction : directionsOf(o, test, card))
      for (const char* ending : {".csv", ".svg", ".png"})
        requireFreeOf(
            o.out /
                (MeasuredTest{.test = test, .direction_deg = direction, .loop = {}, .readings = {}}.stem() + ending),
            inputs, "--out");
  requireFreeOf(o.out / "laboratory.json", inputs, "--out");
  makeFolder(o.out);
}

/// Draping rings have quadratic cells with assumed strains, which laws in closed form have: the others lock in folds.
void checkDrape(const FabricOptions& o, const FabricCard& card, const CardFabric& c) {
  const std::vector<LabTest> tests = testsOf(o, card);
  if (o.out.empty() || std::find(tests.begin(), tests.end(), LabTest::drape) == tests.end()) return;
  if (c.fabric.energy)
    throw InputError({o.card.string(), 0, "tensile.law"},
                     "cannot be draped where it is a curve; allowed for --test: the other tests");
  if (o.specimen.degree != 2)
    throw InputError({"command line", 0, "--degree"},
                     fmt::format("{}: drape is tested with cells of degree 2; allowed: 2, or the other tests by --test",
                                 o.specimen.degree));
}

}  // namespace

int runFabric(const FabricOptions& o, std::ostream& out) {
  FabricCard card = readCard(o.card);
  const std::vector<FittedNumber> numbers = fitMeasurements(o, card);
  CardFabric c;
  std::vector<LoopSample> raw;
  std::optional<LoopFit> fit;
  if (!fitsLoop(o))
    c = fabricOf(card);
  else
    fit = bendByFit(o, card, raw, c);
  checkDrape(o, card, c);
  checkOutputs(o, card);
  useThreads(1);
  out << fabricTable(card, c) << '\n';
  if (!numbers.empty()) out << fittedTable(numbers) << '\n';
  if (fit) out << fitTable(*fit) << '\n';
  if (!o.fabric.empty()) {
    writeOwnFile(o.fabric, fabricFile(o, card, c, fit, numbers));
    out << fmt::format("Fabric: {}\n", o.fabric.string());
  }
  if (!o.out.empty()) openLaboratory(o, card, c, raw, out);
  return 0;
}

}  // namespace gambeson
