#pragma once
/// How far a result spreads where several factors of it do, from few runs.

#include <cstddef>
#include <vector>

namespace gambeson {

/// A result y over standard normal scores z of independent factors, y = c0 + sum c_i z_i + r, by linear least squares.
///   variance of factor i:  c_i^2 less what chance adds to it, s^2 [(X^T X)^-1]_ii, at least 0; X = (1, z);
///   residual variance:     s^2 = sum r^2/(runs - factors - 1): what no straight line explains, that is curvature,
///                          factors that work together, and what differs from run to run by itself;
///   variance of y:         their sum.
/// Since scores have variance 1 by definition and not by the sample's chance, a dozen runs give the variance of a
/// nearly linear result far closer than the variance of as many samples does (Saltelli et al., Global sensitivity
/// analysis, 2008, section 1.2.5: standardised regression coefficients). Units: those of y, squared for variances.
struct SpreadFit {
  double center = 0;             ///< c0
  std::vector<double> slope;     ///< c_i
  std::vector<double> variance;  ///< of each factor
  double residual = 0;           ///< s
  double explained = 0;          ///< 1 - sum r^2/sum (y - mean)^2; 1 where y is one value
  std::size_t runs = 0;

  double total() const;      ///< variance of y
  double deviation() const;  ///< its square root
};

/// Valid for more runs than factors + 1, none of them a combination of others (latinHypercube gives such).
SpreadFit fitSpread(const std::vector<std::vector<double>>& scores, const std::vector<double>& y);

}  // namespace gambeson
