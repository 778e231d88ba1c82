#include "tryon/pattern/flat/propose_seams.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "tryon/pattern/flat/panel_geometry.hpp"

namespace gambeson {
namespace {

constexpr double kShortest_m = 0.02, kNotchApart_m = 5e-3, kLengthShare = 0.01, kLength_m = 2e-3;

struct Side {
  int panel, edge;
  double length_m;
  std::vector<double> notches;  ///< fractions, ascending, ends left out
};

std::vector<Side> sidesOf(const FlatPattern& pattern) {
  std::vector<Side> out;
  for (std::size_t p = 0; p < pattern.panels.size(); ++p) {
    const Panel& panel = pattern.panels[p];
    for (int e = 0; e < static_cast<int>(panel.outline.size()); ++e) {
      Side side{static_cast<int>(p), e, lengthOf(panel, e), {}};
      if (!(side.length_m >= kShortest_m)) continue;
      for (const Notch& n : panel.notches)
        if (n.edge == e && n.at > 1e-6 && n.at < 1 - 1e-6) side.notches.push_back(n.at);
      std::sort(side.notches.begin(), side.notches.end());
      out.push_back(std::move(side));
    }
  }
  return out;
}

struct Pair {
  std::size_t a, b;
  double misfit;
};

/// Nothing where they cannot be sewn: 0 to 1 for lengths, less where as many notches lie beside each other.
std::optional<double> misfit(const Side& a, const Side& b) {
  const double allowed = std::max(kLength_m, kLengthShare * std::max(a.length_m, b.length_m));
  const double off = std::abs(a.length_m - b.length_m) / allowed;
  if (!(off < 1)) return std::nullopt;
  if (a.notches.size() != b.notches.size()) return 2 + off;
  double apart = 0;
  for (std::size_t k = 0; k < a.notches.size(); ++k)
    apart =
        std::max(apart, std::abs(a.notches[k] * a.length_m - (1 - b.notches[b.notches.size() - 1 - k]) * b.length_m));
  if (apart > kNotchApart_m) return 2 + off;
  return a.notches.empty() ? 1 + off : off * 0.5 + 0.5 * apart / kNotchApart_m;
}

}  // namespace

ProposedSeams proposeSeams(const FlatPattern& pattern) {
  const std::vector<Side> sides = sidesOf(pattern);
  std::vector<Pair> pairs;
  for (std::size_t a = 0; a < sides.size(); ++a)
    for (std::size_t b = a + 1; b < sides.size(); ++b)
      if (sides[a].panel != sides[b].panel)
        if (const auto off = misfit(sides[a], sides[b])) pairs.push_back({a, b, *off});
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& s, const Pair& t) { return s.misfit < t.misfit; });
  ProposedSeams out;
  std::vector<bool> taken(sides.size());
  for (const Pair& p : pairs) {
    if (taken[p.a] || taken[p.b]) continue;
    taken[p.a] = taken[p.b] = true;
    PanelSeam seam;
    seam.name = fmt::format("s{}", out.seams.size() + 1);
    seam.a = {{sides[p.a].panel, sides[p.a].edge, 0, 1}};
    seam.b = {{sides[p.b].panel, sides[p.b].edge, 1, 0}};
    seam.proposed = true;
    out.seams.push_back(std::move(seam));
  }
  out.edges_left = static_cast<int>(std::count(taken.begin(), taken.end(), false));
  return out;
}

}  // namespace gambeson
