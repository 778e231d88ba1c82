/// A missing support in words.

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>

#include "core/statics/structure_system.hpp"

namespace gambeson {
namespace {

using Rigid = Eigen::Matrix<double, 6, 1>;  ///< rotation (times a length) and translation

double tidy(double v) { return std::abs(v) < 5e-4 ? 0.0 : v; }

std::string vectorText(const Vec3& v) {
  return fmt::format("({:.3g}, {:.3g}, {:.3g})", tidy(v.x), tidy(v.y), tidy(v.z));
}

std::string axisText(const Vec3& v) {
  const char* names[] = {"x", "y", "z"};
  for (int d = 0; d < 3; ++d)
    if (std::abs(std::abs(v[d]) - 1) < 1e-6) return names[d];
  return vectorText(v);
}

/// Rigid motions that satisfy the supports, in row echelon form, rotations first.
std::vector<Rigid> freeRigidMotions(const Structure& s, const Vec3& center, double length) {
  const SparseRows& C = s.dofs.C;
  Eigen::MatrixXd R = Eigen::MatrixXd::Zero(C.rows(), 6);  // inner unknowns stay, but that directors turn
  for (std::size_t p = 0; p < s.cloth->map().home.size(); ++p) {
    const Vec3 x = (s.cloth->rest()[s.cloth->map().home[p]] - center) / length;
    for (int d = 0; d < 3; ++d) {
      Vec3 axis{};
      axis[d] = 1;
      const Vec3 turn = cross(axis, x);
      for (int i = 0; i < 3; ++i) {
        R(static_cast<long>(3 * p) + i, d) = turn[i];
        R(static_cast<long>(3 * p) + i, 3 + d) = i == d ? 1 : 0;
      }
    }
  }
  for (std::size_t k = 0; s.cloth->turnsInner() && k < s.cloth->innerRates(); ++k)
    R(static_cast<long>(3 * s.cloth->map().home.size() + k), static_cast<long>(k % 3)) = 1 / length;
  // Each unknown is one of the components; what C makes of those must be the motion.
  Eigen::MatrixXd Y = Eigen::MatrixXd::Zero(C.column_count, 6);
  for (int j = 0; j < C.column_count; ++j)
    for (int d = 0; d < 6; ++d) Y(j, d) = s.dofs.unknownOf(j, R(s.dofs.component[static_cast<std::size_t>(j)], d));
  Eigen::MatrixXd misfit = R;
  for (int r = 0; r < C.rows(); ++r)
    for (int k = C.offsets[r]; k < C.offsets[r + 1]; ++k) misfit.row(r) -= C.values[k] * Y.row(C.columns[k]);
  const Eigen::Matrix<double, 6, 6> gram = misfit.transpose() * misfit;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(gram);
  std::vector<Rigid> null;
  for (int k = 0; k < 6; ++k)
    if (eigen.eigenvalues()(k) < 1e-16 * static_cast<double>(C.rows())) null.push_back(eigen.eigenvectors().col(k));
  std::size_t row = 0;
  for (int column = 0; column < 6 && row < null.size(); ++column) {
    std::size_t pivot = row;
    for (std::size_t k = row; k < null.size(); ++k)
      if (std::abs(null[k](column)) > std::abs(null[pivot](column))) pivot = k;
    if (std::abs(null[pivot](column)) < 1e-7) continue;
    std::swap(null[row], null[pivot]);
    null[row] /= null[row](column);
    for (std::size_t k = 0; k < null.size(); ++k)
      if (k != row) null[k] -= null[k](column) * Rigid(null[row]);
    ++row;
  }
  return null;
}

}  // namespace

std::string describeMotion(const Structure& s, std::span<const double> motion) {
  Vec3 center{}, low = s.cloth->rest().front(), high = low;
  for (const Vec3& x : s.cloth->rest()) {
    center += x / static_cast<double>(s.cloth->rest().size());
    for (int d = 0; d < 3; ++d) low[d] = std::min(low[d], x[d]), high[d] = std::max(high[d], x[d]);
  }
  const double length = norm(high - low);
  std::string text;
  for (const Rigid& m : freeRigidMotions(s, center, length)) {
    const Vec3 w{m(0), m(1), m(2)}, t{m(3), m(4), m(5)};
    if (!text.empty()) text += ", ";
    if (norm(w) < 1e-6)
      text += "translation along " + axisText(normalized(t));
    else
      text += fmt::format("rotation about {} through {}", axisText(normalized(w)),
                          vectorText(center + (length / norm2(w)) * cross(w, t)));
  }
  if (!text.empty()) return "no support holds it against " + text;

  std::vector<double> u(s.dofs.C.rows());
  s.dofs.C.multiply<double>(motion, u);
  std::size_t most = 0;
  const auto at = [&](std::size_t p) { return Vec3{u[3 * p], u[3 * p + 1], u[3 * p + 2]}; };
  for (std::size_t p = 0; p < s.cloth->map().home.size(); ++p)
    if (norm(at(p)) > norm(at(most))) most = p;
  const int point = s.cloth->map().home[most];
  return fmt::format("the supports hold it as a whole, but {}, at {} m, moves along {} without resistance",
                     s.cloth->describePoint(point), vectorText(s.cloth->rest()[point]), axisText(normalized(at(most))));
}

}  // namespace gambeson
