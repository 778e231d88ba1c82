#pragma once
/// Solids with supports and loads as the solvers' system: their load paths are those of core/statics/path.hpp.

#include <string>
#include <vector>

#include "core/cloth/constraint.hpp"
#include "core/solid/solid_body.hpp"
#include "core/statics/program.hpp"
#include "core/statics/reduction.hpp"
#include "core/statics/system.hpp"

namespace gambeson {

/// A constant force on a node, at program value 1.
struct NodeForce {
  int node = 0;
  Vec3 force_N;
  int program = 0;
};

struct SolidSupports {
  std::vector<LinearConstraint> constraints;  ///< of nodes: prescribed displacements, symmetry, periodicity
  std::vector<NodeForce> forces;
  std::vector<Program> programs;  ///< none: one, from 0 at 0 to 1 at 1
};

/// u . direction = amount at program value 1, at a node.
LinearConstraint prescribed(int node, const Vec3& direction, double amount_m = 0, int program = -1);

/// Unknowns y: the displacements of nodes that satisfy the supports, u = C y + shifts (DofMap). Positions are X + u.
class SolidSystem : public System {
 public:
  /// Throws InputError where supports contradict each other, or name nodes or programs that do not exist.
  SolidSystem(const SolidBody& body, const SolidSupports& supports);

  int size() const override { return dofs_.unknowns(); }
  const SymmetricMatrix& sparsity() const override { return reduction_.sparsity(); }
  double residual(std::span<const double> y, double t, std::span<double> g) override;
  void stiffness(std::span<const double> y, double t, SymmetricMatrix& K, bool steepest = false) override;
  void change(std::span<const double> y, double t0, double t1, std::span<double> dg) override;
  double length() const override { return length_m_; }
  double reach() const override { return reach_m_; }
  std::string describe(std::span<const double> motion) const override;
  void mass(bool lumped, SymmetricMatrix& M) override;
  /// Zero: solids have no damping of their own.
  void damping(std::span<const double> y, double t, bool lumped, bool stiffness_part, SymmetricMatrix& D) override;

  const SolidBody& body() const { return body_; }
  /// Other programs from now on. Throws InputError where there are not as many as before.
  void setPrograms(std::vector<Program> programs);
  const DofMap& dofs() const { return dofs_; }
  /// Positions of all nodes.
  std::vector<Vec3> positions(std::span<const double> y, double t) const;
  /// What supports push with on all nodes: internal less external forces [N].
  std::vector<Vec3> reactions(std::span<const double> y, double t);
  /// Stored energy [J].
  double energy(std::span<const double> y, double t);

 private:
  std::vector<double> programValues(double t) const;
  /// f = internal - external forces on all nodes; returns the size of either.
  double balance(std::span<const Vec3> x, double t);

  const SolidBody& body_;
  std::vector<NodeForce> forces_;
  std::vector<Program> programs_;
  DofMap dofs_;
  Reduction reduction_;
  double length_m_ = 0, reach_m_ = 0, energy_J_ = 0;
  SolidWork work_;
  BlockMatrix K_;
  std::vector<Vec3> force_;
};

}  // namespace gambeson
