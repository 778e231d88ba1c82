#pragma once
/// Samples of several factors that may be off at once.

#include <cstdint>
#include <vector>

namespace gambeson {

/// A Latin hypercube (McKay, Beckman and Conover, Technometrics 21(2), 1979): of each factor every one of `runs`
/// equally likely strata is met once, at random within it. Rows are runs, columns factors, numbers standard normal
/// scores. Of 1,000 hypercubes the one whose columns are least correlated, by the largest |correlation| of two of them
/// (as Owen, JASA 89, 1994 asks), so that few runs tell the factors apart. The same seed gives the same scores
/// everywhere. Valid for runs >= 2 and factors >= 1.
std::vector<std::vector<double>> latinHypercube(int runs, int factors, std::uint64_t seed);

/// Independent scores, for comparison.
std::vector<std::vector<double>> independentScores(int runs, int factors, std::uint64_t seed);

/// The multiple of a positive quantity whose logarithm is normal: exp(s z), s^2 = ln(1 + spread^2), median 1; `spread`
/// is its standard deviation over its mean, z a standard normal score. Valid for spread >= 0.
double multipleOf(double spread, double z);

}  // namespace gambeson
