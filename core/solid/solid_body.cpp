#include "core/solid/solid_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "core/math/parallel.hpp"

namespace gambeson {
namespace {

struct Source {
  int row, column, from;
};

}  // namespace

SolidBody::SolidBody(SolidMesh mesh) : mesh_(std::move(mesh)) {
  checkMesh(mesh_);
  const int nodes = static_cast<int>(mesh_.nodes.size()), cells = static_cast<int>(mesh_.cells.size());
  if (cells > std::numeric_limits<int>::max() / 64)
    throw InputError({"", 0, "cells"},
                     fmt::format("{} given, at most {} are allowed", cells, std::numeric_limits<int>::max() / 64));
  std::vector<std::vector<int>> corners_of(nodes);
  for (int e = 0; e < cells; ++e) {
    cells_.push_back(hexahedron(cornersOf(e, mesh_.nodes)));
    for (int g = 0; g < 8 && !mesh_.fibres.empty(); ++g)
      cells_[e][g].fibre = normalized(mesh_.fibres[mesh_.fibres.size() == mesh_.cells.size() ? e : 8 * e + g]);
    for (int a = 0; a < kHexahedronNodes; ++a) corners_of[mesh_.cells[e][a]].push_back(8 * e + a);
  }
  node_offsets_.push_back(0);
  for (const std::vector<int>& list : corners_of) {
    node_corners_.insert(node_corners_.end(), list.begin(), list.end());
    node_offsets_.push_back(static_cast<int>(node_corners_.size()));
  }
  for (int r = 0; r < nodes; ++r) {
    std::vector<Source> row;
    for (const int corner : corners_of[r])
      for (int b = 0; b < kHexahedronNodes; ++b)
        if (const int c = mesh_.cells[corner / 8][b]; c >= r) row.push_back({r, c, 8 * corner + b});
    std::stable_sort(row.begin(), row.end(), [](const Source& p, const Source& q) { return p.column < q.column; });
    if (row.empty()) {
      sparsity_.columns.push_back(r);
      block_offsets_.push_back(static_cast<long>(block_sources_.size()));
    }
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (k == 0 || row[k].column != row[k - 1].column) {
        sparsity_.columns.push_back(row[k].column);
        block_offsets_.push_back(static_cast<long>(block_sources_.size()));
      }
      block_sources_.push_back(row[k].from);
    }
    sparsity_.offsets.push_back(static_cast<long>(sparsity_.columns.size()));
  }
  block_offsets_.push_back(static_cast<long>(block_sources_.size()));
}

std::array<Vec3, kHexahedronNodes> SolidBody::cornersOf(int cell, std::span<const Vec3> x) const {
  std::array<Vec3, kHexahedronNodes> corners;
  for (int a = 0; a < kHexahedronNodes; ++a) corners[a] = x[mesh_.cells[cell][a]];
  return corners;
}

const BonetBurton& SolidBody::lawOf(int cell) const {
  return mesh_.materials[mesh_.material_of.empty() ? 0 : mesh_.material_of[cell]].law;
}

double SolidBody::volume() const {
  double sum = 0;
  for (const Hexahedron& cell : cells_)
    for (const HexahedronPoint& p : cell) sum += p.volume_m3;
  return sum;
}

double SolidBody::force(std::span<const Vec3> x, std::span<Vec3> force, SolidWork& work) const {
  const int cells = static_cast<int>(cells_.size());
  work.energy.resize(cells);
  work.force.resize(8 * cells_.size());
  forAll(Each::much, cells, [&](int e) {
    std::array<Vec3, kHexahedronNodes> f;
    work.energy[e] = evaluate(cells_[e], lawOf(e), cornersOf(e, x), f);
    std::copy(f.begin(), f.end(), work.force.begin() + 8 * e);
  });
  forAll(Each::sum, static_cast<int>(mesh_.nodes.size()), [&](int i) {
    Vec3 sum{};
    for (int k = node_offsets_[i]; k < node_offsets_[i + 1]; ++k) sum += work.force[node_corners_[k]];
    force[i] = sum;
  });
  double energy = 0;
  for (const double e : work.energy) energy += e;
  return energy;
}

void SolidBody::stiffness(std::span<const Vec3> x, BlockMatrix& K, SolidWork& work) const {
  work.stiffness.resize(576 * cells_.size());
  forAll(Each::much, static_cast<int>(cells_.size()), [&](int e) {
    std::array<Vec3, kHexahedronNodes> unused;
    std::array<double, 576> k;
    evaluate(cells_[e], lawOf(e), cornersOf(e, x), unused, k);
    std::copy(k.begin(), k.end(), work.stiffness.begin() + 576L * e);
  });
  K.values.resize(9 * K.columns.size());
  forAll(Each::sum, static_cast<int>(K.columns.size()), [&](int block) {
    std::array<double, 9> sum{};
    for (long k = block_offsets_[block]; k < block_offsets_[block + 1]; ++k) {
      const int from = block_sources_[k], cell = from / 64, a = from / 8 % 8, b = from % 8;
      const double* at = work.stiffness.data() + 576L * cell + 24 * 3 * a + 3 * b;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) sum[3 * i + j] += at[24 * i + j];
    }
    std::copy(sum.begin(), sum.end(), K.values.begin() + 9L * block);
  });
}

void SolidBody::mass(bool lumped, BlockMatrix& M) const {
  M.values.assign(9 * M.columns.size(), 0.0);
  for (int e = 0; e < static_cast<int>(cells_.size()); ++e) {
    const double density = mesh_.materials[mesh_.material_of.empty() ? 0 : mesh_.material_of[e]].density_kg_per_m3;
    const std::array<double, 64> products = shapeProducts(cells_[e]);
    for (int a = 0; a < kHexahedronNodes; ++a)
      for (int b = 0; b < kHexahedronNodes; ++b) {
        const int r = mesh_.cells[e][a], c = lumped ? r : mesh_.cells[e][b];
        if (c < r) continue;
        const double m = density * products[8 * a + b];
        M.add(r, c, {m, 0, 0, 0, m, 0, 0, 0, m});
      }
  }
}

}  // namespace gambeson
