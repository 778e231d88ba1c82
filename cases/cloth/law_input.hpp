#pragma once
/// The key law of a fabric: a table, a cell of yarns or curves in place of moduli and bending.

#include "cases/cloth/fabric_input.hpp"

namespace gambeson {

/// The fabric with the law of curves that `law` has, the moduli that it has at rest, and as the limits of its strain,
/// where none are given, the ends of the curves. Throws InputError as CurveEnergy and withEnergy.
FabricCase withCurves(FabricCase fabric, std::shared_ptr<const LawFile> law);

namespace schema {

Object lawTable();  ///< LawInput

/// Throws InputError at a key of the fabric that its law leaves no meaning to; `by`: "\"law\" is given".
void refuseReplaced(const Entry& entry, const char* by);

/// Gives the fabric the law of the input, with what follows from it at rest, and as the limits of its strain the range
/// of a table or of curves where none are given. `entry` is the fabric's in the file. Throws InputError where it has
/// keys that the law replaces, or says no law or two.
void resolveLaw(const Entry& entry, const LawInput& in, FabricCase& fabric);
/// The input that resolves to the fabric's law, what its file says written out.
LawInput restoreLaw(const FabricCase& fabric);

}  // namespace schema
}  // namespace gambeson
