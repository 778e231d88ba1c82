#include "core/contact/contour_region.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <set>
#include <unordered_set>

namespace gambeson {

CutSurface::CutSurface(const ContactMesh& mesh, std::span<const ContourPath> contours) {
  for (const auto& from : contours) add(mesh, from);
  std::sort(cuts_.begin(), cuts_.end(), [](const Cut& a, const Cut& b) {
    return a.edge != b.edge   ? a.edge < b.edge
           : a.t != b.t       ? a.t < b.t
           : a.path != b.path ? a.path < b.path
                              : a.left < b.left;
  });
  std::stable_sort(pieces_.begin(), pieces_.end(), [](const Piece& a, const Piece& b) { return a.face < b.face; });
  std::sort(unclear_.begin(), unclear_.end());
}

void CutSurface::add(const ContactMesh& mesh, const ContourPath& from) {
  const Contour& c = *from.contour;
  const int number = static_cast<int>(paths_.size()), segments = static_cast<int>(c.segments.size());
  Path path{from, {}, false, c.closed[from.surface]};
  std::vector<Piece> pieces;
  for (int i = 0; i < segments; ++i)
    pieces.push_back({c.segments[i].face[from.surface], number, i, c.segments[i].normal[from.surface]});
  std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.face < b.face; });
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (i > 0 && pieces[i].face == pieces[i - 1].face) {
      path.valid = path.valid && pieces[i].normal == pieces[i - 1].normal;
      continue;
    }
    for (int e : mesh.face_edges[pieces[i].face]) path.edges.push_back(e);
  }
  std::sort(path.edges.begin(), path.edges.end());
  path.edges.erase(std::unique(path.edges.begin(), path.edges.end()), path.edges.end());
  std::vector<Cut> cuts;
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
    cuts.push_back({p.edge, p.edge_weight[1], number, left * s.normal[from.surface], p.x});
  }
  path.without_cuts = cuts.empty();
  std::sort(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) { return a.edge < b.edge; });
  for (std::size_t i = 0; i < cuts.size();) {
    int sum = 0;
    const int edge = cuts[i].edge;
    for (; i < cuts.size() && cuts[i].edge == edge; ++i) sum += cuts[i].left;
    path.valid = path.valid && std::abs(sum) <= 1;
  }
  if (path.valid) {
    cuts_.insert(cuts_.end(), cuts.begin(), cuts.end());
    pieces_.insert(pieces_.end(), pieces.begin(), pieces.end());
  } else {
    for (const Cut& cut : cuts) unclear_.push_back(cut.edge);
  }
  paths_.push_back(std::move(path));
}

std::span<const CutSurface::Cut> CutSurface::cutsOf(int edge) const {
  const auto [lo, hi] = std::equal_range(cuts_.begin(), cuts_.end(), Cut{edge, 0, 0, 0, {}},
                                         [](const Cut& a, const Cut& b) { return a.edge < b.edge; });
  return {lo, hi};
}

std::span<const CutSurface::Piece> CutSurface::piecesIn(int face) const {
  const auto [lo, hi] = std::equal_range(pieces_.begin(), pieces_.end(), Piece{face, 0, 0, 0},
                                         [](const Piece& a, const Piece& b) { return a.face < b.face; });
  return {lo, hi};
}

class RegionFill {
 public:
  RegionFill(const ContactMesh& mesh, std::span<const Vec3> x, const CutSurface& surface, int which,
             std::vector<signed char>& label)
      : mesh_(mesh), x_(x), surface_(surface), main_(which), label_(label) {}
  ~RegionFill() {
    for (const auto& part : labelled_)
      for (int v : part) label_[v] = 0;
  }
  RegionFill(const RegionFill&) = delete;
  RegionFill& operator=(const RegionFill&) = delete;

  ContourRegion run(int wanted) {
    ContourRegion region;
    if (!surface_.paths_[main_].valid || !labelHosts()) return region;
    countSeedFaces();
    if (!flood(wanted)) return region;
    region.found = true;
    region.sign = done_ == 0 ? 1 : -1;
    region.area_m2 = area_[done_];
    region.vertices = labelled_[done_];
    std::sort(region.vertices.begin(), region.vertices.end());
    region.beside.assign(beside_[done_].begin(), beside_[done_].end());
    return region;
  }

 private:
  double area(int face) const {
    const auto& [a, b, c] = mesh_.triangles[face];
    return 0.5 * norm(cross(x_[b] - x_[a], x_[c] - x_[a]));
  }

  using Cut = CutSurface::Cut;
  using Piece = CutSurface::Piece;
  std::span<const Cut> cutsOf(int edge) const { return surface_.cutsOf(edge); }

  int flip(int edge) const { return cutsOf(edge).size() % 2 ? -1 : 1; }

  void put(int v, int sign) {
    label_[v] = static_cast<signed char>(sign);
    labelled_[sign > 0 ? 0 : 1].push_back(v);
  }

  /// Which side of the path is to its left in a face whose corners have these labels: +1 Omega+, -1 Omega-.
  int colourLeftOf(int path, int face, const std::array<int, 3>& corner_label) const {
    if (path == main_) return 1;
    for (int k = 0; k < 3; ++k) {
      const int e = mesh_.face_edges[face][k];
      int colour = corner_label[mesh_.triangles[face][k] == mesh_.edges[e][0] ? k : (k + 1) % 3];
      for (const Cut& cut : cutsOf(e)) {
        if (cut.path == path) return colour * cut.left;
        colour = -colour;
      }
    }
    return 1;  // not reached: such paths are left out
  }

  /// Area of Omega+ in a face, by the boundary of the polygons: the pieces of the contour with Omega+ to their left,
  /// and the parts of the triangle's edges that are in Omega+, in the order of corners (Zheng 2013, eq. 4.9; any
  /// reference point will do, and one rule serves the types I to III).
  double plusArea(int face, const std::array<int, 3>& corner_label, bool only_main = false) const {
    const auto& corner = mesh_.triangles[face];
    const Vec3& o = x_[corner[0]];
    const Vec3 n = cross(x_[corner[1]] - o, x_[corner[2]] - o);
    if (!(norm2(n) > 0)) return 0;
    Vec3 sum;
    const auto add = [&](const Vec3& a, const Vec3& b, int sign) { sum += sign * cross(a - o, b - o); };
    for (const Piece& p : surface_.piecesIn(face)) {
      if (p.path != main_ && (only_main || surface_.paths_[p.path].without_cuts)) continue;
      const Contour& c = *surface_.paths_[p.path].from.contour;
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
      for (std::size_t i = 0; i < cuts.size(); ++i) {
        const Cut& cut = cuts[backwards ? cuts.size() - 1 - i : i];
        if (cut.path == main_ || !only_main) stop(cut.x);
      }
      stop(x_[corner[(k + 1) % 3]]);
    }
    return 0.5 * dot(sum, normalized(n));
  }

  /// The label of the vertices nearby where the contour encloses none: with all in Omega-, is the area of Omega+
  /// positive?
  int labelOutside() const {
    double inner = 0;
    std::vector<int> faces;
    const ContourPath& from = surface_.paths_[main_].from;
    for (const auto& s : from.contour->segments) faces.push_back(s.face[from.surface]);
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    for (int f : faces) inner += plusArea(f, {-1, -1, -1}, true);
    return inner >= 0 ? -1 : 1;
  }

  /// The corners of the contour's triangles; false where that contradicts itself.
  bool labelHosts() {
    const std::vector<int>& edges = surface_.paths_[main_].edges;
    seed(edges);
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

  /// Labels one vertex to grow from: preferably on an edge that this contour crosses and no other does.
  void seed(const std::vector<int>& edges) {
    for (const bool alone : {true, false})
      for (int e : edges) {
        int sum = 0, before = 0, label = 0;
        bool others = false;
        for (const Cut& cut : cutsOf(e)) {
          if (cut.path == main_) {
            if (label == 0) label = before % 2 ? -cut.left : cut.left;
            sum += cut.left;
          }
          others = others || cut.path != main_;
          ++before;
        }
        if (sum == 0 || (alone && others)) continue;
        // Without others the label is the sum, whatever the order of the crossings.
        return put(mesh_.edges[e][0], others ? label : sum);
      }
    int edge = edges[0];
    for (int e : edges) {
      const auto cuts = cutsOf(e);
      if (!cuts.empty() && std::all_of(cuts.begin(), cuts.end(), [&](const Cut& cut) { return cut.path == main_; }))
        edge = e;
    }
    put(mesh_.edges[edge][0], labelOutside());
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
    if (const auto pieces = surface_.piecesIn(face); !pieces.empty()) {
      std::array<int, 3> label{label_[corner[0]], label_[corner[1]], label_[corner[2]]};
      const bool main = std::any_of(pieces.begin(), pieces.end(), [&](const Piece& p) { return p.path == main_; });
      std::array<bool, 2> wanted{main, main};
      for (int l : label)
        if (l) wanted[l > 0 ? 0 : 1] = true;
      for (int k = 0; k < 5; ++k)
        if (label[k % 3] && !label[(k + 1) % 3])
          label[(k + 1) % 3] = label[k % 3] * flip(mesh_.face_edges[face][k % 3]);
      for (int s = 0; s < 2; ++s) {
        if (!wanted[s] || !counted_[s].insert(face).second) continue;
        const double plus = plusArea(face, label);
        area_[s] += s == 0 ? plus : area(face) - plus;
      }
    } else if (label_[corner[0]] && label_[corner[1]] && label_[corner[2]]) {
      area_[label_[corner[0]] > 0 ? 0 : 1] += area(face);
    }
  }

  /// Grows side s by the neighbours of one vertex; false where it meets the other side, or a contour without sides.
  bool grow(int s) {
    const int v = labelled_[s][next_[s]++];
    for (int e : mesh_.vertex_edges[v]) {
      if (std::binary_search(surface_.unclear_.begin(), surface_.unclear_.end(), e)) return false;
      if (const auto cuts = cutsOf(e); !cuts.empty()) {
        const Cut& nearest = mesh_.edges[e][0] == v ? cuts.front() : cuts.back();
        // From the upper vertex the last cut is seen from its other side.
        beside_[s].insert({nearest.path, mesh_.edges[e][0] == v ? nearest.left : -nearest.left});
        if (cuts.size() % 2) continue;
      }
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

  const ContactMesh& mesh_;
  std::span<const Vec3> x_;
  const CutSurface& surface_;
  int main_;
  std::vector<signed char>& label_;
  std::array<std::vector<int>, 2> labelled_;  ///< Omega+, Omega-
  std::array<std::size_t, 2> next_{};
  std::array<double, 2> area_{};
  std::array<std::unordered_set<int>, 2> counted_;  ///< cut faces whose share of the side is in area_
  std::array<std::set<std::array<int, 2>>, 2> beside_;
  int done_ = 0;
};

ContourRegion floodRegion(const ContactMesh& mesh, std::span<const Vec3> x, const CutSurface& surface, int which,
                          int sign, FloodWork& work) {
  assert(work.label.size() == static_cast<std::size_t>(mesh.vertex_count));
  return RegionFill(mesh, x, surface, which, work.label).run(sign);
}

}  // namespace gambeson
