#pragma once
/// What the field tables say about all files that the command reads.

#include <string>

namespace gambeson {

/// The JSON Schema of cases.
std::string caseSchema();
/// cases/FIELDS.md: the fields of cases and studies.
std::string caseFields();

}  // namespace gambeson
