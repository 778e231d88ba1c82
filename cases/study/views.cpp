/// Detail of compare.hpp: variants side by side in the viewer of the page.

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "cases/study/compare.hpp"
#include "cases/wear/results/results.hpp"
#include "cases/wear/results/viewer.hpp"
#include "core/error.hpp"

namespace gambeson::study {
namespace {

/// So many stand beside each other and can still be told apart.
constexpr std::size_t kMost = 4;

bool canBeViewed(const Study& s, const Comparison& c, std::size_t i) {
  const auto* definition = std::get_if<Case>(&s.variants[i].definition);
  return c.runs[i].good && definition && definition->output.viewer;
}

/// Of a group's members those that can be viewed.
std::vector<std::size_t> viewable(const Study& s, const Comparison& c, const VariantGroup& g) {
  std::vector<std::size_t> out;
  std::copy_if(g.members.begin(), g.members.end(), std::back_inserter(out),
               [&](std::size_t i) { return canBeViewed(s, c, i); });
  return out;
}

/// The group whose motion decides on the option taken; else the first that has two.
const VariantGroup* decidingGroup(const Study& s, const Comparison& c) {
  const VariantGroup* first = nullptr;
  const Option::Cost* worst =
      c.verdict.take >= 0 ? worstCost(c.input.options[static_cast<std::size_t>(c.verdict.take)]) : nullptr;
  for (const VariantGroup& g : c.groups) {
    if (viewable(s, c, g).size() < 2) continue;
    if (worst && g.label == worst->motion) return &g;
    if (!first) first = &g;
  }
  return first;
}

/// Whether it is of the option that is taken.
bool isTaken(const Study& s, const Comparison& c, std::size_t i) {
  return c.verdict.take >= 0 && memberName(s, c, i) == c.input.options[static_cast<std::size_t>(c.verdict.take)].name;
}

/// The baseline, the one taken, then others from both ends; in the order of the group. Where there is room the one
/// taken in other groups: on another wearer, in another motion.
std::vector<std::size_t> chosenOf(const Study& s, const Comparison& c, const VariantGroup& g) {
  const std::vector<std::size_t> all = viewable(s, c, g);
  std::vector<std::size_t> first;
  const auto take = [&](std::size_t i) {
    if (first.size() < kMost && std::find(first.begin(), first.end(), i) == first.end()) first.push_back(i);
  };
  for (const std::size_t i : all)
    if (static_cast<int>(i) == g.baseline) take(i);
  for (const std::size_t i : all)
    if (isTaken(s, c, i)) take(i);
  for (std::size_t k = 0; k < all.size(); ++k) take(k % 2 == 0 ? all[k / 2] : all[all.size() - 1 - k / 2]);
  std::vector<std::size_t> out;
  for (const std::size_t i : all)
    if (std::find(first.begin(), first.end(), i) != first.end()) out.push_back(i);
  for (const VariantGroup& other : c.groups)
    for (const std::size_t i : viewable(s, c, other))
      if (&other != &g && out.size() < kMost && isTaken(s, c, i)) out.push_back(i);
  return out;
}

/// Of a population those it burdens most, in what each of them wears; of others the group that decides.
std::vector<std::size_t> viewedOf(const Study& s, const Comparison& c) {
  if (!c.population) {
    const VariantGroup* g = decidingGroup(s, c);
    return g ? chosenOf(s, c, *g) : std::vector<std::size_t>{};
  }
  std::vector<std::size_t> out;
  for (const std::size_t w : c.population->worst)
    if (const std::size_t i = c.population->wearers[w].taken()->variant; canBeViewed(s, c, i)) out.push_back(i);
  return out;
}

}  // namespace

std::vector<ViewerRun> takeViews(const Study& s, const Comparison& c, const std::filesystem::path& out,
                                 std::vector<std::string>& failures) {
  std::vector<ViewerRun> views;
  for (const std::size_t i : viewedOf(s, c)) {
    const Variant& v = s.variants[i];
    try {
      const auto [recording, scenario, facts] = recordedRun(out / v.folder);
      Measured m = measure(*scenario, recording);
      measureStretch(*scenario, recording, m);
      views.push_back(viewerRun(*scenario, recording, m, v.label, ViewerContent::compared));
    } catch (const std::exception& e) {
      failures.push_back(fmt::format("{} cannot be looked at side by side: {}", v.label, e.what()));
    }
  }
  if (views.size() < 2) views.clear();
  return views;
}

}  // namespace gambeson::study
