#include "cases/wear/results/viewer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/stress.hpp"
#include "analysis/ticks.hpp"
#include "cases/wear/recording/zone_ledger.hpp"
#include "cases/wear/results/animation.hpp"
#include "cases/wear/results/force_clusters.hpp"
#include "cases/wear/results/shown.hpp"
#include "cases/wear/results/write.hpp"
#include "core/error.hpp"
#include "core/math/parallel.hpp"

namespace gambeson {
namespace {

using Values = std::vector<std::vector<float>>;  ///< [frame][vertex]

/// A length that arrows have where the garment is of this size: as pictures draw them.
constexpr double kLongestArrow = 0.14;
/// Gaps beyond are of no interest to colours, which end there at first.
constexpr double kGapShown_mm = 20;

class ViewMaker {
 public:
  ViewMaker(const Scenario& s, const RecordingReader& recording, const Measured& m, const std::string& label,
            ViewerContent content)
      : s_(s),
        recording_(recording),
        m_(m),
        whole_(content == ViewerContent::whole),
        frames_(shownFrames(recording, 0)),
        scene_(animationOf(s, recording, {0, 0, PictureField::plain, false}).scene),
        garments_(wornMeshes(s)),
        run_(s.definition.name, label, scene_.time_s, origins(), up()) {}

  ViewerRun make() {
    const std::vector<PictureCase> pictures = picturesOf(s_.definition);
    const auto first = std::find_if(pictures.begin(), pictures.end(), [](const PictureCase& p) {
      return p.field != PictureField::plain && p.field != PictureField::body_pressure;
    });
    std::string field = first == pictures.end() ? "stress" : fieldWords(first->field).field;
    if (field.empty()) field = "stress";
    run_.startAt(m_.peak_time_s, field,
                 first == pictures.end() ? "front_right" : viewNames()[static_cast<std::size_t>(first->view)]);
    addMeshes();
    addClothFields();
    addBodyPressure();
    addForces();
    return std::move(run_);
  }

 private:
  Vec3 up() const {
    const Vec3 g = s_.model->environment.gravity_m_per_s2;
    return norm(g) > 0 ? -1.0 / norm(g) * g : Vec3{0, 0, 1};
  }

  /// Where the wearer's root is above the ground; without a wearer the middle of the cloth as it begins.
  std::vector<Vec3> origins() const {
    std::vector<Vec3> out;
    if (s_.human) {
      for (std::size_t t = 0; t < scene_.time_s.size(); ++t) {
        const Vec3 x = worldOf(scene_, t)[0].origin;
        out.push_back(x - dot(x, up()) * up());
      }
      return out;
    }
    const auto& x = scene_.moving.back().at[0];
    std::vector<Vec3> points;
    for (std::size_t i = 0; i + 2 < x.size(); i += 3) points.push_back({x[i], x[i + 1], x[i + 2]});
    const std::array<Vec3, 2> box = boxOf(points, 0);
    const Vec3 middle = 0.5 * (box[0] + box[1]);
    return std::vector<Vec3>(scene_.time_s.size(), middle - dot(middle, up()) * up());
  }

  void addMeshes() {
    std::vector<std::string> zones;
    if (m_.body)
      for (const std::string& z : zoneNames(s_)) zones.push_back(spokenZone(z));
    // Of the body the surfaces that bear its pressure.
    std::vector<BodyMap::Surface> surfaces;
    if (m_.body) surfaces = m_.body->surfaces();
    const auto zonesOf = [&](const BodyMap::Surface& surface) {
      const auto& zone = m_.body->zone();
      return std::vector<int>(zone.begin() + surface.first,
                              zone.begin() + surface.first + static_cast<long>(surface.mesh->vertices.size()));
    };
    std::size_t moving = 0, fixed = 0;
    for (std::size_t o = 0; o < s_.model->obstacles.size(); ++o) {
      const auto surface = std::find_if(surfaces.begin(), surfaces.end(),
                                        [&](const BodyMap::Surface& b) { return b.obstacle == static_cast<int>(o); });
      const bool body = surface != surfaces.end();
      const auto kind = body ? ViewerRun::Kind::body : ViewerRun::Kind::thing;
      if (s_.model->obstacles[o].deforms) {
        const MovingMesh& mesh = scene_.moving[moving++];
        if (body)
          run_.addMoving(kind, mesh, zones, zonesOf(*surface));
        else
          run_.addMoving(kind, mesh);
        continue;
      }
      FixedMesh mesh = scene_.fixed[fixed++];
      std::vector<Placement> at;
      for (std::size_t t = 0; t < scene_.time_s.size(); ++t)
        at.push_back(worldOf(scene_, t)[static_cast<std::size_t>(mesh.node)]);
      if (body) {
        mesh.mesh.vertices = surface->mesh->vertices;
        mesh.mesh.triangles = surface->mesh->triangles;
        run_.addFixed(kind, mesh, at, zones, zonesOf(*surface));
      } else {
        run_.addFixed(kind, mesh, at);
      }
    }
    for (const WornMesh& g : garments_) {
      std::vector<int> patch;
      for (const int sample : g.samples) patch.push_back(s_.model->surface.patch[static_cast<std::size_t>(sample)]);
      std::vector<std::string> names;
      for (std::string name : s_.patch_names) {
        std::replace(name.begin(), name.end(), '_', ' ');
        names.push_back(std::move(name));
      }
      run_.addMoving(ViewerRun::Kind::cloth, scene_.moving[moving++], names, patch);
    }
  }

  /// Of the samples in the order of the garments' vertices.
  template <class Number>
  std::vector<float> ofVertices(const std::vector<Number>& of_samples, double scale) const {
    std::vector<float> out;
    for (const WornMesh& g : garments_)
      for (const int sample : g.samples)
        out.push_back(static_cast<float>(scale * static_cast<double>(of_samples[static_cast<std::size_t>(sample)])));
    return out;
  }

  /// What 99 % of the cloth stays below over the motion, as pictures have it (fieldRange).
  double rangeOf(const Values& values) const {
    std::vector<double> area = areas(), all, weights;
    for (std::size_t t = 0; t < values.size(); ++t) {
      if (!(scene_.time_s[t] > 1e-9) && values.size() > 1) continue;
      for (std::size_t v = 0; v < values[t].size(); ++v)
        if (std::isfinite(values[t][v])) all.push_back(values[t][v]), weights.push_back(area[v]);
    }
    return all.empty() ? 0 : roundedUp(weightedPercentile(all, weights, 0.99));
  }

  std::vector<double> areas() const {
    std::vector<double> out;
    for (const WornMesh& g : garments_)
      for (const int sample : g.samples) out.push_back(s_.model->surface.area_m2[static_cast<std::size_t>(sample)]);
    return out;
  }

  /// Of the fabrics: `along` "" is any direction.
  std::vector<ViewerLimit> stretchLimits(const std::string& along) const {
    std::vector<ViewerLimit> out;
    const auto& garments = s_.definition.garments;
    for (const Stretch& k : m_.stretch) {
      if (!along.empty() && !k.along.empty() && k.along != along) continue;
      int mesh = -1;
      for (std::size_t g = 0; g < garments.size(); ++g)
        if (garments.size() > 1 && garments[g].name == k.garment) mesh = static_cast<int>(g);
      const std::string whose = k.garment.empty() ? "fabric" : k.garment;
      // In any direction the lesser of both counts.
      const auto same = std::find_if(out.begin(), out.end(), [&](const ViewerLimit& l) { return l.mesh == mesh; });
      const ViewerLimit limit{mesh, -1, 100 * k.limit,
                              k.stated ? "limit of the " + whose : "range of the law of the " + whose};
      if (same == out.end())
        out.push_back(limit);
      else if (limit.value < same->value)
        *same = limit;
    }
    return out;
  }

  void addClothFields() {
    struct Recorded {
      PictureField field;
      const char *title, *unit;
    };
    constexpr Recorded recorded[]{{PictureField::stress, "Stress: largest pull", "N/m"},
                                  {PictureField::strain, "Largest stretch", "%"},
                                  {PictureField::pressure, "Contact pressure of single points", "kPa"},
                                  {PictureField::set, "Curvature that is set", "1/m"},
                                  {PictureField::friction, "Friction in bending that is left", "%"}};
    const std::vector<Field> has = recording_.frame(frames_[0]).sample_fields;
    for (const Recorded& r : recorded) {
      const FieldWords words = fieldWords(r.field);
      if (std::none_of(has.begin(), has.end(), [&](const Field& f) { return f.name == words.field; })) continue;
      Values values;
      for (const int f : frames_)
        values.push_back(ofVertices(recording_.sampleField(f, words.field).data, words.scale));
      ViewerField field{words.field, r.title, r.unit, false, false, rangeOf(values), {}};
      if (r.field == PictureField::strain) field.limits = stretchLimits("");
      if (r.field == PictureField::friction) field.high = 100;
      run_.addField(field, values);
    }
    if (whole_) addThreadStrains();
    if (!s_.model->obstacles.empty() && whole_) addGap();
    const std::vector<double> thickness = thicknessOf(s_);
    const auto [least, most] = std::minmax_element(thickness.begin(), thickness.end());
    if (*least < *most)
      run_.addField({"thickness", "Thickness at rest", "mm", false, false, roundedUp(1e3 * *most), {}},
                    Values{ofVertices(thickness, 1e3)});
  }

  void addThreadStrains() {
    const std::unique_ptr<StressView> stress = s_.model->cloth->stress();
    Values along[2];
    for (const int f : frames_) {
      const std::array<std::vector<float>, 2> strain = threadStrains(s_, *stress, recording_.frame(f));
      for (std::size_t d = 0; d < 2; ++d) along[d].push_back(ofVertices(strain[d], 100));
    }
    run_.addField(
        {"strain_weft", "Stretch along the weft", "%", false, false, rangeOf(along[0]), stretchLimits("weft")},
        along[0]);
    run_.addField(
        {"strain_warp", "Stretch along the warp", "%", false, false, rangeOf(along[1]), stretchLimits("warp")},
        along[1]);
  }

  /// From the middle of the cloth to the nearest body, less than 0 inside.
  void addGap() {
    Values values;
    PlacedBodies placed(s_);
    for (std::size_t t = 0; t < frames_.size(); ++t) {
      placed.moveTo(scene_.time_s[t]);
      const std::vector<Vec3> x = vectorsOf(recording_.frame(frames_[t]).positions);
      std::vector<float> gap(x.size());
      forAll(Each::much, static_cast<int>(x.size()), [&](int i) {
        const PlacedBodies::Nearest near = placed.nearest(x[static_cast<std::size_t>(i)]);
        gap[static_cast<std::size_t>(i)] =
            near.body < 0 ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(near.distance_m);
      });
      values.push_back(ofVertices(gap, 1e3));
    }
    run_.addField({"gap", "Gap to the body, from the middle of the cloth", "mm", false, false, kGapShown_mm, {}},
                  values);
  }

  void addBodyPressure() {
    if (!m_.body) return;
    Values values(frames_.size());
    double most = 0;
    for (std::size_t t = 0; t < frames_.size(); ++t)
      for (const double p : m_.body->pressure(recording_.frame(frames_[t]))) {
        values[t].push_back(static_cast<float>(1e-3 * p));
        most = std::max(most, 1e-3 * p);
      }
    ViewerField field{"body_pressure",
                      fmt::format("Pressure on the body, mean over {:g} mm", 1e3 * s_.definition.comfort.sensor_m),
                      "kPa",
                      true,
                      true,
                      roundedUp(most),
                      {}};
    const std::vector<std::string> zones = zoneNames(s_);
    for (const ComfortMeasure& c : m_.comfort) {
      const auto zone = std::find(zones.begin(), zones.end(), c.zone) - zones.begin();
      field.limits.push_back(
          {-1, static_cast<int>(zone), 1e-3 * c.limit.peak_Pa, "limit of peaks, " + spokenZone(c.zone)});
    }
    run_.addField(field, values);
  }

  void addForces() {
    if (s_.model->obstacles.empty()) return;
    PlacedBodies placed(s_);
    std::vector<std::vector<ForceCluster>> of_frames;
    double most_N = 0, size_m = 0;
    for (const int f : frames_) {
      const Frame frame = recording_.frame(f);
      placed.moveTo(frame.time_s);
      const std::vector<Vec3> x = vectorsOf(frame.positions);
      if (of_frames.empty()) {
        const std::array<Vec3, 2> box = boxOf(x, 0);
        size_m = norm(box[1] - box[0]);
      }
      of_frames.push_back(forceClusters(placed, frame, x));
      most_N = std::max(most_N, largestForce(of_frames.back()));
    }
    std::vector<std::vector<ViewerArrow>> arrows(of_frames.size());
    for (std::size_t t = 0; t < of_frames.size(); ++t)
      for (const ForceCluster& c : of_frames[t])
        if (norm(c.force) >= kLeastArrow * most_N) arrows[t].push_back({c.middle(), c.force});
    run_.addArrows(arrows, most_N, kLongestArrow * size_m,
                   fmt::format("{0:g} x {0:g} cm of cloth", 100 * kArrowCell_m));
  }

  const Scenario& s_;
  const RecordingReader& recording_;
  const Measured& m_;
  bool whole_;
  std::vector<int> frames_;
  AnimatedScene scene_;
  std::vector<WornMesh> garments_;
  ViewerRun run_;
};

}  // namespace

ViewerRun viewerRun(const Scenario& s, const RecordingReader& recording, const Measured& m, const std::string& label,
                    ViewerContent content) {
  return ViewMaker(s, recording, m, label, content).make();
}

void addViewer(const Scenario& s, const RecordingReader& recording, const Measured& m, ReportInput& in) {
  if (!s.definition.output.viewer) return;
  try {
    in.viewer.push_back(viewerRun(s, recording, m, "", ViewerContent::whole));
  } catch (const RunError& e) {
    in.warnings.push_back(fmt::format("The page has no view to look around in: {}", e.what()));
  }
}

}  // namespace gambeson
