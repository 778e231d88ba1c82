#pragma once
/// Detail of run.hpp: what is summed over the steps of a dynamic case between the rows of its table.

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "cases/structure/case.hpp"
#include "cases/structure/results.hpp"
#include "core/motion/model.hpp"
#include "core/motion/structure_motion.hpp"

namespace gambeson {

/// Work of the loads since rest. Where all of them are constant it is that of the displacements; else it is summed over
/// the steps, by the trapezium rule. (- F(t) . u is no potential where F changes with time.)
class LoadWork {
 public:
  explicit LoadWork(const Structure& s) : s_(s), varies_(s.loads.follow()) {
    for (const DeadLoad& load : s.dead) {
      const std::vector<double>& value = s.programs[load.program].value;
      varies_ = varies_ || std::any_of(value.begin(), value.end(), [&](double v) { return v != value[0]; });
    }
  }
  /// Call after each step, and once before the first.
  void follow(const State& state, bool lumped) {
    const bool first = q_.empty();
    if (!varies_ && !first) return;
    std::vector<Vec3> q = controlPoints(s_, state), force(q.size());
    s_.loads.add(q, programValues(s_, state.time_s, ProgramEnds::constant), force);
    if (first) work_J_ = -energyOf(s_, state, lumped).external;
    for (std::size_t i = 0; i < q_.size(); ++i) work_J_ += 0.5 * dot(force_[i] + force[i], q[i] - q_[i]);
    q_ = std::move(q);
    force_ = std::move(force);
  }
  double work_J(const DynamicEnergy& now) const { return varies_ ? work_J_ : -now.external; }

 private:
  const Structure& s_;
  bool varies_;
  std::vector<Vec3> q_, force_;
  double work_J_ = 0;
};

/// Contact over a run: what it came to, and the mean forces on the obstacles between two rows of the table.
class ContactTally {
 public:
  explicit ContactTally(const StructureCase& c) : impulse_(c.obstacles.size()) {
    columns_.push_back(contact_work_column);
    for (const ObstacleCase& o : c.obstacles)
      for (const char* axis : {"x", "y", "z"}) columns_.push_back(fmt::format("{}_f{}_N", o.name, axis));
  }
  const std::vector<std::string>& columns() const { return columns_; }

  void observe(const StepReport& r, const StepResult& result, ContactFacts& facts) {
    elapsed_s_ += r.step_s;
    facts.unsolved += !r.contact.converged || r.contact.yielded;
    facts.pinched += r.pinched > 0;
    facts.deepest_m = std::max(facts.deepest_m, r.deepest_m);
    facts.crossings = r.intersections;
    facts.work_J += r.work.contact;
    for (const ContactImpulse& i : result.contact_impulses) impulse_[static_cast<std::size_t>(i.obstacle)] -= i.impulse;
    held_.resize(result.held_impulses.size());
    for (std::size_t k = 0; k < held_.size(); ++k) held_[k] += result.held_impulses[k];
  }
  /// Mean forces of the supports on Model::held_points since the last row [N]; empty before the first step.
  std::vector<Vec3> heldForces() const {
    std::vector<Vec3> forces = held_;
    for (Vec3& f : forces) f = f / elapsed_s_;
    return forces;
  }
  /// A row of them; the next begins.
  std::vector<double> row(const ContactFacts& facts) {
    std::vector<double> values{facts.work_J};
    for (Vec3& i : impulse_) {
      const Vec3 force = elapsed_s_ > 0 ? i / elapsed_s_ : Vec3{};
      values.insert(values.end(), {force.x, force.y, force.z});
      i = {};
    }
    held_.clear();
    elapsed_s_ = 0;
    return values;
  }

 private:
  std::vector<std::string> columns_;
  std::vector<Vec3> impulse_;  ///< on the obstacles
  std::vector<Vec3> held_;     ///< on the held points
  double elapsed_s_ = 0;
};

}  // namespace gambeson
