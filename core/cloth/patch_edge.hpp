#pragma once
/// Edges of the patches that a cloth is made of.

#include <string>
#include <vector>

namespace gambeson {

enum class Side { u0, u1, v0, v1 };

/// One edge of a patch. `reversed` runs it against its parameter.
struct PatchEdge {
  int patch = 0;
  Side side = Side::u0;
  bool reversed = false;
};

/// Edges that supports and studies call by one name.
struct NamedEdge {
  std::string name;
  std::vector<PatchEdge> edges;
};

/// "edge v0 of patch 2", for messages.
std::string edgeName(const PatchEdge& edge);

}  // namespace gambeson
