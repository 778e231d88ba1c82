#include "core/cloth/triangles/triangle_build.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "core/cloth/triangles/hinge_angle.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

/// The flat shape of a triangle in the basis of its threads: corners 1 and 2 from corner 0 [m].
using Flat = std::array<Vec2, 2>;

Vec2 minus(const Vec2& a, const Vec2& b) { return {a.x - b.x, a.y - b.y}; }

/// The flat shape of a triangle from its corners in space; `uv` turns the weft to where u grows and v stays. Without uv
/// the weft is the direction in the triangle nearest to the x axis (to y where the triangle faces x).
Flat flatOfShape(const std::array<Vec3, 3>& X, const std::array<Vec2, 3>* uv, const std::string& name) {
  const Vec3 e1 = X[1] - X[0], e2 = X[2] - X[0], n = normalized(cross(e1, e2));
  Vec3 weft;
  if (uv) {
    const Vec2 d1 = minus((*uv)[1], (*uv)[0]), d2 = minus((*uv)[2], (*uv)[0]);
    const double det = d1.x * d2.y - d1.y * d2.x;
    weft = d2.y * e1 - d1.y * e2;
    if (det < 0) weft = -weft;
    if (!(std::abs(det) > 1e-9 * std::max(d1.x * d1.x + d1.y * d1.y, d2.x * d2.x + d2.y * d2.y)) || !(norm(weft) > 0))
      throw InputError({"", 0, "uv"}, name + " has no area in uv, so that its threads have no direction");
  } else {
    weft = std::abs(n.x) < 0.9 ? Vec3{1, 0, 0} - n.x * n : Vec3{0, 1, 0} - n.y * n;
  }
  weft = normalized(weft);
  const Vec3 warp = cross(n, weft);
  return {Vec2{dot(e1, weft), dot(e1, warp)}, Vec2{dot(e2, weft), dot(e2, warp)}};
}

/// The flat shape of a triangle from uv alone; where that runs the other way around (a mirrored piece) the warp is
/// turned over.
Flat flatOfUv(const std::array<Vec2, 3>& uv, const std::string& name) {
  Vec2 d1 = minus(uv[1], uv[0]), d2 = minus(uv[2], uv[0]);
  const double det = d1.x * d2.y - d1.y * d2.x;
  if (!(std::abs(det) > 1e-9 * std::max(d1.x * d1.x + d1.y * d1.y, d2.x * d2.x + d2.y * d2.y)))
    throw InputError({"", 0, "uv"}, name + " has no area in uv");
  if (det < 0) d1.y = -d1.y, d2.y = -d2.y;
  return {d1, d2};
}

MembraneTriangle membraneOf(const Flat& f, const std::array<int, 3>& corner, int law) {
  const double det = f[0].x * f[1].y - f[0].y * f[1].x;
  MembraneTriangle t;
  t.corner = corner;
  t.g = {Vec2{f[1].y / det, -f[1].x / det}, Vec2{-f[0].y / det, f[0].x / det}};
  t.area_m2 = 0.5 * det;
  t.law = law;
  return t;
}

/// The direction tensor of the normal of an edge from corner a to corner b of a triangle, in the basis of its threads.
Vec3 acrossEdge(const Flat& f, std::size_t a, std::size_t b) {
  const Vec2 at[3] = {{}, f[0], f[1]};
  const Vec2 d = minus(at[b], at[a]);
  const double l2 = d.x * d.x + d.y * d.y;
  return {d.y * d.y / l2, d.x * d.x / l2, -2 * d.x * d.y / l2};
}

double lengthOf(const Flat& f, std::size_t a, std::size_t b) {
  const Vec2 at[3] = {{}, f[0], f[1]};
  const Vec2 d = minus(at[b], at[a]);
  return std::hypot(d.x, d.y);
}

/// An edge of a triangle, by corners.
struct EdgeOf {
  std::size_t triangle = 0;
  std::size_t from = 0, to = 0;
};

/// Adds one garment.
class Builder {
 public:
  Builder(const MeshDraft& garment, int number, int first_seam, int first_vertex, TriangleParts& parts)
      : g_(garment),
        mesh_(garment.mesh),
        out_(parts),
        first_patch_(static_cast<int>(parts.patches.size())),
        first_triangle_(parts.triangles.size()),
        first_fabric_(static_cast<int>(parts.fabrics.size())),
        first_vertex_(first_vertex) {
    checkMesh(mesh_);
    if (g_.fabrics.empty()) throw InputError({"", 0, "fabric"}, "a garment of triangles needs a fabric");
    if (g_.rest == MeshRest::flat && mesh_.uv.empty())
      throw InputError({"", 0, "rest"}, "needs uv coordinates to lie flat by; the mesh has none");
    out_.fabrics.insert(out_.fabrics.end(), g_.fabrics.begin(), g_.fabrics.end());
    out_.membrane_models.resize(out_.fabrics.size(), g_.membrane);
    findColumns();
    addPoints(number);
    addMembranes();
    addHinges();
    addSides();
    out_.sewn = out_.sewn || !g_.ties.empty();
    for (MeshTie tie : g_.closed ? std::vector<MeshTie>{} : g_.ties) {
      for (std::size_t k = 0; k < 2; ++k) tie.vertex[k] = pointOf(tie.patch[k], tie.vertex[k]);
      tie.seam += first_seam;
      out_.ties.push_back(tie);
    }
    addSeamSprings();
    out_.T.column_count += columns_;
  }

 private:
  /// The free point that each vertex is: its own, or that of all to which closed seams tie it.
  void findColumns() {
    const auto n = mesh_.vertices.size();
    std::vector<int> lowest(n);
    std::iota(lowest.begin(), lowest.end(), 0);
    const auto find = [&](int v) {
      while (lowest[static_cast<std::size_t>(v)] != v) v = lowest[static_cast<std::size_t>(v)];
      return v;
    };
    if (g_.closed)
      for (const MeshTie& tie : g_.ties) {
        const int a = find(tie.vertex[0]), b = find(tie.vertex[1]);
        lowest[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
      }
    column_.resize(n);
    for (std::size_t v = 0; v < n; ++v) {
      const int own = find(static_cast<int>(v));
      column_[v] = own == static_cast<int>(v) ? columns_++ : column_[static_cast<std::size_t>(own)];
    }
  }

  void addPoints(int number) {
    point_of_.resize(mesh_.patch_names.size());
    std::size_t next = 0;
    for (std::size_t p = 0; p < point_of_.size(); ++p) {
      ClothPatch patch{mesh_.patch_names[p], number, static_cast<int>(out_.rest.size()), 0, {}, {}, {}};
      out_.first_triangle.push_back(static_cast<int>(first_triangle_ + next));
      for (; next < mesh_.triangles.size() && mesh_.patch[next] == static_cast<int>(p); ++next)
        for (int v : mesh_.triangles[next]) {
          if (!point_of_[p].emplace(v, static_cast<int>(out_.rest.size())).second) continue;
          out_.rest.push_back(mesh_.vertices[static_cast<std::size_t>(v)]);
          out_.vertex.push_back(first_vertex_ + v);
          out_.T.add(out_.T.column_count + column_[static_cast<std::size_t>(v)], 1);
          out_.T.endRow();
        }
      patch.end_point = static_cast<int>(out_.rest.size());
      if (!g_.range.empty()) patch.low = g_.range[p][0], patch.high = g_.range[p][1];
      out_.patches.push_back(patch);
      out_.drafted.push_back(!g_.range.empty());
      out_.lines.push_back(g_.lines.empty() ? std::array<std::vector<double>, 2>{} : g_.lines[p]);
      out_.sides.emplace_back(4);
    }
  }

  int pointOf(int patch, int vertex) const { return point_of_[static_cast<std::size_t>(patch)].at(vertex); }

  void addMembranes() {
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      std::array<int, 3> points{};
      std::array<Vec3, 3> X;
      for (std::size_t k = 0; k < 3; ++k) {
        points[k] = pointOf(mesh_.patch[t], mesh_.triangles[t][k]);
        X[k] = out_.rest[static_cast<std::size_t>(points[k])];
      }
      const std::string name = "triangle " + std::to_string(t + 1);
      const std::array<Vec2, 3>* uv = mesh_.uv.empty() ? nullptr : &mesh_.uv[t];
      flats_.push_back(g_.rest == MeshRest::flat ? flatOfUv(*uv, name) : flatOfShape(X, uv, name));
      const int fabric = first_fabric_ + (g_.fabric.empty() ? 0 : g_.fabric[t]);
      out_.membranes.push_back(membraneOf(flats_.back(), points, fabric));
      out_.membranes.back().bending = g_.bending;
      out_.membranes.back().bending_spring_N_per_m = g_.bending_spring_N_per_m;
      out_.triangles.push_back(points);
      out_.fabric_of_triangle.push_back(fabric);
      out_.draft.push_back(g_.draft.empty() ? std::array<Vec2, 3>{} : g_.draft[t]);
    }
  }

  void addHinges() {
    std::map<std::pair<int, int>, EdgeOf> open;  // directed edges, by vertices
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const EdgeOf two{t, k, (k + 1) % 3};
        const int from = mesh_.triangles[t][two.from], to = mesh_.triangles[t][two.to];
        const auto at = open.find({to, from});
        if (at == open.end())
          open[{from, to}] = two;
        else
          out_.hinges.push_back(hingeOf(at->second, two));
      }
  }

  FoldHinge hingeOf(const EdgeOf& one, const EdgeOf& two) const {
    const std::size_t first = first_triangle_ + one.triangle, second = first_triangle_ + two.triangle;
    const std::array<int, 3>&a = out_.triangles[first], &b = out_.triangles[second];
    const Flat &fa = flats_[one.triangle], &fb = flats_[two.triangle];
    FoldHinge h;
    h.corner = {a[one.from], a[one.to], a[3 - one.from - one.to], b[3 - two.from - two.to]};
    h.triangle = {static_cast<int>(first), static_cast<int>(second)};
    h.area_m2 = out_.membranes[first].area_m2 + out_.membranes[second].area_m2;
    h.per_angle = 0.5 * (lengthOf(fa, one.from, one.to) + lengthOf(fb, two.from, two.to)) / h.area_m2;
    h.d = 0.5 * (acrossEdge(fa, one.from, one.to) + acrossEdge(fb, two.from, two.to));
    h.law = out_.fabric_of_triangle[first];
    h.seam = mesh_.patch[one.triangle] != mesh_.patch[two.triangle];
    const auto at = [&](std::size_t k) { return out_.rest[static_cast<std::size_t>(h.corner[k])]; };
    if (g_.rest == MeshRest::shape ||
        (g_.rest == MeshRest::fabric && hasRestCurvature(out_.fabrics[static_cast<std::size_t>(h.law)])))
      h.theta0 = foldAngle({at(0), at(1), at(2), at(3)}, nullptr);
    return h;
  }

  void addSeamSprings() {
    if (g_.springs.empty()) return;
    std::map<std::pair<int, int>, int> triangle_at;  // of edges as points, in the sense of their triangle
    for (std::size_t t = first_triangle_; t < out_.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        triangle_at[{out_.triangles[t][k], out_.triangles[t][(k + 1) % 3]}] = static_cast<int>(t);
    for (const MeshSpring& s : g_.springs) {
      SeamSpring spring{{}, {}, s.stiffness_N, s.rest_angle_rad};
      for (std::size_t side = 0; side < 2; ++side) {
        for (std::size_t end = 0; end < 2; ++end) spring.edge[side][end] = pointOf(s.patch[side], s.edge[side][end]);
        const auto [from, to] = spring.edge[side];
        const auto forward = triangle_at.find({from, to});
        spring.triangle[side] = forward != triangle_at.end() ? forward->second : triangle_at.at({to, from});
      }
      out_.seam_springs.push_back(spring);
    }
  }

  /// Sides, and which of them are sewn to another patch along their whole length.
  void addSides() {
    std::map<std::pair<int, int>, std::vector<int>> patches_at;  // undirected edges of vertices
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        patches_at[std::minmax(mesh_.triangles[t][k], mesh_.triangles[t][(k + 1) % 3])].push_back(mesh_.patch[t]);
    const std::vector<int> side_of = sideOfLine(mesh_);
    for (std::size_t k = 0; k < mesh_.lines.size(); ++k) {
      const MeshLine& line = mesh_.lines[k];
      const auto patch = static_cast<std::size_t>(first_patch_ + line.patch),
                 side = static_cast<std::size_t>(side_of[k]);
      if (out_.sides[patch].size() <= side) out_.sides[patch].resize(side + 1);
      bool sewn = true;
      for (std::size_t i = 0; i < line.vertices.size(); ++i) {
        out_.sides[patch][side].push_back(pointOf(line.patch, line.vertices[i]));
        if (i == 0) continue;
        const std::vector<int>& at = patches_at.at(std::minmax(line.vertices[i - 1], line.vertices[i]));
        sewn = sewn && std::any_of(at.begin(), at.end(), [&](int p) { return p != line.patch; });
      }
      if (side < 4) out_.patches[patch].sewn[side] = sewn;
    }
  }

  const MeshDraft& g_;
  const ClothMesh& mesh_;
  TriangleParts& out_;
  int first_patch_;
  std::size_t first_triangle_;
  int first_fabric_;
  int first_vertex_;
  std::vector<int> column_;  ///< of each vertex, from the garment's first on
  int columns_ = 0;
  std::vector<std::map<int, int>> point_of_;  ///< of each patch: vertex to point
  std::vector<Flat> flats_;
};

}  // namespace

TriangleParts buildTriangles(std::span<const MeshDraft> garments) {
  if (garments.empty()) throw InputError({"", 0, "garments"}, "at least one garment is needed");
  TriangleParts parts;
  int seams = 0, vertices = 0;
  for (std::size_t g = 0; g < garments.size(); ++g) {
    Builder(garments[g], static_cast<int>(g), seams, vertices, parts);
    seams += garments[g].sewn_seams;
    vertices += static_cast<int>(garments[g].mesh.vertices.size());
  }
  parts.first_triangle.push_back(static_cast<int>(parts.triangles.size()));
  return parts;
}

}  // namespace gambeson
