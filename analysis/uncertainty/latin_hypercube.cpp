#include "analysis/uncertainty/latin_hypercube.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cassert>
#include <cmath>
#include <random>

namespace gambeson {
namespace {

using Scores = std::vector<std::vector<double>>;

/// In (0, 1), both ends left out: they have no score.
double uniform(std::mt19937_64& random) { return (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53; }

/// Below `n`, each number equally likely: draws beyond the last whole multiple of n are thrown away.
std::uint64_t below(std::uint64_t n, std::mt19937_64& random) {
  const std::uint64_t most = std::mt19937_64::max() - std::mt19937_64::max() % n;
  std::uint64_t draw = random();
  while (draw >= most) draw = random();
  return draw % n;
}

double scoreOf(double probability) { return boost::math::quantile(boost::math::normal(), probability); }

double correlation(const Scores& z, std::size_t a, std::size_t b) {
  double mean_a = 0, mean_b = 0;
  for (const auto& row : z) mean_a += row[a], mean_b += row[b];
  mean_a /= static_cast<double>(z.size());
  mean_b /= static_cast<double>(z.size());
  double ab = 0, aa = 0, bb = 0;
  for (const auto& row : z) {
    ab += (row[a] - mean_a) * (row[b] - mean_b);
    aa += (row[a] - mean_a) * (row[a] - mean_a);
    bb += (row[b] - mean_b) * (row[b] - mean_b);
  }
  return ab / std::sqrt(aa * bb);
}

double largestCorrelation(const Scores& z) {
  double most = 0;
  for (std::size_t a = 0; a < z[0].size(); ++a)
    for (std::size_t b = 0; b < a; ++b) most = std::max(most, std::abs(correlation(z, a, b)));
  return most;
}

Scores oneHypercube(std::size_t runs, std::size_t factors, std::mt19937_64& random) {
  Scores z(runs, std::vector<double>(factors));
  std::vector<std::size_t> strata(runs);
  for (std::size_t f = 0; f < factors; ++f) {
    for (std::size_t i = 0; i < runs; ++i) strata[i] = i;
    for (std::size_t i = runs; i > 1; --i) std::swap(strata[i - 1], strata[below(i, random)]);
    for (std::size_t i = 0; i < runs; ++i)
      z[i][f] = scoreOf((static_cast<double>(strata[i]) + uniform(random)) / static_cast<double>(runs));
  }
  return z;
}

}  // namespace

Scores latinHypercube(int runs, int factors, std::uint64_t seed) {
  assert(runs >= 2 && factors >= 1);
  constexpr int tries = 1000;
  std::mt19937_64 random(seed);
  Scores best;
  double least = 2;
  for (int k = 0; k < (factors > 1 ? tries : 1); ++k) {
    Scores z = oneHypercube(static_cast<std::size_t>(runs), static_cast<std::size_t>(factors), random);
    const double most = largestCorrelation(z);
    if (most < least) least = most, best = std::move(z);
  }
  return best;
}

Scores independentScores(int runs, int factors, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Scores z(static_cast<std::size_t>(runs), std::vector<double>(static_cast<std::size_t>(factors)));
  for (auto& row : z)
    for (double& one : row) one = scoreOf(uniform(random));
  return z;
}

double multipleOf(double spread, double z) { return std::exp(std::sqrt(std::log1p(spread * spread)) * z); }

}  // namespace gambeson
