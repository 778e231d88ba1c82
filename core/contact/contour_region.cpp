#include "core/contact/contour_region.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace gambeson {
namespace {

/// A crossing of a contour with an edge of the surface.
struct Cut {
  int edge;
  double t;  ///< from the lower vertex of the edge
  int path;
  int left;  ///< +1 where the lower vertex's side of the cut is to the left of the contour, -1 where it is to the right
  Vec3 x;
};

/// A segment inside a triangle.
struct Piece {
  int face, path, segment, normal;
};

/// Cuts and pieces of one contour; empty cuts for a contour inside one triangle.
struct Path {
  std::vector<Cut> cuts;
  std::vector<Piece> pieces;
  bool valid = true;  ///< two-sided, and not winding twice around a vertex
};

bool byEdge(const Cut& a, const Cut& b) {
  return a.edge != b.edge   ? a.edge < b.edge
         : a.t != b.t       ? a.t < b.t
         : a.path != b.path ? a.path < b.path
                            : a.left < b.left;
}

Path collect(const ContactMesh& mesh, const ContourPath& from, int number) {
  const Contour& c = *from.contour;
  Path path;
  const int segments = static_cast<int>(c.segments.size());
  for (int i = 0; i < segments; ++i)
    path.pieces.push_back({c.segments[i].face[from.surface], number, i, c.segments[i].normal[from.surface]});
  std::sort(path.pieces.begin(), path.pieces.end(),
            [](const Piece& a, const Piece& b) { return a.face != b.face ? a.face < b.face : a.segment < b.segment; });
  for (std::size_t i = 1; i < path.pieces.size(); ++i)
    if (path.pieces[i].face == path.pieces[i - 1].face && path.pieces[i].normal != path.pieces[i - 1].normal)
      path.valid = false;
  for (int i = 0; i < static_cast<int>(c.points.size()); ++i) {
    const ContourPoint& p = c.points[i];
    if (p.vertex >= 0 || p.owner != from.surface) continue;
    // A contour that leaves a face through its edge p -> q has q to its left, seen against the normal of that order.
    const bool leaves = i > 0 || c.cyclic;  // else the contour starts here
    const ContourSegment& s = c.segments[leaves ? (i + segments - 1) % segments : 0];
    const int face = s.face[from.surface];
    int left = -1;
    for (int k = 0; k < 3; ++k)
      if (mesh.face_edges[face][k] == p.edge && mesh.triangles[face][k] != mesh.edges[p.edge][0]) left = 1;
    if (!leaves) left = -left;
    path.cuts.push_back({p.edge, p.edge_weight[1], number, left * s.normal[from.surface], p.x});
  }
  std::sort(path.cuts.begin(), path.cuts.end(), byEdge);
  for (std::size_t i = 0; i < path.cuts.size();) {
    int sum = 0;
    const int edge = path.cuts[i].edge;
    for (; i < path.cuts.size() && path.cuts[i].edge == edge; ++i) sum += path.cuts[i].left;
    if (std::abs(sum) > 1) path.valid = false;
  }
  return path;
}

class Fill {
 public:
  Fill(const ContactMesh& mesh, std::span<const Vec3> x, std::span<const ContourPath> contours,
       std::vector<signed char>& label)
      : mesh_(mesh), x_(x), contours_(contours), label_(label) {}
  ~Fill() {
    for (const auto& part : labelled_)
      for (int v : part) label_[v] = 0;
  }
  Fill(const Fill&) = delete;
  Fill& operator=(const Fill&) = delete;

  ContourRegion run(int wanted) {
    ContourRegion region;
    main_ = collect(mesh_, contours_[0], 0);
    if (!main_.valid) return region;
    cuts_ = main_.cuts;
    pieces_ = main_.pieces;
    const int inner_sign = signInside();
    for (std::size_t k = 1; k < contours_.size(); ++k) {
      const Path other = collect(mesh_, contours_[k], static_cast<int>(k));
      if (!other.valid || other.cuts.empty()) continue;
      cuts_.insert(cuts_.end(), other.cuts.begin(), other.cuts.end());
      pieces_.insert(pieces_.end(), other.pieces.begin(), other.pieces.end());
    }
    std::sort(cuts_.begin(), cuts_.end(), byEdge);
    std::stable_sort(pieces_.begin(), pieces_.end(), [](const Piece& a, const Piece& b) { return a.face < b.face; });
    if (!labelHosts(inner_sign)) return region;
    countSeedFaces();
    if (!flood(wanted)) return region;
    region.found = true;
    region.sign = done_ == 0 ? 1 : -1;
    region.area_m2 = area_[done_];
    region.vertices = labelled_[done_];
    std::sort(region.vertices.begin(), region.vertices.end());
    return region;
  }

 private:
  double area(int face) const {
    const auto& [a, b, c] = mesh_.triangles[face];
    return 0.5 * norm(cross(x_[b] - x_[a], x_[c] - x_[a]));
  }

  std::span<const Piece> piecesIn(int face) const {
    const auto [lo, hi] = std::equal_range(pieces_.begin(), pieces_.end(), Piece{face, 0, 0, 0},
                                           [](const Piece& a, const Piece& b) { return a.face < b.face; });
    return {lo, hi};
  }

  std::span<const Cut> cutsOf(int edge) const {
    const auto [lo, hi] = std::equal_range(cuts_.begin(), cuts_.end(), Cut{edge, 0, 0, 0, {}},
                                           [](const Cut& a, const Cut& b) { return a.edge < b.edge; });
    return {lo, hi};
  }

  int flip(int edge) const { return cutsOf(edge).size() % 2 ? -1 : 1; }

  void put(int v, int sign) {
    label_[v] = static_cast<signed char>(sign);
    labelled_[sign > 0 ? 0 : 1].push_back(v);
  }

  /// Which side of the path is to its left in a face whose corners have these labels: +1 Omega+, -1 Omega-.
  int colourLeftOf(int path, int face, const std::array<int, 3>& corner_label) const {
    if (path == 0) return 1;
    for (int k = 0; k < 3; ++k) {
      const int e = mesh_.face_edges[face][k];
      int colour = corner_label[mesh_.triangles[face][k] == mesh_.edges[e][0] ? k : (k + 1) % 3];
      for (const Cut& cut : cutsOf(e)) {
        if (cut.path == path) return colour * cut.left;
        colour = -colour;
      }
    }
    return 1;  // not reached: a path without cuts is left out
  }

  /// Area of Omega+ in a face, by the boundary of the polygons: the pieces of the contour with Omega+ to their left,
  /// and the parts of the triangle's edges that are in Omega+, in the order of corners (Zheng 2013, eq. 4.9; any
  /// reference point will do, and one rule serves the types I to III).
  double plusArea(int face, const std::array<int, 3>& corner_label) const {
    const auto& corner = mesh_.triangles[face];
    const Vec3& o = x_[corner[0]];
    const Vec3 n = cross(x_[corner[1]] - o, x_[corner[2]] - o);
    if (!(norm2(n) > 0)) return 0;
    Vec3 sum;
    const auto add = [&](const Vec3& a, const Vec3& b, int sign) { sum += sign * cross(a - o, b - o); };
    for (const Piece& p : piecesIn(face)) {
      const Contour& c = *contours_[p.path].contour;
      add(c.points[p.segment].x, c.points[c.next(p.segment)].x, p.normal * colourLeftOf(p.path, face, corner_label));
    }
    for (int k = 0; k < 3; ++k) {
      const int e = mesh_.face_edges[face][k];
      const auto cuts = cutsOf(e);
      const bool backwards = corner[k] != mesh_.edges[e][0];
      Vec3 from = x_[corner[k]];
      bool inside = corner_label[k] > 0;
      const auto stop = [&](const Vec3& to) {
        if (inside) add(from, to, 1);
        from = to;
        inside = !inside;
      };
      for (std::size_t i = 0; i < cuts.size(); ++i) stop(cuts[backwards ? cuts.size() - 1 - i : i].x);
      stop(x_[corner[(k + 1) % 3]]);
    }
    return 0.5 * dot(sum, normalized(n));
  }

  /// The label of all vertices nearby where the first contour encloses none: with all in Omega-, is the area of Omega+
  /// positive?
  int signInside() const {
    double inner = 0;
    int last = -1;
    for (const Piece& p : pieces_)
      if (p.face != last) inner += plusArea(last = p.face, {-1, -1, -1});
    return inner >= 0 ? -1 : 1;
  }

  /// The corners of the first contour's triangles; false where that contradicts itself.
  bool labelHosts(int inner_sign) {
    std::vector<int> edges;
    for (const Piece& p : main_.pieces)
      edges.insert(edges.end(), mesh_.face_edges[p.face].begin(), mesh_.face_edges[p.face].end());
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    seed(edges, inner_sign);
    // The triangles hang together by their edges: a few sweeps label all corners.
    for (bool more = true; more;) {
      more = false;
      for (int e : edges) {
        const auto& [v, w] = mesh_.edges[e];
        if (label_[v] && label_[w]) {
          if (label_[v] != flip(e) * label_[w]) return false;
        } else if (label_[v]) {
          put(w, flip(e) * label_[v]), more = true;
        } else if (label_[w]) {
          put(v, flip(e) * label_[w]), more = true;
        }
      }
    }
    return true;
  }

  /// One vertex: preferably on an edge that the first contour crosses and no other does.
  void seed(const std::vector<int>& edges, int inner_sign) {
    for (const bool alone : {true, false})
      for (int e : edges) {
        int sum = 0, before = 0, label = 0;
        bool others = false;
        for (const Cut& cut : cutsOf(e)) {
          if (cut.path == 0) {
            if (sum == 0 && label == 0) label = before % 2 ? -cut.left : cut.left;
            sum += cut.left;
          }
          others = others || cut.path != 0;
          ++before;
        }
        if (sum == 0 || (alone && others)) continue;
        // Without others the label is the sum, whatever the order of the crossings.
        return put(mesh_.edges[e][0], others ? label : sum);
      }
    for (int e : edges) {
      const auto cuts = cutsOf(e);
      if (!cuts.empty() && std::all_of(cuts.begin(), cuts.end(), [](const Cut& cut) { return cut.path == 0; }))
        return put(mesh_.edges[e][0], inner_sign);
    }
    put(mesh_.edges[edges[0]][0], inner_sign);
  }

  /// Faces with all corners labelled, and cut faces with one labelled corner.
  void countSeedFaces() {
    std::vector<int> faces;
    for (const auto& part : labelled_)
      for (int v : part) faces.insert(faces.end(), mesh_.vertex_faces[v].begin(), mesh_.vertex_faces[v].end());
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    for (int f : faces) count(f);
  }

  /// Called whenever a corner has got its label.
  void count(int face) {
    const auto& corner = mesh_.triangles[face];
    if (const auto pieces = piecesIn(face); !pieces.empty()) {
      std::array<int, 3> label{label_[corner[0]], label_[corner[1]], label_[corner[2]]};
      const bool main = pieces[0].path == 0;
      std::array<bool, 2> wanted{main, main};
      for (int l : label)
        if (l) wanted[l > 0 ? 0 : 1] = true;
      for (int k = 0; k < 5; ++k)
        if (label[k % 3] && !label[(k + 1) % 3])
          label[(k + 1) % 3] = label[k % 3] * flip(mesh_.face_edges[face][k % 3]);
      for (int s = 0; s < 2; ++s) {
        if (!wanted[s] || !counted_[s].insert(face)) continue;
        const double plus = plusArea(face, label);
        area_[s] += s == 0 ? plus : area(face) - plus;
      }
    } else if (label_[corner[0]] && label_[corner[1]] && label_[corner[2]]) {
      area_[label_[corner[0]] > 0 ? 0 : 1] += area(face);
    }
  }

  /// Grows side s by the neighbours of one vertex; false where it meets the other side.
  bool grow(int s) {
    const int v = labelled_[s][next_[s]++];
    for (int e : mesh_.vertex_edges[v]) {
      if (flip(e) < 0) continue;
      const int w = mesh_.edges[e][0] == v ? mesh_.edges[e][1] : mesh_.edges[e][0];
      if (label_[w] == label_[v]) continue;
      if (label_[w]) return false;
      put(w, label_[v]);
      for (int f : mesh_.vertex_faces[w]) count(f);
    }
    return true;
  }

  bool exhausted(int s) const { return next_[s] == labelled_[s].size(); }

  bool flood(int wanted) {
    for (int turn = 0;; turn = 1 - turn) {
      if (wanted != 0) {
        done_ = wanted > 0 ? 0 : 1;
        if (exhausted(done_)) return true;
      } else {
        for (int s = 0; s < 2; ++s) {
          done_ = s;
          if (exhausted(s) && area_[s] <= area_[1 - s]) return true;
        }
        done_ = 0;
        if (exhausted(0) && exhausted(1)) return true;  // not reached with finite areas
      }
      if (!exhausted(turn) && !grow(turn)) return false;
    }
  }

  /// A small set of faces.
  struct FaceSet {
    std::vector<int> sorted;
    bool insert(int face) {
      const auto it = std::lower_bound(sorted.begin(), sorted.end(), face);
      if (it != sorted.end() && *it == face) return false;
      sorted.insert(it, face);
      return true;
    }
  };

  const ContactMesh& mesh_;
  std::span<const Vec3> x_;
  std::span<const ContourPath> contours_;
  std::vector<signed char>& label_;
  Path main_;
  std::vector<Cut> cuts_;                     ///< of all contours, by edge
  std::vector<Piece> pieces_;                 ///< of all contours, by face; the first contour's first
  std::array<std::vector<int>, 2> labelled_;  ///< Omega+, Omega-
  std::array<std::size_t, 2> next_{};
  std::array<double, 2> area_{};
  std::array<FaceSet, 2> counted_;  ///< cut faces whose share of the side is in area_
  int done_ = 0;
};

}  // namespace

ContourRegion floodRegion(const ContactMesh& mesh, std::span<const Vec3> x, std::span<const ContourPath> contours,
                          int sign, FloodWork& work) {
  assert(!contours.empty() && work.label.size() == static_cast<std::size_t>(mesh.vertex_count));
  return Fill(mesh, x, contours, work.label).run(sign);
}

}  // namespace gambeson
