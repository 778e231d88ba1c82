#pragma once
/// Drafts as flat patterns: what a cutter cuts for a garment that was drafted around a body.

#include <string>

#include "core/cloth/draft/garment.hpp"
#include "tryon/pattern/flat/flatten_patch.hpp"
#include "tryon/pattern/flat/panel.hpp"

namespace gambeson {

struct FlattenedDraft {
  FlatPattern pattern;
  std::vector<Flattening> flattening;  ///< of each panel
};

/// Each patch as a panel (flattenPatch), seen from outside, without seam allowance. Its sides are edges, those that
/// have a name in the garment with that name; what trims cut out of a side is spliced into the outline, holes within
/// are cutouts. Lines run through grid points. The grain runs along the warp, and each seam longer than 2 cm has a
/// notch in the middle of either side. Sides of a seam that were strained apart differ in length: they are eased.
///
/// Throws InputError: key "flat" where a patch cannot be laid flat, or the garment has seams that are no edges of
/// patches (weak and sewn ones).
FlattenedDraft flattenDraft(const Garment& garment);

/// Panels that lie flat only where they are stretched far beyond what their fabric stands (a share of the length): by
/// twice that in the mean over the area, or by 30 % more somewhere. "sleeve_top_left by up to 79 % (8.1 % in the mean),
/// .. and 2 more", the worst first. Empty where there are none.
std::string beyondText(const FlattenedDraft& flat, double limit);

}  // namespace gambeson
