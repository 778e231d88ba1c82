#pragma once
/// The kinds of cloth that a garment or a sheet may be made into, as cases call them.

#include <string>
#include <utility>
#include <vector>

#include "cases/cloth/kind.hpp"

namespace gambeson::schema {

inline std::vector<std::pair<std::string, ClothKind>> clothKinds() {
  return {{"nurbs", ClothKind::nurbs},
          {"triangles", ClothKind::triangles},
          {"springs", ClothKind::springs},
          {"shell", ClothKind::shell}};
}
inline const char* clothKindDoc() {
  return "what the cloth is made of: nurbs, smooth patches (Kirchhoff-Love); triangles of constant strain "
         "that bend as bending_elements says; springs between points at the corners of the cells (Provot; Man 2006, "
         "2.2); shell, bilinear cells whose directors turn, sheared through the thickness (Man 2006, 2.3)";
}
/// Those that a laboratory bends and shears: springs have no rigidity of their own, and a centimetre of denim of
/// the degenerated shell does not settle to the 1e-11 of its forces that the laboratory asks for (9e-6).
inline std::vector<std::pair<std::string, ClothKind>> specimenKinds() {
  return {{"nurbs", ClothKind::nurbs}, {"triangles", ClothKind::triangles}};
}
inline std::vector<std::pair<std::string, MeshKind>> meshKinds() {
  return {{"single", MeshKind::single}, {"alternating", MeshKind::alternating}, {"equilateral", MeshKind::equilateral}};
}
inline const char* meshKindDoc() {
  return "of triangles: single, two in each cell, all diagonals alike; alternating, diagonals that cross from cell to "
         "cell; equilateral, rows of triangles a cell's width wide, which bend alike in all directions";
}

inline std::vector<std::pair<std::string, BendingElements>> bendingElements() {
  return {{"midedge", BendingElements::midedge},
          {"triangle", BendingElements::triangle},
          {"hinge", BendingElements::hinge},
          {"springs", BendingElements::springs},
          {"quadratic", BendingElements::quadratic}};
}
inline const char* bendingElementsDoc() {
  return "how triangles bend. midedge: each by its tensor of curvature, from the angles to the normals at its edges, "
         "which turn by unknowns of their own; converges to the plate on all meshes. triangle: the same with normals "
         "halfway between neighbours; on alternating meshes a third too stiff in twist. hinge: each edge by itself; on "
         "single meshes up to three times too stiff across the diagonals. springs: between the corners that "
         "neighbours do not share; limp where flat. quadratic: as hinge for small folds, by forces that are linear "
         "in the positions (Bergou et al. 2006); for the bending law linear and cloth that is flat without stress; of "
         "larger folds too limp, by a tenth at 45 degrees";
}
inline const char* bendingSpringDoc() {
  return "stiffness of crossed springs; 0: what bends as much as the fabric's rigidities do at a curvature of 1/cm, "
         "too little below it and too much beyond";
}

inline std::vector<std::pair<std::string, CellRule>> cellRules() {
  return {{"automatic", CellRule::automatic}, {"full", CellRule::full}, {"assumed", CellRule::assumed}};
}

}  // namespace gambeson::schema
