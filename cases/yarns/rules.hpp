#pragma once
/// Rules between what a cell is made of.

#include "cases/input/schema.hpp"
#include "cases/yarns/cell_design.hpp"

namespace gambeson::schema {

/// Sets what absent keys stand for; checks whatever can be told before the cell is built.
void applyDesignRules(const Entry& root, CellDesign& c);

}  // namespace gambeson::schema
