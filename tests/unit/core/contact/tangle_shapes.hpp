#pragma once
/// Sheets and tubes that pass through each other, for the tests of intersection resolution.

#include <cmath>
#include <random>

#include "core/contact/contact_mesh.hpp"
#include "core/math/vec.hpp"

namespace gambeson::testing_shapes {

struct Piece {
  std::vector<Vec3> x;
  std::vector<std::array<int, 3>> triangles;
};

/// n x m squares of the unit square, at x = map(u, v), diagonals alternating, normals along dx/du x dx/dv.
template <class Map>
Piece sheet(int n, int m, Map&& map) {
  Piece p;
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i <= n; ++i) p.x.push_back(map(static_cast<double>(i) / n, static_cast<double>(j) / m));
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      if ((i + j) % 2)
        p.triangles.insert(p.triangles.end(), {{a, b, d}, {a, d, c}});
      else
        p.triangles.insert(p.triangles.end(), {{a, b, c}, {b, d, c}});
    }
  return p;
}

/// A prism-like tube about z: rings of n points at (r, z), normals outward where z ascends. A last radius of 0 caps it.
inline Piece tube(const std::vector<std::array<double, 2>>& rings, int n, double turn_rad = 0.1) {
  Piece p;
  for (const auto& [r, z] : rings)
    for (int i = 0; i < (r > 0 ? n : 1); ++i) {
      const double a = turn_rad + 2 * M_PI * i / n;
      p.x.push_back({r * std::cos(a), r * std::sin(a), z});
    }
  for (int k = 0; k + 1 < static_cast<int>(rings.size()); ++k)
    for (int i = 0; i < n; ++i) {
      const int a = k * n + i, b = k * n + (i + 1) % n;
      if (rings[k + 1][0] > 0)
        p.triangles.insert(p.triangles.end(), {{a, b, b + n}, {a, b + n, a + n}});
      else
        p.triangles.push_back({a, b, (k + 1) * n});
    }
  return p;
}

template <class Map>
Piece mapped(Piece p, Map&& map) {
  for (auto& v : p.x) v = map(v);
  return p;
}

/// Several pieces in one mesh.
struct Tangled {
  ContactMesh mesh;
  std::vector<Vec3> x;
  std::vector<int> piece;  ///< per vertex

  int pieceOfFace(int face) const { return piece[mesh.triangles[face][0]]; }
  std::vector<Vec3> moved(int which, const Vec3& d) const {
    std::vector<Vec3> y = x;
    for (std::size_t v = 0; v < y.size(); ++v)
      if (piece[v] == which) y[v] += d;
    return y;
  }
};

inline Tangled join(const std::vector<Piece>& pieces) {
  Tangled t;
  std::vector<std::array<int, 3>> triangles;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const int first = static_cast<int>(t.x.size());
    t.x.insert(t.x.end(), pieces[k].x.begin(), pieces[k].x.end());
    t.piece.resize(t.x.size(), static_cast<int>(k));
    for (const auto& [a, b, c] : pieces[k].triangles) triangles.push_back({first + a, first + b, first + c});
  }
  t.mesh = contactMesh(static_cast<int>(t.x.size()), triangles);
  return t;
}

/// A capped, waisted sleeve about z whose neck (radius 20 mm, a short cylinder) is at z = 0: a body of radius 30 mm
/// that ends in a cap 60 mm beyond, and a longer open part behind.
inline Piece waistedSleeve(int n) {
  return tube({{0.030, -0.120},
               {0.030, -0.080},
               {0.029, -0.040},
               {0.020, -0.004},
               {0.020, 0.004},
               {0.029, 0.030},
               {0.030, 0.045},
               {0.020, 0.060},
               {0, 0.060}},
              n);
}

/// Triangles over `vertices` random points of an integer grid {0 .. size}^3, each of three different vertices. Vertices
/// may coincide, edges may have any number of triangles.
inline Tangled soup(std::mt19937& random, int vertices, int triangles, int size) {
  Piece p;
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  for (int v = 0; v < vertices; ++v) {
    const double x = below(size + 1), y = below(size + 1), z = below(size + 1);
    p.x.push_back({x, y, z});
  }
  while (static_cast<int>(p.triangles.size()) < triangles) {
    const int a = below(vertices), b = below(vertices), c = below(vertices);
    if (a != b && b != c && c != a) p.triangles.push_back({a, b, c});
  }
  return join({p});
}

}  // namespace gambeson::testing_shapes
