#include "cases/cloth/card_terms.hpp"

#include <cmath>

namespace gambeson::lab {

double linearity(double work, double extension, double force) { return work / (0.5 * extension * force); }

double rigidityOfLength(double c, double weight) { return weight * kGravity_m_per_s2 * c * c * c; }
double lengthOfRigidity(double B, double weight) { return std::cbrt(B / (weight * kGravity_m_per_s2)); }

double shearOfBias(double extension) { return kFastLoads_N_per_m[0] / (4 * extension); }
double biasOfShear(double G) { return kFastLoads_N_per_m[0] / (4 * G); }

double formability(double B, double E5, double E20) {
  return B * (E20 - E5) / (kFastLoads_N_per_m[1] - kFastLoads_N_per_m[0]);
}

double stiffnessAt(double force, double e) { return force / ((1 + e) * greenOf(e)); }

double strainUnder(double force, double stiffness) {
  double e = force / stiffness;  // above the root, where the force is convex in e
  for (int i = 0; i < 60; ++i) {
    const double wrong = stiffness * (1 + e) * greenOf(e) - force;
    e -= wrong / (stiffness * (greenOf(e) + (1 + e) * (1 + e)));
  }
  return e;
}

}  // namespace gambeson::lab
