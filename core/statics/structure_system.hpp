#pragma once
/// A structure as the solvers' system.

#include <limits>
#include <vector>

#include "core/cloth/law_range.hpp"
#include "core/statics/structure.hpp"
#include "core/statics/system.hpp"

namespace gambeson {

class StructureSystem : public System {
 public:
  StructureSystem(const Structure& structure, ProgramEnds ends);

  int size() const override { return structure_.dofs.unknowns(); }
  const SymmetricMatrix& sparsity() const override { return structure_.reduction.sparsity(); }
  std::vector<double> start() const override;
  void retract(std::span<const double> y, std::span<const double> dy, double s, double t,
               std::span<double> out) const override;
  double residual(std::span<const double> y, double t, std::span<double> g) override;
  void stiffness(std::span<const double> y, double t, SymmetricMatrix& K, bool steepest = false) override;
  void stiffnessInMotion(std::span<const double> y, double t, SymmetricMatrix& K) override;
  double looseness() const override;
  void change(std::span<const double> y, double t0, double t1, std::span<double> dg) override;
  double length() const override { return length_; }
  double reach() const override { return reach_; }
  std::span<const double> history() const override { return history_; }
  void setHistory(std::span<const double> history, double t = 0) override;
  double commit(std::span<const double> y, double t) override;
  std::string describe(std::span<const double> motion) const override;
  std::string whyNotFinite() const override;
  /// Of the last state tried since the last commit whose forces were not finite; no points: there was none.
  LawRange unanswered() const;
  /// How many such states were tried.
  long unansweredTries() const { return lost_tries_; }
  void mass(bool lumped, SymmetricMatrix& M) override;
  void damping(std::span<const double> y, double t, bool lumped, bool stiffness_part, SymmetricMatrix& D) override;
  void dropIdle(std::span<const double> y, double t, std::span<double> rate) const override;
  bool hasStiffnessDamping() const override { return structure_.rayleigh_stiffness_s > 0 || structure_.cloth->damps(); }
  void supportForce(double t, double dt, bool lumped, SupportForces which, std::span<double> f) override;

 private:
  void place(std::span<const double> y, double t);  ///< sets value_ and q_
  /// At t: a load step takes no time that laws could count.
  ClothState stateAt(double t) const {
    return {q_,
            inner_,
            history_,
            {},
            ends_ == ProgramEnds::constant ? t - committed_t_ : std::numeric_limits<double>::infinity()};
  }
  /// Writes the forces on the blocks of all free points and inner unknowns.
  void pullBack(const std::vector<Vec3>& f, std::span<const double> inner, std::vector<double>& out) const;
  void assemble(std::span<const double> y, double t);
  void assemble(std::span<const double> y, double t, const ForceTerms& terms);
  BlockMatrix massBlocks(bool lumped) const;

  const Structure& structure_;
  ProgramEnds ends_;
  double length_ = 0, reach_ = 0;
  ClothWork work_;
  std::vector<double> history_, trial_;
  double committed_t_ = 0;
  ClothEnergy energy_;        ///< of the laws that remember, at the last residual
  std::vector<Vec3> lost_q_;  ///< of the last state that was tried and had no finite forces
  std::vector<double> lost_inner_;
  long lost_tries_ = 0;
  std::vector<double> residual_y_;
  double residual_t_ = 0;
  BlockMatrix K_;
  std::vector<double> at_y_;  ///< where K_ is
  double at_t_ = 0;
  std::vector<double> value_, u_, damping_u_;
  std::vector<Vec3> q_, f_, external_;
  std::vector<double> inner_, inner_f_, inner_external_;
  std::vector<double> free_;  ///< forces by the components of the blocks
  BlockMatrix damping_K_;
};

std::vector<double> programValues(const Structure& structure, double t, ProgramEnds ends);
/// Displacements of the free points and changes of the inner unknowns, u = C y + shifts. Of inner values that turn they
/// are the sum of the changes that led there, which says nothing of where they are.
std::vector<double> freeDisplacements(const Structure& structure, std::span<const double> y,
                                      std::span<const double> value);

/// The values of the inner unknowns in a state y. Those that turn (Cloth::turnsInner) stand behind the unknowns as they
/// would be without what supports turn, which is done to them last; a state without them has turned from the start at
/// once.
std::vector<double> innerValues(const Structure& structure, std::span<const double> y, std::span<const double> value);
/// The values behind the unknowns that make these inner values; none where they do not turn.
std::vector<double> turnedValues(const Structure& structure, std::span<const double> inner,
                                 std::span<const double> value);

/// In words, what a motion moves that meets no stiffness: rigid motions that the supports allow, else the place where
/// it is largest.
std::string describeMotion(const Structure& structure, std::span<const double> motion);

}  // namespace gambeson
