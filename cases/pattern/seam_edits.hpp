#pragma once
/// A short list of what a case wants of a pattern's seams that its file has otherwise: the file stays as it was
/// imported.
///
///   "seams": [{"seam": "left side", "use": "opening", "open": true, "buttons": 5},
///             {"seam": "front.7", "remove": true},
///             {"seam": "centre back", "a": ["back left.2"], "b": ["back right.4 reversed"]}]

#include <span>
#include <string>
#include <vector>

#include "cases/input/schema.hpp"
#include "core/error.hpp"
#include "tryon/pattern/flat/panel.hpp"
#include "tryon/pattern/flat/seam_edit.hpp"

namespace gambeson {

struct EditedPattern {
  /// Where a seam stands: in the list of edits, else in the pattern's file.
  struct Origin {
    int edit = -1, file = -1;
  };
  FlatPattern pattern;
  std::vector<Origin> origins;  ///< of its seams

  /// What was found wrong with the pattern ("seams[k]" of it), with the key that its file has for it.
  InputError inFile(const InputError& e) const;
  /// Whether e is of a seam that an edit made or changed; then `key` becomes the one in the list of edits.
  bool isOfEdit(const InputError& e, std::string& key) const;
};

/// Edits in their order; what they leave is checked (checkPattern). Throws InputError: "seams[i]..." of the edits.
EditedPattern editSeams(FlatPattern pattern, std::span<const SeamEdit> edits);

namespace schema {
const Object& seamEditTable();
}  // namespace schema

}  // namespace gambeson
