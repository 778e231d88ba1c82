#include "core/yarn/cell_response.hpp"

#include <Eigen/Dense>

#include <cmath>

#include "core/error.hpp"
#include "core/statics/newton.hpp"

namespace gambeson {

CellResultants resultantsOf(const RodCell& cell, const CellLoad& load, std::span<const Pose> sections,
                            const CellHistory* history) {
  CellAnswer answer;
  const CellFaces faces = facesOf(cell.yarns(), load);
  CellFriction friction;
  if (history) friction = frictionAt(cell, faces, sections, *history);
  cell.evaluate(faces, sections, answer, nullptr, false, history ? &friction : nullptr);
  const std::array<FaceMotion, 4> motions = faceMotions(cell.yarns(), load);
  std::array<double, 4> n{};
  for (int e = 0; e < 4; ++e)
    for (int g = 0; g < 2; ++g)
      n[e] += dot(answer.gradient[2 * cell.sections() + g], motions[e].dt_m[g]) +
              dot(answer.face_moment_Nm[g], motions[e].spin_rad[g]);
  const double area = cell.area_m2();
  return {answer.energy_J / area, n[0] / area, n[1] / area, n[2] / area, n[3] / area};
}

std::array<double, 9> membraneTangent(const RodCell& cell, const CellLoad& load, std::span<const Pose> sections,
                                      EquilibriumWork& work) {
  if (load.curvature_per_m != 0) throw RunError("the tangent of a cell's membrane is of flat cloth");
  const CellFaces faces = facesOf(cell.yarns(), load);
  work.press(faces, sections);
  work.evaluate(faces, sections, work.answer);
  if (!work.settle(faces, sections, work.answer)) throw RunError("the cell of yarns is not stable");
  const std::array<FaceMotion, 4> motions = faceMotions(cell.yarns(), load);
  const auto rows = static_cast<std::size_t>(3 * cell.blocks());
  const SparseRows& C = cell.freedoms();

  // Columns of d(all blocks)/dE: the faces move, the sections follow so that their forces stay balanced.
  Eigen::MatrixXd moved = Eigen::MatrixXd::Zero(static_cast<long>(rows), 3), force(static_cast<long>(rows), 3);
  std::vector<double> x(rows), y(rows);
  for (int e = 0; e < 3; ++e) {
    std::fill(x.begin(), x.end(), 0.0);
    for (int g = 0; g < 2; ++g)
      for (int c = 0; c < 3; ++c) x[3 * (2 * cell.sections() + g) + c] = motions[e].dt_m[g][c];
    multiply(work.blocks(), x, y);
    std::vector<double> force_of_faces = work.onUnknowns(y);
    for (double& f : force_of_faces) f = -f;
    const std::vector<double> follow = work.follow(force_of_faces);
    for (int row = 0; row < C.rows(); ++row)
      for (int k = C.offsets[row]; k < C.offsets[row + 1]; ++k) x[row] += C.values[k] * follow[C.columns[k]];
    multiply(work.blocks(), x, y);
    moved.col(e) = Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<long>(rows));
    force.col(e) = Eigen::Map<const Eigen::VectorXd>(y.data(), static_cast<long>(rows));
  }
  Eigen::Matrix3d D = moved.transpose() * force;
  const auto second = faceCurvature(cell.yarns(), load);
  constexpr int pairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
  for (int v = 0; v < 6; ++v) {
    double turn = 0;
    for (int g = 0; g < 2; ++g) turn += dot(work.answer.gradient[2 * cell.sections() + g], second[v][g]);
    D(pairs[v][0], pairs[v][1]) += turn;
    if (v > 2) D(pairs[v][1], pairs[v][0]) += turn;
  }
  std::array<double, 9> out{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) out[3 * i + j] = 0.5 * (D(i, j) + D(j, i)) / cell.area_m2();
  return out;
}

LoadReport freeAcross(const RodCell& cell, CellLoad& load, std::vector<Pose>& sections, EquilibriumWork& work,
                      double tolerance, const EquilibriumOptions& options, YarnDirection pulled) {
  constexpr int kIterations = 30;
  constexpr double kLongest = 0.02, kRounding = 1e-12;  // of the strain across
  const bool weft = pulled == along_weft;
  const auto across = [&](CellLoad& l) -> double& { return weft ? l.e22 : l.e11; };
  LoadReport report;
  report.reached = load;
  for (int k = 0; k < kIterations; ++k) {
    const CellResultants n = resultantsOf(cell, load, sections, work.history);
    report.end = EquilibriumReport::End::converged;
    const double side = weft ? n.n22 : n.n11, along = weft ? n.n11 : n.n22;
    if (std::abs(side) <= tolerance * (std::abs(along) + std::abs(n.n12))) return report;
    const double slope = membraneTangent(cell, load, sections, work)[weft ? 4 : 0];
    CellLoad next = load;
    across(next) -= std::clamp(side / std::abs(slope), -kLongest, kLongest);
    if (std::abs(across(next) - across(load)) <= kRounding) return report;
    const int before = report.iterations;
    report = changeLoad(cell, load, next, sections, work, options);
    report.iterations += before;
    load = report.reached;
    if (!report.converged()) return report;
  }
  report.end = EquilibriumReport::End::too_many_iterations;
  return report;
}

}  // namespace gambeson
