#include "cases/structure/stretch.hpp"

#include <fmt/format.h>

#include <cmath>

#include "analysis/ticks.hpp"
#include "cases/cloth/limit_name.hpp"

namespace gambeson {
namespace {

constexpr const char* kThreads[2] = {"weft", "warp"};

}  // namespace

StretchTally::StretchTally(const StructureCase& c, const StructureModel& model, const PlaceMesh& mesh)
    : model_(model), mesh_(mesh) {
  const auto take = [&](const MaterialCase& m) {
    const auto* fabric = std::get_if<Fabric>(&m.law);
    if (!fabric) return;
    const std::optional<double>* const limits[2] = {&m.limit_strain_weft, &m.limit_strain_warp};
    for (std::size_t d = 0; d < 2; ++d)
      if (*limits[d] && (!along_[d].limit || **limits[d] < *along_[d].limit)) {
        along_[d].limit = *limits[d];
        along_[d].fabric = nameOfLimit(m.card, fabric->name);
      }
  };
  take(c.material);
  for (const MaterialCase& m : c.other_materials) take(m);
  if (c.kind != StructureKind::modal && (along_[0].limit || along_[1].limit))
    stress_ = model.structure->cloth->stress();
}

void StretchTally::add(const MeasuredState& state) {
  if (!stress_) return;
  const ClothState cloth{state.q, {}, state.history};
  const std::vector<StressView::Sample> means = stress_->means(cloth);
  for (std::size_t i = 0; i < mesh_.uv.size(); ++i) {
    const PlaneTensor E = stress_->strainAt(cloth, mesh_.patch[i], mesh_.uv[i], means);
    for (std::size_t d = 0; d < 2; ++d)
      if (const double strain = d == 0 ? E.t11 : E.t22; !std::isnan(along_[d].most) && !(strain <= along_[d].most))
        along_[d].most = strain;  // a NaN stays
  }
}

std::vector<AuditCheck> StretchTally::checks() const {
  std::vector<AuditCheck> all;
  for (std::size_t d = 0; d < 2 && stress_; ++d) {
    if (!along_[d].limit) continue;
    const double most = 100 * along_[d].most, limit = 100 * *along_[d].limit;
    all.push_back({fmt::format("Stretch along the {}, {}", kThreads[d], along_[d].fabric), most, limit, "%",
                   fmt::format("the largest Green-Lagrange strain along the {} of any recorded state, against how far "
                               "the fabric may be stretched",
                               kThreads[d]),
                   fmt::format("{} is stretched by {} % along its {}, and is meant for less than {} %: it may not come "
                               "back, or tear",
                               along_[d].fabric, formatNumber(most, 3), kThreads[d], formatNumber(limit, 3))});
  }
  return all;
}

}  // namespace gambeson
