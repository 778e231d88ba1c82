#include "cases/scenario.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cases/draft.hpp"
#include "cases/dress.hpp"
#include "cases/factors.hpp"
#include "cases/obstacle_shape.hpp"
#include "cases/overloaded.hpp"
#include "core/contact/mesh_topology.hpp"
#include "core/dynamics/step.hpp"
#include "core/error.hpp"
#include "core/sheet/layers.hpp"
#include "human/blend.hpp"
#include "human/load.hpp"
#include "human/mesh_sequence.hpp"
#include "human/skin_overlap.hpp"
#include "tryon/projecting.hpp"
#include "tryon/skin_projecting.hpp"
#include "tryon/stitching.hpp"

namespace gambeson {
namespace {

/// Feet of our own motions slip and sink by a centimetre or two at most.
bool plausible(const FootReport& f) { return f.slip_m < 0.05 && f.penetration_m < 0.02 && f.hover_m < 0.02; }

/// The human through dressing, settling and the motion, and the case's own obstacles.
class CaseStage : public Stage {
 public:
  const Human* human = nullptr;
  const Motion* motion = nullptr;
  std::vector<Placement> shrunk;  ///< of the human's shapes, empty without projecting
  std::vector<Vec3> shrunk_skin;  ///< of the human's skin, the same
  double grow_start_s = 0, grow_s = 0;
  std::optional<Posture> dressed;  ///< posture that the garments are put on in, left from settle_start_s on
  double settle_start_s = 0;
  std::vector<Placement> fixed;
  std::vector<Vec3> fixed_velocity;
  std::vector<std::unique_ptr<const MeshSequence>> sequence;  ///< as `fixed`; null for those that do not deform
  int first_fixed = 0;                                        ///< obstacle
  Vec3 air_velocity;
  double air_ramp_s = 0;

  void placements(double t, std::span<Placement> obstacles, std::span<Placement> anchors) const override {
    std::size_t at = 0;
    if (human) {
      const Posture posture = postureAt(t);
      const std::vector<Pose> poses = linkPoses(human->skeleton, posture.q, posture.root);
      std::vector<Placement> body = obstaclePlacementsOf(*human, poses);
      if (!shrunk.empty() && t < grow_start_s + grow_s)
        body = placementsDuringGrowth(body, shrunk, (t - grow_start_s) / grow_s);
      for (const Placement& p : body) obstacles[at++] = p;
      for (std::size_t l = 0; l < anchors.size(); ++l) anchors[l] = {poses[l].rotation, poses[l].origin, 1};
    }
    for (std::size_t k = 0; k < fixed.size(); ++k) {
      obstacles[at] = fixed[k];
      if (!sequence[k]) obstacles[at].origin += t * fixed_velocity[k];
      ++at;
    }
  }

  /// From the posture of dressing into that in which the motion starts, in the first two thirds of the time to settle.
  Posture postureAt(double t) const {
    const Posture first = motion->at(std::max(t, 0.0));
    if (!dressed || t >= 0 || !(settle_start_s < 0)) return first;
    const double x = std::clamp(1.5 * (t - settle_start_s) / -settle_start_s, 0.0, 1.0);
    return blend(*dressed, first, x * x * x * (10 + x * (6 * x - 15)));
  }

  void vertices(int obstacle, double t, std::span<Vec3> x) const override {
    if (obstacle >= first_fixed) {
      const auto k = static_cast<std::size_t>(obstacle - first_fixed);
      sequence[k]->at(t, x);
      for (Vec3& p : x) p += t * fixed_velocity[k];
      return;
    }
    const Posture posture = postureAt(t);
    skinPositions(*human->skin, linkPoses(human->skeleton, posture.q, posture.root), x);
    if (shrunk_skin.empty() || !(t < grow_start_s + grow_s)) return;
    const double w = grownPart((t - grow_start_s) / grow_s);
    for (std::size_t v = 0; v < x.size(); ++v) x[v] = shrunk_skin[v] + w * (x[v] - shrunk_skin[v]);
  }

  /// The air starts with the motion, smoothly over the lead-in.
  Vec3 air(double t) const override {
    if (air_ramp_s <= 0) return air_velocity;
    const double x = std::clamp(t / air_ramp_s, 0.0, 1.0);
    return (x * x * (3 - 2 * x)) * air_velocity;
  }
};

/// Drafted on the human's measures.
bool isDrafted(const GarmentCase& g) {
  return std::holds_alternative<ShortsGarment>(g.shape) || std::holds_alternative<BeltGarment>(g.shape) ||
         std::holds_alternative<ShirtGarment>(g.shape) || std::holds_alternative<SkirtGarment>(g.shape);
}

/// The garment without its seams, springs in their place, and the panels moved off the body (as `start`).
void standPanelsApart(const Stitching& law, const std::vector<int>& samples_per_cell, Garment& garment,
                      std::vector<Vec3>& start, std::vector<Stitch>& stitches) {
  const std::vector<Vec3> offsets = panelOffsets(garment, law.offset_m);
  const std::vector<int> first = controlOffsets(garment);
  for (std::size_t p = 0; p < offsets.size(); ++p)
    for (int i = first[p]; i < first[p + 1]; ++i) start[static_cast<std::size_t>(i)] += offsets[p];
  const Garment open = unsewn(garment);
  stitches = stitchesOf(garment, buildSurface(open, buildFreeMap(open), samples_per_cell),
                        {law.stiffness_N_per_m2, law.damping_kg_per_m_s});
  garment = open;
}

std::vector<PatchEdge> edgesOf(const Case& c, const std::vector<NamedEdge>& known, const EdgeCase& e) {
  if (e.name.empty()) return {{e.patch, e.side, false}};
  for (const NamedEdge& edge : known)
    if (edge.name == e.name) return edge.edges;
  throw InputError({c.file.string(), 0, "supports"}, "the garment has no edge \"" + e.name + "\"");
}

void noteDefects(const MeshObstacle& file, const std::string& name, const Obstacle& obstacle,
                 std::vector<std::string>& notes) {
  std::string defects;
  try {
    defects = meshDefects(meshTopology(std::get<TriangleMesh>(obstacle.shape)));
  } catch (const InputError& e) {
    throw InputError({file.file.string(), 0, ""}, "the mesh of obstacle " + name + ": " + e.reason());
  }
  if (!defects.empty()) notes.push_back("obstacle " + name + " (" + file.file.filename().string() + ") " + defects);
}

void noteSequence(const SequenceObstacle& file, const MeshSequence& sequence, const std::string& name,
                  std::vector<std::string>& notes) {
  std::string defects;
  try {
    defects = meshDefects(meshTopology(sequence.first()));
  } catch (const InputError& e) {
    throw InputError({file.folder.string(), 0, ""}, "the mesh of obstacle " + name + ": " + e.reason());
  }
  notes.push_back(fmt::format("obstacle {} ({}): {} frames from {:.3f} to {:.3f} s, {} triangles{}", name,
                              file.folder.filename().string(), sequence.frames(), file.begin_s, sequence.end_s(),
                              sequence.triangles().size(), defects.empty() ? "" : "; it " + defects));
}

/// `first`: the first patch of each garment; `known`: its named edges.
void addSupports(const Case& c, const Garment& garment, const std::vector<int>& first,
                 const std::vector<std::vector<NamedEdge>>& known, const Surface& surface, const Human* human,
                 ModelOptions& options, std::vector<SupportGroup>& groups) {
  for (const SupportCase& support : c.supports) {
    SupportGroup group;
    const EdgeCase& edge = std::visit([](const auto& s) -> const EdgeCase& { return s.edge; }, support);
    std::size_t worn = 0;
    if (!edge.garment.empty())
      while (c.garments[worn].name != edge.garment) ++worn;
    const std::string of = c.garments.size() == 1 ? "" : edge.garment + " ";
    const std::string name = of + (edge.name.empty() ? "edge of patch " + std::to_string(edge.patch) : edge.name);
    std::vector<PatchEdge> edges;
    if (!std::holds_alternative<PinnedSupport>(support)) edges = edgesOf(c, known[worn], edge);
    for (PatchEdge& e : edges) {
      if (e.patch >= first[worn + 1] - first[worn])
        throw InputError({c.file.string(), 0, "supports"}, "patch " + std::to_string(e.patch) +
                                                               " does not exist; the garment has " +
                                                               std::to_string(first[worn + 1] - first[worn]));
      e.patch += first[worn];
      for (int s : edgeSamples(surface, e))
        if (std::find(group.samples.begin(), group.samples.end(), s) == group.samples.end()) group.samples.push_back(s);
    }
    if (const auto* pinned = std::get_if<PinnedSupport>(&support)) {
      const int p = edge.patch + first[worn];
      const NurbsPatch& patch = garment.patches[p];
      const auto at = [](const KnotVector& k, double part) { return k.front() + part * (k.back() - k.front()); };
      const SurfaceBasis basis = surfaceBasis(patch, at(patch.u, pinned->s), at(patch.v, pinned->t));
      group.name = of + "point held";
      for (std::size_t k = 0; k < basis.columns.size(); ++k)
        if (basis.values[0][k] > 1e-12)
          options.held_control_points.push_back(controlOffsets(garment)[p] + basis.columns[k]);
    } else if (const auto* fixed = std::get_if<FixedSupport>(&support)) {
      group.name = name + " held";
      for (const PatchEdge& e : edges) {
        const EdgeColumns columns = edgeColumns(garment, e);
        options.held_control_points.insert(options.held_control_points.end(), columns.edge.begin(), columns.edge.end());
        if (fixed->rows > 1)
          options.held_control_points.insert(options.held_control_points.end(), columns.inner.begin(),
                                             columns.inner.end());
      }
    } else {
      const auto& springs = std::get<SpringSupport>(support);
      group.name = name + " springs to " + springs.link;
      group.anchor = human->skeleton.link(springs.link);
      if (group.anchor < 0)
        throw InputError({c.file.string(), 0, "supports.springs.link"},
                         "the human has no link \"" + springs.link + "\"");
      // Each sample answers for half of the edge to either neighbour.
      std::vector<double> length(surface.size(), 0);
      std::vector<Vec3> Q;
      for (const NurbsPatch& p : garment.patches) Q.insert(Q.end(), p.points.begin(), p.points.end());
      std::vector<Vec3> X(surface.size());
      surface.W.multiply<Vec3>(Q, X);
      for (const PatchEdge& e : edges) {
        const std::vector<int> at = edgeSamples(surface, e);
        for (std::size_t k = 0; k + 1 < at.size(); ++k) {
          const double half = 0.5 * norm(X[at[k + 1]] - X[at[k]]);
          length[at[k]] += half;
          length[at[k + 1]] += half;
        }
      }
      for (int s : group.samples) {
        group.springs.push_back(static_cast<int>(options.springs.size()));
        options.springs.push_back({s, group.anchor, springs.stiffness_N_per_m2 * length[s]});
      }
    }
    groups.push_back(std::move(group));
  }
}

/// Fills `contact_groups` and `contact_group` from the regions: `press` of each.
void groupContact(Scenario& s, const Garment& garment, const std::vector<std::string>& layers,
                  const std::vector<Press>& press) {
  for (std::size_t i = 0; i < s.contact_region.size(); ++i) {
    const int patch = s.model->surface.patch[i];
    const ContactGroup group{layers[static_cast<std::size_t>(garment.layerOf(patch))],
                             press[static_cast<std::size_t>(s.contact_region[i])]};
    const auto at = std::find(s.contact_groups.begin(), s.contact_groups.end(), group);
    s.contact_group.push_back(static_cast<int>(at - s.contact_groups.begin()));
    if (at == s.contact_groups.end()) s.contact_groups.push_back(group);
  }
}

/// Fills `contact_regions` and `contact_region`, and with them the groups; `q`: the control points at the start.
void nameContactRegions(Scenario& s, const Garment& garment, const std::vector<Garment>& garments,
                        const std::vector<int>& first, const std::vector<Vec3>& q) {
  const Surface& surface = s.model->surface;
  std::vector<Vec3> x(static_cast<std::size_t>(surface.size()));
  surface.W.multiply<Vec3>(q, x);
  s.contact_regions = s.patch_names;
  s.contact_region = surface.patch;
  std::vector<Press> press(s.patch_names.size(), Press::free);
  std::vector<std::string> layers;
  for (std::size_t k = 0; k < garments.size(); ++k) {
    const std::string& called = s.definition.garments[k].name;
    layers.push_back(!called.empty() ? called : !garments[k].name.empty() ? garments[k].name : "garment");
  }
  for (std::size_t k = 0; k < garments.size(); ++k) {
    if (garments[k].name != "belt") continue;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t i = 0; i < x.size(); ++i)
      if (surface.patch[i] >= first[k] && surface.patch[i] < first[k + 1])
        low = std::min(low, x[i].z), high = std::max(high, x[i].z);
    const int region = static_cast<int>(s.contact_regions.size());
    std::fill(press.begin() + first[k], press.begin() + first[k + 1], Press::belt);
    press.push_back(Press::belt);
    s.contact_regions.push_back("under " + s.patch_names[static_cast<std::size_t>(first[k])]);
    for (std::size_t i = 0; i < x.size(); ++i)
      if (garment.layerOf(surface.patch[i]) < static_cast<int>(k) && x[i].z >= low && x[i].z <= high)
        s.contact_region[i] = region;
  }
  for (const SupportGroup& group : s.supports) {
    if (group.springs.empty()) continue;
    for (const int i : group.samples)
      s.contact_region[static_cast<std::size_t>(i)] = static_cast<int>(s.contact_regions.size());
    s.contact_regions.push_back(group.name);
    press.push_back(Press::held);
  }
  groupContact(s, garment, layers, press);
}

}  // namespace

std::string feetText(const FootReport& f) {
  return fmt::format(
      "the foot that stands slips by up to {:.1f} mm (at most {:.2f} m/s, at {:.2f} s), feet enter the "
      "ground by up to {:.1f} mm (at {:.2f} s) and hover up to {:.1f} mm above it (at {:.2f} s)",
      1e3 * f.slip_m, f.slip_m_per_s, f.slip_time_s, 1e3 * f.penetration_m, f.penetration_time_s, 1e3 * f.hover_m,
      f.hover_time_s);
}

std::vector<Placement> Scenario::obstaclePlacements(double time_s) const {
  std::vector<Placement> obstacles(model->obstacles.size()), anchors(model->anchor_count);
  stage->placements(time_s, obstacles, anchors);
  return obstacles;
}

int Scenario::bodyOf(int obstacle, const MaterialPoint& touched) const {
  const int body = body_of_obstacle[obstacle];
  if (body >= 0) return body;
  const auto most = std::max_element(touched.weight.begin(), touched.weight.end()) - touched.weight.begin();
  return human->skin->segment[touched.vertex[most]];
}

std::vector<Pose> Scenario::bodyPoses(double time_s) const {
  std::vector<Placement> obstacles(model->obstacles.size()), anchors(model->anchor_count);
  stage->placements(time_s, obstacles, anchors);
  std::vector<Pose> poses;
  for (const Placement& a : anchors) poses.push_back({a.rotation, a.origin});
  for (std::size_t o = 0; o < obstacles.size(); ++o)
    if (body_of_obstacle[o] >= static_cast<int>(anchors.size()))
      poses.push_back({obstacles[o].rotation, obstacles[o].origin});
  return poses;
}

namespace {

/// Reads a recorded motion, its mean velocity, and what a user should know of it; returns when its window begins.
double readRecorded(const MotionFileOptions& m, Scenario& s) {
  MotionFileNotes notes;
  s.motion = loadMotionFile(m, *s.human, &notes);
  const Vec3 way = s.motion->at(s.motion->duration()).root.origin - s.motion->at(notes.window_s).root.origin;
  s.mean_velocity_m_per_s = Vec3{way.x, way.y, 0} / (s.motion->duration() - notes.window_s);
  const std::string file = m.path.filename().string();
  for (const std::string& line : notes.lines) s.notes.push_back(fmt::format("motion {}: {}", file, line));
  if (notes.beyond_limits_deg > 5)
    s.notes.push_back(fmt::format("motion {}: {} goes {:.0f} degrees beyond its limits", file, notes.beyond_joint,
                                  notes.beyond_limits_deg));
  s.notes.push_back(fmt::format(
      "motion {}: feet at most {:.0f} mm below and {:.0f} mm above the ground, slip of carrying feet {:.2f} m/s RMS",
      file, 1e3 * notes.feet.deepest_m, 1e3 * notes.feet.highest_m, notes.feet.slip_m_per_s));
  return notes.window_s;
}

void noteCharacter(const CharacterOptions& options, const CharacterReport& found, std::vector<std::string>& notes) {
  const std::string file = options.file.filename().string();
  notes.push_back(fmt::format(
      "character {}: bones as in the map {}, {}-pose (arms {:.0f} degrees from hanging down), {:.3f} m tall, {:.1f} "
      "litres",
      file, found.map, found.pose, found.arms_deg, found.height_m, 1000 * found.volume_m3));
  for (const std::string& note : found.notes) notes.push_back(fmt::format("character {}: {}", file, note));
}

/// Says where the skin passes through itself, and switches it off there where asked. Our own motions keep our own skins
/// from it (tests/unit/human/skin_fold_test.cpp).
void noteFolds(const HumanCase& human, Scenario& s) {
  constexpr double every_s = 0.05;
  const OverlapOfMotion o = overlapOf(*s.human, *s.motion, every_s);
  if (o.folded == 0) return;
  std::string note = fmt::format(
      "the skin passes through itself at {} of {} instants of the motion, with at most {:.1f} cm^2 (at {:.2f} s), at "
      "{}",
      o.folded, o.instants, 1e4 * o.largest_m2, o.largest_time_s, fmt::join(o.links, ", "));
  if (human.character && human.character->folds_off) {
    Skin skin = *s.human->skin;
    skin.off = o.triangles;
    s.human->skin = std::make_shared<const Skin>(std::move(skin));
    note += fmt::format("; {:.1f} cm^2 are switched off", 1e4 * o.area_m2);
  } else if (std::holds_alternative<MotionFileOptions>(human.motion)) {
    note += "; hips_apart and arms_apart hold the limbs apart";
  }
  s.notes.push_back(note);
}

std::unique_ptr<Scenario> buildUnnamed(const Case& written, bool panels) {
  auto s = std::make_unique<Scenario>();
  s->definition = written;
  const Case c = withFactors(written);
  auto stage = std::make_unique<CaseStage>();
  std::vector<Obstacle> obstacles;
  double duration = c.time.duration_s.value_or(0);
  if (c.human) {
    CharacterReport character;
    s->human = humanOf(*c.human, &character);
    if (c.human->character) noteCharacter(*c.human->character, character, s->notes);
    std::visit(Overloaded{
                   [&](const StandMotion& m) {
                     class Standing : public Motion {
                      public:
                       Standing(Posture p, double d) : posture_(std::move(p)), duration_(d) {}
                       double duration() const override { return duration_; }
                       Posture at(double) const override { return posture_; }

                      private:
                       Posture posture_;
                       double duration_;
                     };
                     s->motion = std::make_unique<Standing>(standing(*s->human), m.duration_s);
                   },
                   [&](const WalkOptions& w) {
                     s->motion = makeWalk(*s->human, w, &s->mean_velocity_m_per_s);
                     stage->air_ramp_s = w.stand_s + w.lead_in_s;
                   },
                   [&](const StairOptions& o) {
                     s->motion = makeStairs(*s->human, o, &s->mean_velocity_m_per_s);
                     stage->air_ramp_s = o.stand_s + o.lead_in_s;
                   },
                   [&](const AimOptions& o) { s->motion = makeAim(*s->human, o); },
                   [&](const TrajectoryMotion& t) { s->motion = loadTrajectory(t.file, *s->human); },
                   [&](const MotionFileOptions& m) { stage->air_ramp_s = readRecorded(m, *s); },
               },
               c.human->motion);
    if (!c.time.duration_s) duration = s->motion->duration();
    const bool own_motion = !std::holds_alternative<MotionFileOptions>(c.human->motion) &&
                            !std::holds_alternative<TrajectoryMotion>(c.human->motion);
    if (s->human->skin && !(own_motion && c.human->skin)) noteFolds(*c.human, *s);
    s->feet = footReport(*s->human, *s->motion);
    const bool told = std::holds_alternative<MotionFileOptions>(c.human->motion);  // by its own reader
    if (s->feet && !told && !plausible(*s->feet))
      s->notes.push_back("the feet do not stand well: " + feetText(*s->feet));
    stage->human = &*s->human;
    stage->motion = s->motion.get();
    obstacles = obstaclesOf(*s->human);
    for (const Link& link : s->human->skeleton.links) s->bodies.push_back(link.name);
    if (s->human->skin)
      s->body_of_obstacle.push_back(-1);
    else
      for (const BodyShape& shape : s->human->shapes) s->body_of_obstacle.push_back(shape.link);
  }
  stage->air_velocity = c.air.with_pelvis ? s->mean_velocity_m_per_s : c.air.velocity_m_per_s;
  if (!c.air.with_pelvis) stage->air_ramp_s = 0;
  stage->first_fixed = static_cast<int>(obstacles.size());
  for (const ObstacleCase& o : c.obstacles) {
    Placement at;
    stage->sequence.push_back(nullptr);
    if (const auto* frames = std::get_if<SequenceObstacle>(&o.shape)) {
      stage->sequence.back() = std::make_unique<const MeshSequence>(*frames);
      obstacles.push_back({stage->sequence.back()->first(), o.name, true});
      noteSequence(*frames, *stage->sequence.back(), o.name, s->notes);
    } else {
      obstacles.push_back({shapeOf(o, at), o.name});
    }
    if (const auto* mesh = std::get_if<MeshObstacle>(&o.shape)) noteDefects(*mesh, o.name, obstacles.back(), s->notes);
    stage->fixed.push_back(at);
    stage->fixed_velocity.push_back(o.velocity_m_per_s);
    s->body_of_obstacle.push_back(static_cast<int>(s->bodies.size()));
    s->bodies.push_back(o.name);
  }

  const Human* human = s->human ? &*s->human : nullptr;
  const std::vector<Garment> garments = draftGarments(c, human);
  std::vector<int> first{0};
  std::vector<std::vector<NamedEdge>> edges;
  for (std::size_t k = 0; k < garments.size(); ++k) {
    const Garment& g = garments[k];
    const std::string& name = c.garments[k].name;
    for (const std::string& part : g.patch_names)
      s->patch_names.push_back(garments.size() == 1 ? part : g.patches.size() == 1 ? name : name + " " + part);
    s->samples_per_cell.insert(s->samples_per_cell.end(), g.patches.size(), c.garments[k].samples_per_cell);
    if (std::find(s->fabric_names.begin(), s->fabric_names.end(), g.fabric.name) == s->fabric_names.end())
      s->fabric_names.push_back(g.fabric.name);
    first.push_back(first.back() + static_cast<int>(g.patches.size()));
    edges.push_back(g.edges);
  }
  std::vector<Vec3> start = startDisplacements(c, garments);
  Garment garment = garments.size() == 1 ? garments[0] : joinLayers(garments);
  scaleSeams(garment, written.factors);
  ModelOptions options;
  if (panels) standPanelsApart(*c.garments[0].stitching, s->samples_per_cell, garment, start, options.stitches);
  options.patch_samples_per_cell = s->samples_per_cell;
  options.self_contact = c.contact.self;
  options.anchor_count = human ? static_cast<int>(human->skeleton.links.size()) : 0;
  addSupports(c, garment, first, edges, buildSurface(garment, buildFreeMap(garment), s->samples_per_cell), human,
              options, s->supports);
  if (const auto& limit = c.strain_limit) options.strain_limit = limitOf(*limit);
  Environment environment{c.gravity_m_per_s2, c.air.drag_kg_per_m2s};
  const double g = norm(c.gravity_m_per_s2);
  const ContactParameters contact{c.contact.layer_m.value_or(0), c.contact.friction,
                                  c.contact.relaxation_s,        c.contact.tolerance * (g > 0 ? g : 9.81),
                                  c.contact.max_iterations,      c.contact.compliance_m_per_Pa};
  s->model = buildModel(garment, options, environment, contact, std::move(obstacles));

  if (std::any_of(start.begin(), start.end(), [](const Vec3& n) { return n != Vec3{}; }))
    for (std::size_t i = 0; i < s->model->map.home.size(); ++i)
      s->shift_m.push_back(s->model->held[i] ? Vec3{} : start[static_cast<std::size_t>(s->model->map.home[i])]);

  std::vector<Vec3> at_start;
  for (const NurbsPatch& p : garment.patches) at_start.insert(at_start.end(), p.points.begin(), p.points.end());
  for (std::size_t i = 0; i < at_start.size(); ++i) at_start[i] += start[i];
  nameContactRegions(*s, garment, garments, first, at_start);

  const bool project = c.dressing.projecting && human && !c.dressing.layer_by_layer && c.dressing.from.empty();
  const double grow = project ? c.dressing.projecting->grow_s : 0, settle = human ? c.dressing.settle_s : 0;
  s->start_s = -(grow + settle);
  s->end_s = duration;
  stage->grow_start_s = s->start_s;
  stage->grow_s = grow;
  stage->settle_start_s = -settle;
  if (!c.dressing.from.empty()) {
    const Dressed dressed = readDressed(c.dressing.from);
    wear(*s, dressed);
    stage->dressed = dressed.posture;
  } else if (settle > 0 && std::any_of(c.garments.begin(), c.garments.end(), isDrafted)) {
    stage->dressed = standing(*s->human);  // which the garments are drafted for
  }
  if (project) {
    std::vector<Vec3> X(s->model->surface.size());
    s->model->surface.W.multiply<Vec3>(at_start, X);
    const Posture posture = stage->postureAt(s->start_s);
    const std::vector<Pose> poses = linkPoses(human->skeleton, posture.q, posture.root);
    const double clearance = c.dressing.projecting->clearance_m;
    if (human->skin) {
      stage->shrunk_skin = shrinkSkinToFree(*human, poses, X, clearance).x;
    } else {
      const std::vector<Obstacle> shapes = obstaclesOf(*human);
      stage->shrunk = shrinkToFree(ProximityQuery(shapes), shapes, placementsOf(*human, poses), X, clearance);
    }
  }
  s->stage = std::move(stage);
  return s;
}

}  // namespace

State startOf(const Scenario& s, StepWork& work) {
  State state = initialState(*s.model, *s.stage, s.start_s, work);
  if (s.shift_m.empty() && s.start_m.empty()) return state;
  const std::vector<Vec3> drafted = state.anchors;
  if (!s.start_m.empty())
    state.p = s.start_m;
  else
    for (std::size_t i = 0; i < state.p.size(); ++i) state.p[i] += s.shift_m[i];
  attachSprings(*s.model, *s.stage, state, work);
  if (!s.start_m.empty()) hangSprings(*s.model, *s.stage, drafted, state, work);
  return state;
}

namespace {

/// What only building shows to be wrong (a pattern that does not fit the body, say) is said with the case's name.
std::unique_ptr<Scenario> build(const Case& c, bool panels) {
  try {
    return buildUnnamed(c, panels);
  } catch (const InputError& e) {
    if (!e.where().file.empty()) throw;
    throw InputError({c.file.string(), e.where().line, e.where().key}, e.reason());
  }
}

}  // namespace

std::unique_ptr<Scenario> buildScenario(const Case& c) { return build(c, false); }

std::unique_ptr<Scenario> buildPanels(const Case& c) {
  if (c.garments.size() != 1 || !c.garments[0].stitching)
    throw InputError({c.file.string(), 0, "stitching"}, "panels are those of one garment that is to be stitched");
  return build(c, true);
}

}  // namespace gambeson
