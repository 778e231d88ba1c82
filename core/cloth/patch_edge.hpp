#pragma once
/// Edges of the patches that a cloth is made of.

#include <string>
#include <vector>

#include "core/math/vec.hpp"

namespace gambeson {

enum class Side { u0, u1, v0, v1 };

/// One edge of a patch. `reversed` runs it against its parameter.
struct PatchEdge {
  int patch = 0;
  Side side = Side::u0;
  bool reversed = false;
};

/// A place of a patch, in its parameters.
struct EdgePlace {
  int patch = 0;
  Vec2 uv;
};

/// Edges that supports and studies call by one name: sides of patches, or lines across the cells of panels.
struct NamedEdge {
  std::string name;
  std::vector<PatchEdge> edges;
  /// Of what is no side of a patch but a part of its border: places all along it, several in each cell; each line is of
  /// one patch.
  std::vector<std::vector<EdgePlace>> lines{};
};

/// "edge v0 of patch 2", for messages.
std::string edgeName(const PatchEdge& edge);

}  // namespace gambeson
