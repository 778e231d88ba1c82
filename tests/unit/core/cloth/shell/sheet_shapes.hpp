#pragma once
/// Shapes of cloth for the tests of core/cloth.

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "core/cloth/draft/garment.hpp"
#include "core/cloth/draft/seams.hpp"
#include "core/cloth/shell/shell.hpp"
#include "core/nurbs/nurbs.hpp"

namespace gambeson::shapes {

constexpr double kPi = 3.14159265358979323846;

/// Clamped knots with the given cell ends.
inline KnotVector knotsAt(int degree, const std::vector<double>& ends) {
  KnotVector k{degree, {}};
  k.knots.assign(degree + 1, ends.front());
  k.knots.insert(k.knots.end(), ends.begin() + 1, ends.end() - 1);
  k.knots.insert(k.knots.end(), degree + 1, ends.back());
  return k;
}

/// Control point (i, j) is f(Greville u_i, Greville v_j); all weights 1.
inline NurbsPatch patchOf(const KnotVector& u, const KnotVector& v, const std::function<Vec3(double, double)>& f) {
  NurbsPatch s{u, v, {}, {}};
  for (double b : grevillePoints(v))
    for (double a : grevillePoints(u)) {
      s.points.push_back(f(a, b));
      s.weights.push_back(1);
    }
  return s;
}

/// A curved patch over [0, 1.3] x [0, 1] with uneven knots; `rational` gives it smooth uneven weights.
inline NurbsPatch curvedPatch(int p, int q, bool rational) {
  NurbsPatch s = patchOf(knotsAt(p, {0, 0.3, 0.55, 1}), knotsAt(q, {0, 0.4, 1}), [](double a, double b) {
    return Vec3{1.3 * a + 0.05 * b, b - 0.07 * a * b, 0.35 * std::sin(2 * a) * (1 + 0.4 * b) + 0.2 * b * b};
  });
  std::mt19937 random(3);
  std::uniform_real_distribution<double> d(0.7, 1.4);
  if (rational)
    for (double& w : s.weights) w = d(random);
  return s;
}

/// A flat rectangle; interior control points moved in the plane by up to `distort` of a cell.
inline NurbsPatch flatPatch(const KnotVector& u, const KnotVector& v, double length, double width, double distort = 0) {
  NurbsPatch s = patchOf(u, v, [&](double a, double b) { return Vec3{length * a, width * b, 0}; });
  std::mt19937 random(11);
  std::uniform_real_distribution<double> d(-distort, distort);
  const int nu = u.count(), nv = v.count();
  for (int j = 1; j + 1 < nv; ++j)
    for (int i = 1; i + 1 < nu; ++i) {
      s.points[s.index(i, j)].x += d(random) * length / nu;
      s.points[s.index(i, j)].y += d(random) * width / nv;
    }
  return s;
}

inline NurbsPatch transposed(const NurbsPatch& s) {
  NurbsPatch t{s.v, s.u, {}, {}};
  for (int i = 0; i < s.u.count(); ++i)
    for (int j = 0; j < s.v.count(); ++j) {
      t.points.push_back(s.points[s.index(i, j)]);
      t.weights.push_back(s.weights[s.index(i, j)]);
    }
  return t;
}

/// The same surface with u running the other way.
inline NurbsPatch flippedU(const NurbsPatch& s) {
  NurbsPatch t = s;
  const double ends = s.u.knots.front() + s.u.knots.back();
  for (std::size_t k = 0; k < s.u.knots.size(); ++k) t.u.knots[k] = ends - s.u.knots[s.u.knots.size() - 1 - k];
  const int nu = s.u.count();
  for (int j = 0; j < s.v.count(); ++j)
    for (int i = 0; i < nu; ++i) {
      t.points[t.index(i, j)] = s.points[s.index(nu - 1 - i, j)];
      t.weights[t.index(i, j)] = s.weights[s.index(nu - 1 - i, j)];
    }
  return t;
}

/// Cuts along u = knot; the two surfaces together are the patch, exactly.
inline std::array<NurbsPatch, 2> cutU(const NurbsPatch& s, double knot) {
  const int p = s.u.degree;
  const auto present = static_cast<int>(std::count(s.u.knots.begin(), s.u.knots.end(), knot));
  const NurbsPatch fine = present < p ? insertKnot(s, Direction::u, knot, p - present) : s;
  const auto& k = fine.u.knots;
  const int m = static_cast<int>(std::find(k.begin(), k.end(), knot) - k.begin());
  NurbsPatch a{{p, {k.begin(), k.begin() + m + p}}, s.v, {}, {}}, b{{p, {k.begin() + m, k.end()}}, s.v, {}, {}};
  a.u.knots.push_back(knot);
  b.u.knots.insert(b.u.knots.begin(), knot);
  for (int j = 0; j < s.v.count(); ++j)
    for (int i = 0; i < fine.u.count(); ++i) {
      if (i < m) a.points.push_back(fine.points[fine.index(i, j)]), a.weights.push_back(fine.weights[fine.index(i, j)]);
      if (i >= m - 1)
        b.points.push_back(fine.points[fine.index(i, j)]), b.weights.push_back(fine.weights[fine.index(i, j)]);
    }
  return {a, b};
}

inline std::array<NurbsPatch, 2> cutV(const NurbsPatch& s, double knot) {
  const auto [a, b] = cutU(transposed(s), knot);
  return {transposed(a), transposed(b)};
}

enum class Bends { linear, zheng, consistent };

/// The rigidities of a fabric that has its own.
inline GivenRigidities& rigidities(Fabric& f) { return *givenRigidities(f.law); }
inline const GivenRigidities& rigidities(const Fabric& f) { return *givenRigidities(f.law); }
inline ZhengBending& zheng(Fabric& f) { return std::get<ZhengBending>(f.law); }

/// A fabric whose numbers have the same size, so that every term counts. nu = 0.25, weft twice as stiff as warp.
inline Fabric plainFabric(Bends law = Bends::linear) {
  Fabric f;
  f.thickness_m = 0.01;
  f.density_kg_per_m3 = 300;
  f.young_weft_Pa = 200;
  f.young_warp_Pa = 100;
  f.shear_Pa = 45;
  f.poisson = 0.25;
  const GivenRigidities given{0.3, 0.2, 0.1};
  if (law == Bends::linear) f.law = LinearBending{given};
  if (law == Bends::zheng) f.law = ZhengBending{given, 1.5, 0.2};
  if (law == Bends::consistent) f.law = ConsistentBending{};
  return f;
}

inline Garment garmentOf(std::vector<NurbsPatch> patches, std::vector<Seam> seams, const Fabric& fabric,
                         Vec3 weft = {1, 0, 0}) {
  Garment g;
  g.weft.assign(patches.size(), weft);
  g.patches = std::move(patches);
  g.seams = std::move(seams);
  g.fabric = fabric;
  return g;
}

/// Warp and weft turned by 30 degrees against the grid.
inline Vec3 turnedWeft() { return {std::cos(kPi / 6), std::sin(kPi / 6), 0}; }

/// A curved patch cut into four that meet at a corner; patches 0 1 below, 2 3 above.
inline Garment fourPatches(int p, int q, bool rational, SeamKind kind, double stiffness, const Fabric& fabric) {
  NurbsPatch whole = curvedPatch(p, q, rational);
  const auto [left, right] = cutU(whole, 0.55);
  const auto l = cutV(left, 0.4), r = cutV(right, 0.4);
  return garmentOf({l[0], r[0], l[1], r[1]},
                   {{{0, Side::u1}, {1, Side::u0}, kind, stiffness},
                    {{2, Side::u1}, {3, Side::u0}, kind, stiffness},
                    {{0, Side::v1}, {2, Side::v0}, kind, stiffness},
                    {{1, Side::v1}, {3, Side::v0}, kind, stiffness}},
                   fabric, turnedWeft());
}

/// `corners` flat patches of degree 2 around the origin, whose seams are G1 except perhaps at the origin itself:
/// control points (i, 0) and (i, 1), i > 0, of an edge have the same distance along it, and the patches are mirror
/// images.
inline Garment star(int corners, SeamKind kind, const Fabric& fabric) {
  const double phi = 2 * kPi / corners;
  const KnotVector k = uniformKnots(2, 4);
  const std::vector<double> t = grevillePoints(k);
  std::vector<NurbsPatch> patches;
  std::vector<Seam> seams;
  for (int c = 0; c < corners; ++c) {
    const Vec3 d{std::cos(c * phi), std::sin(c * phi), 0}, e{std::cos((c + 1) * phi), std::sin((c + 1) * phi), 0};
    NurbsPatch s = patchOf(k, k, [&](double, double) { return Vec3{}; });
    for (int j = 0; j < k.count(); ++j)
      for (int i = 0; i < k.count(); ++i) {
        const Vec3 along_d = t[i] * d + t[1] * std::tan(phi / 2) * Vec3{-d.y, d.x, 0};
        const Vec3 along_e = t[j] * e + t[1] * std::tan(phi / 2) * Vec3{e.y, -e.x, 0};
        s.points[s.index(i, j)] = j == 0   ? t[i] * d
                                  : i == 0 ? t[j] * e
                                  : j == 1 ? along_d
                                  : i == 1 ? along_e
                                           : t[i] * d + t[j] * e;
      }
    patches.push_back(s);
    seams.push_back({{c, Side::u0}, {(c + 1) % corners, Side::v0}, kind, 0});
  }
  return garmentOf(patches, seams, fabric);
}

/// Half a tube about z from the angle `from`; the halves meet smoothly.
inline NurbsPatch halfTube(double from) {
  const KnotVector k = uniformKnots(2, 6);
  NurbsPatch s = patchOf(k, uniformKnots(2, 3), [&](double a, double b) {
    return Vec3{std::cos(from + kPi * a), std::sin(from + kPi * a), 2 * b};
  });
  const double tangent = std::tan(kPi / 12);  // inner points on the tangents at both ends, at one distance
  for (int j = 0; j < s.v.count(); ++j)
    for (int end : {0, 1}) {
      const double at = from + kPi * end, sign = end == 0 ? 1 : -1, z = s.points[s.index(0, j)].z;
      s.points[s.index(end == 0 ? 1 : k.count() - 2, j)] = {std::cos(at) - sign * tangent * std::sin(at),
                                                            std::sin(at) + sign * tangent * std::cos(at), z};
    }
  return s;
}

inline std::vector<Vec3> restPoints(const Garment& g) {
  std::vector<Vec3> q;
  for (const NurbsPatch& p : g.patches) q.insert(q.end(), p.points.begin(), p.points.end());
  return q;
}

/// The rest positions of the free points moved at random, smooth enough to stay regular.
inline std::vector<Vec3> deformedFree(const Garment& g, const FreeMap& map, double size, unsigned seed = 5) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> d(-size, size);
  const std::vector<Vec3> q = restPoints(g);
  std::vector<Vec3> p;
  for (int i : map.home) p.push_back(q[i] + Vec3{d(random), d(random), d(random)});
  return p;
}

inline std::vector<Vec3> controlsOf(const FreeMap& map, const std::vector<Vec3>& p) {
  std::vector<Vec3> q(map.T.rows());
  map.T.multiply<Vec3>(p, q);
  return q;
}

inline std::vector<Vec3> forceOn(const Shell& shell, const std::vector<Vec3>& q, double* energy = nullptr,
                                 const ForceTerms& terms = {}) {
  ClothWork work;
  std::vector<Vec3> f(q.size());
  shell.force(q, f, work, energy, terms);
  return f;
}

inline std::vector<Vec3> onFree(const FreeMap& map, const std::vector<Vec3>& f) {
  std::vector<Vec3> p(map.home.size());
  map.Tt.multiply<Vec3>(f, p);
  return p;
}

}  // namespace gambeson::shapes
