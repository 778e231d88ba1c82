#include "core/yarn/cell_state.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

namespace gambeson {
namespace {

Eigen::Quaterniond quaternionOf(const Mat3& m) {
  Eigen::Matrix3d e;
  e << m.a.x, m.b.x, m.c.x, m.a.y, m.b.y, m.c.y, m.a.z, m.b.z, m.c.z;
  return Eigen::Quaterniond(e);
}
Mat3 rotationOf(const Eigen::Quaterniond& q) {
  const Eigen::Matrix3d m = q.toRotationMatrix();
  return {{m(0, 0), m(1, 0), m(2, 0)}, {m(0, 1), m(1, 1), m(2, 1)}, {m(0, 2), m(1, 2), m(2, 2)}};
}

}  // namespace

std::vector<Pose> mixed(const CellState& a, const CellState& b, double part, const CellLoad& to) {
  std::vector<Pose> out = carried(a.sections, a.load, to);
  const std::vector<Pose> other = carried(b.sections, b.load, to);
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i].origin += part * (other[i].origin - out[i].origin);
    const Eigen::Quaterniond p = quaternionOf(out[i].rotation);
    Eigen::Quaterniond q = quaternionOf(other[i].rotation);
    if (p.dot(q) < 0) q.coeffs() *= -1;
    out[i].rotation = rotationOf(Eigen::Quaterniond((1 - part) * p.coeffs() + part * q.coeffs()).normalized());
  }
  return out;
}

std::string findState(const RodCell& cell, const CellState& from, std::vector<Pose> near, const CellLoad& to,
                      EquilibriumWork& work, const EquilibriumOptions& options, CellState& out) {
  EquilibriumReport report = findEquilibrium(cell, facesOf(cell.yarns(), to), near, work, options);
  if (!report.converged() || !report.stable) {
    near.assign(from.sections.begin(), from.sections.end());
    report = changeLoad(cell, from.load, to, near, work, options);
  }
  if (!report.converged()) return report.reason();
  if (!report.stable) return "the equilibrium is not stable";
  out = {to, std::move(near), {}};
  out.resultants = resultantsOf(cell, to, out.sections, work.history);
  return {};
}

std::string inWords(const CellLoad& load) {
  return fmt::format("E11 {:.6g}, E22 {:.6g}, 2 E12 {:.6g}", load.e11, load.e22, load.g12);
}

}  // namespace gambeson
