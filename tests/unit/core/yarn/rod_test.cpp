#include "core/yarn/rod.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "core/error.hpp"

namespace gambeson {
namespace {

const RodSection kSection{300, 2.1, 1.7, 0.02, 0.05, 0.11};

Vec3 randomVector(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> in(-size, size);
  const double x = in(random), y = in(random), z = in(random);
  return {x, y, z};
}
Pose randomPose(std::mt19937& random, double place, double turn) {
  return {turned({}, randomVector(random, turn)), randomVector(random, place)};
}
/// Two ends moved by multiples of (dx_a, alpha_a, dx_b, alpha_b).
std::array<Pose, 2> moved(const std::array<Pose, 2>& ends, const std::array<double, 12>& by) {
  std::array<Pose, 2> m = ends;
  for (int k = 0; k < 2; ++k) {
    const double* const d = by.data() + 6 * k;
    m[k].origin += Vec3{d[0], d[1], d[2]};
    m[k].rotation = turned(m[k].rotation, {d[3], d[4], d[5]});
  }
  return m;
}

TEST(Rod, ForceAndTangentAreDerivatives) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 40; ++trial) {
    // Sections up to 140 degrees apart: both branches of the angle, and far out of balance.
    const RodPiece piece = restPiece({{}, {}}, {turned({}, randomVector(random, 0.3)), {0.1, 0.02, 0.01}}, 0.105);
    const Pose first = randomPose(random, 1, 2);
    const std::array<Pose, 2> ends{first, first * Pose{turned({}, randomVector(random, trial % 2 == 0 ? 0.2 : 1.4)),
                                                       Vec3{0.1, 0, 0} + randomVector(random, 0.05)}};
    const RodAnswer here = evaluateRod(kSection, piece, ends[0], ends[1], RodTangent::exact);
    const auto unit = [](int i) { return i % 6 < 3 ? 0.1 : 1.0; };  // lengths beside angles
    constexpr double step = 3e-4;
    const auto energy = [&](int i, double by_i, int j, double by_j) {
      std::array<double, 12> by{};
      by[i] += by_i * step * unit(i);
      by[j] += by_j * step * unit(j);
      const std::array<Pose, 2> m = moved(ends, by);
      return evaluateRod(kSection, piece, m[0], m[1], RodTangent::none).energy_J;
    };
    double force = 0, slope = 0, force_error = 0, slope_error = 0, skew = 0;
    for (int j = 0; j < 12; ++j) {
      const double first_difference =
          (8 * (energy(j, 1, j, 0) - energy(j, -1, j, 0)) - (energy(j, 2, j, 0) - energy(j, -2, j, 0))) / (12 * step);
      force = std::max(force, std::abs(here.gradient[j] * unit(j)));
      force_error = std::max(force_error, std::abs(first_difference - here.gradient[j] * unit(j)));
      for (int i = 0; i <= j; ++i) {
        const auto corners = [&](double a, double b) {
          return energy(j, a, i, b) - energy(j, a, i, -b) - energy(j, -a, i, b) + energy(j, -a, i, -b);
        };
        const double second_difference =
            (64 * corners(1, 1) - 8 * corners(2, 1) - 8 * corners(1, 2) + corners(2, 2)) / (144 * step * step);
        const double exact = here.tangent[12 * i + j] * unit(i) * unit(j);
        slope = std::max(slope, std::abs(exact));
        slope_error = std::max(slope_error, std::abs(second_difference - exact));
        skew = std::max(skew, std::abs(here.tangent[12 * j + i] * unit(i) * unit(j) - exact));
      }
    }
    EXPECT_LT(force_error, 1e-9 * force) << trial;
    EXPECT_LT(slope_error, 1e-7 * slope) << trial;
    EXPECT_LT(skew, 1e-14 * slope) << trial;
  }
}

TEST(Rod, RigidMotionCostsNothing) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 100; ++trial) {
    const Pose a = randomPose(random, 1, 2);
    const Pose b = a * Pose{turned({}, randomVector(random, 1)), Vec3{0.1, 0.01, 0} + randomVector(random, 0.02)};
    const RodPiece piece = restPiece(a, b, 0.11);
    const Pose motion = randomPose(random, 1, 3);
    const RodAnswer rest = evaluateRod(kSection, piece, motion * a, motion * b, RodTangent::exact);
    EXPECT_LT(rest.energy_J, 1e-26);
    double force = 0, stiffness = 0;
    for (int i = 0; i < 12; ++i) force = std::max(force, std::abs(rest.gradient[i]));
    for (double k : rest.tangent) stiffness = std::max(stiffness, std::abs(k));
    EXPECT_LT(force, 1e-14 * stiffness);
    // Also of a strained piece: no net force, no net moment, and the same energy.
    const Pose c = b * Pose{turned({}, {0.2, -0.1, 0.3}), {0.01, 0.02, -0.01}};
    const RodAnswer strained = evaluateRod(kSection, piece, motion * a, motion * c, RodTangent::none);
    EXPECT_NEAR(strained.energy_J, evaluateRod(kSection, piece, a, c, RodTangent::none).energy_J,
                1e-13 * strained.energy_J);
    const std::array<double, 12>& g = strained.gradient;
    const Vec3 f_a{g[0], g[1], g[2]}, f_b{g[6], g[7], g[8]};
    const Vec3 m_a = (motion * a).rotation * Vec3{g[3], g[4], g[5]};
    const Vec3 m_b = (motion * c).rotation * Vec3{g[9], g[10], g[11]};
    const Vec3 net = cross((motion * a).origin, f_a) + m_a + cross((motion * c).origin, f_b) + m_b;
    EXPECT_LT(norm(f_a + f_b), 1e-14 * norm(f_a));
    EXPECT_LT(norm(net), 1e-13 * (norm(f_a) + norm(m_a)));
  }
}

TEST(Rod, EllipsesHaveTheirStiffness) {
  const double E = 84.63e9, G = 0.244e9, a = 0.24e-3, b = 0.16e-3, pi = std::numbers::pi;
  const RodSection s = ellipticSection(E, G, a, b);
  EXPECT_DOUBLE_EQ(s.stretch_N, E * pi * a * b);
  EXPECT_DOUBLE_EQ(s.bending_through_Nm2, E * pi * a * b * b * b / 4);
  EXPECT_DOUBLE_EQ(s.bending_in_plane_Nm2, E * pi * a * a * a * b / 4);
  EXPECT_DOUBLE_EQ(s.torsion_Nm2, G * pi * a * a * a * b * b * b / (a * a + b * b));
  const RodSection round = ellipticSection(E, G, a, a);
  EXPECT_NEAR(round.shear_across_N / (G * pi * a * a), 6.0 / 7, 1e-15) << "Cowper, a circle at nu = 0";
  EXPECT_EQ(round.shear_across_N, round.shear_through_N);
  // A flat section sheared along its width, as a thin strip: 9/10; through its thickness: 3/4.
  const RodSection flat = ellipticSection(E, G, 1, 1e-4);
  EXPECT_NEAR(flat.shear_across_N / (G * pi * 1e-4), 0.9, 1e-6);
  EXPECT_NEAR(flat.shear_through_N / (G * pi * 1e-4), 0.75, 1e-6);
  EXPECT_THROW(ellipticSection(0, G, a, b), InputError);
  EXPECT_THROW(ellipticSection(E, -1, a, b), InputError);
  EXPECT_THROW(ellipticSection(E, G, std::nan(""), b), InputError);
  EXPECT_THROW(ellipticSection(E, G, a, 0), InputError);
}

/// A cantilever of equal pieces, its first section clamped, loaded at its last by a force in space and a moment about
/// the section's own axes: Newton with dense matrices.
class Cantilever {
 public:
  Cantilever(const RodSection& section, std::vector<Pose> sections, double length)
      : section_(section), sections_(std::move(sections)) {
    piece_ = restPiece(sections_[0], sections_[1], length / static_cast<double>(sections_.size() - 1));
  }
  /// The force on the last section, and its moment about the section's axes. Returns the pose of the end.
  Pose bend(const Vec3& force, const Vec3& moment) {
    const int n = static_cast<int>(sections_.size());
    for (int iteration = 0; iteration < 40; ++iteration) {
      Eigen::VectorXd r = Eigen::VectorXd::Zero(6 * n);
      Eigen::MatrixXd K = Eigen::MatrixXd::Zero(6 * n, 6 * n);
      for (int i = 0; i + 1 < n; ++i) {
        const RodAnswer a = evaluateRod(section_, piece_, sections_[i], sections_[i + 1], RodTangent::exact);
        r.segment<12>(6 * i) += Eigen::Map<const Eigen::Matrix<double, 12, 1>>(a.gradient.data());
        K.block<12, 12>(6 * i, 6 * i) += Eigen::Map<const Eigen::Matrix<double, 12, 12>>(a.tangent.data());
      }
      for (int k = 0; k < 3; ++k) r[6 * n - 6 + k] -= force[k], r[6 * n - 3 + k] -= moment[k];
      const int free = 6 * n - 6;
      const Eigen::VectorXd d = K.bottomRightCorner(free, free).partialPivLu().solve(-r.tail(free));
      for (int i = 1; i < n; ++i) {
        const Eigen::VectorXd by = d.segment<6>(6 * i - 6);
        sections_[i].origin += Vec3{by[0], by[1], by[2]};
        sections_[i].rotation = turned(sections_[i].rotation, {by[3], by[4], by[5]});
      }
      if (d.cwiseAbs().maxCoeff() < 1e-12) return sections_.back();
    }
    ADD_FAILURE() << "no equilibrium";
    return sections_.back();
  }

 private:
  RodSection section_;
  RodPiece piece_;
  std::vector<Pose> sections_;
};

Cantilever straight(int pieces, double length) {
  std::vector<Pose> sections(pieces + 1);
  for (int i = 0; i <= pieces; ++i) sections[i].origin.x = length * i / pieces;
  return {kSection, sections, length};
}

/// w = F L³/(3 EI) + F L/GA of small forces; the error falls with the square of the length of a piece.
TEST(Rod, CantileverShearsAndBends) {
  const double L = 1.3, F = 1e-9;
  for (const int way : {1, 2}) {
    const double EI = way == 1 ? kSection.bending_in_plane_Nm2 : kSection.bending_through_Nm2;
    const double GA = way == 1 ? kSection.shear_across_N : kSection.shear_through_N;
    const double exact = F * L * L * L / (3 * EI) + F * L / GA;
    double before = 0;
    for (const int pieces : {4, 8, 16}) {
      Vec3 force{};
      force[way] = F;
      const double error = std::abs(straight(pieces, L).bend(force, {}).origin[way] - exact) / exact;
      if (before > 0) {
        EXPECT_NEAR(before / error, 4, 0.05) << way << " " << pieces;
      }
      before = error;
    }
    EXPECT_LT(before, 1e-3);
  }
}

/// An end moment bends it to a full circle, whatever the number of pieces; a torque turns its end by M L/GJ; a tension
/// stretches it by F/EA.
TEST(Rod, UniformStatesAreExact) {
  const double L = 0.8;
  for (const int pieces : {8, 13}) {
    Cantilever rod = straight(pieces, L);
    Pose end;
    for (int step = 1; step <= 10; ++step)
      end = rod.bend({}, {0, kSection.bending_through_Nm2 * 2 * std::numbers::pi / L * step / 10, 0});
    EXPECT_LT(norm(end.origin), 1e-9 * L);
    EXPECT_LT(norm(end.rotation.a - Vec3{1, 0, 0}), 1e-9);
    const Pose twisted = straight(pieces, L).bend({}, {0.5 * kSection.torsion_Nm2 / L, 0, 0});
    EXPECT_LT(norm(twisted.rotation.b - Vec3{0, std::cos(0.5), std::sin(0.5)}), 1e-12);
    EXPECT_LT(norm(twisted.origin - Vec3{L, 0, 0}), 1e-12);
    const Pose stretched = straight(pieces, L).bend({0.1 * kSection.stretch_N, 0, 0}, {});
    EXPECT_LT(norm(stretched.origin - Vec3{1.1 * L, 0, 0}), 1e-12);
  }
}

/// Bathe's bend of 45 degrees, radius 100, under 600 across its plane: tip at (47.23, 15.79, 53.37) (Simo and Vu-Quoc
/// 1986, Computer Methods in Applied Mechanics and Engineering 58, 79; E 1e7, nu 0, a unit square).
TEST(Rod, BentCantileverLeavesItsPlane) {
  const double R = 100, E = 1e7, quarter = std::numbers::pi / 4;
  const RodSection square{E, 0.5 * E, 0.5 * E, 0.5 * E / 6, E / 12, E / 12};
  constexpr int n = 16;
  std::vector<Pose> x(n + 1);
  for (int i = 0; i <= n; ++i) {
    const double t = quarter * i / n;
    x[i] = {rotationAbout({0, 0, 1}, -t), {R * std::sin(t), R * (std::cos(t) - 1), 0}};
  }
  Cantilever rod(square, x, R * quarter);
  Pose end;
  for (int step = 1; step <= 60; ++step) end = rod.bend({0, 0, 10.0 * step}, {});
  EXPECT_NEAR(end.origin.x, 47.23, 0.2);
  EXPECT_NEAR(-end.origin.y, 15.79, 0.2);
  EXPECT_NEAR(end.origin.z, 53.37, 0.2);
}

}  // namespace
}  // namespace gambeson
