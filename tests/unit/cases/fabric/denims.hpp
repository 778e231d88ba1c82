#pragma once
/// Six denims, measured: Regenerated cellulose-based denim for tropical regions, Journal of Textiles (Hindawi) 2016,
/// 4614168, table 5, fabrics A to F.

#include <array>
#include <string>

#include "cases/cloth/card.hpp"

namespace gambeson {

struct Denim {
  const char* name;
  double extension;                         ///< EMT
  double rigidity, hysteresis;              ///< B [gf cm^2/cm], 2HB [gf cm/cm]
  double shear, width_at_half, width_at_5;  ///< G [gf/(cm deg)], 2HG, 2HG5 [gf/cm]
  double thickness_mm;
};

inline constexpr std::array<Denim, 6> denims{{{"A", 0.05515, 0.172, 0.139, 2.18, 5.012, 7.412, 1.066},
                                              {"B", 0.05735, 0.144, 0.142, 1.538, 3.575, 5.938, 1.188},
                                              {"C", 0.04695, 0.227, 0.105, 3.398, 4.975, 7.4, 0.801},
                                              {"D", 0.05135, 0.147, 0.141, 1.613, 3.513, 6.412, 1.04},
                                              {"E", 0.0471, 0.207, 0.214, 1.538, 3.575, 5.938, 0.887},
                                              {"F", 0.05455, 0.148, 0.159, 1.5, 3.425, 5.763, 0.973}}};

constexpr double kGramForce_N = 9.80665e-3, kOneDegree = 0.017453292519943295;

inline FabricCard cardOf(const Denim& d) {
  FabricCard card;
  card.name = d.name;
  card.source = "table 5";
  card.thickness_m = 1e-3 * d.thickness_mm;
  card.tensile.emplace().extension.both = d.extension;
  CardShear& shear = card.shear.emplace();
  shear.rigidity.both = 100 * kGramForce_N * d.shear / kOneDegree;
  shear.hysteresis.both = 100 * kGramForce_N * d.width_at_half;
  shear.hysteresis_5.both = 100 * kGramForce_N * d.width_at_5;
  card.bending.rigidity.both = 0.01 * kGramForce_N * d.rigidity;
  card.bending.hysteresis.both = kGramForce_N * d.hysteresis;
  card.bending.hysteresis_at_per_m = 100;
  return card;
}

}  // namespace gambeson
