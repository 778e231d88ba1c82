#pragma once
/// Solids for tests.

#include <functional>

#include "core/solid/solid_mesh.hpp"

namespace gambeson::shapes {

/// Man 2006, section 4.3.5.2.
inline BonetBurton kevlar() { return {0.4457e9, 0.5154e9, 0.2714e9, 0.06548e9, 10.54e9}; }

/// A grid of nx by ny by nz cells over the unit cube, moved by `place`: node (i, j, k) is i + (nx + 1) (j + (ny + 1)
/// k).
inline SolidMesh block(int nx, int ny, int nz, const std::function<Vec3(const Vec3&)>& place) {
  SolidMesh m;
  for (int k = 0; k <= nz; ++k)
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i) m.nodes.push_back(place({double(i) / nx, double(j) / ny, double(k) / nz}));
  const auto id = [&](int i, int j, int k) { return i + (nx + 1) * (j + (ny + 1) * k); };
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
        m.cells.push_back({id(i, j, k), id(i + 1, j, k), id(i + 1, j + 1, k), id(i, j + 1, k), id(i, j, k + 1),
                           id(i + 1, j, k + 1), id(i + 1, j + 1, k + 1), id(i, j + 1, k + 1)});
  return m;
}

/// Another mesh beside it, its materials behind those that are there.
inline void append(SolidMesh& m, const SolidMesh& other) {
  const int first = static_cast<int>(m.nodes.size()), material = static_cast<int>(m.materials.size());
  m.material_of.resize(m.cells.size(), 0);
  m.nodes.insert(m.nodes.end(), other.nodes.begin(), other.nodes.end());
  for (std::size_t e = 0; e < other.cells.size(); ++e) {
    std::array<int, 8> cell = other.cells[e];
    for (int& node : cell) node += first;
    m.cells.push_back(cell);
    m.material_of.push_back(material + (other.material_of.empty() ? 0 : other.material_of[e]));
  }
  m.materials.insert(m.materials.end(), other.materials.begin(), other.materials.end());
}

/// The nodes at rest for which `at` holds.
inline std::vector<int> nodesWhere(const SolidMesh& m, const std::function<bool(const Vec3&)>& at) {
  std::vector<int> nodes;
  for (int i = 0; i < static_cast<int>(m.nodes.size()); ++i)
    if (at(m.nodes[i])) nodes.push_back(i);
  return nodes;
}

}  // namespace gambeson::shapes
