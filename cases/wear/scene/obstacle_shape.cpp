#include "cases/wear/scene/obstacle_shape.hpp"

#include <cmath>

#include "cases/input/overloaded.hpp"
#include "human/files/mesh.hpp"

namespace gambeson {

Shape shapeOf(const ObstacleCase& o, Placement& at) {
  return std::visit(
      Overloaded{
          [&](const EllipsoidObstacle& e) -> Shape {
            at.origin = e.center_m;
            return Ellipsoid{e.semi_axes_m};
          },
          [&](const SphereObstacle& s) -> Shape {
            at.origin = s.center_m;
            if (s.rings == 0) return Ellipsoid{{s.radius_m, s.radius_m, s.radius_m}};
            TriangleMesh mesh;
            mesh.vertices.push_back({0, 0, s.radius_m});
            for (int r = 1; r < s.rings; ++r)
              for (int k = 0; k < s.segments; ++k) {
                const double theta = M_PI * r / s.rings, phi = 2 * M_PI * k / s.segments;
                mesh.vertices.push_back(s.radius_m * Vec3{std::sin(theta) * std::cos(phi),
                                                          std::sin(theta) * std::sin(phi), std::cos(theta)});
              }
            mesh.vertices.push_back({0, 0, -s.radius_m});
            const int last = static_cast<int>(mesh.vertices.size()) - 1;
            const auto id = [&](int r, int k) { return 1 + (r - 1) * s.segments + k % s.segments; };
            for (int k = 0; k < s.segments; ++k) {
              mesh.triangles.push_back({0, id(1, k), id(1, k + 1)});
              for (int r = 1; r + 1 < s.rings; ++r) {
                mesh.triangles.push_back({id(r, k), id(r + 1, k), id(r + 1, k + 1)});
                mesh.triangles.push_back({id(r, k), id(r + 1, k + 1), id(r, k + 1)});
              }
              mesh.triangles.push_back({id(s.rings - 1, k), last, id(s.rings - 1, k + 1)});
            }
            return mesh;
          },
          [&](const PlaneObstacle& p) -> Shape {
            at.origin = p.point_m;
            const Vec3 n = normalized(p.normal);
            const Vec3 e1 = normalized(cross(std::abs(n.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, n)),
                       e2 = cross(n, e1);
            const double h = 0.5 * p.size_m;
            return TriangleMesh{{-h * e1 - h * e2, h * e1 - h * e2, h * e1 + h * e2, -h * e1 + h * e2},
                                {{0, 1, 2}, {0, 2, 3}}};
          },
          [&](const TorusObstacle& t) -> Shape {
            at.origin = t.center_m;
            const Vec3 n = normalized(t.axis);
            const Vec3 e1 = normalized(cross(std::abs(n.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, n)),
                       e2 = cross(n, e1);
            TriangleMesh mesh;
            const auto id = [&](int i, int k) { return i % t.segments * t.rings + k % t.rings; };
            for (int i = 0; i < t.segments; ++i) {
              const double phi = 2 * M_PI * i / t.segments;
              const Vec3 out = std::cos(phi) * e1 + std::sin(phi) * e2;
              for (int k = 0; k < t.rings; ++k) {
                const double theta = 2 * M_PI * k / t.rings;
                mesh.vertices.push_back((t.radius_m + t.tube_m * std::cos(theta)) * out +
                                        t.tube_m * std::sin(theta) * n);
                mesh.triangles.push_back({id(i, k), id(i + 1, k), id(i + 1, k + 1)});
                mesh.triangles.push_back({id(i, k), id(i + 1, k + 1), id(i, k + 1)});
              }
            }
            return mesh;
          },
          [&](const MeshObstacle& m) -> Shape {
            at.origin = m.position_m;
            return loadMesh(m.file, m.scale);
          },
          [&](const SequenceObstacle&) -> Shape { return TriangleMesh{}; },  // MeshSequence has it
      },
      o.shape);
}

}  // namespace gambeson
