#pragma once
/// A pattern of a foreign format, and what its reader has to say about it.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tryon/pattern/flat/panel.hpp"

namespace gambeson {

/// What files of some formats leave open.
struct ImportChoices {
  std::string unit;     ///< of lengths, as parseUnit knows it ("in"); empty: the file's own
  std::string up;       ///< "y" or "z": which axis of a mesh is up; empty: z
  std::string size;     ///< which of the sizes of a graded pattern; empty: its sample size
  int piece = 0;        ///< which of the pieces of a mesh, 1 the largest; 0: all, of which there may be one
  bool unfold = false;  ///< whether halves of a DXF pattern that are drawn up to their mirror line are made whole
};

struct ImportedPattern {
  FlatPattern pattern;
  std::vector<std::string> notes;    ///< what was read in a way that should be known
  std::vector<std::string> dropped;  ///< what the file says and the pattern has no place for
};

/// m for one unit of lengths. Throws InputError ("command line", --unit) where the text is no unit of length.
double metresOf(const std::string& unit);

}  // namespace gambeson
