#pragma once
/// Whether a PLY file holds what its header announces: importers that trust the header loop or allocate without end.

#include <string>
#include <string_view>

namespace gambeson {

/// Throws InputError with file and line (of the header, or of the row in an ASCII file): unknown header lines, no
/// vertices, counts that the file cannot hold, rows or bytes that are missing.
void checkPly(std::string_view text, const std::string& file);

}  // namespace gambeson
