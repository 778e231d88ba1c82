#pragma once
/// What the instruments of the virtual laboratory share: a specimen in its clamps, brought to equilibrium.

#include <memory>
#include <optional>
#include <vector>

#include "cases/fabric/laboratory.hpp"
#include "cases/structure/build.hpp"
#include "core/statics/path.hpp"
#include "core/statics/structure_system.hpp"

namespace gambeson::laboratory {

/// The specimen as a plate: its length along x, of as much width as a few cells. It is held at x = 0.
StructureCase caseOf(const Fabric& fabric, const Specimen& s, double length_m);

using Constraints = std::vector<LinearConstraint>;
/// All points that lie side by side across the width move alike along a direction.
void tieAcross(const Cloth& cloth, const Vec3& direction, Constraints& out);
/// No point moves along a direction: (0, 0, 1), and points stay in the plane.
void keepFrom(const Cloth& cloth, const Vec3& direction, Constraints& out);

/// A specimen in its clamps: equilibria at a value of the load's programs, of which those that are accepted count.
class Bench {
 public:
  template <class Constrain>
  Bench(const StructureCase& c, ProgramEnds ends, Constrain constrain) : sheet_(sheetOf(c)), ends_(ends) {
    std::shared_ptr<const Cloth> cloth = clothOf(c, sheet_);
    StructureOptions options = optionsOf(c, sheet_, *cloth);
    constrain(*cloth, options.constraints);
    begin(std::move(cloth), options);
  }

  const Structure& structure() const { return *structure_; }
  /// Equilibrium at t from the last one; its unknowns. Throws RunError where none is found.
  const std::vector<double>& settle(double t);
  void accept() { state_->lost_J += system_->commit(state_->y, state_->factor); }

  std::vector<Vec3> points() const { return controlPoints(*structure_, state_->y, state_->factor, ends_); }
  std::vector<Vec3> reactionForces() const {
    return reactions(*structure_, state_->y, state_->factor, ends_, system_->history());
  }
  double lost_J_per_m2() const { return state_->lost_J / area_m2_; }
  double load() const { return state_->factor; }

 private:
  void begin(std::shared_ptr<const Cloth> cloth, const StructureOptions& options);

  Sheet sheet_;
  ProgramEnds ends_;
  std::unique_ptr<Structure> structure_;
  std::optional<StructureSystem> system_;
  std::optional<PathState> state_;
  double area_m2_ = 0;
};

/// Where a place of the specimen is, of control points: s along its length, in the middle of its width.
class PlaceGauge {
 public:
  PlaceGauge(const Cloth& cloth, double s) : row_(cloth.mounting().place(0, cloth.placeOfDraft(0, {s, 0.5}))) {}
  Vec3 operator()(const std::vector<Vec3>& q) const {
    Vec3 p{};
    for (std::size_t k = 0; k < row_.columns.size(); ++k)
      p += row_.value[k] * q[static_cast<std::size_t>(row_.columns[k])];
    return p;
  }

 private:
  PlaceRow row_;
};

}  // namespace gambeson::laboratory
