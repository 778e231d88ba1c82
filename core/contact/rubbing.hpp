#pragma once
/// Coulomb friction of contacts whose normal impulses are given. Internal to the methods of contact.

#include "core/contact/method.hpp"

namespace gambeson {

/// Finds the tangential impulses that stop the slip, cut to mu lambda of the given normal impulses lambda (Man 2006,
/// eq. 3.46; a return map of eq. 3.52 whose trial is the impulse that sticks, so that nothing slips but at the bound).
/// Rows that share points are taken one after the other until none changes a velocity by more than 1e-4 of a solve's
/// tolerance: with bounds that stay, a convex problem.
/// `pressed`: lambda [N s]; `rubbed`: where it starts, and the result [N s]; `velocity`: of the free points with the
/// normal impulses and without these, with them out [m/s].
ContactSolve rub(const MethodStep& step, std::span<const ContactRow> rows, std::span<const double> pressed,
                 std::span<Vec3> rubbed, std::span<Vec3> velocity, ContactWork& work);

/// Coulomb's coefficient of a row.
inline double frictionOf(const MethodStep& step, const ContactRow& row) {
  return row.slippery ? 0 : step.parameters.frictionOf(row).kinetic;
}

/// Part of a vector across a unit normal.
inline Vec3 across(const Vec3& v, const Vec3& normal) { return v - dot(v, normal) * normal; }

/// A tangential impulse cut to its bound.
inline Vec3 cutTo(double bound, const Vec3& tangential) {
  const double size = norm(tangential);
  return size > bound ? (bound / size) * tangential : tangential;
}

/// Sets impulses and tractions of rows from their parts, and adds to the velocities what the impulses do.
void applyImpulses(const MethodStep& step, std::span<const ContactRow> rows, std::span<const Vec3> normal,
                   std::span<const Vec3> rubbed, std::span<Vec3> velocity, std::span<Vec3> traction,
                   std::span<Vec3> impulses, ContactWork& work);

}  // namespace gambeson
