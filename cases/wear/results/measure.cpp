#include "cases/wear/results/measure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "cases/wear/case/factors.hpp"
#include "cases/wear/case/motions/kind.hpp"
#include "cases/wear/recording/recorded_motion.hpp"
#include "cases/wear/recording/recorder.hpp"
#include "cases/wear/recording/skin_ledger.hpp"
#include "cases/wear/results/vector_columns.hpp"
#include "core/error.hpp"
#include "human/motion/task_moments.hpp"

namespace gambeson {
namespace {

/// From one table, rows of windows that lie in the motion. The bounds were added up.
RecordedTable inMotion(const RecordingReader& recording, const std::string& table) {
  const RecordedTable all = recording.table(table);
  const std::vector<double>& start = all.column("start_s");
  return all.where([&](std::size_t row) { return !(start[row] < -1e-9); });
}

/// Windows of a table in the last 0.1 s of settling, the motion's posture held; none where nothing settles.
RecordedTable atRest(const Scenario& s, const RecordingReader& recording, const std::string& table) {
  const double from_s = -std::min(0.1, s.definition.dressing.settle_s) - 1e-9;
  const RecordedTable all = recording.table(table);
  const std::vector<double>&start = all.column("start_s"), &end = all.column("end_s");
  return all.where([&](std::size_t row) { return !(start[row] < from_s || end[row] > 1e-9); });
}

/// Force and moment on each body.
std::vector<ContactWindow> windowsOf(const RecordedTable& table, const std::vector<std::string>& bodies) {
  const std::vector<double>&start = table.column("start_s"), &end = table.column("end_s");
  std::vector<ContactWindow> windows;
  for (std::size_t w = 0; w < table.rows(); ++w) windows.push_back({start[w], end[w], {}});
  for (const std::string& body : bodies) {
    const VectorColumns force(table, body + "_J", "_Ns"), moment(table, body + "_L", "_Nms");
    for (std::size_t w = 0; w < table.rows(); ++w) windows[w].links.push_back({force[w], moment[w]});
  }
  return windows;
}

/// Lengths of the windows of a table, and of all together.
std::vector<double> lengthsOf(const RecordedTable& table) {
  const std::vector<double>&start = table.column("start_s"), &end = table.column("end_s");
  std::vector<double> lengths;
  for (std::size_t w = 0; w < table.rows(); ++w) lengths.push_back(end[w] - start[w]);
  return lengths;
}
double sumOf(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

/// The scenario's bodies come with the human's links first.
TorqueSeries addedTorques(const Scenario& s, std::vector<ContactWindow> windows, std::span<const int> joints) {
  for (ContactWindow& w : windows) w.links.resize(s.human->skeleton.links.size());
  const auto counting = s.definition.analysis.counting == Counting::all_distal ? TorqueCounting::all_distal
                                                                               : TorqueCounting::distal_segment;
  TorqueSeries series = torqueSeries(*s.human, *s.motion, 0, windows, joints, counting);
  for (auto& row : series.value)
    for (double& tau : row) tau = -tau;
  return series;
}

/// One of the torques that the table "skin" holds of each joint, as the wearer adds it.
TorqueSeries skinTorques(const Scenario& s, const RecordedTable& skin, std::span<const int> joints,
                         const std::string& which) {
  const std::vector<int> moving = movingJoints(s.human->skeleton);
  const std::vector<double>&start = skin.column("start_s"), &end = skin.column("end_s");
  TorqueSeries series{{joints.begin(), joints.end()}, {}, {}};
  for (std::size_t w = 0; w < skin.rows(); ++w) series.time_s.push_back(0.5 * (start[w] + end[w]));
  series.value.resize(skin.rows());
  for (const int j : joints) {
    const bool moves = std::find(moving.begin(), moving.end(), j) != moving.end();
    const std::vector<double>* impulse = moves ? &skin.column(SkinLedger::column(s, j, which)) : nullptr;
    for (std::size_t w = 0; w < skin.rows(); ++w)
      series.value[w].push_back(moves ? -(*impulse)[w] / (end[w] - start[w]) : 0);
  }
  return series;
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

/// Mean over time of a part of the table "bodies", "_n_Ns" say, of some of the scenario's bodies together.
double meanOf(const Scenario& s, const RecordedTable& table, const std::vector<int>& bodies, const std::string& part) {
  std::vector<const std::vector<double>*> columns;
  for (const int b : bodies) columns.push_back(&table.column(s.bodies[static_cast<std::size_t>(b)] + part));
  double sum = 0;
  for (std::size_t w = 0; w < table.rows(); ++w)
    for (const std::vector<double>* column : columns) sum += (*column)[w];
  const double time = sumOf(lengthsOf(table));
  return time > 0 ? sum / time : 0;
}

/// Phase of the largest joint value within the strides.
double highestPhase(const Scenario& s, const Strides& strides, const JointMeasure& m) {
  double best = -std::numeric_limits<double>::infinity(), at = 0;
  for (const double t : strides.thousandths()) {
    const double q = s.motion->at(t).q[static_cast<std::size_t>(m.joint)];
    if (q > best) best = q, at = t;
  }
  return strides.phase(at, m.side);
}

/// The added torques of each joint in the windows of the last 0.1 s before the motion, all of one length; the posture
/// is that of the motion's start.
std::vector<std::vector<double>> standingTorques(const Scenario& s, const RecordedTable& rest,
                                                 const std::vector<int>& joints) {
  std::vector<std::vector<double>> torques(joints.size());
  if (rest.empty()) return torques;
  if (s.hasSkin()) {
    const std::vector<double> lengths = lengthsOf(rest);
    const TorqueSeries all = skinTorques(s, rest, joints, "");
    for (std::size_t w = 0; w < rest.rows(); ++w) {
      if (std::abs(lengths[w] - lengths.back()) > 1e-9) continue;
      for (std::size_t j = 0; j < joints.size(); ++j) torques[j].push_back(all.value[w][j]);
    }
    return torques;
  }
  std::vector<ContactWindow> windows = windowsOf(rest, s.bodies);
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

/// After windows and strides. Motions without strides are played as far as they go.
Measured::Played playedOf(const Measured& m) {
  using Played = Measured::Played;
  if (m.windows.empty()) return Played::nothing;
  const double end = m.windows.back().end_s + 1e-9;
  if (!m.strides || end > m.strides->start_s + m.strides->time_s) return Played::strides;
  return end > m.strides->start_s + 2e-9 ? Played::part_of_a_stride : Played::lead_in;
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

/// `bodies`: of the motion.
void measureJoints(const Scenario& s, const RecordingReader& recording, const RecordedTable& bodies, Measured& out) {
  const Skeleton& skeleton = s.human->skeleton;
  std::vector<int> joints;
  for (const std::string& name : s.definition.analysis.joints) {
    joints.push_back(skeleton.joint(name));
    if (joints.back() < 0)
      throw InputError({s.definition.file.string(), 0, "analysis.joints"}, "the human has no joint \"" + name + "\"");
  }
  if (joints.empty()) joints = movingJoints(skeleton);
  if (s.hasSkin()) {
    const RecordedTable skin = inMotion(recording, "skin");
    out.added = skinTorques(s, skin, joints, "");
    out.added_segments = skinTorques(s, skin, joints, "_segments");
    out.added_proximal = skinTorques(s, skin, joints, "_proximal");
    out.added_distal = skinTorques(s, skin, joints, "_distal");
    out.added_friction = skinTorques(s, skin, joints, "_normal");
  } else {
    out.added = addedTorques(s, out.windows, joints);
    out.added_friction = addedTorques(s, windowsOf(inMotion(recording, "normal"), s.bodies), joints);
  }
  out.added_drag = addedTorques(s, out.drag, joints);
  for (std::size_t w = 0; w < out.added_friction.value.size(); ++w)
    for (std::size_t j = 0; j < joints.size(); ++j)
      out.added_friction.value[w][j] = out.added.value[w][j] - out.added_friction.value[w][j];
  const auto counting = s.definition.analysis.counting == Counting::all_distal ? TorqueCounting::all_distal
                                                                               : TorqueCounting::distal_segment;
  const auto& time = out.added.time_s;
  std::size_t first = 0;  // window that counts
  while (first < time.size() && time[first] < out.counted_from_s) ++first;
  const std::vector<std::vector<double>> standing =
      standingTorques(s, atRest(s, recording, s.hasSkin() ? "skin" : "bodies"), joints);
  std::vector<StaticMoment> held;  // of the aim
  if (const auto kg = kindOf(*s.definition.human).carried_kg(s.definition.human->motion);
      kg && s.definition.analysis.task == Task::aiming)
    held = peakStaticMoments(*s.human, *s.motion, rifleInHands(*s.human, *kg));
  if (time.empty()) return;  // nothing to speak of
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
    m.position_at_peak = q(m.peak.time_s);
    m.rate_at_peak = (q(m.peak.time_s + kRate_s) - q(m.peak.time_s - kRate_s)) / (2 * kRate_s);
    if (!held.empty()) m.held = held[static_cast<std::size_t>(j)];
    // The task's moment is that of its strides.
    if (s.definition.analysis.task != Task::none && out.played != Measured::Played::lead_in) {
      try {
        m.natural_Nm = naturalMoment(s, m);
      } catch (const InputError&) {  // the published data have no such joint; the page says "not known"
      }
      if (m.natural_Nm && !(*m.natural_Nm > 0)) m.natural_Nm.reset();
    }
    const std::vector<int> counted = countedLinks(*s.human, j, counting);
    m.normal_N = meanOf(s, bodies, counted, "_n_Ns");
    m.friction_N = meanOf(s, bodies, counted, "_t_Ns");
    if (const auto& strides = out.strides) {
      const double T = strides->time_s, start = strides->start_s, end = strides->end_s();
      if (m.peak.time_s >= start) m.phase_at_peak = strides->phase(m.peak.time_s, m.side);
      if (out.played == Measured::Played::strides) m.phase_of_highest = highestPhase(s, *strides, m);
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

void measureBodies(const Scenario& s, const RecordedTable& bodies, Measured& out) {
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
    out.contact.push_back({share, meanOf(s, bodies, {share.link}, "_n_Ns"), meanOf(s, bodies, {share.link}, "_t_Ns")});
}

void measureRegions(const Scenario& s, const RecordedTable& table, Measured& out) {
  const std::vector<std::string> names = regionNames(s);
  const double time = sumOf(lengthsOf(table));
  for (std::size_t k = 0; k < names.size(); ++k) {
    const VectorColumns impulse(table, names[k] + "_J", "_Ns");
    RegionMeasure m{
        s.contact_regions[k], {}, sumOf(table.column(names[k] + "_n_Ns")), sumOf(table.column(names[k] + "_t_Ns"))};
    for (std::size_t w = 0; w < table.rows(); ++w) m.mean_N += impulse[w];
    if (time > 0) m.mean_N = m.mean_N / time, m.normal_N /= time, m.friction_N /= time;
    out.contact_regions.push_back(m);
  }
}

void measureSupports(const Scenario& s, const RecordedTable& table, Measured& out) {
  const std::vector<std::string> names = supportNames(s);
  const std::vector<double>&start = table.column("start_s"), &end = table.column("end_s");
  const std::vector<double> lengths = lengthsOf(table);
  const double time = sumOf(lengths);
  for (std::size_t g = 0; g < names.size(); ++g) {
    if (!s.supports[g].cord.empty()) continue;  // its forces add up to none
    SupportMeasure m;
    m.name = s.supports[g].name;
    m.springs = !s.supports[g].springs.empty();
    const VectorColumns impulse(table, names[g] + "_", "_Ns");
    for (std::size_t w = 0; w < table.rows(); ++w) {
      m.mean_N += impulse[w];
      const double force = norm(impulse[w]) / lengths[w];
      if (force > m.peak_N) m.peak_N = force, m.peak_time_s = 0.5 * (start[w] + end[w]);
    }
    for (const double drop : table.column(names[g] + "_drop_m")) m.largest_drop_m = std::max(m.largest_drop_m, drop);
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

std::vector<GarmentMeasure> garmentMeasuresOf(const Scenario& s) {
  std::vector<GarmentMeasure> garments;
  const Case effective = withFactors(s.definition);
  for (const GarmentCase& g : effective.garments) {
    const Fabric& fabric = fabricOf(effective, g);
    const double h = fabric.thickness();
    garments.push_back({g.name, fabric.name, 0, 0, h, 0, h, h});
  }
  const std::vector<ClothPatch>& patches = s.model->cloth->patches();
  const Surface& surface = s.model->surface;
  const std::vector<double> thickness = thicknessOf(s);
  const auto garmentOf = [&](std::size_t sample) {
    return static_cast<std::size_t>(patches[static_cast<std::size_t>(surface.patch[sample])].garment);
  };
  for (std::size_t k = 0; k < garments.size(); ++k) {
    if (effective.garments[k].fields.empty() && effective.garments[k].regions.empty()) continue;
    double area = 0, volume = 0, least = std::numeric_limits<double>::infinity(), largest = 0;
    for (std::size_t i = 0; i < thickness.size(); ++i) {
      if (garmentOf(i) != k) continue;
      area += surface.area_m2[i];
      volume += surface.area_m2[i] * thickness[i];
      least = std::min(least, thickness[i]);
      largest = std::max(largest, thickness[i]);
    }
    garments[k].thickness_m = volume / area;
    garments[k].least_thickness_m = least;
    garments[k].largest_thickness_m = largest;
  }
  for (std::size_t i = 0; i < surface.area_m2.size(); ++i) {
    GarmentMeasure& l = garments[garmentOf(i)];
    l.area_m2 += surface.area_m2[i];
    l.mass_kg += surface.area_m2[i] * s.model->density_kg_per_m2[i];
  }
  for (const ClothPatch& p : patches)
    garments[static_cast<std::size_t>(p.garment)].control_points += p.end_point - p.first_point;
  return garments;
}

double countedFrom(const Scenario& s, const RecordingReader& recording) {
  const std::optional<Strides> strides = stridesOf(s.definition);
  const RecordedTable bodies = recording.table("bodies");
  const bool whole =
      strides && !bodies.empty() && bodies.column("end_s").back() > strides->start_s + strides->time_s - 1e-9;
  return whole ? strides->start_s : 0;
}

Regions regionsOf(const Scenario& s) { return {s.patch_names, s.model->surface.patch, s.model->surface.area_m2}; }

Measured measure(const Scenario& s, const RecordingReader& recording) {
  Measured out;
  out.strides = stridesOf(s.definition);
  const RecordedTable bodies = inMotion(recording, "bodies");
  out.windows = windowsOf(bodies, s.bodies);
  out.drag = windowsOf(inMotion(recording, "drag"), s.bodies);
  out.counted_from_s = countedFrom(s, recording);
  out.played = playedOf(out);
  measureBodies(s, bodies, out);
  if (s.human) measureJoints(s, recording, bodies, out);
  measureZones(s, recording, out);
  if (s.human) measureComfort(s, recording, out);
  measureRegions(s, inMotion(recording, "regions"), out);
  measureSupports(s, inMotion(recording, "supports"), out);
  for (const GarmentMeasure& l : garmentMeasuresOf(s)) out.cloth_kg += l.mass_kg;
  out.energy.negligible = 0.5 * out.cloth_kg * 1e-12;
  out.energy.lift = out.cloth_kg * norm(s.definition.gravity_m_per_s2) * EnergyMeasure::lift_m;
  measureSteps(recording, out);
  measureMemory(s, recording, out);
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
  m.seam_gap = widestSeamGap(s, recording);
  measureStretch(s, recording, m);
  measureFalls(s, recording, m);
  measureGirths(s, recording, m);
  measureGarmentOrder(s, recording, m);
  return m;
}

}  // namespace gambeson
