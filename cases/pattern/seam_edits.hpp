#pragma once
/// A short list of what a case wants of a pattern's seams that its file has otherwise: the file stays as it was
/// imported.
///
///   "seams": [{"seam": "left side", "use": "opening", "open": true, "buttons": 5},
///             {"seam": "front.7", "remove": true},
///             {"seam": "centre back", "a": ["back left.2"], "b": ["back right.4 reversed"]}]

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cases/input/schema.hpp"
#include "core/error.hpp"
#include "tryon/pattern/flat/panel.hpp"

namespace gambeson {

/// With sides a and b it is a new seam; else it changes one, or takes it away.
struct SeamEdit {
  std::string seam;  ///< its name; of one that there is, an edge that is sewn in it will do ("front.3")
  bool remove = false;
  std::vector<std::string> a, b;
  // As those of PanelSeam; what is not said stays.
  std::optional<SeamUse> use;
  std::optional<bool> open;
  std::optional<int> buttons;
  std::optional<double> stiffness_N, rest_angle_rad;
};

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
