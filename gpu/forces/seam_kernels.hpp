#pragma once
/// Rotational springs along seams and springs across weak ones, a thread each
/// (core/cloth/draft/seams.hpp, core/cloth/shell/weak_seam.hpp).

#include <vector>

#include "gpu/forces/angle.hpp"
#include "gpu/forces/point4.hpp"

namespace gambeson::gpu {

/// The points of hinges and gaps; of item i they stand in [first[i], first[i + 1]).
struct FlatSeams {
  std::vector<int> first_hinge{0}, hinge_column;
  std::vector<double> hinge_rows;     ///< t, a, b of each column
  std::vector<double> hinge_numbers;  ///< stiffness times length [N m/rad], angle at rest [rad] of each hinge
  std::vector<int> first_gap{0}, gap_column;
  std::vector<double> gap_row, gap_stiffness;
  int hinge_slot = 0, gap_slot = 0;  ///< first
  int hinges() const { return static_cast<int>(first_hinge.size()) - 1; }
  int gaps() const { return static_cast<int>(first_gap.size()) - 1; }
};

/// The formulas of hingeAngle (core/cloth/draft/seams.cpp).
struct HingeForces {
  const int *first, *column;
  const double *rows, *numbers;
  const Point4* position;
  Vec3* slot;  ///< of the first hinge
  GAMBESON_HD void operator()(int i) const {
    Vec3 t{}, a{}, b{};
    for (int k = first[i]; k < first[i + 1]; ++k) {
      const Vec3 x = vec(position[column[k]]);
      t += rows[3 * k] * x;
      a += rows[3 * k + 1] * x;
      b += rows[3 * k + 2] * x;
    }
    const double length = norm(t);
    const Vec3 e = t / length;
    const double a_along = dot(a, e), b_along = dot(b, e);
    const Vec3 a_perp = a - a_along * e, b_perp = b - b_along * e;
    const double turn = angleOf(dot(cross(-a_perp, b_perp), e), dot(-a_perp, b_perp)) - numbers[2 * i + 1];
    const Vec3 na = cross(e, a_perp) / norm2(a_perp), nb = cross(e, b_perp) / norm2(b_perp);
    const double ca = a_along / length, cb = b_along / length, moment = numbers[2 * i] * turn;
    for (int k = first[i]; k < first[i + 1]; ++k)
      slot[k] = moment * ((rows[3 * k + 2] - cb * rows[3 * k]) * nb - (rows[3 * k + 1] - ca * rows[3 * k]) * na);
  }
};

/// f = - sum of the slots of seams, which are the last, at any control point.
struct GatherSeams {
  const int *first, *slot;
  int first_of_seams;
  const Vec3* value;
  Point4* force;
  GAMBESON_HD void operator()(int i) const {
    Vec3 sum{};
    for (int k = first[i]; k < first[i + 1]; ++k)
      if (slot[k] >= first_of_seams) sum += value[slot[k]];
    force[i] = {-sum.x, -sum.y, -sum.z, 0.0};
  }
};

struct GapForces {
  const int *first, *column;
  const double *row, *stiffness;
  const Point4* position;
  Vec3* slot;  ///< of the first gap
  GAMBESON_HD void operator()(int i) const {
    Vec3 gap{};
    for (int k = first[i]; k < first[i + 1]; ++k) gap += row[k] * vec(position[column[k]]);
    for (int k = first[i]; k < first[i + 1]; ++k) slot[k] = (stiffness[i] * row[k]) * gap;
  }
};

}  // namespace gambeson::gpu
