#include "gpu/scenes/force_scenes.hpp"

#include <bit>

#include "gpu/finding/hash.hpp"
#include "gpu/scenes/random.hpp"

namespace gambeson::gpu {
namespace {

constexpr double kCell_m = 12.8e-3;

/// A parabola that vanishes at each metre.
double hump(double x) {
  const double at = x - std::floor(x);
  return at * (1 - at);
}

/// Cloth of a heavy garment.
Fabric fabric() {
  Fabric f;
  f.thickness_m = 0.7e-3;
  f.density_kg_per_m3 = 400;
  f.young_weft_Pa = 2e6;
  f.young_warp_Pa = 1.5e6;
  f.shear_Pa = 6e5;
  f.poisson = 0.3;
  f.law = ZhengBending{{3.7e-5, 3e-5, 1.3e-5}, 30, 0.3};
  f.jam_area = 0.5;
  return f;
}

KnotVector knots(int degree, int cells, Random& random) {
  KnotVector k{degree, std::vector<double>(static_cast<std::size_t>(degree) + 1, 0.0)};
  for (int i = 0; i < cells; ++i) k.knots.push_back(k.knots.back() + kCell_m * (1 + 0.3 * random.even()));
  k.knots.insert(k.knots.end(), static_cast<std::size_t>(degree), k.knots.back());
  return k;
}

NurbsPatch patch(int cells_u, int cells_v, bool rational, int degree, Random& random) {
  NurbsPatch s{knots(degree, cells_u, random), knots(degree, cells_v, random), {}, {}};
  for (const double v : grevillePoints(s.v))
    for (const double u : grevillePoints(s.u)) {
      s.points.push_back({u, v, 0.1 * u * v});
      s.weights.push_back(rational ? 1 + hump(u) + 0.5 * hump(v) : 1);
    }
  return s;
}

ForceScene sceneOf(const std::string& name, Garment garment, Random& random) {
  garment.fabric = fabric();
  garment.weft.assign(garment.patches.size(), {1, 0, 0});
  ForceScene scene{name, std::make_shared<const NurbsShell>(garment), {}};
  // Stretched by a hundredth, wavy, and moved about by a hundredth of a cell.
  for (const int home : scene.cloth->map().home) {
    const Vec3& x = scene.cloth->rest()[static_cast<std::size_t>(home)];
    scene.p.push_back(Vec3{1.01 * x.x, 0.995 * x.y, x.z + 0.05 * hump(10 * x.x)} + 0.01 * kCell_m * random.evenVec());
  }
  return scene;
}

}  // namespace

ForceScene forceSheet(int cells_u, int cells_v, bool rational, int degree) {
  Random random(1);
  Garment garment;
  garment.patches.push_back(patch(cells_u, cells_v, rational, degree, random));
  return sceneOf((rational ? "rational " : "plain ") + std::string("sheet of ") + std::to_string(cells_u) + " x " +
                     std::to_string(cells_v) + " cells of degree " + std::to_string(degree),
                 std::move(garment), random);
}

ForceScene sewnSheets(int cells) {
  Random random(2);
  Garment garment;
  NurbsPatch one = patch(cells, cells, false, 2, random), other = one;
  for (Vec3& x : other.points) x.y = -x.y;
  garment.patches = {one, other};
  garment.seams.push_back({{0, Side::v0}, {1, Side::v0}, SeamKind::C0, 0.01});
  return sceneOf("two sewn sheets of " + std::to_string(cells) + " x " + std::to_string(cells) + " cells",
                 std::move(garment), random);
}

std::vector<ForceScene> manifestForceScenes() {
  return {forceSheet(40, 30, true), forceSheet(33, 35, false), forceSheet(9, 7, true, 3), sewnSheets(20)};
}

std::uint64_t hashOfForces(const std::vector<Vec3>& forces) {
  std::uint64_t hash = 0;
  for (const Vec3& f : forces)
    for (int c = 0; c < 3; ++c) hash = mixed(hash ^ std::bit_cast<std::uint64_t>(f[c]));
  return hash;
}

}  // namespace gambeson::gpu
