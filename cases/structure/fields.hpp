#pragma once
/// The field tables of the kinds static, dynamic and modal.

#include "cases/input/schema.hpp"
#include "cases/structure/case.hpp"

namespace gambeson::schema {

/// The whole case; the target of reading is a StructureCase.
const Object& structureTable(StructureKind kind);
const std::vector<std::pair<std::string, StructureKind>>& structureKinds();

// Its parts.
Object structureSheetTable();                     ///< SheetCase
Object materialTable();                           ///< MaterialCase
Object structureSupportTable();                   ///< StructureSupport
Object structureLoadTable();                      ///< StructureLoad
Object staticSolverTable();                       ///< StructureCase
Object dynamicSolverTable();                      ///< StructureCase
Object modalSolverTable();                        ///< StructureCase
Object structureOutputTable(StructureKind kind);  ///< StructureOutput

// Pieces that several of them share: values and places.
EdgeAt readEdgeAt(const Entry& entry);
JsonNode nodeOf(const EdgeAt& edge);
Vec2 readCorner(const Entry& entry);

/// Rules between the parts of a case.
void applyStructureRules(const Entry& root, StructureCase& c);

}  // namespace gambeson::schema
