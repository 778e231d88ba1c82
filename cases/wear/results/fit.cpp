/// Detail of measure.hpp: how garments sit: how far their fabrics stretch against what these are meant for, and whether
/// they stay on.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "cases/cloth/fabric.hpp"
#include "cases/cloth/thread_strains.hpp"
#include "cases/wear/results/measure.hpp"
#include "cases/wear/scene/placed_bodies.hpp"
#include "core/math/parallel.hpp"

namespace gambeson {
namespace {

/// Names are told where there are several.
std::string nameOf(const Scenario& s, std::size_t garment) {
  return s.definition.garments.size() > 1 ? s.definition.garments[garment].name : "";
}

/// Of the patches of one garment: the largest of what 99 % of each stays below, and of single spots.
Stretch largestOf(const Scenario& s, const std::vector<StressSummary>& patches, std::size_t garment) {
  Stretch most;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    if (s.model->cloth->patches()[p].garment != static_cast<int>(garment)) continue;
    const auto raise = [](double& largest, double x) {
      if (!std::isnan(largest) && !(x <= largest)) largest = x;  // a NaN stays
    };
    raise(most.most, patches[p].p99_strain);
    raise(most.largest, patches[p].max_strain);
  }
  most.garment = nameOf(s, garment);
  return most;
}

/// Strain along the weft, then the warp, of each patch over the frames of the motion.
std::array<std::vector<StressSummary>, 2> directedStrains(const Scenario& s, const RecordingReader& recording,
                                                          const Regions& regions) {
  const std::unique_ptr<StressView> field = s.model->cloth->stress();
  std::array<std::vector<StressFrame>, 2> frames;
  for (int k = 0; k < recording.frameCount(); ++k) {
    if (!(recording.time(k) > 1e-9)) continue;
    const Frame frame = recording.frame(k);
    const std::array<std::vector<float>, 2> strain = threadStrains(s, *field, frame);
    for (std::size_t d = 0; d < 2; ++d) frames[d].push_back({frame.time_s, strain[d], strain[d]});
  }
  return {summarizeStress(regions, frames[0]), summarizeStress(regions, frames[1])};
}

/// How far the garment may stretch in one direction; where it is of several fabrics, the one that stands least. Nothing
/// where none of them says.
std::optional<double> limitOf(const Case& c, const GarmentCase& g, std::optional<double> FabricCase::*limit) {
  std::optional<double> least = fabricOf(c, g).*limit;
  for (const FabricCase& other : g.other_fabrics)
    if (least || other.*limit) least = std::min(least.value_or(kStrainOfLaw), (other.*limit).value_or(kStrainOfLaw));
  return least;
}

}  // namespace

std::array<std::vector<float>, 2> threadStrains(const Scenario& s, const StressView& field, const Frame& frame) {
  const Surface& surface = s.model->surface;
  const std::vector<Vec3> q = controlsOf(frame);
  const std::vector<StressView::Sample> means = field.means(q);
  std::array<std::vector<float>, 2> strain;
  for (auto& direction : strain) direction.resize(static_cast<std::size_t>(surface.size()));
  forAll(Each::much, surface.size(), [&](int i) {
    const PlaneTensor E = field.strainAt(q, surface.patch[i], surface.parameters[i], means);
    strain[0][static_cast<std::size_t>(i)] = static_cast<float>(E.t11);
    strain[1][static_cast<std::size_t>(i)] = static_cast<float>(E.t22);
  });
  return strain;
}

void measureStretch(const Scenario& s, const RecordingReader& recording, Measured& out) {
  if (out.stress.empty()) return;
  const Case& c = s.definition;
  const ThreadStrains strains(*s.model->cloth);
  for (int k = 0; k < recording.frameCount(); ++k)
    if (recording.time(k) > 1e-9)
      out.thread_strains.push_back(
          strains.values(controlPointsOf(recording.frame(k), static_cast<std::size_t>(s.model->cloth->points()))));
  for (int k = 0; k < recording.frameCount(); ++k) {
    if (!(recording.time(k) > 1e-9)) continue;
    const LawRange range = s.model->cloth->lawRange(
        controlPointsOf(recording.frame(k), static_cast<std::size_t>(s.model->cloth->points())));
    if (range.points == 0) break;
    if (out.law_range.points == 0 || range.beyond > out.law_range.beyond) out.law_range = range;
  }
  const bool stated = std::any_of(c.garments.begin(), c.garments.end(), [&](const GarmentCase& g) {
    return limitOf(c, g, &FabricCase::limit_strain_weft) || limitOf(c, g, &FabricCase::limit_strain_warp);
  });
  std::array<std::vector<StressSummary>, 2> directed;
  if (stated) directed = directedStrains(s, recording, out.regions);
  for (std::size_t k = 0; k < c.garments.size(); ++k) {
    const GarmentCase& garment = c.garments[k];
    const std::optional<double> limits[]{limitOf(c, garment, &FabricCase::limit_strain_weft),
                                         limitOf(c, garment, &FabricCase::limit_strain_warp)};
    if (!limits[0] && !limits[1]) {
      out.stretch.push_back(largestOf(s, out.stress, k));
      out.stretch.back().limit = kStrainOfLaw;
      continue;
    }
    for (std::size_t d = 0; d < 2; ++d) {
      // The range of a law is no limit that anyone stated.
      const auto states = [&](const FabricCase& f) {
        return (d == 0 ? f.limit_strain_weft : f.limit_strain_warp) == limits[d] && !f.limit_of_law[d];
      };
      out.stretch.push_back(largestOf(s, directed[d], k));
      out.stretch.back().limit = limits[d].value_or(kStrainOfLaw);
      out.stretch.back().stated =
          limits[d] && (states(fabricOf(c, garment)) ||
                        std::any_of(garment.other_fabrics.begin(), garment.other_fabrics.end(), states));
      out.stretch.back().along = d == 0 ? "weft" : "warp";
    }
  }
}

namespace {

/// From further away cloth is not worn at the start.
constexpr double worn_within_m = 0.1;
/// A garment that is put on may come down by so much until it finds its hold, as a skirt does on the hips.
constexpr double finds_hold_m = 0.1;

}  // namespace

void measureFalls(const Scenario& s, const RecordingReader& recording, Measured& out) {
  const Vec3 g = s.model->environment.gravity_m_per_s2;
  if (!s.human || recording.frameCount() == 0 || !(norm(g) > 0)) return;
  const Vec3 up = -1.0 / norm(g) * g;
  const Surface& surface = s.model->surface;
  const Frame first = recording.frame(0);
  const std::vector<Vec3> x0 = vectorsOf(first.positions);
  const std::vector<Pose> start = s.bodyPoses(first.time_s);
  PlacedBodies placed(s);
  placed.moveTo(first.time_s);
  const std::size_t garments = s.definition.garments.size(), links = s.human->skeleton.links.size();
  std::vector<double> area(garments, 0), worn(garments, 0);
  std::vector<std::vector<char>> lies(garments, std::vector<char>(links, 0));
  std::vector<std::size_t> garment_of(x0.size());
  for (std::size_t i = 0; i < x0.size(); ++i) {
    garment_of[i] =
        static_cast<std::size_t>(s.model->cloth->patches()[static_cast<std::size_t>(surface.patch[i])].garment);
    area[garment_of[i]] += surface.area_m2[i];
    const PlacedBodies::Nearest near = placed.nearest(x0[i]);
    if (near.body < 0 || near.body >= static_cast<int>(links) || !(near.distance_m < worn_within_m)) continue;
    worn[garment_of[i]] += surface.area_m2[i];
    lies[garment_of[i]][static_cast<std::size_t>(near.body)] = 1;
  }
  for (std::size_t l = 0; l < garments; ++l)
    if (worn[l] > 0.5 * area[l]) out.falls.push_back({nameOf(s, l), 0, 0});
  std::vector<double> put_on(garments, 0);  // fall until the motion starts
  for (int k = 0; k < recording.frameCount(); ++k) {
    const Frame frame = recording.frame(k);
    const bool moving = frame.time_s > 1e-9;
    const std::vector<Vec3> x = vectorsOf(frame.positions);
    const std::vector<Pose> now = s.bodyPoses(frame.time_s);
    std::size_t at = 0;
    for (std::size_t l = 0; l < garments; ++l) {
      if (!(worn[l] > 0.5 * area[l])) continue;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t b = 0; b < links; ++b) {
        if (!lies[l][b]) continue;
        double sum = 0;
        for (std::size_t i = 0; i < x.size(); ++i) {
          if (garment_of[i] != l) continue;
          const Vec3 carried =
              now[b].rotation * (transposeTimes(start[b].rotation, x0[i] - start[b].origin)) + now[b].origin;
          sum += surface.area_m2[i] * dot(carried - x[i], up);
        }
        least = std::min(least, sum / area[l]);
      }
      FallMeasure& fall = out.falls[at++];
      if (!moving) {
        put_on[l] = std::max(0.0, least);
        continue;
      }
      const double counts = least - put_on[l] + std::max(0.0, put_on[l] - finds_hold_m);
      if (counts > fall.largest_m) fall.largest_m = counts, fall.time_s = frame.time_s;
    }
  }
}

}  // namespace gambeson
