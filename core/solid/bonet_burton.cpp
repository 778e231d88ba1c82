#include "core/solid/bonet_burton.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace gambeson {
namespace {

[[noreturn]] void reject(const char* key, double value, const std::string& allowed) {
  throw InputError({"", 0, key}, fmt::format("{} is not allowed: {}", value, allowed));
}

constexpr int kRow[6] = {0, 1, 2, 1, 0, 0}, kColumn[6] = {0, 1, 2, 2, 2, 1};
constexpr int kEntry[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};

double determinant(const Symmetric& C) {
  return C[0] * (C[1] * C[2] - C[3] * C[3]) - C[5] * (C[5] * C[2] - C[3] * C[4]) + C[4] * (C[5] * C[3] - C[1] * C[4]);
}

Symmetric inverse(const Symmetric& C, double det) {
  return {(C[1] * C[2] - C[3] * C[3]) / det, (C[0] * C[2] - C[4] * C[4]) / det, (C[0] * C[1] - C[5] * C[5]) / det,
          (C[4] * C[5] - C[0] * C[3]) / det, (C[3] * C[5] - C[1] * C[4]) / det, (C[3] * C[4] - C[2] * C[5]) / det};
}

/// What energy, stress and tangent share.
struct Invariants {
  Symmetric inverse{};
  Vec3 CA;
  double J = 0, log_J = 0, stretch = 0;  ///< I4 - 1
};

bool isPositive(const Symmetric& C, double det) { return C[0] > 0 && C[0] * C[1] - C[5] * C[5] > 0 && det > 0; }

SolidAnswer notANumber() {
  SolidAnswer answer;
  answer.energy_J_per_m3 = std::numeric_limits<double>::quiet_NaN();
  answer.stress_Pa.fill(answer.energy_J_per_m3);
  return answer;
}

SolidAnswer answerOf(const BonetBurton& m, const Vec3& A, const Symmetric& C, Invariants& v) {
  const double det = determinant(C);
  if (!isPositive(C, det)) return notANumber();
  v.inverse = inverse(C, det);
  v.J = std::sqrt(det);
  v.log_J = std::log(v.J);
  v.CA = {C[0] * A.x + C[5] * A.y + C[4] * A.z, C[5] * A.x + C[1] * A.y + C[3] * A.z,
          C[4] * A.x + C[3] * A.y + C[2] * A.z};
  v.stretch = dot(A, v.CA) - 1;
  const double stretch2 = dot(v.CA, v.CA) - 1, I1 = C[0] + C[1] + C[2];
  SolidAnswer answer;
  answer.energy_J_per_m3 = 0.5 * m.mu_Pa * (I1 - 3) - m.mu_Pa * v.log_J + 0.5 * m.lambda_Pa * (v.J - 1) * (v.J - 1) +
                           (m.alpha_Pa + m.beta_Pa * v.log_J + m.gamma_Pa * v.stretch) * v.stretch -
                           0.5 * m.alpha_Pa * stretch2;
  const double on_inverse = m.lambda_Pa * v.J * (v.J - 1) - m.mu_Pa + m.beta_Pa * v.stretch;
  const double on_fibre = 2 * (m.alpha_Pa + m.beta_Pa * v.log_J + 2 * m.gamma_Pa * v.stretch);
  for (int a = 0; a < 6; ++a) {
    const int i = kRow[a], j = kColumn[a];
    answer.stress_Pa[a] = (i == j ? m.mu_Pa : 0.0) + on_inverse * v.inverse[a] + on_fibre * A[i] * A[j] -
                          m.alpha_Pa * (A[i] * v.CA[j] + v.CA[i] * A[j]);
  }
  return answer;
}

}  // namespace

void checkLaw(const BonetBurton& m) {
  const auto finite = [](const char* key, double value) {
    if (!std::isfinite(value)) reject(key, value, "finite");
  };
  finite("lambda_Pa", m.lambda_Pa);
  finite("alpha_Pa", m.alpha_Pa);
  finite("beta_Pa", m.beta_Pa);
  finite("gamma_Pa", m.gamma_Pa);
  if (!(m.mu_Pa > 0) || !std::isfinite(m.mu_Pa)) reject("mu_Pa", m.mu_Pa, "> 0");
  if (!(m.alpha_Pa < m.mu_Pa)) reject("alpha_Pa", m.alpha_Pa, fmt::format("< mu_Pa = {}", m.mu_Pa));
  if (!(m.lambda_Pa > -m.mu_Pa)) reject("lambda_Pa", m.lambda_Pa, fmt::format("> -mu_Pa = {}", -m.mu_Pa));
  const double d12 = m.lambda_Pa + 2 * m.beta_Pa;
  const double least =
      (d12 * d12 / (m.lambda_Pa + m.mu_Pa) - m.lambda_Pa - 2 * m.mu_Pa + 4 * m.alpha_Pa - 4 * m.beta_Pa) / 8;
  if (!(m.gamma_Pa > least)) reject("gamma_Pa", m.gamma_Pa, fmt::format("> {} beside the other constants", least));
}

BonetBurton lawOf(const TransverseModuli& m) {
  const auto positive = [](const char* key, double value) {
    if (!(value > 0) || !std::isfinite(value)) reject(key, value, "> 0");
  };
  positive("axial_young_Pa", m.axial_young_Pa);
  positive("transverse_young_Pa", m.transverse_young_Pa);
  positive("axial_shear_Pa", m.axial_shear_Pa);
  if (!(m.poisson_transverse > -1 && m.poisson_transverse < 1))
    reject("poisson_transverse", m.poisson_transverse, "-1 to 1, both excluded");
  const double EA = m.axial_young_Pa, ET = m.transverse_young_Pa;
  const double delta = 1 - m.poisson_transverse - 2 * m.poisson_axial * m.poisson_axial * ET / EA;
  if (!(delta > 0))
    reject("poisson_axial", m.poisson_axial,
           fmt::format("between -{0} and {0} beside the other moduli",
                       std::sqrt(0.5 * (1 - m.poisson_transverse) * EA / ET)));
  BonetBurton law;
  const double D11 = EA * (1 - m.poisson_transverse) / delta, D12 = m.poisson_axial * ET / delta;
  law.mu_Pa = 0.5 * ET / (1 + m.poisson_transverse);
  law.lambda_Pa = 0.5 * ET / delta - law.mu_Pa;
  law.alpha_Pa = law.mu_Pa - m.axial_shear_Pa;
  law.beta_Pa = 0.5 * (D12 - law.lambda_Pa);
  law.gamma_Pa = (D11 - law.lambda_Pa - 2 * law.mu_Pa + 4 * law.alpha_Pa - 4 * law.beta_Pa) / 8;
  return law;
}

TransverseModuli moduliOf(const BonetBurton& law) {
  checkLaw(law);
  const double D11 = law.lambda_Pa + 2 * law.mu_Pa + 8 * law.gamma_Pa - 4 * law.alpha_Pa + 4 * law.beta_Pa;
  const double D12 = law.lambda_Pa + 2 * law.beta_Pa, sum = 2 * (law.lambda_Pa + law.mu_Pa);  // D22 + D23
  TransverseModuli m;
  m.axial_young_Pa = D11 - 2 * D12 * D12 / sum;
  m.poisson_axial = D12 / sum;
  // Across: the compliance of (D22 + D23)/2 with its axial strain set free, and of mu.
  const double free = sum - 2 * D12 * D12 / D11;
  m.transverse_young_Pa = 4 * law.mu_Pa * free / (free + 2 * law.mu_Pa);
  m.poisson_transverse = (free - 2 * law.mu_Pa) / (free + 2 * law.mu_Pa);
  m.axial_shear_Pa = law.mu_Pa - law.alpha_Pa;
  return m;
}

BonetBurton isotropicLaw(double young_Pa, double poisson) {
  if (!(young_Pa > 0) || !std::isfinite(young_Pa)) reject("young_Pa", young_Pa, "> 0");
  if (!(poisson > -1 && poisson < 0.5)) reject("poisson", poisson, "-1 to 0.5, both excluded");
  return {young_Pa * poisson / ((1 + poisson) * (1 - 2 * poisson)), 0.5 * young_Pa / (1 + poisson)};
}

SolidAnswer evaluate(const BonetBurton& law, const Vec3& fibre, const Symmetric& C) {
  Invariants unused;
  return answerOf(law, fibre, C, unused);
}

SolidAnswer evaluate(const BonetBurton& m, const Vec3& A, const Symmetric& C, Elasticity& D) {
  Invariants v;
  const SolidAnswer answer = answerOf(m, A, C, v);
  if (std::isnan(answer.energy_J_per_m3)) {
    D.fill(answer.energy_J_per_m3);
    return answer;
  }
  const Symmetric& Ci = v.inverse;
  const double on_G = 2 * (m.mu_Pa - m.lambda_Pa * v.J * (v.J - 1) - m.beta_Pa * v.stretch);
  const double on_inverses = m.lambda_Pa * v.J * (2 * v.J - 1);
  const auto delta = [](int i, int j) { return i == j ? 1.0 : 0.0; };
  for (int a = 0; a < 6; ++a)
    for (int b = a; b < 6; ++b) {
      const int i = kRow[a], j = kColumn[a], k = kRow[b], l = kColumn[b];
      const double G = 0.5 * (Ci[kEntry[i][k]] * Ci[kEntry[j][l]] + Ci[kEntry[i][l]] * Ci[kEntry[j][k]]);  // eq. 4.71
      const double mixed =
          A[i] * A[l] * delta(j, k) + A[i] * A[k] * delta(j, l) + A[j] * A[l] * delta(i, k) + A[j] * A[k] * delta(i, l);
      const double value = on_G * G + on_inverses * Ci[a] * Ci[b] + 8 * m.gamma_Pa * A[i] * A[j] * A[k] * A[l] +
                           2 * m.beta_Pa * (A[i] * A[j] * Ci[b] + Ci[a] * A[k] * A[l]) - m.alpha_Pa * mixed;
      D[6 * a + b] = D[6 * b + a] = value;
    }
  return answer;
}

}  // namespace gambeson
