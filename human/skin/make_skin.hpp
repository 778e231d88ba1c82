#pragma once
/// A skin made around the ellipsoids of a human.

#include "human/body/body.hpp"
#include "human/body/skin.hpp"

namespace gambeson {

/// How a skin is made.
struct SkinOptions {
  double cell_m = 0.012;        ///< edge length where garments lie; hands, feet and head have up to 1.6 times as much
  double crease_gap_m = 0.003;  ///< where a joint folds the skin onto itself, the two sides stay this far apart
};

/// The skin of a human of ellipsoids with the links, joints and shapes of our manikins (human/manikin/manikin.hpp), in
/// the standing posture with the limbs held. Symmetric about the median plane. Throws InputError where a part is
/// missing or an option is out of range.
Skin makeSkin(const Human& human, const SkinOptions& options = {});

}  // namespace gambeson
