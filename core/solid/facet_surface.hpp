#pragma once
/// Surfaces of facets, and where a point meets them: the nearest facet, edge or corner, and all facets that press on it
/// at once (Man 2006, section 3.2).
///
/// Man asks the facets around the nearest node, by the signs of p . c_i (3.59): sixteen cases around four facets. These
/// signs tell where p is only where edges are orthonormal (22 % are wrong with edges 20 degrees off), and the nearest
/// node need not be one of the nearest facet. Here distances decide, of every facet that a sphere around it does not
/// rule out: in all sixteen cases the nearest feature.
///
/// Where one facet is nearest, it is what the point must not pass. Where surfaces meet in a groove, the point must pass
/// none of them, and is held by several facets at once: with one alone, the solution goes to and fro between them (his
/// fig. 14). What is admissible is outside all facets of a groove, and outside any facet of a ridge; so
///   in a groove (an edge or corner nearest from inside, or a facet that faces the nearest one): all of these facets,
///   beside a ridge: of its facets that which the point has passed least.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/solid/facet.hpp"
#include "core/solid/solid_mesh.hpp"

namespace gambeson {

/// The nearest point of a surface.
struct NearestFacet {
  int facet = -1;  ///< -1: none within the distance asked for
  FacetPoint at;
};

/// A facet that holds a point: where the point lies over it (also beyond its edges), and how deep.
struct FacetTouch {
  int facet = 0;
  Vec2 local;
  double gap_m = 0;  ///< > 0: the point has passed the facet (Man's sign, 3.9)
};

/// A facet that may hold a point.
struct FacetCandidate {
  FacetTouch touch;
  Vec3 normal, center;
  double beyond = 0;  ///< its edges, as far as the point lies over it there [half widths]
};

struct TouchOptions {
  double reach_m = 0;  ///< farther facets do not count, on either side; > 0
  /// Facets that meet at less are one plane, and one of them holds a point. More than rounding and no more: one facet
  /// at a time in a groove, however shallow, and the solution goes to and fro.
  double groove_rad = 1e-6;
  bool simultaneous = true;  ///< false: the first facet alone, as others do
  /// 0: a point is held by what is nearest now. Else it keeps its facets while forces are being balanced, and goes on
  /// between passes. Where it then lies beyond the edge of a groove, however shallow, by at most so much [half widths],
  /// both facets hold it: on either alone it would come to rest beyond the edge. At most 1.
  double keep = 0;
};

/// What becomes of the facet that held a point before.
enum class HeldFacet { keeps, goes_on };

/// Constant after it is built.
class FacetSurface {
 public:
  FacetSurface() = default;
  /// Throws InputError (checkFacets; key "facets").
  FacetSurface(std::vector<Facet> facets, int nodes);

  const std::vector<Facet>& facets() const { return facets_; }
  /// The nodes of the facets, ascending.
  const std::vector<int>& nodes() const { return nodes_; }
  FacetCorners corners(int facet, std::span<const Vec3> x) const;
  /// The facets around a node, ascending.
  std::span<const int> facetsAt(int node) const;

  /// Spheres around the facets at the positions x, for the searches there, and in which box of a grid their centers
  /// lie.
  struct Spheres {
    std::vector<Vec3> center;
    std::vector<double> radius;
    Vec3 low;
    double box_m = 0, largest_m = 0;  ///< edge of a box; largest radius
    std::array<int, 3> boxes{};
    std::vector<int> offsets, facets;  ///< by box, ascending in each

    /// The box of a coordinate, of those that there are.
    int boxOf(int axis, double at) const;
  };
  Spheres spheres(std::span<const Vec3> x) const;

  /// The nearest point to p within `reach_m`. Of equally near ones, that of the first facet. `spheres` are those of x.
  NearestFacet nearest(std::span<const Vec3> x, const Spheres& spheres, const Vec3& p, double reach_m) const;

  /// All facets that hold p at once, the nearest first, or where an edge or corner is nearest from inside that which p
  /// has passed most. Empty where none is within reach. `held`: the facets that held p before, the
  /// foremost first. They keep p as long as it lies over them or the next facets; or p goes on to what is nearest now,
  /// from a groove with both (TouchOptions::keep).
  std::vector<FacetTouch> touching(std::span<const Vec3> x, const Spheres& spheres, const Vec3& p,
                                   const TouchOptions& options, std::span<const int> held = {},
                                   HeldFacet after = HeldFacet::keeps) const;

 private:
  std::vector<int> facetsOf(const NearestFacet& nearest) const;
  /// The facet that holds p before any other, and the nearest where that is another of a groove; `held`: what held it
  /// before, or -1.
  std::vector<FacetCandidate> first(std::span<const Vec3> x, const Spheres& spheres, const Vec3& p,
                                    const TouchOptions& options, int held) const;

  std::vector<Facet> facets_;
  std::vector<int> nodes_;
  std::vector<int> node_offsets_, node_facets_;  ///< of all nodes of the mesh
};

}  // namespace gambeson
