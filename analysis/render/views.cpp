/// Detail of render.hpp and camera.hpp: the views, and where they look from.

#include <cmath>

#include "analysis/render/camera.hpp"
#include "analysis/render/render.hpp"

namespace gambeson {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;
/// Of the views from a corner; `above` is for what lies flat.
constexpr double kCorner_deg = 12, kAbove_deg = 45;

/// Exact at right angles, so that views along an axis are.
double sinOf(double angle_deg) {
  const double a = std::remainder(angle_deg, 360);
  return a == 0 || std::abs(a) == 180 ? 0 : std::sin(a * kDegree);
}
double cosOf(double angle_deg) { return sinOf(angle_deg + 90); }

}  // namespace

const std::vector<std::string>& viewNames() {
  static const std::vector<std::string> names{"front",      "back",        "left",      "right",      "top",
                                              "front_left", "front_right", "back_left", "back_right", "above"};
  return names;
}

std::optional<View> viewByName(const std::string& name) {
  for (std::size_t i = 0; i < viewNames().size(); ++i)
    if (viewNames()[i] == name) return static_cast<View>(i);
  return std::nullopt;
}

Viewpoint::Viewpoint(View view) {
  switch (view) {
    case View::front:
      break;
    case View::back:
      azimuth_deg = 180;
      break;
    case View::left:
      azimuth_deg = 90;
      break;
    case View::right:
      azimuth_deg = -90;
      break;
    case View::top:
      azimuth_deg = 180, elevation_deg = 90;  // the front is up in the picture
      break;
    case View::front_left:
      azimuth_deg = 45, elevation_deg = kCorner_deg;
      break;
    case View::front_right:
      azimuth_deg = -45, elevation_deg = kCorner_deg;
      break;
    case View::back_left:
      azimuth_deg = 135, elevation_deg = kCorner_deg;
      break;
    case View::back_right:
      azimuth_deg = -135, elevation_deg = kCorner_deg;
      break;
    case View::above:
      azimuth_deg = -45, elevation_deg = kAbove_deg;
      break;
  }
}

CameraAxes axesOf(const Viewpoint& view, const Vec3& up_W) {
  const Vec3 up = normalized(up_W);
  const Vec3 ahead = std::abs(up.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 0, 1};
  const Vec3 front = normalized(ahead - dot(ahead, up) * up);
  const Vec3 left = cross(up, front);
  const Vec3 level = cosOf(view.azimuth_deg) * front + sinOf(view.azimuth_deg) * left;
  CameraAxes axes;
  axes.towards = cosOf(view.elevation_deg) * level + sinOf(view.elevation_deg) * up;
  axes.up = cosOf(view.elevation_deg) * up - sinOf(view.elevation_deg) * level;
  axes.right = cross(axes.up, axes.towards);
  return axes;
}

}  // namespace gambeson
