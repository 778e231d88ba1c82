#include "core/material/fabric_law.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "core/error.hpp"

namespace gambeson {
namespace {

void checkLaminate(const Fabric& f, const Refusal& refuse) {
  Section section;
  try {
    section = laminate(f.laminate()->plies);
  } catch (const InputError& e) {
    refuse(e.where().key, e.reason());
  }
  double coupling = 0, size = 0;
  for (int i = 0; i < 6; ++i) {
    coupling = std::max(coupling, std::abs(section.B[i]));
    size = std::max(size, std::sqrt(section.A[0] * section.D[0]));
  }
  if (f.tension_field && coupling > 1e-12 * size)
    refuse("tension_field", "needs a section without coupling of membrane and bending (symmetric plies)");
}

void checkShearFriction(const Fabric& f, const Refusal& refuse) {
  const ShearFriction& s = f.shear_friction;
  if (!(s.rise_N_per_m >= 0 && s.growth_N_per_m >= 0)) refuse("shear_friction", "must have slopes >= 0");
  if (s == ShearFriction{}) return;
  if (!(s.span > 0)) refuse("shear_friction", "must have a span > 0");
  if (f.tension_field) refuse("tension_field", "is not possible with friction in shear");
  if (f.laminate()) refuse("shear_friction", "is not possible for plies");
}

void checkEnergy(const Fabric& f, const Refusal& refuse) {
  if (f.tension_field) refuse("tension_field", "is not possible where a fabric's law is an energy at a point");
  if (f.jam_area > 0) refuse("jam_area", "is not possible where a fabric's law is an energy at a point; allowed: 0");
  if (f.shear_friction != ShearFriction{} || !std::holds_alternative<LinearBending>(f.law))
    refuse("law", "an energy at a point stands for membrane and bending: no other law goes with it");
}

void checkMembrane(const Fabric& f, const Refusal& refuse) {
  if (!(f.thickness_m > 0)) refuse("thickness_m", "must be > 0");
  if (!(f.young_weft_Pa > 0)) refuse("young_weft_Pa", "must be > 0");
  if (!(f.young_warp_Pa > 0)) refuse("young_warp_Pa", "must be > 0");
  if (!(f.shear_Pa > 0)) refuse("shear_Pa", "must be > 0");
  if (!(f.poisson * f.poisson * f.young_warp_Pa < f.young_weft_Pa))
    refuse("poisson", "must satisfy poisson^2 young_warp < young_weft");
}

Voigt membraneOf(const Fabric& f) {
  Voigt A{};
  planeStress(f.young_weft_Pa, f.young_warp_Pa, f.shear_Pa, f.poisson, f.thickness_m, A.data());
  return A;
}

}  // namespace

void checkFabric(const Fabric& f, const char* where) {
  const Refusal refuse = [&](const std::string& key, const std::string& reason) {
    throw InputError({"", 0, std::string(where) + "." + key}, reason);
  };
  if (!(f.jam_area >= 0 && f.jam_area < 1)) refuse("jam_area", "must be >= 0 and < 1");
  if (f.jam_area > 0 && f.tension_field)
    refuse("jam_area", "is not possible for a tension field, which carries no compression; allowed: 0");
  checkShearFriction(f, refuse);
  if (f.energy) checkEnergy(f, refuse);
  if (f.laminate()) return checkLaminate(f, refuse);
  checkMembrane(f, refuse);
  std::visit(
      [&]<class L>(const L& law) {
        if constexpr (!L::is_solid) law.check(refuse);
      },
      f.law);
}

PointLaw pointLaw(const Fabric& f) {
  PointLaw point;
  std::visit(
      [&]<class L>(const L& law) {
        point.section = law.section(f.laminate() ? Voigt{} : membraneOf(f), f.thickness_m);
        if constexpr (constexpr int kind = BendingLaws::kind<L>; kind > 0) {
          const auto numbers = law.numbers();
          std::copy(numbers.begin(), numbers.end(), point.numbers.begin());
          point.kind = kind;
        }
      },
      f.law);
  point.tension = f.tension_field ? 1 : 0;
  point.jam_s = f.jam_area * f.jam_area;
  point.jam_N_per_m = f.jam_area > 0 ? jamStiffness(point.section.A) : 0;
  const ShearFriction& s = f.shear_friction;
  point.shear = {s.rise_N_per_m, s.span, s.growth_N_per_m};
  return point;
}

LawUse lawUse(const Fabric& f) {
  const int kind = std::visit([]<class L>(const L&) { return BendingLaws::kind<L>; }, f.law);
  return {kind > 0 ? 1u << kind : 0u, f.tension_field, f.jam_area > 0, f.shear_friction != ShearFriction{}};
}

bool hasRestCurvature(const Fabric& f) {
  return f.rest_curvature_of_shape || std::visit([]<class L>(const L&) { return L::is_solid; }, f.law);
}

PointNumbers<double> numbersOf(const PointLaw& law) {
  PointNumbers<double> numbers;
  std::memcpy(&numbers, &law, sizeof law);
  return numbers;
}

LawUse lawUse(const PointLaw& law) {
  return {law.kind > 0 ? 1u << static_cast<int>(law.kind) : 0u, law.tension != 0, law.jam_N_per_m > 0,
          law.shear[0] > 0 || law.shear[2] > 0};
}

PointAnswer<double> resultants(const PointLaw& law, const double* strain, const double* change,
                               History<double> history) {
  PointAnswer<double> out;
  evaluateLaws<only_resultants>(lawUse(law), numbersOf(law), strain, change, history, out);
  return out;
}

}  // namespace gambeson
