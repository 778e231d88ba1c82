#include "core/cloth/triangles/triangle_cloth.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "core/cloth/draft/grid_lines.hpp"
#include "core/cloth/free_blocks.hpp"
#include "core/cloth/triangles/triangle_mounting.hpp"
#include "core/cloth/triangles/triangle_stress.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

class TriangleTangent : public ClothTangent {
 public:
  explicit TriangleTangent(const TriangleCloth& cloth) : cloth_(cloth) {
    std::vector<std::vector<int>> rows;
    const TriangleElements& e = cloth.elements();
    for (const MembraneTriangle& t : e.triangles()) rows.push_back(freePointsOf(cloth.map(), t.corner));
    for (const FoldHinge& h : e.hinges()) rows.push_back(freePointsOf(cloth.map(), h.corner));
    for (const SeamHinge& h : e.seamSprings().hinges()) rows.push_back(e.seamSprings().blocksOf(h, cloth.map()));
    for (const BentTriangle& t : e.bending().triangles())
      rows.push_back(e.bending().blocksOf(t, e.hinges(), cloth.map()));
    sparsity_ = blockSparsity(cloth.map().T.column_count + cloth.innerBlocks(), rows);
  }
  const BlockMatrix& sparsity() const override { return sparsity_; }
  void assemble(const ClothState& state, ClothWork&, BlockMatrix& K, const ForceTerms& terms) const override {
    if (K.columns.size() != sparsity_.columns.size() || K.offsets != sparsity_.offsets) K = sparsity_;
    std::fill(K.values.begin(), K.values.end(), 0.0);
    std::vector<std::array<double, 9>> blocks;
    const TriangleElements& e = cloth_.elements();
    for (std::size_t k = 0; k < e.triangles().size(); ++k) {
      e.membraneStiffness(static_cast<int>(k), state, terms, blocks);
      addSymmetrised(cloth_.map(), e.triangles()[k].corner, blocks, K);
    }
    e.bending().addStiffness(e.hinges(), cloth_.map(), state, terms, K);
    e.quadratic().addStiffness(cloth_.map(), terms, K);
    e.seamSprings().addStiffness(cloth_.map(), state, terms, K);
    if (terms.bending) e.springs().addStiffness(cloth_.map(), state.q, terms.definite, K);
    for (std::size_t k = 0; k < e.hinges().size(); ++k) {
      if (!e.isHinge(k)) continue;
      e.hingeStiffness(static_cast<int>(k), state, terms, blocks);
      addSymmetrised(cloth_.map(), e.hinges()[k].corner, blocks, K);
    }
  }
  void assembleDamping(const ClothState& state, ClothWork&, BlockMatrix& D) const override {
    if (D.columns.size() != sparsity_.columns.size() || D.offsets != sparsity_.offsets) D = sparsity_;
    D.values.assign(9 * D.columns.size(), 0.0);
    const TriangleElements& e = cloth_.elements();
    if (!e.damps()) return;
    std::vector<std::array<double, 9>> blocks;
    for (std::size_t k = 0; k < e.triangles().size(); ++k) {
      e.membraneDamping(static_cast<int>(k), state.q, blocks);
      addSymmetrised(cloth_.map(), e.triangles()[k].corner, blocks, D);
    }
  }

 private:
  const TriangleCloth& cloth_;
  BlockMatrix sparsity_;
};

}  // namespace

TriangleCloth::TriangleCloth(std::vector<MeshDraft> garments)
    : garments_(std::move(garments)), parts_(buildTriangles(garments_)) {
  map_.T = parts_.T;
  map_.Tt = transpose(map_.T);
  map_.home.assign(static_cast<std::size_t>(map_.T.column_count), -1);
  for (int i = 0; i < map_.T.rows(); ++i) {
    int& home = map_.home[static_cast<std::size_t>(freePoint(i))];
    if (home < 0) home = i;
  }
  elements_ = TriangleElements(points(), std::move(parts_.membranes), std::move(parts_.hinges), parts_.fabrics,
                               *triangleKernels().front(), parts_.membrane_models, parts_.seam_springs);
  mounting_ = triangleMounting(*this);
}

TriangleCloth::~TriangleCloth() = default;

std::string TriangleCloth::kernels() const { return elements_.kernels(); }

std::string TriangleCloth::describePoint(int point) const {
  int patch = 0;
  while (parts_.patches[static_cast<std::size_t>(patch)].end_point <= point) ++patch;
  return "vertex " + std::to_string(point - parts_.patches[static_cast<std::size_t>(patch)].first_point) +
         " of patch " + std::to_string(patch);
}

namespace {

Vec2 minus(const Vec2& a, const Vec2& b) { return {a.x - b.x, a.y - b.y}; }

/// The barycentric coordinates of a point among three.
std::array<double, 3> barycentric(const std::array<Vec2, 3>& at, const Vec2& p) {
  const Vec2 a = minus(at[1], at[0]), b = minus(at[2], at[0]), d = minus(p, at[0]);
  const double det = a.x * b.y - a.y * b.x, s = (d.x * b.y - d.y * b.x) / det, t = (a.x * d.y - a.y * d.x) / det;
  return {1 - s - t, s, t};
}

}  // namespace

Vec2 TriangleCloth::placeOfDraft(int patch, Vec2 uv) const {
  if (!parts_.drafted[static_cast<std::size_t>(patch)])
    throw InputError({"", 0, "patch"}, "a patch of a mesh file has no parameters; name an edge in their place");
  // The triangle that it lies in, or else in least far outside of.
  double best = -std::numeric_limits<double>::infinity();
  Vec2 place;
  const int first = firstTriangle(patch);
  for (int t = first; t < firstTriangle(patch + 1); ++t) {
    const auto w = barycentric(parts_.draft[static_cast<std::size_t>(t)], uv);
    const double least = std::min({w[0], w[1], w[2]});
    if (least > best + 1e-12) best = least, place = {2.0 * (t - first) + w[1], w[2]};
  }
  return place;
}

int TriangleCloth::draftPoints() const {
  int sum = 0;
  for (const MeshDraft& g : garments_) sum += g.of_control.column_count;
  return sum;
}

std::vector<Vec3> TriangleCloth::fromDraft(std::span<const Vec3> control) const {
  std::vector<Vec3> of_vertex, out;
  std::size_t first = 0;
  for (const MeshDraft& g : garments_) {
    const auto columns = static_cast<std::size_t>(g.of_control.column_count);
    std::vector<Vec3> own(g.mesh.vertices.size());
    if (columns > 0) g.of_control.multiply<Vec3>(control.subspan(first, columns), own);
    first += columns;
    of_vertex.insert(of_vertex.end(), own.begin(), own.end());
  }
  for (const int v : parts_.vertex) out.push_back(of_vertex[static_cast<std::size_t>(v)]);
  return out;
}

TriangleCloth::Located TriangleCloth::locate(int patch, Vec2 place) const {
  const int first = firstTriangle(patch), count = firstTriangle(patch + 1) - first;
  const int t = std::clamp(static_cast<int>(std::floor((place.x + 0.25) / 2)), 0, count - 1);
  const double b = place.x - 2.0 * t, c = place.y;
  return {first + t, {1 - b - c, b, c}};
}

const std::vector<int>& TriangleCloth::sidePoints(const PatchEdge& edge) const {
  const auto side = static_cast<std::size_t>(edge.side);
  if (edge.patch < 0 || edge.patch >= static_cast<int>(parts_.patches.size()) ||
      side >= parts_.sides[static_cast<std::size_t>(edge.patch)].size() ||
      parts_.sides[static_cast<std::size_t>(edge.patch)][side].empty())
    throw InputError({"", 0, edgeName(edge)}, "the mesh has no such edge");
  return parts_.sides[static_cast<std::size_t>(edge.patch)][side];
}

Surface TriangleCloth::surface(std::span<const int>) const {
  Surface s;
  const int n = map_.T.column_count;
  s.W.column_count = points();
  for (int i = 0; i < n; ++i) {
    s.W.add(map_.home[static_cast<std::size_t>(i)], 1);
    s.W.endRow();
  }
  s.WT = identityRows(n);
  s.WTt = identityRows(n);
  s.area_m2.resize(static_cast<std::size_t>(n));
  map_.Tt.multiply<double>(areas(), s.area_m2);
  s.patch.assign(static_cast<std::size_t>(n), -1);
  s.parameters.resize(static_cast<std::size_t>(n));
  for (int p = 0; p < static_cast<int>(parts_.patches.size()); ++p) {
    const int first = firstTriangle(p);
    const auto& [us, vs] = parts_.lines[static_cast<std::size_t>(p)];
    const int nu = static_cast<int>(us.size());
    std::vector<int> grid(us.size() * vs.size(), -1);
    for (int t = first; t < firstTriangle(p + 1); ++t) {
      std::array<int, 3> corner{};
      Vec2 middle{};
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec2& at = parts_.draft[static_cast<std::size_t>(t)][k];
        const int point = parts_.triangles[static_cast<std::size_t>(t)][k];
        corner[k] = map_.T.columns[static_cast<std::size_t>(point)];
        const auto sample = static_cast<std::size_t>(corner[k]);
        if (const int i = lineAt(us, at.x), j = lineAt(vs, at.y); i >= 0 && j >= 0)
          grid[static_cast<std::size_t>(i + nu * j)] = corner[k];
        middle = {middle.x + at.x / 3, middle.y + at.y / 3};
        // A sample belongs to the patch of its first point.
        if (s.patch[sample] >= 0 || map_.home[sample] != point) continue;
        s.patch[sample] = p;
        s.parameters[sample] = {2.0 * (t - first) + (k == 1), k == 2 ? 1.0 : 0.0};
      }
      s.triangles.push_back(corner);
      s.triangle_patch.push_back(p);
      s.triangle_cell.push_back(grid.empty() ? t - first
                                             : cellBetween(us, middle.x) + (nu - 1) * cellBetween(vs, middle.y));
    }
    s.patch_grid_size.push_back(grid.empty() ? std::array<int, 2>{firstTriangle(p + 1) - first + 1, 2}
                                             : std::array<int, 2>{nu, static_cast<int>(vs.size())});
    s.patch_grid.push_back(std::move(grid));
    s.edge_samples.emplace_back();
    for (const std::vector<int>& side : parts_.sides[static_cast<std::size_t>(p)]) {
      s.edge_samples.back().emplace_back();
      for (int point : side) s.edge_samples.back().back().push_back(map_.T.columns[static_cast<std::size_t>(point)]);
    }
  }
  s.twins = twins();
  return s;
}

SewnRows TriangleCloth::sewnRows() const {
  SewnRows rows;
  rows.C.column_count = points();
  for (const MeshTie& tie : parts_.ties) {
    const auto [a, b] = tie.vertex;
    rows.C.add(std::min(a, b), a < b ? 1 : -1);
    rows.C.add(std::max(a, b), a < b ? -1 : 1);
    rows.C.endRow();
    rows.length_m.push_back(tie.length_m);
    rows.hat_m.push_back(tie.spacing_m);
    rows.seam.push_back(tie.seam);
    rows.cell_m.push_back(tie.cell_m);
  }
  rows.pairs = rows.C;
  return rows;
}

std::vector<std::array<int, 2>> TriangleCloth::twins() const {
  std::map<int, std::set<int>> group;  // by the first found of each
  std::map<int, int> group_of;
  for (const MeshTie& tie : parts_.ties) {
    const int a = freePoint(tie.vertex[0]), b = freePoint(tie.vertex[1]);
    const int to = group_of.try_emplace(a, a).first->second, from = group_of.try_emplace(b, b).first->second;
    group[to].insert(a), group[from].insert(b);
    if (to == from) continue;
    for (const int i : group[from]) group[to].insert(i), group_of[i] = to;
    group.erase(from);
  }
  std::vector<std::array<int, 2>> out;
  for (const auto& [first, members] : group)
    for (auto i = members.begin(); i != members.end(); ++i)
      for (auto k = std::next(i); k != members.end(); ++k) out.push_back({*i, *k});
  std::sort(out.begin(), out.end());
  return out;
}

Bulges TriangleCloth::bulges(const Surface& surface, std::span<const int>) const {
  Bulges flat;
  flat.middle.column_count = surface.size();
  flat.of_sample.offsets.assign(static_cast<std::size_t>(surface.size()) + 1, 0);
  return flat;
}

SparseRows TriangleCloth::finer(int fineness, std::span<const int>) const {
  SparseRows rows;
  rows.column_count = points();
  for (const auto& t : parts_.triangles)
    for (int j = 0; j <= fineness; ++j)
      for (int i = 0; i + j <= fineness; ++i) {
        const double b = static_cast<double>(i) / fineness, c = static_cast<double>(j) / fineness;
        rows.add(t[0], 1 - b - c);
        rows.add(t[1], b);
        rows.add(t[2], c);
        rows.endRow();
      }
  return rows;
}

PlaceMesh TriangleCloth::placeMesh(int) const {
  PlaceMesh mesh;
  for (int p = 0; p < static_cast<int>(parts_.patches.size()); ++p) {
    const ClothPatch& patch = parts_.patches[static_cast<std::size_t>(p)];
    const int first = firstTriangle(p), first_place = static_cast<int>(mesh.uv.size());
    const auto count = static_cast<std::size_t>(patch.end_point - patch.first_point);
    mesh.patch.insert(mesh.patch.end(), count, p);
    mesh.uv.resize(mesh.uv.size() + count);
    mesh.fraction.resize(mesh.uv.size());
    std::vector<char> placed(count, 0);
    for (int t = first; t < firstTriangle(p + 1); ++t) {
      std::array<int, 3> corner{};
      for (std::size_t k = 0; k < 3; ++k) {
        const int local = parts_.triangles[static_cast<std::size_t>(t)][k] - patch.first_point;
        corner[k] = first_place + local;
        if (placed[static_cast<std::size_t>(local)]) continue;
        placed[static_cast<std::size_t>(local)] = 1;
        mesh.uv[static_cast<std::size_t>(corner[k])] = {2.0 * (t - first) + (k == 1), k == 2 ? 1.0 : 0.0};
        if (!parts_.drafted[static_cast<std::size_t>(p)]) continue;
        const Vec2 at = parts_.draft[static_cast<std::size_t>(t)][k];
        mesh.fraction[static_cast<std::size_t>(corner[k])] = {(at.x - patch.low.x) / (patch.high.x - patch.low.x),
                                                              (at.y - patch.low.y) / (patch.high.y - patch.low.y)};
      }
      mesh.triangles.push_back(corner);
    }
  }
  return mesh;
}

Fabric TriangleCloth::fabricAt(int patch, Vec2 uv) const {
  return parts_.fabrics[static_cast<std::size_t>(
      parts_.fabric_of_triangle[static_cast<std::size_t>(locate(patch, uv).triangle)])];
}

double TriangleCloth::cellAt(int patch, Vec2 uv) const {
  const auto& t = parts_.triangles[static_cast<std::size_t>(locate(patch, uv).triangle)];
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k)
    least = std::min(least, norm(parts_.rest[static_cast<std::size_t>(t[(k + 1) % 3])] -
                                 parts_.rest[static_cast<std::size_t>(t[k])]));
  return least;
}

std::vector<NetEdge> TriangleCloth::net() const {
  std::vector<NetEdge> edges;
  std::map<std::pair<int, int>, bool> seen;
  for (const auto& t : parts_.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = std::min(t[k], t[(k + 1) % 3]), b = std::max(t[k], t[(k + 1) % 3]);
      if (!seen.emplace(std::pair(a, b), true).second) continue;
      edges.push_back(
          {a, b, 1 / norm2(parts_.rest[static_cast<std::size_t>(b)] - parts_.rest[static_cast<std::size_t>(a)])});
    }
  return edges;
}

std::vector<double> TriangleCloth::areas() const {
  std::vector<double> area(parts_.rest.size(), 0);
  for (const MembraneTriangle& t : elements_.triangles())
    for (int c : t.corner) area[static_cast<std::size_t>(c)] += t.area_m2 / 3;
  return area;
}

std::vector<double> TriangleCloth::masses() const {
  std::vector<double> mass(parts_.rest.size(), 0);
  for (const MembraneTriangle& t : elements_.triangles())
    for (int c : t.corner)
      mass[static_cast<std::size_t>(c)] +=
          parts_.fabrics[static_cast<std::size_t>(t.law)].surfaceDensity() * t.area_m2 / 3;
  if (!parts_.sewn) return mass;
  // As much as so large a part of what a vertex inside of its patch bears; what that takes comes from all others alike.
  constexpr double share = 0.3;
  std::vector<double> least(mass.size());
  for (std::size_t p = 0; p < parts_.patches.size(); ++p) {
    const auto from = static_cast<std::size_t>(parts_.patches[p].first_point),
               end = static_cast<std::size_t>(parts_.patches[p].end_point);
    const double whole =
        std::accumulate(mass.begin() + static_cast<long>(from), mass.begin() + static_cast<long>(end), 0.0);
    const int triangles = firstTriangle(static_cast<int>(p) + 1) - firstTriangle(static_cast<int>(p));
    for (std::size_t i = from; i < end; ++i) least[i] = share * whole / (0.5 * triangles);
  }
  const double sum = std::accumulate(mass.begin(), mass.end(), 0.0);
  const auto given = [&](double factor) {
    double total = 0;
    for (std::size_t i = 0; i < mass.size(); ++i) total += std::max(factor * mass[i], least[i]);
    return total;
  };
  double low = 0, high = 1;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (given(middle) > sum ? high : low) = middle;
  }
  for (std::size_t i = 0; i < mass.size(); ++i) mass[i] = std::max(low * mass[i], least[i]);
  return mass;
}

SparseRows TriangleCloth::consistentMass() const {
  std::vector<std::map<int, double>> rows(parts_.rest.size());
  for (const MembraneTriangle& t : elements_.triangles()) {
    const double m = parts_.fabrics[static_cast<std::size_t>(t.law)].surfaceDensity() * t.area_m2 / 12;
    for (int a : t.corner)
      for (int b : t.corner) rows[static_cast<std::size_t>(a)][b] += a == b ? 2 * m : m;
  }
  SparseRows out;
  out.column_count = points();
  for (const auto& row : rows) {
    for (const auto& [column, value] : row) out.add(column, value);
    out.endRow();
  }
  return out;
}

void TriangleCloth::force(const ClothState& state, const ClothForce& out, ClothWork& work,
                          const ForceTerms& terms) const {
  elements_.force(state, out, work, terms);
}

void TriangleCloth::dampingForce(const ClothState& state, const ClothForce& out, ClothWork& work) const {
  elements_.dampingForce(state, out, work);
}

std::unique_ptr<ClothTangent> TriangleCloth::tangent() const { return std::make_unique<TriangleTangent>(*this); }

void TriangleCloth::innerMasses(std::span<double> mass) const {
  std::copy(elements_.bending().innerMasses().begin(), elements_.bending().innerMasses().end(), mass.begin());
}

/// Of a hinge the middle of its edge, in its first triangle; of bent triangles and of friction in shear the triangle's.
std::vector<HistoryPlace> TriangleCloth::historyPlaces() const {
  std::vector<HistoryPlace> places;
  for (std::size_t k = 0; k < elements_.hinges().size(); ++k) {
    HistoryPlace own = elements_.historyOf(k);
    if (own.count == 0) continue;
    const FoldHinge& h = elements_.hinges()[k];
    int patch = 0;
    while (firstTriangle(patch + 1) <= h.triangle[0]) ++patch;
    const std::array<int, 3>& corners = elements_.triangles()[static_cast<std::size_t>(h.triangle[0])].corner;
    const auto half = [&](std::size_t c) { return corners[c] == h.corner[0] || corners[c] == h.corner[1] ? 0.5 : 0.0; };
    own.patch = patch;
    own.place = {2.0 * (h.triangle[0] - firstTriangle(patch)) + half(1), half(2)};
    places.push_back(own);
  }
  const BendingTriangles& bending = elements_.bending();
  for (std::size_t k = 0; k < bending.triangles().size(); ++k) {
    HistoryPlace own = bending.historyOf(k);
    if (own.count == 0) continue;
    const int triangle = bending.triangles()[k].triangle;
    while (firstTriangle(own.patch + 1) <= triangle) ++own.patch;
    own.place = {2.0 * (triangle - firstTriangle(own.patch)) + 1.0 / 3, 1.0 / 3};
    places.push_back(own);
  }
  for (int p = 0; p < static_cast<int>(parts_.patches.size()); ++p)
    for (int t = firstTriangle(p); t < firstTriangle(p + 1); ++t) {
      HistoryPlace own = elements_.shearHistoryOf(static_cast<std::size_t>(t));
      if (own.count == 0) continue;
      own.patch = p;
      own.place = {2.0 * (t - firstTriangle(p)) + 1.0 / 3, 1.0 / 3};
      places.push_back(own);
    }
  return places;
}

std::unique_ptr<StressView> TriangleCloth::stress() const { return std::make_unique<TriangleStress>(*this); }

PointState TriangleCloth::stateAt(const ClothState& state, int patch, Vec2 uv) const {
  return elements_.stateOf(locate(patch, uv).triangle, state);
}

double TriangleCloth::bendAt(const ClothState& state, int patch, Vec2 uv) const {
  const Vec3 k = elements_.curvatureOf(locate(patch, uv).triangle, state, true);
  return std::sqrt(k.x * k.x + k.y * k.y + 0.5 * k.z * k.z);
}

std::vector<std::pair<int, Vec2>> TriangleCloth::lawPlaces() const {
  std::vector<std::pair<int, Vec2>> places;
  for (int p = 0; p < static_cast<int>(parts_.patches.size()); ++p)
    for (int t = 0; t < firstTriangle(p + 1) - firstTriangle(p); ++t)
      places.emplace_back(p, Vec2{2.0 * t + 1.0 / 3, 1.0 / 3});
  return places;
}

bool TriangleCloth::springsAtRest(double length_m) const {
  for (std::size_t k = 0; k < elements_.hinges().size(); ++k)
    if (std::abs(elements_.curvature(static_cast<int>(k), parts_.rest)) * length_m > 1e-6) return true;
  return false;
}

StrainRows TriangleCloth::strainRows(Mobility mobility, LimitPoints points) const {
  if (points != LimitPoints::vertices)
    throw InputError({"", 0, "strain_limit.points"}, "are for NURBS patches; triangles are limited each as a whole");
  StrainRows s;
  s.mobility = std::move(mobility);
  s.B.column_count = map_.T.column_count;
  const std::vector<MembraneTriangle>& triangles = elements_.triangles();
  for (SparseRows& field : s.field_of_row) field.column_count = 2 * static_cast<int>(triangles.size());
  for (int p = 0; p < static_cast<int>(parts_.patches.size()); ++p)
    for (int k = firstTriangle(p); k < firstTriangle(p + 1); ++k) {
      const MembraneTriangle& t = triangles[static_cast<std::size_t>(k)];
      s.points.push_back({p, {2.0 * (k - firstTriangle(p)) + 1.0 / 3, 1.0 / 3}, t.area_m2, {2 * k, 2 * k + 1}});
      for (int direction : {0, 1}) {
        const auto part = [&](std::size_t c) { return direction == 0 ? t.g[c].x : t.g[c].y; };
        std::map<int, double> row;
        row[map_.T.columns[static_cast<std::size_t>(t.corner[0])]] -= part(0) + part(1);
        row[map_.T.columns[static_cast<std::size_t>(t.corner[1])]] += part(0);
        row[map_.T.columns[static_cast<std::size_t>(t.corner[2])]] += part(1);
        for (const auto& [column, value] : row) s.B.add(column, value);
        s.B.endRow();
        s.area_m2.push_back(t.area_m2);
        s.field_of_row[static_cast<std::size_t>(direction)].add(2 * k + direction, 1 / t.area_m2);
        s.field_of_row[static_cast<std::size_t>(direction)].endRow();
      }
    }
  completeRows(s);
  return s;
}

Vec2 TriangleCloth::limitStressAt(const StrainRows&, std::span<const Vec2> field, int patch, Vec2 uv) const {
  return field[static_cast<std::size_t>(locate(patch, uv).triangle)];
}

}  // namespace gambeson
