#include "core/material/table/strain_spline.hpp"

#include <algorithm>
#include <cstddef>

namespace gambeson {
namespace {

/// Nodes on both sides of 0.
std::vector<double> mirrored(const std::vector<double>& nodes) {
  std::vector<double> all;
  for (std::size_t k = nodes.size(); k-- > 1;) all.push_back(-nodes[k]);
  all.insert(all.end(), nodes.begin(), nodes.end());
  return all;
}

/// values[i][j] to values[j][i], each with `size` numbers.
std::vector<double> turned(std::span<const double> values, std::size_t rows, std::size_t columns, std::size_t size) {
  std::vector<double> out(values.size());
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < columns; ++j)
      for (std::size_t c = 0; c < size; ++c) out[(j * rows + i) * size + c] = values[(i * columns + j) * size + c];
  return out;
}

}  // namespace

template <int kParts>
StrainSpline<kParts>::StrainSpline()
    : axes_{SplineAxis({0}), SplineAxis({0}), SplineAxis({0})}, coefficients_(kParts, 0.0) {}

template <int kParts>
StrainSpline<kParts>::StrainSpline(const StrainGrid& grid, std::span<const double> values,
                                   const std::array<int, kParts>& parity)
    : axes_{SplineAxis(grid.nodes[0]), SplineAxis(grid.nodes[1]),
            SplineAxis(parity[0] == 0 ? grid.nodes[2] : mirrored(grid.nodes[2]))} {
  constexpr auto parts = static_cast<std::size_t>(kParts);
  const std::size_t own = grid.nodes[2].size(), all = axes_[2].nodes().size();
  const std::size_t n0 = grid.nodes[0].size(), n1 = grid.nodes[1].size(), planes = n0 * n1;
  coefficients_.resize(planes * all * parts);
  for (std::size_t at = 0; at < planes; ++at)
    for (std::size_t k = 0; k < all; ++k) {
      const bool below = k + own < all;
      const std::size_t from = below ? all - own - k : k - (all - own);
      for (std::size_t c = 0; c < parts; ++c) {
        const double value = values[(at * own + from) * parts + c];
        const bool turns = parity[c] < 0 && all > own;
        coefficients_[(at * all + k) * parts + c] = turns && from == 0 ? 0 : turns && below ? -value : value;
      }
    }
  // Along each axis in turn: the axis goes in front, is solved for, and goes back.
  const std::size_t size = coefficients_.size();
  coefficients_ = axes_[0].coefficients(coefficients_, static_cast<int>(size / n0));
  std::vector<double> c = turned(coefficients_, n0, n1, all * parts);
  c = axes_[1].coefficients(c, static_cast<int>(size / n1));
  c = turned(turned(c, n1, n0, all * parts), planes, all, parts);
  c = axes_[2].coefficients(c, static_cast<int>(size / all));
  coefficients_ = turned(c, all, planes, parts);
}

template <int kParts>
void StrainSpline<kParts>::evaluate(const std::array<double, 3>& E, std::array<StrainTaylor, kParts>& out) const {
  const SplineAxis::Basis u = axes_[0].at(E[0]), v = axes_[1].at(E[1]), w = axes_[2].at(E[2]);
  const int nu = axes_[0].order(), nv = axes_[1].order(), nw = axes_[2].order();
  const long rows = axes_[1].count(), depth = axes_[2].count();
  out = {};
  for (int i = 0; i < nu; ++i) {
    double plane[6][kParts]{};  // derivatives in E22, 2 E12: none, 2, 3, 22, 33, 23
    for (int j = 0; j < nv; ++j) {
      double line[3][kParts]{};
      const double* c = coefficients_.data() + (((u.first + i) * rows + v.first + j) * depth + w.first) * kParts;
      for (int k = 0; k < nw; ++k)
        for (int d = 0; d < 3; ++d)
          for (int part = 0; part < kParts; ++part) line[d][part] += w.value[d][k] * c[k * kParts + part];
      for (int part = 0; part < kParts; ++part) {
        plane[0][part] += v.value[0][j] * line[0][part];
        plane[1][part] += v.value[1][j] * line[0][part];
        plane[2][part] += v.value[0][j] * line[1][part];
        plane[3][part] += v.value[2][j] * line[0][part];
        plane[4][part] += v.value[0][j] * line[2][part];
        plane[5][part] += v.value[1][j] * line[1][part];
      }
    }
    const double b = u.value[0][i], b1 = u.value[1][i], b11 = u.value[2][i];
    for (int part = 0; part < kParts; ++part) {
      StrainTaylor& t = out[static_cast<std::size_t>(part)];
      const auto p = [&](int k) { return plane[k][part]; };
      t.value += b * p(0);
      t.first[0] += b1 * p(0);
      t.first[1] += b * p(1);
      t.first[2] += b * p(2);
      t.second[0] += b11 * p(0);
      t.second[1] += b * p(3);
      t.second[2] += b * p(4);
      t.second[3] += b1 * p(1);
      t.second[4] += b1 * p(2);
      t.second[5] += b * p(5);
    }
  }
}

template class StrainSpline<1>;
template class StrainSpline<3>;
template class StrainSpline<6>;

}  // namespace gambeson
