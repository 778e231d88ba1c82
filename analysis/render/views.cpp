/// Detail of render.hpp and camera.hpp: the views, and where they look from.

#include <cassert>

#include "analysis/render/camera.hpp"
#include "analysis/render/render.hpp"

namespace gambeson {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;
/// Of the views from a corner; `above` is for what lies flat.
constexpr double kElevation_rad = 12 * kDegree, kAbove_rad = 45 * kDegree;

/// Where a view looks from, in the body's frame: front, left, up.
Vec3 towardsViewer(View view) {
  switch (view) {
    case View::front:
      return {1, 0, 0};
    case View::back:
      return {-1, 0, 0};
    case View::left:
      return {0, 1, 0};
    case View::right:
      return {0, -1, 0};
    case View::top:
      return {0, 0, 1};
    case View::front_left:
      return {1, 1, 0};
    case View::front_right:
    case View::above:
      return {1, -1, 0};
    case View::back_left:
      return {-1, 1, 0};
    case View::back_right:
      return {-1, -1, 0};
  }
  assert(false);
  return {1, 0, 0};
}

bool isElevated(View view) { return norm2(towardsViewer(view)) > 1.5; }

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

CameraAxes axesOf(View view, const Vec3& up_W) {
  const Vec3 up = normalized(up_W);
  const Vec3 ahead = std::abs(up.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 0, 1};
  const Vec3 front = normalized(ahead - dot(ahead, up) * up);
  const Vec3 left = cross(up, front);
  const Vec3 b = normalized(towardsViewer(view));
  CameraAxes axes;
  axes.towards = b.x * front + b.y * left + b.z * up;
  if (view == View::top) {
    axes.up = front;
  } else {
    const double e = view == View::above ? kAbove_rad : isElevated(view) ? kElevation_rad : 0;
    const Vec3 level = axes.towards;
    axes.towards = std::cos(e) * level + std::sin(e) * up;
    axes.up = std::cos(e) * up - std::sin(e) * level;
  }
  axes.right = cross(axes.up, axes.towards);
  return axes;
}

}  // namespace gambeson
