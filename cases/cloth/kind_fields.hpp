#pragma once
/// The kinds of cloth that a garment or a sheet may be made into, as cases call them.

#include <string>
#include <utility>
#include <vector>

#include "cases/cloth/kind.hpp"

namespace gambeson::schema {

inline std::vector<std::pair<std::string, ClothKind>> clothKinds() {
  return {{"nurbs", ClothKind::nurbs}, {"triangles", ClothKind::triangles}};
}
inline const char* clothKindDoc() {
  return "what the cloth is made of: smooth NURBS patches (Kirchhoff-Love), or constant-strain triangles with hinges "
         "at "
         "their edges";
}
inline std::vector<std::pair<std::string, MeshKind>> meshKinds() {
  return {{"single", MeshKind::single}, {"alternating", MeshKind::alternating}, {"equilateral", MeshKind::equilateral}};
}
inline const char* meshKindDoc() {
  return "of triangles: single, two in each cell, all diagonals alike; alternating, diagonals that cross from cell to "
         "cell; equilateral, rows of triangles a cell's width wide, which bend alike in all directions";
}

inline std::vector<std::pair<std::string, CellRule>> cellRules() {
  return {{"automatic", CellRule::automatic}, {"full", CellRule::full}, {"assumed", CellRule::assumed}};
}

}  // namespace gambeson::schema
