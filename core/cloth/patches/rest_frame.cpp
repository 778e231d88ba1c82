#include "core/cloth/patches/rest_frame.hpp"

#include <cmath>

#include "core/error.hpp"

namespace gambeson {

RestFrame restFrame(const Vec3& A1, const Vec3& A2, const Vec3& weft, double angle) {
  const Vec3 normal = cross(A1, A2);
  const double area = norm(normal);
  if (!(area > 0)) throw InputError({"", 0, "patch"}, "the rest surface is degenerate (zero area)");
  const Vec3 n = normal / area;
  const Vec3 in_plane = weft - dot(weft, n) * n;
  if (!(norm(in_plane) > 1e-6 * norm(weft)))
    throw InputError({"", 0, "weft"}, "the weft direction is normal to the rest surface");
  const Vec3 e = normalized(in_plane);
  const Vec3 E1 = angle == 0 ? e : std::cos(angle) * e + std::sin(angle) * cross(n, e), E2 = cross(n, E1);
  const double J11 = dot(E1, A1), J12 = dot(E1, A2), J21 = dot(E2, A1), J22 = dot(E2, A2);
  const double det = J11 * J22 - J12 * J21;
  return {J22 / det, -J12 / det, -J21 / det, J11 / det, area};
}

Vec3 curvature(const RestFrame& G, const Vec3& a1, const Vec3& a2, const Vec3& x11, const Vec3& x22, const Vec3& x12) {
  const Vec3 n = normalized(cross(a1, a2));
  const double b11 = dot(n, x11), b22 = dot(n, x22), b12 = dot(n, x12);
  return {G.G11 * G.G11 * b11 + 2 * G.G11 * G.G21 * b12 + G.G21 * G.G21 * b22,
          G.G12 * G.G12 * b11 + 2 * G.G12 * G.G22 * b12 + G.G22 * G.G22 * b22,
          G.G11 * G.G12 * b11 + (G.G11 * G.G22 + G.G21 * G.G12) * b12 + G.G21 * G.G22 * b22};
}

}  // namespace gambeson
