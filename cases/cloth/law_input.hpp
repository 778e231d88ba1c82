#pragma once
/// The key law of a fabric: a table, a cell of yarns or curves in place of moduli and bending.

#include "cases/cloth/fabric_input.hpp"

namespace gambeson::schema {

Object lawTable();  ///< LawInput

/// Gives the fabric the law of the input, with what follows from it at rest, and as the limits of its strain the range
/// of a table or of curves where none are given. `entry` is the fabric's in the file. Throws InputError where it has
/// keys that the law replaces, or says no law or two.
void resolveLaw(const Entry& entry, const LawInput& in, FabricCase& fabric);
/// The same of curves by themselves; at the key "curves" of `law` is said what is wrong with them.
void takeCurves(const Entry& law, std::shared_ptr<const CurveLaw> curves, FabricCase& fabric);
/// The input that resolves to the fabric's law, what its file says written out.
LawInput restoreLaw(const FabricCase& fabric);

}  // namespace gambeson::schema
