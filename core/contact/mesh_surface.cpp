#include "core/contact/mesh_surface.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/contact/triangle.hpp"

namespace gambeson {

namespace {

/// Cells along the longest side: 4 mm for half a metre, at most 2 MB.
constexpr int kGridResolution = 128;

Vec3 unitOrZero(const Vec3& v) {
  const double l = norm(v);
  return l > 0 ? v / l : Vec3{};
}

/// Square of what rounding makes of a product of unit vectors and one of length 1, and far more.
constexpr double kRounding2 = 1e-26;

/// Whether |s|/sqrt(of2), as in MeshSurface::surely, is less than `radius` in spite of any rounding.
bool surelyWithin(double s, double of2, double r2, double radius) {
  const double radius2 = radius * radius;
  return s * s < 0.99 * radius2 * of2 && kRounding2 * r2 < 1e-6 * radius2;
}

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
  x_.assign(vertices.begin(), vertices.end());
  bounds_ = {};
  for (int v : named_) bounds_.add(x_[v]);
  tolerance_m_ = 1e-10 * norm(bounds_.halfSize());
}

/// Of twice the face's area.
inline Vec3 MeshSurface::areaNormal(int t) const {
  const auto& c = topology_.triangles[t];
  return cross(x_[c[1]] - x_[c[0]], x_[c[2]] - x_[c[0]]);
}

/// Unit; 0 for a triangle without area.
Vec3 MeshSurface::normalOf(int t) const { return topology_.collapsed(t) ? Vec3{} : unitOrZero(areaNormal(t)); }

/// Whether s/sqrt(of2), how far along a unit vector a point goes that is sqrt(r2) away, is beyond the tolerance in
/// spite of any rounding: 1 forwards, -1 backwards, 0 where that is not certain. It nearly always is, which spares the
/// unit vector.
inline int MeshSurface::surely(double s, double of2, double r2) const {
  if (!(s * s > 4 * (tolerance_m_ * tolerance_m_ + kRounding2 * r2) * of2)) return 0;
  return s > 0 ? 1 : -1;
}

/// Of a point at r from the edge's line, over a face with this normal, into which the edge e goes round.
inline MeshSurface::Side MeshSurface::sideOf(const Vec3& r, const Vec3& e, const Vec3& area_normal) const {
  const int sure = surely(dot(r, cross(area_normal, e)), norm2(area_normal) * norm2(e), norm2(r));
  if (sure != 0) return sure > 0 ? Side::in : Side::out;
  const double s = dot(r, unitOrZero(cross(unitOrZero(area_normal), e)));
  return s > tolerance_m_ ? Side::in : s < -tolerance_m_ ? Side::out : Side::on;
}

MeshSurface::EdgeFrame MeshSurface::edgeOf(int e) const {
  const Vec3 d = x_[topology_.edges[e].w] - x_[topology_.edges[e].v];
  return {unitOrZero(d), norm(d)};
}

Vec3 MeshSurface::edgeNormal(int e) const {
  Vec3 sum{};
  for (int i = topology_.edge_begin[e]; i < topology_.edge_begin[e + 1]; ++i)
    sum += normalOf(topology_.edge_faces[i].face);
  return unitOrZero(sum);
}

Vec3 MeshSurface::vertexNormal(int v) const {
  Vec3 sum{};
  for (int i = corners_begin_[v]; i < corners_begin_[v + 1]; ++i) {
    const auto [t, k] = corners_[i];
    const auto& c = topology_.triangles[t];
    const Vec3 e = x_[c[(k + 1) % 3]] - x_[c[k]], back = x_[c[(k + 2) % 3]] - x_[c[k]];
    sum += std::atan2(norm(cross(e, back)), dot(e, back)) * normalOf(t);
  }
  return unitOrZero(sum);
}

MaterialPoint MeshSurface::material(const MeshPoint& foot) const {
  const int n_faces = static_cast<int>(owns_.size()), n_edges = static_cast<int>(topology_.edges.size());
  MaterialPoint m;
  if (foot.feature >= n_faces + n_edges) {
    m.add(foot.feature - n_faces - n_edges, 1);
  } else if (foot.feature >= n_faces) {
    const int e = foot.feature - n_faces;
    const auto [v, w] = topology_.edges[e];
    const EdgeFrame f = edgeOf(e);
    const double t = f.length_m > 0 ? std::clamp(dot(foot.position - x_[v], f.direction) / f.length_m, 0.0, 1.0) : 0;
    m.add(v, 1 - t);
    m.add(w, t);
  } else {
    const auto& c = topology_.triangles[foot.feature];
    const Vec3 u = x_[c[1]] - x_[c[0]], s = x_[c[2]] - x_[c[0]], r = foot.position - x_[c[0]], n = cross(u, s);
    const double b = dot(cross(r, s), n) / norm2(n), d = dot(cross(u, r), n) / norm2(n);
    m.add(c[0], 1 - b - d);
    m.add(c[1], b);
    m.add(c[2], d);
  }
  return m;
}

MeshPoint MeshSurface::signedFoot(const Vec3& p, const Vec3& foot, int feature) const {
  const int n_faces = static_cast<int>(owns_.size()), n_edges = static_cast<int>(topology_.edges.size());
  MeshPoint m{foot, {}, 0, feature};
  if (feature < n_faces) {
    m.normal = normalOf(feature);
    m.distance_m = dot(p - foot, m.normal);
    return m;
  }
  const int e = feature - n_faces, v = e - n_edges;
  const bool is_edge = e < n_edges;
  const Vec3 r = p - foot;
  const double d = norm(r);
  // Closer than this the direction is rounding.
  const bool tells = d > 10 * tolerance_m_;
  // In front of each face there, as most are, it is in front of their mean.
  const auto inFront = [&](const MeshTopology::Corner& c) {
    const Vec3 n = areaNormal(c.face);
    const double h = dot(r, n);
    return h > 0 && h * h > kRounding2 * norm2(r) * norm2(n);
  };
  const auto faces = is_edge
                         ? std::span(topology_.edge_faces)
                               .subspan(topology_.edge_begin[e], topology_.edge_begin[e + 1] - topology_.edge_begin[e])
                         : std::span(corners_).subspan(corners_begin_[v], corners_begin_[v + 1] - corners_begin_[v]);
  if (tells && std::ranges::all_of(faces, inFront)) {
    m.distance_m = d;
    m.normal = r / d;
    return m;
  }
  const Vec3 pseudo = is_edge ? edgeNormal(e) : vertexNormal(v);
  const bool rim = is_edge ? topology_.rim_edge[e] : topology_.rim_vertex[v];
  const bool behind = !rim && dot(r, pseudo) < 0;
  m.distance_m = behind ? -d : d;
  m.normal = tells ? r / m.distance_m : pseudo;
  return m;
}

/// Of features that are equally near the first counts.
void MeshSurface::lookAt(int t, const Vec3& p, Nearest& best) const {
  if (topology_.collapsed(t)) return;
  const auto& c = topology_.triangles[t];
  const TrianglePoint q = closestOnTriangle({x_[c[0]], x_[c[1]], x_[c[2]]}, p);
  if (!(q.dist2_m2 <= best.dist2_m2)) return;
  const int feature = q.feature == kFace    ? t
                      : q.feature >= kEdge0 ? topology_.edgeFeature(topology_.face_edges[t][q.feature - kEdge0])
                                            : topology_.vertexFeature(c[q.feature]);
  if (q.dist2_m2 == best.dist2_m2 && best.feature >= 0 && best.feature < feature) return;
  best = {q.dist2_m2, q.position, feature};
}

std::optional<MeshPoint> MeshSurface::nearest(const Vec3& p, double radius) const {
  Nearest best{radius * radius};
  tree_.at(x_, topology_.triangles).nearest(p, best.dist2_m2, [&](int t, double&) { lookAt(t, p, best); });
  if (best.feature < 0) return std::nullopt;
  return signedFoot(p, best.position, best.feature);
}

/// Whether the distance of p to the edge and its faces, from face number `from` of these on, has its minimum on the
/// edge: the foot of p lies within the edge, and p above none of the faces. Sets that foot.
bool MeshSurface::edgeIsMinimum(int e, const Vec3& p, int from, Vec3& foot) const {
  const Vec3& a = x_[topology_.edges[e].v];
  const Vec3 r = p - a;
  for (int i = topology_.edge_begin[e] + from; i < topology_.edge_begin[e + 1]; ++i) {
    const auto [t, k] = topology_.edge_faces[i];
    const auto& c = topology_.triangles[t];
    if (sideOf(r, x_[c[(k + 1) % 3]] - x_[c[k]], areaNormal(t)) == Side::in) return false;
  }
  const EdgeFrame f = edgeOf(e);
  const double t = dot(r, f.direction);
  if (!(t >= -tolerance_m_ && t <= f.length_m + tolerance_m_)) return false;
  foot = a + std::clamp(t, 0.0, f.length_m) * f.direction;
  return true;
}

/// Whether the distance of p has its minimum around this vertex at the vertex: no edge leads from it towards p, and so
/// no triangle does, whose cone its edges span.
bool MeshSurface::vertexIsMinimum(int v, const Vec3& p) const {
  const Vec3 r = p - x_[v];
  const double r2 = norm2(r);
  for (int i = topology_.vertex_begin[v]; i < topology_.vertex_begin[v + 1]; ++i) {
    const int e = topology_.vertex_edges[i];
    const auto [from, to] = topology_.edges[e];
    const Vec3 d = x_[to] - x_[from];
    const int sure = surely(dot(r, d), norm2(d), r2), away = from == v ? 1 : -1;
    if (sure == away || (sure == 0 && away * dot(r, edgeOf(e).direction) > tolerance_m_)) return false;
  }
  return true;
}

/// Local minima that this triangle answers for. False: it is out of reach.
bool MeshSurface::faceFeet(int t, const Vec3& p, double radius, std::vector<MeshPoint>& out) const {
  const auto& c = topology_.triangles[t];
  const Vec3 r[3] = {p - x_[c[0]], p - x_[c[1]], p - x_[c[2]]}, n = areaNormal(t);
  if (norm2(n) == 0 && topology_.collapsed(t)) return false;
  if (!surelyWithin(dot(r[0], n), norm2(n), norm2(r[0]), radius) && std::abs(dot(r[0], unitOrZero(n))) > radius)
    return false;
  Side side[3];
  for (int k = 0; k < 3; ++k) side[k] = sideOf(r[k], x_[c[(k + 1) % 3]] - x_[c[k]], n);
  if (norm2(n) > 0 && std::ranges::find(side, Side::out) == std::end(side)) {
    const Vec3 normal = unitOrZero(n);
    const double h = dot(r[0], normal);
    out.push_back({p - h * normal, normal, h, t});
  }
  // This face alone often tells that it has a closer point than its edge or corner: the foot of p on the edge's line is
  // surely before its start, or past its end, or the edge leads from the corner towards p.
  const auto pastStart = [&](int k) {
    const Vec3 e = x_[c[(k + 1) % 3]] - x_[c[k]];
    return surely(dot(r[k], e), norm2(e), norm2(r[k]));
  };
  const auto beforeEnd = [&](int k) {
    const Vec3 e = x_[c[(k + 1) % 3]] - x_[c[k]];
    return surely(norm2(e) - dot(r[k], e), norm2(e), norm2(r[k]) + norm2(e));
  };
  for (int k = 0; k < 3; ++k) {
    const int edge = topology_.face_edges[t][k];
    const int next = side[k] == Side::out ? 1 : 0;  // this face is the first of the edges that it owns
    Vec3 foot;
    if ((owns_[t].edges >> k & 1) && side[k] != Side::in && pastStart(k) >= 0 && beforeEnd(k) >= 0 &&
        edgeIsMinimum(edge, p, next, foot) && norm2(p - foot) <= radius * radius)
      out.push_back(signedFoot(p, foot, topology_.edgeFeature(edge)));
    if ((owns_[t].vertices >> k & 1) && norm2(r[k]) <= radius * radius && pastStart(k) <= 0 &&
        beforeEnd((k + 2) % 3) <= 0 && vertexIsMinimum(c[k], p))
      out.push_back(signedFoot(p, x_[c[k]], topology_.vertexFeature(c[k])));
  }
  return true;
}

void MeshSurface::touching(const Vec3& p, double radius, std::vector<MeshPoint>& out) const {
  const std::size_t begin = out.size();
  bool seen = false;
  tree_.at(x_, topology_.triangles).within(p, radius, [&](int t) { seen = faceFeet(t, p, radius, out) || seen; });
  chooseFeet(p, radius, seen, begin, out);
}

void MeshSurface::touching(const Vec3& p, double radius, std::span<const int> triangles, std::vector<MeshPoint>& out,
                           bool outside) const {
  const std::size_t begin = out.size();
  bool seen = false;
  for (int t : triangles) seen = faceFeet(t, p, radius, out) || seen;
  if (!outside || out.size() > begin) {
    chooseFeet(p, radius, seen, begin, out);
  } else if (seen) {
    // Beside all that is near, or a minimum that the predicates lost to rounding.
    Nearest best{radius * radius};
    for (int t : triangles) lookAt(t, p, best);
    if (best.feature >= 0) out.push_back(signedFoot(p, best.position, best.feature));
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
  const auto nearest_it = std::min_element(found, out.end(), [](const MeshPoint& a, const MeshPoint& b) {
    return std::abs(a.distance_m) < std::abs(b.distance_m);
  });
  const double zero = 100 * tolerance_m_;  // a point this deep is on the surface
  if (nearest_it->distance_m < -zero) {
    *found = MeshPoint(*nearest_it);
    out.erase(found + 1, out.end());
    return;
  }
  // Feet that neighbouring features share within the tolerance are one contact; minima on the far side are not seen.
  const double same2 = zero * zero;
  auto keep = found;
  for (auto it = found; it != out.end(); ++it) {
    if (it->distance_m < -zero) continue;
    const bool is_face = it->feature < static_cast<int>(owns_.size());
    const bool twin = std::any_of(found, keep, [&](const MeshPoint& k) {
      return norm2(k.position - it->position) <= same2 && (!is_face || dot(k.normal, it->normal) > 1 - 1e-9);
    });
    if (!twin) *keep++ = *it;
  }
  out.erase(keep, out.end());
}

}  // namespace gambeson
