#pragma once
/// Exact answers about moving points, in integer arithmetic (GMP): the reference for core/contact/certified_impact.hpp.
/// Shares nothing with it: roots of the coplanarity cubic are isolated by Sturm sequences, and conditions decided by
/// the signs of polynomials at these algebraic numbers.

#include <gmpxx.h>

#include <array>
#include <vector>

#include "core/math/vec.hpp"

namespace gambeson::exact {

using FourPoints = std::array<Vec3, 4>;
using Poly = std::vector<mpz_class>;  ///< ascending powers, no leading zero; empty is the zero polynomial

/// n / 2^k
struct Dyadic {
  mpz_class n;
  unsigned k = 0;
};

/// A real root in [0, 1]: exactly lo where lo == hi, else the only root of `poly` (square-free) in the open interval.
struct Root {
  Poly poly;
  Dyadic lo, hi;
  bool exact = false;
};

/// All impacts, or in a motion that stays in one plane at least the first: empty where the pair never touches.
struct Impacts {
  std::vector<Root> times;
  bool hit() const { return !times.empty(); }
  /// Is there an impact strictly before t? Exact.
  bool before(double t) const;
  double firstAbout() const;  ///< to 1e-12, for messages
};

/// (p, a, b, c) and (a, b, c, d); every finite double is taken as it is.
Impacts pointTriangle(const FourPoints& x0, const FourPoints& x1);
Impacts edgeEdge(const FourPoints& x0, const FourPoints& x1);

/// Is the distance of the two points with parameters (u, v) at time t at most `distance`? Exact.
bool pointTriangleWithin(const FourPoints& x0, const FourPoints& x1, double t, double u, double v, double distance);
bool edgeEdgeWithin(const FourPoints& x0, const FourPoints& x1, double t, double u, double v, double distance);

/// Real roots in [0, 1], ascending.
std::vector<Root> rootsInUnit(const Poly& f);
/// Sign of h at the root; refines the root's interval.
int signAt(const Poly& h, Root& root);

}  // namespace gambeson::exact
