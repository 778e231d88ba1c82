#pragma once
/// Contacts with bodies by the algorithms of Man 2006, section 3.3, in place of solveContacts: its boxes 3 to 5.
///
/// All three are of central differences, x(n+1) = x(n) + dt v(n+1/2), as a step of velocity Verlet is: what a box calls
/// the corrector a_c of the acceleration is here the impulse dt M a_c on the velocity of the half step. They know
/// bodies whose motion is prescribed (Signorini's problem) and no cloth on cloth; the thesis gives box 4 the friction
/// of 3.1.3 and box 5 none. Here all take Coulomb's: of the impulse that would stop the slip, what exceeds mu lambda is
/// cut off (eq. 3.46, 3.52), lambda the normal impulse.
///
/// A body's surface is as far from the cloth as the layer says. What lies within the layer at the start of a step comes
/// out in the relaxation time, as with solveContacts: the boxes, whose cloth never starts inside, would throw it out in
/// one step.

#include <memory>
#include <span>
#include <vector>

#include "core/contact/response.hpp"

namespace gambeson {

/// What a step tells of its cloth and its bodies.
struct MethodStep {
  const SparseRows& WT;                   ///< samples x free points
  std::span<const double> inverse_mass;   ///< of the free points, 0 where held [1/kg]
  std::span<const double> area, density;  ///< of the samples [m^2, kg/m^2]
  std::span<const int> place;             ///< of the samples (solveContacts)
  std::span<const Obstacle> obstacles;
  std::span<const Placement> start, end;  ///< of the obstacles
  std::span<const Vec3> x0;               ///< of the samples, at the start [m]
  const ContactParameters& parameters;
  double dt_s;
};

/// The distance that a row keeps, and the part of it that the cloth between the samples asks for beyond its layer.
struct RowLayer {
  double m = 0, beyond_m = 0;
};
struct LayeredRows {
  std::span<const ContactRow> rows;
  std::span<const RowLayer> layer;
};

/// Scratch of solveByMethod.
struct MethodWork {
  std::vector<int> own, others;  ///< rows of the method and of solveContacts
  struct Part {
    std::vector<ContactRow> rows;
    std::vector<RowLayer> layer;
    std::vector<Vec3> warm, impulses, change, before;
  };
  Part of_own, of_others;
  std::vector<Vec3> velocity;
  // Of the method itself.
  std::vector<ContactRow> smooth;  ///< rows without friction
  std::vector<Vec3> normal_warm, normal, rubbed, rubbed_before, moving;
  std::vector<double> pressed;
  std::vector<int> by_point, first_of_point;
};

/// One of the boxes.
class BodyMethod {
 public:
  virtual ~BodyMethod() = default;
  /// Whether a row is its own: persistent contacts with bodies. Impacts, contours and cloth on cloth never are.
  virtual bool takes(const ContactRow& row) const;
  /// Changes what the row asks for, target and normal, once it has those of a rigid layer (layerUnder).
  virtual void prepare(const MethodStep&, const RowLayer&, ContactRow&) const {}
  /// `velocity`: of the free points without these rows, with their impulses out; `warm`: tractions of the last step,
  /// replaced by the result [N s/m^2]; `impulses`: on the cloth [N s].
  virtual ContactSolve solve(const MethodStep& step, const LayeredRows& rows, std::span<Vec3> velocity,
                             std::span<Vec3> warm, std::span<Vec3> impulses, ContactWork& work,
                             MethodWork& scratch) const = 0;
};

/// That of the parameters; null for ContactMethod::together.
std::unique_ptr<const BodyMethod> bodyMethod(const ContactParameters& parameters);

/// Solves the rows that the method takes by it, and the others by solveContacts. Where there are both they take turns,
/// each with the impulses of the other in place, until those of the method's rows stay (within the tolerance of a
/// solve); the method's have the last word. A sample that is stopped at the surface as an impact has its friction from
/// that alone. Arguments as of solveContacts.
ContactSolve solveByMethod(const BodyMethod& method, const MethodStep& step, const LayeredRows& rows,
                           std::span<Vec3> velocity, std::span<Vec3> warm, std::vector<Vec3>& impulses,
                           ContactWork& work, MethodWork& scratch);

}  // namespace gambeson
