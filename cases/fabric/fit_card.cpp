#include "cases/fabric/fit_card.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "cases/cloth/card_terms.hpp"
#include "core/error.hpp"
#include "core/material/hysteresis.hpp"
#include "core/math/least_squares.hpp"

namespace gambeson {
namespace {

using lab::kGfCm2PerCm_Nm, lab::kGfPerCm_N_per_m, lab::kGfPerCmDeg_N_per_m;
constexpr double kGfCmPerCm_N = 9.80665e-3, kFrom_rad = 0.5 * 0.017453292519943295;
constexpr const char* kThreads[2] = {"weft", "warp"};

[[noreturn]] void refuse(const std::string& test, const std::string& reason) {
  throw InputError({"", 0, test}, reason);
}

LeastSquares solve(const std::string& test, const Residuals& residuals, std::size_t count,
                   const std::vector<double>& start) {
  try {
    return leastSquares(residuals, static_cast<int>(count), start);
  } catch (const InputError& e) {
    refuse(test, e.reason());
  }
}

/// LT of Fung's curve, and its derivative in b.
std::pair<double, double> linearityOf(double b) {
  if (std::abs(b) < 1e-3) return {1 - b / 6, -1. / 6};
  const double grown = std::expm1(b);
  return {2 / b - 2 / grown, -2 / (b * b) + 2 * (grown + 1) / (grown * grown)};
}

void fitTension(const Measurements& m, int i, CardTensile& t, std::vector<FittedNumber>& out) {
  const std::vector<TensilePoint>& points = m.tension[i];
  const std::string test = fmt::format("tension_{}", kThreads[i]);
  const double most = t.load_N_per_m;
  const auto& [e, F] = points.back();
  const LeastSquares fit =
      solve(test,
            [&](std::span<const double> x, std::span<double> r) {
              for (std::size_t k = 0; k < points.size(); ++k) {
                const double s = points[k][0] / x[0];
                r[k] = most * (x[1] == 0 ? s : std::expm1(x[1] * s) / std::expm1(x[1])) - points[k][1];
              }
            },
            points.size(), {e * std::sqrt(most / F), 2});
  const auto [lt, slope] = linearityOf(fit.value[1]);
  const int count = static_cast<int>(points.size());
  if (!(fit.value[0] > 1e-5 && fit.value[0] <= 0.5 && lt > 0.1 && lt <= 1.5))
    refuse(test, fmt::format("gives EMT {:.4g} % and LT {:.4g}; allowed: 0.001 to 50 % and 0.1 to 1.5",
                             100 * fit.value[0], lt));
  out.push_back({fmt::format("EMT {}", kThreads[i]), "%", 0.01, fit.value[0], fit.error[0], count, fit.rms});
  out.push_back({fmt::format("LT {}", kThreads[i]), "", 1, lt, std::abs(slope) * fit.error[1], count, fit.rms});
  (i == 0 ? t.extension.weft : t.extension.warp) = fit.value[0];
  (i == 0 ? t.linearity.weft : t.linearity.warp) = lt;
}

/// Slope and width of a loop whose ways are straight between two places: y = slope x +- width/2.
LeastSquares fitWays(const std::string& test, const std::vector<std::array<double, 2>>& loop, double from, double to,
                     double slope, double width, std::size_t& count) {
  std::vector<std::array<double, 3>> points;  // x, y and the sign of the way
  for (std::size_t k = 1; k < loop.size(); ++k) {
    const double x = loop[k][0], way = x - loop[k - 1][0];
    if (way != 0 && std::abs(x) >= from * (1 - 1e-9) && std::abs(x) <= to * (1 + 1e-9))
      points.push_back({x, loop[k][1], way > 0 ? 1. : -1.});
  }
  count = points.size();
  return solve(test,
               [&](std::span<const double> x, std::span<double> r) {
                 for (std::size_t k = 0; k < points.size(); ++k)
                   r[k] = x[0] * points[k][0] + 0.5 * x[1] * points[k][2] - points[k][1];
               },
               points.size(), {slope, width});
}

void fitShear(const Measurements& m, FabricCard& card, std::vector<FittedNumber>& out) {
  std::vector<std::array<double, 2>> loop = m.shear;
  for (auto& point : loop) point[0] = std::tan(point[0]);
  std::size_t count = 0;
  const LeastSquares fit = fitWays("shear", loop, std::tan(kFrom_rad), 1, kCardShear_N_per_m, 1, count);
  if (!(fit.value[0] > 0)) refuse("shear", fmt::format("gives G {:.4g} N/m; allowed: > 0", fit.value[0]));
  const int n = static_cast<int>(count);
  out.push_back({"G", "gf/(cm deg)", kGfPerCmDeg_N_per_m, fit.value[0], fit.error[0], n, fit.rms});
  out.push_back({"2HG", "gf/cm", kGfPerCm_N_per_m, fit.value[1], fit.error[1], n, fit.rms});
  CardShear s;
  s.rigidity.both = fit.value[0];
  if (fit.value[1] > 2 * fit.error[1]) s.hysteresis.both = fit.value[1];
  if (card.shear) s.friction_rad = card.shear->friction_rad;
  if (s.hysteresis.any()) try {
      sheetOf(s);
    } catch (const InputError& e) {
      refuse("shear", e.reason());
    }
  card.shear = s;
}

struct Bent {
  double rigidity = 0;
  std::optional<double> width;
};

Bent fitBending(const Measurements& m, int i, std::vector<FittedNumber>& out) {
  const std::string test = fmt::format("bending_{}", kThreads[i]);
  std::size_t count = 0;
  const LeastSquares fit =
      fitWays(test, m.bending[i], kKesFrom_per_m, kKesTo_per_m, 0.1 * kGfCm2PerCm_Nm, 0.1 * kGfCmPerCm_N, count);
  if (!(fit.value[0] > 0)) refuse(test, fmt::format("gives B {:.4g} N m; allowed: > 0", fit.value[0]));
  const int n = static_cast<int>(count);
  out.push_back(
      {fmt::format("B {}", kThreads[i]), "gf cm^2/cm", kGfCm2PerCm_Nm, fit.value[0], fit.error[0], n, fit.rms});
  out.push_back({fmt::format("2HB {}", kThreads[i]), "gf cm/cm", kGfCmPerCm_N, fit.value[1], fit.error[1], n, fit.rms});
  return {fit.value[0], fit.value[1] > 2 * fit.error[1] ? std::optional(fit.value[1]) : std::nullopt};
}

Bent fitOverhang(const Measurements& m, int i, const FabricCard& card, std::vector<FittedNumber>& out) {
  const std::string test = fmt::format("overhang_{}", kThreads[i]);
  if (!card.weight_kg_per_m2) refuse(test, "needs the card's weight: B = W g (L/2)^3");
  const std::vector<double>& lengths = m.overhang[i];
  const LeastSquares fit = solve(test,
                                 [&](std::span<const double> x, std::span<double> r) {
                                   const double c = lab::lengthOfRigidity(x[0], *card.weight_kg_per_m2);
                                   for (std::size_t k = 0; k < lengths.size(); ++k) r[k] = 2 * c - lengths[k];
                                 },
                                 lengths.size(), {lab::rigidityOfLength(0.5 * lengths[0], *card.weight_kg_per_m2)});
  out.push_back({fmt::format("B {} (overhang)", kThreads[i]), "gf cm^2/cm", kGfCm2PerCm_Nm, fit.value[0], fit.error[0],
                 static_cast<int>(lengths.size()), fit.rms});
  return {fit.value[0], std::nullopt};
}

}  // namespace

std::vector<FittedNumber> fitCard(const Measurements& m, FabricCard& card) {
  std::vector<FittedNumber> out;
  if (!m.tension[0].empty() || !m.tension[1].empty()) {
    CardTensile t;
    for (int i = 0; i < 2; ++i) {
      if (m.tension[i].empty())
        refuse(fmt::format("tension_{}", kThreads[i]), fmt::format("is required beside tension_{}", kThreads[1 - i]));
      fitTension(m, i, t, out);
    }
    if (card.tensile) t.law = card.tensile->law;
    card.tensile = t;
  }
  if (!m.shear.empty()) fitShear(m, card, out);
  std::optional<Bent> bent[2];
  for (int i = 0; i < 2; ++i) {
    if (!m.bending[i].empty()) bent[i] = fitBending(m, i, out);
    if (!m.overhang[i].empty() && bent[i])
      refuse(fmt::format("overhang_{}", kThreads[i]), fmt::format("excludes bending_{}: both give B", kThreads[i]));
    if (!m.overhang[i].empty()) bent[i] = fitOverhang(m, i, card, out);
  }
  if (bent[0] && bent[1]) {
    CardBending b;
    b.rigidity.weft = bent[0]->rigidity;
    b.rigidity.warp = bent[1]->rigidity;
    if (bent[0]->width && bent[1]->width) {
      b.hysteresis.weft = bent[0]->width;
      b.hysteresis.warp = bent[1]->width;
      b.hysteresis_at_per_m = kKesWidthAt_per_m;
    }
    card.bending = b;
  } else if (bent[0] || bent[1]) {
    refuse(fmt::format("bending_{}", kThreads[bent[0] ? 1 : 0]), "is required beside the other direction, or overhang");
  }
  return out;
}

std::string fittedTable(const std::vector<FittedNumber>& numbers) {
  std::string text =
      fmt::format("Fitted by least squares\n  {:<20}{:>12}{:>12}  {:<12} points\n", "", "value", "error", "unit");
  for (const FittedNumber& n : numbers)
    text += fmt::format("  {:<20}{:>12.4g}{:>12.2g}  {:<12} {}\n", n.name, n.value / n.per_unit, n.error / n.per_unit,
                        n.unit, n.points);
  return text;
}

}  // namespace gambeson
