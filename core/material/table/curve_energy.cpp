#include "core/material/table/curve_energy.hpp"

#include <cmath>
#include <cstddef>

#include "core/error.hpp"

namespace gambeson {
namespace {

TensionCurve curveOf(const CurveLaw& law, std::size_t direction) {
  try {
    return TensionCurve(law.tension[direction]);
  } catch (const InputError& e) {
    throw InputError({"", 0, direction == 0 ? "weft" : "warp"}, e.reason());
  }
}

}  // namespace

CurveEnergy::CurveEnergy(const CurveLaw& law) : law_(law), curves_{curveOf(law, 0), curveOf(law, 1)} {
  const auto require = [](bool holds, const char* key, const char* allowed) {
    if (!holds) throw InputError({"", 0, key}, std::string("is out of range; allowed: ") + allowed);
  };
  require(law.shear_N_per_m > 0 && std::isfinite(law.shear_N_per_m), "shear", "> 0");
  require(law.rigidity_Nm[0] > 0 && std::isfinite(law.rigidity_Nm[0]), "rigidity_weft", "> 0");
  require(law.rigidity_Nm[1] > 0 && std::isfinite(law.rigidity_Nm[1]), "rigidity_warp", "> 0");
  require(law.rigidity_Nm[2] >= 0 && std::isfinite(law.rigidity_Nm[2]), "twist", ">= 0");
}

void CurveEnergy::evaluate(std::span<const SheetStrain> points, SheetParts parts, std::span<const double>,
                           std::span<double>, std::span<SheetAnswer> out) const {
  for (std::size_t p = 0; p < points.size(); ++p) {
    const SheetStrain& at = points[p];
    SheetAnswer& a = out[p];
    a = {};
    std::array<double, 3> stiffness{0, 0, law_.shear_N_per_m};
    for (std::size_t i = 0; i < 2; ++i) {
      const TensionAnswer t = curves_[i].at(at.strain[i]);
      a.energy_J_per_m2 += t.energy_J_per_m2;
      a.resultant[i] = t.tension_N_per_m;
      stiffness[i] = t.stiffness_N_per_m;
      a.beyond |= t.beyond;
    }
    a.resultant[2] = law_.shear_N_per_m * at.strain[2];
    a.energy_J_per_m2 += 0.5 * a.resultant[2] * at.strain[2];
    for (std::size_t i = 0; i < 3; ++i) {
      a.moment[i] = law_.rigidity_Nm[i] * at.curvature[i];
      a.energy_J_per_m2 += 0.5 * a.moment[i] * at.curvature[i];
    }
    if (parts == SheetParts::resultants) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      a.slope[7 * i] = stiffness[i];
      a.slope[7 * (3 + i)] = law_.rigidity_Nm[i];
    }
  }
}

std::array<double, 36> CurveEnergy::steepest(const StrainBox& within) const {
  std::array<double, 36> out{};
  for (std::size_t i = 0; i < 2; ++i) out[7 * i] = curves_[i].steepest(within.low[i], within.high[i]);
  out[14] = law_.shear_N_per_m;
  for (std::size_t i = 0; i < 3; ++i) out[7 * (3 + i)] = law_.rigidity_Nm[i];
  return out;
}

}  // namespace gambeson
