#include "core/motion/step_contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <tuple>

#include "core/math/parallel.hpp"
#include "core/motion/body_edges.hpp"
#include "core/motion/clearance.hpp"
#include "core/motion/closest_projection.hpp"

namespace gambeson {
namespace {

/// The sum of both sides' thicknesses; weights of a side add up to 1, a body has none.
double clothLayer(const Model& m, const ContactRow& row) {
  double sum = 0;
  for (int k = 0; k < row.stencil.count; ++k) sum += std::abs(row.stencil.weight[k]) * m.layer_m[row.stencil.sample[k]];
  return sum;
}

}  // namespace

double layerOf(const Model& m, const ContactRow& row) {
  const double sum = clothLayer(m, row);
  return row.contact.onBody() ? std::max(sum, row.contact.clearance_m) : 0.5 * sum;
}

MaterialPoint nearestTouched(const Model& m, const ImpactZone& zone, const Vec3& p, const StepWork& w) {
  MaterialPoint point;
  if (!m.obstacles[zone.body].deforms) return point;
  const std::span<const Vec3> x = w.stage.start.vertices[zone.body];
  point.add(*std::min_element(zone.touched.begin(), zone.touched.end(),
                              [&](int a, int b) { return norm2(x[a] - p) < norm2(x[b] - p); }),
            1);
  return point;
}

namespace {

constexpr int kRounds = 8;  ///< of solves
constexpr int kImpactZoneRounds = 12;

/// How far the cloth between the samples stands out from them towards the body: its gap is so much smaller than theirs.
double standsOut(const Model& m, const ContactRow& row) {
  return row.contact.onBody() ? std::max(0.0, row.contact.clearance_m - clothLayer(m, row)) : 0;
}

/// Mass per area of the cloth on the side that the normal points to, whose weights add up to 1. Contact::sample does
/// not tell: of two edges it is an edge's number.
double densityOf(const Model& m, const Stencil& stencil) {
  double sum = 0;
  for (int k = 0; k < stencil.count; ++k)
    if (stencil.weight[k] > 0) sum += stencil.weight[k] * m.density_kg_per_m2[stencil.sample[k]];
  return sum;
}

/// `warm`: its traction in the last step, times dt. A sample inside of a body comes out no faster than other
/// intersections are freed (h0 of eq. 4.21).
void setPersistent(const Model& m, double dt, const Vec3& warm, ContactRow& row) {
  ContactParameters parameters = m.contact;
  parameters.layer_m = layerOf(m, row);
  layerUnder(dot(warm, row.contact.normal) / dt, dt, densityOf(m, row.stencil), parameters, row);
  if (row.contact.gap_m < 0) row.target_m_per_s = std::min(row.target_m_per_s, m.collisions.untangling.speed_mps);
}

/// The order of persistent contacts, as the lists come.
auto key(const auto& c) { return std::tuple(c.kind, c.sample, c.obstacle, c.feature); }

ObstacleMotion motionOf(const StepWork& w) {
  const StageInstant &a = w.stage.start, &b = w.stage.end;
  return {a.obstacles, b.obstacles, a.vertices, b.vertices};
}

/// Rows of the persistent contacts, as the lists come.
void listRows(const Model& m, double dt, StepWork& w) {
  const int near = static_cast<int>(w.near.size()), points = static_cast<int>(w.collisions.points.size());
  w.rows.resize(w.near.size() + w.collisions.points.size() + w.edge_rows.size());
  forAll(Each::value, near, [&](int k) {
    w.rows[k] = bodyRow(w.near[k], wayOfBody(m.collisions, motionOf(w), w.near[k]) / dt, 0, false);
  });
  forAll(Each::value, points, [&](int k) {
    const ClothContactPoint& p = w.collisions.points[k];
    ContactRow& row = w.rows[near + k];
    row = {};
    row.contact = p.contact;
    row.stencil = p.stencil;
    row.partner = p.partner;
  });
  std::copy(w.edge_rows.begin(), w.edge_rows.end(), w.rows.begin() + near + points);
}

/// Rows of the persistent contacts with their warm tractions.
void persistentRows(const Model& m, const State& in, double dt, StepWork& w) {
  listRows(m, dt, w);
  const int n = static_cast<int>(w.rows.size());
  w.warm.resize(n);
  const double scale = in.last_step_s > 0 ? dt / in.last_step_s : 0;
  std::size_t at = 0;
  // The sample's feet move from feature to feature, and there may be one or several of them: a new one starts from what
  // those on its side have borne in the mean.
  const auto around = [&](const Contact& c) {
    WarmContact mean;
    int count = 0;
    const auto first = std::lower_bound(
        in.warm.begin(), in.warm.end(), std::pair(ContactKind::sample_on_cloth, c.sample),
        [&](const WarmContact& a, const std::pair<ContactKind, int>& b) { return std::pair(a.kind, a.sample) < b; });
    for (auto it = first; it != in.warm.end() && it->kind == ContactKind::sample_on_cloth && it->sample == c.sample;
         ++it) {
      if (!(dot(it->traction, c.normal) > 0)) continue;
      mean.traction += it->traction;
      mean.mean_Pa += it->mean_Pa;
      ++count;
    }
    if (count == 0) return mean;
    mean.traction *= 1.0 / count;
    mean.mean_Pa /= count;
    return mean;
  };
  for (int k = 0; k < n; ++k) {
    ContactRow& row = w.rows[k];
    while (at < in.warm.size() && key(in.warm[at]) < key(row.contact)) ++at;
    const bool known = at < in.warm.size() && key(in.warm[at]) == key(row.contact);
    WarmContact warm;
    if (known) warm = in.warm[at];
    if (!known && row.contact.kind == ContactKind::sample_on_cloth) warm = around(row.contact);
    w.warm[k] = scale * warm.traction;
    row.mean_Pa = warm.mean_Pa;
  }
  forAll(Each::value, n, [&](int k) { setPersistent(m, dt, w.warm[k], w.rows[k]); });
}

/// Asks for what eq. 3.23 leaves of the gap, min(k delta, g), and for half of k delta more each round: bodies are
/// curved, and pairs turn. As a speed that is delta/(2 tau) at most, however short the step: where steps are cut, what
/// is asked for must not grow.
void setImpactTarget(const Model& m, double dt, int round, ContactRow& row) {
  const double gap = row.contact.gap_m;
  const double restored = -std::expm1(-dt / m.contact.relaxation_s) * layerOf(m, row);
  row.target_m_per_s = (std::min(restored, std::max(gap, 0.0)) - gap + 0.5 * (round - 1) * restored) / dt;
}

/// A sample's hit at an obstacle; replaces the row of the same pair.
void addImpact(const Model& m, const Contact& hit, double dt, int round, StepWork& w) {
  const Vec3 body =
      (w.stage.end.obstacles[hit.obstacle] * hit.local - w.stage.start.obstacles[hit.obstacle] * hit.local) / dt;
  ContactRow row = bodyRow(hit, body, 0, true);
  setImpactTarget(m, dt, round, row);
  for (ContactRow& old : w.rows)
    if (old.stencil.count == 1 && old.contact.sample == hit.sample && old.contact.obstacle == hit.obstacle &&
        old.pair[0] < 0 && (old.impact || round > 2)) {
      old = row;
      return;
    }
  w.rows.push_back(row);
  w.warm.push_back({});
}

void addImpact(const Model& m, const PairHit& hit, double dt, int round, StepWork& w) {
  ContactRow row = hit.row;
  setImpactTarget(m, dt, round, row);
  for (ContactRow& old : w.rows)
    if (old.pair == row.pair) {
      old = row;
      return;
    }
  w.rows.push_back(row);
  w.warm.push_back({});
}

/// Contacts contradict each other where cloth is pinched: between bodies that come closer than two layers, or where it
/// would have to bend more sharply than its control points can. Then no velocities keep what they ask for, or only such
/// as grow without bound from step to step, the impulses of both sides grow with each iteration, and the residual stays
/// far above the tolerance.
bool contradict(const ContactSolve& solve, double dt) {
  constexpr double kFar_m_per_s2 = 1;  // a tenth of gravity; solves end at a hundredth to a tenth of it
  return !solve.converged && !(solve.residual_m_per_s <= kFar_m_per_s2 * dt);
}

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
  std::optional<SupportHold> supported;
  MotionHold* hold = limits;
  if (m.supports && m.supports->couple()) {
    hold = &supported.emplace(*m.supports, limits);
    constexpr double kNothing = 1e-9;
    PointWeights scratch;
    for (ContactRow& row : w.rows) row.fixed = !(givesWay(m, row, scratch) > kNothing);
  }
  const auto solve = [&](std::span<const ContactRow> rows) {
    return solveContacts(rows, m.surface.WT, m.inverse_mass, m.surface.area_m2, m.density_kg_per_m2, m.contact, dt,
                         w.velocity, w.warm, w.impulses, w.contact, hold);
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
/// one with a held point stays, or goes where supports move that. False where it is no use: pinched between bodies, or
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
        const Vec3 with = m.supports ? solved[*first_held] : Vec3{};
        for (int i : zone.points) w.velocity[i] = with;
      } else {
        makeRigid(zone, in.p, m.mass_kg, w.velocity);
      }
    }
    report.impact_zones = impact_zones.size();
    if (m.supports) m.supports->drive(in.time_s, in.time_s + dt, w.velocity);
    if (!allFinite(w.velocity) || !anyImpact(m, dt, w)) {
      w.impact_zones = std::move(impact_zones);
      for (int i = 0; i < m.freeCount(); ++i) w.impact_zone_change[i] = w.velocity[i] - solved[i];
      return true;
    }
  }
  return false;
}

}  // namespace

void keepWarm(const Model& m, double dt, const StepWork& w, std::vector<WarmContact>& warm) {
  warm.clear();
  for (std::size_t i = 0; i < w.rows.size(); ++i) {
    const ContactRow& row = w.rows[i];
    const Contact& c = row.contact;
    if (row.impact || (row.mean_Pa == 0 && w.warm[i] == Vec3{})) continue;
    // What stops a sample on its way to the layer does not press on the layer.
    const double pressure = atLayer(c.gap_m, layerOf(m, row)) ? dot(w.warm[i], c.normal) / dt : 0;
    const double mean = lastingPressure(row.mean_Pa, pressure, dt, densityOf(m, row.stencil), m.contact);
    warm.push_back({c.kind, c.sample, c.obstacle, c.feature, w.warm[i], mean});
    if (row.partner >= 0) warm.push_back({c.kind, row.partner, c.obstacle, -1, -w.warm[i], mean});
  }
  std::stable_sort(warm.begin(), warm.end(),
                   [](const WarmContact& a, const WarmContact& b) { return key(a) < key(b); });
}

void pressingAccelerations(const Model& m, double dt, StepWork& w, std::vector<Vec3>& pressed) {
  const bool limited = m.strain_limit.mode != LimitMode::none;
  pressed.clear();
  for (std::size_t i = 0; i < w.rows.size(); ++i) {
    const ContactRow& row = w.rows[i];
    const Contact& c = row.contact;
    if (row.impact || row.slippery || w.impulses[i] == Vec3{}) continue;
    if (!limited && !atLayer(c.gap_m, layerOf(m, row))) continue;
    if (pressed.empty()) {
      pressed.resize(m.freeCount());
      w.sample_pressing.assign(m.surface.size(), Vec3{});
    }
    const double share =
        limited ? 1 : lastingShare(row.mean_Pa, dot(w.warm[i], c.normal) / dt, densityOf(m, row.stencil));
    for (int k = 0; k < row.stencil.count; ++k)
      w.sample_pressing[row.stencil.sample[k]] += (share * row.stencil.weight[k]) * w.impulses[i];
  }
  if (pressed.empty()) return;
  m.surface.WTt.multiply<Vec3>(w.sample_pressing, pressed);
  for (int i = 0; i < m.freeCount(); ++i) pressed[i] *= m.inverse_mass[i] / dt;
  if (m.supports) m.supports->hold(pressed);
}

void contactImpulses(const Model& m, StepWork& w, std::vector<Vec3>& impulses) {
  w.sample_impulse.assign(m.surface.size(), Vec3{});
  for (std::size_t i = 0; i < w.rows.size(); ++i)
    for (int k = 0; k < w.rows[i].stencil.count; ++k)
      w.sample_impulse[w.rows[i].stencil.sample[k]] += w.rows[i].stencil.weight[k] * w.impulses[i];
  m.surface.WTt.multiply<Vec3>(w.sample_impulse, impulses);
}

namespace {

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
    for (const SampleHit& hit : w.hits) addImpact(m, hit, dt, round, w);
    for (const PairHit& hit : w.pair_hits) addImpact(m, hit, dt, round, w);
  }
  const bool done = moveImpactZones(m, in, dt, report, w);
  clock.lap(w.times.impact);
  if (done && allFinite(w.velocity)) return true;
  failForImpacts(m, report, w);
  return false;
}

}  // namespace gambeson
