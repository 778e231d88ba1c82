#pragma once
/// A fabric whose law is an energy per area of the strain and the curvature at a point, and nothing simpler: a table,
/// or a cell of yarns that is solved at every point.

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <string>

namespace gambeson {

/// What a sheet does at a point, axes along weft and warp: the Green-Lagrange strain of its middle surface, and its
/// curvature (where the fabric says so, its change from rest).
struct SheetStrain {
  std::array<double, 3> strain{};     ///< E11, E22, 2 E12
  std::array<double, 3> curvature{};  ///< k11, k22, 2 k12 [1/m]
  bool operator==(const SheetStrain&) const = default;
};

/// What the law answers. Resultants and moments are the derivatives of the energy, slopes those of both.
struct SheetAnswer {
  double energy_J_per_m2 = 0;         ///< W
  std::array<double, 3> resultant{};  ///< n11, n22, n12 = dW/d(E11, E22, 2 E12) [N/m]
  std::array<double, 3> moment{};     ///< m11, m22, m12 = dW/d(k11, k22, 2 k12) [N]
  std::array<double, 36> slope{};     ///< d(n, m)/d(strain, curvature) by rows, symmetric [N/m, N, N m]
  bool beyond = false;                ///< the strain lies beyond what the law knows
};

enum class SheetParts { resultants, slopes };

/// Strains between two corners, in E11, E22 and 2 E12.
struct StrainBox {
  std::array<double, 3> low{}, high{};

  static StrainBox all() {
    constexpr double kAny = std::numeric_limits<double>::infinity();
    return {{-kAny, -kAny, -kAny}, {kAny, kAny, kAny}};
  }
  static StrainBox none() { return {all().high, all().low}; }
  void add(const StrainBox& other) {
    for (std::size_t i = 0; i < 3; ++i)
      low[i] = std::min(low[i], other.low[i]), high[i] = std::max(high[i], other.high[i]);
  }
  bool contains(const StrainBox& other) const {
    bool in = true;
    for (std::size_t i = 0; i < 3; ++i) in = in && low[i] <= other.low[i] && other.high[i] <= high[i];
    return in;
  }
  StrainBox widened(double by) const {
    StrainBox out = *this;
    for (std::size_t i = 0; i < 3; ++i) out.low[i] -= by, out.high[i] += by;
    return out;
  }
};

/// Constant; many threads may evaluate it.
class PointEnergy {
 public:
  virtual ~PointEnergy() = default;

  /// Writes what each of the points answers. `history` is what each remembers, historySize() doubles one after the
  /// other (empty, or zeros: nothing yet), `remembered` what it would (empty: not asked). Slopes are written where
  /// asked. A point that finds no answer has NaN.
  virtual void evaluate(std::span<const SheetStrain> points, SheetParts parts, std::span<const double> history,
                        std::span<double> remembered, std::span<SheetAnswer> out) const = 0;
  /// Why a point with this history finds no answer, in words; empty where it finds one.
  virtual std::string whyNone(const SheetStrain& point, std::span<const double> history) const {
    return static_cast<void>(point), static_cast<void>(history), std::string();
  }
  /// Doubles that each point remembers.
  virtual std::size_t historySize() const { return 0; }
  /// A slope that no point strained within a box exceeds, in the order of matrices: what the stable time step must
  /// allow for. Throws RunError where nothing bounds them (such laws are of statics).
  virtual std::array<double, 36> steepest(const StrainBox& within = StrainBox::all()) const = 0;

  SheetAnswer at(const SheetStrain& point, SheetParts parts = SheetParts::slopes,
                 std::span<const double> history = {}) const {
    SheetAnswer out;
    evaluate({&point, 1}, parts, history, {}, {&out, 1});
    return out;
  }
};

}  // namespace gambeson
