#include "core/motion/model.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "core/contact/halving.hpp"
#include "core/error.hpp"
#include "core/motion/sewing.hpp"
#include "core/motion/step_method.hpp"

namespace gambeson {
namespace {

/// See Model::spring_rise_m.
std::vector<Vec3> springRise(const Model& m) {
  const std::vector<ClothPatch>& patches = m.cloth->patches();
  std::vector<double> mass(patches.size(), 0), stiffness(mass.size(), 0);  // by garment, of which there are fewer
  const std::vector<double> point_mass = m.cloth->masses();
  for (const ClothPatch& patch : patches)
    for (int c = patch.first_point; c < patch.end_point; ++c) mass[patch.garment] += point_mass[c];
  const auto garment = [&](const SpringSupportPoint& s) { return patches[m.surface.patch[s.sample]].garment; };
  for (const SpringSupportPoint& s : m.springs) stiffness[garment(s)] += s.stiffness_N_per_m;
  std::vector<Vec3> rise;
  for (const SpringSupportPoint& s : m.springs)
    rise.push_back(stiffness[garment(s)] > 0
                       ? (-mass[garment(s)] / stiffness[garment(s)]) * m.environment.gravity_m_per_s2
                       : Vec3{});
  return rise;
}

/// Which motion moves each held point.
void addHeldMotion(const ModelOptions& options, Model& m) {
  const std::vector<int>& motion = options.held_motion;
  if (std::all_of(motion.begin(), motion.end(), [](int k) { return k < 0; })) return;
  constexpr int kNone = -2;
  const SparseRows& T = m.cloth->map().T;
  m.held_motion.assign(m.held_points.size(), kNone);
  for (std::size_t c = 0; c < motion.size(); ++c) {
    const int point = options.held_control_points[c];
    m.held_motion_count = std::max(m.held_motion_count, motion[c] + 1);
    for (int k = T.offsets[point]; k < T.offsets[point + 1]; ++k) {
      int& of = m.held_motion[heldSlot(m, T.columns[k])];
      if (of != kNone && of != motion[c])
        throw InputError({"", 0, "supports"},
                         "two supports hold the same point and move it differently; allowed: the same drive");
      of = motion[c];
    }
  }
}

/// Masses and areas of the free points, and which of them are held.
void addPoints(const ModelOptions& options, Model& m) {
  constexpr double kLeastShare = 0.25;  // of the untrimmed mass, where threads pull
  const FreeMap& map = m.cloth->map();
  const int n = map.T.column_count;
  m.area_m2.resize(n);
  m.mass_kg.resize(n);
  m.held.assign(n, 0);
  map.Tt.multiply<double>(m.cloth->areas(), m.area_m2);
  const bool threads = options.strain_limit.mode != LimitMode::none && !options.structure;
  map.Tt.multiply<double>(threads ? m.cloth->evenedMasses(kLeastShare) : m.cloth->masses(), m.mass_kg);
  for (int c : options.held_control_points)
    for (int k = map.T.offsets[c]; k < map.T.offsets[c + 1]; ++k) m.held[map.T.columns[k]] = 1;
  for (double a : m.area_m2) m.drag_kg_per_s.push_back(m.environment.drag_kg_per_m2s * a);
  for (int i = 0; i < n; ++i)
    if (!(m.mass_kg[i] > 0)) throw InputError({"", 0, "garment"}, "a control point would carry no mass");
  if (const Structure* s = options.structure) {
    if (s->rayleigh_stiffness_s > 0)
      throw InputError(
          {"", 0, "rayleigh_stiffness_s"},
          "explicit steps take no stiffness damping: it would cut the stable step; use an implicit scheme");
    m.structure = s;
    for (int i = 0; i < n; ++i)
      m.drag_kg_per_s[i] += s->drag_kg_per_m2s * m.area_m2[i] + s->rayleigh_mass_per_s * m.mass_kg[i];
    m.supports = std::make_unique<const Supports>(*s, m.mass_kg, m.drag_kg_per_s);
    m.held = m.supports->held();
  }
  m.inner_mass.resize(m.cloth->innerRates());
  m.cloth->innerMasses(m.inner_mass);
  if (!m.inner_mass.empty())
    m.inner_drag_per_s = std::accumulate(m.drag_kg_per_s.begin(), m.drag_kg_per_s.end(), 0.0) /
                         std::accumulate(m.mass_kg.begin(), m.mass_kg.end(), 0.0);
  for (double mass : m.inner_mass)
    if (!(mass > 0)) throw InputError({"", 0, "garment"}, "an inner unknown would carry no mass");
  for (int i = 0; i < n; ++i) {
    m.inverse_mass.push_back(m.held[i] ? 0 : 1 / m.mass_kg[i]);
    if (m.supports ? m.supports->binds(i) : m.held[i]) m.held_points.push_back(i);
  }
  addHeldMotion(options, m);
}

/// What contact asks of each sample.
void addSamples(Model& m, std::vector<int>& garment) {
  for (int s = 0; s < m.surface.size(); ++s) {
    const int patch = m.surface.patch[s];
    const Vec2 at = m.surface.parameters[s];
    const Fabric fabric = m.cloth->fabricAt(patch, at);
    m.cell_m.push_back(m.cloth->cellAt(patch, at));
    m.density_kg_per_m2.push_back(fabric.surfaceDensity());
    m.layer_m.push_back(m.contact.layer_m > 0 ? m.contact.layer_m : fabric.thickness());
    garment.push_back(m.cloth->patches()[patch].garment);
  }
}

/// Of each sample, what tells the direction of its weft from the free points.
SparseRows weftRows(const Model& m) {
  const SparseRows& T = m.cloth->map().T;
  SparseRows rows;
  rows.column_count = T.column_count;
  for (int s = 0; s < m.surface.size(); ++s) {
    const PlaceRow weft = m.cloth->mounting().weft(m.surface.patch[s], m.surface.parameters[s]);
    std::map<int, double> of_free;
    for (std::size_t k = 0; k < weft.columns.size(); ++k)
      for (int e = T.offsets[weft.columns[k]]; e < T.offsets[weft.columns[k] + 1]; ++e)
        of_free[T.columns[e]] += weft.value[k] * T.values[e];
    for (const auto& [column, value] : of_free) rows.add(column, value);
    rows.endRow();
  }
  return rows;
}

/// The projection on the seams' rows, with the part of it that a sweep over contacts sees.
void projectSeams(const SewnRows& sewn, Model& m) {
  constexpr double kLeast = 1e-4;  // of a point's own mobility: what is less only the projection sees
  m.sewing = SewnProjection(multiply(sewn.C, m.cloth->map().T), m.inverse_mass);
  m.sewn_ties = m.sewing.ties(kLeast);
}

/// What projects on the seams.
void addSewing(const ModelOptions& options, Model& m) {
  const SewnRows sewn = m.cloth->sewnRows();
  if (sewn.empty()) return;
  const auto refuse = [](const char* key, const char* why) { throw InputError({"", 0, key}, why); };
  if (m.strain_limit.mode != LimitMode::none)
    refuse("strain_limit", "limits of strain go without sewn seams; allowed with them: none");
  if (m.supports && m.supports->couple())
    refuse("supports", "sewn seams go with supports that hold points whole; allowed: all three directions of a point");
  if (m.contact.method != ContactMethod::together)
    refuse("contact.method", "goes without sewn seams; allowed with them: together");
  if (!(options.sewing.close_per_s > 0 && options.sewing.close_m_per_s > 0))
    refuse("sewing", "seams close at a rate > 0 1/s and a speed > 0 m/s");
  const SparseRows& T = m.cloth->map().T;
  m.sewing_options = options.sewing;
  m.sewn_pairs = multiply(sewn.pairs, T);
  m.sewn_cell_m = sewn.cell_m;
  projectSeams(sewn, m);
  for (int k = 0; k < sewn.rows(); ++k) {
    const int point = sewn.C.columns[sewn.C.offsets[k]];
    for (const ClothPatch& patch : m.cloth->patches())
      if (point >= patch.first_point && point < patch.end_point) {
        m.sewn_garment.push_back(patch.garment);
        break;
      }
  }
}

}  // namespace

std::unique_ptr<Model> buildModel(std::shared_ptr<const Cloth> cloth, const ModelOptions& options,
                                  const Environment& environment, const ContactParameters& contact,
                                  std::vector<Obstacle> obstacles) {
  auto model = std::make_unique<Model>();
  Model& m = *model;
  m.cloth = std::move(cloth);
  std::vector<int> per_cell = options.patch_samples_per_cell;
  if (per_cell.empty()) per_cell.assign(m.cloth->patches().size(), options.samples_per_cell);
  if (options.structure && !options.self_contact && obstacles.empty()) {  // no samples: nothing sees them
    m.surface.W.column_count = m.cloth->points();
    m.surface.WT.column_count = m.cloth->map().T.column_count;
    m.surface.WTt = transpose(m.surface.WT);
  } else {
    m.surface = m.cloth->surface(per_cell);
    m.bulges = m.cloth->bulges(m.surface, per_cell);
  }
  m.net = m.cloth->net();
  m.environment = environment;
  m.contact = contact;
  m.obstacles = std::move(obstacles);
  m.springs = options.springs;
  m.anchor_count = options.anchor_count;
  m.strain_limit = options.strain_limit;
  m.stitches = options.stitches;
  addPoints(options, m);
  std::vector<int> garment;
  addSamples(m, garment);
  if (contact.followsThreads()) m.weft = weftRows(m);
  if (!contact.of_garment.empty()) m.contact.garment_of_sample = garment;
  addStitchDamping(m.stitches, m.surface.WT, m.drag_kg_per_s);
  m.spring_rise_m = springRise(m);
  if (!options.dead_force_N.empty()) {
    if (static_cast<int>(options.dead_force_N.size()) != m.cloth->points())
      throw InputError({"", 0, "loads"}, "dead forces need one entry per control point");
    m.dead_force_N.resize(m.mass_kg.size());
    m.cloth->map().Tt.multiply<Vec3>(options.dead_force_N, m.dead_force_N);
  }
  if (options.strain_limit.mode != LimitMode::none) {
    checkLimit(options.strain_limit);
    Mobility mobility = m.supports ? m.supports->mobility() : Mobility{m.inverse_mass, {}};
    if (options.strain_limit.method != LimitMethod::fast && mobility.P.rows() > 0)
      throw InputError({"", 0, "strain_limit.method"}, "closest and provot go with supports that hold points whole");
    m.strain_rows = m.cloth->strainRows(std::move(mobility), options.strain_limit.points);
  }
  addSewing(options, m);
  m.proximity = std::make_unique<ProximityQuery>(m.obstacles);
  std::vector<Vec3> rest(m.surface.size());
  m.surface.W.multiply<Vec3>(m.cloth->rest(), rest);
  m.place = halvedPlaces(rest);
  const std::vector<Placement> placement(m.obstacles.size());
  m.collisions =
      buildCollisions(m.surface, rest, std::move(garment), m.layer_m, m.obstacles, placement, options.self_contact);
  m.method = bodyMethod(m.contact);
  if (m.method) checkMethod(m);
  return model;
}

void evenMasses(Model& m) {
  const double mean = std::accumulate(m.mass_kg.begin(), m.mass_kg.end(), 0.0) / static_cast<double>(m.mass_kg.size());
  for (std::size_t i = 0; i < m.mass_kg.size(); ++i) {
    m.mass_kg[i] = mean;
    if (m.inverse_mass[i] > 0) m.inverse_mass[i] = 1 / mean;
  }
  if (!m.sewing.empty()) projectSeams(m.cloth->sewnRows(), m);
}

void holdOnly(std::span<const int> control_points, Model& m) {
  const SparseRows& T = m.cloth->map().T;
  std::vector<char> held(m.held.size(), 0);
  for (const int c : control_points)
    for (int k = T.offsets[c]; k < T.offsets[c + 1]; ++k) held[T.columns[k]] = m.held[T.columns[k]];
  std::vector<int> points, motion;
  for (std::size_t k = 0; k < m.held_points.size(); ++k) {
    const int i = m.held_points[k];
    if (!held[i]) continue;
    points.push_back(i);
    if (!m.held_motion.empty()) motion.push_back(m.held_motion[k]);
  }
  for (std::size_t i = 0; i < held.size(); ++i) m.inverse_mass[i] = held[i] ? 0 : 1 / m.mass_kg[i];
  m.held = std::move(held);
  m.held_points = std::move(points);
  m.held_motion = std::move(motion);
  if (!m.sewing.empty()) projectSeams(m.cloth->sewnRows(), m);
  if (m.strain_limit.mode != LimitMode::none)
    m.strain_rows = m.cloth->strainRows(Mobility{m.inverse_mass, {}}, m.strain_limit.points);
}

}  // namespace gambeson
