#include "cases/wear/recording/state_checkpoint.hpp"

#include <algorithm>
#include <vector>

namespace gambeson {
namespace {

std::vector<double> doubles(std::span<const Vec3> values) {
  std::vector<double> out;
  for (const Vec3& v : values) out.insert(out.end(), {v.x, v.y, v.z});
  return out;
}

std::vector<Vec3> vectors(const std::vector<double>& values) {
  std::vector<Vec3> out(values.size() / 3);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
  return out;
}

}  // namespace

Checkpoint checkpointOf(const State& s, const Frequency& f) {
  Checkpoint c;
  c.time_s = s.time_s;
  c.reals = {{"p", doubles(s.p)},
             {"v", doubles(s.v)},
             {"a", doubles(s.a)},
             {"anchors", doubles(s.anchors)},
             {"mode", doubles(s.mode)}};
  c.reals["limit"] = s.limit_J;
  c.reals["pressed"] = doubles(s.pressed);
  c.reals["sums"] = doubles(std::vector<Vec3>{s.sums.drag, s.sums.springs, s.sums.held});
  c.reals["held"] = doubles(s.held_N);
  c.reals["control"] = {s.frequency_rad_per_s, s.last_step_s, f.largest_rad_per_s, f.membrane_share,
                        f.bending_share,       f.seam_share,  f.spring_share};
  c.reals["swing"] = {s.swing, s.share};
  if (!s.history.empty()) c.reals["history"] = s.history;
  if (s.law_strains) {
    c.reals["law_strains"].assign(s.law_strains->low.begin(), s.law_strains->low.end());
    c.reals["law_strains"].insert(c.reals["law_strains"].end(), s.law_strains->high.begin(), s.law_strains->high.end());
  }
  if (s.elastic_J) c.reals["elastic"] = {*s.elastic_J};
  if (!s.free_change.empty()) c.reals["free_change"] = doubles(s.free_change);
  if (s.damping_W != 0) c.reals["damping"] = {s.damping_W};
  if (!s.inner.empty()) {
    c.reals["inner"] = s.inner;
    c.reals["inner_rate"] = s.inner_rate;
    c.reals["inner_acceleration"] = s.inner_acceleration;
  }
  c.integers["steps_to_estimate"] = {s.steps_to_estimate};
  c.integers["tangled"] = {s.tangled};
  c.integers["pinched"].assign(s.pinched.begin(), s.pinched.end());
  std::vector<Vec3> traction;
  auto& ids = c.integers["warm"];
  auto& mean_Pa = c.reals["warm_mean"];
  const bool slips = std::any_of(s.warm.begin(), s.warm.end(), [](const WarmContact& w) { return w.slip_m_per_s > 0; });
  for (const WarmContact& w : s.warm) {
    traction.push_back(w.traction);
    mean_Pa.push_back(w.mean_Pa);
    if (slips) c.reals["warm_slip"].push_back(w.slip_m_per_s);
    ids.insert(ids.end(), {w.sample, w.obstacle >= 0 ? w.obstacle : -static_cast<int>(w.kind), w.feature});
  }
  c.reals["warm"] = doubles(traction);
  return c;
}

namespace {

/// In a checkpoint a contact of cloth with cloth has minus its kind in place of an obstacle; an edge on a body has a
/// negative feature.
WarmContact warmContact(int sample, int obstacle, int feature, const Vec3& traction, double mean_Pa, double slip) {
  const ContactKind kind = obstacle < 0  ? static_cast<ContactKind>(-obstacle)
                           : feature < 0 ? ContactKind::edge_on_body
                                         : ContactKind::sample_on_body;
  return {kind, sample, std::max(obstacle, -1), feature, traction, mean_Pa, slip};
}

}  // namespace

State stateOf(const Checkpoint& c, Frequency& f) {
  State s;
  s.time_s = c.time_s;
  s.p = vectors(c.reals.at("p"));
  s.v = vectors(c.reals.at("v"));
  s.a = vectors(c.reals.at("a"));
  s.anchors = vectors(c.reals.at("anchors"));
  s.mode = vectors(c.reals.at("mode"));
  s.limit_J = c.reals.at("limit");
  const auto ifThere = [&](const char* name) {
    return c.reals.contains(name) ? c.reals.at(name) : std::vector<double>{};
  };
  s.history = ifThere("history");
  if (c.reals.contains("elastic")) s.elastic_J = c.reals.at("elastic")[0];
  s.free_change = vectors(ifThere("free_change"));
  if (const std::vector<double> damping = ifThere("damping"); !damping.empty()) s.damping_W = damping[0];
  s.inner = ifThere("inner");
  s.inner_rate = ifThere("inner_rate");
  s.inner_acceleration = ifThere("inner_acceleration");
  s.pressed = vectors(c.reals.at("pressed"));
  const std::vector<Vec3> sums = vectors(c.reals.at("sums"));
  s.sums = {sums[0], sums[1], sums[2]};
  s.held_N = vectors(c.reals.at("held"));
  const std::vector<double>& control = c.reals.at("control");
  s.frequency_rad_per_s = control[0];
  s.last_step_s = control[1];
  s.swing = c.reals.at("swing")[0];
  s.share = c.reals.at("swing")[1];
  f = {control[2], control[3], control[4], control[5], control[6]};
  if (const std::vector<double> box = ifThere("law_strains"); box.size() == 6)
    s.law_strains = StrainBox{{box[0], box[1], box[2]}, {box[3], box[4], box[5]}};
  s.steps_to_estimate = static_cast<int>(c.integers.at("steps_to_estimate")[0]);
  s.tangled = c.integers.at("tangled")[0] != 0;
  for (const auto sample : c.integers.at("pinched")) s.pinched.push_back(static_cast<int>(sample));
  const auto& ids = c.integers.at("warm");
  const std::vector<Vec3> traction = vectors(c.reals.at("warm"));
  const std::vector<double>&mean_Pa = c.reals.at("warm_mean"), slip = ifThere("warm_slip");
  for (std::size_t i = 0; i < traction.size(); ++i)
    s.warm.push_back(warmContact(static_cast<int>(ids[3 * i]), static_cast<int>(ids[3 * i + 1]),
                                 static_cast<int>(ids[3 * i + 2]), traction[i], mean_Pa[i],
                                 slip.empty() ? 0 : slip[i]));
  return s;
}

}  // namespace gambeson
