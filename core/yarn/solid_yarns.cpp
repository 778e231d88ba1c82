#include "core/yarn/solid_yarns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace gambeson {
namespace {

[[noreturn]] void refuse(const char* key, const std::string& why) { throw InputError({"", 0, key}, why); }

void check(const WovenYarns& yarns, const YarnMeshing& meshing, bool quarter) {
  checkWovenYarns(yarns);
  if (meshing.across < 2 || meshing.across > 16) refuse("across", fmt::format("{}, must be 2 to 16", meshing.across));
  if (meshing.along < 5 || meshing.along > 63 || meshing.along % 2 == 0)
    refuse("along", fmt::format("{}, must be odd, 5 to 63", meshing.along));
  if (quarter && !isPlain(yarns.weave)) refuse("extent", "quarter, must be full unless the weave is plain");
}

/// A yarn at s along the cloth: its middle and the axes of its section.
struct Frame {
  Vec3 middle, tangent, across, normal;
};

Frame frameAt(const WovenYarns& yarns, int direction, int yarn, double s) {
  const Vec3 ahead = direction == along_weft ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, up{0, 0, 1}, across = cross(up, ahead);
  const Vec3 tangent = normalized(ahead + yarns.slope(direction, yarn, s) * up);
  return {yarns.middle(direction, yarn, s), tangent, across, cross(tangent, across)};
}

class Builder {
 public:
  Builder(const WovenYarns& yarns, const YarnMeshing& meshing, SolidYarns& out)
      : yarns_(yarns), n_(meshing.across), along_(meshing.along), out_(out) {}

  /// A yarn over a number of spacings from s = 0.
  void add(int direction, int yarn, int spacings) {
    const double L = yarns_.yarn[1 - direction].spacing_m;
    YarnBody body{direction,
                  yarn,
                  static_cast<int>(out_.mesh.nodes.size()),
                  static_cast<int>(out_.mesh.cells.size()),
                  0,
                  along_ * spacings + 1,
                  yarns_.arcLength_m(direction, yarn, 0, spacings * L)};
    const double step = L / along_;
    const WovenYarn& size = yarns_.yarn[direction];
    for (int l = 0; l < body.sections; ++l) {
      const Frame frame = frameAt(yarns_, direction, yarn, l * step);
      for (int j = 0; j <= n_; ++j)
        for (int i = 0; i <= n_; ++i) {
          const double p = -1 + 2.0 * i / n_, r = -1 + 2.0 * j / n_;
          out_.mesh.nodes.push_back(frame.middle + size.half_width_m * p * std::sqrt(1 - r * r / 2) * frame.across +
                                    size.half_thickness_m * r * std::sqrt(1 - p * p / 2) * frame.normal);
        }
    }
    addCells(body, step);
    out_.bodies.push_back(body);
    widen(body);
  }

 private:
  void addCells(YarnBody& body, double step) {
    for (int l = 0; l + 1 < body.sections; ++l)
      for (int j = 0; j < n_; ++j)
        for (int i = 0; i < n_; ++i) {
          const auto at = [&](int dl, int di, int dj) { return out_.node(body, l + dl, i + di, j + dj); };
          out_.mesh.cells.push_back(
              {at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0), at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)});
          out_.mesh.material_of.push_back(body.direction);
          for (const Vec3& local : hexahedronPoints())
            out_.mesh.fibres.push_back(
                frameAt(yarns_, body.direction, body.yarn, (l + 0.5 * (1 + local.x)) * step).tangent);
        }
    body.end_cell = static_cast<int>(out_.mesh.cells.size());
  }

  /// Volumes go with the widths, which are measured along one axis of the cloth.
  void widen(const YarnBody& body) {
    SolidMesh& mesh = out_.mesh;
    double volume = 0;
    for (int e = body.first_cell; e < body.end_cell; ++e) {
      std::array<Vec3, kHexahedronNodes> corners;
      for (int a = 0; a < kHexahedronNodes; ++a) corners[a] = mesh.nodes[mesh.cells[e][a]];
      for (const HexahedronPoint& p : hexahedron(corners)) volume += p.volume_m3;
    }
    const WovenYarn& size = yarns_.yarn[body.direction];
    const double wanted = std::numbers::pi * size.half_width_m * size.half_thickness_m * body.length_m;
    const int axis = 1 - body.direction;
    const double middle = yarns_.middle(body.direction, body.yarn, 0)[axis];
    for (std::size_t i = body.first_node; i < mesh.nodes.size(); ++i)
      mesh.nodes[i][axis] = middle + wanted / volume * (mesh.nodes[i][axis] - middle);
  }

  const WovenYarns& yarns_;
  int n_, along_;
  SolidYarns& out_;
};

}  // namespace

int SolidYarns::node(const YarnBody& body, int section, int i, int j) const {
  const int n = meshing.across + 1;
  return body.first_node + (section * n + j) * n + i;
}

std::vector<Facet> SolidYarns::skin(const YarnBody& body) const {
  const int in_section = (meshing.across + 1) * (meshing.across + 1);
  std::vector<Facet> facets = boundaryFacets(mesh, body.first_cell, body.end_cell);
  std::erase_if(facets, [&](const Facet& f) {
    const auto sectionOf = [&](int node) { return (node - body.first_node) / in_section; };
    return std::all_of(f.begin(), f.end(), [&](int node) { return sectionOf(node) == sectionOf(f[0]); });
  });
  return facets;
}

SolidYarns solidYarns(const WovenYarns& yarns, const std::array<BonetBurton, 2>& law, const YarnMeshing& meshing,
                      bool quarter) {
  check(yarns, meshing, quarter);
  SolidYarns out;
  out.meshing = meshing;
  out.mesh.materials = {{law[along_weft], 0}, {law[along_warp], 0}};
  Builder builder(yarns, meshing, out);
  for (const int d : {along_weft, along_warp})
    for (int k = 0; k < (quarter ? 1 : yarns.count(d)); ++k) builder.add(d, k, quarter ? 1 : yarns.crossings(d));
  return out;
}

}  // namespace gambeson
