#include "core/contact/untangle.hpp"

#include <cmath>
#include <map>

#include "core/contact/contour_region.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

Vec3 unitNormal(const ContactMesh& mesh, std::span<const Vec3> x, int face) {
  const auto& [a, b, c] = mesh.triangles[face];
  const Vec3 n = cross(x[b] - x[a], x[c] - x[a]);
  const double length = norm(n);
  return length > 0 ? n / length : Vec3{};
}

/// J^T r for a unit vector r, J = dx/dd of a point: a (x) n / (a.n) on an edge (direction a) of surface 0 through
/// a triangle (normal n) of surface 1, which d moves; I - a (x) n / (a.n) on an edge of surface 1. (Eq. 4.1 to 4.3;
/// eq. 4.14 covers the second case only.)
Vec3 transposeTimesMotion(const ContactMesh& mesh, std::span<const Vec3> x, const ContourPoint& p, const Vec3& r) {
  if (p.vertex >= 0) return 0.5 * r;
  const Vec3 a = x[mesh.edges[p.edge][1]] - x[mesh.edges[p.edge][0]], n = unitNormal(mesh, x, p.triangle);
  const double slope = dot(a, n);
  const Vec3 slide = slope != 0 ? (dot(a, r) / slope) * n : Vec3{};
  return p.owner == 0 ? slide : r - slide;
}

double contourLength(const Contour& c) {
  double sum = 0;
  for (std::size_t i = 0; i < c.segments.size(); ++i)
    sum += norm(c.points[c.next(static_cast<int>(i))].x - c.points[i].x);
  return sum;
}

int garmentOf(const ContactMesh& mesh, const Contour& c, int surface, std::span<const int> garment) {
  return garment.empty() ? 0 : garment[mesh.triangles[c.segments[0].face[surface]][0]];
}

/// The wrong part between garments: +1 left of the contour, -1 right, 0 where the order does not tell: within one
/// garment, and on a body, since cloth may lie on a body with either side. The left is in front of the other surface
/// where -m . n_other > 0: on surface 0 where direction * normal < 0, on surface 1 where it is > 0. Where the normals
/// of a garment disagree the longer part of the contour decides.
int wrongByGarment(const ContactMesh& mesh, const Contour& c, int surface, std::span<const int> garment) {
  const int own = garmentOf(mesh, c, surface, garment), other = garmentOf(mesh, c, 1 - surface, garment);
  if (own == other || own < 0) return 0;
  double left_in_front = 0;
  for (std::size_t i = 0; i < c.segments.size(); ++i) {
    const ContourSegment& s = c.segments[i];
    const double length = norm(c.points[c.next(static_cast<int>(i))].x - c.points[i].x);
    left_in_front += length * s.direction * s.normal[surface] * (surface == 0 ? -1 : 1);
  }
  const int left = left_in_front >= 0 ? 1 : -1;
  return own < other ? left : -left;
}

/// A contour from the rim of one surface to the rim of the other ("mixed"). It divides neither, but the order of
/// garments says which side of it is wrong, and where it ends inside one surface the other one ends too.
bool fromRimToOtherRim(const ContactMesh& mesh, const Contour& c) {
  const auto onRim = [&](const ContourPoint& p) { return p.vertex < 0 && mesh.border(p.edge); };
  return !c.cyclic && onRim(c.points.front()) && onRim(c.points.back()) &&
         c.points.front().owner != c.points.back().owner;
}

/// Per vertex, a number of its connected piece.
std::vector<int> connectedPieces(const ContactMesh& mesh) {
  std::vector<int> piece(mesh.vertex_count, -1), queue;
  for (int start = 0; start < mesh.vertex_count; ++start) {
    if (piece[start] >= 0) continue;
    piece[start] = start;
    queue.assign(1, start);
    while (!queue.empty()) {
      const int v = queue.back();
      queue.pop_back();
      for (int e : mesh.vertex_edges[v])
        for (int w : mesh.edges[e])
          if (piece[w] < 0) {
            piece[w] = start;
            queue.push_back(w);
          }
    }
  }
  return piece;
}

/// Contours that bound regions together: closed on the same piece, by the same garment or the same piece of the own
/// garment or of the bodies. A piece that crosses itself has each contour for itself.
class Bounds {
 public:
  /// The contours outlive it.
  Bounds(const ContactMesh& mesh, std::span<const Contour> contours, std::span<const int> garment) {
    if (contours.empty()) return;
    struct Key {
      int own, other, garment, other_garment, contour;
      auto operator<=>(const Key&) const = default;
    };
    const std::vector<int> piece = connectedPieces(mesh);
    std::map<Key, std::vector<ContourPath>> paths_of;
    std::vector<std::array<Key, 2>> keys(contours.size());
    index_.resize(contours.size());
    for (std::size_t k = 0; k < contours.size(); ++k)
      for (int s = 0; s < 2; ++s) {
        const Contour& c = contours[k];
        const auto pieceOf = [&](int side) { return piece[mesh.triangles[c.segments[0].face[side]][0]]; };
        const int own = garmentOf(mesh, c, s, garment), other = garmentOf(mesh, c, 1 - s, garment);
        const bool itself = pieceOf(0) == pieceOf(1);
        const Key key{pieceOf(s), own == other || other < 0 ? pieceOf(1 - s) : -1, own, other,
                      itself ? 2 * static_cast<int>(k) + s : -1};
        auto& paths = paths_of[key];
        keys[k][s] = key;
        index_[k][s].which = static_cast<int>(paths.size());
        paths.push_back({&c, s});
      }
    std::map<Key, int> number;
    for (const auto& [key, paths] : paths_of) {
      number[key] = static_cast<int>(surfaces_.size());
      surfaces_.emplace_back(mesh, paths);
    }
    for (std::size_t k = 0; k < contours.size(); ++k)
      for (int s = 0; s < 2; ++s) index_[k][s].surface = number[keys[k][s]];
  }

  const CutSurface& surface(std::size_t contour, int side) const { return surfaces_[index_[contour][side].surface]; }
  int which(std::size_t contour, int side) const { return index_[contour][side].which; }

  /// Contours share their regions: one flood for all of them.
  void learn(std::size_t contour, int side, const ContourRegion& region) {
    const int surface = index_[contour][side].surface;
    for (const auto& [path, sign] : region.beside)
      known_.try_emplace({surface, path, sign}, Known{region.area_m2, region.vertices});
  }
  bool known(std::size_t contour, int side, int sign, Untangling& u) const {
    const auto it = known_.find({index_[contour][side].surface, which(contour, side), sign});
    if (it == known_.end()) return false;
    u.closed[side] = true;
    u.wrong_sign[side] = sign;
    u.wrong_area_m2[side] = it->second.area_m2;
    u.wrong_vertices[side] = it->second.vertices;
    return true;
  }

 private:
  struct Index {
    int surface = -1, which = -1;
  };
  struct Known {
    double area_m2;
    std::vector<int> vertices;
  };
  std::map<std::array<int, 3>, Known> known_;  ///< by surface, contour and sign
  std::vector<CutSurface> surfaces_;
  std::vector<std::array<Index, 2>> index_;
};

}  // namespace

Vec3 lengthGradient(const ContactMesh& mesh, std::span<const Vec3> x, const Contour& c) {
  Vec3 gradient;
  for (std::size_t i = 0; i < c.segments.size(); ++i) {
    const ContourSegment& s = c.segments[i];
    const Vec3 line = cross(unitNormal(mesh, x, s.face[0]), unitNormal(mesh, x, s.face[1]));
    const double sine = norm(line);
    if (!(sine > 0)) continue;
    const Vec3 r = (s.direction / sine) * line;
    gradient += transposeTimesMotion(mesh, x, c.points[c.next(static_cast<int>(i))], r) -
                transposeTimesMotion(mesh, x, c.points[i], r);
  }
  return gradient;
}

Vec3 areaGradient(const ContactMesh& mesh, std::span<const Vec3> x, const Contour& c, int surface) {
  Vec3 gradient;
  for (std::size_t i = 0; i < c.segments.size(); ++i) {
    const ContourSegment& s = c.segments[i];
    const Vec3 own = unitNormal(mesh, x, s.face[surface]), other = unitNormal(mesh, x, s.face[1 - surface]);
    const double sine = norm(cross(own, other));
    if (!(sine > 0)) continue;
    // On surface 1, m = r x n' has n.m = -direction |n x n'|, and surface 0 moves by -d against it: two signs.
    const double length = norm(c.points[c.next(static_cast<int>(i))].x - c.points[i].x);
    gradient += (s.direction * s.normal[surface] * length / sine) * other;
  }
  return gradient;
}

void checkUntangleLaw(const UntangleLaw& law) {
  if (!(law.speed_mps > 0 && std::isfinite(law.speed_mps)))
    throw InputError({"", 0, "untangle.speed"}, "must be positive and finite");
  if (!(law.g0 > 0 && std::isfinite(law.g0))) throw InputError({"", 0, "untangle.g0"}, "must be positive and finite");
}

std::vector<Untangling> untangleContours(const ContactMesh& mesh, std::span<const Vec3> x,
                                         std::vector<Contour> contours, std::span<const int> garment,
                                         const UntangleLaw& law) {
  checkUntangleLaw(law);
  FloodWork work;
  work.label.resize(mesh.vertex_count);
  std::vector<Untangling> out(contours.size());
  Bounds bounds(mesh, contours, garment);
  for (std::size_t k = 0; k < contours.size(); ++k) {
    Untangling& u = out[k];
    const Contour& c = contours[k];
    u.length_m = contourLength(c);
    for (int s = 0; s < 2; ++s) {
      const int by_garment = wrongByGarment(mesh, c, s, garment);
      if (!c.closed[s]) {
        u.wrong_sign[s] = by_garment != 0 && fromRimToOtherRim(mesh, c) ? by_garment : 0;
        continue;
      }
      if (by_garment != 0 && bounds.known(k, s, by_garment, u)) continue;
      ContourRegion region;
      if (by_garment == 0) region = floodRegion(mesh, x, CutSurface(mesh, std::array{ContourPath{&c, s}}), 0, 0, work);
      if (!region.found) region = floodRegion(mesh, x, bounds.surface(k, s), bounds.which(k, s), by_garment, work);
      u.closed[s] = by_garment != 0 || region.found;
      u.wrong_sign[s] = by_garment != 0 ? by_garment : region.found ? region.sign : 0;
      if (!region.found) continue;
      if (by_garment != 0) bounds.learn(k, s, region);
      u.wrong_area_m2[s] = region.area_m2;
      u.wrong_vertices[s] = std::move(region.vertices);
    }
    if (u.length_m > 0) {
      const Vec3 open = -2 * lengthGradient(mesh, x, c);
      for (int s = 0; s < 2; ++s)
        u.G_side[s] = u.wrong_sign[s] != 0 && law.by == UntangleBy::kArea
                          ? (-u.wrong_sign[s] / u.length_m) * areaGradient(mesh, x, c, s)
                          : open;
      u.G = norm2(u.G_side[0]) > norm2(u.G_side[1]) ? u.G_side[0] : u.G_side[1];
      // Which part of a body has come through is a guess by size, which part of the cloth is inside of it is not.
      if (dot(u.G_side[0], u.G_side[1]) < 0)
        for (int s = 0; s < 2; ++s)
          if (garmentOf(mesh, c, s, garment) >= 0 && garmentOf(mesh, c, 1 - s, garment) < 0 && u.wrong_sign[s] != 0)
            u.G = u.G_side[s];
      const double size = norm(u.G);
      if (size > 0) {
        u.direction = u.G / size;
        u.speed_mps = law.speed_mps * size / std::hypot(size, law.g0);
      }
    }
  }
  for (std::size_t k = 0; k < contours.size(); ++k) out[k].contour = std::move(contours[k]);
  return out;
}

std::vector<Untangling> untangle(const ContactMesh& mesh, std::span<const Vec3> x, std::span<const int> garment,
                                 std::span<const char> obstacle, const UntangleLaw& law) {
  return untangleContours(mesh, x, traceContours(mesh, x, findCrossings(mesh, x, obstacle)), garment, law);
}

std::vector<RestoringRow> restoringRows(const ContactMesh& mesh, const Untangling& u) {
  std::vector<RestoringRow> rows;
  if (!(u.speed_mps > 0)) return rows;
  for (const ContourPoint& p : u.contour.points) {
    if (p.vertex >= 0) continue;
    const auto& [v, w] = mesh.edges[p.edge];
    const auto& [a, b, c] = mesh.triangles[p.triangle];
    const double sign = p.owner == 1 ? 1 : -1;
    const auto& e = p.edge_weight;
    const auto& t = p.triangle_weight;
    rows.push_back({{v, w, a, b, c},
                    {sign * e[0], sign * e[1], -sign * t[0], -sign * t[1], -sign * t[2]},
                    u.direction,
                    u.speed_mps});
  }
  return rows;
}

std::vector<Tangle> tangledVertices(const ContactMesh& mesh, std::span<const Untangling> untanglings) {
  std::vector<Tangle> tangle(mesh.vertex_count, Tangle::kFree);
  for (const auto& u : untanglings)
    for (const auto& p : u.contour.points) {
      if (p.vertex >= 0) {
        tangle[p.vertex] = Tangle::kBeside;
        continue;
      }
      for (int v : mesh.edges[p.edge]) tangle[v] = Tangle::kBeside;
      for (int v : mesh.triangles[p.triangle]) tangle[v] = Tangle::kBeside;
    }
  for (const auto& u : untanglings)
    for (const auto& part : u.wrong_vertices)
      for (int v : part) tangle[v] = Tangle::kWrong;
  return tangle;
}

}  // namespace gambeson
