#pragma once
/// What `gambeson draft --flat` writes: a draft as flat panels.

#include <filesystem>
#include <iosfwd>

#include "core/cloth/draft/garment.hpp"

namespace gambeson {

/// Writes the garment laid flat (flattenDraft) by the ending of the file's name: .dxf (patternDxf), .svg (patternSvg)
/// or .json (patternText), and says on `out` its panels, by how much each was strained, what of that its fabric does
/// not stand, and where the sides of seams differ. Throws InputError.
void flatToFile(const Garment& garment, const std::filesystem::path& file, double limit, std::ostream& out);

}  // namespace gambeson
