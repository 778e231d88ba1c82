#include "core/contact/response.hpp"

#include <algorithm>
#include <cmath>

#include "core/contact/contact_iteration.hpp"
#include "core/contact/contact_rows.hpp"
#include "core/contact/held_iteration.hpp"
#include "core/contact/iteration_lanes.hpp"
#include "core/contact/newton_rows.hpp"
#include "core/contact/row_sweep.hpp"
#include "core/math/parallel.hpp"

namespace gambeson {
namespace {

/// Of a pressure, in its mean over the relaxation time.
double countsAtMost(double mean_Pa, double density) { return 2 * mean_Pa + 9.81 * density; }

/// The part of a pressure that no impact makes: what is beyond that of cloth stopped from 5 m/s in the step. Cloth is
/// jammed there, in a fold.
double beyondImpact(double pressure_Pa, double dt, double density) {
  constexpr double kFast_mps = 5;
  return std::max(0.0, 1 - density * kFast_mps / (dt * pressure_Pa));
}

constexpr double kOfLargestHeld = 2e-4;  ///< of the largest impulse, with a hold that bears tension
constexpr int kFollows = 40;             ///< rounds in which friction follows the motion; a few are the rule
constexpr int kSweepsBeforeNewton = 320;
constexpr double kStill = 4;             ///< goals; what sticks is as slow as that

/// What one solve is given.
struct Problem {
  std::span<const ContactRow> rows;
  const SparseRows& WT;
  std::span<const double> inverse_mass, density;
  std::span<const int> place;
  std::span<const Vec3> velocity;
  const ContactParameters& parameters;
  double dt;
};

/// Makes w.order of the rows that are in, those of one sample side by side.
void choose(const Problem& p, ContactWork& w) {
  w.order.clear();
  for (int i = 0; i < static_cast<int>(p.rows.size()); ++i)
    if (w.in[i]) w.order.push_back(i);
  std::stable_sort(w.order.begin(), w.order.end(),
                   [&](int a, int b) { return p.rows[a].stencil.sample[0] < p.rows[b].stencil.sample[0]; });
  reachRows(p.rows, p.WT, p.inverse_mass, p.velocity, w);
  restrict(p.rows, p.WT.column_count, p.inverse_mass, p.density, p.place, p.velocity, w);
  if (w.hold && !w.hold->projects()) largestBounds(w);  // before velocities are set: it works in their arrays
}

/// Looks at the rows that are left out, at the velocities w.now: the largest residual among them; those that would be
/// penetrated are marked in w.joins.
double leftOut(const Problem& p, ContactWork& w) {
  const int n = static_cast<int>(p.rows.size());
  w.joins.resize(n);
  return std::sqrt(largestOf(Each::sum, n, 0.0, [&](int i) {
    w.joins[i] = 0;
    if (w.in[i] || w.area_of[i] == 0) return 0.0;
    const Vec3 v = velocityAt(p.rows[i], p.WT, w.now);
    const Vec3& normal = p.rows[i].contact.normal;
    if (!(dot(v, normal) < 0)) return 0.0;
    w.joins[i] = 1;
    return norm2(project(-v, normal, w.slip[i].friction, w.slip[i].drag));
  }));
}

/// Takes in what w.joins marks. The others keep their place in the iteration; islands that grow together go on with the
/// least momentum of them.
void join(const Problem& p, ContactWork& w) {
  const int n = static_cast<int>(p.rows.size());
  w.kept_candidate.assign(n, {});
  w.kept_previous.assign(n, {});
  w.kept_island.assign(n, -1);
  for (std::size_t i = 0; i < w.islands.size(); ++i)
    for (int k = w.islands[i].row; k < w.islands[i].row_end; ++k) {
      w.kept_candidate[w.order[k]] = w.candidate[k];
      w.kept_previous[w.order[k]] = w.previous[k];
      w.kept_island[w.order[k]] = static_cast<int>(i);
    }
  w.kept_islands = w.islands;
  w.kept_points = w.free_points;
  w.kept_moved = w.moved;
  w.kept_moved_before = w.moved_before;
  for (int i = 0; i < n; ++i) w.in[i] = w.in[i] || w.joins[i];
  choose(p, w);
  // What joins carries nothing yet: no point moves otherwise for it.
  w.moved = w.moved_before = w.base;
  for (std::size_t k = 0; k < w.kept_points.size(); ++k) {
    const int slot = w.free_slot[w.kept_points[k]];
    w.moved[slot] = w.kept_moved[k];
    w.moved_before[slot] = w.kept_moved_before[k];
  }
  for (ContactWork::Island& island : w.islands) {
    const ContactWork::Island* slowest = nullptr;
    bool same = true;
    for (int k = island.row; k < island.row_end; ++k) {
      w.candidate[k] = w.kept_candidate[w.order[k]];
      w.previous[k] = w.kept_previous[w.order[k]];
      const int kept = w.kept_island[w.order[k]];
      const ContactWork::Island* old = kept < 0 ? nullptr : &w.kept_islands[kept];
      same = same && old && (!slowest || slowest == old);
      if (old && (!slowest || old->momentum < slowest->momentum)) slowest = old;
    }
    if (!slowest) continue;
    island.beta = slowest->beta;
    island.momentum = slowest->momentum;
    island.caution = slowest->caution;
    island.iterations = slowest->iterations;
    island.residual_m_per_s = slowest->residual_m_per_s;
    island.done = same && slowest->done;
  }
  for (const ContactWork::Island& island : w.islands) {
    if (!island.held) continue;
    moveHeld(w.previous, island, w, w.moved_before);
    moveHeld(w.candidate, island, w, w.moved);
  }
}

bool anyJoins(const ContactWork& w) { return std::find(w.joins.begin(), w.joins.end(), 1) != w.joins.end(); }

/// The rows that carried something and those that would be penetrated with what they carried, all rows that a hold ties
/// together; the iteration stands at its start.
void begin(const Problem& p, std::span<const Vec3> warm, ContactWork& w) {
  const int n = static_cast<int>(p.rows.size());
  w.in.resize(n);
  const bool ties_all = w.hold && !w.hold->projects();
  for (int i = 0; i < n; ++i) w.in[i] = w.area_of[i] > 0 && (ties_all || !(warm[i] == Vec3{}));
  smoothWarm(p.rows, p.WT, p.inverse_mass, warm, w);
  w.impulses.resize(n);
  forAll(Each::sum, n, [&](int i) {
    w.impulses[i] = {};
    if (w.start[i] == Vec3{}) return;
    w.start[i] = project(w.start[i], p.rows[i].contact.normal, w.slip[i].friction, w.slip[i].drag);
    w.impulses[i] = w.area_of[i] * w.start[i];
  });
  spreadImpulses(p.rows, p.WT, p.inverse_mass, w.impulses, w);
  w.now = w.change;
  if (w.hold && w.hold->projects()) w.hold->hold(w.now);
  forAll(Each::value, static_cast<int>(w.now.size()), [&](int f) { w.now[f] = p.velocity[f] + w.now[f]; });
  leftOut(p, w);
  for (int i = 0; i < n; ++i) w.in[i] = w.in[i] || w.joins[i];
  choose(p, w);
  for (std::size_t k = 0; k < w.order.size(); ++k) w.traction[k] = w.start[w.order[k]];
  startIteration(w);
}

/// What pressure and direction have of the friction of a row. `along`: its slip, or the traction that holds it.
double factorOf(const FrictionLaw& law, double pressure_Pa, const Vec3& along, const Vec3& normal,
                const RowSlip& slip) {
  const Vec3 t = along - dot(along, normal) * normal;
  const double size2 = norm2(t), to_weft = dot(t, slip.weft);
  // Where nothing pulls yet, the most that any direction holds: what does pull then says.
  const double towards =
      size2 > 0 ? law.towards(std::min(to_weft * to_weft / size2, 1.0)) : std::max(1.0, law.along_warp);
  return law.atPressure(pressure_Pa) * towards;
}

/// Friction of the rows as they move now: mu and drag of a law.
void setFriction(const FrictionLaw& law, double factor, double dt, RowSlip& slip) {
  slip.friction = factor * (slip.slips ? law.slipping(slip.speed_m_per_s) : law.still);
  slip.drag = slip.slips ? dt * law.drag(slip.speed_m_per_s) : 0;
}

/// Friction of all rows at the start.
void startFriction(const Problem& p, std::span<const RowSlip> slip, std::span<const Vec3> warm, ContactWork& w) {
  const int n = static_cast<int>(p.rows.size());
  w.slip.resize(n);
  w.any_slips = countOf(Each::sum, n, [&](int i) {
                  w.slip[i] = {};
                  const ContactRow& row = p.rows[i];
                  if (row.slippery) return false;
                  const FrictionLaw& law = p.parameters.frictionOf(row);
                  w.slip[i].friction = law.kinetic;
                  if (law.isCoulomb() || slip.empty()) return false;
                  w.slip[i] = slip[i];
                  const Vec3& normal = row.contact.normal;
                  const double factor = factorOf(law, dot(warm[i], normal) / p.dt, warm[i], normal, w.slip[i]);
                  setFriction(law, factor, p.dt, w.slip[i]);
                  return true;
                }) > 0;
}

/// Lets the friction of rows that carry something follow the velocities that they have now. False: it is what it was,
/// within `goal`; else the islands of those that changed are no longer done.
bool followSlip(const Problem& p, double goal, ContactWork& w) {
  bool any = false;
  for (ContactWork::Island& island : w.islands) {
    bool changed = false;
    for (int k = island.row; k < island.row_end; ++k) {
      const ContactRow& row = p.rows[w.order[k]];
      if (row.slippery || w.row_area[k] == 0) continue;
      const FrictionLaw& law = p.parameters.frictionOf(row);
      if (law.isCoulomb()) continue;
      const double* lane = w.candidate[k].lane;
      const Vec3 traction{lane[0], lane[1], lane[2]}, over = slipOf(w, k);
      const double pressed = dot(traction, row.contact.normal);
      RowSlip& slip = w.slip[w.order[k]];
      slip.speed_m_per_s = norm(over);
      const double factor = factorOf(law, pressed / p.dt, slip.slips ? over : traction, row.contact.normal, slip);
      const bool breaks = !slip.slips && !slip.broke && slip.speed_m_per_s > kStill * goal;
      if (breaks) {
        slip.slips = slip.broke = true;
        slip.friction = law.kinetic * factor;
        slip.drag = 0;
      } else {
        setFriction(law, factor, p.dt, slip);
      }
      ContactWork::Row& facts = w.facts[k];
      const double change = std::abs(slip.friction - facts.friction) * pressed + std::abs(slip.drag - facts.drag);
      if (!(change * facts.slope > goal)) continue;
      facts.friction = slip.friction;
      facts.drag = slip.drag;
      changed = true;
    }
    if (changed) island.done = false, any = true;
  }
  return any;
}

/// w.now, of the rows that are iterated on as they are. Points that a hold takes along may be no row's.
void findVelocities(const Problem& p, ContactWork& w) {
  if (!w.hold || !w.hold->projects()) {
    for (std::size_t f = 0; f < w.free_points.size(); ++f) w.now[w.free_points[f]] = vec(w.moved[f]);
    return;
  }
  std::fill(w.impulses.begin(), w.impulses.end(), Vec3{});
  for (std::size_t k = 0; k < w.order.size(); ++k) w.impulses[w.order[k]] = w.row_area[k] * vec(w.candidate[k]);
  spreadImpulses(p.rows, p.WT, p.inverse_mass, w.impulses, w);
  w.hold->hold(w.change);
  forAll(Each::value, static_cast<int>(w.now.size()), [&](int f) { w.now[f] = p.velocity[f] + w.change[f]; });
}

ContactSolve solve(const Problem& p, double goal, int max_iterations, ContactWork& w) {
  ContactSolve report;
  const bool ties_all = w.hold && !w.hold->projects();
  int follows = 0;
  for (int check = std::min(kFirstCheck, max_iterations);; check = std::min(2 * check, max_iterations)) {
    iterate(goal, check, max_iterations, w);
    if (p.parameters.newton && !ties_all && check >= kSweepsBeforeNewton) finishByNewton(goal, w);
    findVelocities(p, w);
    report.residual_m_per_s = leftOut(p, w);
    report.converged = report.residual_m_per_s <= goal;
    for (const ContactWork::Island& island : w.islands) {
      report.residual_m_per_s = std::max(report.residual_m_per_s, island.residual_m_per_s);
      report.iterations = std::max(report.iterations, island.iterations);
      report.converged = report.converged && island.done;
    }
    if (report.converged && w.any_slips && check < max_iterations && follows++ < kFollows && followSlip(p, goal, w)) {
      check = std::max(report.iterations, kFirstCheck);  // twice as many come next
      continue;
    }
    if (report.converged || check >= max_iterations) return report;
    if (anyJoins(w)) join(p, w);
  }
}

}  // namespace

namespace {

const FrictionLaw* own(const std::vector<std::optional<FrictionLaw>>& list, int index) {
  const auto at = static_cast<std::size_t>(index);
  return index >= 0 && at < list.size() && list[at] ? &*list[at] : nullptr;
}

}  // namespace

const FrictionLaw& ContactParameters::frictionOf(const ContactRow& row) const {
  if (!row.contact.onBody()) return on_cloth ? *on_cloth : friction;
  if (const FrictionLaw* of = own(of_obstacle, row.contact.obstacle)) return *of;
  if (!garment_of_sample.empty() && row.stencil.count > 0)
    if (const FrictionLaw* of = own(of_garment, garment_of_sample[static_cast<std::size_t>(row.stencil.sample[0])]))
      return *of;
  return friction;
}

bool ContactParameters::followsMotion() const {
  const auto any = [](const std::vector<std::optional<FrictionLaw>>& list) {
    return std::any_of(list.begin(), list.end(), [](const auto& f) { return f && !f->isCoulomb(); });
  };
  return !friction.isCoulomb() || (on_cloth && !on_cloth->isCoulomb()) || any(of_obstacle) || any(of_garment);
}

bool ContactParameters::followsThreads() const {
  const auto any = [](const std::vector<std::optional<FrictionLaw>>& list) {
    return std::any_of(list.begin(), list.end(), [](const auto& f) { return f && f->goesWithDirection(); });
  };
  return friction.goesWithDirection() || (on_cloth && on_cloth->goesWithDirection()) || any(of_obstacle) ||
         any(of_garment);
}

ContactRow bodyRow(const Contact& contact, const Vec3& body_velocity, double target, bool impact) {
  ContactRow row{contact, {}, body_velocity, target, impact};
  row.stencil.add(contact.sample, 1);
  return row;
}

double persistentTarget(double gap, double dt, const ContactParameters& c) {
  const double depth = c.layer_m - gap;
  return depth > 0 ? -std::expm1(-dt / c.relaxation_s) * depth / dt : depth / dt;
}

double lastingPressure(double mean, double pressure, double dt, double density, const ContactParameters& c) {
  return mean - std::expm1(-dt / c.relaxation_s) * (std::min(pressure, countsAtMost(mean, density)) - mean);
}

double lastingShare(double mean, double pressure, double density) {
  return pressure > 0 ? std::min(1.0, countsAtMost(mean, density) / pressure) : 0;
}

void layerUnder(double last, double dt, double density, const ContactParameters& c, ContactRow& row) {
  const double gap = row.contact.gap_m;
  row.target_m_per_s = persistentTarget(gap, dt, c);
  row.compliance = 0;
  if (!atLayer(gap, c.layer_m)) return;
  const double k = -std::expm1(-dt / c.relaxation_s), gives = k * c.compliance_m_per_Pa / dt;
  const double counted =
      last > 0 ? std::max(lastingShare(row.mean_Pa, last, density), beyondImpact(last, dt, density)) : row.mean_Pa > 0;
  row.target_m_per_s -= gives * (1 - k) * row.mean_Pa;
  row.compliance = gives * k * counted / dt;
}

ContactSolve solveContacts(std::span<const ContactRow> rows, const SparseRows& WT, std::span<const double> inverse_mass,
                           std::span<const double> area, std::span<const double> density, std::span<const int> place,
                           const ContactParameters& c, double dt, std::span<Vec3> velocity, std::span<Vec3> warm,
                           std::vector<Vec3>& impulses, ContactWork& w, MotionHold* hold, std::span<RowSlip> slip) {
  impulses.assign(rows.size(), {});
  w.hold = hold;
  if (rows.empty()) return {};
  const Problem problem{rows, WT, inverse_mass, density, place, velocity, c, dt};
  shareAreas(rows, WT, area, inverse_mass, w);
  w.reach.assign(rows.size(), {});
  w.reach_point.clear();
  w.reach_weight.clear();
  startFriction(problem, slip, warm, w);
  begin(problem, warm, w);
  double goal = c.tolerance_m_per_s2 * dt;
  double largest = 0;
  for (std::size_t k = 0; k < w.order.size(); ++k) largest = std::max(largest, w.facts[k].slope * norm(w.traction[k]));
  const bool tension = hold && hold->bearsTension();
  goal = tension ? std::max(goal, kOfLargestHeld * largest) : goalOf(goal, largest);
  const ContactSolve report = solve(problem, goal, c.max_iterations, w);

  std::copy_n(w.slip.begin(), slip.size(), slip.begin());
  std::fill(warm.begin(), warm.end(), Vec3{});
  forAll(Each::value, static_cast<int>(w.order.size()), [&](int k) {
    const int i = w.order[k];
    warm[i] = vec(w.candidate[k]);
    impulses[i] = w.row_area[k] * warm[i];
  });
  spreadImpulses(rows, WT, inverse_mass, impulses, w);
  if (hold) hold->hold(w.change);
  forAll(Each::value, static_cast<int>(velocity.size()), [&](int f) { velocity[f] += w.change[f]; });
  return report;
}

}  // namespace gambeson
