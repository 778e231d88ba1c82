#pragma once
/// What `gambeson draft` writes: a garment of a case as a file of its own.

#include <cstddef>
#include <filesystem>
#include <iosfwd>
#include <string>

#include "cases/wear/case/case.hpp"
#include "core/cloth/draft/garment.hpp"

namespace gambeson {

/// The number of the garment of this name, or of the only one. Throws InputError.
std::size_t garmentCalled(const Case& c, const std::string& name);
/// That garment, made on its human over the others. Throws InputError.
Garment draftOf(const Case& c, std::size_t garment);

/// Writes the garment of this name (or the only one) as a file, or as a mesh of triangles, and says on `out` what it
/// is. Throws InputError.
void draftToFile(const Case& c, const std::string& name, const std::filesystem::path& file, bool as_mesh,
                 std::ostream& out);

/// Which drafts cannot be cut of flat cloth (beyondText), a sentence each.
std::vector<std::string> uncutText(const Case& c, const std::vector<Garment>& drafts);

}  // namespace gambeson
