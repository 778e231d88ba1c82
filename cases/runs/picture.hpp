#pragma once
/// A picture of results, as cases, studies and the command ask for it.

#include <optional>

#include "analysis/render/render.hpp"
#include "cases/input/schema.hpp"

namespace gambeson {

enum class PictureTime { at, peak, end };
/// body_pressure: on the body, without the garment, the largest over the motion at each place.
/// set, friction: of cloth with friction in bending.
enum class PictureField { plain, stress, pressure, strain, thickness, body_pressure, set, friction };
/// What a picture is framed around: all of the wearer and what is worn, or the garments alone.
enum class PictureAround { wearer, garment };

struct PictureCase {
  PictureTime when = PictureTime::end;
  double time_s = 0;  ///< where `when` is `at`
  PictureField field = PictureField::stress;
  View view = View::front_right;
  PictureAround around = PictureAround::wearer;
  std::optional<int> width{}, height{};  ///< in pixels
};

struct PictureSize {
  int width = 1280, height = 960;
};

/// As wearers stand, and as the places of pictures on a page are.
inline constexpr PictureSize kUpright{960, 1280};

/// As the picture names it, or `usual`; where it names one side alone, of the shape of `usual`.
PictureSize sizeOf(const PictureCase& picture, PictureSize usual);

namespace schema {

Object pictureTable();  ///< PictureCase

}  // namespace schema
}  // namespace gambeson
