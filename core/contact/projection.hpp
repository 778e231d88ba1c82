#pragma once
/// Contact by projection onto implicit surfaces (Man 2006, eq. 3.60, 3.61 and box 5).

#include "core/contact/ellipsoid_foot.hpp"
#include "core/contact/method.hpp"

namespace gambeson {

/// f(p) = sum_i (p_i/e_i)^2 - 1 (eq. 3.61): negative inside.
inline double ellipsoidFunction(const EllipsoidMetric& ellipsoid, const Vec3& p) {
  const Vec3& w = ellipsoid.inverse;
  return norm2(Vec3{p.x * w.x, p.y * w.y, p.z * w.z}) - 1;
}

/// Where the line from p along the gradient of f meets the ellipsoid next to p, as a distance along that gradient
/// (positive out of it) [m]; the surface point is p + distance * direction.
struct GradientFoot {
  double distance_m = 0;
  Vec3 direction;  ///< unit
};

/// Projection "along the gradient at the penetrating point" (Man 2006, section 3.3.3): the root k next to 0 of
/// f(p + k grad f) = 0, a quadratic. From inside there is always one; on the arm of section 5.3 it is off the closest
/// point by 20 um from a depth of 1 mm, as the square of the depth. Of a point outside whose line misses the ellipsoid,
/// the end of the line next to it. From the centre, which has no gradient, along a shortest axis.
GradientFoot footAlongGradient(const EllipsoidMetric& ellipsoid, const Vec3& p);

/// Box 5: a node whose trial position x* is inside of the body as it stands at the end of the step is put on its
/// surface,
///   d_c = proj(x*) - x*,   lambda = M d_c / dt,
/// and there is no system to solve, as each sample is a point of the cloth with a mass of its own. Bodies are
/// ellipsoids or flat (a plane, along its normal).
///
/// With a layer the surface is that of the ellipsoid whose semi-axes are the layer longer: the layer away at the ends
/// of its axes, and elsewhere at least c = 2 sqrt(ab)/(a + b) of it, a and b the longest and the shortest semi-axis
/// (0.86 on the arm). What the cloth between its points asks for beyond its layer (findClearances) makes them 1/c of
/// that longer. These clearances have a tenth of the layer to spare: triangles stay out of bodies up to 2.5 times as
/// long as wide (c >= 0.9), and on longer ones may dip into the flanks by 0.9 - c of the layer. The row's normal is
/// that of this surface.
///
/// Friction (the thesis gives none): after a projection the slip over the touched point of the body is stopped as far
/// as mu lambda allows; then the node is put on the surface again, inwards too where friction has carried it off, and
/// so on, until it stays. A node in several bodies is projected onto one after the other.
class Projection : public BodyMethod {
 public:
  bool takes(const ContactRow& row) const override;
  void prepare(const MethodStep& step, const RowLayer& layer, ContactRow& row) const override;
  ContactSolve solve(const MethodStep& step, const LayeredRows& rows, std::span<Vec3> velocity, std::span<Vec3> warm,
                     std::span<Vec3> impulses, ContactWork& work, MethodWork& scratch) const override;
};

/// Throws InputError (key "contact.method") unless every sample is a point of the cloth, as in cloth of triangles, and
/// no obstacle is other than an ellipsoid or flat.
void checkProjection(const SparseRows& WT, std::span<const Obstacle> obstacles);

}  // namespace gambeson
