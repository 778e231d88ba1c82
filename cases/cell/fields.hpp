#pragma once
/// The field table of the kind cell.

#include "cases/cell/case.hpp"
#include "cases/input/schema.hpp"

namespace gambeson::schema {

/// The whole case; the target of reading is a CellCase.
const Object& cellTable();

// Its parts.
Object pathTable();        ///< PathCase
Object cellOutputTable();  ///< CellOutput

/// The key of a path that says its load: "biaxial".
std::string wordOf(const PathLoads& load);

/// Rules between the parts of a case; builds the cell once. Sets what absent keys stand for.
void applyCellRules(const Entry& root, CellCase& c);

}  // namespace gambeson::schema
