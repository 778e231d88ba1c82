#pragma once
/// Which kind of cloth a garment or a sheet is made into.

#include "core/cloth/triangles/mesh_kind.hpp"

namespace gambeson {

enum class ClothKind { nurbs, triangles };

/// `model` and `mesh` of a garment or a sheet.
struct ClothModel {
  ClothKind kind = ClothKind::nurbs;
  MeshKind mesh = MeshKind::single;
};

}  // namespace gambeson
