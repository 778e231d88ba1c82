#pragma once
/// NURBS of any degree: knots, basis functions and surfaces (Zheng 2013, section 2.1; Piegl and Tiller, The NURBS
/// Book).

#include <array>
#include <span>
#include <vector>

#include "core/math/vec.hpp"

namespace gambeson {

/// A non-decreasing knot vector of a given degree. It has count() basis functions, valid on [front(), back()].
struct KnotVector {
  int degree = 2;
  std::vector<double> knots;

  int count() const { return static_cast<int>(knots.size()) - degree - 1; }
  double front() const { return knots[degree]; }
  double back() const { return knots[knots.size() - 1 - degree]; }
  bool operator==(const KnotVector&) const = default;
};

/// Open uniform knots on [0, 1] with `cells` cells.
KnotVector uniformKnots(int degree, int cells);
/// The distinct knots of [front, back]: the ends of the non-empty cells.
std::vector<double> breakpoints(const KnotVector& knots);
/// Greville points, the averages of `degree` consecutive inner knots, one per basis function.
std::vector<double> grevillePoints(const KnotVector& knots);
/// The index s with knots[s] <= u < knots[s + 1] (the last non-empty cell at the end); the functions s - p .. s are
/// non-zero.
int findSpan(const KnotVector& knots, double u);
/// Basis functions s - p .. s and their derivatives up to `order` at u: out[d * (p + 1) + i], zero for d > p.
/// Piegl and Tiller, algorithm A2.3.
void basisDerivatives(const KnotVector& knots, int span, double u, int order, std::span<double> out);

/// A tensor-product surface, Zheng 2013, eq. 2.4. Control point (i, j) is points[i + u.count() * j].
struct NurbsPatch {
  KnotVector u, v;
  std::vector<Vec3> points;
  std::vector<double> weights;

  int index(int i, int j) const { return i + u.count() * j; }
  int size() const { return u.count() * v.count(); }
};

/// Throws InputError (key = what is wrong) unless counts match, knots ascend, weights are positive and all is finite.
void validate(const NurbsPatch& patch);

/// Rational basis functions of a patch at (u, v), and derivatives up to order 2: values[d][k] belongs to the control
/// point columns[k], with d = 0: N, 1: N,u, 2: N,v, 3: N,uu, 4: N,vv, 5: N,uv.
struct SurfaceBasis {
  std::vector<int> columns;
  std::array<std::vector<double>, 6> values;
};
SurfaceBasis surfaceBasis(const NurbsPatch& patch, double u, double v);

/// x, x,u, x,v, x,uu, x,vv, x,uv at (u, v).
std::array<Vec3, 6> surfaceDerivatives(const NurbsPatch& patch, double u, double v);

enum class Direction { u, v };
/// Boehm's knot insertion, `times` times; geometry and parameterisation stay exact. The knot lies strictly inside the
/// range and its multiplicity may not exceed the degree; InputError otherwise.
NurbsPatch insertKnot(const NurbsPatch& patch, Direction direction, double knot, int times = 1);
/// The same for a list of knots (repeated entries repeat).
NurbsPatch insertKnots(const NurbsPatch& patch, Direction direction, std::span<const double> knots);
/// Degree raised by `by`; geometry and parameterisation stay exact, continuity at inner knots is kept. The knots of the
/// result are clamped at both ends.
NurbsPatch elevateDegree(const NurbsPatch& patch, Direction direction, int by = 1);

}  // namespace gambeson
