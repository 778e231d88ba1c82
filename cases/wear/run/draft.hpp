#pragma once
/// What `gambeson draft` writes: a garment of a case as a file of its own.

#include <filesystem>
#include <iosfwd>
#include <string>

#include "cases/wear/case/case.hpp"

namespace gambeson {

/// Writes the garment of this name (or the only one) as a file, or as a mesh of triangles, and says on `out` what it
/// is. Throws InputError.
void draftToFile(const Case& c, const std::string& name, const std::filesystem::path& file, bool as_mesh,
                 std::ostream& out);

}  // namespace gambeson
