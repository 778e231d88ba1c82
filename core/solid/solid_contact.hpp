#pragma once
/// Contact of nodes with surfaces of facets: what presses and rubs at given positions (Man 2006, sections 3.1 and 3.4).
///
/// A node that lies over a facet at xi, with gap g (> 0: passed), is pushed by the pressure t_N and dragged by the
/// traction t_a, its components in the convected frame T_a of the facet at rest, M_ab = T_a . T_b there:
///   t_N = <lambda_N + eps_N g>                                                      (3.69)
///   t*_a = lambda_a + eps_T M_ab (xi_b - xi_b,n),  |t| = sqrt(t_a M^ab t_b)         (3.74)
///   t_a = t*_a where |t*| <= bound, else bound t*_a/|t*|                            (3.75)
///   virtual work of the node's area A: A (t_N dg + t_a dxi_a)                       (3.73)
/// xi_n is where the node lay over the same facet when the step began, and M is taken there, so that t*_a is the
/// gradient of an energy. lambda are multipliers, constant while positions are solved for; without them it is the
/// penalty method (3.27, 3.50-3.52). The bound is
///   mu t_N      coupled      box 6: the tangent of what slips is not symmetric
///   mu lambda_N symmetrised  box 7 (Laursen): symmetric; a contact that is new does not rub in its first pass.
///
/// A node that slides on over an edge is pushed by the facet on which it is, and rubs in the frame of the facet on
/// which the step began, continued beyond its edges. In a groove it is pushed by several facets, by each with its own
/// pressure (core/solid/facet_surface.hpp).
///
/// Fails: only nodes of one side are kept out of the facets of the other. The facets' own nodes may pass, and a uniform
/// pressure is not passed on exactly between meshes that do not match (no one-sided contact of nodes passes the contact
/// patch test). Both sides in turn, with half of the area each, mend the first and not the second; where nodes meet
/// nodes they are more conditions than there are motions, and multipliers settle slowly. A surface does not touch
/// itself.

#include <span>
#include <vector>

#include "core/solid/facet_projection.hpp"
#include "core/solid/facet_surface.hpp"

namespace gambeson {

/// How far from its middle a facet holds a node, or is rubbed by one [half widths]: over the next facet.
inline constexpr double kFacetReach = 3;

/// Nodes that must not pass facets.
struct ContactSide {
  std::vector<int> nodes;
  std::vector<double> areas_m2;  ///< of each node at rest
  FacetSurface surface;
};

/// The nodes of a surface against another. `share` of their areas: 1, or 1/2 where the other side is asked too.
ContactSide contactSide(std::span<const Facet> of_nodes, const FacetSurface& against, std::span<const Vec3> rest,
                        double share = 1);

enum class FrictionBound { coupled, symmetrised };

struct SolidContactLaw {
  double normal_Pa_per_m = 0;      ///< eps_N > 0
  double tangential_Pa_per_m = 0;  ///< eps_T > 0, where there is friction
  double friction = 0;             ///< mu >= 0
  FrictionBound bound = FrictionBound::symmetrised;
  TouchOptions touch;
};

/// The multipliers of a node on a facet.
struct ContactMultipliers {
  int side = 0, slave = 0;  ///< side, and which of its nodes
  int facet = 0;            ///< on which it is
  int rub_facet = 0;        ///< in whose frame the traction is counted
  double pressure_Pa = 0;
  Vec2 traction_N_per_m;  ///< lambda_a
};

/// A node pressed by a facet.
struct ContactPoint {
  int side = 0, slave = 0, node = 0, facet = 0;
  double area_m2 = 0;
  bool known = false;                         ///< it has multipliers; else it is new
  double multiplier_Pa = 0, pressure_Pa = 0;  ///< lambda_N, t_N
  FacetProjection over;                       ///< the facet, gap and all

  bool rubs = false;  ///< the rest is only then there
  int rub_facet = 0;
  bool slips = false;
  double bound_Pa = 0, trial_Pa = 0;                         ///< trial: |t*|
  Vec2 multiplier_N_per_m, trial_N_per_m, traction_N_per_m;  ///< lambda_a, t*_a, t_a
  std::array<double, 3> metric_m2{};                         ///< M_11, M_22, M_12
  FacetProjection rub_over;

  /// |t| [Pa].
  double tractionSize() const { return slips ? bound_Pa : trial_Pa; }
};

/// A part of the tangent [N/m]: rows and columns are components of these nodes.
struct ContactBlock {
  std::array<int, 5> rows, columns;
  ProjectionMatrix values{};
};

/// Constant after it is built. The same bits for any number of threads.
class SolidContact {
 public:
  /// Throws InputError where a number is out of its range, or a node of a side is one of its facets' too.
  SolidContact(std::vector<ContactSide> sides, const SolidContactLaw& law, std::vector<Vec3> rest);

  const std::vector<ContactSide>& sides() const { return sides_; }
  const SolidContactLaw& law() const { return law_; }

  /// What presses at the positions x, in the order of sides and nodes. `start`: positions when the step began. Points
  /// that neither press nor rub are left out, unless `all`. A point is not a number where the node slid farther than
  /// over the next facet since then: take smaller steps.
  std::vector<ContactPoint> points(std::span<const Vec3> x, std::span<const Vec3> start,
                                   std::span<const ContactMultipliers> multipliers, bool all = false) const;
  /// f += A (t_N dg/dx + t_a dxi_a/dx), as internal forces.
  void addForce(std::span<const ContactPoint> points, std::span<Vec3> f) const;
  /// What the penalties store [J]: the sum of A (t_N² - lambda_N²)/(2 eps_N). Without friction its gradient is the
  /// force, with the multipliers held.
  double energy(std::span<const ContactPoint> points) const;
  /// What rubs turns into heat in the step that ended here [J]: the sum of A t_a times what has slipped,
  /// M^ab (t*_b - t_b)/eps_T, which is A |t| (|t*| - |t|)/eps_T; never negative. Where augmentations have settled,
  /// lambda = t, all that has slid since the step began has slipped.
  double lost(std::span<const ContactPoint> points) const;
  /// What the springs along facets hold [J]: the sum of A |t|²/(2 eps_T). They give way for good with penalties alone;
  /// where augmentations have settled what sticks has not moved, and there is no such energy.
  double held(std::span<const ContactPoint> points) const;
  /// The exact slope of that force in x.
  std::vector<ContactBlock> tangent(std::span<const Vec3> x, std::span<const ContactPoint> points) const;

  /// Multipliers for the next pass: lambda = t; of box 7 t* returned to mu t_N (3.79).
  std::vector<ContactMultipliers> augmented(std::span<const ContactPoint> points) const;
  /// Where nodes keep facets (TouchOptions::keep): those of these multipliers go on to what is nearest at x, with the
  /// pressure of the facet that is left; a second facet of a groove comes in with none, or, unless they `share`, gives
  /// its pressure to the foremost. Returns how many have changed.
  int moveOn(std::span<const Vec3> x, std::vector<ContactMultipliers>& multipliers, bool share) const;
  /// Multipliers for the next step, in the frames of the facets on which the nodes are at x.
  std::vector<ContactMultipliers> settled(std::span<const Vec3> x, std::vector<ContactMultipliers> multipliers) const;

  std::array<int, 5> nodesOf(int side, int node, int facet) const;
  FacetCorners cornersOf(int side, int facet, std::span<const Vec3> x) const {
    return sides_[side].surface.corners(facet, x);
  }

 private:
  void rub(std::span<const Vec3> x, std::span<const Vec3> start, ContactPoint& point,
           const ContactMultipliers* multipliers) const;

  std::vector<ContactSide> sides_;
  SolidContactLaw law_;
  std::vector<Vec3> rest_;
  std::vector<int> first_slave_;  ///< of each side
};

/// |t| = sqrt(t_a M^ab t_b) [Pa], M = (M_11, M_22, M_12).
double sizeOfTraction(const Vec2& traction_N_per_m, const std::array<double, 3>& metric_m2);

/// Which multipliers each touch of a node takes: that on the same facet, else one that has lost its facet, in their
/// order; -1: it is new.
std::vector<int> matchTouches(std::span<const FacetTouch> touches, std::span<const ContactMultipliers> multipliers);

}  // namespace gambeson
