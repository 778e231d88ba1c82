/// Detail of scene.hpp: triangles of one shape and of many sizes.
#include "gpu/scenes/random.hpp"
#include "gpu/scenes/scene.hpp"
#include "gpu/scenes/turns.hpp"

namespace gambeson::gpu {

namespace {

/// Along the sides of the square of half side 1, from (1, -1) on; turns from 0 to 1.
Vec3 alongSquare(double turns) {
  const int side = static_cast<int>(4 * turns);
  const double at = 2 * (4 * turns - side) - 1;
  switch (side) {
    case 0:
      return {1, at, 0};
    case 1:
      return {-at, 1, 0};
    case 2:
      return {-1, -at, 0};
    default:
      return {at, -1, 0};
  }
}

}  // namespace

Scene gradedPyramids(int count, int around) {
  const double least_m = 4e-3, largest_m = 0.4, growth = 1 + 8.0 / around;
  Random random(13);
  Scene scene;
  scene.options.tolerance_m = 1e-10;
  int rings = 0;
  for (int part = 0; part < count; ++part) {
    const Mat3 turn = turnBy({1, 0.3 * part, 0.1}, 0.2 * part);
    int ring = 0;
    for (double half_m = least_m; half_m < growth * largest_m; half_m *= growth, ++ring)
      for (int k = 0; k < around; ++k) {
        const Vec3 flat = half_m * alongSquare(static_cast<double>(k) / around);
        const Vec3 fall{0, 0, -6e-3 * part};
        // No two edges in a line: a query of such is not what is measured here.
        const Vec3 uneven = 0.05 * (growth - 1) * half_m * random.evenVec();
        scene.x0.push_back(turn * (flat + Vec3{0, 0, 0.3 * half_m} + uneven) + Vec3{0, 0, 4e-3 * part});
        scene.x1.push_back(scene.x0.back() + fall + 0.3 * (growth - 1) * half_m * random.evenVec());
      }
    const int first = part * ring * around;
    for (int j = 0; j + 1 < ring; ++j)
      for (int k = 0; k < around; ++k) {
        const int a = first + j * around + k, b = first + j * around + (k + 1) % around;
        scene.mesh.faces.push_back({a, b, b + around});
        scene.mesh.faces.push_back({a, b + around, a + around});
      }
    rings = ring;
  }
  scene.name = std::to_string(count) + " pyramids of " + std::to_string(rings) + " rings of " + std::to_string(around);
  scene.mesh.vertices = static_cast<int>(scene.x0.size());
  scene.mesh.edges = edgesOf(scene.mesh.faces);
  return scene;
}

}  // namespace gambeson::gpu
