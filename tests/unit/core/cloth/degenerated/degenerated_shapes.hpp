#pragma once
/// Degenerated shells for tests.

#include <functional>
#include <random>
#include <vector>

#include "core/cloth/degenerated/degenerated_shell.hpp"
#include "unit/core/cloth/shell/sheet_shapes.hpp"

namespace gambeson::shapes {

constexpr std::array<ShellRule, 4> kShellRules{ShellRule::mitc4, ShellRule::one_point, ShellRule::selective,
                                               ShellRule::full};

inline Fabric isotropicSolid(double young_Pa, double poisson, double thickness_m, double density_kg_per_m3 = 1000) {
  Fabric f;
  f.thickness_m = thickness_m;
  f.density_kg_per_m3 = density_kg_per_m3;
  f.young_weft_Pa = f.young_warp_Pa = young_Pa;
  f.poisson = poisson;
  f.shear_Pa = young_Pa / (2 * (1 + poisson));
  f.law = ConsistentBending{};
  return f;
}

/// Orthotropic, with rigidities of its own.
inline Fabric orthotropicCloth() {
  Fabric f;
  f.thickness_m = 0.02;
  f.density_kg_per_m3 = 400;
  f.young_weft_Pa = 2e6;
  f.young_warp_Pa = 3e6;
  f.shear_Pa = 4e5;
  f.poisson = 0.2;
  f.law = LinearBending{{2, 3, 1}};
  f.rest_curvature_of_shape = true;
  return f;
}

/// One patch of nu x nv cells; control point (i, j) at f(i/nu, j/nv).
inline Garment sheetOf(int nu, int nv, const Fabric& fabric, const std::function<Vec3(double, double)>& f,
                       const Vec3& weft = {1, 0, 0}) {
  Garment g;
  g.patches = {patchOf(uniformKnots(1, nu), uniformKnots(1, nv), f)};
  g.weft = {weft};
  g.fabric = fabric;
  return g;
}

/// A flat rectangle, its inner points moved in the plane by up to `distort` of a cell.
inline Garment flatSheet(int nu, int nv, double length, double width, const Fabric& fabric, double distort = 0) {
  Garment g = sheetOf(nu, nv, fabric, [&](double a, double b) { return Vec3{length * a, width * b, 0}; });
  for (int j = 1; j < nv; ++j)
    for (int i = 1; i < nu; ++i) {
      Vec3& x = g.patches[0].points[static_cast<std::size_t>(g.patches[0].index(i, j))];
      x.x += distort * length / nu * std::sin(3.1 * i + 7.7 * j);
      x.y += distort * width / nv * std::cos(5.3 * i + 2.9 * j);
    }
  return g;
}

/// A piece of a cylinder that is cut aslant, so that no cell is a rectangle.
inline Garment curvedSheet(int nu, int nv, const Fabric& fabric) {
  return sheetOf(nu, nv, fabric, [](double a, double b) {
    const double angle = 1.2 * a + 0.1 * b;
    return Vec3{std::sin(angle), b + 0.15 * a * b, 1 - std::cos(angle)};
  });
}

/// Points and directors.
struct ShellPlace {
  std::vector<Vec3> q;
  std::vector<double> inner;
  operator ClothState() const { return {q, inner, {}}; }  // NOLINT
};

inline ShellPlace atRest(const Cloth& c) {
  ShellPlace s{c.rest(), std::vector<double>(c.innerValues())};
  c.startInner(s.inner);
  return s;
}

/// Points moved by up to `move`, directors turned by up to `turn`, at random.
inline ShellPlace disturbed(const Cloth& c, double move, double turn, unsigned seed = 5) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> d(-1, 1);
  ShellPlace s = atRest(c);
  for (int p = 0; p < c.points(); ++p) {
    const Vec3 by = move * Vec3{d(random), d(random), d(random)};
    s.q[static_cast<std::size_t>(p)] += by;
  }
  for (int p = 0; p < c.points(); ++p) {  // joined points are one
    const SparseRows& T = c.map().T;
    const int home = c.map().home[static_cast<std::size_t>(
        T.columns[static_cast<std::size_t>(T.offsets[static_cast<std::size_t>(p)])])];
    s.q[static_cast<std::size_t>(p)] = s.q[static_cast<std::size_t>(home)];
  }
  std::vector<double> spin(c.innerRates()), from = s.inner;
  for (double& v : spin) v = turn * d(random);
  c.advance(from, spin, 1, s.inner);
  return s;
}

inline double energyIn(const Cloth& c, const ClothState& s, const ForceTerms& terms = {}) {
  std::vector<Vec3> f(s.q.size());
  ClothWork work;
  ClothEnergy energy;
  c.force(s, {f, {}, {}, &energy}, work, terms);
  return energy.stored;
}

/// Forces on free points, and behind them those on the rates.
inline std::vector<double> forcesIn(const Cloth& c, const ClothState& s) {
  std::vector<Vec3> f(s.q.size()), free(c.map().home.size());
  std::vector<double> inner(c.innerRates());
  ClothWork work;
  c.force(s, {f, inner, {}, nullptr}, work, {});
  c.map().Tt.multiply<Vec3>(f, free);
  std::vector<double> all;
  for (const Vec3& v : free) all.insert(all.end(), {v.x, v.y, v.z});
  all.insert(all.end(), inner.begin(), inner.end());
  return all;
}

/// A state changed along one component of the free points or the rates.
inline ShellPlace changed(const Cloth& c, const ShellPlace& s, const std::vector<double>& by) {
  ShellPlace out = s;
  std::vector<Vec3> free, all(s.q.size());
  const std::size_t n = c.map().home.size();
  for (std::size_t i = 0; i < n; ++i) free.push_back({by[3 * i], by[3 * i + 1], by[3 * i + 2]});
  c.map().T.multiply<Vec3>(free, all);
  for (std::size_t i = 0; i < all.size(); ++i) out.q[i] += all[i];
  c.advance(s.inner, std::span(by).subspan(3 * n), 1, out.inner);
  return out;
}

}  // namespace gambeson::shapes
