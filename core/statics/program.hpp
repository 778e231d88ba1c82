#pragma once
/// Factors of supports and loads over time, or over the load factor.

#include <span>
#include <vector>

namespace gambeson {

/// A factor over time (or over the load factor, in statics), linear between its points, constant beyond.
struct Program {
  std::vector<double> at, value;
  double operator()(double t) const;
  /// As a load path sees it that leaves 0 to 1 (limit points, snap-backs): beyond both its points and 0 to 1 it goes on
  /// with its slope there.
  double extended(double factor) const;
};

/// How programs go on beyond their ends: constant (time), or with their slope (a load path).
enum class ProgramEnds { constant, extended };

/// Throws InputError where a program has no points, too many or too few values, numbers that are not finite, or points
/// that do not ascend.
void checkPrograms(std::span<const Program> programs);

}  // namespace gambeson
