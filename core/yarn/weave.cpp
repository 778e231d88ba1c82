#include "core/yarn/weave.hpp"

#include <algorithm>
#include <numeric>
#include <string>

#include "core/error.hpp"

namespace gambeson {
namespace {

[[noreturn]] void refuse(const std::string& key, const std::string& why) { throw InputError({"", 0, key}, why); }

int wrapped(int i, int n) { return ((i % n) + n) % n; }

/// The yarns that a way from yarn 0 reaches, going up from a yarn to those over it, or down. Wefts come first.
std::vector<char> reached(const Weave& w, bool up) {
  std::vector<char> found(static_cast<std::size_t>(w.wefts + w.warps), 0);
  std::vector<int> open{0};
  found[0] = 1;
  const auto visit = [&](int yarn) {
    if (found[static_cast<std::size_t>(yarn)]) return;
    found[static_cast<std::size_t>(yarn)] = 1;
    open.push_back(yarn);
  };
  while (!open.empty()) {
    const int yarn = open.back();
    open.pop_back();
    if (yarn < w.wefts) {
      for (int i = 0; i < w.warps; ++i)
        if (w.warpOver(i, yarn) == up) visit(w.wefts + i);
    } else {
      for (int j = 0; j < w.wefts; ++j)
        if (w.warpOver(yarn - w.wefts, j) != up) visit(j);
    }
  }
  return found;
}

/// Row j of `rows` is the first, shifted by j times the step.
Weave shifted(const std::vector<char>& first, int step) {
  const int n = static_cast<int>(first.size());
  Weave w{n, n, {}};
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) w.warp_over.push_back(first[static_cast<std::size_t>(wrapped(i - j * step, n))]);
  return w;
}

}  // namespace

bool Weave::warpOver(int warp, int weft) const {
  return warp_over[static_cast<std::size_t>(wrapped(weft, wefts) * warps + wrapped(warp, warps))] != 0;
}

Weave plainWeave() { return shifted({1, 0}, 1); }

bool isPlain(const Weave& w) {
  for (int j = 0; j < w.wefts; ++j)
    for (int i = 0; i < w.warps; ++i)
      if (w.warpOver(i, j) == w.warpOver(i + 1, j) || w.warpOver(i, j) == w.warpOver(i, j + 1)) return false;
  return true;
}

Weave twillWeave(int over, int under) {
  if (over < 1) refuse("weave.over", std::to_string(over) + ", must be at least 1");
  if (under < 1) refuse("weave.under", std::to_string(under) + ", must be at least 1");
  std::vector<char> first(static_cast<std::size_t>(over + under), 0);
  std::fill_n(first.begin(), over, char{1});
  return shifted(first, 1);
}

Weave satinWeave(int ends, int step) {
  if (ends < 5) refuse("weave.ends", std::to_string(ends) + ", must be at least 5");
  if (step < 2 || step > ends - 2 || std::gcd(step, ends) != 1)
    refuse("weave.step", std::to_string(step) + ", must be 2 to " + std::to_string(ends - 2) +
                             " without a factor in common with " + std::to_string(ends));
  std::vector<char> first(static_cast<std::size_t>(ends), 1);
  first[0] = 0;
  return shifted(first, step);
}

Weave weaveOf(const std::vector<std::vector<int>>& rows) {
  if (rows.empty() || rows[0].empty()) refuse("weave.matrix", "must have at least one row of at least one crossing");
  Weave w{static_cast<int>(rows[0].size()), static_cast<int>(rows.size()), {}};
  for (std::size_t j = 0; j < rows.size(); ++j) {
    if (rows[j].size() != rows[0].size())
      refuse("weave.matrix", "row " + std::to_string(j + 1) + " has " + std::to_string(rows[j].size()) +
                                 " crossings, must have " + std::to_string(rows[0].size()) + " as the first");
    for (int over : rows[j]) {
      if (over != 0 && over != 1)
        refuse("weave.matrix",
               std::to_string(over) + " in row " + std::to_string(j + 1) + ", must be 0 (weft over) or 1 (warp over)");
      w.warp_over.push_back(static_cast<char>(over));
    }
  }
  checkWeave(w);
  return w;
}

namespace {

/// Whether other(i, j) is the weave, shifted by some warps and wefts.
template <class Other>
bool isShifted(const Weave& w, const Other& other) {
  const auto same = [&](int by_warps, int by_wefts) {
    for (int j = 0; j < w.wefts; ++j)
      for (int i = 0; i < w.warps; ++i)
        if (other(i, j) != w.warpOver(i + by_warps, j + by_wefts)) return false;
    return true;
  };
  for (int j = 0; j < w.wefts; ++j)
    for (int i = 0; i < w.warps; ++i)
      if (same(i, j)) return true;
  return false;
}

}  // namespace

bool isMirrorSymmetric(const Weave& weave) {
  return isShifted(weave, [&](int i, int j) { return weave.warpOver(-i, j); });
}

bool hasEqualFaces(const Weave& weave) {
  return isShifted(weave, [&](int i, int j) { return !weave.warpOver(i, j); });
}

void checkWeave(const Weave& weave) {
  for (const bool up : {true, false}) {
    const std::vector<char> found = reached(weave, up);
    const auto lost = std::find(found.begin(), found.end(), char{0});
    if (lost == found.end()) continue;
    const int yarn = static_cast<int>(lost - found.begin());
    const bool weft = yarn < weave.wefts;
    refuse("weave.matrix", (weft ? "weft yarn " : "warp yarn ") +
                               std::to_string((weft ? yarn : yarn - weave.wefts) + 1) +
                               " is not woven in: it can be taken off the first weft yarn, with others or alone; from "
                               "each yarn a way over yarns that lie on each other must lead to every other");
  }
}

}  // namespace gambeson
