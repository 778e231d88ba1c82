#include "core/statics/modal.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/math/exact_solve.hpp"
#include "core/math/lanczos.hpp"
#include "core/statics/newton.hpp"
#include "core/statics/structure_system.hpp"

namespace gambeson {
namespace {

/// The largest K_ii/M_ii, an estimate of the largest eigenvalue.
double largestRatio(const SymmetricMatrix& K, const SymmetricMatrix& M) {
  double most = 0;
  for (int c = 0; c < K.size; ++c) {
    const double m = M.values[M.offsets[c]];
    if (!(m > 0)) throw InputError({"", 0, "mass"}, "a control point has no mass; modes need one");
    most = std::max(most, std::abs(K.values[K.offsets[c]]) / m);
  }
  return most;
}

/// eps |s|^T |K| |s|.
double roundingOf(const SymmetricMatrix& K, std::span<const double> s) {
  double sum = 0;
  for (int c = 0; c < K.size; ++c)
    for (int k = K.offsets[c]; k < K.offsets[c + 1]; ++k)
      sum += (K.rows[k] == c ? 1 : 2) * std::abs(K.values[k] * s[c] * s[K.rows[k]]);
  return std::numeric_limits<double>::epsilon() * sum;
}

void keepInOrder(std::vector<RitzPair>& found, RitzPair pair) {
  const auto at = std::upper_bound(found.begin(), found.end(), pair.value,
                                   [](double value, const RitzPair& other) { return value > other.value; });
  found.insert(at, std::move(pair));
}

}  // namespace

std::vector<Mode> lowestModes(System& system, std::span<const double> y, double t, int count, bool lumped_mass) {
  const int n = system.size();
  if (count < 1) throw InputError({"", 0, "modes"}, "must be >= 1");
  count = std::min(count, n);
  std::vector<double> rest;
  if (y.empty()) rest = system.start(), y = rest;
  SymmetricMatrix K = system.sparsity(), M = K;
  system.stiffness(y, t, K);
  system.mass(lumped_mass, M);
  // The shift: zero, or as far below as makes K - sigma M positive definite.
  const double first_shift = -1e-10 * largestRatio(K, M);
  double sigma = 0;
  SymmetricFactor factor(K);
  SymmetricMatrix shifted = K;
  const auto shiftTo = [&](double to) {
    sigma = to;
    for (std::size_t k = 0; k < K.values.size(); ++k) shifted.values[k] = K.values[k] - sigma * M.values[k];
    return factor.factorise(shifted) == Definiteness::positive;
  };
  for (double to = 0; !shiftTo(to); to = to == 0 ? first_shift : 10 * to)
    if (!(to > -1e300)) throw RunError("modes: the mass matrix is not positive definite");

  std::vector<double> scratch(n), Ks(n), Ms(n);
  const LinearOperator mass = [&](std::span<const double> x, std::span<double> out) { multiply(M, x, out); };
  const LinearOperator inverse = [&](std::span<const double> x, std::span<double> out) {
    multiply(M, x, scratch);
    solveExactly(shifted, factor, scratch, out);
  };
  const std::vector<double> nothing(n, 0.0);
  /// omega^2 of a shape.
  const auto rayleigh = [&](const std::vector<double>& shape) {
    residualOf(K, shape, nothing, Ks);
    multiply(M, shape, Ms);
    return -dot(shape, Ks) / dot(shape, Ms);
  };
  /// How well it is one.
  const auto residual = [&](const std::vector<double>& shape, double lambda) {
    inverse(shape, Ks);
    for (int i = 0; i < n; ++i) Ks[i] = shape[i] - (lambda - sigma) * Ks[i];
    multiply(M, Ks, Ms);
    return std::sqrt(std::max(0.0, dot(Ks, Ms)));
  };
  constexpr double kTolerance = 1e-11, kResidual = 1e-6;
  // Where there are rigid modes, 1/sigma would drown the others' 1/(omega^2 - sigma): a shift of their own size.
  if (sigma == first_shift) {
    double least = 0;
    for (const RitzPair& pair : lanczosLargest(inverse, mass, scatteredVector(n, 1), {}, {std::min(n, 10), 1e-6, n})) {
      const double lambda = rayleigh(pair.vector);
      if (lambda > -10 * first_shift && (least == 0 || lambda < least)) least = lambda;
    }
    if (least > 0 && !shiftTo(-least)) throw RunError("modes: the stiffness matrix is not symmetric positive");
  }
  std::vector<RitzPair> found;
  for (unsigned run = 0; run < static_cast<unsigned>(n) + 1; ++run) {
    const int open = count - static_cast<int>(found.size());
    LanczosOptions options{std::max(open, 1), kTolerance, std::min(n, 300 + 20 * count)};
    if (open <= 0) options.tolerance = 1e-7;  // only to see whether something lower is left
    std::vector<RitzPair> pairs = lanczosLargest(inverse, mass, scatteredVector(n, run + 1), found, options);
    if (pairs.empty()) break;
    if (open <= 0) {
      if (pairs[0].value <= found[count - 1].value * (1 + 1e-9)) break;
      options.tolerance = kTolerance;
      pairs = lanczosLargest(inverse, mass, pairs[0].vector, found, options);
    }
    bool any = false;
    for (RitzPair& pair : pairs)
      if (residual(pair.vector, rayleigh(pair.vector)) <= kResidual) any = true, keepInOrder(found, std::move(pair));
    if (!any) throw RunError("modes: Lanczos did not converge in " + std::to_string(options.most_steps) + " steps");
  }

  std::vector<Mode> modes;
  for (int k = 0; k < std::min(count, static_cast<int>(found.size())); ++k) {
    Mode mode;
    mode.shape = std::move(found[k].vector);
    double lambda = rayleigh(mode.shape);
    mode.residual = residual(mode.shape, lambda);
    if (sigma != 0 && std::abs(lambda) <= -1e-3 * first_shift) lambda = 0;
    if (lambda != 0) mode.rounding = roundingOf(K, mode.shape) / std::abs(lambda);
    mode.omega_rad_per_s = lambda < 0 ? -std::sqrt(-lambda) : std::sqrt(lambda);
    modes.push_back(std::move(mode));
  }
  std::stable_sort(modes.begin(), modes.end(),
                   [](const Mode& a, const Mode& b) { return a.omega_rad_per_s < b.omega_rad_per_s; });
  return modes;
}

std::vector<Mode> naturalModes(const Structure& structure, std::span<const double> y, double t, int count,
                               bool lumped_mass, std::span<const double> history) {
  refuseProjectedSeams(structure);
  StructureSystem system(structure, ProgramEnds::constant);
  if (!history.empty()) system.setHistory(history, t);
  return lowestModes(system, y, t, count, lumped_mass);
}

}  // namespace gambeson
