/// Detail of scene.hpp: sheets on each other.
#include "gpu/scenes/random.hpp"
#include "gpu/scenes/scene.hpp"

namespace gambeson::gpu {

namespace {

/// Close to sin(2 pi turns), of parabolas.
double wave(double turns) {
  const double at = turns - std::floor(turns);
  return at < 0.5 ? 16 * at * (0.5 - at) : -16 * (at - 0.5) * (1 - at);
}

}  // namespace

Scene wavySheets(int sheets, int n) {
  const double cell_m = 6e-3, apart_m = 2.5e-3, wave_m = 3e-3;
  Random random(3);
  Scene scene;
  scene.name = std::to_string(sheets) + " sheets of " + std::to_string(n) + " x " + std::to_string(n);
  scene.options.separation_m = 1e-6;
  scene.options.margin_m = 1.3e-3;  // of each of the two
  for (int sheet = 0; sheet < sheets; ++sheet) {
    const int first = sheet * n * n;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        // Waves of 0.19 and 0.25 m for all, ripples of each sheet's own.
        const double x = (i + 0.3 * (sheet % 3)) * cell_m, y = (j + 0.2 * (sheet % 2)) * cell_m;
        const double ripple = wave(0.048 * i + 0.16 * sheet) * wave(0.032 * j + 0.25);
        scene.x0.push_back(
            {x, y, sheet * apart_m + wave_m * wave(x / 0.19) * wave(y / 0.25 + 0.25) + 0.1 * apart_m * ripple});
        const double dx = 1e-5 * random.normal(), dy = 1e-5 * random.normal(), dz = 2e-5 * random.normal();
        scene.x1.push_back(scene.x0.back() + Vec3{dx, dy, dz - 1e-5 * sheet});
      }
    for (int j = 0; j + 1 < n; ++j)
      for (int i = 0; i + 1 < n; ++i) {
        const int a = first + i + n * j;
        scene.mesh.faces.push_back({a, a + 1, a + n + 1});
        scene.mesh.faces.push_back({a, a + n + 1, a + n});
      }
  }
  scene.mesh.vertices = static_cast<int>(scene.x0.size());
  scene.mesh.edges = edgesOf(scene.mesh.faces);
  return scene;
}

Scene fallingSheets(int n) {
  Scene scene = wavySheets(2, n);
  scene.name = "2 sheets of " + std::to_string(n) + " x " + std::to_string(n) + " that fall through each other";
  Random random(5);
  for (std::size_t i = 0; i < scene.x1.size(); ++i) {
    const bool upper = i >= scene.x1.size() / 2;
    scene.x1[i] = scene.x0[i] + Vec3{0, 0, upper ? -6e-3 : 0} + 4e-3 * random.evenVec();
  }
  return scene;
}

}  // namespace gambeson::gpu
