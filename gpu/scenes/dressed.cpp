/// Detail of dressed.hpp.
#include "gpu/scenes/dressed.hpp"

#include <bit>
#include <map>

#include "gpu/finding/hash.hpp"
#include "gpu/scenes/random.hpp"
#include "gpu/scenes/turns.hpp"

namespace gambeson::gpu {
namespace {

/// Close to sin(2 pi turns), of parabolas.
double wave(double turns) {
  const double at = turns - std::floor(turns);
  return at < 0.5 ? 16 * at * (0.5 - at) : -16 * (at - 0.5) * (1 - at);
}

TriangleMesh ball(double radius_m, int levels) {
  const double p = (1 + std::sqrt(5.0)) / 2;
  TriangleMesh m;
  m.vertices = {{-1, p, 0},  {1, p, 0},  {-1, -p, 0}, {1, -p, 0}, {0, -1, p},  {0, 1, p},
                {0, -1, -p}, {0, 1, -p}, {p, 0, -1},  {p, 0, 1},  {-p, 0, -1}, {-p, 0, 1}};
  m.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                 {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                 {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int l = 0; l < levels; ++l) {
    std::map<std::pair<int, int>, int> middle;
    const auto between = [&](int a, int b) {
      const auto [at, is_new] =
          middle.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<int>(m.vertices.size()));
      if (is_new) m.vertices.push_back(0.5 * (m.vertices[a] + m.vertices[b]));
      return at->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : m.triangles) {
      const int ab = between(a, b), bc = between(b, c), ca = between(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    m.triangles = finer;
  }
  for (Vec3& x : m.vertices) x = radius_m * normalized(x);
  return m;
}

TriangleMesh box(const Vec3& half) {
  TriangleMesh m;
  for (int i = 0; i < 8; ++i)
    m.vertices.push_back({i & 1 ? half.x : -half.x, i & 2 ? half.y : -half.y, i & 4 ? half.z : -half.z});
  m.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                 {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return m;
}

/// A square sheet with cells of `cell_m`, its middle at the origin, at(x, y) away from its plane at the start.
template <class At>
SheetPart sheetPart(int n, double cell_m, double thickness_m, const At& at) {
  SheetPart part;
  part.nu = part.nv = n;
  part.thickness_m = thickness_m;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const double x = (i - 0.5 * (n - 1)) * cell_m, y = (j - 0.5 * (n - 1)) * cell_m;
      part.rest.push_back({x, y, 0});
      part.x0.push_back({x, y, at(x, y)});
    }
  return part;
}

void shake(SheetPart& part, Random& random, double noise_m, double way_m, const Vec3& way) {
  part.x1.clear();
  for (Vec3& x : part.x0) {
    x += noise_m * random.evenVec();
    part.x1.push_back(x + way + way_m * random.evenVec());
  }
}

/// How far edges and one diagonal of each cell stand out in the middle, by second differences along them.
void addBulges(const SheetPart& part, int first, Bulges& bulges, std::vector<std::vector<std::pair<int, double>>>& of) {
  const auto add = [&](int i, int j, int di, int dj, double kind) {
    const auto sample = [&](int k) { return first + i + k * di + part.nu * (j + k * dj); };
    if (i + 2 * di >= part.nu || j + 2 * dj >= part.nv) return;
    for (int k = 0; k < 3; ++k) bulges.middle.add(sample(k), k == 1 ? 0.25 : -0.125);
    bulges.middle.endRow();
    const int row = static_cast<int>(bulges.ends.size());
    bulges.ends.push_back({sample(0), sample(1)});
    for (int k = 0; k < 2; ++k) of[static_cast<std::size_t>(sample(k))].emplace_back(row, kind);
  };
  for (int j = 0; j < part.nv; ++j)
    for (int i = 0; i < part.nu; ++i) {
      add(i, j, 1, 0, 1);
      add(i, j, 0, 1, 1);
      add(i, j, 1, 1, 0);
    }
}

}  // namespace

std::unique_ptr<DressedScene> dressed(const std::string& name, const std::vector<SheetPart>& sheets,
                                      std::vector<Obstacle> obstacles, std::vector<Placement> start) {
  auto scene = std::make_unique<DressedScene>();
  scene->name = name;
  Surface s;
  std::vector<Vec3> rest;
  std::vector<int> garment;
  std::vector<double> thickness;
  std::vector<std::vector<std::pair<int, double>>> bulges_of;
  for (std::size_t p = 0; p < sheets.size(); ++p) {
    const SheetPart& part = sheets[p];
    const int first = static_cast<int>(rest.size());
    rest.insert(rest.end(), part.rest.begin(), part.rest.end());
    scene->x0.insert(scene->x0.end(), part.x0.begin(), part.x0.end());
    scene->x1.insert(scene->x1.end(), part.x1.begin(), part.x1.end());
    garment.resize(rest.size(), part.garment);
    thickness.resize(rest.size(), part.thickness_m);
    bulges_of.resize(rest.size());
    std::vector<int> grid;
    for (int k = 0; k < part.nu * part.nv; ++k) grid.push_back(first + k);
    s.patch_grid.push_back(grid);
    s.patch_grid_size.push_back({part.nu, part.nv});
    for (int j = 0; j + 1 < part.nv; ++j)
      for (int i = 0; i + 1 < part.nu; ++i) {
        const int a = first + i + part.nu * j, b = a + 1, c = b + part.nu, d = a + part.nu;
        s.triangles.push_back({a, b, c});
        s.triangles.push_back({a, c, d});
        for (int k = 0; k < 2; ++k) {
          s.triangle_patch.push_back(static_cast<int>(p));
          s.triangle_cell.push_back(i + (part.nu - 1) * j);
        }
      }
    addBulges(part, first, scene->bulges, bulges_of);
  }
  for (const auto& of : bulges_of) {
    for (const auto& [row, kind] : of) scene->bulges.of_sample.add(row, kind);
    scene->bulges.of_sample.endRow();
  }
  s.area_m2.assign(rest.size(), 1);
  scene->obstacles = std::move(obstacles);
  scene->start = scene->end = std::move(start);
  scene->start_vertices = DeformedVertices(scene->obstacles);
  for (std::size_t o = 0; o < scene->obstacles.size(); ++o)
    if (scene->obstacles[o].deforms) {
      const std::vector<Vec3>& x = std::get<TriangleMesh>(scene->obstacles[o].shape).vertices;
      std::copy(x.begin(), x.end(), scene->start_vertices[o].begin());
    }
  scene->end_vertices = scene->start_vertices;
  scene->collisions = buildCollisions(s, rest, garment, thickness, scene->obstacles, scene->start, true);
  return scene;
}

std::unique_ptr<DressedScene> foldedSheet(int n, double cell_m) {
  const double thickness_m = 2e-3, apart_m = 2.05e-3;
  SheetPart part = sheetPart(n, cell_m, thickness_m, [](double, double) { return 0.0; });
  // To the right, back over itself, and to the right again; the turns are one cell long.
  const int third = n / 3;
  const auto fold = [&](int i) {
    const int turn = i / third, at = i % third;
    return Vec3{cell_m * (turn % 2 == 0 ? at : third - 1 - at), 0, turn * apart_m};
  };
  Random random(11);
  for (int j = 0; j < n; ++j) {
    double along = 0;
    for (int i = 0; i < n; ++i) {
      const Vec3 f = fold(i);
      if (i > 0) along += norm(f - fold(i - 1));
      part.x0[i + n * j] = {f.x, cell_m * j + 0.3 * f.z, f.z + 0.6e-3 * wave(0.07 * j) + 0.2e-3 * wave(f.x / 0.03)};
      part.rest[i + n * j] = {along, cell_m * j, 0};
    }
  }
  shake(part, random, 2e-4, 1e-4, {});
  const std::string cells = std::to_string(n) + " x " + std::to_string(n);
  return dressed(
      cell_m < thickness_m ? "fine sheet of " + cells + " folded on itself" : "sheet of " + cells + " folded on itself",
      {part}, {}, {});
}

std::unique_ptr<DressedScene> twoLayers(int n) {
  Random random(12);
  const auto ripple = [](double x, double y) { return 4e-3 * wave(x / 0.05) * wave(y / 0.06 + 0.25); };
  SheetPart below = sheetPart(n, 6e-3, 1.5e-3, ripple),
            above = sheetPart(n, 5e-3, 2.5e-3, [&](double x, double y) { return ripple(x, y) + 1.9e-3; });
  above.garment = 1;
  shake(below, random, 8e-4, 1e-4, {});
  shake(above, random, 8e-4, 1e-4, {0, 0, -3e-4});
  return dressed("two layers of " + std::to_string(n) + " x " + std::to_string(n), {below, above}, {}, {});
}

std::unique_ptr<DressedScene> facingPeaks(int n) {
  Random random(16);
  const double cell_m = 4e-3, peak_m = 0.8e-3;
  const auto peak = [&](double x, double y) {
    const long i = static_cast<long>(x / cell_m + 1000.5), j = static_cast<long>(y / cell_m + 1000.5);
    return i % 2 == 0 && j % 2 == 0 ? peak_m : 0.0;
  };
  SheetPart below = sheetPart(n, cell_m, 1.5e-3, peak),
            above = sheetPart(n, cell_m, 1.7e-3, [&](double x, double y) { return 2 * peak_m + 1.6e-3 - peak(x, y); });
  above.garment = 1;
  shake(below, random, 5e-5, 1e-4, {});
  shake(above, random, 5e-5, 1e-4, {0, 0, -1e-4});
  return dressed("two sheets with peaks that face each other", {below, above}, {}, {});
}

std::unique_ptr<DressedScene> sheetOnEllipsoids(int n) {
  Random random(13);
  SheetPart part = sheetPart(n, 6e-3, 1.2e-3, [](double x, double y) { return -2.5 * (x * x + y * y); });
  shake(part, random, 2e-4, 3e-4, {0, 0, -2e-4});
  const std::vector<Vec3> axes{{0.2, 0.19, 0.21}, {0.05, 0.05, 0.02}, {0.12, 0.03, 0.04}};
  std::vector<Obstacle> obstacles;
  for (const Vec3& a : axes) obstacles.push_back({Ellipsoid{a}, "ellipsoid " + std::to_string(obstacles.size())});
  std::vector<Placement> at(3);
  at[0].origin = {0, 0, -0.2105};
  at[1] = {turnBy({1, 0.3, 0}, 0.2), {0.03, 0.02, 0.022}, 1.03};
  at[2] = {turnBy({0, 0.2, 1}, 0.5), {-0.04, 0, -0.045}, 1};
  auto scene = dressed("sheet on ellipsoids", {part}, obstacles, at);
  for (Placement& X : scene->end) X = {turnBy({0.3, 1, 0.2}, 1e-3), X.origin + 2e-4 * random.evenVec(), X.scale};
  for (std::size_t o = 0; o < 3; ++o) scene->end[o].rotation = scene->end[o].rotation * at[o].rotation;
  return scene;
}

std::unique_ptr<DressedScene> sheetOnSolids(int n, bool deform) {
  Random random(14);
  // Edges of the box lie between samples; over one of them the sheet slopes down.
  SheetPart part = sheetPart(n, 7e-3, 1.2e-3, [](double x, double) {
    return x > 0.046 ? 6e-4 - 0.9 * (x - 0.046) : x > 0.038 ? 1.1e-3 - 0.06 * (x - 0.038) : 1.1e-3;
  });
  shake(part, random, 3e-4, 3e-4, {0, 0, -2e-4});
  std::vector<Obstacle> obstacles{{box({0.043, 0.031, 0.02}), "box"},
                                  {ball(0.03, 2), "ball"},
                                  {ball(0.03, 2), "ball in the sheet"},
                                  {ball(5e-3, 1), "bead around a sample beside an edge of the box"}};
  std::vector<Placement> at(4);
  at[0].origin = {0, 0.0013, -0.02};
  at[1] = {turnBy({1, 1, 0}, 0.3), {-0.05, -0.05, -0.0285}, 1.01};
  at[2] = {turnBy({1, 0, 0}, 0.1), {0.04, -0.065, 0.0004}, 0.9};
  at[3].origin = {0.0455, 0.0035, 6e-4};
  if (deform)
    for (std::size_t o = 0; o < obstacles.size(); ++o) {
      for (Vec3& x : std::get<TriangleMesh>(obstacles[o].shape).vertices) x = at[o] * x;
      at[o] = {};
      obstacles[o].deforms = true;
    }
  auto scene = dressed(deform ? "sheet on soft solids" : "sheet on solids", {part}, obstacles, at);
  const std::vector<Vec3> way{{1e-4, 0, 2e-4}, {0, 0, 3e-4}, {0, 1e-4, 0}, {}};
  for (std::size_t o = 0; o < obstacles.size(); ++o)
    if (deform)
      for (Vec3& x : scene->end_vertices[o]) x += way[o] + Vec3{0, 1e-4 * wave(x.x / 0.02), 0};
    else
      scene->end[o].origin += way[o];
  return scene;
}

std::unique_ptr<DressedScene> sheetOnSkin(int n) {
  Random random(15);
  const double radius_m = 0.06;
  const auto over = [&](double away) {
    return [=](double x, double y) {
      const double r2 = radius_m * radius_m - x * x - y * y;
      return (r2 > 0 ? std::sqrt(r2) : -0.5 * radius_m) + away;
    };
  };
  SheetPart below = sheetPart(n, 4e-3, 1e-3, over(0.9e-3)), above = sheetPart(n, 4.3e-3, 1.4e-3, over(2.2e-3));
  above.garment = 1;
  shake(below, random, 2e-4, 2e-4, {});
  shake(above, random, 2e-4, 2e-4, {0, 0, -2e-4});
  TriangleMesh skin = ball(radius_m, 3);
  for (Vec3& x : skin.vertices) x *= 1 + 0.01 * wave(x.x / 0.02) * wave(x.y / 0.03);
  TriangleMesh other = ball(0.02, 2);
  for (Vec3& x : other.vertices) x += Vec3{0.055, 0, 0.03};
  auto scene = dressed("two layers on skin", {below, above}, {{skin, "skin", true}, {other, "hand", true}},
                       std::vector<Placement>(2));
  for (std::size_t o = 0; o < 2; ++o)
    for (Vec3& x : scene->end_vertices[o]) x += Vec3{1e-4 * wave(x.y / 0.1), 0, 1.5e-4 * wave(x.x / 0.05)};
  return scene;
}

std::vector<std::unique_ptr<DressedScene>> dressedScenes() {
  std::vector<std::unique_ptr<DressedScene>> all;
  all.push_back(foldedSheet(30, 6e-3));
  all.push_back(foldedSheet(30, 1.3e-3));
  all.push_back(twoLayers(24));
  all.push_back(facingPeaks(16));
  all.push_back(sheetOnEllipsoids(24));
  all.push_back(sheetOnSolids(24, false));
  all.push_back(sheetOnSolids(24, true));
  all.push_back(sheetOnSkin(24));
  return all;
}

std::uint64_t hashOf(const NearContacts& contacts) {
  std::uint64_t hash = 0;
  for (std::size_t i = 0; i < contacts.facts.size(); ++i) {
    std::uint64_t one = mixed(i);
    const auto take = [&](std::uint64_t bits) { one = mixed(one ^ bits); };
    const auto number = [&](double x) { take(std::bit_cast<std::uint64_t>(x)); };
    const auto integer = [&](int x) { take(static_cast<std::uint32_t>(x)); };
    const auto vector = [&](const Vec3& x) { number(x.x), number(x.y), number(x.z); };
    const ContactFacts& f = contacts.facts[i];
    for (const int x : {f.kind, f.sample, f.obstacle, f.feature, f.partner, f.pair}) integer(x);
    vector(f.normal), vector(f.body_velocity);
    for (const double x : {f.gap_m, f.layer_m, f.clearance_m}) number(x);
    const ContactStencil& s = contacts.stencil[i];
    integer(s.count);
    for (int k = 0; k < s.count; ++k) integer(s.sample[k]), number(s.weight[k]);
    const BodyTouch& t = contacts.touch[i];
    vector(t.local);
    for (int k = 0; k < 3; ++k) integer(t.vertex[k]), number(t.weight[k]);
    hash += one;
  }
  return hash;
}

NearFacts factsOf(NearSearch& search) { return {search.sizes(), hashOf(search.contacts())}; }

}  // namespace gambeson::gpu
