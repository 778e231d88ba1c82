#include "core/cloth/shell/shell_law.hpp"

#include <cmath>
#include <string>

#include "core/error.hpp"
#include "core/material/bending.hpp"
#include "core/material/jamming.hpp"
#include "core/material/tension_field.hpp"

namespace gambeson {

void checkFabric(const Fabric& f, const char* where) {
  const auto reject = [&](const std::string& key, const std::string& reason) {
    throw InputError({"", 0, std::string(where) + "." + key}, reason);
  };
  if (!(f.jam_area >= 0 && f.jam_area < 1)) reject("jam_area", "must be >= 0 and < 1");
  if (f.jam_area > 0 && f.tension_field)
    reject("jam_area", "is not possible for a tension field, which carries no compression; allowed: 0");
  if (!f.plies.empty()) {
    Section section;
    try {
      section = laminate(f.plies);
    } catch (const InputError& e) {
      reject(e.where().key, e.reason());
    }
    double coupling = 0, size = 0;
    for (int i = 0; i < 6; ++i) {
      coupling = std::max(coupling, std::abs(section.B[i]));
      size = std::max(size, std::sqrt(section.A[0] * section.D[0]));
    }
    if (f.tension_field && coupling > 1e-12 * size)
      reject("tension_field", "needs a section without coupling of membrane and bending (symmetric plies)");
    return;
  }
  if (!(f.thickness_m > 0)) reject("thickness_m", "must be > 0");
  if (!(f.young_weft_Pa > 0)) reject("young_weft_Pa", "must be > 0");
  if (!(f.young_warp_Pa > 0)) reject("young_warp_Pa", "must be > 0");
  if (!(f.shear_Pa > 0)) reject("shear_Pa", "must be > 0");
  if (!(f.poisson * f.poisson * f.young_warp_Pa < f.young_weft_Pa))
    reject("poisson", "must satisfy poisson^2 young_warp < young_weft");
  if (f.bending_law == BendingLaw::consistent) return;
  if (!(f.bending_weft_Nm >= 0)) reject("bending_weft_Nm", "must be >= 0");
  if (!(f.bending_warp_Nm >= 0)) reject("bending_warp_Nm", "must be >= 0");
  if (!(f.twist_Nm >= 0)) reject("twist_Nm", "must be >= 0");
  if (f.bending_law == BendingLaw::zheng && !(f.kappa_regular_per_m > 0 && f.kappa_regular_per_m <= f.kappa0_per_m))
    reject("kappa_regular_per_m", "must be > 0 and at most kappa0_per_m");
}

PointLaw pointLaw(const Fabric& f) {
  PointLaw law;
  law.tension = f.tension_field ? 1 : 0;
  const auto jam = [&] {
    law.jam_s = f.jam_area * f.jam_area;
    law.jam_N_per_m = f.jam_area > 0 ? jamStiffness(law.section.A) : 0;
  };
  if (!f.plies.empty()) {
    law.section = laminate(f.plies);
    jam();
    return law;
  }
  const double nu21 = f.poisson * f.young_warp_Pa / f.young_weft_Pa, h = f.thickness_m;
  const double scale = h / (1 - f.poisson * nu21);
  Voigt &A = law.section.A, &D = law.section.D;
  A = {f.young_weft_Pa * scale, f.young_warp_Pa * scale, f.shear_Pa * h, f.poisson * (f.young_warp_Pa * scale), 0, 0};
  jam();
  if (f.bending_law == BendingLaw::consistent) {
    for (int i = 0; i < 6; ++i) D[i] = A[i] * h * h / 12;
    return law;
  }
  D = {f.bending_weft_Nm, f.bending_warp_Nm, f.twist_Nm, 0, 0, 0};
  if (f.bending_law == BendingLaw::zheng) {
    law.kappa0 = f.kappa0_per_m;
    law.kappa_regular = f.kappa_regular_per_m;
  }
  return law;
}

ShellLaw shellLaw(const Fabric& f) {
  ShellLaw law;
  law.point = pointLaw(f);
  const Voigt &A = law.point.section.A, &D = law.point.section.D;
  law.d1 = A[0];
  law.d2 = A[1];
  law.d3 = A[3];
  law.d4 = A[2];
  law.bending_weft = D[0];
  law.bending_warp = D[1];
  law.twist = D[2];
  law.kappa0 = law.point.kappa0;
  law.kappa_regular = law.point.kappa_regular;
  law.zheng = law.kappa0 > 0;
  law.tension = f.tension_field;
  law.jams = f.jam_area > 0;
  law.general = !f.plies.empty() || f.tension_field || f.bending_law == BendingLaw::consistent;
  return law;
}

bool hasRestCurvature(const Fabric& f) {
  return f.rest_curvature_of_shape || f.bending_law == BendingLaw::consistent || !f.plies.empty();
}

PointResultants resultants(const PointLaw& law, const double* e, const double* k) {
  const auto times = [](const Voigt& S, const double* x, double* y) {
    y[0] += S[0] * x[0] + S[3] * x[1] + S[4] * x[2];
    y[1] += S[3] * x[0] + S[1] * x[1] + S[5] * x[2];
    y[2] += S[4] * x[0] + S[5] * x[1] + S[2] * x[2];
  };
  PointResultants r{};
  if (law.tension != 0) {
    const TensionField field = tensionField(law.section.A.data(), e);
    for (int i = 0; i < 3; ++i) r.n[i] = field.n[i];
  } else {
    times(law.section.A, e, r.n);
  }
  const double s = std::max(jam_least_s, (1 + 2 * e[0]) * (1 + 2 * e[1]) - e[2] * e[2]);
  if (s < law.jam_s) {
    const double push = -0.25 * law.jam_N_per_m * (law.jam_s / s - 1) * law.jam_s / (s * s);
    r.n[0] += push * 2 * (1 + 2 * e[1]);
    r.n[1] += push * 2 * (1 + 2 * e[0]);
    r.n[2] += push * -2 * e[2];
  }
  times(law.section.B, k, r.n);
  times(law.section.B, e, r.m);
  times(law.section.D, k, r.m);
  if (law.kappa0 > 0)
    for (int i = 0; i < 2; ++i) r.m[i] = zhengMoment(k[i], law.section.D[i], law.kappa0, law.kappa_regular);
  return r;
}

void tensionFieldLanes(int lanes, const double* A, const double* strain, const double* on, double* n, double* energy,
                       double* slope) {
  for (int l = 0; l < lanes; ++l) {
    if (on[l] == 0) continue;
    double stiffness[6], e[3];
    for (int i = 0; i < 6; ++i) stiffness[i] = A[i * lanes + l];
    for (int i = 0; i < 3; ++i) e[i] = strain[i * lanes + l];
    const TensionField field = tensionField(stiffness, e);
    for (int i = 0; i < 3; ++i) n[i * lanes + l] = field.n[i];
    energy[l] = field.energy;
    if (slope)
      for (int i = 0; i < 6; ++i) slope[i * lanes + l] = field.slope[i];
  }
}

}  // namespace gambeson
