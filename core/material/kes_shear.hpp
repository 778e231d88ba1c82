#pragma once
/// What KES-FB1 reads of friction in shear, and the friction of which it reads that.

#include "core/material/laws/shear_friction.hpp"

namespace gambeson {

/// G, slope between 0.5 and 2.5 degrees [N/m per shear strain], and widths of the loop at 0.5 and 5 degrees, 2HG and
/// 2HG5 [N/m], each the mean of both sides, of a loop to 8 degrees either way.
struct KesShear {
  double rigidity_N_per_m = 0, hysteresis_N_per_m = 0, hysteresis_5_N_per_m = 0;
};

/// A sheared sheet: A33 [N/m], and its friction.
struct ShearedSheet {
  double elastic_N_per_m = 0;
  ShearFriction friction;
};

/// Reads a loop that has settled.
KesShear readKesShear(const ShearedSheet& sheet);

/// The sheet of which KES-FB1 reads this, its friction overcome at the shear strain `span`. Where
/// `hysteresis_5_N_per_m` is 0 no friction grows with the shear. Throws InputError (reason only) where there is none: 2HG5 below what 2HG's
/// friction has there, or G below what friction gives it.
ShearedSheet sheetOfKesShear(const KesShear& read, double span);

}  // namespace gambeson
