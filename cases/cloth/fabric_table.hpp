#pragma once
/// The key law of a fabric: a table in place of moduli and bending.

#include "cases/cloth/fabric_input.hpp"

namespace gambeson::schema {

Object tableLawTable();  ///< TableInput

/// Gives the fabric the law of the input, with what follows from it at rest, and as the limits of its strain the range
/// of the table where none are given. `entry` is the fabric's in the file. Throws InputError where it has keys that the
/// law replaces, or neither a file nor values.
void resolveTable(const Entry& entry, const TableInput& in, FabricCase& fabric);
/// The input that resolves to the fabric's law, the table's values written out.
TableInput restoreTable(const FabricCase& fabric);

}  // namespace gambeson::schema
