#pragma once
/// The words of the schemes that step cloth of any case.

#include <string>
#include <utility>
#include <vector>

#include "core/motion/motion_options.hpp"

namespace gambeson::schema {

inline std::vector<std::pair<std::string, MotionScheme>> motionSchemes() {
  return {{"verlet", MotionScheme::verlet},
          {"euler", MotionScheme::euler},
          {"symplectic_euler", MotionScheme::symplectic_euler},
          {"rk2", MotionScheme::midpoint},
          {"rk4", MotionScheme::runge_kutta},
          {"implicit_euler", MotionScheme::implicit_euler},
          {"semi_implicit", MotionScheme::semi_implicit}};
}

inline const char* motionSchemesDoc() {
  return "verlet: velocity Verlet, explicit, of second order, keeps energy; euler, rk2 (midpoint), rk4: explicit, of "
         "first, second and fourth order (Wong 2014, section 3.2.1), the first two grow but where drag is; "
         "symplectic_euler: explicit, the velocity first (Man 2006, eq. 2.2), of first order, bounded; "
         "implicit_euler: of first order, any step, damps (3.2.2); semi_implicit: the same with bending in explicit "
         "substeps (section 4.3)";
}

}  // namespace gambeson::schema
