#include "analysis/render/shapes.hpp"

namespace gambeson {
namespace {

RenderMesh meshOf(const Ellipsoid& e, const Placement& X_W) {
  constexpr int bands = 48, around = 96;
  constexpr double pi = 3.14159265358979323846;
  const Vec3& s = e.semi_axes;
  RenderMesh mesh;
  const auto add = [&](const Vec3& u) {  // u on the unit sphere; the gradient of sum (x_i / s_i)^2 is the normal
    mesh.vertices.push_back(X_W * Vec3{s.x * u.x, s.y * u.y, s.z * u.z});
    mesh.normals.push_back(normalized(X_W.rotation * Vec3{u.x / s.x, u.y / s.y, u.z / s.z}));
  };
  add({0, 0, 1});
  for (int i = 1; i < bands; ++i) {
    const double theta = pi * i / bands;
    for (int j = 0; j < around; ++j) {
      const double phi = 2 * pi * j / around;
      add({std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
    }
  }
  add({0, 0, -1});
  const int south = static_cast<int>(mesh.vertices.size()) - 1;
  const auto at = [&](int i, int j) { return 1 + (i - 1) * around + j % around; };
  for (int j = 0; j < around; ++j) {
    mesh.triangles.push_back({0, at(1, j), at(1, j + 1)});
    for (int i = 1; i + 1 < bands; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
    mesh.triangles.push_back({at(bands - 1, j), south, at(bands - 1, j + 1)});
  }
  return mesh;
}

RenderMesh meshOf(const TriangleMesh& m, const Placement& X_W) {
  RenderMesh mesh;
  for (const Vec3& p : m.vertices) mesh.vertices.push_back(X_W * p);
  mesh.triangles = m.triangles;
  return mesh;
}

}  // namespace

RenderMesh meshOf(const Shape& shape, const Placement& X_W, Color color) {
  RenderMesh mesh = std::visit([&](const auto& s) { return meshOf(s, X_W); }, shape);
  mesh.color = color;
  return mesh;
}

}  // namespace gambeson
