#include "core/solid/solid_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.hpp"

namespace gambeson {
namespace {

[[noreturn]] void reject(const std::string& key, const std::string& why) { throw InputError({"", 0, key}, why); }

bool finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool isIsotropic(const BonetBurton& law) { return law.alpha_Pa == 0 && law.beta_Pa == 0 && law.gamma_Pa == 0; }

/// The faces of a hexahedron, seen from outside.
constexpr int kFaces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

}  // namespace

void checkMesh(const SolidMesh& mesh) {
  const int nodes = static_cast<int>(mesh.nodes.size()), materials = static_cast<int>(mesh.materials.size());
  if (mesh.cells.empty()) reject("cells", "none given, at least one is needed");
  for (int i = 0; i < nodes; ++i)
    if (!finite(mesh.nodes[i])) reject(fmt::format("nodes[{}]", i), "must be finite");
  if (materials == 0) reject("materials", "none given, at least one is needed");
  bool isotropic = true;
  for (int m = 0; m < materials; ++m) {
    try {
      checkLaw(mesh.materials[m].law);
    } catch (const InputError& e) {
      reject(fmt::format("materials[{}].{}", m, e.where().key), e.reason());
    }
    const double density = mesh.materials[m].density_kg_per_m3;
    if (!(density >= 0) || !std::isfinite(density))
      reject(fmt::format("materials[{}].density_kg_per_m3", m), fmt::format("{} is not allowed: >= 0", density));
    isotropic = isotropic && isIsotropic(mesh.materials[m].law);
  }
  const std::size_t cells = mesh.cells.size();
  if (!mesh.material_of.empty() && mesh.material_of.size() != cells)
    reject("material_of", fmt::format("{} given, {} expected, or none", mesh.material_of.size(), cells));
  for (std::size_t e = 0; e < mesh.material_of.size(); ++e)
    if (mesh.material_of[e] < 0 || mesh.material_of[e] >= materials)
      reject(fmt::format("material_of[{}]", e),
             fmt::format("{} is not allowed: 0 to {}", mesh.material_of[e], materials - 1));
  const std::size_t fibres = mesh.fibres.size();
  if (fibres == 0 && !isotropic) reject("fibres", "none given, and a law has fibres");
  if (fibres != 0 && fibres != cells && fibres != 8 * cells)
    reject("fibres", fmt::format("{} given, {} or {} expected", fibres, cells, 8 * cells));
  for (std::size_t k = 0; k < fibres; ++k)
    if (!finite(mesh.fibres[k]) || !(norm(mesh.fibres[k]) > 0))
      reject(fmt::format("fibres[{}]", k), "must be finite and have a length");
  for (std::size_t e = 0; e < cells; ++e) {
    std::array<Vec3, kHexahedronNodes> rest;
    for (int a = 0; a < kHexahedronNodes; ++a) {
      const int node = mesh.cells[e][a];
      if (node < 0 || node >= nodes)
        reject(fmt::format("cells[{}]", e), fmt::format("node {} is not allowed: 0 to {}", node, nodes - 1));
      rest[a] = mesh.nodes[node];
    }
    for (const HexahedronPoint& p : hexahedron(rest))
      if (!(p.volume_m3 > 0))
        reject(fmt::format("cells[{}]", e),
               "is turned inside out or without volume; corners 0 to 3 go round one face, seen from inside the cell "
               "against the clock");
  }
}

std::vector<Facet> boundaryFacets(const SolidMesh& mesh) {
  return boundaryFacets(mesh, 0, static_cast<int>(mesh.cells.size()));
}

std::vector<Facet> boundaryFacets(const SolidMesh& mesh, int first, int end) {
  std::map<Facet, int> count;
  const auto facetOf = [&](int cell, int face) {
    Facet f{};
    for (int k = 0; k < 4; ++k) f[k] = mesh.cells[cell][kFaces[face][k]];
    return f;
  };
  const auto sorted = [](Facet f) {
    std::sort(f.begin(), f.end());
    return f;
  };
  for (int e = first; e < end; ++e)
    for (int k = 0; k < 6; ++k) ++count[sorted(facetOf(e, k))];
  std::vector<Facet> facets;
  for (int e = first; e < end; ++e)
    for (int k = 0; k < 6; ++k)
      if (const Facet f = facetOf(e, k); count[sorted(f)] == 1) facets.push_back(f);
  return facets;
}

void checkFacets(std::span<const Facet> facets, int nodes) {
  for (std::size_t f = 0; f < facets.size(); ++f)
    for (int k = 0; k < 4; ++k) {
      const int node = facets[f][k];
      if (node < 0 || node >= nodes)
        reject("facets", fmt::format("facet {}: node {} is not allowed: 0 to {}", f, node, nodes - 1));
      for (int j = 0; j < k; ++j)
        if (facets[f][j] == node) reject("facets", fmt::format("facet {} has node {} twice", f, node));
    }
}

std::vector<double> nodeAreas(std::span<const Facet> facets, std::span<const Vec3> nodes) {
  std::vector<double> area(nodes.size(), 0.0);
  for (const Facet& f : facets) {
    const double a = 0.5 * norm(cross(nodes[f[2]] - nodes[f[0]], nodes[f[3]] - nodes[f[1]]));
    for (const int node : f) area[node] += 0.25 * a;
  }
  return area;
}

}  // namespace gambeson
