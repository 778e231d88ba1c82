#pragma once
/// Meshes of hexahedra: nodes, cells, what they are made of and where their fibres run.

#include <array>
#include <span>
#include <vector>

#include "core/solid/hexahedron.hpp"

namespace gambeson {

struct SolidMaterial {
  BonetBurton law;
  double density_kg_per_m3 = 0;  ///< 0: without mass, for what is solved in equilibrium
};

/// Four nodes round a face, its normal by the right hand.
using Facet = std::array<int, 4>;

struct SolidMesh {
  std::vector<Vec3> nodes;                               ///< at rest [m]; one that no cell has is to be held
  std::vector<std::array<int, kHexahedronNodes>> cells;  ///< corners in the order of hexahedron.hpp
  std::vector<SolidMaterial> materials;
  std::vector<int> material_of;  ///< of each cell; empty: all of the first
  /// Along the fibres at rest, of any length: one for each cell, or one for each of its eight Gauss points. Empty where
  /// the laws are isotropic.
  std::vector<Vec3> fibres;
};

/// Throws InputError where a number is not finite, a node or material does not exist, a law is refused, a density is
/// negative, fibres are missing, too many or without length, or a cell is turned inside out at a Gauss point.
void checkMesh(const SolidMesh& mesh);

/// The faces that one cell alone has, each seen from outside, in the order of the cells.
std::vector<Facet> boundaryFacets(const SolidMesh& mesh);
/// Those of the cells in [first, end) alone: the skin of one of several bodies in a mesh.
std::vector<Facet> boundaryFacets(const SolidMesh& mesh, int first, int end);

/// Throws InputError (key "facets") where a corner does not exist or a facet names one twice.
void checkFacets(std::span<const Facet> facets, int nodes);

/// Area at rest of the facets around each node, a quarter of each [m²].
std::vector<double> nodeAreas(std::span<const Facet> facets, std::span<const Vec3> nodes);

}  // namespace gambeson
