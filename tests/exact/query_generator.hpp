#pragma once
/// Random queries about four moving points, most of them degenerate: what breaks tests that are not certified.

#include <array>
#include <cmath>
#include <random>

#include "core/math/vec.hpp"

namespace gambeson::exact {

struct MovingPoints {
  std::array<Vec3, 4> x0, x1;
};

/// Kinds of queries; all but the first two have their degeneracy exactly, in dyadic coordinates of few bits.
enum QueryKind {
  kRandom,          ///< uniform in a cube
  kNear,            ///< cloth-like: near each other, small motion common to all
  kGrid,            ///< coordinates among few integers: parallel, coplanar, shared, collapsed, at rest, all mixed
  kInPlane,         ///< motion in a tilted plane
  kMeets,           ///< meets exactly, at a dyadic time and place
  kMeetsPerturbed,  ///< the same, then some coordinates moved by an ulp
  kAtRest,          ///< no motion, the nearest points on each other to rounding
  kParallel,        ///< parallel edges, or a triangle without area
  kShared,          ///< two corners in one place, at the start, the end or always
  kFar,             ///< tiny, far from the origin: differences of few ulps
  kTurning,         ///< quick turn with a point close to the surface
  kTouchesAtEnd,    ///< meets exactly at time 0 or 1, from outside
  kQueryKinds
};

class QueryGenerator {
 public:
  /// edges: (a, b; c, d), otherwise (p; a, b, c).
  QueryGenerator(std::uint64_t seed, bool edges) : rng_(seed), edges_(edges) {}

  MovingPoints operator()(QueryKind kind) {
    MovingPoints q;
    switch (kind) {
      case kNear:
        near(q);
        break;
      case kGrid:
        grid(q, 2);
        break;
      case kInPlane:
        inPlane(q);
        break;
      case kMeets:
        meets(q, dyadic(6));
        break;
      case kMeetsPerturbed:
        meets(q, dyadic(6)), perturb(q);
        break;
      case kAtRest:
        atRest(q);
        break;
      case kParallel:
        parallel(q);
        break;
      case kShared:
        shared(q);
        break;
      case kFar:
        far(q);
        break;
      case kTurning:
        turning(q);
        break;
      case kTouchesAtEnd:
        meets(q, below(2));
        break;
      default:
        for (int i = 0; i < 4; ++i) q.x0[i] = uniform(), q.x1[i] = uniform();
    }
    return q;
  }

 private:
  int below(int n) { return static_cast<int>(rng_() % static_cast<unsigned>(n)); }
  double real(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(rng_); }
  Vec3 uniform() { return {real(-1, 1), real(-1, 1), real(-1, 1)}; }
  /// k / 2^bits in [0, 1]
  double dyadic(int bits) { return std::ldexp(below((1 << bits) + 1), -bits); }
  Vec3 lattice(int range, int bits) {
    const auto c = [&] { return std::ldexp(below(2 * range + 1) - range, -bits); };
    return {c(), c(), c()};
  }
  static Vec3 mix(const Vec3& a, const Vec3& b, double t) { return (1 - t) * a + t * b; }

  void near(MovingPoints& q) {
    const Vec3 drift = 0.01 * uniform();
    q.x0 = {Vec3{real(0, 1), real(0, 1), real(-0.05, 0.05)}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    if (edges_)
      q.x0 = {
          Vec3{0, 0, 0}, {1, real(0, 1), 0}, {real(0, 1), 0, real(-0.05, 0.05)}, {real(0, 1), 1, real(-0.05, 0.05)}};
    const Mat3 R = rotationAbout(normalized(uniform()), real(0, 6));
    for (int i = 0; i < 4; ++i) {
      q.x0[i] = R * (q.x0[i] + 0.02 * uniform());
      q.x1[i] = q.x0[i] + drift + 0.05 * uniform();
    }
  }

  void grid(MovingPoints& q, int range) {
    for (int i = 0; i < 4; ++i) {
      q.x0[i] = lattice(range, 1);
      q.x1[i] = below(3) == 0 ? q.x0[i] : lattice(range, 1);
    }
  }

  void inPlane(MovingPoints& q) {
    const Vec3 o = lattice(64, 3), e = lattice(64, 4), f = lattice(64, 4);
    const auto point = [&] { return o + std::ldexp(below(257) - 128, -7) * e + std::ldexp(below(257) - 128, -7) * f; };
    for (int i = 0; i < 4; ++i) {
      q.x0[i] = point();
      q.x1[i] = below(4) == 0 ? q.x0[i] : point();
    }
    const Vec3 drift = lattice(64, 3);
    for (Vec3& x : q.x1) x += drift;
  }

  /// The point p, or corner d of the second edge, is put so that the pair meets at time t: all in few bits, so exact.
  void meets(MovingPoints& q, double t) {
    for (int i = 0; i < 4; ++i) q.x0[i] = lattice(2048, 10), q.x1[i] = lattice(2048, 10);
    const double u = dyadic(4), v = (edges_ ? 1 : 1 - u) * dyadic(3);
    const auto at = [&](int i) { return mix(q.x0[i], q.x1[i], t); };
    const int moved = edges_ ? 3 : 0;
    Vec3 goal;
    if (edges_) {
      // A point of ab, and d beyond it as seen from c.
      const Vec3 m = mix(at(0), at(1), u);
      goal = m + std::ldexp(below(5), -2) * (m - at(2));
    } else {
      goal = at(1) + u * (at(2) - at(1)) + v * (at(3) - at(1));
    }
    // From goal - t w to goal + (1 - t) w.
    const Vec3 w = lattice(2048, 10);
    q.x0[moved] = goal - t * w;
    q.x1[moved] = goal + (1 - t) * w;
  }

  void perturb(MovingPoints& q) {
    for (int k = below(3); k >= 0; --k) {
      double& c = (below(2) ? q.x0 : q.x1)[below(4)][below(3)];
      c = std::nextafter(c, below(2) ? INFINITY : -INFINITY);
    }
  }

  void atRest(MovingPoints& q) {
    for (Vec3& x : q.x0) x = uniform();
    const double u = real(0, 1), v = real(0, 1 - u);
    if (edges_) {
      const Vec3 m = mix(q.x0[0], q.x0[1], u);
      q.x0[3] = m + real(0, 2) * (m - q.x0[2]);
    } else {
      q.x0[0] = q.x0[1] + u * (q.x0[2] - q.x0[1]) + v * (q.x0[3] - q.x0[1]);
    }
    q.x1 = q.x0;
    if (below(2)) {
      const Vec3 drift = lattice(64, 4);
      for (Vec3& x : q.x1) x += drift;
    }
  }

  void parallel(MovingPoints& q) {
    const Vec3 e = lattice(16, 3);
    const int a = edges_ ? 0 : 1, b = edges_ ? 2 : below(2) ? 1 : 2;
    for (auto* x : {&q.x0, &q.x1}) {
      for (Vec3& p : *x) p = lattice(16, 3);
      (*x)[a + 1] = (*x)[a] + std::ldexp(below(17) - 8, -2) * e;
      (*x)[b + 1] = (*x)[b] + std::ldexp(below(17) - 8, -2) * e;
    }
    if (below(3) == 0) q.x1 = q.x0;
    if (below(3) == 0) meetAtMiddle(q);
  }
  /// The first primitive is moved (rigidly) so that a corner of each coincide half way.
  void meetAtMiddle(MovingPoints& q) {
    const int i = edges_ ? below(2) : 0, j = edges_ ? 2 + below(2) : 1 + below(3);
    const Vec3 shift = mix(q.x0[j], q.x1[j], 0.5) - mix(q.x0[i], q.x1[i], 0.5);
    for (int k = 0; k < (edges_ ? 2 : 1); ++k) q.x0[k] += shift, q.x1[k] += shift;
  }

  void shared(MovingPoints& q) {
    for (int i = 0; i < 4; ++i) q.x0[i] = uniform(), q.x1[i] = uniform();
    const int i = edges_ ? below(2) : 0, j = edges_ ? 2 + below(2) : 1 + below(3), when = below(3);
    if (when != 0) q.x0[i] = q.x0[j];
    if (when != 1) q.x1[i] = q.x1[j];
    if (below(4) == 0) perturb(q);
  }

  void far(MovingPoints& q) {
    grid(q, 3);
    const Vec3 o = std::ldexp(1, below(30)) * lattice(8, 3);
    const double scale = std::ldexp(1, -below(20) - 10);
    for (int i = 0; i < 4; ++i) q.x0[i] = o + scale * q.x0[i], q.x1[i] = o + scale * q.x1[i];
  }

  void turning(MovingPoints& q) {
    near(q);
    const Mat3 R = rotationAbout(normalized(uniform()), real(0, 2.5));
    const double u = real(0, 1), v = real(0, 1 - u), h0 = std::pow(10, real(-12, -2));
    for (auto* x : {&q.x0, &q.x1}) {
      auto& y = *x;
      const double h = below(4) ? h0 : -h0;  // most stay on their side
      if (edges_) {
        const Vec3 m = mix(y[0], y[1], u), n = cross(y[1] - y[0], y[2] - y[0]);
        y[3] = m + real(0.1, 2) * (m - y[2]) + h * n;
      } else {
        y[0] = y[1] + u * (y[2] - y[1]) + v * (y[3] - y[1]) + h * cross(y[2] - y[1], y[3] - y[1]);
      }
    }
    for (Vec3& x : q.x1) x = R * x;
  }

  std::mt19937_64 rng_;
  bool edges_;
};

}  // namespace gambeson::exact
