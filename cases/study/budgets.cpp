/// Detail of compare.hpp: error bars of the numbers that a study's page shows.

#include <algorithm>
#include <cmath>

#include "cases/study/compare.hpp"
#include "cases/wear/recording/zone_ledger.hpp"

namespace gambeson::study {
namespace {

/// What pages show of a variant's run: the joints that matter in its group, and the zone that is least comfortable.
std::vector<Headline> headlinesOf(const Comparison& c, std::size_t variant) {
  using Q = Headline::Quantity;
  std::vector<Headline> all;
  const RunNumbers& run = c.runs[variant];
  for (const VariantGroup& g : c.groups) {
    if (std::find(g.members.begin(), g.members.end(), variant) == g.members.end()) continue;
    for (const std::string& name : g.joints)
      if (const JointNumbers* j = run.joint(name))
        for (const Q q : {Q::peak, Q::rms}) all.push_back({q, name, j->label});
  }
  // On another mesh than the finest it is in no group.
  if (all.empty())
    if (const JointNumbers* j = run.decisive())
      for (const Q q : {Q::peak, Q::rms}) all.push_back({q, j->name, j->label});
  if (const ComfortNumbers* k = run.leastComfortable())
    for (const Q q : {Q::mean_pressure, Q::peak_pressure}) all.push_back({q, k->zone, spokenZone(k->zone)});
  return all;
}

/// In how many axes the levels of two variants differ.
std::size_t distance(const Variant& a, const Variant& b) {
  std::size_t n = 0;
  for (std::size_t k = 0; k < a.levels.size() && k < b.levels.size(); ++k) n += a.levels[k] != b.levels[k];
  return n;
}

}  // namespace

void findBudgets(const Study& s, Comparison& c) {
  if (!s.uncertainty) return;
  for (std::size_t i = 0; i < s.variants.size(); ++i) {
    const bool asked = std::any_of(s.variants.begin(), s.variants.end(),
                                   [&](const Variant& v) { return v.reference == static_cast<int>(i); });
    if (!asked || !c.runs[i].good) continue;
    Budget& b = c.budgets.emplace_back(budgetOf(s, c.runs, i, headlinesOf(c, i)));
    double most = 0;
    for (const MeshRow& m : c.meshes)
      if (std::isfinite(m.bar)) most = std::max(most, m.bar);
    for (BarredNumber& n : b.numbers)
      if (!n.bar.mesh && n.what.isTorque() && most > 0) n.bar.mesh = most * n.value, b.mesh_taken_over = true;
  }
}

std::optional<BarredNumber> barOf(const Study& s, const Comparison& c, std::size_t variant, const Headline& what,
                                  bool* taken_over) {
  const Budget* nearest = nullptr;
  const BarredNumber* found = nullptr;
  for (const Budget& b : c.budgets)
    for (const BarredNumber& n : b.numbers) {
      if (n.what.of != what.of || n.what.quantity != what.quantity) continue;
      if (nearest && distance(s.variants[b.reference], s.variants[variant]) >=
                         distance(s.variants[nearest->reference], s.variants[variant]))
        continue;
      nearest = &b;
      found = &n;
    }
  const auto value = what.in(c.runs[variant]);
  if (!found || !value) return {};
  if (taken_over) *taken_over = nearest->reference != variant;
  BarredNumber n = *found;
  const double times = *value / found->value;
  n.value = *value;
  for (std::optional<double>* part : {&n.bar.mesh, &n.bar.step, &n.bar.fabric})
    if (*part) **part *= times;
  if (nearest->reference != variant) n.fabric.reset();
  return n;
}

}  // namespace gambeson::study
