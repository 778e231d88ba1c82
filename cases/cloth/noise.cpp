#include "cases/cloth/noise.hpp"

#include <fmt/format.h>
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "cases/cloth/arc.hpp"
#include "cases/cloth/fields.hpp"
#include "cases/input/table.hpp"
#include "core/cloth/draft/seams.hpp"

namespace gambeson {
namespace {

/// Uniform in [0, 1), the same on every machine.
double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

/// Uniform in [-1, 1).
double even(std::mt19937_64& random) { return 2 * uniform(random) - 1; }

/// Waves over [0, 1] with the amplitude 1.
struct Waves {
  std::vector<double> size, phase;
  int from = 0;
  double largest = 0;

  Waves(const NoiseCase& n, std::mt19937_64& random) : from(n.from) {
    for (int k = n.from; k <= n.to; ++k) {
      size.push_back(even(random));
      phase.push_back(2 * std::numbers::pi * uniform(random));
    }
    for (int i = 0; i < 4096; ++i) largest = std::max(largest, std::abs(sum(i / 4096.)));
  }
  double sum(double t) const {
    double s = 0;
    for (std::size_t k = 0; k < size.size(); ++k)
      s += size[k] * std::cos(2 * std::numbers::pi * (from + static_cast<double>(k)) * t + phase[k]);
    return s;
  }
  double operator()(double t) const { return largest > 0 ? sum(t) / largest : 0; }
};

/// The basis at the Greville points: row i is point i.
Eigen::MatrixXd grevilleBasis(const KnotVector& k, const std::vector<double>& at) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(k.count(), k.count());
  std::vector<double> values(static_cast<std::size_t>(k.degree) + 1);
  for (int i = 0; i < k.count(); ++i) {
    const int span = findSpan(k, at[static_cast<std::size_t>(i)]);
    basisDerivatives(k, span, at[static_cast<std::size_t>(i)], 0, values);
    for (int b = 0; b <= k.degree; ++b) A(i, span - k.degree + b) = values[static_cast<std::size_t>(b)];
  }
  return A;
}

/// Control points of the field that has the values of `f` (by control point) at the Greville points.
void interpolate(const NurbsPatch& p, std::vector<Vec3>& f) {
  const Eigen::MatrixXd U = grevilleBasis(p.u, grevillePoints(p.u)), V = grevilleBasis(p.v, grevillePoints(p.v));
  const Eigen::Map<const Eigen::MatrixXd> weights(p.weights.data(), p.u.count(), p.v.count());
  const Eigen::MatrixXd W = U * weights * V.transpose();
  const Eigen::PartialPivLU<Eigen::MatrixXd> u(U), v(V);
  for (int d = 0; d < 3; ++d) {
    Eigen::MatrixXd value(p.u.count(), p.v.count());
    for (int j = 0; j < p.v.count(); ++j)
      for (int i = 0; i < p.u.count(); ++i) value(i, j) = f[static_cast<std::size_t>(p.index(i, j))][d] * W(i, j);
    const Eigen::MatrixXd half = u.solve(value), control = v.solve(half.transpose()).transpose();
    for (int j = 0; j < p.v.count(); ++j)
      for (int i = 0; i < p.u.count(); ++i)
        f[static_cast<std::size_t>(p.index(i, j))][d] = control(i, j) / weights(i, j);
  }
}

}  // namespace

std::vector<Vec3> noiseOf(const Sheet& sheet, const NoiseCase& noise) {
  const Garment& g = sheet.garment;
  const FreeMap map = buildFreeMap(g);
  const std::vector<int> offsets = controlOffsets(g);
  std::mt19937_64 random(static_cast<std::uint64_t>(noise.seed));
  std::vector<Vec3> free(map.home.size()), all(static_cast<std::size_t>(offsets.back()));
  const auto normalAt = [](const NurbsPatch& p, double u, double v) {
    const std::array<Vec3, 6> x = surfaceDerivatives(p, u, v);
    const Vec3 a = cross(x[1], x[2]);
    return norm(a) > 0 ? normalized(a) : Vec3{};  // a pole stays
  };
  if (noise.from == 0) {
    for (std::size_t f = 0; f < free.size(); ++f) {
      const auto patch =
          static_cast<std::size_t>(std::upper_bound(offsets.begin(), offsets.end(), map.home[f]) - offsets.begin() - 1);
      const NurbsPatch& p = g.patches[patch];
      const int local = map.home[f] - offsets[patch], i = local % p.u.count(), j = local / p.u.count();
      const double size = even(random);
      free[f] = noise.amplitude_m * size *
                normalAt(p, grevillePoints(p.u)[static_cast<std::size_t>(i)],
                         grevillePoints(p.v)[static_cast<std::size_t>(j)]);
    }
  } else {
    // Interpolated: as coefficients of quadratics a wave of 2.7 cells would shrink to half, and more on a coarser mesh.
    const Waves waves(noise, random);
    for (std::size_t patch = 0; patch < g.patches.size(); ++patch) {
      const NurbsPatch& p = g.patches[patch];
      const KnotVector& k = noise.along_v ? p.v : p.u;
      const double angle = noise.along_v ? sheet.angle_v_rad : sheet.angle_u_rad;
      const int count = noise.along_v ? sheet.count_v : sheet.count_u;
      const int index = static_cast<int>(patch);
      const int piece = !sheet.grid ? 0 : noise.along_v ? index / sheet.count_u : index % sheet.count_u;
      const std::vector<double> us = grevillePoints(p.u), vs = grevillePoints(p.v);
      std::vector<Vec3> field;
      for (const double v : vs)
        for (const double u : us) {
          const double t = ((noise.along_v ? v : u) - k.front()) / (k.back() - k.front());
          field.push_back(noise.amplitude_m * waves((piece + arcFraction(angle, t)) / count) * normalAt(p, u, v));
        }
      interpolate(p, field);
      std::copy(field.begin(), field.end(), all.begin() + offsets[patch]);
    }
    for (std::size_t f = 0; f < free.size(); ++f) free[f] = all[static_cast<std::size_t>(map.home[f])];
  }
  // By the free points, so that seams stay smooth.
  map.T.multiply<Vec3>(free, all);
  return all;
}

std::vector<Vec3> noiseOf(const Cloth& cloth, const Surface& surface, int first, int end, const NoiseCase& noise) {
  const std::vector<Vec3>& rest = cloth.rest();
  std::vector<Vec3> along(static_cast<std::size_t>(end - first));
  for (const std::array<int, 3>& t : surface.triangles) {
    std::array<int, 3> point;
    for (int k = 0; k < 3; ++k) point[k] = surface.W.columns[surface.W.offsets[t[k]]];
    if (point[0] < first || point[0] >= end) continue;
    const Vec3 area = cross(rest[point[1]] - rest[point[0]], rest[point[2]] - rest[point[0]]);
    for (const int p : point) along[p - first] += area;
  }
  std::mt19937_64 random(static_cast<std::uint64_t>(noise.seed));
  for (Vec3& d : along) {
    const double size = noise.amplitude_m * even(random);
    d = norm(d) > 0 ? size * normalized(d) : Vec3{};
  }
  return along;
}

namespace schema {

Object noiseTable() {
  using N = NoiseCase;
  return Table<N>("Noise")
      .number("amplitude", &N::amplitude_m, "m", aboveTo(0, 1e9), "largest displacement along the normal")
      .required()
      .integer("seed", &N::seed, 0, 1000000000, "another seed gives other noise, the same on every machine")
      .integer("from", &N::from, 0, 1000,
               "lowest number of waves over the sheet; 0: no waves, each control point moves by itself")
      .integer("to", &N::to, 0, 1000, "highest number of waves")
      .choice("along", &N::along_v, std::vector<std::pair<std::string, bool>>{{"u", false}, {"v", true}},
              "the direction of the waves")
      .check([](const Entry& p, const N& n) {
        if (n.to < n.from) p.failAt("to", fmt::format("{} is out of range; allowed: >= from = {}", n.to, n.from));
        if (n.from == 0 && n.to > 0) p.failAt("from", "is required with \"to\": the lowest number of waves, >= 1");
      })
      .build();
}

}  // namespace schema
}  // namespace gambeson
