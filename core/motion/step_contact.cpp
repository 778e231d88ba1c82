#include "core/motion/step_contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "core/math/parallel.hpp"
#include "core/motion/body_edges.hpp"
#include "core/motion/clearance.hpp"
#include "core/motion/closest_projection.hpp"
#include "core/motion/contradict.hpp"
#include "core/motion/held_motion.hpp"
#include "core/motion/provot_projection.hpp"
#include "core/motion/sewing.hpp"
#include "core/motion/step_method.hpp"
#include "core/motion/step_rows.hpp"

namespace gambeson {
namespace {

constexpr int kRounds = 8;  ///< of solves
constexpr int kImpactZoneRounds = 12;

/// Rows give way by this part of what their own impulse would move the cloth at them, B 1/rho in the mean:
/// contradicting rows then share what they miss in proportion to their impulses. These are bounded (by 1/part of what
/// stops the cloth), the solve converges, and no more energy enters than what bodies and targets do: with D(tau) =
/// tau.A.tau/2 + tau.(v - target) + |yield| <= D(0) = 0, the work tau.(v + A tau/2) is at most tau.target.
struct Yield {
  static constexpr double kLittle = 1e-4;  ///< cloth jammed in a fold, which bears 8 % less then (a third with much)
  static constexpr double kMuch = 1e-2;    ///< cloth between bodies that close on it
  double part = 0;                         ///< that is needed in this step
};

/// What a row of compliance zero would yield per impulse if it gave way altogether: B 1/rho [m/s per N s/m^2].
double givesPerImpulse(const Model& m, const ContactRow& row) {
  double sum = 0;
  for (int k = 0; k < row.stencil.count; ++k)
    sum += std::abs(row.stencil.weight[k]) / m.density_kg_per_m2[row.stencil.sample[k]];
  return sum;
}

/// Whether rows that yield by `part` miss more than half of their layer in the relaxation time.
bool missTooMuch(const Model& m, double part, const StepWork& w) {
  for (std::size_t i = 0; i < w.rows.size(); ++i)
    if (part * givesPerImpulse(m, w.rows[i]) * dot(w.warm[i], w.rows[i].contact.normal) >
        layerOf(m, w.rows[i]) / (2 * m.contact.relaxation_s))
      return true;
  return false;
}

/// The free points under a contact and their parts in it.
struct PointWeights {
  std::vector<int> points;
  std::vector<double> weight;
};

/// How far a contact gives way along its normal for all that holds the cloth: per impulse, in parts of what it would
/// without. `at`: scratch.
double givesWay(const Model& m, const ContactRow& row, PointWeights& at) {
  at.points.clear();
  at.weight.clear();
  bool bound = false;
  for (int k = 0; k < row.stencil.count; ++k) {
    const int s = row.stencil.sample[k];
    for (int e = m.surface.WT.offsets[s]; e < m.surface.WT.offsets[s + 1]; ++e) {
      const int i = m.surface.WT.columns[e];
      bound = bound || takesHold(m, i);
      const auto slot = static_cast<std::size_t>(std::find(at.points.begin(), at.points.end(), i) - at.points.begin());
      if (slot == at.points.size()) {
        at.points.push_back(i);
        at.weight.push_back(0);
      }
      at.weight[slot] += row.stencil.weight[k] * m.surface.WT.values[e];
    }
  }
  if (!bound) return 1;
  if (m.supports && m.supports->couple()) return m.supports->givesWay(at.points, at.weight, row.contact.normal);
  double whole = 0, left = 0;
  for (std::size_t a = 0; a < at.points.size(); ++a) {
    whole += at.weight[a] * at.weight[a] / m.mass_kg[at.points[a]];
    left += at.weight[a] * at.weight[a] * m.inverse_mass[at.points[a]];
  }
  return left / whole;
}

/// w.velocity after the contacts w.rows, which yield as they did before in this step. `limits`: null, or the strain
/// limits that go along.
void solveRows(const Model& m, double dt, MotionHold* limits, Yield& yield, StepReport& report, StepWork& w) {
  if (m.method) {
    report.contact = solveByMethod(m, dt, w);
    return;
  }
  std::optional<SupportHold> supported;
  MotionHold* hold = limits;
  if (m.supports && m.supports->couple()) {
    hold = &supported.emplace(*m.supports, limits);
    constexpr double kNothing = 1e-9;
    PointWeights scratch;
    for (ContactRow& row : w.rows) row.fixed = !(givesWay(m, row, scratch) > kNothing);
  }
  std::optional<SewnHold> sewn;
  if (!m.sewing.empty() && someSeamsHold(w) && contactsMeetSeams(m, w.rows)) hold = &sewn.emplace(m, w.sewn_open);
  const auto solve = [&](std::span<const ContactRow> rows) {
    return solveContacts(rows, m.surface.WT, m.inverse_mass, m.surface.area_m2, m.density_kg_per_m2, m.place, m.contact,
                         dt, w.velocity, w.warm, w.impulses, w.contact, hold, w.slip);
  };
  w.unsolved = w.velocity;
  int before = 0;
  if (yield.part == 0 || limits) {
    report.contact = solve(w.rows);
    if (!contradict(report.contact, dt) || limits) return;  // limits yield before contacts do
    before = report.contact.iterations;
    yield.part = Yield::kLittle;
    std::fill(w.warm.begin(), w.warm.end(), Vec3{});
  }
  for (;;) {
    w.yielding = w.rows;
    for (ContactRow& row : w.yielding) row.compliance += yield.part * givesPerImpulse(m, row);
    w.velocity = w.unsolved;
    report.contact = solve(w.yielding);
    report.contact.iterations += before;
    report.contact.yielded = true;
    if (yield.part == Yield::kMuch || !(missTooMuch(m, yield.part, w) || contradict(report.contact, dt))) return;
    before = report.contact.iterations;
    yield.part = Yield::kMuch;
    std::fill(w.warm.begin(), w.warm.end(), Vec3{});
  }
}

/// What the contacts' impulses alone do to the free points [m/s].
void contactChange(const Model& m, StepWork& w, std::vector<Vec3>& change) {
  contactImpulses(m, w, change);
  for (int i = 0; i < m.freeCount(); ++i) change[i] *= m.inverse_mass[i];
  if (m.supports) m.supports->hold(change);
}

/// Velocities of the half step after contacts and strain limits; w.rows stay what they are. Each turn projects the
/// strains with the contacts' impulses as they are, then solves for the contacts while limits of equality go along
/// (StrainHold): what is left over is of second order in the step. Where the two contradict each other contacts have
/// the last word, and the report says that the step is not solved.
void solveVelocities(const Model& m, const State& in, double dt, bool first, Yield& yield, StepReport& report,
                     StopWatch& clock, StepWork& w) {
  const StrainLimit& limit = m.strain_limit;
  if (limit.mode == LimitMode::none) {
    w.velocity = w.predictor;
    solveRows(m, dt, nullptr, yield, report, w);
    clock.lap(w.times.contact);
    return;
  }
  const int n = m.freeCount();
  std::vector<Vec3>&end = w.limit_end, &change = w.limit.contact_change;
  end.resize(n);
  w.velocity.resize(n);
  const auto move = [&] {  // with the impulses of limits and contacts as they are
    if (m.supports) {
      w.released.resize(n);
      applyMobility(m.strain_rows.mobility, w.limit.pull, w.released);
    }
    for (int i = 0; i < n; ++i) {
      w.velocity[i] = m.supports ? w.predictor[i] - w.released[i] / dt + change[i]
                                 : w.predictor[i] - (m.inverse_mass[i] / dt) * w.limit.pull[i] + change[i];
      end[i] = in.p[i] + dt * w.velocity[i];
    }
  };
  // Threads that may slacken pull only: the linear problem with contacts is no longer one that a factor solves. Limits
  // of that kind and contacts take turns.
  const bool together = limit.mode == LimitMode::equality;
  const int most_turns = together ? limit.max_rounds : limit.max_turns;
  const auto contactsAlone = [&] {
    for (int i = 0; i < n; ++i) w.velocity[i] -= change[i];
    solveRows(m, dt, nullptr, yield, report, w);
    contactChange(m, w, change);
    move();
  };
  for (int turn = 1;; ++turn) {
    move();
    // The first turn solves both where the step would go without them, at once: a tension and the contacts that bear it
    // move the cloth far one by one, and hardly together.
    const int most = together && turn == 1 && !w.rows.empty() ? 1 : limit.max_projections;
    if (limit.method == LimitMethod::closest)
      projectClosest(m.strain_rows, limit, end, report.limit, w.limit);
    else if (limit.method == LimitMethod::provot)
      projectOneByOne(m.strain_rows, limit, end, report.limit, w.limit);
    else
      projectStrain(m.strain_rows, limit, first && turn == 1 && limit.always, end, report.limit, w.limit, most);
    ++report.limit.rounds;
    clock.lap(w.times.limit);
    move();
    if (w.rows.empty()) {
      w.impulses.clear();
      break;
    }
    if (together) {
      StrainHold hold(m.strain_rows, limit, end, report.limit, w.limit);
      w.moved = change;
      hold.hold(w.moved);
      for (int i = 0; i < n; ++i) w.velocity[i] -= w.moved[i];  // as without contacts
      w.moved = change;
      solveRows(m, dt, &hold, yield, report, w);
      contactChange(m, w, change);
      for (int i = 0; i < n; ++i) w.moved[i] = dt * (change[i] - w.moved[i]);
      hold.follow(w.moved);
      move();
    } else {
      contactsAlone();
    }
    clock.lap(w.times.contact);
    report.limit.solved = unrestored(m.strain_rows, limit, end, w.limit) <= unrestoredTolerance(limit, w.limit);
    clock.lap(w.times.limit);
    // A residual that is not finite shows in the velocities.
    if ((report.limit.solved && report.contact.converged) || !allFinite(end)) break;
    if (turn < most_turns) continue;
    report.limit.solved = false;
    if (together && !report.contact.converged) contactsAlone();
    break;
  }
  report.limit.residual = limitResidual(m.strain_rows, limit, end, w.limit);
  report.limit.converged = report.limit.residual <= limit.tolerance;
  clock.lap(w.times.limit);
}

/// What would pass through what with w.velocity: w.hits and w.pair_hits.
bool anyImpact(const Model& m, double dt, StepWork& w) {
  w.x1.resize(m.surface.size());
  m.surface.WT.multiply<Vec3>(w.velocity, w.x1);
  const int samples = m.surface.size();
  forAll(Each::value, samples, [&](int s) { w.x1[s] = w.x0[s] + dt * w.x1[s]; });
  m.proximity->impacts(w.stage.start.obstacles, w.stage.end.obstacles, w.x0, w.x1, w.hits);
  std::erase_if(w.hits, [&](const SampleHit& hit) { return w.collisions.tangle[hit.sample] != Tangle::kFree; });
  moveVertices(w.x1, w.collisions);
  findImpacts(m.collisions, dt, w.inside, w.collisions, w.pair_hits);
  return !w.hits.empty() || !w.pair_hits.empty();
}

/// The rigid motion nearest to that of a body that deforms, around where an impact zone touches it: of all triangles
/// there.
RigidVelocity motionAround(const Model& m, const ImpactZone& zone, double dt, const StepWork& w) {
  const CollisionModel& c = m.collisions;
  const int first = c.bodies[c.body_of_obstacle[zone.body]].first_vertex;
  std::vector<int> around;
  for (int v : zone.touched)
    for (int t : c.mesh.vertex_faces[first + v])
      for (int corner : c.mesh.triangles[t]) around.push_back(corner - first);
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  const std::span<const Vec3> start = w.stage.start.vertices[zone.body], end = w.stage.end.vertices[zone.body];
  std::vector<Vec3> velocity(start.size());
  for (int v : around) velocity[v] = (end[v] - start[v]) / dt;
  return nearestRigid(around, start, std::vector<double>(start.size(), 1.0), velocity);
}

/// Moves what still meets in rigid impact zones, which grow until nothing does. An impact zone at a body moves with it,
/// one with a held point stays, or goes where that is moved. False where it is no use: pinched between bodies, or
/// never done.
bool moveImpactZones(const Model& m, const State& in, double dt, StepReport& report, StepWork& w) {
  ImpactZones impact_zones;
  std::vector<ContactRow> rows;
  w.impact_zone_change.assign(m.freeCount(), Vec3{});
  const std::vector<Vec3> solved = w.velocity;
  for (int round = 0; round < kImpactZoneRounds; ++round) {
    rows.clear();
    for (const SampleHit& hit : w.hits) rows.push_back(bodyRow(hit, {}, 0, true));
    for (const PairHit& hit : w.pair_hits) rows.push_back(hit.row);
    joinImpactZones(rows, m.surface.WT, impact_zones);
    w.velocity = solved;
    for (int z = 0; z < impact_zones.size(); ++z) {
      const ImpactZone zone = impact_zones[z];
      if (zone.pinched) return false;
      const auto first_held =
          std::find_if(zone.points.begin(), zone.points.end(), [&](int i) { return m.held[i] != 0; });
      const bool held = first_held != zone.points.end();
      if (zone.body >= 0) {
        if (held) return false;
        if (m.obstacles[zone.body].deforms) {
          const RigidVelocity body = motionAround(m, zone, dt, w);
          for (int i : zone.points) w.velocity[i] = body.at(in.p[i]);
        } else {
          for (int i : zone.points)
            w.velocity[i] =
                (w.stage.end.obstacles[zone.body] * toLocal(w.stage.start.obstacles[zone.body], in.p[i]) - in.p[i]) /
                dt;
        }
      } else if (held) {
        const int motion = m.held_motion.empty() ? -1 : m.held_motion[heldSlot(m, *first_held)];
        for (int i : zone.points)
          w.velocity[i] =
              motion < 0 ? (m.supports ? solved[*first_held] : Vec3{}) : (carried(w, motion, in.p[i]) - in.p[i]) / dt;
      } else {
        makeRigid(zone, in.p, m.mass_kg, w.velocity);
      }
    }
    report.impact_zones = impact_zones.size();
    if (m.supports) m.supports->drive(in.time_s, in.time_s + dt, w.velocity);
    driveHeld(m, in.p, dt, w, w.velocity);
    if (!allFinite(w.velocity) || !anyImpact(m, dt, w)) {
      w.impact_zones = std::move(impact_zones);
      for (int i = 0; i < m.freeCount(); ++i) w.impact_zone_change[i] = w.velocity[i] - solved[i];
      return true;
    }
  }
  return false;
}

/// What w.hits and w.pair_hits, which nothing keeps apart, say of the step.
void failForImpacts(const Model& m, StepReport& report, StepWork& w) {
  report.failure = StepFailure::impact;
  report.why = fmt::format("{} pairs would still pass through each other{}", w.hits.size() + w.pair_hits.size(),
                           w.hits.empty() ? "" : ", of the cloth into " + m.obstacles[w.hits[0].obstacle].segment);
  constexpr double kLittleWay = 1e-2;  // a triangle that is held at two corners and met near these
  w.stuck.clear();
  PointWeights scratch;
  const auto note = [&](const ContactRow& row, double time) {
    report.earliest_impact = std::min(report.earliest_impact, time);
    w.stuck.insert(w.stuck.end(), row.stencil.sample.begin(), row.stencil.sample.begin() + row.stencil.count);
    if (report.failure == StepFailure::held || !row.contact.onBody() || givesWay(m, row, scratch) > kLittleWay) return;
    Vec3 x{};
    for (int k = 0; k < row.stencil.count; ++k) x += std::abs(row.stencil.weight[k]) * w.x0[row.stencil.sample[k]];
    report.failure = StepFailure::held;
    report.why = fmt::format(
        "cloth that is held at {} and \"{}\" would pass through each other: what holds the cloth and the obstacle "
        "contradict each other; let one of them give way, or start or move it elsewhere",
        positionText(x), m.obstacles[row.contact.obstacle].segment);
  };
  for (const SampleHit& hit : w.hits) note(bodyRow(hit, {}, 0, true), hit.time);
  for (const PairHit& hit : w.pair_hits) note(hit.row, hit.time);
  std::sort(w.stuck.begin(), w.stuck.end());
  w.stuck.erase(std::unique(w.stuck.begin(), w.stuck.end()), w.stuck.end());
}

bool solved(const StepWork& w, StepReport& report) {
  if (allFinite(w.velocity)) return true;
  report.failure = StepFailure::not_finite;
  report.why = "a velocity is not finite after the contacts";
  return false;
}

}  // namespace

bool resolveContacts(const Model& m, const State& in, double dt, StepReport& report, StopWatch& clock, StepWork& w) {
  const int samples = m.surface.size();
  w.impact_zones.clear();
  report.smallest_gap_m = std::numeric_limits<double>::max();
  Yield yield;
  startProjection(m.strain_rows, in.limit_J, w.limit);
  leaveStrain(m.strain_rows, m.strain_limit, in.p, in.limit_J, dt, w.limit);
  if (!m.collisions.self && m.obstacles.empty()) {  // nothing to touch
    w.rows.clear();
    w.warm.clear();
    w.slip.clear();
    solveVelocities(m, in, dt, true, yield, report, clock, w);
    return solved(w, report);
  }
  w.sample_velocity.resize(samples);
  m.surface.WT.multiply<Vec3>(w.predictor, w.sample_velocity);
  w.reach.resize(samples);
  w.x1.resize(samples);
  forAll(Each::value, samples, [&](int s) {
    w.reach[s] = contactReach(std::max(m.layer_m[s], kLargestClearance_m)) + dt * norm(w.sample_velocity[s]);
    w.x1[s] = w.x0[s] + dt * w.sample_velocity[s];
  });
  placeVertices(m.collisions, in.time_s, dt, w.x0, motionOf(w), w.collisions);
  moveVertices(w.x1, w.collisions);
  listNear(m.collisions, w.collisions);
  m.proximity->near(w.stage.start.obstacles, w.stage.end.obstacles, w.x0, w.reach, w.near, &w.collisions.near_bodies,
                    &w.stage.surfaces);
  findClearances(m, w);
  dropUnreached(m.collisions, motionOf(w), w.collisions, w.near);
  w.inside.assign(samples, 0);
  for (const Contact& c : w.near) {
    report.deepest_m = std::max(report.deepest_m, -c.gap_m);
    if (!(c.gap_m > 0)) {
      w.inside[c.sample] = 1;
      if (std::holds_alternative<TriangleMesh>(m.obstacles[c.obstacle].shape)) ++report.inside;
    }
  }
  clock.lap(w.times.proximity);
  std::vector<Contour> contours;
  report.searched = (in.tangled || !in.pinched.empty()) && mayTangle(m.collisions);
  if (report.searched) contours = findTangles(m.collisions, w.collisions);
  report.intersections = static_cast<int>(contours.size());
  clock.lap(w.times.tangles);
  freeTangles(m.collisions, std::move(contours), dt, w.collisions, w.restoring);
  clock.lap(w.times.freeing);
  report.pinched = static_cast<int>(in.pinched.size());
  for (int s : in.pinched) w.collisions.tangle[s] = Tangle::kBeside;
  nearCloth(m.collisions, w.collisions);
  bodyEdgeRows(m.collisions, dt, w.inside, w.collisions, w.edge_rows);
  persistentRows(m, in, dt, w);
  for (const ContactRow& row : w.rows)
    report.smallest_gap_m = std::min(report.smallest_gap_m, row.contact.gap_m - standsOut(m, row));
  w.rows.insert(w.rows.end(), w.restoring.begin(), w.restoring.end());
  w.warm.resize(w.rows.size());
  if (m.contact.followsMotion()) w.slip.resize(w.rows.size());
  report.contacts = static_cast<int>(w.rows.size() - w.restoring.size());
  report.cloth_contacts = static_cast<int>(w.collisions.points.size());
  clock.lap(w.times.proximity);
  for (int round = 1;; ++round) {
    solveVelocities(m, in, dt, round == 1, yield, report, clock, w);
    if (!solved(w, report)) return false;
    const bool any = anyImpact(m, dt, w);
    clock.lap(w.times.impact);
    report.impact_rounds = round - 1;
    if (!any) return true;
    if (round == 1) report.impacts = static_cast<int>(w.hits.size() + w.pair_hits.size());
    if (round > kRounds) break;
    addImpacts(m, in, dt, round, w);
  }
  const bool done = moveImpactZones(m, in, dt, report, w);
  clock.lap(w.times.impact);
  if (done && allFinite(w.velocity)) return true;
  failForImpacts(m, report, w);
  return false;
}

}  // namespace gambeson
