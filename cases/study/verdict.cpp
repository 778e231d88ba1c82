/// Detail of compare.hpp: what the verdict is made of, from the runs.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "cases/cloth/fabric.hpp"
#include "cases/study/compare.hpp"
#include "cases/wear/recording/zone_ledger.hpp"
#include "cases/wear/results/check_words.hpp"
#include "cases/wear/results/write.hpp"

namespace gambeson::study {
namespace {

/// What one run adds to its option.
void addRun(const Comparison& c, const VariantGroup& g, std::size_t i, Option& option) {
  const RunNumbers& run = c.runs[i];
  if (option.garments.empty())
    for (const GarmentNumbers& l : run.garments) option.garments.push_back({l.name, l.thickness_m});
  for (const std::string& name : g.joints) {
    const JointNumbers* j = run.joint(name);
    if (!j) continue;
    Option::Cost cost{g.label, j->label, std::abs(j->peak_Nm), j->part(), {}, j->lever_m};
    if (j->peak_Nm != 0 && !j->torque_Nm.empty()) cost.end_part = std::abs(j->torque_Nm.back() / j->peak_Nm);
    for (const JointRatio& r : c.ratios[i])
      if (r.joint == name && std::isfinite(r.peak)) cost.ratio = r.peak;
    option.costs.push_back(cost);
  }
  if (const ComfortNumbers* k = run.leastComfortable())
    option.comforts.push_back({g.label, spokenZone(k->zone), lightNamed(k->light), k->mean_Pa, k->red_Pa, k->peak_Pa,
                               k->peak_limit_Pa, k->peak_time_s, k->peak_during});
}

/// Adds the exponents of all joints and motions that the options cost.
void addExponents(const Study& s, const Comparison& c, VerdictInput& in) {
  const auto find = [&](const VariantGroup& g, const std::string& joint, const char* quantity) -> const AxisExponent* {
    const std::string setting = settingOf(s, s.variants[g.members[0]], {c.main_axis});
    for (const AxisExponent& e : c.exponents)
      if (e.axis == in.what && e.setting == setting && e.joint == joint && e.quantity == quantity) return &e;
    return nullptr;
  };
  for (const VariantGroup& g : c.groups)
    for (const std::string& name : g.joints) {
      std::string label;
      for (const std::size_t i : g.members)
        if (const JointNumbers* j = c.runs[i].joint(name)) label = j->label;
      const AxisExponent *peak = find(g, label, "peak"), *rms = find(g, label, "RMS");
      if (peak && rms) in.exponents.push_back({g.label, label, peak->law, rms->law});
    }
}

/// Of each variant the option that its run belongs to; -1: none.
using OptionOf = std::vector<int>;

void addRun(const Study& s, const OptionOf& option, std::size_t i, WrongRuns& runs) {
  runs.names.push_back(s.variants[i].label);
  runs.options.push_back(option[i]);
}

void addDoubts(const Study& s, const Comparison& c, const OptionOf& option, VerdictInput& in) {
  struct Worst {
    CheckNumbers check;
    std::string beside;
    WrongRuns runs;
  };
  std::vector<Worst> all;
  for (std::size_t i = 0; i < c.runs.size(); ++i) {
    const RunNumbers& r = c.runs[i];
    if (!r.good) continue;
    ++in.checked_runs;
    in.failing_runs += r.failing() > 0;
    for (const CheckNumbers& k : r.checks) {
      if (k.holds) continue;
      auto at = std::find_if(all.begin(), all.end(), [&](const Worst& w) { return w.check.name == k.name; });
      if (at == all.end()) at = all.insert(at, {k, r.heldAgainst(k.name), {}});
      if (!(k.value <= at->check.value)) at->check.value = k.value, at->beside = r.heldAgainst(k.name);
      addRun(s, option, i, at->runs);
    }
  }
  for (const Worst& w : all) {
    const CheckWords words = checkWords(w.check.name, w.check.value, w.check.limit, w.check.unit);
    in.doubts.push_back({words.wrong + w.beside, words.order, w.check.name, w.runs});
  }
}

/// The worst of all runs that are good.
void addStretch(const Study& s, const Comparison& c, const OptionOf& option, VerdictInput& in) {
  std::vector<Stretch> all;
  for (std::size_t i = 0; i < c.runs.size(); ++i) {
    if (!c.runs[i].good) continue;
    all.insert(all.end(), c.runs[i].stretch.begin(), c.runs[i].stretch.end());
    if (c.runs[i].trust().stretched > 0) addRun(s, option, i, in.stretched);
  }
  in.law_strain = kStrainOfLaw;
  if (const Stretch* worst = worstOf(all)) in.stretch = *worst;
}

/// What the groups differ in.
Role settingRole(const Study& s, const Comparison& c) {
  std::vector<Role> roles;
  for (std::size_t a = 0; a < s.axes.size(); ++a)
    if (static_cast<int>(a) != c.main_axis && static_cast<int>(a) != c.mesh_axis && s.axes[a].levels.size() > 1)
      roles.push_back(s.axes[a].role);
  return roles.size() == 1 ? roles[0] : Role::other;
}

void addMeshError(const Comparison& c, VerdictInput& in) {
  std::vector<std::string> where;
  for (const MeshRow& m : c.meshes) {
    if (!std::isfinite(m.error)) continue;
    in.mesh_error = std::max(in.mesh_error.value_or(0), m.error);
    where.push_back(m.setting);
  }
  in.mesh_where = where.size() == 1 ? where[0] : where.empty() ? "" : fmt::format("{} pairs of runs", where.size());
}

/// The joint of whose peak the verdict tells the error bar: one, for the mesh and for the others.
const JointNumbers* toldBy(const Comparison& c, const Budget& b) {
  const RunNumbers& run = c.runs[b.reference];
  for (const MeshRow& m : c.meshes)
    if (m.coarse == b.reference)
      for (const JointNumbers& j : run.joints)
        if (j.label == m.joint) return &j;
  return run.decisive();
}

/// Of the joints that decide in the settings whose bars are known; what a motion that costs next to nothing is off by
/// decides nothing.
void addOtherErrors(const Comparison& c, VerdictInput& in) {
  const auto costOf = [&](const Budget& b, double torque_Nm) {
    const JointNumbers* j = toldBy(c, b);
    return j && j->natural_Nm && *j->natural_Nm > 0 ? torque_Nm / *j->natural_Nm : torque_Nm;
  };
  double largest = 0;
  for (const bool scaled : {false, true})
    for (const Budget& b : c.budgets)
      for (const BarredNumber& n : b.numbers) {
        const JointNumbers* j = toldBy(c, b);
        if (!j || n.what.of != j->name || n.what.quantity != Headline::Quantity::peak) continue;
        if (!scaled) {
          largest = std::max(largest, costOf(b, n.value));
          continue;
        }
        const auto take = [&](const std::optional<double>& part, std::optional<double>& error) {
          if (part) error = std::max(error.value_or(0), costOf(b, *part) / largest);
        };
        take(n.bar.step, in.step_error);
        take(n.bar.fabric, in.fabric_error);
      }
}

}  // namespace

VerdictInput verdictInput(const Study& s, const Comparison& c) {
  VerdictInput in;
  const Axis* axis = c.main_axis >= 0 ? &s.axes[static_cast<std::size_t>(c.main_axis)] : nullptr;
  in.what = axis ? axis->name : "variant";
  in.role = axis ? axis->role : Role::other;
  in.setting = settingRole(s, c);
  in.multiple = axis && axis->multiple;
  in.sized = axis && axis->role == Role::thickness && axis->levels[0].number;
  in.green = s.limits.green;
  in.red = s.limits.red;
  std::vector<std::size_t> order(axis ? axis->levels.size() : s.variants.size());
  for (std::size_t l = 0; l < order.size(); ++l) order[l] = l;
  if (in.sized)
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return *axis->levels[a].number < *axis->levels[b].number; });
  OptionOf option_of(s.variants.size(), -1);
  for (const std::size_t l : order) {
    Option option;
    bool any = false;
    const auto belongs = [&](std::size_t i) {
      const Variant& v = s.variants[i];
      return axis ? v.levels[static_cast<std::size_t>(c.main_axis)] == static_cast<int>(l) : i == l;
    };
    for (const VariantGroup& g : c.groups)
      for (const std::size_t i : g.members) {
        const Variant& v = s.variants[i];
        if (!belongs(i)) continue;
        any = true;
        option.name = memberName(s, c, i);
        if (in.sized) option.size = axis->levels[l].number;
        if (v.baseline == static_cast<int>(i)) in.baseline = static_cast<int>(in.options.size());
        if (const auto* k = std::get_if<Case>(&v.definition); k && !(in.sensor_m > 0))
          in.sensor_m = k->comfort.sensor_m;
        if (c.runs[i].good && c.runs[i].decisive())
          addRun(c, g, i, option);
        else if (c.runs[i].good && !c.runs[i].joints.empty())
          option.untouched = true;
        else
          option.missing = true;
      }
    if (!any) continue;
    // On every mesh.
    for (std::size_t i = 0; i < s.variants.size(); ++i) {
      if (!(s.variants[i].grid || s.variants[i].finer) || !belongs(i)) continue;
      option_of[i] = static_cast<int>(in.options.size());
      if (c.runs[i].good) option.trust.add(c.runs[i].trust());
    }
    in.options.push_back(std::move(option));
  }
  addMeshError(c, in);
  addOtherErrors(c, in);
  if (in.sized) addExponents(s, c, in);
  addDoubts(s, c, option_of, in);
  addStretch(s, c, option_of, in);
  return in;
}

}  // namespace gambeson::study
