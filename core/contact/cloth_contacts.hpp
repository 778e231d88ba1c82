#pragma once
/// Persistent contact of cloth with cloth: samples on triangles from both sides, and sharp edges on edges.

#include <algorithm>
#include <span>
#include <vector>

#include "core/contact/pairs.hpp"
#include "core/contact/response.hpp"

namespace gambeson {

/// What is constant about the cloth. Vertices of the mesh below cloth_vertices are samples of cloth.
struct ClothFacts {
  int cloth_vertices = 0;
  std::vector<Vec3> rest;           ///< positions of the samples at rest
  std::vector<int> garment;         ///< of each sample: the garment it belongs to
  std::vector<double> thickness_m;  ///< of each sample
};

/// Where two surfaces touch, both ways of writing it: the least distance of a contact is `layer_m`.
struct ClothContactPoint {
  Contact contact;  ///< sample_on_cloth or edge_on_edge; the normal points to the sample, or to edge `sample`
  Stencil stencil;
  double layer_m = 0;  ///< half the sum of the thicknesses
  int partner = -1;    ///< ContactRow::partner
};

/// Distance within which contacts between cloth of this thickness are kept, and the distance at rest within which
/// points of one garment are neighbours.
constexpr double contactReach(double layer_m) { return 1.1 * layer_m; }
/// The most that the cloth between the samples asks for as distance of these from a body.
constexpr double kLargestClearance_m = 2.5e-3;
inline double neighbourDistance(double layer_m) { return 2 * layer_m; }

/// A point that moves straight by `way` comes less than `reach` from the origin, starting at `from`.
inline bool comesWithin(double reach, const Vec3& from, const Vec3& way) {
  const double way2 = norm2(way), t = way2 > 0 ? std::clamp(-dot(from, way) / way2, 0.0, 1.0) : 0;
  return norm2(from + t * way) < reach * reach;
}

/// Local minima of the distance between cloth and cloth at positions x0, where it is, or at the rate of the paths
/// x0 -> x1 would become, less than 1.1 layers (Zheng 2013, section 3.2.1: the normal points from the foot to the
/// sample, whatever the side). A sample against a triangle: feet on an edge or corner count only if no triangle there
/// is nearer, and once for the feature; on a border only if nothing beside the sample is nearer to them, either. Edges
/// against edges count only inside both and where both are sharp, that is where the faces of each bend away from the
/// other by more than 3 degrees: flat cloth on flat cloth is carried by its samples alone, since all its edges are
/// equally near. Two samples that lie on each other, each with its foot within a twentieth of the gap of the other, are
/// one contact. Neighbours along one garment are no contact: samples less than twice the layer from the foot, both at
/// rest (a fold of the least radius, half the layer, joins points that are pi/2 layers apart). Sorted by kind, then
/// sample, then feature. `pairs` hold all that come as near as this.
void clothContacts(const ContactMesh& mesh, const ClothFacts& facts, const CandidatePairs& pairs,
                   std::span<const Vec3> x0, std::span<const Vec3> x1, std::vector<ClothContactPoint>& out);

}  // namespace gambeson
