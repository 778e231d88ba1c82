#include "core/sheet/shell.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "core/error.hpp"
#include "core/material/bending.hpp"
#include "core/math/quadrature.hpp"

namespace gambeson {
namespace {

/// G = d(xi)/dX: columns are the physical directions weft and warp (orthonormal, tangent to the rest surface).
struct RestFrame {
  double G11, G12, G21, G22, area;  ///< area: |A1 x A2|
};

RestFrame restFrame(const Vec3& A1, const Vec3& A2, const Vec3& weft) {
  const Vec3 normal = cross(A1, A2);
  const double area = norm(normal);
  if (!(area > 0)) throw InputError({"", 0, "patch"}, "the rest surface is degenerate (zero area)");
  const Vec3 n = normal / area;
  const Vec3 in_plane = weft - dot(weft, n) * n;
  if (!(norm(in_plane) > 1e-6 * norm(weft)))
    throw InputError({"", 0, "weft"}, "the weft direction is normal to the rest surface");
  const Vec3 E1 = normalized(in_plane), E2 = cross(n, E1);
  const double J11 = dot(E1, A1), J12 = dot(E1, A2), J21 = dot(E2, A1), J22 = dot(E2, A2);
  const double det = J11 * J22 - J12 * J21;
  return {J22 / det, -J12 / det, -J21 / det, J11 / det, area};
}

Vec3 curvature(const RestFrame& G, const Vec3& a1, const Vec3& a2, const Vec3& x11, const Vec3& x22, const Vec3& x12) {
  const Vec3 n = normalized(cross(a1, a2));
  const double b11 = dot(n, x11), b22 = dot(n, x22), b12 = dot(n, x12);
  return {G.G11 * G.G11 * b11 + 2 * G.G11 * G.G21 * b12 + G.G21 * G.G21 * b22,
          G.G12 * G.G12 * b11 + 2 * G.G12 * G.G22 * b12 + G.G22 * G.G22 * b22,
          G.G11 * G.G12 * b11 + (G.G11 * G.G22 + G.G21 * G.G12) * b12 + G.G21 * G.G22 * b22};
}

bool isRational(const NurbsPatch& p) {
  return std::any_of(p.weights.begin(), p.weights.end(), [&](double w) { return w != p.weights.front(); });
}

struct Cell {
  int patch, su, sv;  ///< spans
  double u0, u1, v0, v1;
};

std::vector<Cell> cellsOf(const NurbsPatch& patch, int index) {
  std::vector<Cell> cells;
  const auto us = breakpoints(patch.u), vs = breakpoints(patch.v);
  for (std::size_t j = 0; j + 1 < vs.size(); ++j)
    for (std::size_t i = 0; i + 1 < us.size(); ++i)
      cells.push_back({index, findSpan(patch.u, 0.5 * (us[i] + us[i + 1])),
                       findSpan(patch.v, 0.5 * (vs[j] + vs[j + 1])), us[i], us[i + 1], vs[j], vs[j + 1]});
  return cells;
}

/// Fills lane `lane` of group `group`; `real` is false for the copies that fill a last group up (their area is zero).
void packCell(const Garment& garment, const std::vector<int>& offsets, const Cell& cell, bool real, ShellBlock& b,
              int group, int lane) {
  const NurbsPatch& patch = garment.patches[cell.patch];
  const int nu = b.p + 1, nv = b.q + 1, nn = nu * nv, L = b.lanes;
  std::vector<double> w(nn);
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i) {
      const int local = patch.index(cell.su - b.p + i, cell.sv - b.q + j), k = i + nu * j;
      b.nodes[(static_cast<long>(group) * nn + k) * L + lane] = offsets[cell.patch] + local;
      w[k] = patch.weights[local];
      if (b.rational) b.weights[(static_cast<long>(group) * nn + k) * L + lane] = w[k];
    }
  const Quadrature ru = gaussLegendre(b.gu), rv = gaussLegendre(b.gv);
  std::vector<double> bu(3 * nu), bv(3 * nv);
  for (int gv = 0; gv < b.gv; ++gv) {
    const double v = cell.v0 + rv.points[gv] * (cell.v1 - cell.v0);
    basisDerivatives(patch.v, cell.sv, v, 2, bv);
    for (int k = 0; k < 3 * nv; ++k)
      b.basis_v[((static_cast<long>(group) * b.gv + gv) * 3 * nv + k) * L + lane] = bv[k];
    for (int gu = 0; gu < b.gu; ++gu) {
      const double u = cell.u0 + ru.points[gu] * (cell.u1 - cell.u0);
      basisDerivatives(patch.u, cell.su, u, 2, bu);
      for (int k = 0; k < 3 * nu; ++k)
        b.basis_u[((static_cast<long>(group) * b.gu + gu) * 3 * nu + k) * L + lane] = bu[k];
      const auto d = surfaceDerivatives(patch, u, v);
      const RestFrame G = restFrame(d[1], d[2], garment.weft[cell.patch]);
      const double dA =
          real ? G.area * (cell.u1 - cell.u0) * (cell.v1 - cell.v0) * ru.weights[gu] * rv.weights[gv] : 0.0;
      std::vector<double> data{G.G11, G.G12, G.G21, G.G22, dA};
      if (b.rational) {
        std::array<double, 6> W{};  // the denominator and its derivatives: w, 1, 2, 11, 22, 12
        const int du[6] = {0, 1, 0, 2, 0, 1}, dv[6] = {0, 0, 1, 0, 2, 1};
        for (int m = 0; m < 6; ++m)
          for (int j = 0; j < nv; ++j)
            for (int i = 0; i < nu; ++i) W[m] += bu[du[m] * nu + i] * bv[dv[m] * nv + j] * w[i + nu * j];
        data.insert(data.end(), W.begin(), W.end());
      }
      if (b.rest_curvature) {
        const Vec3 k0 = curvature(G, d[1], d[2], d[3], d[4], d[5]);
        data.insert(data.end(), {k0.x, k0.y, k0.z});
      }
      const long at = ((static_cast<long>(group) * b.gv + gv) * b.gu + gu) * b.pointDoubles();
      for (std::size_t k = 0; k < data.size(); ++k) b.points[(at + static_cast<long>(k)) * L + lane] = data[k];
    }
  }
}

/// What the laws need to be laws at all: a positive definite membrane and an eq. 2.14 with a finite slope. NaN fails.
void checkFabric(const Fabric& f) {
  const auto reject = [](const char* key, const char* reason) {
    throw InputError({"", 0, std::string("fabric.") + key}, reason);
  };
  if (!(f.thickness_m > 0)) reject("thickness_m", "must be > 0");
  if (!(f.young_weft_Pa > 0)) reject("young_weft_Pa", "must be > 0");
  if (!(f.young_warp_Pa > 0)) reject("young_warp_Pa", "must be > 0");
  if (!(f.shear_Pa > 0)) reject("shear_Pa", "must be > 0");
  if (!(f.poisson * f.poisson * f.young_warp_Pa < f.young_weft_Pa))
    reject("poisson", "must satisfy poisson^2 young_warp < young_weft");
  if (!(f.bending_weft_Nm >= 0)) reject("bending_weft_Nm", "must be >= 0");
  if (!(f.bending_warp_Nm >= 0)) reject("bending_warp_Nm", "must be >= 0");
  if (!(f.twist_Nm >= 0)) reject("twist_Nm", "must be >= 0");
  if (f.bending_law == BendingLaw::zheng && !(f.kappa_regular_per_m > 0 && f.kappa_regular_per_m <= f.kappa0_per_m))
    reject("kappa_regular_per_m", "must be > 0 and at most kappa0_per_m");
}

}  // namespace

ShellLaw shellLaw(const Fabric& f) {
  const double nu21 = f.poisson * f.young_warp_Pa / f.young_weft_Pa, h = f.thickness_m;
  const double scale = h / (1 - f.poisson * nu21);
  ShellLaw law;
  law.d1 = f.young_weft_Pa * scale;
  law.d2 = f.young_warp_Pa * scale;
  law.d3 = f.poisson * law.d2;
  law.d4 = f.shear_Pa * h;
  law.bending_weft = f.bending_weft_Nm;
  law.bending_warp = f.bending_warp_Nm;
  law.twist = f.twist_Nm;
  if (f.bending_law == BendingLaw::zheng) {
    law.kappa0 = f.kappa0_per_m;
    law.kappa_regular = f.kappa_regular_per_m;
  }
  return law;
}

Shell::Shell(const Garment& garment, const KernelSet& kernels, int gauss_extra, CellRule)
    : garment_(garment), kernels_(&kernels), offsets_(controlOffsets(garment)), control_count_(offsets_.back()) {
  checkFabric(garment.fabric);
  if (garment.weft.size() != garment.patches.size())
    throw InputError({"", 0, "weft"}, "one direction for each patch is needed");
  // Blocks: cells of the same degrees, rational or not.
  std::map<std::tuple<int, int, bool>, std::vector<Cell>> kinds;
  for (std::size_t p = 0; p < garment.patches.size(); ++p) {
    const NurbsPatch& patch = garment.patches[p];
    validate(patch);
    if (patch.u.degree < 1 || patch.u.degree > 5 || patch.v.degree < 1 || patch.v.degree > 5)
      throw InputError({"", 0, "degree"}, "degrees of a shell patch must be 1 to 5");
    auto& cells = kinds[{patch.u.degree, patch.v.degree, isRational(patch)}];
    const auto more = cellsOf(patch, static_cast<int>(p));
    cells.insert(cells.end(), more.begin(), more.end());
  }
  const int L = kernels.lanes;
  std::vector<std::vector<std::pair<long, int>>> gather(control_count_);
  for (const auto& [kind, cells] : kinds) {
    Part part;
    ShellBlock& b = part.block;
    std::tie(b.p, b.q, b.rational) = kind;
    b.gu = b.p + 1 + gauss_extra;
    b.gv = b.q + 1 + gauss_extra;
    b.lanes = L;
    b.groups = (static_cast<int>(cells.size()) + L - 1) / L;
    b.rest_curvature = garment.fabric.rest_curvature_of_shape;
    const int nn = b.nodeCount();
    b.nodes.resize(static_cast<long>(b.groups) * nn * L);
    if (b.rational) b.weights.resize(static_cast<long>(b.groups) * nn * L);
    b.basis_u.resize(static_cast<long>(b.groups) * b.gu * 3 * (b.p + 1) * L);
    b.basis_v.resize(static_cast<long>(b.groups) * b.gv * 3 * (b.q + 1) * L);
    b.points.resize(static_cast<long>(b.groups) * b.gu * b.gv * b.pointDoubles() * L);
    part.law = shellLaw(garment.fabric);
    part.first_slot = slot_count_;
    for (int g = 0; g < b.groups; ++g)
      for (int l = 0; l < L; ++l) {
        const std::size_t at = static_cast<std::size_t>(g) * L + l;
        packCell(garment, offsets_, cells[std::min(at, cells.size() - 1)], at < cells.size(), b, g, l);
        if (at >= cells.size()) continue;
        for (int k = 0; k < nn; ++k)
          gather[b.nodes[(static_cast<long>(g) * nn + k) * L + l]].push_back(
              {part.first_slot + (static_cast<long>(g) * nn + k) * 3 * L + l, L});
      }
    gauss_points_ += static_cast<long>(cells.size()) * b.gu * b.gv;
    slot_count_ += static_cast<long>(b.groups) * nn * 3 * L;
    parts_.push_back(std::move(part));
  }

  // Springs along seams; where the map T holds the tangents together the angle cannot change, and no spring is needed.
  const FreeMap map = buildFreeMap(garment);
  std::vector<Vec3> Q, gradient;
  for (const NurbsPatch& p : garment.patches) Q.insert(Q.end(), p.points.begin(), p.points.end());
  for (HingePoint& h : buildHinges(garment)) {
    hingeAngle(h, Q, &gradient);
    std::map<int, Vec3> pulled;
    double size = 0, left = 0;
    for (std::size_t k = 0; k < h.columns.size(); ++k) {
      size += norm(gradient[k]);
      for (int e = map.T.offsets[h.columns[k]]; e < map.T.offsets[h.columns[k] + 1]; ++e)
        pulled[map.T.columns[e]] += map.T.values[e] * gradient[k];
    }
    for (const auto& entry : pulled) left += norm(entry.second);
    if (left > 1e-9 * size) hinges_.push_back(std::move(h));
  }
  hinge_slot_ = slot_count_;
  for (const HingePoint& h : hinges_) {
    hinge_offset_.push_back((slot_count_ - hinge_slot_) / 3);
    for (std::size_t k = 0; k < h.columns.size(); ++k)
      gather[h.columns[k]].push_back({slot_count_ + 3 * static_cast<long>(k), 1});
    slot_count_ += 3 * static_cast<long>(h.columns.size());
  }
  gather_offsets_.push_back(0);
  for (const auto& list : gather) {
    for (const auto& [slot, stride] : list) {
      gather_slots_.push_back(slot);
      gather_strides_.push_back(stride);
    }
    gather_offsets_.push_back(static_cast<long>(gather_slots_.size()));
  }
}

void Shell::cellForces(std::span<const Vec3> q, ShellWork& work, double* energy, const ShellTerms& terms) const {
  work.slots.resize(slot_count_);
  double total = 0;
  const bool cells = terms.membrane || terms.bending;
  if (!cells) std::fill(work.slots.begin(), work.slots.begin() + hinge_slot_, 0.0);
  for (const Part& part : parts_) {
    if (!cells) break;
    ShellLaw law = part.law;
    if (!terms.membrane) law.d1 = law.d2 = law.d3 = law.d4 = 0;
    if (terms.steepest && law.kappa0 > 0) {
      law.bending_weft = zhengSteepest(law.bending_weft, law.kappa0, law.kappa_regular);
      law.bending_warp = zhengSteepest(law.bending_warp, law.kappa0, law.kappa_regular);
      law.kappa0 = law.kappa_regular = 0;
    }
    if (!terms.bending) law.bending_weft = law.bending_warp = law.twist = 0;
    if (energy) work.lane_energy.assign(static_cast<std::size_t>(part.block.groups) * part.block.lanes, 0.0);
    kernels_->force(part.block, law, reinterpret_cast<const double*>(q.data()), work.slots.data() + part.first_slot,
                    energy ? work.lane_energy.data() : nullptr);
    if (energy)
      for (double e : work.lane_energy) total += e;
  }
  if (energy) *energy = total;
}

void Shell::force(std::span<const Vec3> q, std::span<Vec3> f, ShellWork& work, double* energy,
                  const ShellTerms& terms) const {
  double total = 0;
  cellForces(q, work, energy ? &total : nullptr, terms);
  const int hinge_count = static_cast<int>(hinges_.size());
  std::vector<double> hinge_energy(energy ? hinge_count : 0);
#pragma omp parallel if (hinge_count > 64)
  {
    std::vector<Vec3> gradient;
#pragma omp for schedule(static)
    for (int i = 0; i < hinge_count; ++i) {
      const HingePoint& h = hinges_[i];
      const double turn = terms.seams ? hingeAngle(h, q, &gradient) - h.theta0 : 0.0;
      for (std::size_t k = 0; k < h.columns.size(); ++k) {
        const Vec3 g = terms.seams ? (h.stiffness_length * turn) * gradient[k] : Vec3{};
        double* slot = work.slots.data() + hinge_slot_ + 3 * (hinge_offset_[i] + static_cast<long>(k));
        slot[0] = g.x;
        slot[1] = g.y;
        slot[2] = g.z;
      }
      if (energy) hinge_energy[i] = 0.5 * h.stiffness_length * turn * turn;
    }
  }
  for (double e : hinge_energy) total += e;
  if (energy) *energy = total;
#pragma omp parallel for schedule(static) if (control_count_ > 512)
  for (int i = 0; i < control_count_; ++i) {
    Vec3 sum{};
    for (long k = gather_offsets_[i]; k < gather_offsets_[i + 1]; ++k) {
      const double* slot = work.slots.data() + gather_slots_[k];
      sum.x += slot[0];
      sum.y += slot[gather_strides_[k]];
      sum.z += slot[2 * gather_strides_[k]];
    }
    f[i] = -sum;
  }
}

struct Shell::Frame {
  SurfaceBasis basis;
  RestFrame G;
};

Shell::Frame Shell::frameAt(int patch, Vec2 uv) const {
  Frame frame{surfaceBasis(garment_.patches[patch], uv.x, uv.y), {}};
  Vec3 A1{}, A2{};
  for (std::size_t k = 0; k < frame.basis.columns.size(); ++k) {
    A1 += frame.basis.values[1][k] * garment_.patches[patch].points[frame.basis.columns[k]];
    A2 += frame.basis.values[2][k] * garment_.patches[patch].points[frame.basis.columns[k]];
  }
  frame.G = restFrame(A1, A2, garment_.weft[patch]);
  return frame;
}

ShellStress Shell::stressAt(int patch, Vec2 uv, std::span<const Vec3> q) const {
  const Frame frame = frameAt(patch, uv);
  const RestFrame& G = frame.G;
  Vec3 a1{}, a2{};
  for (std::size_t k = 0; k < frame.basis.columns.size(); ++k) {
    const Vec3& x = q[offsets_[patch] + frame.basis.columns[k]];
    a1 += frame.basis.values[1][k] * x;
    a2 += frame.basis.values[2][k] * x;
  }
  const Vec3 e1 = G.G11 * a1 + G.G21 * a2, e2 = G.G12 * a1 + G.G22 * a2;
  const double C11 = dot(e1, e1), C22 = dot(e2, e2), C12 = dot(e1, e2);
  const double E11 = 0.5 * (C11 - 1), E22 = 0.5 * (C22 - 1), E12 = 0.5 * C12;
  const ShellLaw law = shellLaw(garment_.fabric);
  const double n11 = law.d1 * E11 + law.d3 * E22, n22 = law.d3 * E11 + law.d2 * E22, n12 = 2 * law.d4 * E12;
  // Principal values of F n Fᵀ / J are those of n C / J.
  const double J = std::sqrt(C11 * C22 - C12 * C12);
  const double trace = n11 * C11 + 2 * n12 * C12 + n22 * C22, det = (n11 * n22 - n12 * n12) * (C11 * C22 - C12 * C12);
  const double root = std::sqrt(std::max(0.0, 0.25 * trace * trace - det));
  const double mean = 0.5 * (E11 + E22), radius = std::hypot(0.5 * (E11 - E22), E12);
  return {(0.5 * trace + root) / J, (0.5 * trace - root) / J, mean + radius, mean - radius};
}

Vec3 Shell::curvatureAt(int patch, Vec2 uv, std::span<const Vec3> q) const {
  const Frame frame = frameAt(patch, uv);
  std::array<Vec3, 6> d{};
  for (std::size_t k = 0; k < frame.basis.columns.size(); ++k)
    for (int m = 1; m < 6; ++m) d[m] += frame.basis.values[m][k] * q[offsets_[patch] + frame.basis.columns[k]];
  return curvature(frame.G, d[1], d[2], d[3], d[4], d[5]);
}

}  // namespace gambeson
