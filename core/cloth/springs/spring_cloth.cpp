#include "core/cloth/springs/spring_cloth.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/cloth/free_blocks.hpp"
#include "core/cloth/patches/bilinear.hpp"
#include "core/cloth/patches/cell_stress.hpp"
#include "core/cloth/spring_stiffness.hpp"
#include "core/math/parallel.hpp"

namespace gambeson {
namespace {

class SpringTangent : public ClothTangent {
 public:
  explicit SpringTangent(const SpringCloth& cloth) : cloth_(cloth) {
    std::vector<std::vector<int>> rows;
    for (const PointSpring& s : cloth.springs().springs) rows.push_back(freePointsOf(cloth.map(), s.corner));
    sparsity_ = blockSparsity(cloth.map(), rows);
  }
  const BlockMatrix& sparsity() const override { return sparsity_; }
  void assemble(const ClothState& state, ClothWork&, BlockMatrix& K, const ForceTerms& terms) const override {
    if (K.columns.size() != sparsity_.columns.size() || K.offsets != sparsity_.offsets) K = sparsity_;
    K.values.assign(9 * K.columns.size(), 0.0);
    for (const PointSpring& s : cloth_.springs().springs) {
      if (!(s.bends ? terms.bending : terms.membrane)) continue;
      const Vec3 way = state.q[static_cast<std::size_t>(s.corner[1])] - state.q[static_cast<std::size_t>(s.corner[0])];
      addSpringStiffness(cloth_.map(), s.corner, way, cloth_.springs().answer(s, norm2(way)), terms.definite, K);
    }
  }

 private:
  const SpringCloth& cloth_;
  BlockMatrix sparsity_;
};

}  // namespace

SpringCloth::SpringCloth(const NodalDraft& draft, const SpringNumbers& numbers)
    : PatchCloth(draft), springs_(springNet(draft.garment, numbers)), gather_(points()) {
  for (std::size_t k = 0; k < springs_.springs.size(); ++k)
    for (std::size_t end = 0; end < 2; ++end)
      gather_.add(springs_.springs[k].corner[end], static_cast<long>(6 * k + 3 * end), 1);
  gather_.close();
}

void SpringCloth::force(const ClothState& state, const ClothForce& out, ClothWork& work,
                        const ForceTerms& terms) const {
  const int n = static_cast<int>(springs_.springs.size());
  work.slots.resize(6 * springs_.springs.size());
  if (out.energy) work.lane_energy.assign(springs_.springs.size(), 0.0);
  forAll(Each::sum, n, [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    const PointSpring& s = springs_.springs[k];
    double* const slot = work.slots.data() + 6 * k;
    if (!(s.bends ? terms.bending : terms.membrane)) {
      std::fill_n(slot, 6, 0.0);
      return;
    }
    const Vec3 way = state.q[static_cast<std::size_t>(s.corner[1])] - state.q[static_cast<std::size_t>(s.corner[0])];
    const SpringAnswer<double> answer = springs_.answer(s, norm2(way));
    for (int c = 0; c < 3; ++c) {
      slot[c] = -answer.per_length * way[c];
      slot[3 + c] = -slot[c];
    }
    if (out.energy) work.lane_energy[k] = answer.energy;
  });
  gather_.negativeSum(work.slots.data(), out.points);
  if (!out.energy) return;
  *out.energy = {};
  for (const double e : work.lane_energy) out.energy->stored += e;
}

std::unique_ptr<ClothTangent> SpringCloth::tangent() const { return std::make_unique<SpringTangent>(*this); }

std::unique_ptr<StressView> SpringCloth::stress() const {
  return std::make_unique<CellStress>(*this, springs_.first_cell, [this](const ClothState& state, int patch, int cell) {
    return stateOf(patch, cell, state.q);
  });
}

std::vector<int> SpringCloth::cellsAt(int patch, Vec2 uv) const {
  std::vector<int> cells = gambeson::cellsAt(garment().patches[static_cast<std::size_t>(patch)], uv);
  for (int& c : cells) c += springs_.first_cell[static_cast<std::size_t>(patch)];
  return cells;
}

namespace {

/// The mean of the second differences of a line of points around its interval c, where there are any.
template <class At>
Vec3 secondDifference(int c, int count, const At& at) {
  Vec3 sum{};
  int found = 0;
  for (int k = c; k <= c + 1; ++k)
    if (k > 0 && k + 1 < count) sum += at(k - 1) - 2.0 * at(k) + at(k + 1), ++found;
  return found > 0 ? sum / found : sum;
}

}  // namespace

/// A cell of a patch among its points, and what takes forms of grid coordinates to (weft, warp).
class SpringCloth::Place {
 public:
  Place(const SpringCloth& cloth, int patch, int cell, std::span<const Vec3> q)
      : patch_(cloth.garment().patches[static_cast<std::size_t>(patch)]),
        q_(q.subspan(static_cast<std::size_t>(cloth.patches()[static_cast<std::size_t>(patch)].first_point),
                     static_cast<std::size_t>(patch_.size()))) {
    const int local = cell - cloth.springs_.first_cell[static_cast<std::size_t>(patch)], across = patch_.u.count() - 1;
    i_ = local % across, j_ = local / across;
    const auto& lines = cloth.springs_.cells[static_cast<std::size_t>(cell)].lines;
    const Vec2 u = lines[0].way, v = lines[1].way;
    const double det = u.x * v.y - u.y * v.x;
    of_u_ = {v.y / det, -v.x / det}, of_v_ = {-u.y / det, u.x / det};
    su_ = 0.5 * (at(1, 0) - at(0, 0) + at(1, 1) - at(0, 1));
    sv_ = 0.5 * (at(0, 1) - at(0, 0) + at(1, 1) - at(1, 0));
  }
  Vec3 strain() const {
    const Vec3 metric = toWeft(norm2(su_), norm2(sv_), 2 * dot(su_, sv_));
    return {0.5 * (metric.x - 1), 0.5 * (metric.y - 1), 0.5 * metric.z};
  }
  Vec3 curvature() const {
    const Vec3 normal = normalized(cross(su_, sv_));
    Vec3 uu{}, vv{};
    for (int side = 0; side < 2; ++side) {
      uu += 0.5 * secondDifference(i_, patch_.u.count(), [&](int k) { return at(k - i_, side); });
      vv += 0.5 * secondDifference(j_, patch_.v.count(), [&](int l) { return at(side, l - j_); });
    }
    const Vec3 twist = at(1, 1) - at(1, 0) - at(0, 1) + at(0, 0);
    return toWeft(dot(uu, normal), dot(vv, normal), 2 * dot(twist, normal));
  }

 private:
  const Vec3& at(int k, int l) const { return q_[static_cast<std::size_t>(patch_.index(i_ + k, j_ + l))]; }
  /// Of a form (uu, vv, 2 uv).
  Vec3 toWeft(double uu, double vv, double uv2) const {
    const Vec2 &a = of_u_, &b = of_v_;
    return {uu * a.x * a.x + vv * b.x * b.x + uv2 * a.x * b.x, uu * a.y * a.y + vv * b.y * b.y + uv2 * a.y * b.y,
            2 * (uu * a.x * a.y + vv * b.x * b.y) + uv2 * (a.x * b.y + a.y * b.x)};
  }

  const NurbsPatch& patch_;
  std::span<const Vec3> q_;
  int i_ = 0, j_ = 0;
  Vec2 of_u_, of_v_;  ///< rows of the inverse of the sides at rest
  Vec3 su_, sv_;      ///< the sides
};

Vec3 SpringCloth::curvatureOf(int patch, int cell, std::span<const Vec3> q) const {
  return Place(*this, patch, cell, q).curvature();
}

PointState SpringCloth::stateOf(int patch, int cell, std::span<const Vec3> q) const {
  PointState s;
  s.strain = Place(*this, patch, cell, q).strain();
  s.curvature_change = curvatureOf(patch, cell, q) - curvatureOf(patch, cell, rest());
  s.n = resultantsOf(springs_.cells[static_cast<std::size_t>(cell)], s.strain);
  s.m = momentsOf(springs_.cells[static_cast<std::size_t>(cell)], s.curvature_change);
  return s;
}

PointState SpringCloth::stateAt(const ClothState& state, int patch, Vec2 uv) const {
  return stateOf(patch, cellsAt(patch, uv).front(), state.q);
}

double SpringCloth::bendAt(const ClothState& state, int patch, Vec2 uv) const {
  const Vec3 k = curvatureOf(patch, cellsAt(patch, uv).front(), state.q);
  return std::sqrt(k.x * k.x + k.y * k.y + 0.5 * k.z * k.z);
}

std::vector<std::pair<int, Vec2>> SpringCloth::lawPlaces() const { return cellMiddles(garment()); }

}  // namespace gambeson
