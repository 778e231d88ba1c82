#include "analysis/render/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "analysis/render/colormap.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

bool finite(const Vec3& a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }

void check(const RenderMesh& mesh, std::size_t which) {
  const auto fail = [&](const std::string& why) {
    throw RunError("cannot draw mesh " + std::to_string(which) + ": " + why);
  };
  const std::size_t n = mesh.vertices.size();
  if (!mesh.scalars.empty() && mesh.scalars.size() != n)
    fail(std::to_string(mesh.scalars.size()) + " scalars for " + std::to_string(n) + " vertices");
  if (!mesh.normals.empty() && mesh.normals.size() != n)
    fail(std::to_string(mesh.normals.size()) + " normals for " + std::to_string(n) + " vertices");
  for (const Vec3& x : mesh.vertices)
    if (!finite(x)) fail("a vertex is not finite");
  for (const auto& t : mesh.triangles)
    for (const int i : t)
      if (i < 0 || static_cast<std::size_t>(i) >= n)
        fail("a triangle names vertex " + std::to_string(i) + " of " + std::to_string(n));
}

DrawVertex vertex(const Vec3& p, const Vec3& n, Color color) {
  DrawVertex v;
  for (int i = 0; i < 3; ++i) v.position[i] = static_cast<float>(p[i]), v.normal[i] = static_cast<float>(n[i]);
  v.color[0] = linearOfSrgb(color.r), v.color[1] = linearOfSrgb(color.g), v.color[2] = linearOfSrgb(color.b);
  return v;
}

std::uint32_t push(DrawList& list, const DrawVertex& v) {
  list.vertices.push_back(v);
  return static_cast<std::uint32_t>(list.vertices.size() - 1);
}

/// Edges of exactly one triangle, as pairs of vertices in the order of the map: the same for any triangle order.
std::vector<std::pair<int, int>> boundaryOf(const RenderMesh& mesh) {
  std::map<std::pair<int, int>, int> count;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) ++count[std::minmax(t[k], t[(k + 1) % 3])];
  std::vector<std::pair<int, int>> edges;
  for (const auto& [edge, uses] : count)
    if (uses == 1) edges.push_back(edge);
  return edges;
}

/// Ribbons that face the viewer, lifted by one width so that their own surface does not hide them.
void addBoundary(DrawList& list, const RenderMesh& mesh, const Camera& camera, double width_m) {
  const Color dark{0.45f * mesh.color.r, 0.45f * mesh.color.g, 0.45f * mesh.color.b};
  for (const auto& [i, j] : boundaryOf(mesh)) {
    const Vec3 a = camera.toCamera(mesh.vertices[i]), b = camera.toCamera(mesh.vertices[j]);
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    if (!(length > 0)) continue;  // seen end on
    const Vec3 along = {(b.x - a.x) / length, (b.y - a.y) / length, 0};
    const Vec3 side = 0.5 * width_m * Vec3{-along.y, along.x, 0}, lift{0, 0, width_m}, cap = 0.3 * width_m * along;
    std::uint32_t k[4];
    const Vec3 corners[4] = {a - side - cap, b - side + cap, b + side + cap, a + side - cap};
    for (int c = 0; c < 4; ++c) {
      DrawVertex v = vertex(corners[c] + lift, {0, 0, 1}, dark);
      v.lit = 0;
      k[c] = push(list, v);
    }
    list.indices.insert(list.indices.end(), {k[0], k[1], k[2], k[0], k[2], k[3]});
  }
}

}  // namespace

std::vector<Vec3> smoothNormals(const RenderMesh& mesh) {
  std::vector<Vec3> normals(mesh.vertices.size());
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const Vec3& x = mesh.vertices[t[k]];
      const Vec3 a = mesh.vertices[t[(k + 1) % 3]] - x, b = mesh.vertices[t[(k + 2) % 3]] - x;
      const Vec3 n = cross(a, b);
      const double size = norm(n);
      if (size > 0) normals[t[k]] += std::atan2(size, dot(a, b)) / size * n;
    }
  for (Vec3& n : normals)
    if (norm2(n) > 0) n = normalized(n);
  return normals;
}

DrawList drawListOf(const std::vector<RenderMesh>& meshes, const Camera& camera, double low, double high,
                    double line_m) {
  DrawList list;
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const RenderMesh& mesh = meshes[m];
    check(mesh, m);
    const std::vector<Vec3> computed = mesh.normals.empty() ? smoothNormals(mesh) : std::vector<Vec3>{};
    const std::vector<Vec3>& normals = mesh.normals.empty() ? computed : mesh.normals;
    const std::uint32_t first = static_cast<std::uint32_t>(list.vertices.size());
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      const Vec3& n = normals[i];
      const CameraAxes& axes = camera.axes;
      DrawVertex v = vertex(camera.toCamera(mesh.vertices[i]),
                            {dot(axes.right, n), dot(axes.up, n), dot(axes.towards, n)}, mesh.color);
      if (!mesh.scalars.empty() && std::isfinite(mesh.scalars[i])) {
        v.map = static_cast<float>(std::clamp((mesh.scalars[i] - low) / (high - low), 0.0, 1.0));
        v.mapped = 1;
      }
      list.vertices.push_back(v);
    }
    for (const auto& t : mesh.triangles)
      for (const int i : t) list.indices.push_back(first + static_cast<std::uint32_t>(i));
    if (mesh.edges) addBoundary(list, mesh, camera, line_m);
  }
  return list;
}

void addArrow(DrawList& list, const Vec3& from, const Vec3& to, double radius_m, Color color) {
  const double length = norm(to - from);
  if (!(length > 0)) return;
  constexpr int around = 32;
  constexpr double pi = 3.14159265358979323846;
  const Vec3 d = (to - from) / length;
  const Vec3 e = normalized(cross(d, std::abs(d.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0})), f = cross(d, e);
  // The head is at most half of the arrow; a shorter arrow is smaller as a whole.
  const double r = std::min(radius_m, length / 13), head = 6.5 * r, head_r = 2.6 * r;
  const Vec3 neck = to - head * d;
  const double slope = head_r / head;  // of the cone: its normals lean forward
  const auto ring = [&](const Vec3& c, double radius, double lean, bool flat) {
    const std::uint32_t first = static_cast<std::uint32_t>(list.vertices.size());
    for (int j = 0; j < around; ++j) {
      const Vec3 out = std::cos(2 * pi * j / around) * e + std::sin(2 * pi * j / around) * f;
      list.vertices.push_back(vertex(c + radius * out, flat ? -d : normalized(out + lean * d), color));
    }
    return first;
  };
  const auto strip = [&](std::uint32_t a, std::uint32_t b) {
    for (std::uint32_t j = 0; j < around; ++j) {
      const std::uint32_t k = (j + 1) % around;
      list.indices.insert(list.indices.end(), {a + j, a + k, b + k, a + j, b + k, b + j});
    }
  };
  const std::uint32_t tail = push(list, vertex(from, -d, color));
  const std::uint32_t cap = ring(from, r, 0, true);
  for (std::uint32_t j = 0; j < around; ++j)
    list.indices.insert(list.indices.end(), {tail, cap + (j + 1) % around, cap + j});
  const std::uint32_t bottom = ring(from, r, 0, false), top = ring(neck, r, 0, false);
  strip(bottom, top);
  const std::uint32_t inner = ring(neck, r, 0, true), outer = ring(neck, head_r, 0, true);
  strip(outer, inner);
  const std::uint32_t base = ring(neck, head_r, slope, false), tip = ring(to, 0, slope, false);
  strip(base, tip);
}

}  // namespace gambeson
