#include "cases/cell/truss_engine.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/math/quadrature.hpp"

namespace gambeson {
namespace {

double stretchOf(double strain) { return std::sqrt(1 + 2 * strain); }

/// The ratio along `free` at which that direction carries nothing, the largest; forces rise with the ratio.
double freeStretch(const KawabataCloth& cloth, std::array<double, 2> stretch, int free) {
  const auto pulls = [&](double ratio) {
    stretch[free] = ratio;
    return kawabataState(cloth, stretch).force_N_per_m[free] > 0;
  };
  double low = 0.5, high = 1;  // crimp gives way by far less than half
  while (!pulls(high)) high *= 1.1;
  while (pulls(low)) low *= 0.5;
  for (double middle = 0.5 * (low + high); middle > low && middle < high; middle = 0.5 * (low + high))
    (pulls(middle) ? high : low) = middle;
  return low;
}

/// Straight yarns between crossings and the points half way.
std::vector<YarnTube> tubesOf(const KawabataCloth& cloth, const WovenYarns& yarns, const std::array<double, 2>& stretch,
                              const KawabataState& state) {
  const std::array<double, 2> height_m{cloth.yarn[along_weft].crimp_height_m - state.deflection_m[along_weft],
                                       cloth.yarn[along_warp].crimp_height_m + state.deflection_m[along_warp]};
  std::vector<YarnTube> tubes;
  for (const int d : {along_weft, along_warp}) {
    const WovenYarn& yarn = yarns.yarn[d];
    const double stress_Pa = state.yarn_tension_N[d] / (std::numbers::pi * yarn.half_width_m * yarn.half_thickness_m);
    const double step_m = 0.5 * stretch[d] * yarns.yarn[1 - d].spacing_m;
    for (int k = 0; k < yarns.count(d); ++k) {
      const double aside_m = (k + 0.5) * stretch[1 - d] * yarn.spacing_m;
      std::vector<Vec3> middle;
      for (int i = 0; i <= 2 * yarns.crossings(d); ++i) {
        const double z = i % 2 == 0 ? 0 : yarns.onTop(d, k, i / 2) ? height_m[d] : -height_m[d];
        middle.push_back(d == along_weft ? Vec3{i * step_m, aside_m, z} : Vec3{aside_m, i * step_m, z});
      }
      YarnTube tube{d, {}, {}, yarn.half_width_m, yarn.half_thickness_m};
      for (std::size_t i = 0; i < middle.size(); ++i) {
        const Vec3 ahead = normalized(middle[std::min(i + 1, middle.size() - 1)] - middle[i == 0 ? 0 : i - 1]);
        const Vec3 across = normalized(cross(Vec3{0, 0, 1}, ahead));
        tube.sections.push_back({{ahead, across, cross(ahead, across)}, middle[i]});
        tube.stress_Pa.push_back(stress_Pa);
      }
      tubes.push_back(std::move(tube));
    }
  }
  return tubes;
}

class TrussSpecimen : public CellSpecimen {
 public:
  TrussSpecimen(const KawabataCloth& cloth, const WovenYarns& yarns) : cloth_(cloth), yarns_(yarns) {}

  CellStep bring(const CellTarget& to) override {
    stretch_ = {stretchOf(to.load.e11), stretchOf(to.load.e22)};
    if (to.free) stretch_[*to.free] = freeStretch(cloth_, stretch_, *to.free);
    const KawabataState state = kawabataState(cloth_, stretch_);
    CellStep step;
    CellLoad& load = step.point.load;
    load.e11 = 0.5 * (stretch_[0] * stretch_[0] - 1);
    load.e22 = 0.5 * (stretch_[1] * stretch_[1] - 1);
    step.point.resultants.energy_J_per_m2 = energyOf(cloth_, state);
    step.point.resultants.n11 = state.force_N_per_m[0] / stretch_[0];
    step.point.resultants.n22 = state.force_N_per_m[1] / stretch_[1];
    step.point.tension_N = state.yarn_tension_N;
    return step;
  }

  YarnShape shape() const override {
    return shapeOf(tubesOf(cloth_, yarns_, stretch_, kawabataState(cloth_, stretch_)));
  }
  std::optional<std::array<double, 9>> membraneTangent() override { return {}; }
  std::optional<std::array<double, 3>> bendingStiffness() override { return {}; }

 private:
  const KawabataCloth& cloth_;
  const WovenYarns& yarns_;
  std::array<double, 2> stretch_{1, 1};
};

}  // namespace

double energyOf(const KawabataCloth& cloth, const KawabataState& state) {
  constexpr int kPoints = 20;
  double crossing_J = 0;
  for (int d = 0; d < 2; ++d) {
    const KawabataYarn& y = cloth.yarn[d];
    const double rest_m = std::hypot(2 * y.crimp_height_m, y.spacing_m);
    const double extension = std::max(0.0, state.yarn_stretch[d] - 1);
    crossing_J += 0.5 * y.stretch_N * rest_m * extension * extension;
  }
  const double touch_m = cloth.yarn[0].half_thickness_m + cloth.yarn[1].half_thickness_m;
  const double approach_m = state.deflection_m[0] - state.deflection_m[1];
  const Quadrature rule = gaussLegendre(kPoints);
  for (std::size_t q = 0; q < rule.points.size(); ++q)
    crossing_J +=
        rule.weights[q] * approach_m * cloth.compression.force_N(touch_m - rule.points[q] * approach_m, touch_m);
  return crossing_J / (cloth.yarn[0].spacing_m * cloth.yarn[1].spacing_m);
}

TrussEngine::TrussEngine(const KawabataCloth& cloth, const WovenYarns& yarns) : cloth_(cloth), yarns_(yarns) {
  checkWovenYarns(yarns_);
  checkKawabata(cloth_);
  surface_ = surfaceOf(tubesOf(cloth_, yarns_, {1, 1}, kawabataState(cloth_, {1, 1})));
}

std::unique_ptr<CellSpecimen> TrussEngine::specimen() const { return std::make_unique<TrussSpecimen>(cloth_, yarns_); }

std::vector<std::string> TrussEngine::assumptions() const {
  return {
      "Yarns are straight between the crossings and half way between them, where they are joined (Kawabata's structure "
      "model, Man 2006, section 4.1.2.1): they stretch, and neither bend nor shear.",
      "A yarn that is slack carries nothing.",
      "Crossings move through the cloth until the yarns press on each other with one force, by the law of lateral "
      "compression, without friction."};
}

}  // namespace gambeson
