/// Quadratic hinges: gradients, rigid and affine motions, their constant tangent, hinges of small folds, seams.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/cloth/triangles/triangle_cloth.hpp"
#include "quadratic_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

TriangleCloth sheet(BendingElements bending, const Fabric& f, MeshKind kind, double jitter, int nu = 4, int nv = 3) {
  MeshDraft g = flatTriangles(nu, nv, 0.01 * nu, 0.01 * nv, f, kind, jitter);
  g.bending = bending;
  return shapes::clothOf(std::move(g));
}

/// Far from flat: bent, stretched and noisy.
std::vector<Vec3> bent(const TriangleCloth& c, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> noise(-1, 1);
  std::vector<Vec3> q;
  for (const Vec3& X : c.rest())
    q.push_back(Vec3{1.04 * X.x + 0.05 * X.y, 0.97 * X.y, 20 * X.x * X.x + 10 * X.x * X.y} +
                1e-3 * Vec3{noise(random), noise(random), noise(random)});
  return q;
}

ForceTerms bendingAlone() {
  ForceTerms terms;
  terms.membrane = false;
  return terms;
}

struct Forces {
  std::vector<Vec3> points;
  double energy = 0;

  Forces(const TriangleElements& e, const std::vector<Vec3>& q, const ForceTerms& terms) : points(q.size()) {
    ClothWork work;
    ClothEnergy sum;
    e.force({q, {}, {}}, {points, {}, {}, &sum}, work, terms);
    energy = sum.stored + sum.lost;
  }
  Forces(const TriangleCloth& c, const std::vector<Vec3>& q, const ForceTerms& terms = bendingAlone())
      : Forces(c.elements(), q, terms) {}
};

double largest(const std::vector<Vec3>& v) {
  double most = 0;
  for (const Vec3& x : v) most = std::max(most, norm(x));
  return most;
}

/// Differences of a quadratic energy have no error but rounding, however far they reach.
TEST(QuadraticHinges, ForceIsTheGradientOfTheEnergy) {
  for (const Fabric& f : fabrics())
    for (const MeshKind kind : kKinds) {
      const TriangleCloth c = sheet(kQuadratic, f, kind, 0.2);
      const std::vector<Vec3> q = bent(c, 3);
      const Forces at(c, q);
      constexpr double h = 0.01;
      double worst = 0;
      for (std::size_t i = 0; i < q.size(); ++i)
        for (int d = 0; d < 3; ++d) {
          std::vector<Vec3> low = q, high = q;
          low[i][d] -= h, high[i][d] += h;
          const double slope = (Forces(c, high).energy - Forces(c, low).energy) / (2 * h);
          worst = std::max(worst, std::abs(at.points[i][d] + slope));
        }
      EXPECT_LT(worst, 1e-9 * largest(at.points));
    }
}

TEST(QuadraticHinges, RigidAndAffineMotionsCostNothingAndForcesHaveNoTorque) {
  for (const Fabric& f : fabrics()) {
    const TriangleCloth c = sheet(kQuadratic, f, MeshKind::single, 0.25);
    const Mat3 R = rotationAbout(normalized({1, 2, -0.5}), 2.1);
    std::vector<Vec3> rigid, affine;
    for (const Vec3& X : c.rest()) {
      rigid.push_back(R * X + Vec3{0.3, -0.1, 0.2});
      affine.push_back({1.2 * X.x + 0.3 * X.y, 0.1 * X.x + 0.8 * X.y, 0.4 * X.x - 0.2 * X.y});
    }
    const std::vector<Vec3> q = bent(c, 9);
    const Forces at(c, q);
    for (const auto& flat : {rigid, affine}) {
      const Forces none(c, flat);
      EXPECT_LT(largest(none.points), 1e-12 * largest(at.points));
      EXPECT_LT(none.energy, 1e-20 * at.energy);
    }
    Vec3 sum{}, moment{};
    for (std::size_t i = 0; i < q.size(); ++i) sum += at.points[i], moment += cross(q[i], at.points[i]);
    EXPECT_LT(norm(sum), 1e-12 * largest(at.points));
    EXPECT_LT(norm(moment), 1e-12 * 0.05 * largest(at.points));
  }
}

Eigen::MatrixXd tangentAt(const TriangleCloth& c, const std::vector<Vec3>& q, bool definite) {
  const auto tangent = c.tangent();
  ClothWork work;
  BlockMatrix K = tangent->sparsity();
  ForceTerms terms = bendingAlone();
  terms.definite = definite;
  tangent->assemble({q, {}, {}}, work, K, terms);
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(3 * K.rows(), 3 * K.rows());
  for (int r = 0; r < K.rows(); ++r)
    for (long k = K.offsets[static_cast<std::size_t>(r)]; k < K.offsets[static_cast<std::size_t>(r + 1)]; ++k)
      for (int e = 0; e < 9; ++e) {
        const int a = 3 * r + e / 3, b = 3 * K.columns[static_cast<std::size_t>(k)] + e % 3;
        all(a, b) = all(b, a) = K.values[static_cast<std::size_t>(9 * k + e)];
      }
  return all;
}

TEST(QuadraticHinges, TheTangentIsConstantAndTheDerivativeOfTheForce) {
  for (const Fabric& f : fabrics()) {
    const TriangleCloth c = sheet(kQuadratic, f, MeshKind::alternating, 0.2);
    const std::vector<Vec3> q = bent(c, 5);
    const Eigen::MatrixXd K = tangentAt(c, q, false);
    EXPECT_EQ((K - tangentAt(c, c.rest(), true)).cwiseAbs().maxCoeff(), 0);
    Eigen::MatrixXd fd = K;
    constexpr double h = 0.01;
    for (int j = 0; j < K.cols(); ++j) {  // one patch: points are free points
      std::vector<Vec3> low = q, high = q;
      const auto point = [&](int p) { return static_cast<std::size_t>(c.map().home[static_cast<std::size_t>(p)]); };
      low[point(j / 3)][j % 3] -= h, high[point(j / 3)][j % 3] += h;
      const Forces before(c, low), after(c, high);
      for (int i = 0; i < K.rows(); ++i)
        fd(i, j) = (before.points[point(i / 3)][i % 3] - after.points[point(i / 3)][i % 3]) / (2 * h);
    }
    EXPECT_LT((K - fd).cwiseAbs().maxCoeff(), 1e-10 * K.cwiseAbs().maxCoeff());
    const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K).eigenvalues();
    EXPECT_GT(values.minCoeff(), -1e-12 * values.maxCoeff());
    EXPECT_GT(values.maxCoeff(), 0);
  }
}

/// Heights of 1e-4 of a cell: angles squared are 1e-8.
TEST(QuadraticHinges, StoreWhatHingesDoOfSmallFolds) {
  for (const Fabric& f : fabrics())
    for (const MeshKind kind : kKinds) {
      std::vector<double> energy;
      for (const BendingElements bending : {kHinge, kQuadratic}) {
        const TriangleCloth c = sheet(bending, f, kind, 0.2);
        std::mt19937 random(3);
        std::uniform_real_distribution<double> noise(-1e-6, 1e-6);
        std::vector<Vec3> q = c.rest();
        for (Vec3& x : q) x.z += noise(random);
        energy.push_back(Forces(c, q).energy);
      }
      ASSERT_GT(energy[0], 0);
      EXPECT_NEAR(energy[1] / energy[0], 1, 1e-6);
    }
}

/// Two triangles, of one patch or of two, in all ways to count the corners of the second.
MeshDraft pair(BendingElements bending, bool sewn, int turn) {
  MeshDraft g;
  g.mesh.vertices = {{0, 0, 0}, {0.01, 0, 0}, {0.003, 0.008, 0}, {0.004, -0.012, 0}};
  std::array<int, 3> second{1, 0, 3};
  std::rotate(second.begin(), second.begin() + turn, second.end());
  g.mesh.triangles = {{0, 1, 2}, second};
  g.mesh.patch = {0, sewn ? 1 : 0};
  g.mesh.patch_names = {"one"};
  if (sewn) g.mesh.patch_names.push_back("two");
  g.fabrics = {linear()};
  g.bending = bending;
  return g;
}

std::vector<Vec3> folded(const TriangleCloth& c, double theta) {
  std::vector<Vec3> q = c.rest();
  for (Vec3& x : q)
    if (x.y < -1e-9) x = {x.x, x.y * std::cos(theta), -x.y * std::sin(theta)};
  return q;
}

TEST(QuadraticHinges, MomentsGoWithTheSineOfTheFold) {
  for (const bool sewn : {false, true})
    for (const int turn : {0, 1, 2})
      for (const double theta : {1e-3, -0.5, 1.2, 3.0}) {
        const TriangleCloth one = shapes::clothOf(pair(kHinge, sewn, turn)),
                            two = shapes::clothOf(pair(kQuadratic, sewn, turn));
        const double hinge = Forces(one, folded(one, theta)).energy, ours = Forces(two, folded(two, theta)).energy;
        EXPECT_NEAR(ours / hinge, std::pow(2 * std::sin(0.5 * theta) / theta, 2), 1e-9);
      }
}

/// Seams are left out as those of hinges are, and what lies within a patch.
TEST(QuadraticHinges, TermsLeaveOutSeamsOrPatches) {
  for (const bool sewn : {false, true}) {
    const TriangleCloth c = shapes::clothOf(pair(kQuadratic, sewn, 0));
    EXPECT_EQ(c.elements().quadratic().seams().size(), sewn ? 1u : 0u);
    EXPECT_EQ(c.elements().quadratic().within().size(), sewn ? 0u : 1u);
    const std::vector<Vec3> q = folded(c, 0.5);
    const double whole = Forces(c, q).energy;
    for (const bool seams : {false, true}) {
      ForceTerms terms = bendingAlone();
      (seams ? terms.seams : terms.bending) = false;
      const bool left = seams != sewn;
      const Forces at(c, q, terms);
      EXPECT_EQ(at.energy, left ? whole : 0);
      EXPECT_EQ(largest(at.points) > 0, left);
      const auto tangent = c.tangent();
      ClothWork work;
      BlockMatrix K = tangent->sparsity();
      tangent->assemble({q, {}, {}}, work, K, terms);
      EXPECT_EQ(std::any_of(K.values.begin(), K.values.end(), [](double v) { return v != 0; }), left);
    }
  }
}

/// A fold within a patch, one at a seam, and a garment that bends by springs.
TEST(QuadraticHinges, StandBesideSeamsAndOtherElements) {
  const auto three = [] {
    MeshDraft g = pair(kQuadratic, false, 0);
    g.mesh.vertices.push_back({0.012, -0.013, 0});
    g.mesh.triangles.push_back({1, 3, 4});
    g.mesh.patch.push_back(1);
    g.mesh.patch_names.push_back("two");
    return g;
  };
  std::vector<MeshDraft> garments;
  garments.push_back(three());
  garments.push_back(pair(BendingElements::springs, false, 0));
  const TriangleCloth both(std::move(garments)), one = shapes::clothOf(three()),
                                                 two = shapes::clothOf(pair(BendingElements::springs, false, 0));
  const std::vector<Vec3> q = bent(one, 3), other = bent(two, 5);
  std::vector<Vec3> all = q;
  all.insert(all.end(), other.begin(), other.end());
  const Forces whole(both, all), of_one(one, q), of_two(two, other);
  EXPECT_NEAR(whole.energy, of_one.energy + of_two.energy, 1e-12 * whole.energy);
  for (std::size_t i = 0; i < all.size(); ++i)
    EXPECT_LE(norm(whole.points[i] - (i < q.size() ? of_one.points[i] : of_two.points[i - q.size()])),
              1e-12 * largest(whole.points));
  constexpr double h = 0.01;
  for (std::size_t i = 0; i < q.size(); ++i) {
    std::vector<Vec3> low = q, high = q;
    low[i].z -= h, high[i].z += h;
    const double slope = (Forces(one, high).energy - Forces(one, low).energy) / (2 * h);
    EXPECT_NEAR(of_one.points[i].z, -slope, 1e-9 * largest(of_one.points));
  }
}

TEST(QuadraticHinges, InstructionSetsAgree) {
  const TriangleCloth c = sheet(kQuadratic, solid(), MeshKind::single, 0.2, 9, 7);
  const std::vector<Vec3> q = bent(c, 3);
  const Forces widest(c, q, {});
  for (const TriangleKernels* kernels : triangleKernels()) {
    const TriangleElements elements(c.points(), c.elements().triangles(), c.elements().hinges(), std::vector{solid()},
                                    *kernels);
    const Forces at(elements, q, {});
    EXPECT_NEAR(at.energy / widest.energy, 1, 1e-12) << kernels->name;
    for (std::size_t i = 0; i < q.size(); ++i)
      EXPECT_LT(norm(at.points[i] - widest.points[i]), 1e-11 * largest(widest.points)) << kernels->name;
  }
}

/// What bends by slots of its own adds nothing to what membranes damp, whatever was in these slots.
TEST(QuadraticHinges, DampNothing) {
  for (const BendingElements bending : {kQuadratic, BendingElements::springs}) {
    MeshDraft g = flatTriangles(4, 3, 0.04, 0.03, linear(), MeshKind::single, 0.2);
    g.bending = bending;
    g.membrane = {.elements = MembraneElements::springs, .stretch_damping_Ns_per_m = 1};
    const TriangleCloth c = shapes::clothOf(std::move(g));
    const std::vector<Vec3> q = bent(c, 3), still(q.size());
    std::vector<Vec3> force(q.size());
    ClothWork work;
    c.force({q, {}, {}}, {force, {}, {}, nullptr}, work, bendingAlone());
    ASSERT_GT(largest(force), 0);
    ClothState state{q, {}, {}};
    state.v = still;
    c.dampingForce(state, {force, {}, {}, nullptr}, work);
    EXPECT_EQ(largest(force), 0);
  }
}

}  // namespace
}  // namespace gambeson
