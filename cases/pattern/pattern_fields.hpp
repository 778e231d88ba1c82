#pragma once
/// Detail of pattern_file.hpp: what a file says before names are looked up.

#include <string>
#include <vector>

#include "tryon/pattern/flat/panel.hpp"

namespace gambeson::schema {

struct SeamInput {
  std::string name;
  std::vector<std::string> a, b;
  SeamUse use = SeamUse::sewn;
  double stiffness_N = 0;
  bool proposed = false;
  bool open = false;
  int buttons = 0;
  double rest_angle_rad = 0;
};

/// The pattern's seams are empty: `seams` has them.
struct PatternInput {
  int version = 1;
  FlatPattern pattern;
  std::vector<SeamInput> seams;
};

}  // namespace gambeson::schema
