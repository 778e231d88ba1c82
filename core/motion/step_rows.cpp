#include "core/motion/step_rows.hpp"

#include <algorithm>
#include <climits>
#include <tuple>

#include "core/math/parallel.hpp"
#include "core/motion/impact_row.hpp"
#include "core/motion/sewing.hpp"
#include "core/motion/step_contact.hpp"
#include "core/motion/step_method.hpp"
#include "core/motion/warm_start.hpp"

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

double standsOut(const Model& m, const ContactRow& row) {
  return row.contact.onBody() ? std::max(0.0, row.contact.clearance_m - clothLayer(m, row)) : 0;
}

namespace {

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
  if (m.method && m.method->takes(row)) parameters.compliance_m_per_Pa = 0;
  layerUnder(dot(warm, row.contact.normal) / dt, dt, densityOf(m, row.stencil), parameters, row);
  if (row.contact.gap_m < 0) row.target_m_per_s = std::min(row.target_m_per_s, m.collisions.untangling.speed_mps);
}

RowSlip slipAt(double speed) { return {speed > 0, false, speed, 0, 0, {}}; }

/// The weft of the cloth at a contact, at the start of the step; 0 where no friction asks.
Vec3 weftAt(const Model& m, const State& in, const ContactRow& row) {
  if (m.weft.rows() == 0) return {};
  const Vec3 along = sampleAt(m.weft, row.stencil.sample[0], in.p);
  const Vec3 t = along - dot(along, row.contact.normal) * row.contact.normal;
  return norm2(t) > 0 ? normalized(t) : Vec3{};
}

/// How a contact that is new moves: as the surfaces do at the start of the step.
RowSlip startSlip(const Model& m, const State& in, double dt, const ContactRow& row) {
  Vec3 v = -row.body_velocity;
  for (int j = 0; j < row.stencil.count; ++j)
    v += row.stencil.weight[j] * sampleAt(m.surface.WT, row.stencil.sample[j], in.v);
  const double speed = norm(v - dot(v, row.contact.normal) * row.contact.normal);
  return slipAt(speed > m.contact.still(dt) ? speed : 0);
}

/// The order of persistent contacts, as the lists come.
auto key(const auto& c) { return std::tuple(c.kind, c.sample, c.obstacle, c.feature); }
ContactKey contactKey(const WarmContact& c) { return {static_cast<int>(c.kind), c.sample, c.obstacle, c.feature}; }

}  // namespace

ObstacleMotion motionOf(const StepWork& w) {
  const StageInstant &a = w.stage.start, &b = w.stage.end;
  return {a.obstacles, b.obstacles, a.vertices, b.vertices};
}

namespace {

/// Rows of the persistent contacts, as the lists come.
void listRows(const Model& m, double dt, StepWork& w) {
  const int near = static_cast<int>(w.near.size()), points = static_cast<int>(w.collisions.points.size());
  w.rows.resize(w.near.size() + w.collisions.points.size() + w.edge_rows.size());
  forAll(Each::sum, near, [&](int k) {
    w.rows[k] = bodyRow(w.near[k], wayOfBody(m.collisions, motionOf(w), w.near[k]) / dt, 0, false);
  });
  forAll(Each::sum, points, [&](int k) {
    const ClothContactPoint& p = w.collisions.points[k];
    ContactRow& row = w.rows[near + k];
    row = {};
    row.contact = p.contact;
    row.stencil = p.stencil;
    row.partner = p.partner;
  });
  std::copy(w.edge_rows.begin(), w.edge_rows.end(), w.rows.begin() + near + points);
}

}  // namespace

void persistentRows(const Model& m, const State& in, double dt, StepWork& w) {
  listRows(m, dt, w);
  const int n = static_cast<int>(w.rows.size());
  w.warm.resize(n);
  w.slip.clear();
  if (m.contact.followsMotion()) w.slip.resize(n);
  const double scale = in.last_step_s > 0 ? dt / in.last_step_s : 0;
  std::size_t at = 0;
  const int known_count = static_cast<int>(in.warm.size());
  const auto keyOf = [&](int k) { return contactKey(in.warm[k]); };
  const auto borne = [&](int k) { return WarmStart{in.warm[k].traction, in.warm[k].mean_Pa, 0}; };
  const auto around = [&](const Contact& c) {
    const ContactKey of_sample{static_cast<int>(ContactKind::sample_on_cloth), c.sample, INT_MIN, INT_MIN};
    const WarmStart mean =
        meanAround(of_sample, c.normal, firstNotLess(of_sample, known_count, keyOf), known_count, keyOf, borne);
    WarmContact warm;
    warm.traction = mean.traction;
    warm.mean_Pa = mean.mean_Pa;
    return warm;
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
    if (!m.contact.followsMotion()) continue;
    w.slip[k] = known ? slipAt(warm.slip_m_per_s) : startSlip(m, in, dt, row);
    w.slip[k].weft = weftAt(m, in, row);
  }
  forAll(Each::sum, n, [&](int k) { setPersistent(m, dt, w.warm[k], w.rows[k]); });
  if (m.method) prepareRows(m, dt, w);
}

namespace {

void setImpactTarget(const Model& m, double dt, int round, ContactRow& row) {
  const double restored = -std::expm1(-dt / m.contact.relaxation_s) * layerOf(m, row);
  row.target_m_per_s = impactTarget(row.contact.gap_m, restored, round, dt);
}

void addRow(const Model& m, const State& in, double dt, const ContactRow& row, StepWork& w) {
  w.rows.push_back(row);
  w.warm.push_back({});
  if (!m.contact.followsMotion()) return;
  w.slip.push_back(startSlip(m, in, dt, row));
  w.slip.back().weft = weftAt(m, in, row);
}

}  // namespace

namespace {

/// What a row stands for where a hit may take its place: the sample and the obstacle after -1, or the pair of an
/// impact.
using ImpactKey = std::array<int, 3>;
struct KnownRow {
  ImpactKey key;
  int row = 0;
  bool operator<(const KnownRow& other) const { return std::tie(key, row) < std::tie(other.key, other.row); }
};

/// Rows in whose place hits of this round come, in order; those of a sample that lasts from the third round on.
std::vector<KnownRow> replaceable(const StepWork& w, int round) {
  std::vector<KnownRow> known;
  for (std::size_t i = 0; i < w.rows.size(); ++i) {
    const ContactRow& row = w.rows[i];
    if (row.pair[0] >= 0)
      known.push_back({row.pair, static_cast<int>(i)});
    else if (row.stencil.count == 1 && (row.impact || round > 2))
      known.push_back({{-1, row.contact.sample, row.contact.obstacle}, static_cast<int>(i)});
  }
  std::sort(known.begin(), known.end());
  return known;
}

}  // namespace

void addImpacts(const Model& m, const State& in, double dt, int round, StepWork& w) {
  const std::vector<KnownRow> known = replaceable(w, round);
  const auto add = [&](const ImpactKey& key, ContactRow row) {
    setImpactTarget(m, dt, round, row);
    const auto old = std::lower_bound(known.begin(), known.end(), KnownRow{key, 0});
    if (old != known.end() && old->key == key)
      w.rows[static_cast<std::size_t>(old->row)] = row;
    else
      addRow(m, in, dt, row, w);
  };
  for (const SampleHit& hit : w.hits) {
    const Vec3 body =
        (w.stage.end.obstacles[hit.obstacle] * hit.local - w.stage.start.obstacles[hit.obstacle] * hit.local) / dt;
    add({-1, hit.sample, hit.obstacle}, bodyRow(hit, body, 0, true));
  }
  for (const PairHit& hit : w.pair_hits) add(hit.row.pair, hit.row);
}

namespace {

/// What the persistent contacts of the step leave to the next.
void keepWarm(const Model& m, double dt, const StepWork& w, std::vector<WarmContact>& warm) {
  warm.clear();
  for (std::size_t i = 0; i < w.rows.size(); ++i) {
    const ContactRow& row = w.rows[i];
    const Contact& c = row.contact;
    if (row.impact || (row.mean_Pa == 0 && w.warm[i] == Vec3{})) continue;
    // What stops a sample on its way to the layer does not press on the layer.
    const double pressure = atLayer(c.gap_m, layerOf(m, row)) ? dot(w.warm[i], c.normal) / dt : 0;
    const double mean = lastingPressure(row.mean_Pa, pressure, dt, densityOf(m, row.stencil), m.contact);
    const double slip = !w.slip.empty() && w.slip[i].slips && w.slip[i].speed_m_per_s > m.contact.still(dt)
                            ? w.slip[i].speed_m_per_s
                            : 0;
    warm.push_back({c.kind, c.sample, c.obstacle, c.feature, w.warm[i], mean, slip});
    if (row.partner >= 0) warm.push_back({c.kind, row.partner, c.obstacle, -1, -w.warm[i], mean, slip});
  }
  std::stable_sort(warm.begin(), warm.end(),
                   [](const WarmContact& a, const WarmContact& b) { return key(a) < key(b); });
}

}  // namespace

void leaveToNext(const Model& m, const State& in, double dt, const StepReport& report, const StepWork& w, State& out) {
  keepWarm(m, dt, w, out.warm);
  out.tangled = report.intersections > 0 || report.pinched > 0 || report.inside > 0;
  out.pinched.clear();
  out.frequency_rad_per_s = in.frequency_rad_per_s;
  out.mode = in.mode;
  out.steps_to_estimate = in.steps_to_estimate;
  out.law_strains = in.law_strains;
  out.swing = in.swing;
  out.share = in.share;
  out.last_step_s = dt;
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
  if (!m.sewing.empty() && someSeamsHold(w)) m.sewing.hold(pressed, w.sewn_open, w.sewn);
}

void contactImpulses(const Model& m, StepWork& w, std::vector<Vec3>& impulses) {
  w.sample_impulse.assign(m.surface.size(), Vec3{});
  for (std::size_t i = 0; i < w.rows.size(); ++i)
    for (int k = 0; k < w.rows[i].stencil.count; ++k)
      w.sample_impulse[w.rows[i].stencil.sample[k]] += w.rows[i].stencil.weight[k] * w.impulses[i];
  m.surface.WTt.multiply<Vec3>(w.sample_impulse, impulses);
}

}  // namespace gambeson
