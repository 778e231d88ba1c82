#include "core/cloth/degenerated/directors.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "core/cloth/draft/seams.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

/// The tangent at the point k of a line of points, of a parabola through it and its neighbours over chord lengths.
template <class At>
Vec3 tangentOf(int k, int count, const At& at) {
  if (count == 2) return normalized(at(1) - at(0));
  const int middle = std::clamp(k, 1, count - 2);
  const Vec3 before = at(middle) - at(middle - 1), after = at(middle + 1) - at(middle);
  const double a = norm(before), b = norm(after);
  const Vec3 slope = (b * b * before + a * a * after) / (a * b * (a + b)),
             bend = 2 * (a * after - b * before) / (a * b * (a + b));
  const double from = k < middle ? -a : k > middle ? b : 0;
  return normalized(slope + from * bend);
}

}  // namespace

std::vector<Vec3> normalsOf(const NurbsPatch& p) {
  std::vector<Vec3> normals;
  for (int j = 0; j < p.v.count(); ++j)
    for (int i = 0; i < p.u.count(); ++i) {
      const auto at = [&](int k, int l) -> const Vec3& { return p.points[static_cast<std::size_t>(p.index(k, l))]; };
      const Vec3 normal = cross(tangentOf(i, p.u.count(), [&](int k) { return at(k, j); }),
                                tangentOf(j, p.v.count(), [&](int l) { return at(i, l); }));
      if (!(norm(normal) > 1e-6))
        throw InputError({"", 0, "patches"}, "a shell has no normal at control point (" + std::to_string(i) + ", " +
                                                 std::to_string(j) + "): points coincide, or lines of them touch");
      normals.push_back(normalized(normal));
    }
  return normals;
}

Directors directorsOf(const Garment& garment) {
  std::vector<Vec3> normals;
  for (const NurbsPatch& p : garment.patches) {
    const std::vector<Vec3> own = normalsOf(p);
    normals.insert(normals.end(), own.begin(), own.end());
  }
  std::vector<int> parent(normals.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto find = [&](int i) {
    while (parent[static_cast<std::size_t>(i)] != i) i = parent[static_cast<std::size_t>(i)];
    return i;
  };
  for (std::size_t s = 0; s < garment.seams.size(); ++s) {
    const Seam& seam = garment.seams[s];
    const EdgeColumns a = edgeColumns(garment, seam.a), b = edgeColumns(garment, seam.b);
    const std::size_t from = static_cast<std::size_t>(std::max(0, seam.first_cell));  // of b
    double least = 1, most = -1;
    for (std::size_t k = 0; k < a.edge.size(); ++k) {
      const double cosine =
          dot(normals[static_cast<std::size_t>(a.edge[k])], normals[static_cast<std::size_t>(b.edge[from + k])]);
      least = std::min(least, cosine), most = std::max(most, cosine);
    }
    const double smooth = std::cos(kSmoothSeam_rad);
    const std::string key = "seams[" + std::to_string(s) + "]";
    if (most < -smooth)
      throw InputError({"", 0, key}, "the patches meet smoothly, but their normals are opposite: turn one around");
    if (seam.kind != SeamKind::G1 && !(least > smooth)) {
      if (seam.stiffness_N > 0)
        throw InputError({"", 0, key + ".stiffness"},
                         "a seam of a degenerated shell that meets at an angle is a free hinge; allowed: 0");
      continue;
    }
    for (std::size_t k = 0; k < a.edge.size(); ++k) {
      const int i = find(a.edge[k]), j = find(b.edge[from + k]);
      if (i != j) parent[static_cast<std::size_t>(std::max(i, j))] = std::min(i, j);
    }
  }
  Directors out;
  std::vector<int> number(normals.size(), -1);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    int& own = number[static_cast<std::size_t>(find(static_cast<int>(i)))];
    if (own < 0) {
      own = static_cast<int>(out.rest.size());
      out.rest.emplace_back();
    }
    out.rest[static_cast<std::size_t>(own)] += normals[i];
    out.of_point.push_back(own);
  }
  for (Vec3& d : out.rest) d = normalized(d);
  return out;
}

Vec3 turned(const Vec3& d, const Vec3& turn) {
  const double angle2 = norm2(turn), angle = std::sqrt(angle2);
  const bool small = angle < 1e-4;
  const double sine = small ? 1 - angle2 / 6 : std::sin(angle) / angle;
  const double half = small ? 0.5 - angle2 / 24 : 2 * std::pow(std::sin(0.5 * angle) / angle, 2);
  const Vec3 side = cross(turn, d);
  return normalized(d + sine * side + half * cross(turn, side));
}

}  // namespace gambeson
