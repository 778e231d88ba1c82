#include "core/yarn/solid_stress.hpp"

#include <algorithm>
#include <cmath>

namespace gambeson {
namespace {

/// What a Gauss point carries.
struct PointStress {
  Symmetric S{};
  double cauchy_Pa = 0, nominal_Pa = 0;  ///< along the fibre, by area now and at rest
};

Vec3 times(const Symmetric& T, const Vec3& v) {
  return {T[0] * v.x + T[5] * v.y + T[4] * v.z, T[5] * v.x + T[1] * v.y + T[3] * v.z,
          T[4] * v.x + T[3] * v.y + T[2] * v.z};
}

/// Of the eight points of a cell.
std::array<PointStress, kHexahedronNodes> stressIn(const SolidBody& body, int cell, std::span<const Vec3> x) {
  std::array<Vec3, kHexahedronNodes> corners;
  for (int a = 0; a < kHexahedronNodes; ++a) corners[a] = x[body.mesh().cells[cell][a]];
  std::array<PointStress, kHexahedronNodes> out;
  for (int q = 0; q < kHexahedronNodes; ++q) {
    const HexahedronPoint& p = body.cells()[cell][q];
    const PointStrain at = strainAt(p, corners);
    out[q].S = evaluate(body.lawOf(cell), p.fibre, at.C).stress_Pa;
    const Vec3 CA = times(at.C, p.fibre), SCA = times(out[q].S, CA);
    const double I4 = dot(p.fibre, CA);
    out[q].cauchy_Pa = dot(CA, SCA) / (at.det * I4);
    out[q].nominal_Pa = dot(p.fibre, SCA) / std::sqrt(I4);
  }
  return out;
}

/// N_q at corner c of the cube whose corners are the Gauss points, of which the cell's are sqrt(3) times as far out.
const std::array<std::array<double, kHexahedronNodes>, kHexahedronNodes>& cornersFromPoints() {
  static const auto weights = [] {
    std::array<std::array<double, kHexahedronNodes>, kHexahedronNodes> w;
    for (int c = 0; c < kHexahedronNodes; ++c) w[c] = hexahedronShape(3 * hexahedronPoints()[c]);  // 3/sqrt(3)
    return w;
  }();
  return weights;
}

}  // namespace

std::array<double, 3> meanStress(const SolidCell& cell, std::span<const Vec3> x) {
  const SolidBody& body = cell.body();
  std::array<double, 3> sum{};
  for (int e = 0; e < static_cast<int>(body.cells().size()); ++e) {
    const auto stress = stressIn(body, e, x);
    for (int q = 0; q < kHexahedronNodes; ++q) {
      const double volume = body.cells()[e][q].volume_m3;
      sum[0] += volume * stress[q].S[0];
      sum[1] += volume * stress[q].S[1];
      sum[2] += volume * stress[q].S[5];
    }
  }
  for (double& s : sum) s /= cell.area_m2() * cell.height_m();
  return sum;
}

std::vector<double> fibreStress(const SolidCell& cell, std::span<const Vec3> x) {
  const SolidBody& body = cell.body();
  const auto& weights = cornersFromPoints();
  std::vector<double> sum(x.size(), 0.0);
  std::vector<int> count(x.size(), 0);
  for (int e = 0; e < static_cast<int>(body.cells().size()); ++e) {
    const auto stress = stressIn(body, e, x);
    for (int c = 0; c < kHexahedronNodes; ++c) {
      const int node = body.mesh().cells[e][c];
      ++count[node];
      for (int q = 0; q < kHexahedronNodes; ++q) sum[node] += weights[c][q] * stress[q].cauchy_Pa;
    }
  }
  for (std::size_t i = 0; i < sum.size(); ++i)
    if (count[i] > 0) sum[i] /= count[i];
  return sum;
}

std::array<double, 2> largestTension(const SolidCell& cell, std::span<const Vec3> x) {
  const SolidBody& body = cell.body();
  const int in_layer = cell.design().meshing.across * cell.design().meshing.across;
  std::array<double, 2> most{-INFINITY, -INFINITY};
  for (const YarnBody& b : cell.solids().bodies) {
    const double step_m = cell.yarns().yarn[1 - b.direction].spacing_m / cell.design().meshing.along;
    for (int layer = 0; layer + 1 < b.sections; ++layer) {
      double force = 0;
      for (int k = 0; k < in_layer; ++k) {
        const int e = b.first_cell + layer * in_layer + k;
        const auto stress = stressIn(body, e, x);
        for (int q = 0; q < kHexahedronNodes; ++q) force += body.cells()[e][q].volume_m3 * stress[q].nominal_Pa;
      }
      const double length_m = cell.yarns().arcLength_m(b.direction, b.yarn, layer * step_m, (layer + 1) * step_m);
      most[b.direction] = std::max(most[b.direction], force / length_m);
    }
  }
  return most;
}

std::vector<double> nodePressure(const SolidCell& cell, const SolidCellState& state) {
  std::vector<double> force(state.x.size(), 0.0);
  for (const ContactPoint& p : state.points) {
    const double normal_N = p.area_m2 * p.pressure_Pa;
    const std::array<int, 5> nodes = cell.contact().nodesOf(p.side, p.node, p.facet);
    const std::array<double, 4> share = facetShape(p.over.local);
    force[nodes[0]] += normal_N;
    for (int k = 0; k < 4; ++k) force[nodes[k + 1]] += share[k] * normal_N;
  }
  for (const YarnBody& b : cell.solids().bodies) {
    const std::vector<double> area = nodeAreas(cell.solids().skin(b), cell.solids().mesh.nodes);
    for (std::size_t i = 0; i < force.size(); ++i)
      if (area[i] > 0) force[i] /= area[i];
  }
  return force;
}

}  // namespace gambeson
