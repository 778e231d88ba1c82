#include "core/yarn/solid_response.hpp"

namespace gambeson {

CellResultants resultantsOf(const SolidCell& cell, const SolidCellState& state) {
  SolidWork work;
  std::vector<Vec3> force(state.x.size());
  const double stored = cell.body().force(state.x, force, work);
  cell.contact().addForce(state.points, force);
  const std::array<Vec3, 2> carried = cell.faceForces(force);
  const std::array<FaceMotion, 4> motions = faceMotions(cell.yarns(), state.load);
  std::array<double, 3> n{};
  for (int e = 0; e < 3; ++e)
    for (int g = 0; g < 2; ++g) n[e] += dot(carried[g], motions[e].dt_m[g]) / cell.area_m2();
  return {(stored + cell.contact().energy(state.points)) / cell.area_m2(), n[0], n[1], n[2], 0};
}

std::array<double, 3> stressOf(const SolidCell& cell, const CellResultants& n) {
  const double height = cell.height_m();
  return {n.n11 / height, n.n22 / height, n.n12 / height};
}

std::array<double, 3> meanStress(const SolidCell& cell, std::span<const Vec3> x) {
  const SolidBody& body = cell.body();
  std::array<double, 3> sum{};
  for (std::size_t e = 0; e < body.cells().size(); ++e) {
    std::array<Vec3, kHexahedronNodes> corners;
    for (int a = 0; a < kHexahedronNodes; ++a) corners[a] = x[body.mesh().cells[e][a]];
    for (const HexahedronPoint& p : body.cells()[e]) {
      const Symmetric S = evaluate(body.lawOf(static_cast<int>(e)), p.fibre, strainAt(p, corners).C).stress_Pa;
      sum[0] += p.volume_m3 * S[0];
      sum[1] += p.volume_m3 * S[1];
      sum[2] += p.volume_m3 * S[5];
    }
  }
  for (double& s : sum) s /= cell.area_m2() * cell.height_m();
  return sum;
}

}  // namespace gambeson
