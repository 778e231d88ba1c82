#pragma once
/// Files of laws that are tables (LAW.json): a table with its units, and where it comes from.

#include <filesystem>
#include <optional>
#include <string>

#include "cases/input/schema.hpp"
#include "core/material/table/curve_energy.hpp"
#include "core/material/table/law_table_data.hpp"

namespace gambeson {

/// What a table was made of and how good it is. Estimated errors are parts of the largest of their kind in the range;
/// absent: not estimated.
struct LawProvenance {
  std::string cell;       ///< identity of the case whose yarns the table stands for; empty: no cell
  std::string cell_name;  ///< its name
  std::string made_by;    ///< program and version
  std::string options;    ///< of the homogenisation, in words
  std::string note;       ///< source, where it is no cell
  std::optional<double> error_energy, error_tension, error_shear, error_moment;
  int compared_at = 0;  ///< points between the nodes from which the errors were estimated
  bool operator==(const LawProvenance&) const = default;
};

/// What a law was measured or computed to be: the table of a file, or in its place curves of a case.
struct LawFile {
  LawTableData table;
  LawProvenance provenance;
  std::optional<CurveLaw> curves;
  bool operator==(const LawFile&) const = default;
};

/// Reads and checks a file. Throws InputError with file, line and key: what is no table (LawTable), another version of
/// the format, other units.
LawFile readLawTable(const std::filesystem::path& file);
/// Writes it whole or not at all; numbers so that they are read back exactly.
void writeLawTable(const std::filesystem::path& file, const LawFile& law);

namespace schema {
/// Of such a file, for the documentation.
const Object& lawFileTable();
/// The same as a part of a case: what a finished run keeps of a table.
LawFile readLawFile(const Entry& entry);
JsonNode nodeOf(const LawFile& law);
}  // namespace schema

}  // namespace gambeson
