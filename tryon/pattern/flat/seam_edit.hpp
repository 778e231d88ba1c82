#pragma once
/// What is wanted of a seam otherwise than a pattern has it (cases/pattern/seam_edits.hpp).

#include <optional>
#include <string>
#include <vector>

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

}  // namespace gambeson
