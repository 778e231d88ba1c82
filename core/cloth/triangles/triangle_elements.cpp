#include "core/cloth/triangles/triangle_elements.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/cloth/triangles/hinge_angle.hpp"
#include "core/error.hpp"
#include "core/material/bending.hpp"
#include "core/material/jamming.hpp"
#include "core/material/tension_field.hpp"

namespace gambeson {
namespace {

constexpr int kMany = 256;  ///< elements, from which on threads share the work

PointLaw lawOf(const Fabric& fabric) {
  checkFabric(fabric);
  PointLaw law = pointLaw(fabric);
  const Section& s = law.section;
  for (int i = 0; i < 6; ++i)
    if (std::abs(s.B[static_cast<std::size_t>(i)]) > 1e-12 * std::sqrt(s.A[0] * s.D[0]))
      throw InputError(
          {"", 0, "fabric.plies"},
          "couple membrane and bending, which triangles cannot carry; allowed: plies that are symmetric about "
          "the middle, or \"model\": \"nurbs\"");
  return law;
}

/// What the terms leave of a law.
PointLaw withTerms(PointLaw law, const ForceTerms& terms) {
  if (!terms.membrane) law.section.A = {}, law.tension = law.jam_N_per_m = law.jam_s = 0;
  if (terms.steepest) {
    law.tension = 0;
    if (law.kappa0 > 0) {
      law.section.D[0] = zhengSteepest(law.section.D[0], law.kappa0, law.kappa_regular);
      law.section.D[1] = zhengSteepest(law.section.D[1], law.kappa0, law.kappa_regular);
      law.kappa0 = law.kappa_regular = 0;
    }
  }
  if (!terms.bending) law.section.D = {}, law.kappa0 = 0;
  return law;
}

Vec3 times(const Voigt& S, const Vec3& x) {
  return {S[0] * x.x + S[3] * x.y + S[4] * x.z, S[3] * x.x + S[1] * x.y + S[5] * x.z,
          S[4] * x.x + S[5] * x.y + S[2] * x.z};
}

/// n of the membrane, its energy per area and, where not null, dn/de in the order of Voigt.
Vec3 membraneLaw(const PointLaw& law, const Vec3& e, double* energy, Voigt* slope) {
  Vec3 n;
  if (law.tension != 0) {
    const double strain[3] = {e.x, e.y, e.z};
    const TensionField field = tensionField(law.section.A.data(), strain);
    n = {field.n[0], field.n[1], field.n[2]};
    if (energy) *energy = field.energy;
    if (slope)
      for (std::size_t i = 0; i < 6; ++i) (*slope)[i] = field.slope[i];
  } else {
    n = times(law.section.A, e);
    if (energy) *energy = 0.5 * dot(n, e);
    if (slope) *slope = law.section.A;
  }
  const double a = 1 + 2 * e.x, b = 1 + 2 * e.y, s = std::max(jam_least_s, a * b - e.z * e.z);
  if (!(s < law.jam_s)) return n;
  const double ratio = law.jam_s / s, r = ratio - 1, push = -0.25 * law.jam_N_per_m * r * ratio / s;
  const Vec3 grad{2 * b, 2 * a, -2 * e.z};
  n += push * grad;
  if (energy) *energy += 0.125 * law.jam_N_per_m * r * r;
  if (slope) {
    const double steep = 0.25 * law.jam_N_per_m * ratio / (s * s) * (ratio + 2 * r);
    constexpr int row[6] = {0, 1, 2, 0, 0, 1}, column[6] = {0, 1, 2, 1, 2, 2};
    for (std::size_t i = 0; i < 6; ++i) (*slope)[i] += steep * grad[row[i]] * grad[column[i]];
    (*slope)[3] += 4 * push;
    (*slope)[2] -= 2 * push;
  }
  return n;
}

/// dW/dkappa of W(kappa d), W and, where not null, the slope.
double bendingLaw(const PointLaw& law, double kappa, const Vec3& d, double* energy, double* slope) {
  const Vec3 k = kappa * d;
  if (law.kappa0 == 0) {
    const double B = dot(d, times(law.section.D, d));
    if (energy) *energy = 0.5 * B * kappa * kappa;
    if (slope) *slope = B;
    return B * kappa;
  }
  const double b1 = law.section.D[0], b2 = law.section.D[1], twist = law.section.D[2], k0 = law.kappa0,
               kr = law.kappa_regular;
  if (energy) *energy = zhengEnergy(k.x, b1, k0, kr) + zhengEnergy(k.y, b2, k0, kr) + 0.5 * twist * k.z * k.z;
  if (slope)
    *slope = zhengSlope(k.x, b1, k0, kr) * d.x * d.x + zhengSlope(k.y, b2, k0, kr) * d.y * d.y + twist * d.z * d.z;
  return zhengMoment(k.x, b1, k0, kr) * d.x + zhengMoment(k.y, b2, k0, kr) * d.y + twist * k.z * d.z;
}

HingePoints cornersOf(const FoldHinge& h, std::span<const Vec3> q) {
  return {q[h.corner[0]], q[h.corner[1]], q[h.corner[2]], q[h.corner[3]]};
}

void addOuter(std::array<double, 9>& m, double scale, const Vec3& a, const Vec3& b) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m[static_cast<std::size_t>(3 * i + j)] += scale * a[i] * b[j];
}

void writeSlot(double* slot, const Vec3& f) { slot[0] = f.x, slot[1] = f.y, slot[2] = f.z; }

}  // namespace

TriangleElements::TriangleElements(int points, std::vector<MembraneTriangle> triangles, std::vector<FoldHinge> hinges,
                                   std::span<const Fabric> fabrics)
    : triangles_(std::move(triangles)), hinges_(std::move(hinges)), gather_(points) {
  for (const Fabric& f : fabrics) laws_.push_back(lawOf(f));
  for (const MembraneTriangle& t : triangles_)
    for (int corner : t.corner) {
      gather_.add(corner, slot_count_, 1);
      slot_count_ += 3;
    }
  hinge_slot_ = slot_count_;
  for (const FoldHinge& h : hinges_)
    for (int corner : h.corner) {
      gather_.add(corner, slot_count_, 1);
      slot_count_ += 3;
    }
  gather_.close();
  hinges_of_.assign(triangles_.size(), {-1, -1, -1});
  for (std::size_t k = 0; k < hinges_.size(); ++k)
    for (const int t : hinges_[k].triangle)
      *std::find(hinges_of_[static_cast<std::size_t>(t)].begin(), hinges_of_[static_cast<std::size_t>(t)].end(), -1) =
          static_cast<int>(k);
}

Vec3 TriangleElements::strain(int triangle, std::span<const Vec3> q, Vec3* weft, Vec3* warp) const {
  const MembraneTriangle& t = triangles_[static_cast<std::size_t>(triangle)];
  const Vec3 e1 = q[t.corner[1]] - q[t.corner[0]], e2 = q[t.corner[2]] - q[t.corner[0]];
  const Vec3 f1 = t.g[0].x * e1 + t.g[1].x * e2, f2 = t.g[0].y * e1 + t.g[1].y * e2;
  if (weft) *weft = f1;
  if (warp) *warp = f2;
  return {0.5 * (norm2(f1) - 1), 0.5 * (norm2(f2) - 1), dot(f1, f2)};
}

double TriangleElements::curvature(int hinge, std::span<const Vec3> q) const {
  const FoldHinge& h = hinges_[static_cast<std::size_t>(hinge)];
  return h.per_angle * (foldAngle(cornersOf(h, q), nullptr) - h.theta0);
}

Vec3 TriangleElements::curvatureOf(int triangle, std::span<const Vec3> q, bool rest) const {
  Vec3 sum{};
  for (const int k : hinges_of_[static_cast<std::size_t>(triangle)]) {
    if (k < 0) continue;
    const FoldHinge& h = hinges_[static_cast<std::size_t>(k)];
    const double length = h.per_angle * h.area_m2;
    sum += (0.5 * length * (curvature(k, q) / h.per_angle + (rest ? h.theta0 : 0))) * h.d;
  }
  return sum / triangles_[static_cast<std::size_t>(triangle)].area_m2;
}

PointState TriangleElements::stateOf(int triangle, std::span<const Vec3> q) const {
  PointState s{strain(triangle, q), curvatureOf(triangle, q, false), {}, {}};
  const double e[3] = {s.strain.x, s.strain.y, s.strain.z},
               k[3] = {s.curvature_change.x, s.curvature_change.y, s.curvature_change.z};
  const PointResultants r = resultants(law(triangles_[static_cast<std::size_t>(triangle)].law), e, k);
  s.n = {r.n[0], r.n[1], r.n[2]};
  s.m = {r.m[0], r.m[1], r.m[2]};
  return s;
}

void TriangleElements::force(std::span<const Vec3> q, const ClothForce& out, ClothWork& work,
                             const ForceTerms& terms) const {
  work.slots.resize(static_cast<std::size_t>(slot_count_));
  std::vector<PointLaw> laws;
  for (const PointLaw& law : laws_) laws.push_back(withTerms(law, terms));
  const int triangles = static_cast<int>(triangles_.size()), hinges = static_cast<int>(hinges_.size());
  work.lane_energy.assign(out.energy ? static_cast<std::size_t>(triangles + hinges) : 0, 0.0);
  double* const energies = out.energy ? work.lane_energy.data() : nullptr;
#pragma omp parallel for schedule(static) if (triangles > kMany)
  for (int k = 0; k < triangles; ++k) {
    const MembraneTriangle& t = triangles_[static_cast<std::size_t>(k)];
    Vec3 f1, f2;
    const Vec3 e = strain(k, q, &f1, &f2);
    double w = 0;
    const Vec3 n = membraneLaw(laws[static_cast<std::size_t>(t.law)], e, energies ? &w : nullptr, nullptr);
    const Vec3 p1 = t.area_m2 * (n.x * f1 + n.z * f2), p2 = t.area_m2 * (n.z * f1 + n.y * f2);
    const Vec3 g1 = t.g[0].x * p1 + t.g[0].y * p2, g2 = t.g[1].x * p1 + t.g[1].y * p2;
    double* slot = work.slots.data() + 9L * k;
    writeSlot(slot, -(g1 + g2));
    writeSlot(slot + 3, g1);
    writeSlot(slot + 6, g2);
    if (energies) energies[k] = t.area_m2 * w;
  }
#pragma omp parallel for schedule(static) if (hinges > kMany)
  for (int k = 0; k < hinges; ++k) {
    const FoldHinge& h = hinges_[static_cast<std::size_t>(k)];
    double* slot = work.slots.data() + hinge_slot_ + 12L * k;
    if (!(terms.bending && (terms.seams || !h.seam))) {
      std::fill(slot, slot + 12, 0.0);
      continue;
    }
    HingePoints gradient;
    const double kappa = h.per_angle * (foldAngle(cornersOf(h, q), &gradient) - h.theta0);
    double w = 0;
    const double moment =
        bendingLaw(laws[static_cast<std::size_t>(h.law)], kappa, h.d, energies ? &w : nullptr, nullptr);
    for (std::size_t c = 0; c < 4; ++c)
      writeSlot(slot + 3 * static_cast<long>(c), (h.area_m2 * h.per_angle * moment) * gradient[c]);
    if (energies) energies[triangles + k] = h.area_m2 * w;
  }
  gather_.negativeSum(work.slots.data(), out.points);
  if (!out.energy) return;
  *out.energy = {};
  for (double e : work.lane_energy) out.energy->stored += e;
}

void TriangleElements::membraneStiffness(int triangle, std::span<const Vec3> q, const ForceTerms& terms,
                                         std::vector<std::array<double, 9>>& blocks) const {
  const MembraneTriangle& t = triangles_[static_cast<std::size_t>(triangle)];
  Vec3 f[2];
  const Vec3 e = strain(triangle, q, &f[0], &f[1]);
  Voigt C;
  const Vec3 n = membraneLaw(withTerms(law(t.law), terms), e, nullptr, &C);
  const Vec2 g[3] = {{-t.g[0].x - t.g[1].x, -t.g[0].y - t.g[1].y}, t.g[0], t.g[1]};
  // dE/dq_I = (g.x f1, g.y f2, g.y f1 + g.x f2).
  Vec3 b[3][3];
  for (int I = 0; I < 3; ++I) b[I][0] = g[I].x * f[0], b[I][1] = g[I].y * f[1], b[I][2] = g[I].y * f[0] + g[I].x * f[1];
  blocks.assign(9, {});
  constexpr int at[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
  for (int I = 0; I < 3; ++I)
    for (int J = 0; J < 3; ++J) {
      std::array<double, 9>& m = blocks[static_cast<std::size_t>(3 * I + J)];
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) addOuter(m, t.area_m2 * C[static_cast<std::size_t>(at[r][c])], b[I][r], b[J][c]);
      const double geometric =
          t.area_m2 * (n.x * g[I].x * g[J].x + n.y * g[I].y * g[J].y + n.z * (g[I].x * g[J].y + g[I].y * g[J].x));
      for (std::size_t d = 0; d < 3; ++d) m[4 * d] += geometric;
    }
}

void TriangleElements::hingeStiffness(int hinge, std::span<const Vec3> q, const ForceTerms& terms,
                                      std::vector<std::array<double, 9>>& blocks) const {
  const FoldHinge& h = hinges_[static_cast<std::size_t>(hinge)];
  blocks.assign(16, {});
  if (!(terms.bending && (terms.seams || !h.seam))) return;
  const HingePoints x = cornersOf(h, q);
  HingePoints gradient;
  const double kappa = h.per_angle * (foldAngle(x, &gradient) - h.theta0);
  double slope = 0;
  const double moment = bendingLaw(withTerms(law(h.law), terms), kappa, h.d, nullptr, &slope);
  std::array<std::array<double, 9>, 16> second;
  foldAngleHessian(x, second);
  for (std::size_t I = 0; I < 4; ++I)
    for (std::size_t J = 0; J < 4; ++J) {
      std::array<double, 9>& m = blocks[4 * I + J];
      for (std::size_t k = 0; k < 9; ++k) m[k] = h.area_m2 * h.per_angle * moment * second[4 * I + J][k];
      addOuter(m, h.area_m2 * h.per_angle * h.per_angle * slope, gradient[I], gradient[J]);
    }
}

}  // namespace gambeson
