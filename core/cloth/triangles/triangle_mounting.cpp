#include "core/cloth/triangles/triangle_mounting.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/cloth/triangles/triangle_cloth.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

[[noreturn]] void reject(const std::string& key, const std::string& reason) { throw InputError({"", 0, key}, reason); }

/// A piece of an edge with the triangle that it bounds: a and b along the edge, c the third corner, whose foot on the
/// edge is a + foot (b - a).
struct Piece {
  int a = 0, b = 0, c = 0;
  double foot = 0, length_m = 0, height_m = 0;
  Vec3 normal;               ///< of the triangle at rest
  int turn = -1;             ///< inner unknown of the edge; -1: none
  bool along_border = true;  ///< a to b as the triangle's border runs
};

class TriangleMounting : public Mounting {
 public:
  explicit TriangleMounting(const TriangleCloth& cloth) : c_(cloth) {}

  PlaceRow place(int patch, Vec2 uv) const override {
    checkPatch(patch, "patch");
    const auto [triangle, weight] = c_.locate(patch, uv);
    const MembraneTriangle& t = c_.elements().triangles()[static_cast<std::size_t>(triangle)];
    PlaceRow row;
    row.columns.assign(t.corner.begin(), t.corner.end());
    row.value.assign(weight.begin(), weight.end());
    row.d1 = {-t.g[0].x - t.g[1].x, t.g[0].x, t.g[1].x};
    row.d2 = {-t.g[0].y - t.g[1].y, t.g[0].y, t.g[1].y};
    return row;
  }

  PlaceRow weft(int patch, Vec2 uv) const override {
    PlaceRow row = place(patch, uv);
    return {std::move(row.columns), std::move(row.d1), {}, {}};
  }

  std::vector<int> edgePoints(const PatchEdge& edge, int rows) const override {
    std::vector<int> points = c_.sidePoints(edge);
    std::set<int> seen(points.begin(), points.end());
    for (std::size_t first = 0; rows > 1; --rows) {
      // The next row: all that share a triangle with the last.
      const std::size_t end = points.size();
      const std::set<int> last(points.begin() + static_cast<long>(first), points.end());
      for (int t = c_.firstTriangle(edge.patch); t < c_.firstTriangle(edge.patch + 1); ++t) {
        const auto& corner = c_.triangles()[static_cast<std::size_t>(t)];
        if (std::none_of(corner.begin(), corner.end(), [&](int p) { return last.contains(p); })) continue;
        for (int p : corner)
          if (seen.insert(p).second) points.push_back(p);
      }
      first = end;
    }
    return points;
  }

  double edgeLength(const PatchEdge& edge) const override {
    double length = 0;
    for (const Piece& piece : pieces(edge)) length += piece.length_m;
    return length;
  }

  std::vector<LinearConstraint> holdEdge(const PatchEdge& edge, std::span<const Vec3> directions,
                                         const Prescribed& motion) const override {
    const std::string name = "support of " + edgeName(edge);
    checkSupport(name, directions, motion);
    std::vector<LinearConstraint> out;
    for (const Vec3& d : directions)
      for (int point : c_.sidePoints(edge)) {
        out.push_back(supportEquation(name, d, motion));
        out.back().terms = {{point, d}};
      }
    return out;
  }

  std::vector<LinearConstraint> holdPlace(int patch, Vec2 uv, std::span<const Vec3> directions,
                                          const Prescribed& motion) const override {
    const std::string name = "support of a point of patch " + std::to_string(patch);
    const PlaceRow row = place(patch, uv);
    checkSupport(name, directions, motion);
    std::vector<LinearConstraint> out;
    for (const Vec3& d : directions) {
      out.push_back(supportEquation(name, d, motion));
      for (std::size_t k = 0; k < 3; ++k)
        if (std::abs(row.value[k]) > 1e-14) out.back().terms.emplace_back(row.columns[k], row.value[k] * d);
    }
    return out;
  }

  std::vector<LinearConstraint> clampEdge(const PatchEdge& edge) const override {
    std::vector<LinearConstraint> out;
    const std::string name = "clamp of " + edgeName(edge);
    for (const Piece& piece : pieces(edge))
      if (piece.turn < 0)
        keepAcross(name, piece, piece.normal, out);
      else
        keepNormal(name, piece, out);
    return out;
  }

  std::vector<LinearConstraint> mirrorEdge(const PatchEdge& edge, const Vec3& normal) const override {
    const std::string name = "symmetry of " + edgeName(edge);
    checkSupport(name, std::span(&normal, 1), {});
    const std::vector<Piece> all = pieces(edge);
    const double length = edgeLength(edge);
    const Vec3 first = c_.rest()[static_cast<std::size_t>(all.front().a)];
    for (const Piece& piece : all) {
      for (int p : {piece.a, piece.b})
        if (!(std::abs(dot(normal, c_.rest()[static_cast<std::size_t>(p)] - first)) <= 1e-6 * length))
          reject(name, "the edge does not lie in a plane with this normal");
      if (std::abs(dot(normal, piece.normal)) > 1e-4)
        reject(name, "the rest surface does not meet the plane at right angles");
    }
    std::vector<LinearConstraint> out = holdEdge(edge, std::span(&normal, 1), {});
    for (LinearConstraint& c : out) c.name = name;
    const Vec3 e = std::abs(normal.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 one = normalized(e - dot(e, normal) * normal), two = cross(normal, one);
    for (const Vec3& d : {one, two})
      for (const Piece& piece : all)
        if (piece.turn < 0) keepAcross(name, piece, d, out);
    for (const Piece& piece : all)
      if (piece.turn >= 0) keepNormal(name, piece, out);
    return out;
  }

  std::vector<LinearConstraint> tieEdge(const PatchEdge& edge, const Vec3& direction) const override {
    const std::string name = "tie of " + edgeName(edge);
    checkSupport(name, std::span(&direction, 1), {});
    const std::vector<int>& points = c_.sidePoints(edge);
    std::vector<LinearConstraint> out;
    for (std::size_t i = 1; i < points.size(); ++i) {
      out.push_back(supportEquation(name, direction, {}));
      out.back().terms = {{points[i], direction}, {points[0], -direction}};
    }
    return out;
  }

  std::vector<Vec3> edgeForce(const PatchEdge& edge, const Vec3& force_N_per_m) const override {
    checkFiniteLoad(force_N_per_m, "edge load");
    std::vector<Vec3> force(static_cast<std::size_t>(c_.points()));
    for (const Piece& piece : pieces(edge))
      for (int p : {piece.a, piece.b}) force[static_cast<std::size_t>(p)] += 0.5 * piece.length_m * force_N_per_m;
    return force;
  }

  std::vector<Vec3> surfaceForce(int patch, const Vec3& force_N_per_m2) const override {
    checkPatch(patch, "surface load");
    checkFiniteLoad(force_N_per_m2, "surface load");
    std::vector<Vec3> force(static_cast<std::size_t>(c_.points()));
    for (int t = c_.firstTriangle(patch); t < c_.firstTriangle(patch + 1); ++t) {
      const MembraneTriangle& m = c_.elements().triangles()[static_cast<std::size_t>(t)];
      for (int p : m.corner) force[static_cast<std::size_t>(p)] += m.area_m2 / 3 * force_N_per_m2;
    }
    return force;
  }

  std::vector<Vec3> placeForce(int patch, Vec2 uv, const Vec3& force_N) const override {
    checkFiniteLoad(force_N, "point load");
    const PlaceRow row = place(patch, uv);
    std::vector<Vec3> force(static_cast<std::size_t>(c_.points()));
    for (std::size_t k = 0; k < 3; ++k) force[static_cast<std::size_t>(row.columns[k])] += row.value[k] * force_N;
    return force;
  }

  std::vector<Vec3> weightForce(const Vec3& gravity_m_per_s2) const override {
    checkFiniteLoad(gravity_m_per_s2, "gravity");
    std::vector<Vec3> force;
    for (double m : c_.masses()) force.push_back(m * gravity_m_per_s2);
    return force;
  }

  /// p A n/3 at each corner, n A = (x1 - x0) x (x2 - x0)/2: the gradient of the enclosed volume.
  std::vector<FollowingLoad> pressure(int patch, double pressure_Pa) const override {
    checkPatch(patch, "pressure");
    std::vector<FollowingLoad> loads;
    for (int t = c_.firstTriangle(patch); t < c_.firstTriangle(patch + 1); ++t) {
      const auto& corner = c_.triangles()[static_cast<std::size_t>(t)];
      loads.push_back({0,
                       true,
                       {corner.begin(), corner.end()},
                       {{{1.0 / 3, 1.0 / 3, 1.0 / 3}, {-1, 1, 0}, {-1, 0, 1}, 0.5 * pressure_Pa}}});
    }
    return loads;
  }

  std::vector<FollowingLoad> edgeMoment(const PatchEdge& edge, double moment_N) const override {
    std::vector<FollowingLoad> loads;
    for (const Piece& p : pieces(edge)) {
      FollowingLoad load{0,
                         false,
                         {p.a, p.b, p.c},
                         {{{},
                           {-1 / p.length_m, 1 / p.length_m, 0},
                           {-(1 - p.foot) / p.height_m, -p.foot / p.height_m, 1 / p.height_m},
                           moment_N * p.length_m}}};
      // It turns the edge's normal: the triangle's less what the unknown takes from it.
      if (p.turn >= 0) load.inner = {{p.turn, (p.along_border ? -1 : 1) * moment_N * p.length_m}};
      loads.push_back(std::move(load));
    }
    return loads;
  }

 private:
  void checkPatch(int patch, const char* key) const {
    if (patch < 0 || patch >= static_cast<int>(c_.patches().size()))
      reject(key, "patch " + std::to_string(patch) + " does not exist");
  }

  /// d . (u_c - u of its foot) = 0.
  static void keepAcross(const std::string& name, const Piece& p, const Vec3& d, std::vector<LinearConstraint>& out) {
    LinearConstraint c = supportEquation(name, d, {});
    c.terms = {{p.c, d}, {p.a, -(1 - p.foot) * d}, {p.b, -p.foot * d}};
    out.push_back(std::move(c));
  }

  /// phi = n . (u_c - u of its foot)/h: what the triangle turns about the edge, the edge's normal turns back.
  static void keepNormal(const std::string& name, const Piece& p, std::vector<LinearConstraint>& out) {
    const Vec3 d = -1 / p.height_m * p.normal;
    keepAcross(name, p, d, out);
    out.back().inner = {{p.turn, 1}};
  }

  std::vector<Piece> pieces(const PatchEdge& edge) const {
    std::vector<int> points = c_.sidePoints(edge);
    if (edge.reversed) std::reverse(points.begin(), points.end());
    std::vector<Piece> out;
    for (std::size_t i = 1; i < points.size(); ++i) {
      Piece p{points[i - 1], points[i], -1, 0, 0, 0, {}, -1, true};
      for (int t = c_.firstTriangle(edge.patch); t < c_.firstTriangle(edge.patch + 1) && p.c < 0; ++t) {
        const auto& corner = c_.triangles()[static_cast<std::size_t>(t)];
        const auto has = [&](int point) { return std::find(corner.begin(), corner.end(), point) != corner.end(); };
        if (!has(p.a) || !has(p.b)) continue;
        for (int point : corner)
          if (point != p.a && point != p.b) p.c = point;
        const auto at = [&](int point) { return c_.rest()[static_cast<std::size_t>(point)]; };
        const Vec3 along = at(p.b) - at(p.a), up = at(p.c) - at(p.a);
        p.length_m = norm(along);
        p.foot = dot(up, along) / norm2(along);
        p.height_m = norm(up - p.foot * along);
        p.normal = normalized(cross(at(corner[1]) - at(corner[0]), at(corner[2]) - at(corner[0])));
        p.turn = turnOf(t, p.c);
        p.along_border = dot(cross(along, up), p.normal) > 0;
      }
      out.push_back(p);
    }
    return out;
  }

  /// The inner unknown of the border edge that faces a point of a triangle; -1: none.
  int turnOf(int triangle, int point) const {
    const BendingTriangles& bending = c_.elements().bending();
    const int bent = bending.bentOf(triangle);
    if (bent < 0) return -1;
    const BentTriangle& t = bending.triangles()[static_cast<std::size_t>(bent)];
    const auto edge = static_cast<std::size_t>(std::find(t.corner.begin(), t.corner.end(), point) - t.corner.begin());
    return t.hinge[edge] < 0 ? t.turn[edge] : -1;
  }

  const TriangleCloth& c_;
};

}  // namespace

std::unique_ptr<const Mounting> triangleMounting(const TriangleCloth& cloth) {
  return std::make_unique<TriangleMounting>(cloth);
}

}  // namespace gambeson
