#include "core/cloth/loads.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/cloth/free_blocks.hpp"
#include "core/cloth/mounting.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

/// a bᵀ, added.
void addOuter(std::array<double, 9>& m, double scale, const Vec3& a, const Vec3& b) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m[3 * i + j] += scale * a[i] * b[j];
}

}  // namespace

namespace {

/// What an edge moment needs at a point. With t = x,t/|x,t| along the edge, x,c into the patch, k = x,c . x,t/|x,t|^2
/// and n = (x,t x x,c)/J, J = |x,t x x,c|, the conormal into the patch is b = n x t, and the surface derivative of N
/// along b is  g = |x,t|/J (N,c - k N,t).
struct EdgeKinematics {
  Vec3 xt, xc, n, contra_t, contra_c;  ///< contravariant base vectors
  double length, J, k;
  EdgeKinematics(const Vec3& along, const Vec3& inward) : xt(along), xc(inward) {
    const Vec3 area = cross(xt, xc);
    J = norm(area);
    n = area / J;
    length = norm(xt);
    k = dot(xc, xt) / (length * length);
    contra_t = cross(xc, n) / J;
    contra_c = cross(n, xt) / J;
  }
};

}  // namespace

/// Pressure: f_I = p ∫ N_I (x,u x x,v) du dv, as a3 dA = x,u x x,v du dv.
/// Moment: dw = (t x a3) . da3 with da3 = - a^a (a3 . da_a). The product does not change where n, which is a3 or - a3,
/// takes the place of a3; with t x n = - b it is  dw = sum_I g_I n . dq_I,  so that  f_I = m ∫ g_I n ds.
void FollowingLoad::add(std::span<const Vec3> q, double value, std::span<Vec3> f) const {
  for (const FollowingPoint& point : points) {
    const Vec3 x1 = combine(columns, point.d1, q), x2 = combine(columns, point.d2, q);
    if (pressure) {
      const Vec3 push = value * point.weight * cross(x1, x2);
      for (std::size_t k = 0; k < columns.size(); ++k) f[columns[k]] += point.n[k] * push;
    } else {
      const EdgeKinematics e(x1, x2);
      const Vec3 push = value * point.weight * e.length / e.J * e.n;
      for (std::size_t k = 0; k < columns.size(); ++k) f[columns[k]] += (point.d2[k] - e.k * point.d1[k]) * push;
    }
  }
}

/// Pressure: d(x,u x x,v) = N_J,u dq x x,v + x,u x N_J,v dq.
/// Moment: with t_J = N_J,a a^a: dn = - t_J (n . dq_J),
/// dJ = J t_J . dq, d|x,t| = N_J,t t . dq, dk = ((N_J,c x,t + N_J,t x,c) - 2 k N_J,t x,t) . dq/|x,t|^2.
void FollowingLoad::addStiffness(std::span<const Vec3> q, double value,
                                 std::vector<std::array<double, 9>>& blocks) const {
  const std::size_t n = columns.size();
  for (const FollowingPoint& point : points) {
    const Vec3 x1 = combine(columns, point.d1, q), x2 = combine(columns, point.d2, q);
    const double w = value * point.weight;
    if (pressure) {
      for (std::size_t J = 0; J < n; ++J) {
        const Vec3 a = point.d2[J] * x1 - point.d1[J] * x2;  // d(x1 x x2) = a x dq_J
        for (std::size_t I = 0; I < n; ++I) {
          const double s = -w * point.n[I];
          std::array<double, 9>& m = blocks[I * n + J];
          m[1] -= s * a.z, m[2] += s * a.y;
          m[3] += s * a.z, m[5] -= s * a.x;
          m[6] -= s * a.y, m[7] += s * a.x;
        }
      }
      continue;
    }
    const EdgeKinematics e(x1, x2);
    const double factor = e.length / e.J, length2 = e.length * e.length;
    for (std::size_t J = 0; J < n; ++J) {
      const Vec3 tJ = point.d1[J] * e.contra_t + point.d2[J] * e.contra_c;
      const Vec3 scale = point.d1[J] / length2 * e.xt - tJ;  // d(factor)/factor
      const Vec3 dk = ((point.d2[J] - 2 * e.k * point.d1[J]) * e.xt + point.d1[J] * e.xc) / length2;
      for (std::size_t I = 0; I < n; ++I) {
        const double g = factor * (point.d2[I] - e.k * point.d1[I]);
        std::array<double, 9>& m = blocks[I * n + J];
        addOuter(m, -w, e.n, g * scale - factor * point.d1[I] * dk);
        addOuter(m, w * g, tJ, e.n);
      }
    }
  }
}

Loads::Loads(const Mounting& mounting, int points, std::vector<DeadLoad> dead,
             const std::vector<PressureLoad>& pressure, const std::vector<EdgeMoment>& moments)
    : point_count_(points), dead_(std::move(dead)) {
  const auto useProgram = [&](int program) {
    if (program < 0) throw InputError({"", 0, "load"}, "needs a program");
    programs_ = std::max(programs_, program + 1);
  };
  const auto keep = [&](std::vector<FollowingLoad> loads, int program) {
    for (FollowingLoad& load : loads) {
      load.program = program;
      following_.push_back(std::make_shared<const FollowingLoad>(std::move(load)));
    }
  };
  for (const DeadLoad& load : dead_) {
    useProgram(load.program);
    if (static_cast<int>(load.force_N.size()) != point_count_)
      throw InputError({"", 0, "load"}, "has " + std::to_string(load.force_N.size()) + " forces for " +
                                            std::to_string(point_count_) + " control points");
    for (const Vec3& f : load.force_N)
      if (!std::isfinite(f.x + f.y + f.z)) throw InputError({"", 0, "load"}, "must be finite");
  }
  for (const PressureLoad& load : pressure) {
    useProgram(load.program);
    if (!std::isfinite(load.pressure_Pa)) throw InputError({"", 0, "pressure"}, "must be finite");
    keep(mounting.pressure(load.patch, load.pressure_Pa), load.program);
  }
  for (const EdgeMoment& load : moments) {
    useProgram(load.program);
    if (!std::isfinite(load.moment_N)) throw InputError({"", 0, "edge moment"}, "must be finite");
    keep(mounting.edgeMoment(load.edge, load.moment_N), load.program);
  }
}

void Loads::add(std::span<const Vec3> q, std::span<const double> value, std::span<Vec3> f) const {
  assert(static_cast<int>(q.size()) == point_count_ && q.size() == f.size());
  assert(static_cast<int>(value.size()) >= programs_);
  for (const DeadLoad& load : dead_)
    for (std::size_t i = 0; i < f.size(); ++i) f[i] += value[load.program] * load.force_N[i];
  for (const auto& element : following_)
    if (value[element->program] != 0) element->add(q, value[element->program], f);
}

void Loads::addInner(std::span<const double> value, std::span<double> f) const {
  for (const auto& element : following_)
    for (const auto& [inner, force] : element->inner) f[static_cast<std::size_t>(inner)] += value[element->program] * force;
}

void Loads::addStiffness(std::span<const Vec3> q, std::span<const double> value, const FreeMap& map,
                         BlockMatrix& K) const {
  assert(static_cast<int>(value.size()) >= programs_);
  std::vector<std::array<double, 9>> blocks;
  for (const auto& element : following_) {
    if (value[element->program] == 0) continue;
    blocks.assign(element->columns.size() * element->columns.size(), {});
    element->addStiffness(q, value[element->program], blocks);
    addSymmetrised(map, element->columns, blocks, K);
  }
}

}  // namespace gambeson
