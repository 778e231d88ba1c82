#pragma once
/// Small garments of triangles as OBJ and PLY files, of our own making.

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

namespace gambeson {

/// A tube of 12 flat sides about the z axis, `radius` around and `height` high, in 3 rows of squares: the sides 0 to 5
/// of material front, 6 to 11 of back. Both halves have vertices of their own along their seams and the same uv, which
/// is `per_uv` long in one: rectangles of the sides laid flat, the back's mirrored.
inline std::string tubeObj(double radius, double height, double per_uv, bool with_uv = true) {
  const int sides = 12, rows = 3;
  const double side = 2 * radius * std::sin(std::numbers::pi / sides);
  std::string out = "# a tube\nmtllib looks.mtl\no tube\n", vt, faces;
  int count = 0;
  for (const char* name : {"front", "back"}) {
    const int first = name[0] == 'f' ? 0 : 6, start = count;
    for (int j = 0; j <= rows; ++j)
      for (int i = 0; i <= 6; ++i) {
        const double angle = 2 * std::numbers::pi * (first + i) / sides;
        out += fmt::format("v {:.17g} {:.17g} {:.17g}\n", radius * std::cos(angle), radius * std::sin(angle),
                           height * j / rows);
        vt += fmt::format("vt {:.17g} {:.17g}\n", (name[0] == 'f' ? i : 6 - i) * side / per_uv,
                          height * j / rows / per_uv);
        ++count;
      }
    faces += fmt::format("usemtl {}\n", name);
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < 6; ++i) {
        const int a = start + 1 + 7 * j + i;
        if (with_uv)
          faces += fmt::format("f {0}/{0} {1}/{1} {2}/{2} {3}/{3}\n", a, a + 1, a + 8, a + 7);
        else
          faces += fmt::format("f {} {} {} {}\n", a, a + 1, a + 8, a + 7);
      }
  }
  return out + (with_uv ? vt : "") + faces;
}

/// Two triangles of a square of 20 cm, with uv by vertex where asked for.
inline std::string squarePly(bool with_uv) {
  std::string out = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
  if (with_uv) out += "property float s\nproperty float t\n";
  out += "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
  const int corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (const auto& c : corners)
    out += fmt::format("{} {} 0.5{}\n", 0.2 * c[0], 0.2 * c[1], with_uv ? fmt::format(" {} {}", c[0], c[1]) : "");
  return out + "3 0 1 2\n3 0 2 3\n";
}

}  // namespace gambeson
