/// Detail of scene.hpp: spheres that fly through each other.
#include <map>

#include "gpu/scenes/random.hpp"
#include "gpu/scenes/scene.hpp"

namespace gambeson::gpu {

namespace {

struct Ball {
  std::vector<Vec3> x;
  std::vector<std::array<int, 3>> faces;
};

Ball icosahedron() {
  const double p = (1 + std::sqrt(5.0)) / 2;
  Ball ball;
  ball.x = {{-1, p, 0},  {1, p, 0},  {-1, -p, 0}, {1, -p, 0}, {0, -1, p},  {0, 1, p},
            {0, -1, -p}, {0, 1, -p}, {p, 0, -1},  {p, 0, 1},  {-p, 0, -1}, {-p, 0, 1}};
  ball.faces = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  return ball;
}

/// Each triangle cut into four.
void refine(Ball& ball) {
  std::map<std::array<int, 2>, int> middle;
  const auto between = [&](int a, int b) {
    const auto [at, is_new] = middle.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<int>(ball.x.size()));
    if (is_new) ball.x.push_back(0.5 * (ball.x[a] + ball.x[b]));
    return at->second;
  };
  std::vector<std::array<int, 3>> faces;
  for (const auto& [a, b, c] : ball.faces) {
    const int ab = between(a, b), bc = between(b, c), ca = between(c, a);
    faces.insert(faces.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  ball.faces = faces;
}

}  // namespace

Scene flyingBalls(int count) {
  const double radius_m = 0.12, way_m = 0.12;
  Ball ball = icosahedron();
  refine(ball);
  refine(ball);
  Random random(7);
  Scene scene;
  scene.name = std::to_string(count) + " balls";
  scene.options.tolerance_m = 1e-10;
  for (int i = 0; i < count; ++i) {
    const Vec3 centre = random.evenVec(), way = way_m * random.evenVec();
    const int first = static_cast<int>(scene.x0.size());
    for (const Vec3& x : ball.x) {
      scene.x0.push_back(centre + radius_m * normalized(x));
      scene.x1.push_back(scene.x0.back() + way);
    }
    for (const auto& [a, b, c] : ball.faces) scene.mesh.faces.push_back({first + a, first + b, first + c});
  }
  scene.mesh.vertices = static_cast<int>(scene.x0.size());
  scene.mesh.edges = edgesOf(scene.mesh.faces);
  return scene;
}

Scene longWays(int count) {
  Scene scene = flyingBalls(count);
  scene.name += ", every fifth on a long way";
  Random random(11);
  const std::size_t of_ball = scene.x0.size() / static_cast<std::size_t>(count);
  for (std::size_t ball = 0; ball < scene.x0.size(); ball += 5 * of_ball) {
    const Vec3 way = 1.5 * random.evenVec();
    for (std::size_t i = ball; i < ball + of_ball; ++i) scene.x1[i] = scene.x0[i] + way;
  }
  return scene;
}

}  // namespace gambeson::gpu
