#include "cases/wear/recording/recorder.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "cases/runs/run_identity.hpp"
#include "cases/wear/recording/recorded_scene.hpp"
#include "core/error.hpp"
#include "core/math/carried_error.hpp"
#include "core/math/parallel.hpp"

namespace gambeson {
namespace {

/// Row of "steps": how each column is combined over the steps of a window.
enum Column {
  kSteps,
  kShortest,
  kLongest,
  kContacts,
  kClothContacts,
  kImpacts,
  kImpactZones,
  kCuts,
  kPinched,
  kIntersections,
  kSmallestGap,
  kIterations,
  kUnconverged,
  kYielded,
  kResidual,
  kMomentumError,
  kDeepest,
  kWay,
  kWorkContact,
  kWorkSeparation,
  kWorkRestoring,
  kWorkFriction,
  kWorkDrag,
  kWorkSupports,
  kWorkLimit,
  kDissipated,
  kProjections,
  kUnlimited,
  kLimitResidual,
  kKinetic,
  kInternal,
  kGravity,
  kSprings,
  kFrequency,
  kMembrane,
  kBending,
  kSeam,
  kSpringShare,
  kColumns
};

void addVec(std::vector<double>& row, const Vec3& v) { row.insert(row.end(), {v.x, v.y, v.z}); }

std::vector<float> floats(std::span<const Vec3> values) {
  std::vector<float> out;
  out.reserve(3 * values.size());
  for (const Vec3& v : values) {
    out.push_back(static_cast<float>(v.x));
    out.push_back(static_cast<float>(v.y));
    out.push_back(static_cast<float>(v.z));
  }
  return out;
}

}  // namespace

const std::vector<std::string>& stepColumns() {
  static const std::vector<std::string> names{"steps",
                                              "shortest_step_s",
                                              "longest_step_s",
                                              "most_contacts",
                                              "most_cloth_contacts",
                                              "impacts",
                                              "zones",
                                              "cut_steps",
                                              "pinched",
                                              "most_intersections",
                                              "smallest_gap_m",
                                              "iterations",
                                              "unconverged_steps",
                                              "yielded_steps",
                                              "largest_residual_m_per_s",
                                              "momentum_error",
                                              "deepest_m",
                                              "largest_way_cells",
                                              "work_contact_J",
                                              "work_separation_J",
                                              "work_restoring_J",
                                              "work_friction_J",
                                              "work_drag_J",
                                              "work_supports_J",
                                              "work_limit_J",
                                              "dissipated_J",
                                              "projections",
                                              "unlimited_steps",
                                              "largest_limit_residual",
                                              "kinetic_J",
                                              "internal_J",
                                              "gravity_J",
                                              "springs_J",
                                              "frequency_rad_per_s",
                                              "membrane_share",
                                              "bending_share",
                                              "seam_share",
                                              "spring_share"};
  return names;
}

std::vector<std::string> regionNames(const Scenario& s) { return toldApart(s.contact_regions); }

std::vector<std::string> supportNames(const Scenario& s) {
  std::vector<std::string> names;
  for (const SupportGroup& g : s.supports) names.push_back(g.name);
  return toldApart(names);
}

namespace {

/// Readers take columns by their names. Throws InputError where two columns of a table would have one.
void requireOwnNames(const RecordingLayout& layout, const std::filesystem::path& file) {
  for (const auto& [table, columns] : layout.tables) {
    std::set<std::string> known;
    for (const std::string& name : columns)
      if (!known.insert(name).second)
        throw InputError({file.string(), 0, ""},
                         "two columns of the recording's table " + table + " would be called \"" + name +
                             "\"; allowed: names of garments, links, joints and obstacles that keep them apart");
  }
}

}  // namespace

RecordingLayout recordingLayout(const Scenario& s, DeviceKind device) {
  RecordingLayout layout;
  layout.identity = RunIdentity(caseIdentity(s.definition), s.model->cloth->kernels(), device).text();
  layout.metadata = writeCase(s.definition);
  layout.triangles = s.model->surface.triangles;
  layout.patches = s.model->cloth->geometry();
  for (std::size_t p = 0; p < layout.patches.size(); ++p) layout.patches[p].name = s.patch_names[p];
  const std::vector<std::string> window{"start_s", "end_s"};
  auto &bodies = layout.tables["bodies"] = window, &drag = layout.tables["drag"] = window,
       &pressing = layout.tables["normal"] = window;
  for (const std::string& name : s.bodies) {
    for (const char* part : {"_Jx_Ns", "_Jy_Ns", "_Jz_Ns", "_Lx_Nms", "_Ly_Nms", "_Lz_Nms"}) {
      bodies.push_back(name + part);
      drag.push_back(name + part);
      pressing.push_back(name + part);
    }
    bodies.push_back(name + "_n_Ns");
    bodies.push_back(name + "_t_Ns");
  }
  if (s.hasSkin()) {
    auto& skin = layout.tables["skin"] = window;
    const std::vector<std::string> joints = SkinLedger::columns(s);
    skin.insert(skin.end(), joints.begin(), joints.end());
    layout.body_triangles = s.human->skin->rest.triangles;
  }
  auto& regions = layout.tables["regions"] = window;
  for (const std::string& name : regionNames(s))
    for (const char* part : {"_Jx_Ns", "_Jy_Ns", "_Jz_Ns", "_n_Ns", "_t_Ns"}) regions.push_back(name + part);
  auto& zones = layout.tables["body_zones"] = window;
  const std::vector<std::string> sums = ZoneLedger::columns(s);
  zones.insert(zones.end(), sums.begin(), sums.end());
  auto& supports = layout.tables["supports"] = window;
  for (const std::string& name : supportNames(s))
    for (const char* part : {"_x_Ns", "_y_Ns", "_z_Ns", "_drop_m"}) supports.push_back(name + part);
  auto& steps = layout.tables["steps"] = window;
  steps.insert(steps.end(), stepColumns().begin(), stepColumns().end());
  if (s.model->cloth->losesEnergy()) steps.push_back(lost_column);
  const TimeCase& time = s.definition.time;
  if (time.auditsEnergy()) steps.push_back(integrator_column);
  if (isImplicit(time.motion.scheme)) steps.insert(steps.end(), std::begin(solve_columns), std::end(solve_columns));
  auto& sticking = layout.tables["sticking"] = window;
  sticking.insert(sticking.end(), {"bodies_n_Ns", "bodies_stuck_Ns", "cloth_n_Ns", "cloth_stuck_Ns"});
  if (ClothMemoryView(*s.model).any()) {
    auto& memory = layout.tables["memory"] = window;
    const std::vector<std::string> of_patches = ClothMemoryView::columns(s.patch_names);
    memory.insert(memory.end(), of_patches.begin(), of_patches.end());
  }
  requireOwnNames(layout, s.definition.file);
  layout.scene = sceneOf(s);
  return layout;
}

Recorder::Recorder(const Scenario& scenario, RecordingWriter& writer)
    : scenario_(scenario),
      stress_(scenario.model->cloth->stress()),
      writer_(writer),
      placed_(scenario),
      zones_(scenario),
      memory_(*scenario.model),
      bodies_(scenario.bodies.size()),
      regions_(scenario.contact_regions.size()),
      supports_(scenario.supports.size()),
      contact_(scenario.model->surface.size()),
      normal_(scenario.model->surface.size()),
      limit_(scenario.model->strain_rows.rows(), 0),
      steps_(kColumns, 0) {
  if (scenario.hasSkin()) skin_.emplace(scenario);
}

void Recorder::addSupportWork(double J) { steps_[kWorkSupports] += J; }

void Recorder::observe(const State& before, const State& after, const StepReport& r, const StepResult& work,
                       const Frequency& f) {
  // Moments about the body's origin at the middle of the step, where the impulse acts in the mean.
  const std::vector<Pose> poses = scenario_.bodyPoses(0.5 * (before.time_s + after.time_s));
  for (const ContactImpulse& c : work.contact_impulses) {
    const Vec3 received = -c.impulse;
    const double normal = dot(c.impulse, c.normal), tangential = norm(c.impulse - normal * c.normal);
    const auto give = [&](int to, double part) {
      Body& body = bodies_[to];
      body.force += part * received;
      body.moment += cross(c.point - poses[to].origin, part * received);
      body.pressing += (-part * normal) * c.normal;
      body.pressing_moment += cross(c.point - poses[to].origin, (-part * normal) * c.normal);
      body.normal += part * normal;
      body.tangential += part * tangential;
    };
    if (const int body = scenario_.body_of_obstacle[c.obstacle]; body >= 0) {
      give(body, 1);
    } else {
      for (int k = 0; k < 3 && c.touched.vertex[k] >= 0; ++k)
        give(scenario_.human->skin->segment[c.touched.vertex[k]], c.touched.weight[k]);
      skin_->add(c.touched, received, -normal * c.normal);
    }
    zones_.add(c, poses);
    Body& region = regions_[static_cast<std::size_t>(scenario_.contact_region[c.sample])];
    region.force += received;
    region.normal += normal;
    region.tangential += tangential;
    contact_[c.sample] += c.impulse;
    normal_[c.sample] += normal;
  }
  for (std::size_t g = 0; g < scenario_.supports.size(); ++g) {
    for (int k : scenario_.supports[g].springs) supports_[g] += work.spring_impulses[k];
    for (const auto& [k, part] : scenario_.supports[g].held) supports_[g] += part * work.held_impulses[k];
  }
  addSticking(before, after, r, work);
  const bool first = steps_[kSteps] == 0;
  const auto most = [&](Column c, double value) { steps_[c] = first ? value : std::max(steps_[c], value); };
  steps_[kShortest] = first ? r.step_s : std::min(steps_[kShortest], r.step_s);
  most(kLongest, r.step_s);
  most(kContacts, r.contacts);
  most(kClothContacts, r.cloth_contacts);
  most(kIntersections, r.intersections);
  steps_[kSmallestGap] = first ? r.smallest_gap_m : std::min(steps_[kSmallestGap], r.smallest_gap_m);
  steps_[kImpactZones] += r.impact_zones;
  steps_[kCuts] += r.cuts > 0;
  steps_[kPinched] += r.pinched;
  most(kResidual, r.contact.residual_m_per_s);
  most(kMomentumError, r.momentum.scale > 0 ? r.momentum.error() / r.momentum.scale : 0);
  most(kDeepest, r.deepest_m);
  most(kWay, r.largest_way);
  steps_[kSteps] += 1;
  steps_[kImpacts] += r.impacts;
  steps_[kIterations] += r.contact.iterations;
  steps_[kUnconverged] += r.contact.converged ? 0 : 1;
  steps_[kYielded] += r.contact.yielded;
  steps_[kWorkContact] += r.work.contact;
  steps_[kWorkSeparation] += r.work.separation;
  steps_[kWorkRestoring] += r.work.restoring;
  steps_[kWorkFriction] += r.work.friction;
  steps_[kWorkDrag] += r.work.drag;
  steps_[kWorkSupports] += r.work.supports;
  steps_[kWorkLimit] += r.work.limit;
  steps_[kDissipated] += r.work.dissipated;
  lost_J_ += r.work.cloth;
  integrator_J_ += r.work.integrator;
  solve_iterations_ += r.solve.iterations;
  if (r.momentum.scale > 0) largest_missed_ = std::max(largest_missed_, norm(r.momentum.missed) / r.momentum.scale);
  steps_[kProjections] += r.limit.projections;
  steps_[kUnlimited] += r.limit.converged ? 0 : 1;
  most(kLimitResidual, r.limit.residual);
  for (std::size_t i = 0; i < limit_.size(); ++i) limit_[i] += r.step_s * after.limit_J[i];
  steps_[kFrequency] = f.largest_rad_per_s;
  steps_[kMembrane] = f.membrane_share;
  steps_[kBending] = f.bending_share;
  steps_[kSeam] = f.seam_share;
  steps_[kSpringShare] = f.spring_share;
}

void Recorder::addSticking(const State& before, const State& after, const StepReport& r, const StepResult& work) {
  const Model& m = *scenario_.model;
  const SparseRows& WT = m.surface.WT;
  const auto pressing = [&](std::size_t i) {
    const double normal = dot(work.impulses[i], work.rows[i].contact.normal);
    return normal > 0 && !work.rows[i].slippery ? normal : 0.0;
  };
  std::vector<char> sticks(work.rows.size());
  forAll(Each::sum, static_cast<int>(work.rows.size()), [&](int at) {
    const auto i = static_cast<std::size_t>(at);
    if (pressing(i) == 0) return;
    const ContactRow& row = work.rows[i];
    Vec3 v = -row.body_velocity;
    for (int j = 0; j < row.stencil.count; ++j) {
      const int s = row.stencil.sample[j];
      for (int k = WT.offsets[s]; k < WT.offsets[s + 1]; ++k)
        v += (row.stencil.weight[j] * WT.values[k] / r.step_s) * (after.p[WT.columns[k]] - before.p[WT.columns[k]]);
    }
    sticks[i] = norm(v - dot(v, row.contact.normal) * row.contact.normal) <= m.contact.still(r.step_s);
  });
  for (std::size_t i = 0; i < work.rows.size(); ++i) {
    const double normal = pressing(i);
    if (normal == 0) continue;
    const std::size_t of = work.rows[i].contact.onBody() ? 0 : 2;
    sticking_[of] += normal;
    if (sticks[i]) sticking_[of + 1] += normal;
  }
}

void Recorder::closeWindow(const State& state, double start_s, bool frame, StepWork& work) {
  const Model& m = *scenario_.model;
  const double window = state.time_s - start_s;
  const std::vector<double> head{start_s, state.time_s};
  const std::vector<Pose> poses = scenario_.bodyPoses(state.time_s);

  std::vector<double> row = head;
  for (const Body& b : bodies_) {
    addVec(row, b.force);
    addVec(row, b.moment);
    row.insert(row.end(), {b.normal, b.tangential});
  }
  writer_.append(TableRow{"bodies", row});
  row = head;
  for (const Body& b : bodies_) {
    addVec(row, b.pressing);
    addVec(row, b.pressing_moment);
  }
  writer_.append(TableRow{"normal", row});
  row = head;
  row.insert(row.end(), zones_.row().begin(), zones_.row().end());
  writer_.append(TableRow{"body_zones", row});
  if (skin_) {
    row = head;
    const std::vector<double> joints = skin_->row(0.5 * (start_s + state.time_s));
    row.insert(row.end(), joints.begin(), joints.end());
    writer_.append(TableRow{"skin", row});
  }
  row = head;
  for (const Body& b : regions_) {
    addVec(row, b.force);
    row.insert(row.end(), {b.normal, b.tangential});
  }
  writer_.append(TableRow{"regions", row});

  // Drag at the window's end, on the body nearest to each sample.
  std::vector<Body> drag(bodies_.size());
  std::vector<Vec3> x(m.surface.size()), v(m.surface.size());
  m.surface.WT.multiply<Vec3>(state.p, x);
  m.surface.WT.multiply<Vec3>(state.v, v);
  if (m.environment.drag_kg_per_m2s > 0 && !m.obstacles.empty()) {
    const Vec3 air = scenario_.stage->air(state.time_s);
    std::vector<int> nearest(x.size(), 0);
    if (bodies_.size() > 1) {
      placed_.moveTo(state.time_s);
      forAll(Each::much, m.surface.size(), [&](int s) { nearest[s] = placed_.nearest(x[s]).body; });
    }
    for (int s = 0; s < m.surface.size(); ++s) {
      const Vec3 f = (-m.environment.drag_kg_per_m2s * m.surface.area_m2[s] * window) * (v[s] - air);
      drag[nearest[s]].force += f;
      drag[nearest[s]].moment += cross(x[s] - poses[nearest[s]].origin, f);
    }
  }
  row = head;
  for (const Body& b : drag) {
    addVec(row, b.force);
    addVec(row, b.moment);
  }
  writer_.append(TableRow{"drag", row});

  row = head;
  for (std::size_t g = 0; g < scenario_.supports.size(); ++g) {
    addVec(row, supports_[g]);
    double drop = 0;
    const SupportGroup& group = scenario_.supports[g];
    if (!group.springs.empty()) {
      std::vector<Placement> obstacles(m.obstacles.size()), anchors(m.anchor_count);
      scenario_.stage->placements(state.time_s, obstacles, anchors);
      const double size = norm(m.environment.gravity_m_per_s2);
      const Vec3 down = size > 0 ? m.environment.gravity_m_per_s2 / size : Vec3{};
      for (int k : group.springs)
        drop += dot(x[m.springs[k].sample] + m.spring_rise_m[k] - anchors[group.anchor] * state.anchors[k], down) /
                static_cast<double>(group.springs.size());
    }
    row.push_back(drop);
  }
  writer_.append(TableRow{"supports", row});

  const Energy energy = energyOf(m, *scenario_.stage, state, work);
  steps_[kKinetic] = energy.kinetic;
  steps_[kInternal] = energy.internal;
  steps_[kGravity] = energy.gravity;
  steps_[kSprings] = energy.springs;
  row = head;
  row.insert(row.end(), steps_.begin(), steps_.end());
  if (m.cloth->losesEnergy()) row.push_back(std::exchange(lost_J_, 0));
  const TimeCase& time = scenario_.definition.time;
  const double own_J = std::exchange(integrator_J_, 0), missed = std::exchange(largest_missed_, 0),
               iterations = static_cast<double>(std::exchange(solve_iterations_, 0));
  if (time.auditsEnergy()) row.push_back(own_J);
  if (isImplicit(time.motion.scheme)) row.insert(row.end(), {iterations, missed});
  writer_.append(TableRow{"steps", row});
  row = head;
  row.insert(row.end(), sticking_.begin(), sticking_.end());
  sticking_.fill(0);
  writer_.append(TableRow{"sticking", row});
  if (memory_.any()) {
    row = head;
    const std::vector<double> of_patches = memory_.row(state.history, static_cast<int>(scenario_.patch_names.size()));
    row.insert(row.end(), of_patches.begin(), of_patches.end());
    writer_.append(TableRow{"memory", row});
  }

  if (frame) appendFrame(state, window);
  if (skin_) skin_->clear();
  zones_.clear();
  std::fill(bodies_.begin(), bodies_.end(), Body{});
  std::fill(regions_.begin(), regions_.end(), Body{});
  std::fill(supports_.begin(), supports_.end(), Vec3{});
  std::fill(contact_.begin(), contact_.end(), Vec3{});
  std::fill(normal_.begin(), normal_.end(), 0.0);
  std::fill(limit_.begin(), limit_.end(), 0.0);
  std::fill(steps_.begin(), steps_.end(), 0.0);
}

namespace {

/// Area now over area at rest, sqrt((1 + 2 E1) (1 + 2 E2)) of the principal Green-Lagrange strains. Cloth is crushed
/// to a tenth of its length at most.
double areaRatio(const PrincipalStress& s) {
  return std::sqrt(std::max(1 + 2 * s.strain1, 0.01) * std::max(1 + 2 * s.strain2, 0.01));
}

}  // namespace

void Recorder::appendFrame(const State& state, double window) {
  const Model& m = *scenario_.model;
  const int n = m.surface.size();
  Frame frame;
  frame.time_s = state.time_s;
  std::vector<Vec3> x(n), v(n), q(m.cloth->points()), force(n);
  m.surface.WT.multiply<Vec3>(state.p, x);
  m.surface.WT.multiply<Vec3>(state.v, v);
  m.cloth->map().T.multiply<Vec3>(state.p, q);
  frame.positions = floats(x);
  Field velocity{"velocity", "m/s", 3, floats(v)}, contact{"contact_force", "N", 3, {}},
      pressure{"pressure", "Pa", 1, {}};
  for (int s = 0; s < n; ++s) force[s] = contact_[s] / window;
  contact.data = floats(force);
  pressure.data.resize(n);
  Field area{"area", "m^2", 1, std::vector<float>(n)};
  Field s1{"stress", "N/m", 1, std::vector<float>(n)}, s2{"stress_second", "N/m", 1, std::vector<float>(n)};
  Field e1{"strain", "1", 1, std::vector<float>(n)}, e2{"strain_second", "1", 1, std::vector<float>(n)};
  // Strain limits pull in impulses, one a step: like the contact forces, the mean over the window.
  for (double& l : limit_) l /= window;
  const std::vector<Vec2> limits = limit_.empty() ? std::vector<Vec2>{} : limitStress(m.strain_rows, limit_);
  StressView::More more;
  if (!limits.empty())
    more = [&](int patch, Vec2 uv) { return m.cloth->limitStressAt(m.strain_rows, limits, patch, uv); };
  const ClothState at(q);
  const std::vector<StressView::Sample> means = stress_->means(at, more);
  CarriedError error;
  forAll(Each::much, n, [&](int s) {
    error.guard(s, [&] {
      const PrincipalStress stress = stress_->at(at, m.surface.patch[s], m.surface.parameters[s], means, more);
      s1.data[s] = static_cast<float>(stress.principal1_N_per_m);
      s2.data[s] = static_cast<float>(stress.principal2_N_per_m);
      e1.data[s] = static_cast<float>(stress.strain1);
      e2.data[s] = static_cast<float>(stress.strain2);
      const double now_m2 = m.surface.area_m2[s] * areaRatio(stress);
      area.data[s] = static_cast<float>(now_m2);
      pressure.data[s] = static_cast<float>(normal_[s] / (now_m2 * window));
    });
  });
  error.rethrow();
  frame.sample_fields = {velocity, contact, pressure, area, s1, s2, e1, e2};
  if (memory_.any()) {
    const ClothMemory memory = memory_.at(state.history);
    frame.sample_fields.push_back({"set", "1/m", 1, {memory.set_per_m.begin(), memory.set_per_m.end()}});
    frame.sample_fields.push_back(
        {"friction_left", "1", 1, {memory.friction_left.begin(), memory.friction_left.end()}});
  }
  frame.control_fields = {Field{"position", "m", 3, floats(q)}};
  if (skin_) addSkin(state, window, frame);
  writer_.append(std::move(frame));
}

/// Pressure: the normal force on a vertex over a third of the area of its triangles.
void Recorder::addSkin(const State& state, double window, Frame& frame) const {
  const DeformedVertices skin = deformedVertices(*scenario_.model, *scenario_.stage, state.time_s);
  const std::span<const Vec3> x = skin[0];
  std::vector<double> area(x.size(), 0);
  for (const auto& t : scenario_.human->skin->rest.triangles) {
    const double third = norm(cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]])) / 6;
    for (int v : t) area[v] += third;
  }
  std::vector<Vec3> force(x.size());
  Field pressure{"pressure", "Pa", 1, std::vector<float>(x.size())};
  for (std::size_t v = 0; v < x.size(); ++v) {
    force[v] = skin_->received()[v] / window;
    pressure.data[v] = static_cast<float>(area[v] > 0 ? skin_->normal()[v] / (area[v] * window) : 0);
  }
  frame.body_fields = {Field{"position", "m", 3, floats(x)}, Field{"contact_force", "N", 3, floats(force)}, pressure};
}

}  // namespace gambeson
