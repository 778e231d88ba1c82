#include "core/contact/sharp.hpp"

namespace gambeson {

Vec3 alongFrom(const ContactMesh& mesh, std::span<const Vec3> x, int v, int edge) {
  return alongFrom(viewOf(mesh), x.data(), v, edge);
}

Vec3 acrossFrom(const ContactMesh& mesh, std::span<const Vec3> x, int edge, int t) {
  return acrossFrom(viewOf(mesh), x.data(), edge, t);
}

bool isSharpEdge(const ContactMesh& mesh, std::span<const Vec3> x, int edge) {
  return isSharpEdge(viewOf(mesh), x.data(), edge);
}

bool isSharpCorner(const ContactMesh& mesh, std::span<const Vec3> x, int v) {
  return isSharpCorner(viewOf(mesh), x.data(), v);
}

}  // namespace gambeson
