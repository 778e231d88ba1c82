#include "cases/wear/results/measure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "cases/wear/case/factors.hpp"
#include "cases/wear/case/motions/kind.hpp"
#include "cases/wear/recording/skin_ledger.hpp"
#include "core/error.hpp"
#include "human/motion/task_moments.hpp"

namespace gambeson {
namespace {

using Rows = std::vector<std::vector<double>>;

/// From one table, rows of windows that lie in the motion. The bounds were added up.
Rows motionRows(const RecordingReader& recording, const std::string& table) {
  Rows rows = recording.table(table);
  std::erase_if(rows, [](const auto& r) { return r[0] < -1e-9; });
  return rows;
}

/// Windows of a table in the last 0.1 s of settling, the motion's posture held; none where nothing settles.
Rows restRows(const Scenario& s, const RecordingReader& recording, const std::string& table) {
  const double from_s = -std::min(0.1, s.definition.dressing.settle_s) - 1e-9;
  Rows rows = recording.table(table);
  std::erase_if(rows, [&](const auto& r) { return r[0] < from_s || r[1] > 1e-9; });
  return rows;
}

/// Rows with `stride` columns per body, of which the first six are force and moment.
std::vector<ContactWindow> windowsOf(const Rows& rows, std::size_t bodies, std::size_t stride) {
  std::vector<ContactWindow> windows;
  for (const auto& r : rows) {
    ContactWindow w{r[0], r[1], {}};
    for (std::size_t b = 0; b < bodies; ++b) {
      const double* v = &r[2 + stride * b];
      w.links.push_back({{v[0], v[1], v[2]}, {v[3], v[4], v[5]}});
    }
    windows.push_back(std::move(w));
  }
  return windows;
}

/// The scenario's bodies come with the human's links first.
TorqueHistory addedTorques(const Scenario& s, std::vector<ContactWindow> windows, std::span<const int> joints) {
  for (ContactWindow& w : windows) w.links.resize(s.human->skeleton.links.size());
  const auto counting = s.definition.analysis.counting == Counting::all_distal ? TorqueCounting::all_distal
                                                                               : TorqueCounting::distal_segment;
  TorqueHistory history = torqueHistory(*s.human, *s.motion, 0, windows, joints, counting);
  for (auto& row : history.value)
    for (double& tau : row) tau = -tau;
  return history;
}

/// One of the torques that the table "skin" holds of each joint, as the wearer adds it.
TorqueHistory skinTorques(const Scenario& s, const Rows& rows, std::span<const int> joints, int which) {
  const std::vector<int> moving = movingJoints(s.human->skeleton);
  TorqueHistory history{{joints.begin(), joints.end()}, {}, {}};
  for (const auto& r : rows) {
    history.time_s.push_back(0.5 * (r[0] + r[1]));
    history.value.emplace_back();
    for (const int j : joints) {
      const auto at = std::find(moving.begin(), moving.end(), j) - moving.begin();
      history.value.back().push_back(
          at < std::ssize(moving) ? -r[2 + static_cast<std::size_t>(SkinLedger::kPerJoint * at + which)] / (r[1] - r[0])
                                  : 0);
    }
  }
  return history;
}

/// "hip_flexion_left" is "hip", "flexion", "left"; "elbow" is just that.
void splitName(JointMeasure& m) {
  std::string rest = m.name;
  for (const char* side : {"left", "right"})
    if (rest.ends_with(std::string("_") + side)) {
      m.side = side;
      rest.resize(rest.size() - m.side.size() - 1);
    }
  const std::size_t cut = rest.rfind('_');
  m.part = rest.substr(0, cut);
  if (cut != std::string::npos) m.movement = rest.substr(cut + 1);
  std::replace(m.part.begin(), m.part.end(), '_', ' ');
}

double meanOf(const Rows& rows, const std::vector<int>& bodies, std::size_t part) {
  double sum = 0, time = 0;
  for (const auto& r : rows) {
    time += r[1] - r[0];
    for (const int b : bodies) sum += r[2 + 8 * static_cast<std::size_t>(b) + part];
  }
  return time > 0 ? sum / time : 0;
}

/// Phase of the largest joint value within the strides.
double highestPhase(const Scenario& s, const Strides& strides, const JointMeasure& m) {
  double best = -std::numeric_limits<double>::infinity(), at = 0;
  for (int i = 0; i < 1000; ++i) {
    const double t = strides.start_s + strides.time_s * i / 1000;
    const double q = s.motion->at(t).q[static_cast<std::size_t>(m.joint)];
    if (q > best) best = q, at = t;
  }
  return strides.phase(at, m.side);
}

/// The added torques of each joint in the windows of the last 0.1 s before the motion, all of one length; the posture
/// is that of the motion's start.
std::vector<std::vector<double>> standingTorques(const Scenario& s, const Rows& rest, const std::vector<int>& joints) {
  std::vector<std::vector<double>> torques(joints.size());
  if (rest.empty()) return torques;
  if (s.hasSkin()) {
    for (std::size_t w = 0; w < rest.size(); ++w) {
      if (std::abs((rest[w][1] - rest[w][0]) - (rest.back()[1] - rest.back()[0])) > 1e-9) continue;
      const TorqueHistory at = skinTorques(s, {rest[w]}, joints, 0);
      for (std::size_t j = 0; j < joints.size(); ++j) torques[j].push_back(at.value[0][j]);
    }
    return torques;
  }
  std::vector<ContactWindow> windows = windowsOf(rest, s.bodies.size(), 8);
  const double length = windows.back().duration();
  const auto counting = s.definition.analysis.counting == Counting::all_distal ? TorqueCounting::all_distal
                                                                               : TorqueCounting::distal_segment;
  for (ContactWindow& w : windows) {
    if (std::abs(w.duration() - length) > 1e-9) continue;
    w.links.resize(s.human->skeleton.links.size());
    const std::vector<double> tau = contactTorques(*s.human, s.motion->at(0), w.links, w.duration(), joints, counting);
    for (std::size_t j = 0; j < joints.size(); ++j) torques[j].push_back(-tau[j]);
  }
  return torques;
}

/// The task's own peak moment at a joint. Throws InputError where the published data have no such joint.
std::optional<double> naturalMoment(const Scenario& s, const JointMeasure& m) {
  switch (s.definition.analysis.task) {
    case Task::none:
      return {};
    case Task::natural_walk:
      return naturalPeakMoment_Nm("Natural", m.name, s.human->mass_kg);
    case Task::natural_stairs:
      return naturalPeakMoment_Nm("Ascending", m.name, s.human->mass_kg);
    case Task::aiming:
      break;
  }
  return m.held && m.held->moment_Nm != 0 ? std::optional(std::abs(m.held->moment_Nm)) : std::nullopt;
}

/// `skin`: of the table of that name, empty without a skin; `rest` of that table too where there is one, else of
/// bodies; `pressing`: the normal parts.
void measureJoints(const Scenario& s, const Rows& rows, const Rows& skin, const Rows& rest,
                   const std::vector<ContactWindow>& pressing, Measured& out) {
  const Skeleton& skeleton = s.human->skeleton;
  std::vector<int> joints;
  for (const std::string& name : s.definition.analysis.joints) {
    joints.push_back(skeleton.joint(name));
    if (joints.back() < 0)
      throw InputError({s.definition.file.string(), 0, "analysis.joints"}, "the human has no joint \"" + name + "\"");
  }
  if (joints.empty()) joints = movingJoints(skeleton);
  if (s.hasSkin()) {
    out.added = skinTorques(s, skin, joints, 0);
    out.added_segments = skinTorques(s, skin, joints, 1);
    out.added_proximal = skinTorques(s, skin, joints, 2);
    out.added_distal = skinTorques(s, skin, joints, 3);
  } else {
    out.added = addedTorques(s, out.windows, joints);
  }
  out.added_drag = addedTorques(s, out.drag, joints);
  out.added_friction = s.hasSkin() ? skinTorques(s, skin, joints, 4) : addedTorques(s, pressing, joints);
  for (std::size_t w = 0; w < out.added_friction.value.size(); ++w)
    for (std::size_t j = 0; j < joints.size(); ++j)
      out.added_friction.value[w][j] = out.added.value[w][j] - out.added_friction.value[w][j];
  const auto counting = s.definition.analysis.counting == Counting::all_distal ? TorqueCounting::all_distal
                                                                               : TorqueCounting::distal_segment;
  const auto& time = out.added.time_s;
  std::size_t first = 0;  // window that counts
  while (first < time.size() && time[first] < out.counted_from_s) ++first;
  const std::vector<std::vector<double>> standing = standingTorques(s, rest, joints);
  std::vector<StaticMoment> held;  // of the aim
  if (const auto kg = kindOf(*s.definition.human).carried_kg(s.definition.human->motion);
      kg && s.definition.analysis.task == Task::aiming)
    held = peakStaticMoments(*s.human, *s.motion, rifleInHands(*s.human, *kg));
  for (const int j : joints) {
    JointMeasure m;
    m.joint = j;
    m.name = skeleton.joints[static_cast<std::size_t>(j)].name;
    m.prismatic = skeleton.joints[static_cast<std::size_t>(j)].type == JointType::prismatic;
    splitName(m);
    const std::vector<double> tau = out.added.of(j), drag = out.added_drag.of(j), friction = out.added_friction.of(j);
    m.peak = peakOf(std::span(time).subspan(first), std::span(tau).subspan(first));
    m.rms = rms(std::span(tau).subspan(first));
    if (s.hasSkin()) {
      const std::vector<double> segments = out.added_segments.of(j);
      m.segments.emplace();
      m.segments->peak = peakOf(std::span(time).subspan(first), std::span(segments).subspan(first));
      for (std::size_t w = 0; w < time.size(); ++w)
        if (time[w] == m.peak.time_s) {
          m.segments->at_peak = segments[w];
          m.segments->border_proximal = out.added_proximal.of(j)[w];
          m.segments->border_distal = out.added_distal.of(j)[w];
        }
    }
    if (const std::vector<double>& still = standing[out.joints.size()]; !still.empty()) {
      m.standing = 0;
      for (const double t : still) *m.standing += t / static_cast<double>(still.size());
    }
    if (first > 0) m.lead_in_peak = peakOf(std::span(time).first(first), std::span(tau).first(first));
    for (std::size_t w = 0; w < time.size(); ++w)
      if (time[w] == m.peak.time_s) m.drag_at_peak = drag[w], m.friction_at_peak = friction[w];
    m.friction_rms = rms(std::span(friction).subspan(first));
    const auto q = [&](double t) { return s.motion->at(t).q[static_cast<std::size_t>(j)]; };
    constexpr double h = 1e-3;
    m.position_at_peak = q(m.peak.time_s);
    m.rate_at_peak = (q(m.peak.time_s + h) - q(m.peak.time_s - h)) / (2 * h);
    if (!held.empty()) m.held = held[static_cast<std::size_t>(j)];
    if (s.definition.analysis.task != Task::none) {
      try {
        m.natural_Nm = naturalMoment(s, m);
      } catch (const InputError&) {  // the published data have no such joint; the page says "not known"
      }
      if (m.natural_Nm && !(*m.natural_Nm > 0)) m.natural_Nm.reset();
    }
    const std::vector<int> counted = countedLinks(*s.human, j, counting);
    m.normal_N = meanOf(rows, counted, 6);
    m.friction_N = meanOf(rows, counted, 7);
    if (const auto& strides = out.strides) {
      const double T = strides->time_s, start = strides->start_s, end = strides->end_s();
      if (m.peak.time_s >= start) m.phase_at_peak = strides->phase(m.peak.time_s, m.side);
      m.phase_of_highest = highestPhase(s, *strides, m);
      for (int k = 0; k < strides->count; ++k) {
        std::vector<double> t, values;
        for (std::size_t w = 0; w < time.size(); ++w)
          if (time[w] >= start + k * T && time[w] < start + (k + 1) * T) t.push_back(time[w]), values.push_back(tau[w]);
        if (!t.empty()) m.stride_peaks.push_back(peakOf(t, values));
      }
      if (strides->count >= 2) m.second_stride = compareShifted(time, tau, tau, T, start, start + T);
      const int other = m.side == "right" ? skeleton.joint(otherSide(m.name)) : -1;
      if (std::find(joints.begin(), joints.end(), other) != joints.end())
        m.other_side = compareShifted(time, tau, out.added.of(other), 0.5 * T, start, end - 0.5 * T);
    }
    out.joints.push_back(std::move(m));
  }
}

void measureBodies(const Scenario& s, const Rows& rows, Measured& out) {
  for (std::size_t b = 0; b < s.bodies.size(); ++b) {
    Link link;
    link.name = s.bodies[b];
    out.bodies.skeleton.links.push_back(link);
  }
  if (s.hasSkin()) {
    std::vector<int> links = s.human->skin->segment;
    std::sort(links.begin(), links.end());
    links.erase(std::unique(links.begin(), links.end()), links.end());
    for (const int l : links) out.bodies.shapes.push_back({l, s.bodies[static_cast<std::size_t>(l)], Ellipsoid{}, {}});
  }
  for (std::size_t o = 0; o < s.model->obstacles.size(); ++o)
    if (s.body_of_obstacle[o] >= 0)
      out.bodies.shapes.push_back(
          {s.body_of_obstacle[o], s.model->obstacles[o].segment, s.model->obstacles[o].shape, {}});
  for (const ContactShare& share : contactShares(out.bodies, out.windows))
    out.contact.push_back({share, meanOf(rows, {share.link}, 6), meanOf(rows, {share.link}, 7)});
}

void measureRegions(const Scenario& s, const Rows& rows, Measured& out) {
  for (std::size_t k = 0; k < s.contact_regions.size(); ++k) {
    RegionMeasure m{s.contact_regions[k], {}, 0, 0};
    double time = 0;
    for (const auto& r : rows) {
      const double* v = &r[2 + 5 * k];
      m.mean_N += Vec3{v[0], v[1], v[2]};
      m.normal_N += v[3];
      m.friction_N += v[4];
      time += r[1] - r[0];
    }
    if (time > 0) m.mean_N = m.mean_N / time, m.normal_N /= time, m.friction_N /= time;
    out.contact_regions.push_back(m);
  }
}

void measureSupports(const Scenario& s, const Rows& rows, Measured& out) {
  for (std::size_t g = 0; g < s.supports.size(); ++g) {
    SupportMeasure m;
    m.name = s.supports[g].name;
    m.springs = !s.supports[g].springs.empty();
    double time = 0;
    for (const auto& r : rows) {
      const double* v = &r[2 + 4 * g];
      const Vec3 impulse{v[0], v[1], v[2]};
      const double dt = r[1] - r[0];
      m.mean_N += impulse;
      time += dt;
      if (norm(impulse) / dt > m.peak_N) m.peak_N = norm(impulse) / dt, m.peak_time_s = 0.5 * (r[0] + r[1]);
      m.largest_drop_m = std::max(m.largest_drop_m, v[3]);
    }
    if (time > 0) m.mean_N = m.mean_N / time;
    out.supports.push_back(m);
  }
}

}  // namespace

const JointMeasure* Measured::highest() const {
  const JointMeasure* best = nullptr;
  for (const JointMeasure& m : joints)
    if (!m.prismatic && isTouched(m) && (!best || std::abs(m.peak.value) > std::abs(best->peak.value))) best = &m;
  return best;
}

std::vector<double> sampleAreas(const Scenario& s, const Frame& frame) {
  for (const Field& f : frame.sample_fields)
    if (f.name == "area") return {f.data.begin(), f.data.end()};
  return s.model->surface.area_m2;
}

std::vector<double> thicknessOf(const Scenario& s) {
  const Surface& surface = s.model->surface;
  std::vector<double> thickness;
  for (std::size_t i = 0; i < surface.area_m2.size(); ++i)
    thickness.push_back(s.model->cloth->fabricAt(surface.patch[i], surface.parameters[i]).thickness());
  return thickness;
}

std::vector<LayerMeasure> layersOf(const Scenario& s) {
  std::vector<LayerMeasure> layers;
  const Case effective = withFactors(s.definition);
  for (const GarmentCase& g : effective.garments) {
    const Fabric& fabric = fabricOf(effective, g);
    const double h = fabric.thickness();
    layers.push_back({g.name, fabric.name, 0, 0, h, 0, h, h});
  }
  const std::vector<ClothPatch>& patches = s.model->cloth->patches();
  const Surface& surface = s.model->surface;
  const std::vector<double> thickness = thicknessOf(s);
  const auto layerOf = [&](std::size_t sample) {
    return static_cast<std::size_t>(patches[static_cast<std::size_t>(surface.patch[sample])].garment);
  };
  for (std::size_t k = 0; k < layers.size(); ++k) {
    if (effective.garments[k].fields.empty()) continue;
    double area = 0, volume = 0, least = std::numeric_limits<double>::infinity(), largest = 0;
    for (std::size_t i = 0; i < thickness.size(); ++i) {
      if (layerOf(i) != k) continue;
      area += surface.area_m2[i];
      volume += surface.area_m2[i] * thickness[i];
      least = std::min(least, thickness[i]);
      largest = std::max(largest, thickness[i]);
    }
    layers[k].thickness_m = volume / area;
    layers[k].least_thickness_m = least;
    layers[k].largest_thickness_m = largest;
  }
  for (std::size_t i = 0; i < surface.area_m2.size(); ++i) {
    LayerMeasure& l = layers[layerOf(i)];
    l.area_m2 += surface.area_m2[i];
    l.mass_kg += surface.area_m2[i] * s.model->density_kg_per_m2[i];
  }
  for (const ClothPatch& p : patches)
    layers[static_cast<std::size_t>(p.garment)].control_points += p.end_point - p.first_point;
  return layers;
}

double countedFrom(const Scenario& s, const RecordingReader& recording) {
  const std::optional<Strides> strides = stridesOf(s.definition);
  const Rows rows = recording.table("bodies");
  const bool whole = strides && !rows.empty() && rows.back()[1] > strides->start_s + strides->time_s - 1e-9;
  return whole ? strides->start_s : 0;
}

Regions regionsOf(const Scenario& s) { return {s.patch_names, s.model->surface.patch, s.model->surface.area_m2}; }

Measured measure(const Scenario& s, const RecordingReader& recording) {
  Measured out;
  out.strides = stridesOf(s.definition);
  const Rows bodies = motionRows(recording, "bodies");
  out.windows = windowsOf(bodies, s.bodies.size(), 8);
  out.drag = windowsOf(motionRows(recording, "drag"), s.bodies.size(), 6);
  out.counted_from_s = countedFrom(s, recording);
  measureBodies(s, bodies, out);
  if (s.human)
    measureJoints(s, bodies, s.hasSkin() ? motionRows(recording, "skin") : Rows{},
                  restRows(s, recording, s.hasSkin() ? "skin" : "bodies"),
                  windowsOf(motionRows(recording, "normal"), s.bodies.size(), 6), out);
  measureZones(s, recording, out);
  if (s.human) measureComfort(s, recording, out);
  measureRegions(s, motionRows(recording, "regions"), out);
  measureSupports(s, motionRows(recording, "supports"), out);
  for (const LayerMeasure& l : layersOf(s)) out.cloth_kg += l.mass_kg;
  out.energy.negligible = 0.5 * out.cloth_kg * 1e-12;
  measureSteps(recording, out);
  out.limited = s.definition.strain_limit.has_value();
  out.regions = regionsOf(s);
  measureFrames(recording, out);
  measureTouch(s, recording, out);
  if (const JointMeasure* joint = out.highest(); joint && !out.windows.empty()) {
    out.peak_time_s = joint->peak.time_s;
  } else {
    double most = -1;
    for (const ContactWindow& w : out.windows) {
      double sum = 0;
      for (const LinkImpulse& i : w.links) sum += norm(i.force_Ns) / w.duration();
      if (sum > most) most = sum, out.peak_time_s = w.middle();
    }
  }
  return out;
}

Measured measureAll(const Scenario& s, const RecordingReader& recording) {
  Measured m = measure(s, recording);
  m.surface_depth = surfaceDepth(s, recording);
  measureStretch(s, recording, m);
  measureFalls(s, recording, m);
  measureLayerOrder(s, recording, m);
  return m;
}

}  // namespace gambeson
