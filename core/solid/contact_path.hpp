#pragma once
/// Load steps of solids that touch, by each of Man's ways to enforce contact (2006, sections 3.1.2 and 3.4).
///
///   penalty      t_N = eps_N <g>: passes by t_N/eps_N (3.27); friction by 3.50-3.52, coupled
///   multipliers  g = 0 for a set of pairs that is tried (3.29, 3.30): what pulls leaves it, what has passed enters,
///                until nothing changes; without friction
///   augmented    boxes 6 and 7: Newton with multipliers held, then lambda = t, and again until they stay. Which of the
///                boxes is SolidContactLaw::bound's to say. With friction at least two augmentations: new contacts of
///                box 7 rub from the second pass on.
///
/// Where nodes keep facets (TouchOptions::keep), two of a groove share a node; an augmented step that does not settle so
/// is made again with one facet for each. A step that fails is halved. Supports must hold each body, at least until contact presses: what contact alone holds
/// has a singular tangent before the first touch, and the step says so.

#include <functional>
#include <string>
#include <vector>

#include "core/solid/contact_system.hpp"

namespace gambeson {

enum class SolidContactMethod { penalty, multipliers, augmented };

struct ContactPathOptions {
  SolidContactMethod method = SolidContactMethod::augmented;
  int steps = 10;  ///< equal load steps from 0 to 1; one that fails is halved, at most `halvings` times
  int halvings = 6;
  int iterations = 30;      ///< of Newton, for a pass
  double tolerance = 1e-9;  ///< of the residual against the forces that balance
  int passes = 40;          ///< augmentations, or sets tried, of a step
  double raise = 0;         ///< ContactNewton's: for bodies that nothing but contact holds
  /// Augmented: multipliers may change by this part of the largest pressure in the last pass ...
  double change = 1e-6;
  double deepest_m = 0;  ///< ... and no node may have passed by more; > 0
};

/// A converged load.
struct ContactState {
  double factor = 0;
  std::vector<double> y;
  std::vector<ContactMultipliers> multipliers;  ///< what the next step starts from
};

struct ContactStep {
  ContactState state;
  std::vector<ContactPoint> points;  ///< what pressed in the last pass
  int passes = 0, iterations = 0;    ///< of all passes
  std::vector<double> residuals;     ///< relative, of the last pass that needed more than one iteration
  double residual = 0;               ///< relative, of the last pass
  bool rounded = false;              ///< rounding kept it above the tolerance
  bool stable = true;                ///< the last tangent that was factorised, if it is symmetric, was positive definite
  double deepest_m = 0;
};

struct ContactReport {
  bool reached = false;
  std::string why;  ///< else: which load and what failed
  int steps = 0;
};

/// Follows the load from the state to factor 1; `observe` sees each converged step and may end the path by false.
/// Throws InputError where options are out of their ranges or the method does not know the law. `solver` is scratch.
ContactReport followContact(SolidSystem& solids, const SolidContact& contact, const ContactPathOptions& options,
                            ContactState& state, TangentSolver& solver,
                            const std::function<bool(const ContactStep&)>& observe);
/// With scratch of its own.
ContactReport followContact(SolidSystem& solids, const SolidContact& contact, const ContactPathOptions& options,
                            ContactState& state, const std::function<bool(const ContactStep&)>& observe);

/// Undeformed, at factor 0.
ContactState contactStart(const SolidSystem& solids);

}  // namespace gambeson
