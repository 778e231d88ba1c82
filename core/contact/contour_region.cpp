#include "core/contact/contour_region.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace gambeson {
namespace {

/// A crossing of the contour with an edge of the surface.
struct Cut {
  int edge;
  double t;  ///< from the lower vertex of the edge
  int left;  ///< +1 where the lower vertex lies to the left of the contour, -1 to the right
  Vec3 x;
};

struct Host {
  int face, normal;
  double area = 0;
  double plus = 0;                  ///< area of its part of Omega+
  std::vector<int> first_segments;  ///< segments inside
};

class Fill {
 public:
  Fill(const ContactMesh& mesh, std::span<const Vec3> x, const Contour& contour, int surface,
       std::vector<signed char>& label)
      : mesh_(mesh), x_(x), contour_(contour), surface_(surface), label_(label) {}
  ~Fill() {
    for (const auto& part : labelled_)
      for (int v : part) label_[v] = 0;
  }
  Fill(const Fill&) = delete;
  Fill& operator=(const Fill&) = delete;

  ContourRegion run(int wanted) {
    ContourRegion region;
    if (!collectHosts() || !collectCuts() || !labelHosts()) return region;
    for (const auto& h : hosts_) {
      area_[0] += h.plus;
      area_[1] += h.area - h.plus;
    }
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
  bool collectHosts() {
    std::vector<std::array<int, 3>> visits;  // face, segment, normal
    for (std::size_t i = 0; i < contour_.segments.size(); ++i)
      visits.push_back(
          {contour_.segments[i].face[surface_], static_cast<int>(i), contour_.segments[i].normal[surface_]});
    std::sort(visits.begin(), visits.end());
    for (const auto& [face, segment, normal] : visits) {
      if (hosts_.empty() || hosts_.back().face != face) {
        hosts_.push_back({face, normal, 0, 0, {}});
        hosts_.back().area = area(face);
      }
      if (hosts_.back().normal != normal) return false;  // a one-sided surface
      hosts_.back().first_segments.push_back(segment);
    }
    return true;
  }

  double area(int face) const {
    const auto& [a, b, c] = mesh_.triangles[face];
    return 0.5 * norm(cross(x_[b] - x_[a], x_[c] - x_[a]));
  }

  bool isHost(int face) const {
    const auto it =
        std::lower_bound(hosts_.begin(), hosts_.end(), face, [](const Host& h, int f) { return h.face < f; });
    return it != hosts_.end() && it->face == face;
  }

  /// A contour that leaves a face through its edge p -> q has q to its left, seen against the normal of that order.
  bool collectCuts() {
    const int segments = static_cast<int>(contour_.segments.size());
    for (int i = 0; i < static_cast<int>(contour_.points.size()); ++i) {
      const ContourPoint& p = contour_.points[i];
      if (p.owner != surface_) continue;
      const bool leaves = i > 0 || contour_.cyclic;  // else the contour starts here
      const ContourSegment& s = contour_.segments[leaves ? (i + segments - 1) % segments : 0];
      const int face = s.face[surface_];
      int left = -1;
      for (int k = 0; k < 3; ++k)
        if (mesh_.face_edges[face][k] == p.edge && mesh_.triangles[face][k] != mesh_.edges[p.edge][0]) left = 1;
      if (!leaves) left = -left;
      cuts_.push_back({p.edge, p.edge_weight[1], left * s.normal[surface_], p.x});
    }
    std::sort(cuts_.begin(), cuts_.end(), [](const Cut& a, const Cut& b) {
      return a.edge != b.edge ? a.edge < b.edge : a.t != b.t ? a.t < b.t : a.left < b.left;
    });
    for (std::size_t i = 0; i < cuts_.size();) {
      int sum = 0;
      const int edge = cuts_[i].edge;
      for (; i < cuts_.size() && cuts_[i].edge == edge; ++i) sum += cuts_[i].left;
      if (std::abs(sum) > 1) return false;  // winds more than once
    }
    return true;
  }

  std::span<const Cut> cutsOf(int edge) const {
    const auto [lo, hi] = std::equal_range(cuts_.begin(), cuts_.end(), Cut{edge, 0, 0, {}},
                                           [](const Cut& a, const Cut& b) { return a.edge < b.edge; });
    return {lo, hi};
  }

  void put(int v, int sign) {
    label_[v] = static_cast<signed char>(sign);
    labelled_[sign > 0 ? 0 : 1].push_back(v);
  }

  /// Labels the corners of all hosts; false where that contradicts itself.
  bool labelHosts() {
    bool odd = false;
    for (std::size_t i = 0; i < cuts_.size() && !odd; ++i) {
      int sum = 0;
      for (const auto& c : cutsOf(cuts_[i].edge)) sum += c.left;
      if (sum == 0) continue;
      odd = true;
      put(mesh_.edges[cuts_[i].edge][0], sum);
      put(mesh_.edges[cuts_[i].edge][1], -sum);
    }
    if (!odd) put(mesh_.triangles[hosts_[0].face][0], -1);
    std::vector<int> corners, edges;
    for (const auto& h : hosts_)
      for (int k = 0; k < 3; ++k) edges.push_back(mesh_.face_edges[h.face][k]);
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    // The hosts of a contour hang together by their edges: a few sweeps label all.
    for (bool more = true; more;) {
      more = false;
      for (int e : edges) {
        const auto& [v, w] = mesh_.edges[e];
        const int flip = cutsOf(e).size() % 2 ? -1 : 1;
        if (label_[v] && label_[w]) {
          if (label_[v] != flip * label_[w]) return false;
        } else if (label_[v]) {
          put(w, flip * label_[v]), more = true;
        } else if (label_[w]) {
          put(v, flip * label_[w]), more = true;
        }
      }
    }
    for (auto& h : hosts_) h.plus = plusArea(h);
    if (odd) return true;
    double inner = 0;
    for (const auto& h : hosts_) inner += h.plus;
    if (inner >= 0) return true;  // Omega+ is inside, no vertex in it
    for (int v : labelled_[1]) label_[v] = 1;
    labelled_[0].swap(labelled_[1]);
    for (auto& h : hosts_) h.plus = plusArea(h);
    return true;
  }

  /// Area of Omega+ in a host, by the boundary of the polygons: the pieces of the contour, forwards, and the parts of
  /// the triangle's edges that are in Omega+, counterclockwise about the carried normal (Zheng 2013, eq. 4.9; any
  /// reference point will do, and one rule serves the types I to III).
  double plusArea(const Host& h) const {
    const auto& corner = mesh_.triangles[h.face];
    const Vec3& o = x_[corner[0]];
    const Vec3 n = cross(x_[corner[1]] - o, x_[corner[2]] - o);
    if (!(norm2(n) > 0)) return 0;
    Vec3 sum;
    const auto add = [&](const Vec3& a, const Vec3& b) { sum += cross(a - o, b - o); };
    for (int i : h.first_segments) add(contour_.points[i].x, contour_.points[contour_.next(i)].x);
    for (int k = 0; k < 3; ++k) {
      const int v = corner[k], w = corner[(k + 1) % 3];
      const auto cuts = cutsOf(mesh_.face_edges[h.face][k]);
      const bool backwards = v != mesh_.edges[mesh_.face_edges[h.face][k]][0];
      Vec3 from = x_[v];
      bool inside = label_[v] > 0;
      const auto stop = [&](const Vec3& to) {
        if (inside) h.normal > 0 ? add(from, to) : add(to, from);
        from = to;
        inside = !inside;
      };
      for (std::size_t i = 0; i < cuts.size(); ++i) stop(cuts[backwards ? cuts.size() - 1 - i : i].x);
      stop(x_[w]);
    }
    return 0.5 * h.normal * dot(sum, normalized(n));
  }

  /// Faces that are not cut, with all corners among the corners of hosts.
  void countSeedFaces() {
    std::vector<int> faces;
    for (const auto& part : labelled_)
      for (int v : part)
        for (int f : mesh_.vertex_faces[v]) faces.push_back(f);
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    for (int f : faces) count(f);
  }

  void count(int face) {
    const auto& [a, b, c] = mesh_.triangles[face];
    if (label_[a] && label_[b] && label_[c] && !isHost(face)) area_[label_[a] > 0 ? 0 : 1] += area(face);
  }

  /// Grows side s by the neighbours of one vertex; false where it meets the other side.
  bool grow(int s) {
    const int v = labelled_[s][next_[s]++];
    for (int e : mesh_.vertex_edges[v]) {
      const int w = mesh_.edges[e][0] == v ? mesh_.edges[e][1] : mesh_.edges[e][0];
      if (label_[w]) {
        if (label_[w] != label_[v] && cutsOf(e).size() % 2 == 0) return false;
        continue;
      }
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
  const Contour& contour_;
  int surface_;
  std::vector<signed char>& label_;
  std::vector<Host> hosts_;
  std::vector<Cut> cuts_;
  std::array<std::vector<int>, 2> labelled_;  ///< Omega+, Omega-
  std::array<std::size_t, 2> next_{};
  std::array<double, 2> area_{};
  int done_ = 0;
};

}  // namespace

ContourRegion floodRegion(const ContactMesh& mesh, std::span<const Vec3> x, const Contour& contour, int surface,
                          int sign, FloodWork& work) {
  assert(contour.closed[surface] && work.label.size() == static_cast<std::size_t>(mesh.vertex_count));
  return Fill(mesh, x, contour, surface, work.label).run(sign);
}

}  // namespace gambeson
