#include "cases/fabric/drape_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gambeson::laboratory {
namespace {

double meanOf(const std::vector<Draped>& drapes) {
  double sum = 0;
  for (const Draped& d : drapes) sum += d.coefficient;
  return sum / static_cast<double>(drapes.size());
}

template <class Check>
bool all(const DrapeSeries& s, Check check) {
  return std::all_of(s.starts.begin(), s.starts.end(), check) && std::all_of(s.coarser.begin(), s.coarser.end(), check);
}

}  // namespace

double DrapeSeries::coefficient() const { return meanOf(starts); }
double DrapeSeries::nodes() const {
  double sum = 0;
  for (const Draped& d : starts) sum += d.nodes;
  return sum / static_cast<double>(starts.size());
}
double DrapeSeries::spread() const { return 0.5 * (starts.back().coefficient - starts.front().coefficient); }
double DrapeSeries::mesh() const { return meanOf(starts) - meanOf(coarser); }
bool DrapeSeries::atRest() const {
  return all(*this, [](const Draped& d) { return d.at_rest; });
}
double DrapeSeries::unbalanced() const {
  double most = 0;
  for (const auto* drapes : {&starts, &coarser})
    for (const Draped& d : *drapes) most = std::max(most, d.unbalanced);
  return most;
}
long DrapeSeries::crossings() const {
  long most = 0;
  for (const Draped& d : starts) most = std::max(most, d.crossings);
  return most;
}

DrapeSeries drapeSeries(const Fabric& fabric, const Specimen& specimen, double specimen_m, double support_m) {
  DrapeSeries out;
  out.cells = specimen.cells;
  Specimen coarse = specimen;
  coarse.cells = out.coarser_cells = std::max(4, 2 * specimen.cells / 3);
  for (int k = 0; k < kDrapeStarts; ++k) {
    out.starts.push_back(drape(fabric, specimen, {specimen_m, support_m, k}));
    out.coarser.push_back(drape(fabric, coarse, {specimen_m, support_m, k}));
  }
  std::sort(out.starts.begin(), out.starts.end(),
            [](const auto& a, const auto& b) { return a.coefficient < b.coefficient; });
  return out;
}

std::string drapeVerdict(const DrapeSeries& s, double card) {
  const double off = std::abs(s.coefficient() - card), doubt = s.spread() + std::abs(s.mesh());
  const std::string of = fmt::format("within {:.0f} points of the card", 100 * kDrapeWithin);
  if (!s.atRest()) return fmt::format("whether it is {} is not known: not all starts came to rest", of);
  const std::string beside =
      fmt::format("it is {:.1f} off, starts and mesh leave {:.1f} in doubt", 100 * off, 100 * doubt);
  if (off + doubt <= kDrapeWithin) return fmt::format("{}: {}", of, beside);
  if (off - doubt > kDrapeWithin) return fmt::format("not {}: {}", of, beside);
  return fmt::format("whether it is {} is not known: {}", of, beside);
}

}  // namespace gambeson::laboratory
