#include "analysis/render/camera.hpp"

#include <algorithm>
#include <limits>

namespace gambeson {

std::array<Vec3, 2> boxOf(std::span<const Vec3> x, double margin_m) {
  const double inf = std::numeric_limits<double>::infinity();
  std::array<Vec3, 2> box{Vec3{inf, inf, inf}, Vec3{-inf, -inf, -inf}};
  for (const Vec3& p : x)
    for (int c = 0; c < 3; ++c) {
      box[0][c] = std::min(box[0][c], p[c] - margin_m);
      box[1][c] = std::max(box[1][c], p[c] + margin_m);
    }
  return box;
}

Camera fitCamera(const Scene& scene, const Viewpoint& from, const PixelRect& free) {
  Camera camera;
  camera.axes = axesOf(from, scene.up);
  constexpr double inf = std::numeric_limits<double>::infinity();
  Vec3 low{inf, inf, inf}, high{-inf, -inf, -inf};
  const auto include = [&](const Vec3& x) {
    const Vec3 c = camera.toCamera(x);
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], c[i]);
      high[i] = std::max(high[i], c[i]);
    }
  };
  if (scene.focus) {
    const auto& [a, b] = *scene.focus;
    for (int i = 0; i < 8; ++i) include({i & 1 ? b.x : a.x, i & 2 ? b.y : a.y, i & 4 ? b.z : a.z});
  } else {
    for (const auto& mesh : scene.meshes)
      for (const auto& x : mesh.vertices) include(x);
    for (const auto& arrow : scene.arrows) include(arrow.from), include(arrow.to);
  }
  if (!(low.x <= high.x)) low = {-1, -1, -1}, high = {1, 1, 1};  // nothing to show
  const Vec3 middle = 0.5 * (low + high);
  camera.origin = middle.x * camera.axes.right + middle.y * camera.axes.up + middle.z * camera.axes.towards;
  const double margin = 0.96, least_m = 1e-9;
  camera.pixels_per_m = margin * std::min(free.width() / std::max(high.x - low.x, least_m),
                                          free.height() / std::max(high.y - low.y, least_m));
  if (!(camera.pixels_per_m < 1e9)) camera.pixels_per_m = 1e3;  // a single point
  camera.center_x = 0.5 * (free.left + free.right);
  camera.center_y = 0.5 * (free.top + free.bottom);
  return camera;
}

}  // namespace gambeson
