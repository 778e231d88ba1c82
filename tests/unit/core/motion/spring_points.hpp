#pragma once
/// Oscillators as a cloth: points of mass 1 that a function drives along x. No sample sees them.

#include <Eigen/Dense>
#include <functional>
#include <stdexcept>

#include "core/motion/step.hpp"

namespace gambeson::shapes {

class SpringPoints : public Cloth {
 public:
  using Vector = Eigen::VectorXd;
  using Law = std::function<Vector(const Vector&)>;  ///< what pulls the points back, of their x

  SpringPoints(int n, Law law) : law_(std::move(law)), rest_(static_cast<std::size_t>(n)) {
    map_.T = map_.Tt = identityRows(n);
    for (int i = 0; i < n; ++i) map_.home.push_back(i);
  }

  const std::vector<Vec3>& rest() const override { return rest_; }
  const FreeMap& map() const override { return map_; }
  const std::vector<ClothPatch>& patches() const override { return patches_; }
  std::string pointName() const override { return std::to_string(points()) + " points"; }
  std::string kernels() const override { return "none"; }
  std::string describePoint(int point) const override { return "point " + std::to_string(point); }
  Vec2 placeOfDraft(int, Vec2 uv) const override { return uv; }
  int draftPoints() const override { return points(); }
  std::vector<Vec3> fromDraft(std::span<const Vec3> control) const override { return {control.begin(), control.end()}; }
  Surface surface(std::span<const int>) const override {
    Surface s;
    s.W.column_count = s.WT.column_count = points();
    s.WTt = transpose(s.WT);
    return s;
  }
  Bulges bulges(const Surface&, std::span<const int>) const override { return {}; }
  SparseRows finer(int, std::span<const int>) const override { return {}; }
  PlaceMesh placeMesh(int) const override { return {}; }
  Fabric fabricAt(int, Vec2) const override { return {}; }
  double cellAt(int, Vec2) const override { return 1; }
  std::vector<NetEdge> net() const override {
    std::vector<NetEdge> edges;
    for (int i = 0; i + 1 < points(); ++i) edges.push_back({i, i + 1, 1});
    return edges;
  }
  std::vector<double> areas() const override { return std::vector<double>(rest_.size(), 1); }
  std::vector<double> masses() const override { return areas(); }
  SparseRows consistentMass() const override { return identityRows(points()); }
  void force(const ClothState& state, const ClothForce& out, ClothWork&, const ForceTerms&) const override {
    Vector x(points());
    for (int i = 0; i < points(); ++i) x(i) = state.q[i].x;
    const Vector pull = law_(x);
    for (int i = 0; i < points(); ++i) out.points[i] = {-pull(i), 0, 0};
  }
  std::unique_ptr<ClothTangent> tangent() const override { return std::make_unique<Tangent>(*this); }
  std::unique_ptr<StressView> stress() const override { throw std::logic_error("no stress"); }
  PointState stateAt(const ClothState&, int, Vec2) const override { return {}; }
  double bendAt(const ClothState&, int, Vec2) const override { return 0; }
  std::vector<std::pair<int, Vec2>> lawPlaces() const override { return {}; }
  bool springsAtRest(double) const override { return false; }
  StrainRows strainRows(Mobility, LimitPoints) const override { throw std::logic_error("no threads"); }
  Vec2 limitStressAt(const StrainRows&, std::span<const Vec2>, int, Vec2) const override { return {}; }
  const Mounting& mounting() const override { throw std::logic_error("nothing to mount"); }

 private:
  /// By differences of the law: exact for springs that are linear or of the second order.
  class Tangent : public ClothTangent {
   public:
    explicit Tangent(const SpringPoints& cloth) : cloth_(cloth) {
      for (int r = 0; r < cloth.points(); ++r) {
        for (int c = r; c < cloth.points(); ++c) sparsity_.columns.push_back(c);
        sparsity_.offsets.push_back(static_cast<long>(sparsity_.columns.size()));
      }
      sparsity_.values.assign(9 * sparsity_.columns.size(), 0.0);
    }
    const BlockMatrix& sparsity() const override { return sparsity_; }
    void assemble(const ClothState& state, ClothWork&, BlockMatrix& K, const ForceTerms&) const override {
      constexpr double kDifference = 1e-3;
      K = sparsity_;
      Vector x(cloth_.points());
      for (int i = 0; i < cloth_.points(); ++i) x(i) = state.q[i].x;
      for (int c = 0; c < cloth_.points(); ++c) {
        Vector before = x, after = x;
        before(c) -= kDifference;
        after(c) += kDifference;
        const Vector slope = (cloth_.law_(after) - cloth_.law_(before)) / (2 * kDifference);
        for (int r = 0; r <= c; ++r) K.values[9 * K.find(r, c)] = slope(r);
      }
    }

   private:
    const SpringPoints& cloth_;
    BlockMatrix sparsity_;
  };

  Law law_;
  std::vector<Vec3> rest_;
  FreeMap map_;
  std::vector<ClothPatch> patches_;
};

}  // namespace gambeson::shapes
