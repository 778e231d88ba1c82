#pragma once
/// What `gambeson draft --flat` writes: a draft as flat panels.

#include <filesystem>
#include <iosfwd>
#include <string>

#include "core/cloth/draft/garment.hpp"
#include "tryon/pattern/flat/flatten_draft.hpp"

namespace gambeson {

/// Panels that lie flat only where they are stretched, in the mean over the area, beyond what their fabric stands (a
/// share of the length): "sleeve_top_left by 8.1 % in the mean and up to 79 %, ..". Empty where there are none.
std::string beyondText(const FlattenedDraft& flat, double limit);

/// Writes the garment laid flat (flattenDraft) by the ending of the file's name: .dxf (patternDxf), .svg (patternSvg)
/// or .json (patternText), and says on `out` its panels, by how much each was strained, what of that its fabric does not
/// stand, and where the sides of seams differ. Throws InputError.
void flatToFile(const Garment& garment, const std::filesystem::path& file, double limit, std::ostream& out);

}  // namespace gambeson
