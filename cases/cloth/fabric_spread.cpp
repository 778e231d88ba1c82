#include "cases/cloth/fabric_spread.hpp"

#include "cases/input/table.hpp"

namespace gambeson::schema {

Object spreadTable() {
  using F = FabricSpread;
  const Range range = between(0, 1);
  return Table<F>("Spread of a fabric", "standard deviations over their means, \"5 %\" say; 0: known to be the same")
      .number(
          "thickness", &F::thickness, "", range,
          "of the thickness; mass and stiffness in the plane go with it, the rigidity of bending, which is measured "
          "by itself, does not")
      .defaultsTo("not known")
      .number("moduli", &F::moduli, "", range, "of Young's and the shear moduli, all together")
      .defaultsTo("not known")
      .number("bending", &F::bending, "", range, "of the rigidities of bending, twist and seams, all together")
      .defaultsTo("not known")
      .number("friction", &F::friction, "", range, "of the coefficients of friction, with bodies and with cloth")
      .defaultsTo("not known")
      .build();
}

}  // namespace gambeson::schema
