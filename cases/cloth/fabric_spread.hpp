#pragma once
/// How far a fabric's numbers spread from piece to piece.

#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "cases/input/schema.hpp"

namespace gambeson {

/// Standard deviations over their means, each of what was measured by itself; absent: not known.
struct FabricSpread {
  std::optional<double> thickness;  ///< mass and stiffness in the plane go with it; the rigidity of bending does not
  std::optional<double> moduli;     ///< of Young's and the shear moduli together
  std::optional<double> bending;    ///< of the rigidities of bending and twist, and of seams
  std::optional<double> friction;   ///< of the coefficients with bodies and cloth
};

/// Its numbers by name, in the one order that all who go through them take.
inline constexpr std::array<std::pair<std::string_view, std::optional<double> FabricSpread::*>, 4> kSpreads{
    {{"thickness", &FabricSpread::thickness},
     {"moduli", &FabricSpread::moduli},
     {"bending", &FabricSpread::bending},
     {"friction", &FabricSpread::friction}}};

namespace schema {
Object spreadTable();
}  // namespace schema

}  // namespace gambeson
