/// Hexahedra and solids of them: energy, forces, tangent, patch test, mass, and what meshes are refused.

#include "core/solid/solid_body.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>

#include "core/error.hpp"
#include "unit/core/solid/solid_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

/// A crooked block of 8 to 27 cells of yarn, its fibres across the corners.
SolidMesh crooked(int n) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> d(-0.12 / n, 0.12 / n);
  SolidMesh m = block(n, n, n, [&](const Vec3& p) {
    const auto inside = [](double v) { return v > 0.01 && v < 0.99 ? 1.0 : 0.0; };
    return Vec3{2 * p.x + inside(p.x) * d(random), p.y + inside(p.y) * d(random), p.z + inside(p.z) * d(random)};
  });
  m.materials = {{kevlar(), 1000}};
  m.fibres.assign(m.cells.size(), {1, 2, -0.5});
  return m;
}

std::vector<Vec3> moved(const SolidMesh& m, const std::function<Vec3(const Vec3&)>& f) {
  std::vector<Vec3> x;
  for (const Vec3& X : m.nodes) x.push_back(f(X));
  return x;
}

double largest(const std::vector<Vec3>& f) {
  double most = 0;
  for (const Vec3& v : f) most = std::max(most, norm(v));
  return most;
}

TEST(SolidBody, HasItsVolumeAndMass) {
  const SolidBody body(crooked(3));
  EXPECT_NEAR(body.volume(), 2, 1e-13);
  for (const bool lumped : {false, true}) {
    BlockMatrix M = body.sparsity();
    body.mass(lumped, M);
    std::vector<double> one(3 * body.mesh().nodes.size(), 0.0), rows(one.size());
    for (std::size_t i = 0; i < one.size(); i += 3) one[i] = 1;
    for (int r = 0; r < M.rows(); ++r)
      for (long k = M.offsets[r]; k < M.offsets[r + 1]; ++k) {
        rows[3 * r] += M.values[9 * k];
        if (M.columns[k] != r) rows[3 * M.columns[k]] += M.values[9 * k];
      }
    double total = 0;
    for (const double m : rows) total += m;
    EXPECT_NEAR(total, 2000, 1e-9);
  }
}

TEST(SolidBody, ARigidMotionCostsNoForce) {
  const SolidBody body(crooked(2));
  const Mat3 R = rotationAbout(normalized(Vec3{1, -2, 0.7}), 2.3);
  const std::vector<Vec3> x = moved(body.mesh(), [&](const Vec3& X) { return R * X + Vec3{3, -1, 2}; });
  std::vector<Vec3> f(x.size());
  SolidWork work;
  EXPECT_NEAR(body.force(x, f, work), 0, 1e-15 * 84.63e9);
  EXPECT_LT(largest(f), 1e-13 * 84.63e9);
}

TEST(SolidBody, PassesThePatchTest) {
  const SolidBody body(crooked(3));
  const Mat3 F{{1.1, 0.05, -0.1}, {0.2, 0.9, 0.03}, {-0.04, 0.1, 1.05}};
  const std::vector<Vec3> x = moved(body.mesh(), [&](const Vec3& X) { return F * X; });
  std::vector<Vec3> f(x.size());
  SolidWork work;
  const double energy = body.force(x, f, work);
  const Symmetric C{norm2(F.a), norm2(F.b), norm2(F.c), dot(F.b, F.c), dot(F.a, F.c), dot(F.a, F.b)};
  const SolidAnswer answer = evaluate(kevlar(), normalized(Vec3{1, 2, -0.5}), C);
  EXPECT_NEAR(energy, 2 * answer.energy_J_per_m3, 1e-12 * energy);
  const double border = largest(f);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Vec3& X = body.mesh().nodes[i];
    const bool inside = X.x > 0.01 && X.x < 1.99 && X.y > 0.01 && X.y < 0.99 && X.z > 0.01 && X.z < 0.99;
    if (inside) {
      EXPECT_LT(norm(f[i]), 1e-13 * border);
    }
  }
}

TEST(SolidBody, ForceIsTheGradientOfTheEnergyAndTheTangentItsSlope) {
  const SolidBody body(crooked(2));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> d(-0.05, 0.05);
  std::vector<Vec3> x = moved(body.mesh(), [&](const Vec3& X) { return X + Vec3{d(random), d(random), d(random)}; });
  std::vector<Vec3> f(x.size()), before(x.size()), after(x.size());
  SolidWork work;
  body.force(x, f, work);
  BlockMatrix K = body.sparsity();
  body.stiffness(x, K, work);
  double stiffest = 0, energy_error = 0, slope_error = 0;
  for (const double v : K.values) stiffest = std::max(stiffest, std::abs(v));
  const double h = 1e-6;
  for (int i = 0; i < static_cast<int>(x.size()); ++i)
    for (int c = 0; c < 3; ++c) {
      const double at = x[i][c];
      x[i][c] = at + h;
      const double up = body.force(x, after, work);
      x[i][c] = at - h;
      const double down = body.force(x, before, work);
      x[i][c] = at;
      energy_error = std::max(energy_error, std::abs((up - down) / (2 * h) - f[i][c]));
      for (int j = 0; j < static_cast<int>(x.size()); ++j) {
        const long block = i <= j ? K.find(i, j) : K.find(j, i);
        for (int e = 0; e < 3; ++e) {
          const double k = block < 0 ? 0 : K.values[9 * block + (i <= j ? 3 * c + e : 3 * e + c)];
          slope_error = std::max(slope_error, std::abs((after[j][e] - before[j][e]) / (2 * h) - k));
        }
      }
    }
  EXPECT_LT(energy_error, 1e-7 * largest(f));
  EXPECT_LT(slope_error, 1e-7 * stiffest);
}

TEST(SolidBody, TheTangentIsSymmetric) {
  const SolidMesh m = crooked(1);
  std::array<Vec3, 8> X, x, f;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> d(-0.1, 0.1);
  for (int a = 0; a < 8; ++a) X[a] = m.nodes[m.cells[0][a]], x[a] = X[a] + Vec3{d(random), d(random), d(random)};
  std::array<double, 576> K;
  evaluate(hexahedron(X), kevlar(), x, f, K);
  double most = 0, error = 0;
  for (int i = 0; i < 24; ++i)
    for (int j = 0; j < 24; ++j) {
      most = std::max(most, std::abs(K[24 * i + j]));
      error = std::max(error, std::abs(K[24 * i + j] - K[24 * j + i]));
    }
  EXPECT_LT(error, 1e-14 * most);
}

TEST(SolidBody, SameBitsForAnyNumberOfThreads) {
  const SolidBody body(crooked(3));
  const std::vector<Vec3> x = moved(body.mesh(), [](const Vec3& X) {
    return X + Vec3{0.05 * std::sin(3 * X.y), 0.02 * X.x * X.z, 0.03 * X.x};
  });
  const int before = omp_get_max_threads();
  std::vector<Vec3> f1(x.size()), f3(x.size());
  BlockMatrix K1 = body.sparsity(), K3 = K1;
  SolidWork work;
  omp_set_num_threads(1);
  const double one = body.force(x, f1, work);
  body.stiffness(x, K1, work);
  omp_set_num_threads(3);
  const double three = body.force(x, f3, work);
  body.stiffness(x, K3, work);
  omp_set_num_threads(before);
  EXPECT_EQ(one, three);
  EXPECT_EQ(f1, f3);
  EXPECT_TRUE(std::equal(K1.values.begin(), K1.values.end(), K3.values.begin()));
}

TEST(SolidBody, ACellTurnedInsideOutHasNoForce) {
  const SolidBody body(crooked(1));
  const std::vector<Vec3> x = moved(body.mesh(), [](const Vec3& X) { return Vec3{-X.x, X.y, X.z}; });
  std::vector<Vec3> f(x.size());
  SolidWork work;
  EXPECT_TRUE(std::isnan(body.force(x, f, work)));
  EXPECT_TRUE(std::isnan(f[0].x));
}

TEST(SolidMesh, FacetsAreSeenFromOutside) {
  const SolidMesh m = crooked(2);
  const std::vector<Facet> facets = boundaryFacets(m);
  ASSERT_EQ(facets.size(), 24u);
  // Gauss: the flux of x through the skin is three times the volume, wherever the block stands. Facets are plane.
  double flux = 0;
  const auto at = [&](int node) { return m.nodes[node] + Vec3{1, 2, 3}; };
  for (const Facet& f : facets)
    for (const auto& t : {std::array{0, 1, 2}, std::array{0, 2, 3}})
      flux += dot(at(f[t[0]]), cross(at(f[t[1]]), at(f[t[2]]))) / 2;
  EXPECT_NEAR(flux, 3 * 2, 1e-12);
  double area = 0;
  for (const double a : nodeAreas(facets, m.nodes)) area += a;
  EXPECT_NEAR(area, 10, 1e-12);
}

void expectRefused(const std::string& key, SolidMesh mesh, const std::function<void(SolidMesh&)>& spoil) {
  spoil(mesh);
  try {
    const SolidBody body(std::move(mesh));
    ADD_FAILURE() << key << " was accepted";
  } catch (const InputError& e) {
    EXPECT_EQ(e.where().key, key);
  }
}

TEST(SolidMesh, BadMeshesAreRefused) {
  const SolidMesh good = crooked(2);
  expectRefused("cells", good, [](SolidMesh& m) { m.cells.clear(); });
  expectRefused("nodes[3]", good, [](SolidMesh& m) { m.nodes[3].y = std::nan(""); });
  expectRefused("materials", good, [](SolidMesh& m) { m.materials.clear(); });
  expectRefused("materials[0].mu_Pa", good, [](SolidMesh& m) { m.materials[0].law.mu_Pa = -1; });
  expectRefused("materials[0].density_kg_per_m3", good,
                [](SolidMesh& m) { m.materials[0].density_kg_per_m3 = std::nan(""); });
  expectRefused("material_of", good, [](SolidMesh& m) { m.material_of = {0}; });
  expectRefused("material_of[7]", good, [](SolidMesh& m) { m.material_of = {0, 0, 0, 0, 0, 0, 0, 1}; });
  expectRefused("fibres", good, [](SolidMesh& m) { m.fibres.clear(); });
  expectRefused("fibres", good, [](SolidMesh& m) { m.fibres.pop_back(); });
  expectRefused("fibres[2]", good, [](SolidMesh& m) { m.fibres[2] = {}; });
  expectRefused("cells[1]", good, [](SolidMesh& m) { m.cells[1][4] = 27; });
  expectRefused("cells[1]", good, [](SolidMesh& m) { std::swap(m.cells[1][0], m.cells[1][1]); });
}

}  // namespace
}  // namespace gambeson
