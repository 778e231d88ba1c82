#pragma once
/// Sewn seams in explicit steps: exact, whatever the step, and without a smaller step. Internal to core/motion.
///
/// The rows C p = 0 of SewnRows are linear and constant, so the motion stays in a subspace: velocity Verlet with
///   (M + h D) a = F - C^T lambda,  C a = 0,   v(n+1/2) = v + dt/2 a,  C v(n+1/2) = r
/// is velocity Verlet of the constrained system, symplectic as before. Its frequencies interlace those of the unsewn
/// one (Cauchy), so that no stable step is shorter. Contacts see W - W C^T (C W C^T)^-1 C W in the place of W = M^-1
/// (SewnHold): contacts and seams are one problem, but for garments whose seams are far open (findOpenSeams). Rigid
/// impact zones, which come after all contacts, have the last word where they meet a seam; what they part closes as an
/// open seam does.

#include "core/contact/projecting_hold.hpp"
#include "core/motion/model.hpp"

namespace gambeson {

/// The rates at which the gaps of the rows change in a step that starts at p: those of a garment all close by the same
/// part of themselves in a second, close_per_s or what brings its widest to close_m_per_s. One part for all, as rates
/// - c C p can be had whatever rows nearly depend on each other. Gaps that are closed stay so: what rounding has left
/// of them is taken too.
void closingRates(const Model& model, std::span<const Vec3> p, double dt_s, StepScratch& work);

/// Makes w.predictor keep the seams; w.sewn_closing becomes what that gives all points, held ones too [N s].
void sewVelocities(const Model& model, std::span<const Vec3> p, double dt_s, StepWork& work);

/// From a = (M + h D)^-1 F to what the seams leave of it. Returns their forces on all points, w.sewn_force [N].
std::span<const Vec3> sewAccelerations(const Model& model, double half_step_s, std::span<Vec3> a, StepScratch& work);

/// Finds work.sewn_open by the rates: garments whose seams are still far open, as their widest gap closes as fast as
/// gaps may. Their rates are wishes then, which contact grants as far as it can: it does not see their seams, and what
/// it moves them by closes in later steps. A rough body between two edges contradicts a rate that must be kept by
/// whatever force. Where nothing rubs, none counts as far open: what contact gave one side alone would be brought
/// together in the next step, and seams would work on cloth that presses on itself.
void findOpenSeams(const Model& model, StepScratch& work);
/// Whether contact sees seams of any garment.
bool someSeamsHold(const StepScratch& work);

/// What the seams give all points while the contacts give them `impulses` is added to w.sewn_impulse [N s].
void addSeamsUnderContact(const Model& model, std::span<const Vec3> impulses, StepWork& work);

/// Work of the impulses with which seams close in a step [J], on points that go from `from` to `to`. Held ones count
/// too, where they are moved: what holds them bears the impulse, and has its work with the other sign.
double sewingWork(const Model& model, double dt_s, std::span<const Vec3> foreseen, std::span<const Vec3> from,
                  std::span<const Vec3> to, const StepWork& work);

/// The largest gap between the hats of any seam, in sides of its cell, with the free points at p (SewnRows::pairs).
double widestGap(const Model& model, std::span<const Vec3> p);

/// Gives all free points the mean of their masses. While seams close both points of a pair go to meet in the ratio of
/// their inverse masses, and neighbours whose ratios differ would be torn apart. Of a model that is moved for that
/// alone.
void evenMasses(Model& model);

/// The seams in the place of M^-1 for contacts.
class SewnHold : public ProjectingHold {
 public:
  /// `open`: rows that it leaves out (work.sewn_open). Lives no longer than both.
  SewnHold(const Model& model, std::span<const char> open)
      : model_(model), open_(open), all_(static_cast<std::size_t>(model.freeCount())) {}
  void hold(std::span<Vec3> change) const override { model_.sewing.hold(change, open_, work_); }
  void touch(std::span<const int> points) override;
  void holdTouched(std::span<Vec3> change) const override;
  PointTies ties(int free_point) const override;

 private:
  const Model& model_;
  std::span<const char> open_;
  std::vector<int> points_;
  std::vector<int> sewn_;  ///< of these, which a seam takes hold of: place in points_
  mutable SewnProjection::Work work_;
  mutable std::vector<Vec3> all_;
};

/// Whether contacts act on points that a seam takes hold of.
bool contactsMeetSeams(const Model& model, std::span<const ContactRow> rows);

}  // namespace gambeson
