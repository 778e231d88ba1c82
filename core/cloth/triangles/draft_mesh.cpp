#include "core/cloth/triangles/draft_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "core/cloth/draft/cells.hpp"
#include "core/cloth/draft/seams.hpp"
#include "core/cloth/triangles/sewn_mesh.hpp"
#include "core/error.hpp"
#include "core/nurbs/trim_mesh.hpp"

namespace gambeson {
namespace {

[[noreturn]] void reject(const std::string& reason) { throw InputError({"", 0, "mesh"}, reason); }

/// The triangles of one patch in its parameters, the lines of its grid if it has one, and the points of its sides
/// u0, u1, v0, v1, ascending.
struct PatchMesh {
  std::vector<Vec2> uv;
  std::vector<std::array<int, 3>> triangles;
  std::array<std::vector<double>, 2> lines;
  std::array<std::vector<int>, 4> sides;
};

void findSides(const NurbsPatch& patch, PatchMesh& m) {
  const double line[] = {patch.u.front(), patch.u.back(), patch.v.front(), patch.v.back()};
  for (std::size_t side = 0; side < 4; ++side) {
    std::vector<std::pair<double, int>> on;
    for (std::size_t k = 0; k < m.uv.size(); ++k)
      if ((side < 2 ? m.uv[k].x : m.uv[k].y) == line[side])
        on.emplace_back(side < 2 ? m.uv[k].y : m.uv[k].x, static_cast<int>(k));
    std::sort(on.begin(), on.end());
    for (const auto& entry : on) m.sides[side].push_back(entry.second);
  }
}

PatchMesh gridMesh(const std::vector<double>& us, const std::vector<double>& vs, bool alternating) {
  PatchMesh m;
  const int nu = static_cast<int>(us.size()), nv = static_cast<int>(vs.size());
  for (double v : vs)
    for (double u : us) m.uv.push_back({u, v});
  for (int j = 0; j + 1 < nv; ++j)
    for (int i = 0; i + 1 < nu; ++i) {
      const int a = i + nu * j, b = a + 1, c = a + 1 + nu, d = a + nu;
      if (alternating && (i + j) % 2 == 1) {
        m.triangles.push_back({a, b, d});
        m.triangles.push_back({b, c, d});
      } else {
        m.triangles.push_back({a, b, c});
        m.triangles.push_back({a, c, d});
      }
    }
  return m;
}

/// `rows` is even. Where rows lie between the lines of cells they divide these evenly.
PatchMesh rowsMesh(const std::vector<double>& us, const std::vector<double>& vs, int rows) {
  PatchMesh m;
  const int n = static_cast<int>(us.size()) - 1, cells = static_cast<int>(vs.size()) - 1;
  std::vector<int> first;
  for (int j = 0; j <= rows; ++j) {
    const double at = static_cast<double>(j) * cells / rows;
    const int k = std::min(static_cast<int>(at), cells - 1);
    const double v = j == rows ? vs.back()
                               : vs[static_cast<std::size_t>(k)] +
                                     (at - k) * (vs[static_cast<std::size_t>(k + 1)] - vs[static_cast<std::size_t>(k)]);
    first.push_back(static_cast<int>(m.uv.size()));
    if (j % 2 == 0) {
      for (double u : us) m.uv.push_back({u, v});
      continue;
    }
    m.uv.push_back({us.front(), v});
    for (int i = 0; i < n; ++i)
      m.uv.push_back({0.5 * (us[static_cast<std::size_t>(i)] + us[static_cast<std::size_t>(i + 1)]), v});
    m.uv.push_back({us.back(), v});
  }
  for (int j = 0; j < rows; ++j) {
    const int low = first[static_cast<std::size_t>(j)], high = first[static_cast<std::size_t>(j + 1)];
    for (int k = 0; k <= n; ++k) {
      if (j % 2 == 0) {
        m.triangles.push_back({low + k, high + k + 1, high + k});
        if (k < n) m.triangles.push_back({low + k, low + k + 1, high + k + 1});
      } else {
        m.triangles.push_back({low + k, low + k + 1, high + k});
        if (k < n) m.triangles.push_back({low + k + 1, high + k + 1, high + k});
      }
    }
  }
  return m;
}

/// The mean height of a cell over the height of an equilateral triangle on its width, of all patches by area: one
/// number, so that patches whose edges have as many cells have as many rows.
double rowsPerCell(const Garment& g) {
  double sum = 0, area = 0;
  for (const SheetCell& cell : sheetCells(g)) {
    const NurbsPatch& p = g.patches[static_cast<std::size_t>(cell.patch)];
    const auto d = surfaceDerivatives(p, 0.5 * (cell.u0 + cell.u1), 0.5 * (cell.v0 + cell.v1));
    const double width = norm(d[1]) * (cell.u1 - cell.u0), height = norm(d[2]) * (cell.v1 - cell.v0),
                 dA = width * height;
    if (!(width > 0)) continue;
    sum += dA * height / (0.5 * std::sqrt(3.0) * width);
    area += dA;
  }
  return area > 0 ? sum / area : 1;
}

std::array<bool, 4> joinedSides(const Garment& g, int patch) {
  std::array<bool, 4> joined{};
  for (const Seam& seam : g.seams)
    for (const PatchEdge& e : {seam.a, seam.b})
      if (e.patch == patch) joined[static_cast<std::size_t>(e.side)] = true;
  return joined;
}

PatchMesh meshOf(const Garment& g, int index, MeshKind kind, double rows_per_cell) {
  const NurbsPatch& patch = g.patches[static_cast<std::size_t>(index)];
  const std::vector<double> us = breakpoints(patch.u), vs = breakpoints(patch.v);
  PatchMesh m;
  if (isTrimmed(g, index)) {
    if (kind != MeshKind::single)
      reject("alternating and equilateral are for patches that are not trimmed; allowed here: single");
    const TrimMesh cut = trimMesh(patch, g.trims[static_cast<std::size_t>(index)], us, vs, joinedSides(g, index));
    m.uv = cut.uv;
    m.triangles = cut.triangles;
  } else if (kind != MeshKind::equilateral) {
    m = gridMesh(us, vs, kind == MeshKind::alternating);
  } else {
    const double cells = static_cast<double>(vs.size() - 1);
    m = rowsMesh(us, vs, std::max(2, 2 * static_cast<int>(std::lround(0.5 * cells * rows_per_cell))));
  }
  if (kind != MeshKind::equilateral) m.lines = {us, vs};
  findSides(patch, m);
  return m;
}

PatchMesh panelMesh(const Garment& g, int index, const SewnMesh::Patch& mesh) {
  PatchMesh m{mesh.uv, mesh.triangles, {}, {}};
  if (!isTrimmed(g, index)) findSides(g.patches[static_cast<std::size_t>(index)], m);
  return m;
}

/// Points of all patches one after the other, those that seams join as one: parent of each.
class Welding {
 public:
  explicit Welding(std::size_t points) : parent_(points) { std::iota(parent_.begin(), parent_.end(), 0); }
  int find(int i) {
    while (parent_[static_cast<std::size_t>(i)] != i) i = parent_[static_cast<std::size_t>(i)];
    return i;
  }
  void join(int a, int b) {
    a = find(a), b = find(b);
    if (a != b) parent_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  }

 private:
  std::vector<int> parent_;
};

/// Each vertex of the side `a` of a seam is one with the vertex of `b` at its place; both ways unless a is a part of b.
void joinSides(const std::vector<int>& a, const std::vector<int>& b, const std::vector<Vec3>& X,
               const std::string& name, bool part, Welding& welding) {
  double length = 0;
  for (std::size_t k = 1; k < a.size(); ++k)
    length += norm(X[static_cast<std::size_t>(a[k])] - X[static_cast<std::size_t>(a[k - 1])]);
  const double near = 1e-3 * length / std::max<double>(1, static_cast<double>(a.size() - 1));
  if (!part && a.size() != b.size())
    reject(name + " joins edges of " + std::to_string(a.size()) + " and " + std::to_string(b.size()) + " vertices");
  for (int i : a) {
    const auto at = std::min_element(b.begin(), b.end(), [&](int p, int q) {
      const Vec3& x = X[static_cast<std::size_t>(i)];
      return norm2(X[static_cast<std::size_t>(p)] - x) < norm2(X[static_cast<std::size_t>(q)] - x);
    });
    if (at == b.end() || !(norm(X[static_cast<std::size_t>(*at)] - X[static_cast<std::size_t>(i)]) < near))
      reject(name + " joins edges whose vertices do not meet in this mesh");
    welding.join(i, *at);
  }
}

}  // namespace

MeshDraft meshDraft(const Garment& g, MeshKind kind) {
  if (!g.weak_seams.empty())
    reject("triangles need seams whose edges have equal cells; weak seams go with NURBS cloth");
  std::optional<SewnMesh> sewn;
  if (!g.sewn_seams.empty()) {
    if (kind != MeshKind::single)
      reject("alternating and equilateral are for drafts without sewn seams; allowed here: single");
    sewn = sewnMesh(g);
  }
  validateFields(g);
  MeshDraft out;
  ClothMesh& mesh = out.mesh;
  const double rows_per_cell = kind == MeshKind::equilateral ? rowsPerCell(g) : 1;
  std::vector<PatchMesh> patches;
  std::vector<int> first{0};
  std::vector<Vec3> X;
  for (int p = 0; p < static_cast<int>(g.patches.size()); ++p) {
    patches.push_back(sewn ? panelMesh(g, p, sewn->patches[static_cast<std::size_t>(p)])
                           : meshOf(g, p, kind, rows_per_cell));
    for (const Vec2& uv : patches.back().uv)
      X.push_back(surfaceDerivatives(g.patches[static_cast<std::size_t>(p)], uv.x, uv.y)[0]);
    first.push_back(static_cast<int>(X.size()));
  }
  const auto side = [&](const PatchEdge& e) {
    std::vector<int> points = patches[static_cast<std::size_t>(e.patch)].sides[static_cast<std::size_t>(e.side)];
    for (int& k : points) k += first[static_cast<std::size_t>(e.patch)];
    if (e.reversed) std::reverse(points.begin(), points.end());
    return points;
  };
  Welding welding(X.size());
  for (std::size_t k = 0; k < g.seams.size(); ++k)
    joinSides(side(g.seams[k].a), side(g.seams[k].b), X, "seam " + std::to_string(k), g.seams[k].onPart(), welding);
  const auto pointOf = [&](const MeshVertex& v) { return first[static_cast<std::size_t>(v.patch)] + v.vertex; };
  if (sewn)
    for (const auto& [a, b] : sewn->cuts) welding.join(pointOf(a), pointOf(b));

  std::vector<int> vertex(X.size(), -1);
  const std::vector<int> offsets = controlOffsets(g);
  out.of_control.column_count = offsets.back();
  for (int p = 0; p < static_cast<int>(patches.size()); ++p) {
    const auto patch = static_cast<std::size_t>(p);
    for (std::size_t k = 0; k < patches[patch].uv.size(); ++k) {
      const int i = first[patch] + static_cast<int>(k), root = welding.find(i);
      if (root != i) continue;
      vertex[static_cast<std::size_t>(i)] = static_cast<int>(mesh.vertices.size());
      mesh.vertices.push_back(X[static_cast<std::size_t>(i)]);
      const SurfaceBasis basis = surfaceBasis(g.patches[patch], patches[patch].uv[k].x, patches[patch].uv[k].y);
      for (std::size_t c = 0; c < basis.columns.size(); ++c)
        out.of_control.add(offsets[patch] + basis.columns[c], basis.values[0][c]);
      out.of_control.endRow();
    }
  }
  const auto vertexOf = [&](int i) { return vertex[static_cast<std::size_t>(welding.find(i))]; };

  for (int p = 0; p < static_cast<int>(patches.size()); ++p) {
    const auto patch = static_cast<std::size_t>(p);
    mesh.patch_names.push_back(g.patch_names.empty() ? "patch_" + std::to_string(p) : g.patch_names[patch]);
    const KnotVector &u = g.patches[patch].u, &v = g.patches[patch].v;
    out.range.push_back({Vec2{u.front(), v.front()}, Vec2{u.back(), v.back()}});
    out.lines.push_back(patches[patch].lines);
    const bool varies = fabricVaries(g, p);
    for (const auto& t : patches[patch].triangles) {
      std::array<Vec3, 3> x;
      std::array<Vec2, 3> at;
      std::array<int, 3> corner{};
      for (std::size_t k = 0; k < 3; ++k) {
        corner[k] = vertexOf(first[patch] + t[k]);
        x[k] = mesh.vertices[static_cast<std::size_t>(corner[k])];
        at[k] = patches[patch].uv[static_cast<std::size_t>(t[k])];
      }
      mesh.triangles.push_back(corner);
      mesh.patch.push_back(p);
      out.draft.push_back(at);
      const Vec2 middle{(at[0].x + at[1].x + at[2].x) / 3, (at[0].y + at[1].y + at[2].y) / 3};
      const Vec3 n = normalized(cross(x[1] - x[0], x[2] - x[0]));
      Vec3 weft = rotationAbout(n, fibreAngleAt(g, p, middle)) * g.weft[patch];
      weft = weft - dot(weft, n) * n;
      if (!(norm(weft) > 1e-6 * norm(g.weft[patch])))
        reject("the weft is normal to a triangle of patch " + std::to_string(p));
      weft = normalized(weft);
      const Vec3 warp = cross(n, weft);
      mesh.uv.push_back({Vec2{}, Vec2{dot(x[1] - x[0], weft), dot(x[1] - x[0], warp)},
                         Vec2{dot(x[2] - x[0], weft), dot(x[2] - x[0], warp)}});
      const Fabric fabric = varies ? fabricAt(g, p, middle) : g.fabric;
      auto known = std::find(out.fabrics.begin(), out.fabrics.end(), fabric);
      if (known == out.fabrics.end()) known = out.fabrics.insert(out.fabrics.end(), fabric);
      out.fabric.push_back(static_cast<int>(known - out.fabrics.begin()));
    }
    constexpr const char* names[] = {"u0", "u1", "v0", "v1"};
    for (int s = 0; s < 4; ++s) {
      MeshLine line{names[s], p, side({p, static_cast<Side>(s), false})};
      for (int& i : line.vertices) i = vertexOf(i);
      if (line.vertices.size() > 1) mesh.lines.push_back(std::move(line));
    }
  }
  for (const NamedEdge& edge : g.edges)
    for (const PatchEdge& e : edge.edges) {
      MeshLine line{edge.name, e.patch, side(e)};
      for (int& i : line.vertices) i = vertexOf(i);
      mesh.lines.push_back(std::move(line));
    }
  out.sewn_seams = static_cast<int>(g.sewn_seams.size());
  if (!sewn) return out;
  for (const SewnEdgePair& pair : sewn->edges) {
    const SewnSeam& seam = g.sewn_seams[static_cast<std::size_t>(pair.seam)];
    if (seam.stiffness_N == 0) continue;
    MeshSpring spring{{}, {pair.a[0].patch, pair.b[0].patch}, seam.stiffness_N, seam.rest_angle_rad};
    for (std::size_t end = 0; end < 2; ++end) {
      spring.edge[0][end] = vertexOf(pointOf(pair.a[end]));
      spring.edge[1][end] = vertexOf(pointOf(pair.b[end]));
    }
    out.springs.push_back(spring);
  }
  for (const SewnPair& pair : sewn->pairs) {
    const std::array<int, 2> ends{vertexOf(pointOf(pair.a)), vertexOf(pointOf(pair.b))};
    if (ends[0] == ends[1]) continue;  // at the tip of a dart that is cut on
    const double cell = std::min(sewn->patches[static_cast<std::size_t>(pair.a.patch)].cell_m,
                                 sewn->patches[static_cast<std::size_t>(pair.b.patch)].cell_m);
    out.ties.push_back({ends, {pair.a.patch, pair.b.patch}, pair.seam, pair.length_m, pair.spacing_m, cell});
  }
  return out;
}

}  // namespace gambeson
