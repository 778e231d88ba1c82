#pragma once
/// One cell of the degenerated shell: energy, force and stiffness in the positions and directors of its corners.
///
/// Position (Man 2006, eq. 2.39): x(xi, eta, z) = sum_A N_A (x_A + z d_A), d_A unit directors, z [m] the height over
/// the mid-surface, N_A bilinear. Strains are Green-Lagrange's against the rest shape (total Lagrangian, eq. 2.36).
/// With a_i = x,i and b_i = d,i of the interpolations, the covariant strains at a height z are
///   e_ij(z) = eta_ij + z k_ij,   k_ij = (a_i . b_j + a_j . b_i)/2,   eta_ij = (a_i . a_j + z0² b_i . b_j)/2,
///   e_i3 = a_i . d/2,   each less its value at rest;
/// two Gauss points through the thickness, z = +- z0 = +- t/sqrt(12), make the term in z² the same at both. Transverse
/// shear is that of the mid-surface. In the lamina of the mid-surface at rest (axes weft, warp, normal) they become
/// strains E = T eta, curvatures kappa = - T k in the sense of Zheng 2013, eq. 2.9, and shears gamma_a = 2 E_a3.
/// S33 = 0 is condensed (Man 2006, eq. 2.72 and 2.74 with section 2.3.1.5). Energy per area of the rest mid-surface:
///   W = E . A E/2 + E . B kappa + kappa . D kappa/2 + gamma . G gamma/2.
/// With A = Q t, B = 0, D = Q t³/12 that is what the thesis integrates over both points; a sheet whose rigidity D is
/// given apart, or a laminate, takes its own, and laws that no section expresses take the place of the first three
/// terms (shell_law.hpp). Where curvature counts from flat, k has no value at rest. Terms of the order of thickness
/// over radius of the rest shape are left out, as in any first-order shell theory.

#include <array>

#include "core/cloth/cloth_state.hpp"
#include "core/cloth/degenerated/shell_law.hpp"
#include "core/cloth/degenerated/shell_rule.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

/// Covariant strains of a point: eta 11, 22, 12 [m^2], k 11, 22, 12 [m], e_13, e_23 [m].
using Covariant = std::array<double, 8>;

/// A point of the rule in one cell, at rest.
struct ShellPoint {
  double area_m2 = 0;              ///< that it stands for
  std::array<double, 9> T{};       ///< (eta 11, 22, 12) to (E11, E22, 2 E12), row by row
  std::array<double, 6> slant{};   ///< to gamma, where directors at rest are not quite normal
  std::array<double, 4> across{};  ///< (e_13, e_23) to gamma
  Covariant rest{};
};

struct ShellCell {
  int patch = 0;
  std::array<int, 4> corner{}, director{};  ///< corners (-1, -1), (1, -1), (-1, 1), (1, 1)
  ShellLaw law;
  long first_history = 0;  ///< where its memory begins in the cloth's
  double hold_Nm = 0;  ///< per rad: against drilling, where it must not be without stiffness (ClothTangent::holdIdle)
  std::array<ShellPoint, 5> points;  ///< as many as the rule has
};

/// Of a cell, in its own order: positions of the corners, then directors.
using CornerVectors = std::array<Vec3, 8>;
/// Second derivatives by nodes' components: 24 x 24, row by row.
using CellStiffness = std::array<double, 576>;

/// Bilinear functions of the corners at a place, and their derivatives by xi and eta.
struct CornerBasis {
  std::array<double, 4> n{}, n1{}, n2{};
};
CornerBasis cornerBasis(Natural at);

/// Shares of the corners in a cell by ∫ N_A² dA, which sum to 1, and its area at rest, by 2 x 2 points.
struct CornerShares {
  std::array<double, 4> share{};
  double area_m2 = 0;
};
CornerShares squaredShares(const CornerVectors& rest);

/// Evaluates cells by one rule. Constant.
class ShellKernel {
 public:
  explicit ShellKernel(ShellRule rule);

  const RuleTable& table() const { return table_; }
  /// Points that see strains in the plane, and remember; they come first.
  std::size_t planePoints() const { return plane_points_; }

  /// The frames and rest strains of a cell with these corners at rest. Throws InputError where the rest surface has no
  /// area, the weft is normal to it, or a director lies in it.
  void setRest(const CornerVectors& rest, const Vec3& weft, double angle_rad, ShellCell& cell) const;

  /// Adds the gradient of the energy; returns that [J]. Terms of `terms` that do not act are left out: stretching and
  /// what couples it are the membrane, bending and shear the bending.
  ClothEnergy gradient(const ShellCell& cell, const CornerVectors& now, const CellMemory& memory,
                       const ForceTerms& terms, CornerVectors& gradient) const;
  /// Writes the second derivatives by positions and directors, both free in space. `definite`: without the part of the
  /// stress.
  void stiffness(const ShellCell& cell, const CornerVectors& now, const CellMemory& memory, const ForceTerms& terms,
                 CellStiffness& K, CornerVectors& gradient) const;
  /// What the law says of stretching and bending at a place of a cell whose corners were at rest, as the nearest point
  /// remembers. `total`: with the curvature of the rest shape, in PointState::curvature_change.
  PointState at(const ShellCell& cell, const CornerVectors& rest, const CornerVectors& now, const CellMemory& memory,
                const Vec3& weft, double angle_rad, Natural place, bool total = false) const;

 private:
  struct Station {
    Vec3 a1, a2, b1, b2, d;
  };
  static Station stationAt(const CornerBasis& basis, const CornerVectors& x);
  static void addPlane(const Station& s, double z2, Covariant& c);
  Covariant covariant(const CornerVectors& x, double z2, std::size_t point) const;

  RuleTable table_;
  std::size_t plane_points_ = 0;
  std::vector<CornerBasis> points_, stations_;
};

}  // namespace gambeson
