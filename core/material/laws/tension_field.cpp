#include "core/material/laws/tension_field.hpp"

namespace gambeson {

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
