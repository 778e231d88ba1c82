#include "cases/study/map_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <ostream>

#include "cases/input/table.hpp"
#include "cases/study/files.hpp"
#include "cases/study/make_variant.hpp"
#include "cases/study/numbers.hpp"
#include "cases/study/run_variants.hpp"
#include "cases/wear/results/measure.hpp"
#include "cases/wear/scene/scenario.hpp"
#include "core/error.hpp"

namespace gambeson::study {
namespace {

/// A map that cannot be run counts as this many times the torque of the start.
constexpr double kFailed = 10;

/// The joint of the largest added torque among those that count.
const JointNumbers* worstJoint(const Optimise& o, const RunNumbers& run) {
  const JointNumbers* worst = nullptr;
  for (const JointNumbers& j : run.joints) {
    if (j.prismatic || !j.applies()) continue;
    if (!o.joints.empty() && std::ranges::find(o.joints, j.name) == o.joints.end()) continue;
    if (!worst || std::abs(j.peak_Nm) > std::abs(worst->peak_Nm)) worst = &j;
  }
  return worst;
}

/// How much the mass of the built garments grows with the factor of each region, and the mass of all. What is built has
/// a mass linear in the factors, whatever cloth it is of.
struct Masses {
  std::vector<double> of_regions_kg;
  double all_kg = 0;
};

double massOf(const Case& c) {
  double sum = 0;
  for (const GarmentMeasure& g : garmentMeasuresOf(*buildScenario(c))) sum += g.mass_kg;
  return sum;
}

Masses massesOf(const Optimise& o, const Case& c) {
  Masses m;
  m.all_kg = massOf(c);
  for (const MapRegion* r : o.free()) {
    Case more = c;
    more.garments[r->garment].regions[r->region].thickness += 1;
    m.of_regions_kg.push_back(massOf(more) - m.all_kg);
  }
  return m;
}

class MapRuns {
 public:
  MapRuns(Study& s, const Options& o, const Signals& signals, int lock, std::ostream& out)
      : study_(s), o_(o), signals_(signals), lock_(lock), out_(out), optimise_(*s.optimise) {}

  std::vector<Outcome> run() {
    const MapProblem problem = pose(study_.variants[0]);
    FoundMap& found = optimise_.found;
    found.mass_kg = problem.mass_kg;
    const std::vector<TriedMap> tried = searchMap(problem, [&](const std::vector<double>& map) {
      found.runs.push_back(runAll({mapVariant(study_, map, {}, "")}, {map})[0]);
      const MapRun& r = found.runs.back();
      out_ << fmt::format("map {} of {} at most: {}\n", found.runs.size(), optimise_.runs,
                          r.why.empty() ? fmt::format("{:.4g} Nm, {:.4g} kg", r.torque_Nm, r.mass_kg) : r.why)
           << std::flush;
      if (found.runs.size() == 1 && !r.why.empty())
        throw RunError(fmt::format("the map that the search starts from cannot be run: {}", r.why));
      return r.why.empty() ? r.torque_Nm : kFailed * found.runs[0].torque_Nm;
    });
    found.best = bestOf(problem, tried);
    for (std::size_t i = 0; i < optimise_.repeats.size(); ++i)
      found.repeats.push_back(runPair(optimise_.repeats[i].second, repeatName(i), optimise_.repeats[i].first,
                                      found.start().map, found.found().map));
    if (!optimise_.finer.empty()) {
      // Drafted finer, regions have other masses by a hair: both maps are put right again.
      const MapProblem fine = pose(mapVariant(study_, found.start().map, optimise_.finer, kFiner));
      std::vector<double> best = found.found().map;
      if (optimise_.aim == Aim::torque) best = mapOfMass(fine, best, fine.massOf(fine.start));
      for (double& factor : best) factor = roundedFactor(factor);
      found.finer = runPair(optimise_.finer, kFiner, "a finer mesh", fine.start, best);
    }
    return present();
  }

 private:
  /// The problem on the mesh of a variant: what the search starts from has the mass that is given.
  MapProblem pose(const Variant& v) {
    const Case& c = std::get<Case>(v.definition);
    const Masses masses = massesOf(optimise_, c);
    MapProblem p{optimise_.aim,        {},
                 masses.of_regions_kg, optimise_.least,
                 optimise_.most,       optimise_.step,
                 optimise_.limit_Nm,   static_cast<std::size_t>(optimise_.runs)};
    for (const MapRegion* r : optimise_.free()) p.start.push_back(r->factor);
    if (!optimise_.mass_kg) return p;
    const double free_kg = p.massOf(p.start), wanted_kg = *optimise_.mass_kg - (masses.all_kg - free_kg);
    const std::vector<double> thin(p.start.size(), p.least), thick(p.start.size(), p.most);
    for (double& factor : p.start) factor = roundedFactor(factor * wanted_kg / free_kg);
    if (std::ranges::any_of(p.start, [&](double f) { return !(f >= p.least && f <= p.most); }))
      throw InputError({study_.file.string(), optimise_.line, "optimise.mass"},
                       fmt::format("{:g} kg cannot be reached by one factor within between; allowed: {:.4g} to {:.4g}",
                                   *optimise_.mass_kg, masses.all_kg + p.massOf(thin) - free_kg,
                                   masses.all_kg + p.massOf(thick) - free_kg));
    return p;
  }

  MapPair runPair(const std::vector<Setting>& more, const std::string& suffix, const std::string& what,
                  const std::vector<double>& start, const std::vector<double>& best) {
    std::vector<Variant> variants{mapVariant(study_, start, more, suffix)};
    std::vector<std::vector<double>> maps{start};
    if (best != start) {
      variants.push_back(mapVariant(study_, best, more, suffix));
      maps.push_back(best);
    }
    const std::vector<MapRun> runs = runAll(std::move(variants), maps);
    return {what, runs.front(), runs.back()};
  }

  /// Runs what is not done yet.
  std::vector<MapRun> runAll(std::vector<Variant> variants, const std::vector<std::vector<double>>& maps) {
    Study part;
    part.name = study_.name;
    part.file = study_.file;
    part.variants = std::move(variants);
    const std::vector<Stand> stands = standsOf(part, o_);
    std::vector<Outcome> outcomes(part.variants.size());
    if (o_.compare) {
      for (std::size_t i = 0; i < stands.size(); ++i)
        if (stands[i] != Stand::done)
          throw RunError(fmt::format("the run {} is not done: the search goes on from there with --resume",
                                     part.variants[i].folder));
        else
          outcomes[i].good = true;
    } else {
      checkFolder(part, o_, stands);
      outcomes = runVariants(part, o_, stands, signals_, lock_, out_);
    }
    std::vector<MapRun> runs;
    for (std::size_t i = 0; i < part.variants.size(); ++i) {
      runs.push_back(numbersOf(part.variants[i].folder, maps[i], outcomes[i]));
      ran_.push_back(std::move(part.variants[i]));
    }
    return runs;
  }

  MapRun numbersOf(const std::string& folder, const std::vector<double>& map, const Outcome& outcome) const {
    MapRun r{folder, map, std::numeric_limits<double>::infinity(), "", 0, 0, outcome.why};
    if (!outcome.good) return r;
    const RunNumbers numbers = readRun(o_.out / folder);
    const JointNumbers* j = numbers.good ? worstJoint(optimise_, numbers) : nullptr;
    if (!numbers.good) r.why = numbers.why;
    if (numbers.good && !j) r.why = "no joint has an added torque";
    if (!j) return r;
    r.torque_Nm = std::abs(j->peak_Nm);
    r.joint = j->label;
    r.mass_kg = numbers.mass_kg();
    r.failing = numbers.failing();
    return r;
  }

  /// The variants that the page compares: start and best, here and on the finer mesh.
  std::vector<Outcome> present() {
    const FoundMap& found = optimise_.found;
    study_.variants.clear();
    std::vector<Outcome> outcomes;
    const auto add = [&](const MapRun& r, int level, bool finer) {
      const auto at = std::ranges::find(ran_, r.folder, &Variant::folder);
      Variant v = *at;
      v.levels = {level};
      v.grid = !finer;
      v.finer = finer;
      v.label = study_.axes[0].levels[static_cast<std::size_t>(level)].name + (finer ? ", finer mesh" : "");
      v.baseline = 0;
      study_.variants.push_back(std::move(v));
      outcomes.push_back({r.why.empty(), r.why});
    };
    const bool better = found.best > 0;
    study_.axes = {mapAxis(better)};
    study_.compared = {0};
    study_.baseline = {0};
    add(found.start(), 0, false);
    if (better) add(found.found(), 1, false);
    if (found.finer) {
      add(found.finer->start, 0, true);
      if (better) add(found.finer->best, 1, true);
    }
    return outcomes;
  }

  Axis mapAxis(bool better) const {
    const std::vector<double>& start = optimise_.found.start().map;
    const bool uniform =
        std::ranges::all_of(start, [&](double f) { return f == start[0]; }) &&
        std::ranges::all_of(optimise_.regions, [&](const MapRegion& r) { return !r.kept || r.factor == start[0]; });
    Axis axis;
    axis.name = "thickness map";
    axis.role = Role::other;
    axis.labelled = true;
    const std::string first = uniform ? "uniform thickness" : "thickness of the case";
    axis.levels.push_back({first, first, "uniform", {}, {}});
    if (better) axis.levels.push_back({"optimised map", "optimised map", "optimised", {}, {}});
    return axis;
  }

  Study& study_;
  const Options& o_;
  const Signals& signals_;
  int lock_;
  std::ostream& out_;
  Optimise& optimise_;
  std::vector<Variant> ran_;
};

}  // namespace

std::string repeatName(std::size_t repeat) { return fmt::format("repeat{}", repeat + 1); }

Variant mapVariant(const Study& s, const std::vector<double>& map, const std::vector<Setting>& more,
                   const std::string& suffix) {
  const Optimise& o = *s.optimise;
  Variant v;
  v.grid = true;
  std::vector<Setting> all = o.common;
  const std::vector<const MapRegion*> free = o.free();
  for (std::size_t i = 0; i < free.size(); ++i) {
    const double factor = roundedFactor(map[i]);
    all.push_back({free[i]->path, schema::nodeOf(factor)});
    all.back().value.line = o.line;
    v.label += fmt::format("{}{:g}", v.label.empty() ? "map " : " ", factor);
    v.folder += fmt::format("_{}", factor);
  }
  v.folder = "map" + v.folder;
  all.insert(all.end(), more.begin(), more.end());
  if (!suffix.empty()) {
    v.folder += "_" + suffix;
    v.label += ", " + suffix;
  }
  JsonNode root = o.base;
  defineVariant(s, root, o.case_file, all, v);
  return v;
}

std::vector<Outcome> runOptimisation(Study& study, const Options& options, const Signals& signals, int lock,
                                     std::ostream& out) {
  return MapRuns(study, options, signals, lock, out).run();
}

}  // namespace gambeson::study
