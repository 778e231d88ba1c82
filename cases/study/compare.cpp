#include "cases/study/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "cases/study/files.hpp"
#include "core/io/own_file.hpp"

namespace gambeson::study {
namespace {

void findAxes(const Study& s, Comparison& c) {
  // Of the axes that are compared a thickness, else the first; of meshes the finest is judged, and none is a variant.
  const auto role = [&](int a) { return s.axes[static_cast<std::size_t>(a)].role; };
  for (const int a : s.compared)
    if (role(a) != Role::mesh &&
        (c.main_axis < 0 || (role(a) == Role::thickness && role(c.main_axis) != Role::thickness)))
      c.main_axis = a;
  for (std::size_t a = 0; a < s.axes.size(); ++a)
    if (s.axes[a].role == Role::mesh && s.axes[a].levels.size() > 1 && static_cast<int>(a) != c.main_axis)
      c.mesh_axis = static_cast<int>(a);
  if (c.mesh_axis < 0) return;
  int most = -1;
  for (std::size_t i = 0; i < s.variants.size(); ++i)
    if (c.runs[i].good && c.runs[i].control_points > most) {
      most = c.runs[i].control_points;
      c.mesh_level = s.variants[i].levels[static_cast<std::size_t>(c.mesh_axis)];
    }
}

bool onMainMesh(const Comparison& c, const Variant& v) {
  return c.mesh_axis < 0 || c.mesh_level < 0 || v.levels[static_cast<std::size_t>(c.mesh_axis)] == c.mesh_level;
}

/// The joint that decides, and those that have a fifth of the largest torque in one of the runs or are not green.
std::vector<std::string> jointsThatMatter(const Study& s, const Comparison& c, const VariantGroup& g) {
  struct Most {
    std::string name;
    double part = -1, peak_Nm = 0;
  };
  std::vector<Most> all;
  for (const std::size_t i : g.members)
    for (const JointNumbers& j : c.runs[i].joints) {
      if (j.prismatic || !j.applies() || !std::isfinite(j.peak_Nm)) continue;
      auto at = std::find_if(all.begin(), all.end(), [&](const Most& m) { return m.name == j.name; });
      if (at == all.end()) at = all.insert(at, {j.name});
      at->part = std::max(at->part, j.part().value_or(-1));
      at->peak_Nm = std::max(at->peak_Nm, std::abs(j.peak_Nm));
    }
  std::stable_sort(all.begin(), all.end(), [](const Most& a, const Most& b) {
    return a.part != b.part ? a.part > b.part : a.peak_Nm > b.peak_Nm;
  });
  double largest = 0;
  for (const Most& m : all) largest = std::max(largest, m.peak_Nm);
  std::vector<std::string> names;
  for (const Most& m : all)
    if (names.empty() || m.part >= s.limits.green || m.peak_Nm >= 0.2 * largest) names.push_back(m.name);
  return names;
}

void findVariantGroups(const Study& s, Comparison& c) {
  for (std::size_t i = 0; i < s.variants.size(); ++i) {
    const Variant& v = s.variants[i];
    if (!v.grid || !onMainMesh(c, v)) continue;
    const std::string label = settingOf(s, v, {c.main_axis, c.mesh_axis});
    VariantGroup* group = nullptr;
    for (VariantGroup& g : c.groups)
      if (g.label == label) group = &g;
    if (!group) group = &c.groups.emplace_back(VariantGroup{label, {}, -1, {}});
    group->members.push_back(i);
    if (v.baseline == static_cast<int>(i)) group->baseline = v.baseline;
  }
  for (VariantGroup& g : c.groups) g.joints = jointsThatMatter(s, c, g);
}

void findRatios(const Study& s, Comparison& c) {
  for (std::size_t i = 0; i < s.variants.size(); ++i) {
    c.ratios.emplace_back();
    const int b = s.variants[i].baseline;
    const RunNumbers& run = c.runs[i];
    if (b < 0 || !run.good || !c.runs[static_cast<std::size_t>(b)].good) continue;
    const RunNumbers& base = c.runs[static_cast<std::size_t>(b)];
    for (const JointNumbers& j : run.joints) {
      const JointNumbers* of = base.joint(j.name);
      if (!of) continue;
      JointRatio r{j.name, std::abs(j.peak_Nm) / std::abs(of->peak_Nm), j.rms_Nm / of->rms_Nm, {}};
      if (run.time_s.size() == base.time_s.size() && run.time_s == base.time_s && !run.time_s.empty())
        r.likeness =
            compareShifted(run.time_s, of->torque_Nm, j.torque_Nm, 0, base.counted_from_s, run.time_s.back() + 1);
      else
        r.likeness.correlation = r.likeness.relative = std::nan("");
      c.ratios.back().push_back(r);
    }
  }
}

struct Quantity {
  const char* name;
  double (*of)(const JointNumbers&);
};
const Quantity kQuantities[]{{"peak", [](const JointNumbers& j) { return std::abs(j.peak_Nm); }},
                             {"RMS", [](const JointNumbers& j) { return j.rms_Nm; }}};

/// Joints that all of the runs have, with torque in the first; first "", the highest of each run.
std::vector<std::string> jointsOf(const std::vector<const RunNumbers*>& runs) {
  std::vector<std::string> names;
  if (runs.empty() || !runs[0]->highest()) return names;
  names.emplace_back("");
  for (const JointNumbers& j : runs[0]->joints)
    if (!j.prismatic && j.applies() &&
        std::all_of(runs.begin(), runs.end(), [&](const RunNumbers* r) { return r->joint(j.name); }))
      names.push_back(j.name);
  return names;
}

double valueOf(const RunNumbers& run, const std::string& joint, const Quantity& q) {
  const JointNumbers* j = joint.empty() ? run.highest() : run.joint(joint);
  return j ? q.of(*j) : std::nan("");
}

std::string jointLabel(const RunNumbers& run, const std::string& joint) {
  return joint.empty() ? "the highest" : run.joint(joint)->label;
}

/// Finds how torques change along every axis of numbers, all other levels kept. Materials that have names are read as
/// names, not as the number that stands behind each.
void findExponents(const Study& s, Comparison& c) {
  for (std::size_t a = 0; a < s.axes.size(); ++a) {
    const Axis& axis = s.axes[a];
    if (axis.role == Role::mesh || axis.levels.size() < 2 || !axis.levels[0].number) continue;
    if (axis.labelled && axis.role != Role::thickness) continue;
    std::map<std::vector<int>, std::vector<std::size_t>> lines;
    std::vector<std::vector<int>> order;
    for (std::size_t i = 0; i < s.variants.size(); ++i) {
      if (!s.variants[i].grid || !c.runs[i].good) continue;
      std::vector<int> others = s.variants[i].levels;
      others[a] = 0;
      if (!lines.contains(others)) order.push_back(others);
      lines[others].push_back(i);
    }
    for (const auto& key : order) {
      const std::vector<std::size_t>& line = lines[key];
      std::vector<const RunNumbers*> runs;
      std::vector<double> x;
      for (const std::size_t i : line) {
        runs.push_back(&c.runs[i]);
        x.push_back(*axis.levels[static_cast<std::size_t>(s.variants[i].levels[a])].number);
      }
      for (const std::string& joint : jointsOf(runs))
        for (const Quantity& q : kQuantities) {
          std::vector<double> y;
          for (const RunNumbers* r : runs) y.push_back(valueOf(*r, joint, q));
          if (const auto law = fitPowerLaw(x, y))
            c.exponents.push_back({axis.name, settingOf(s, s.variants[line[0]], {static_cast<int>(a)}),
                                   jointLabel(*runs[0], joint), q.name, *law, x, y});
        }
    }
  }
}

/// Finds the elasticities of cases that differ in factors alone, from each factor's smallest and largest value
/// beside 1.
void findElasticities(const Study& s, Comparison& c) {
  std::map<std::string, std::vector<std::size_t>> families;
  std::vector<std::string> order;
  for (std::size_t i = 0; i < s.variants.size(); ++i) {
    if (s.variants[i].rest_identity.empty() || !c.runs[i].good || s.variants[i].part != BarPart::none) continue;
    if (!families.contains(s.variants[i].rest_identity)) order.push_back(s.variants[i].rest_identity);
    families[s.variants[i].rest_identity].push_back(i);
  }
  using F = FactorsCase;
  const std::pair<double F::*, std::optional<double> Elasticities::*> five[]{{&F::bending, &Elasticities::bending},
                                                                             {&F::membrane, &Elasticities::membrane},
                                                                             {&F::weight, &Elasticities::weight},
                                                                             {&F::inertia, &Elasticities::inertia},
                                                                             {&F::drag, &Elasticities::drag}};
  for (const std::string& key : order) {
    const std::vector<std::size_t>& family = families[key];
    const auto factors = [&](std::size_t i) { return std::get<Case>(s.variants[i].definition).factors; };
    /// The variants in which `factor` alone may differ from 1, by its value.
    const auto along = [&](double F::*factor) {
      std::map<double, std::size_t> line;
      for (const std::size_t i : family) {
        F f = factors(i);
        const double value = f.*factor;
        f.*factor = 1;
        if (f == F{}) line.emplace(value, i);
      }
      return line;
    };
    std::vector<const RunNumbers*> runs;
    for (const std::size_t i : family) runs.push_back(&c.runs[i]);
    bool any = false;
    for (const auto& [factor, e] : five) any = any || along(factor).size() > 1;
    if (!any) continue;
    const std::map<double, std::size_t> thick = along(&F::thickness);
    const auto base = thick.find(1);
    const Variant& at = s.variants[base != thick.end() ? base->second : family[0]];
    std::vector<int> factor_axes;
    for (std::size_t a = 0; a < s.axes.size(); ++a)
      for (const Setting& set : s.axes[a].levels[0].set)
        if (set.path.starts_with("factors")) factor_axes.push_back(static_cast<int>(a));
    for (const std::string& joint : jointsOf(runs))
      for (const Quantity& q : kQuantities) {
        ElasticityRow row{settingOf(s, at, factor_axes), jointLabel(*runs[0], joint), q.name, {}, {}};
        for (const auto& [factor, e] : five) {
          const auto line = along(factor);
          if (line.size() < 2) continue;
          const auto &low = *line.begin(), &high = *line.rbegin();
          row.e.*e = elasticity(low.first, high.first, valueOf(c.runs[low.second], joint, q),
                                valueOf(c.runs[high.second], joint, q));
        }
        std::vector<double> x, y;
        for (const auto& [value, i] : thick) {
          x.push_back(value);
          y.push_back(valueOf(c.runs[i], joint, q));
        }
        if (const auto law = fitPowerLaw(x, y)) row.measured = law->exponent;
        c.elasticities.push_back(std::move(row));
      }
  }
}

/// The run of a variant's case on the finest mesh: of the mesh's axis, or of a variant that is said to be finer.
const Variant* finestOf(const Study& s, const Comparison& c, const Variant& v) {
  for (const Variant& w : s.variants)
    if (w.finer && w.levels == v.levels && c.runs[static_cast<std::size_t>(&w - s.variants.data())].good) return &w;
  if (onMainMesh(c, v)) return nullptr;
  std::vector<int> levels = v.levels;
  levels[static_cast<std::size_t>(c.mesh_axis)] = c.mesh_level;
  for (const Variant& w : s.variants)
    if (w.grid && w.levels == levels) return &w;
  return nullptr;
}

void compareMeshes(const Study& s, Comparison& c) {
  constexpr double settled_s = 0.2;  // Zheng 2013, fig. 6.11: the courses agree but for the start
  std::map<int, double> largest;     // of each level
  const auto weight = [](const JointNumbers& j) { return j.natural_Nm && *j.natural_Nm > 0 ? 1 / *j.natural_Nm : 1; };
  for (std::size_t i = 0; i < s.variants.size(); ++i) {
    const Variant& v = s.variants[i];
    const Variant* w = v.grid ? finestOf(s, c, v) : nullptr;
    if (!w) continue;
    const RunNumbers &coarse = c.runs[i], &fine = c.runs[static_cast<std::size_t>(w - s.variants.data())];
    if (!coarse.good || !fine.good || !fine.decisive()) continue;
    const JointNumbers& f = *fine.decisive();
    const JointNumbers* of = coarse.joint(f.name);
    if (!of) continue;
    MeshRow row;
    row.setting = settingOf(s, v, {c.mesh_axis});
    row.joint = f.label;
    row.coarse = i;
    if (c.main_axis >= 0) row.level = v.levels[static_cast<std::size_t>(c.main_axis)];
    row.coarse_points = coarse.control_points;
    row.fine_points = fine.control_points;
    row.coarse_Nm = of->peak_Nm;
    row.fine_Nm = f.peak_Nm;
    row.difference = std::abs(of->peak_Nm) / std::abs(f.peak_Nm) - 1;
    const Likeness like = compareShifted(fine.time_s, f.torque_Nm, of->torque_Nm, 0, settled_s, 1e300);
    row.course = coarse.time_s == fine.time_s ? like.rms_difference / std::abs(f.peak_Nm) : std::nan("");
    // Pages show the coarse run where the fine one is a further variant, else the fine one.
    const About about = w->finer ? About::coarse : About::fine;
    const double shown = std::abs(about == About::coarse ? of->peak_Nm : f.peak_Nm);
    row.bar = meshPart(coarse, fine, f.name, about).value_or(std::nan(""));
    row.error = weight(f) * row.bar * shown;
    largest[row.level] = std::max(largest[row.level], weight(f) * shown);
    c.meshes.push_back(row);
  }
  // What a motion that costs next to nothing is off by decides nothing.
  for (MeshRow& m : c.meshes) m.error /= largest[m.level];
}

/// The joint that decides for what is taken comes first in its motion.
void decideFirst(Comparison& c) {
  if (c.verdict.take < 0) return;
  for (VariantGroup& g : c.groups) {
    const Option::Cost* worst = worstCost(c.input.options[static_cast<std::size_t>(c.verdict.take)], &g.label);
    const auto decides = [&](const std::string& name) {
      return std::any_of(g.members.begin(), g.members.end(), [&](std::size_t i) {
        const JointNumbers* j = c.runs[i].joint(name);
        return j && j->label == worst->joint;
      });
    };
    if (worst) std::stable_partition(g.joints.begin(), g.joints.end(), decides);
  }
}

}  // namespace

std::string settingOf(const Study& s, const Variant& v, const std::vector<int>& without) {
  std::string label;
  for (std::size_t a = 0; a < s.axes.size(); ++a) {
    if (std::find(without.begin(), without.end(), static_cast<int>(a)) != without.end()) continue;
    const Axis& axis = s.axes[a];
    if (axis.levels.size() < 2) continue;
    const Level& level = axis.levels[static_cast<std::size_t>(v.levels[a])];
    label += (label.empty() ? "" : ", ") + level.name;
  }
  return label;
}

const JointRatio* ratioOf(const Comparison& c, std::size_t i, const std::string& joint) {
  for (const JointRatio& r : c.ratios[i])
    if (r.joint == joint) return &r;
  return nullptr;
}

bool isBaseline(const Study& s, std::size_t i) { return s.variants[i].baseline == static_cast<int>(i); }

std::string memberName(const Study& s, const Comparison& c, std::size_t i) {
  if (c.main_axis < 0) return s.variants[i].label;
  const auto a = static_cast<std::size_t>(c.main_axis);
  return s.axes[a].levels[static_cast<std::size_t>(s.variants[i].levels[a])].name;
}

std::size_t memberOrder(const Study& s, const Comparison& c, std::size_t i) {
  std::size_t place = i, base = static_cast<std::size_t>(std::max(0, s.variants[i].baseline));
  if (c.main_axis >= 0) {
    const auto a = static_cast<std::size_t>(c.main_axis);
    place = static_cast<std::size_t>(s.variants[i].levels[a]);
    for (std::size_t k = 0; k < s.compared.size(); ++k)
      if (s.compared[k] == c.main_axis) base = static_cast<std::size_t>(s.baseline[k]);
  }
  return place == base ? 0 : place < base ? place + 1 : place;
}

std::optional<double> peakAboveStanding(const RunNumbers& run, const JointNumbers& j) {
  if (!j.standing_Nm) return {};
  double most = 0;
  for (std::size_t i = 0; i < run.time_s.size(); ++i)
    if (run.time_s[i] >= run.counted_from_s) most = std::max(most, std::abs(j.torque_Nm[i] - *j.standing_Nm));
  return most;
}

Comparison compare(const Study& s, std::vector<RunNumbers> runs) {
  Comparison c;
  c.runs = std::move(runs);
  for (const RunNumbers& r : c.runs) {
    const JointNumbers* j = r.good ? r.decisive() : nullptr;
    c.lights.push_back(shownLight(lightOf(j ? j->part() : std::nullopt, s.limits.green, s.limits.red), r.trust()));
  }
  findAxes(s, c);
  findVariantGroups(s, c);
  findRatios(s, c);
  findExponents(s, c);
  findElasticities(s, c);
  compareMeshes(s, c);
  findBudgets(s, c);
  if (s.population) c.population = answerOf(s, c.runs);
  c.input = verdictInput(s, c);
  c.verdict = verdictOf(c.input);
  decideFirst(c);
  return c;
}

std::vector<std::string> switchedOff(const Case& c) {
  std::vector<std::string> off;
  if (!c.contact.self) off.emplace_back("contact of cloth with cloth");
  if (c.contact.friction == FrictionLaw{}) off.emplace_back("friction");
  if (c.air.drag_kg_per_m2s == 0) off.emplace_back("air drag");
  if (norm(c.gravity_m_per_s2) == 0) off.emplace_back("weight");
  if (!c.strain_limit) off.emplace_back("limits of strain");
  if (c.human && c.dressing.settle_s == 0) off.emplace_back("settling before the motion");
  if (c.human && c.analysis.task == Task::none) off.emplace_back("comparison with natural moments");
  return off;
}

void compareVariants(const Study& s, std::vector<Outcome>& outcomes, const std::filesystem::path& out) {
  std::vector<RunNumbers> runs;
  for (std::size_t i = 0; i < s.variants.size(); ++i) {
    RunNumbers run;
    if (outcomes[i].good)
      run = readRun(out / s.variants[i].folder);
    else
      run.why = outcomes[i].why;
    if (!run.good) outcomes[i] = {false, run.why};
    runs.push_back(std::move(run));
  }
  const Comparison c = compare(s, std::move(runs));
  std::vector<std::string> failures;
  const std::vector<SidePicture> pictures = takeSidePictures(s, c, out, failures);
  const std::vector<ViewerRun> views = takeViews(s, c, out, failures);
  writeStudyTables(s, c, out);
  writeOwnFile(out / files::report, studyPage(s, c, pictures, failures, views));
}

}  // namespace gambeson::study
