#include "core/cloth/degenerated/shell_cell.hpp"

#include <algorithm>
#include <cmath>

#include "core/cloth/degenerated/shell_resultants.hpp"
#include "core/cloth/patches/rest_frame.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

/// What takes covariant strains (11, 22, 12) to (E11, E22, 2 E12) of the frame G = d(xi)/dX.
std::array<double, 9> toPhysical(const RestFrame& G) {
  return {G.G11 * G.G11,     G.G21 * G.G21,     2 * G.G11 * G.G21,
          G.G12 * G.G12,     G.G22 * G.G22,     2 * G.G12 * G.G22,
          2 * G.G11 * G.G12, 2 * G.G21 * G.G22, 2 * (G.G11 * G.G22 + G.G21 * G.G12)};
}

constexpr std::array<double, 4> kXi{-1, 1, -1, 1}, kEta{-1, -1, 1, 1};

}  // namespace

CornerBasis cornerBasis(Natural at) {
  CornerBasis b;
  for (std::size_t k = 0; k < 4; ++k) {
    b.n[k] = 0.25 * (1 + kXi[k] * at.xi) * (1 + kEta[k] * at.eta);
    b.n1[k] = 0.25 * kXi[k] * (1 + kEta[k] * at.eta);
    b.n2[k] = 0.25 * kEta[k] * (1 + kXi[k] * at.xi);
  }
  return b;
}

CornerShares squaredShares(const CornerVectors& rest) {
  CornerShares shares;
  double sum = 0;
  for (const RulePoint& p : tableOf(ShellRule::full).points) {
    const CornerBasis b = cornerBasis(p.at);
    Vec3 a1, a2;
    for (std::size_t k = 0; k < 4; ++k) a1 += b.n1[k] * rest[k], a2 += b.n2[k] * rest[k];
    const double area = norm(cross(a1, a2)) * p.weight;
    shares.area_m2 += area;
    for (std::size_t k = 0; k < 4; ++k) {
      shares.share[k] += area * b.n[k] * b.n[k];
      sum += area * b.n[k] * b.n[k];
    }
  }
  for (double& s : shares.share) s /= sum;
  return shares;
}

ShellKernel::Station ShellKernel::stationAt(const CornerBasis& basis, const CornerVectors& x) {
  Station s;
  for (std::size_t k = 0; k < 4; ++k) {
    s.a1 += basis.n1[k] * x[k];
    s.a2 += basis.n2[k] * x[k];
    s.b1 += basis.n1[k] * x[4 + k];
    s.b2 += basis.n2[k] * x[4 + k];
    s.d += basis.n[k] * x[4 + k];
  }
  return s;
}

ShellKernel::ShellKernel(ShellRule rule) : table_(tableOf(rule)) {
  for (const RulePoint& p : table_.points) {
    points_.push_back(cornerBasis(p.at));
    plane_points_ += p.plane ? 1 : 0;
  }
  for (const Natural& s : table_.stations) stations_.push_back(cornerBasis(s));
}

void ShellKernel::addPlane(const Station& s, double z2, Covariant& c) {
  c[0] += 0.5 * (norm2(s.a1) + z2 * norm2(s.b1));
  c[1] += 0.5 * (norm2(s.a2) + z2 * norm2(s.b2));
  c[2] += 0.5 * (dot(s.a1, s.a2) + z2 * dot(s.b1, s.b2));
  c[3] += dot(s.a1, s.b1);
  c[4] += dot(s.a2, s.b2);
  c[5] += 0.5 * (dot(s.a1, s.b2) + dot(s.a2, s.b1));
}

Covariant ShellKernel::covariant(const CornerVectors& x, double z2, std::size_t point) const {
  Covariant c{};
  addPlane(stationAt(points_[point], x), z2, c);
  const RulePoint& rule = table_.points[point];
  for (std::size_t k = 0; rule.shear && k < stations_.size(); ++k) {
    const Station s = stationAt(stations_[k], x);
    c[6] += rule.on13[k] * 0.5 * dot(s.a1, s.d);
    c[7] += rule.on23[k] * 0.5 * dot(s.a2, s.d);
  }
  return c;
}

void ShellKernel::setRest(const CornerVectors& rest, const Vec3& weft, double angle_rad, ShellCell& cell) const {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Station s = stationAt(points_[i], rest);
    const RestFrame G = restFrame(s.a1, s.a2, weft, angle_rad);
    ShellPoint& p = cell.points[i];
    p.area_m2 = G.area * table_.points[i].weight;
    p.T = toPhysical(G);
    // The normal as a sum of the covariant base vectors a1, a2, d: those of the contravariant ones along it.
    const Vec3 normal = cross(s.a1, s.a2) / G.area;
    const double along = dot(s.d, normal);
    if (!(along > 0.1)) throw InputError({"", 0, "patches"}, "a director lies in the rest surface");
    const Vec3 tilt = (normal - s.d / along);
    const Vec3 up1 = cross(s.a2, normal) / G.area, up2 = cross(normal, s.a1) / G.area;
    const double beta1 = dot(tilt, up1), beta2 = dot(tilt, up2), beta3 = 1 / along;
    p.slant = {2 * G.G11 * beta1, 2 * G.G21 * beta2, 2 * (G.G11 * beta2 + G.G21 * beta1),
               2 * G.G12 * beta1, 2 * G.G22 * beta2, 2 * (G.G12 * beta2 + G.G22 * beta1)};
    p.across = {2 * G.G11 * beta3, 2 * G.G21 * beta3, 2 * G.G12 * beta3, 2 * G.G22 * beta3};
    p.rest = covariant(rest, cell.law.z2_m2, i);
    if (cell.law.from_flat) std::fill(p.rest.begin() + 3, p.rest.begin() + 6, 0.0);
  }
}

ClothEnergy ShellKernel::gradient(const ShellCell& cell, const CornerVectors& now, const CellMemory& memory,
                                  const ForceTerms& terms, CornerVectors& gradient) const {
  const double z2 = cell.law.z2_m2;
  std::array<Station, 4> stations;
  std::array<double, 4> e13{}, e23{}, s13{}, s23{};
  for (std::size_t k = 0; k < stations_.size(); ++k) {
    stations[k] = stationAt(stations_[k], now);
    e13[k] = 0.5 * dot(stations[k].a1, stations[k].d);
    e23[k] = 0.5 * dot(stations[k].a2, stations[k].d);
  }
  ClothEnergy energy;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const RulePoint& rule = table_.points[i];
    const ShellPoint& p = cell.points[i];
    const Station s = stationAt(points_[i], now);
    Covariant c{};
    addPlane(s, z2, c);
    for (std::size_t k = 0; rule.shear && k < stations_.size(); ++k) {
      c[6] += rule.on13[k] * e13[k];
      c[7] += rule.on23[k] * e23[k];
    }
    for (std::size_t r = 0; r < 8; ++r) c[r] -= p.rest[r];
    const Resultants answer(cell.law, p, c, rule, terms, memory.of(cell.law, i));
    energy.stored += p.area_m2 * answer.stored();
    energy.lost += p.area_m2 * answer.in_plane.lost;
    Covariant f = answer.conjugate(p);
    for (double& v : f) v *= p.area_m2;
    const Vec3 a1 = f[0] * s.a1 + 0.5 * f[2] * s.a2 + f[3] * s.b1 + 0.5 * f[5] * s.b2,
               a2 = f[1] * s.a2 + 0.5 * f[2] * s.a1 + f[4] * s.b2 + 0.5 * f[5] * s.b1,
               b1 = z2 * (f[0] * s.b1 + 0.5 * f[2] * s.b2) + f[3] * s.a1 + 0.5 * f[5] * s.a2,
               b2 = z2 * (f[1] * s.b2 + 0.5 * f[2] * s.b1) + f[4] * s.a2 + 0.5 * f[5] * s.a1;
    for (std::size_t k = 0; k < 4; ++k) {
      gradient[k] += points_[i].n1[k] * a1 + points_[i].n2[k] * a2;
      gradient[4 + k] += points_[i].n1[k] * b1 + points_[i].n2[k] * b2;
    }
    for (std::size_t k = 0; rule.shear && k < stations_.size(); ++k) {
      s13[k] += rule.on13[k] * f[6];
      s23[k] += rule.on23[k] * f[7];
    }
  }
  for (std::size_t k = 0; k < stations_.size(); ++k) {
    const Vec3 a1 = 0.5 * s13[k] * stations[k].d, a2 = 0.5 * s23[k] * stations[k].d,
               d = 0.5 * (s13[k] * stations[k].a1 + s23[k] * stations[k].a2);
    for (std::size_t j = 0; j < 4; ++j) {
      gradient[j] += stations_[k].n1[j] * a1 + stations_[k].n2[j] * a2;
      gradient[4 + j] += stations_[k].n[j] * d;
    }
  }
  return energy;
}

void ShellKernel::stiffness(const ShellCell& cell, const CornerVectors& now, const CellMemory& memory,
                            const ForceTerms& terms, CellStiffness& K, CornerVectors& gradient) const {
  const double z2 = cell.law.z2_m2;
  std::array<std::array<double, 8>, 8> turning{};  // of the stress, by nodes: times the identity
  const auto addTurning = [&](std::size_t k, std::size_t l, double v) { turning[k][l] += v; };
  K.fill(0);
  gradient.fill({});
  const CellMemory committed{memory.committed, nullptr, memory.elapsed_s};
  this->gradient(cell, now, committed, terms, gradient);
  std::array<double, 4> s13{}, s23{};
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const RulePoint& rule = table_.points[i];
    const ShellPoint& p = cell.points[i];
    const CornerBasis& N = points_[i];
    const Station s = stationAt(N, now);
    // Rows: the derivative of each covariant strain by the nodes' components.
    std::array<std::array<double, 24>, 8> rows{}, stressed{};
    const auto addTo = [&rows](std::size_t row, std::size_t node, double w, const Vec3& v) {
      rows[row][3 * node] += w * v.x, rows[row][3 * node + 1] += w * v.y, rows[row][3 * node + 2] += w * v.z;
    };
    for (std::size_t k = 0; k < 4; ++k) {
      const double n1 = N.n1[k], n2 = N.n2[k];
      addTo(0, k, n1, s.a1), addTo(0, 4 + k, z2 * n1, s.b1);
      addTo(1, k, n2, s.a2), addTo(1, 4 + k, z2 * n2, s.b2);
      addTo(2, k, 0.5, n1 * s.a2 + n2 * s.a1), addTo(2, 4 + k, 0.5 * z2, n1 * s.b2 + n2 * s.b1);
      addTo(3, k, n1, s.b1), addTo(3, 4 + k, n1, s.a1);
      addTo(4, k, n2, s.b2), addTo(4, 4 + k, n2, s.a2);
      addTo(5, k, 0.5, n1 * s.b2 + n2 * s.b1), addTo(5, 4 + k, 0.5, n1 * s.a2 + n2 * s.a1);
    }
    for (std::size_t st = 0; rule.shear && st < stations_.size(); ++st) {
      const Station t = stationAt(stations_[st], now);
      for (std::size_t k = 0; k < 4; ++k) {
        addTo(6, k, 0.5 * rule.on13[st] * stations_[st].n1[k], t.d);
        addTo(6, 4 + k, 0.5 * rule.on13[st] * stations_[st].n[k], t.a1);
        addTo(7, k, 0.5 * rule.on23[st] * stations_[st].n2[k], t.d);
        addTo(7, 4 + k, 0.5 * rule.on23[st] * stations_[st].n[k], t.a2);
      }
    }
    Covariant c = covariant(now, z2, i);
    for (std::size_t r = 0; r < 8; ++r) c[r] -= p.rest[r];
    ShellLaw slopes;
    if (!cell.law.isLinear()) slopes = linearAt(cell.law, p, c, terms, committed.of(cell.law, i));
    const ShellLaw& tangent = cell.law.isLinear() ? cell.law : slopes;
    for (std::size_t k = 0; k < 8; ++k) {
      Covariant one{};
      one[k] = p.area_m2;
      const Covariant answer = Resultants(tangent, p, one, rule, terms).conjugate(p);
      for (std::size_t r = 0; r < 8; ++r)
        for (std::size_t j = 0; answer[r] != 0 && j < 24; ++j) stressed[r][j] += answer[r] * rows[k][j];
    }
    for (std::size_t i1 = 0; i1 < 24; ++i1)
      for (std::size_t r = 0; r < 8; ++r) {
        const double row = rows[r][i1];
        for (std::size_t j = 0; j < 24; ++j) K[24 * i1 + j] += row * stressed[r][j];
      }
    if (terms.definite) continue;
    Covariant f = Resultants(cell.law, p, c, rule, terms, committed.of(cell.law, i)).conjugate(p);
    for (double& v : f) v *= p.area_m2;
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t l = 0; l < 4; ++l) {
        const double n11 = N.n1[k] * N.n1[l], n22 = N.n2[k] * N.n2[l],
                     n12 = 0.5 * (N.n1[k] * N.n2[l] + N.n2[k] * N.n1[l]);
        const double of_n = f[0] * n11 + f[1] * n22 + f[2] * n12, of_m = f[3] * n11 + f[4] * n22 + f[5] * n12;
        addTurning(k, l, of_n);
        addTurning(4 + k, 4 + l, z2 * of_n);
        addTurning(k, 4 + l, of_m);
        addTurning(4 + l, k, of_m);
      }
    for (std::size_t st = 0; rule.shear && st < stations_.size(); ++st) {
      s13[st] += rule.on13[st] * f[6];
      s23[st] += rule.on23[st] * f[7];
    }
  }
  for (std::size_t st = 0; st < stations_.size(); ++st)
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t l = 0; l < 4; ++l) {
        const double of_shear =
            0.5 * (s13[st] * stations_[st].n1[k] + s23[st] * stations_[st].n2[k]) * stations_[st].n[l];
        addTurning(k, 4 + l, of_shear);
        addTurning(4 + l, k, of_shear);
      }
  for (std::size_t k = 0; k < 8; ++k)
    for (std::size_t l = 0; l < 8; ++l)
      for (std::size_t a = 0; a < 3; ++a) K[(3 * k + a) * 24 + 3 * l + a] += turning[k][l];
}

PointState ShellKernel::at(const ShellCell& cell, const CornerVectors& rest, const CornerVectors& now,
                           const CellMemory& memory, const Vec3& weft, double angle_rad, Natural place,
                           bool total) const {
  const CornerBasis basis = cornerBasis(place);
  const Station before = stationAt(basis, rest);
  ShellPoint p;
  p.T = toPhysical(restFrame(before.a1, before.a2, weft, angle_rad));
  Covariant c{}, start{};
  addPlane(stationAt(basis, now), cell.law.z2_m2, c);
  addPlane(before, cell.law.z2_m2, start);
  for (std::size_t r = 0; r < 6; ++r)
    if (r < 3 || !(total || cell.law.from_flat)) c[r] -= start[r];
  const auto off2 = [&](std::size_t i) {
    const Natural& at = table_.points[i].at;
    return (at.xi - place.xi) * (at.xi - place.xi) + (at.eta - place.eta) * (at.eta - place.eta);
  };
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < plane_points_; ++i)
    if (off2(i) < off2(nearest)) nearest = i;
  const CellMemory committed{memory.committed, nullptr, memory.elapsed_s};
  const Resultants answer(cell.law, p, c, {place, 1, true, false, {}, {}}, {}, committed.of(cell.law, nearest));
  return {answer.strain, answer.curvature, answer.n, answer.m};
}

}  // namespace gambeson
