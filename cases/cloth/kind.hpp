#pragma once
/// Which kind of cloth a garment or a sheet is made into.

#include <string>

#include "core/cloth/triangles/draft_mesh.hpp"

namespace gambeson {

enum class ClothKind { nurbs, triangles };

/// `model` and `mesh` of a garment or a sheet.
struct ClothModel {
  ClothKind kind = ClothKind::nurbs;
  MeshKind mesh = MeshKind::single;
};

/// What it assumes, for pages.
inline std::string inWords(const ClothModel& cloth) {
  switch (cloth.kind) {
    case ClothKind::nurbs:
      return "Kirchhoff-Love sheet: thin, normals stay normal; strains of the reference surface are Green-Lagrange's.";
    case ClothKind::triangles:
      return "Triangles of constant Green-Lagrange strain that bend at their edges.";
  }
  return {};
}

}  // namespace gambeson
