#pragma once
/// The field tables of the kinds static, dynamic and modal.

#include "cases/schema.hpp"
#include "cases/structure_case.hpp"

namespace gambeson::schema {

/// The whole case; the target of reading is a StructureCase.
const Object& structureTable(StructureKind kind);
const std::vector<std::pair<std::string, StructureKind>>& structureKinds();

// Its parts.
Object structureSheetTable();    ///< SheetCase
Object materialTable();          ///< MaterialCase
Object structureSupportTable();  ///< StructureSupport
Object structureLoadTable();     ///< StructureLoad
Object staticSolverTable();      ///< StructureCase
Object dynamicSolverTable();     ///< StructureCase
Object modalSolverTable();       ///< StructureCase
enum class FieldsOf { sheet, garment };
Object fieldsTable(FieldsOf of);                  ///< FieldsCase
Object noiseTable();                              ///< NoiseCase
Object structureOutputTable(StructureKind kind);  ///< StructureOutput

// Pieces that several of them share: values and places.
Vec2 readPair(const Place& place, const std::string& unit, const Range& range);
std::vector<double> readNumbers(const Place& place, const std::string& unit, const Range& range);
JsonNode nodeOf(const Vec2& v);
JsonNode nodeOfList(const std::vector<double>& values);
EdgeAt readEdgeAt(const Place& place);
JsonNode nodeOf(const EdgeAt& edge);
Vec2 readCorner(const Place& place);

/// Rules between the parts of a case.
void applyStructureRules(const Place& root, StructureCase& c);

}  // namespace gambeson::schema
