#pragma once
/// The two parts into which closed contours cut a surface, and which of them is on the wrong side (Zheng 2013,
/// section 4.2).

#include <array>
#include <span>
#include <vector>

#include "core/contact/contour.hpp"

namespace gambeson {

/// A contour as seen on one of its surfaces.
struct ContourPath {
  const Contour* contour = nullptr;
  int surface = 0;
};

/// Contours on one surface, ready to be looked up by edge and by face. The contours outlive it.
class CutSurface {
 public:
  CutSurface(const ContactMesh& mesh, std::span<const ContourPath> contours);

 private:
  friend class RegionFill;
  /// A crossing of a contour with an edge of the surface.
  struct Cut {
    int edge;
    double t;  ///< from the lower vertex of the edge
    int path;
    int left;  ///< +1 where the lower vertex's side of the cut is to the left of the contour, -1 where it is to the
               ///< right
    Vec3 x;
  };
  /// A segment inside a triangle.
  struct Piece {
    int face, path, segment, normal;
  };
  struct Path {
    ContourPath from;
    std::vector<int> edges;     ///< of the triangles that it passes through, ascending
    bool without_cuts = false;  ///< it lies inside one triangle
    bool valid = true;          ///< two-sided, and not winding twice around a vertex
  };
  std::span<const Cut> cutsOf(int edge) const;
  std::span<const Piece> piecesIn(int face) const;
  void add(const ContactMesh& mesh, const ContourPath& from);

  std::vector<Path> paths_;
  std::vector<Cut> cuts_;      ///< by edge, then along it
  std::vector<Piece> pieces_;  ///< by face
  std::vector<int> unclear_;   ///< edges crossed by contours without two sides, ascending
};

/// Omega+ lies to the left of the contour's travel, seen against the normal of its segments; Omega- to the right.
struct ContourRegion {
  bool found = false;         ///< false where nothing keeps the two sides of the contour apart
  int sign = 1;               ///< which one: +1 Omega+, -1 Omega-
  double area_m2 = 0;         ///< of that region: whole triangles and the polygons of those that are cut
  std::vector<int> vertices;  ///< of that region, ascending; none where it lies inside the cut triangles
  /// The contours of the surface next to its vertices, and on which side of each (+1 left) it lies; ascending.
  std::vector<std::array<int, 2>> beside;
};

/// Scratch of floodRegion: a label for each vertex, all 0 between calls.
struct FloodWork {
  std::vector<signed char> label;
};

/// The region of the given sign beside contour `which` of the surface or, where sign = 0, the smaller one. The other
/// contours bound it too: two cuts along a tube, none of which divides it alone.
/// Flood fill over the vertices from both sides of the contour at once, until one side has no more to grow and is the
/// wanted one: the cost is that of the smaller region. The sides of a vertex on crossed edges follow from the sum of
/// the signs of an edge's crossings, which is what the nearest one says (a contour crosses an edge in alternating
/// directions) but needs no comparison of distances; a contour that crosses every edge an even number of times
/// encloses no vertex, and the sign of its area tells the sides.
/// A contour that is not closed on the surface or crosses itself there has no regions, and a region that grows against
/// one is not found: it would go around its end. Regions beyond another contour that share a cut triangle with this
/// one's count with its side; where contours cross each other in a triangle its share is approximate.
ContourRegion floodRegion(const ContactMesh& mesh, std::span<const Vec3> x, const CutSurface& surface, int which,
                          int sign, FloodWork& work);

}  // namespace gambeson
