#include "cases/fabric/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ostream>

#include "cases/cloth/fabric_input.hpp"
#include "cases/cloth/fields.hpp"
#include "cases/fabric/raw_loop.hpp"
#include "cases/fabric/results.hpp"
#include "cases/runs/results_folder.hpp"
#include "core/error.hpp"
#include "core/io/own_file.hpp"

namespace gambeson {
namespace {

using Json = nlohmann::ordered_json;
constexpr double kDegree = 0.017453292519943295;

/// The steps of the instruments: a tenth of a unit of curvature, an eighth of a degree.
laboratory::Course bendingCourse(double width_at_per_m) {
  return {{kKesCurvature_per_m, -kKesCurvature_per_m, kKesCurvature_per_m},
          5,
          {-width_at_per_m, width_at_per_m, -kKesFrom_per_m, kKesFrom_per_m, -kKesTo_per_m, kKesTo_per_m}};
}
laboratory::Course shearCourse() { return {{8 * kDegree, -8 * kDegree, 8 * kDegree}, 0.25 * kDegree, {}}; }

/// What a raw loop makes of the bending of a card's fabric: its stops, the same about all axes.
LoopFit bendByFit(const FabricOptions& o, const FabricCard& card, std::vector<LoopSample>& raw, CardFabric& c) {
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
                       const std::optional<LoopFit>& fit) {
  Json provenance{{"card", o.card.filename().string()},      {"name", card.name},          {"source", card.source},
                  {"program", "gambeson " GAMBESON_VERSION}, {"from_the_card", c.derived}, {"assumed", c.assumed}};
  if (fit)
    provenance["raw_loop"] = {{"file", o.loop.filename().string()},
                              {"points", fit->points},
                              {"rms_N", fit->rms_N},
                              {"largest_N", fit->largest_N},
                              {"amplitude_N", fit->amplitude_N}};
  return Json{{"fabric", fabricJson(c.fabric)}, {"provenance", provenance}}.dump(2) + "\n";
}

std::vector<double> directionsOf(const FabricOptions& o, const FabricCard& card) {
  if (!o.directions_deg.empty()) return o.directions_deg;
  const bool apart = card.bending.rigidity.apart() || card.bending.hysteresis.apart();
  return apart && o.loop.empty() ? std::vector<double>{0, 90} : std::vector<double>{0};
}

KesTest measure(const FabricOptions& o, const FabricCard& card, const Fabric& fabric, bool bending, double direction) {
  KesTest test{bending, direction, {}, {}};
  laboratory::Specimen specimen = o.specimen;
  specimen.direction_rad = direction * kDegree;
  if (bending) {
    const double at = card.bending.hysteresis_at_per_m.value_or(kKesWidthAt_per_m);
    test.loop = laboratory::bend(fabric, specimen, bendingCourse(at));
    test.readings = bendingReadings(card, test, at);
  } else {
    test.loop = laboratory::shear(fabric, specimen, shearCourse());
    test.readings = shearReadings(card, test);
  }
  return test;
}

Json testJson(const KesTest& test) {
  Json readings = Json::array();
  for (const Reading& r : test.readings) {
    Json one{{"name", r.name}, {"unit", r.unit}, {"measured", r.measured / r.per_unit}, {"measured_SI", r.measured}};
    if (r.card) {
      one["card"] = *r.card / r.per_unit;
      one["difference"] = r.measured / *r.card - 1;
    }
    readings.push_back(one);
  }
  return {{"test", test.title()},
          {"direction_deg", test.direction_deg},
          {"loop", test.stem() + ".csv"},
          {"picture", test.stem() + ".svg"},
          {"lost_J_per_m2", test.loop.back().lost_J_per_m2},
          {"readings", readings}};
}

/// All tests of a fabric; each is said as soon as it is done.
void openLaboratory(const FabricOptions& o, const FabricCard& card, const CardFabric& c,
                    const std::vector<LoopSample>& raw, std::ostream& out) {
  const std::vector<double> directions = directionsOf(o, card);
  const std::string specimen = specimenText(o.specimen);
  out << specimen << "\n\n";
  Json tests = Json::array();
  for (const bool bending : {true, false})
    for (const double direction : directions) {
      if (!(bending ? o.bending : o.shear && (o.chosen || card.shear))) continue;
      const KesTest test = measure(o, card, c.fabric, bending, direction);
      out << testTable(test) << '\n';
      out.flush();
      writeOwnFile(o.out / (test.stem() + ".csv"), loopCsv(test));
      writeOwnFile(o.out / (test.stem() + ".svg"), loopPicture(card, test, raw, specimen));
      tests.push_back(testJson(test));
    }
  const Json all{{"card", card.name},    {"source", card.source}, {"program", "gambeson " GAMBESON_VERSION},
                 {"specimen", specimen}, {"assumed", c.assumed},  {"tests", tests}};
  writeOwnFile(o.out / "laboratory.json", all.dump(2) + "\n");
  out << fmt::format("The loops, their pictures and laboratory.json are in {}\n", o.out.string());
}

/// Everything that is going to be written, before anything is computed.
void checkOutputs(const FabricOptions& o, const FabricCard& card) {
  Paths inputs{o.card};
  if (!o.loop.empty()) inputs.push_back(o.loop);
  if (!o.fabric.empty()) checkOutput(o.fabric, "--output", inputs);
  if (o.out.empty()) return;
  requireFolder(o.out);
  for (const double direction : directionsOf(o, card))
    for (const bool bending : {true, false})
      for (const char* ending : {".csv", ".svg"})
        requireFreeOf(o.out / (KesTest{bending, direction, {}, {}}.stem() + ending), inputs, "--out");
  requireFreeOf(o.out / "laboratory.json", inputs, "--out");
  makeFolder(o.out);
}

}  // namespace

int runFabric(const FabricOptions& o, std::ostream& out) {
  const FabricCard card = readCard(o.card);
  CardFabric c;
  std::vector<LoopSample> raw;
  std::optional<LoopFit> fit;
  if (o.loop.empty())
    c = fabricOf(card);
  else
    fit = bendByFit(o, card, raw, c);
  checkOutputs(o, card);
  useThreads(1);
  out << fabricTable(card, c) << '\n';
  if (fit) out << fitTable(*fit) << '\n';
  if (!o.fabric.empty()) {
    writeOwnFile(o.fabric, fabricFile(o, card, c, fit));
    out << fmt::format("Fabric: {}\n", o.fabric.string());
  }
  if (!o.out.empty()) openLaboratory(o, card, c, raw, out);
  return 0;
}

}  // namespace gambeson
