#include "core/contact/mesh_surface.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/math/parallel.hpp"

namespace gambeson {

namespace {

/// Cells along the longest side: 4 mm for half a metre, at most 2 MB.
constexpr int kGridResolution = 128;

}  // namespace

MeshSurface::MeshSurface(const TriangleMesh& mesh, bool deforms)
    : topology_(meshTopology(mesh)), tree_(mesh.vertices, topology_.triangles) {
  owns_.resize(topology_.triangles.size());
  std::vector<char> vertex_owned(mesh.vertices.size(), 0);
  for (std::size_t e = 0; e < topology_.edges.size(); ++e) {
    const auto& c = topology_.edge_faces[topology_.edge_begin[e]];
    owns_[c.face].edges |= static_cast<unsigned char>(1 << c.k);
  }
  for (std::size_t t = 0; t < owns_.size(); ++t) {
    if (topology_.collapsed(static_cast<int>(t))) continue;
    for (int k = 0; k < 3; ++k) {
      char& owned = vertex_owned[topology_.triangles[t][k]];
      if (!owned) owns_[t].vertices |= static_cast<unsigned char>(1 << k);
      owned = 1;
    }
  }
  corners_begin_.assign(mesh.vertices.size() + 1, 0);
  const auto everyCorner = [&](auto&& visit) {
    for (std::size_t t = 0; t < owns_.size(); ++t)
      for (int k = 0; k < 3 && !topology_.collapsed(static_cast<int>(t)); ++k)
        visit(topology_.triangles[t][k], MeshTopology::Corner{static_cast<int>(t), k});
  };
  everyCorner([&](int v, const MeshTopology::Corner&) { ++corners_begin_[v + 1]; });
  std::partial_sum(corners_begin_.begin(), corners_begin_.end(), corners_begin_.begin());
  corners_.resize(corners_begin_.back());
  std::vector<int> next(corners_begin_.begin(), corners_begin_.end() - 1);
  everyCorner([&](int v, const MeshTopology::Corner& c) { corners_[next[v]++] = c; });
  std::vector<char> named(mesh.vertices.size(), 0);
  for (const std::array<int, 3>& t : topology_.triangles)
    for (int v : t) named[v] = 1;
  for (std::size_t v = 0; v < named.size(); ++v)
    if (named[v]) named_.push_back(static_cast<int>(v));
  place(mesh.vertices);
  if (topology_.closed && !deforms) {
    const auto is_inside = [&](const Vec3& p) {
      return nearest(p, std::numeric_limits<double>::infinity())->distance_m < 0;
    };
    std::vector<std::array<Vec3, 3>> corners;
    for (const auto& [a, b, c] : topology_.triangles) corners.push_back({x_[a], x_[b], x_[c]});
    inside_ = InsideGrid(corners, is_inside, kGridResolution);
  }
}

void MeshSurface::refit(std::span<const Vec3> vertices) {
  inside_ = {};
  tree_.moved();
  place(vertices);
}

void MeshSurface::place(std::span<const Vec3> vertices) {
  assert(vertices.size() == topology_.vertex_of.size());
  x_.resize(vertices.size());
  forAll(Each::value, static_cast<int>(vertices.size()), [&](int v) { x_[v] = vertices[v]; });
  bounds_ = {};
  for (int v : named_) bounds_.add(x_[v]);
  const MeshTopology& m = topology_;
  view_ = {x_.data(),
           1e-10 * norm(bounds_.halfSize()),
           static_cast<int>(m.triangles.size()),
           static_cast<int>(m.edges.size()),
           m.triangles.data(),
           m.face_edges.data(),
           m.edges.data(),
           m.edge_begin.data(),
           m.edge_faces.data(),
           m.vertex_begin.data(),
           m.vertex_edges.data(),
           corners_begin_.data(),
           corners_.data(),
           m.rim_edge.data(),
           m.rim_vertex.data(),
           owns_.data(),
           m.closed};
}

std::optional<MeshPoint> MeshSurface::nearest(const Vec3& p, double radius) const {
  SurfaceView::Nearest best{radius * radius};
  tree_.at(x_, topology_.triangles).nearest(p, best.dist2_m2, [&](int t, double&) { view_.lookAt(t, p, best); });
  if (best.feature < 0) return std::nullopt;
  return view_.signedFoot(p, best.position, best.feature);
}

void MeshSurface::touching(const Vec3& p, double radius, std::vector<MeshPoint>& out) const {
  const std::size_t begin = out.size();
  const auto add = [&](const MeshPoint& foot) { out.push_back(foot); };
  bool seen = false;
  tree_.at(x_, topology_.triangles).within(p, radius, [&](int t) { seen = view_.faceFeet(t, p, radius, add) || seen; });
  chooseFeet(p, radius, seen, begin, out);
}

void MeshSurface::touching(const Vec3& p, double radius, std::span<const int> triangles, std::vector<MeshPoint>& out,
                           bool outside) const {
  const std::size_t begin = out.size();
  const auto add = [&](const MeshPoint& foot) { out.push_back(foot); };
  bool seen = false;
  for (int t : triangles) seen = view_.faceFeet(t, p, radius, add) || seen;
  if (!outside || out.size() > begin) {
    chooseFeet(p, radius, seen, begin, out);
  } else if (seen) {
    // Beside all that is near, or a minimum that the predicates lost to rounding.
    SurfaceView::Nearest best{radius * radius};
    for (int t : triangles) view_.lookAt(t, p, best);
    if (best.feature >= 0) out.push_back(view_.signedFoot(p, best.position, best.feature));
  }
}

std::optional<MeshPoint> MeshSurface::wayOut(const Vec3& p, double within_m) const {
  if (!topology_.closed || boxDistance2(bounds_, p) > 0 || inside_.at(p) == InsideGrid::Cube::outside)
    return std::nullopt;
  return nearest(p, within_m);
}

/// Of the minima found from `begin`, those that p touches.
void MeshSurface::chooseFeet(const Vec3& p, double radius, bool seen, std::size_t begin,
                             std::vector<MeshPoint>& out) const {
  const auto found = out.begin() + static_cast<std::ptrdiff_t>(begin);
  const bool maybe_deep = topology_.closed && boxDistance2(bounds_, p) == 0;
  if (found == out.end()) {
    if (!seen && (!maybe_deep || inside_.at(p) == InsideGrid::Cube::outside)) return;
    // Deep inside, or a minimum that the predicates lost to rounding.
    const auto n = nearest(p, maybe_deep ? std::numeric_limits<double>::infinity() : radius);
    if (n && (n->distance_m < 0 || n->distance_m <= radius)) out.push_back(*n);
    return;
  }
  std::sort(found, out.end(), [](const MeshPoint& a, const MeshPoint& b) { return a.feature < b.feature; });
  const int count = static_cast<int>(out.end() - found);
  out.resize(begin + static_cast<std::size_t>(view_.chooseAmong(&*found, count)));
}

}  // namespace gambeson
