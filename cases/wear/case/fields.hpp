#pragma once
/// The field table: every key of a case file with its unit, default, allowed range and meaning. Reading, defaults,
/// checks, the JSON schema and cases/FIELDS.md all come from it.

#include "cases/input/schema.hpp"

namespace gambeson::schema {

/// The whole case; the target of reading is a Case.
const Object& caseTable();

// Its parts, each beside the rules between its fields.
Object garmentTable();  ///< GarmentCase
Object humanTable();    ///< HumanCase
Object supportTable();  ///< SupportCase
Object outputTable();   ///< OutputCase
Object comfortTable();  ///< ComfortCase

}  // namespace gambeson::schema
