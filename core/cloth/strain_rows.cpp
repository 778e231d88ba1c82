#include "core/cloth/strain_rows.hpp"

#include <map>
#include <utility>

namespace gambeson {
namespace {

/// Of the rows alone that nothing moves: a diagonal of 1.
void addColumn(const std::map<int, double>& column, int c, bool live, SymmetricMatrix& S) {
  if (live) {
    for (const auto& [row, value] : column) {
      S.rows.push_back(row);
      S.values.push_back(value);
    }
  } else {
    S.rows.push_back(c);
    S.values.push_back(1);
  }
  S.offsets.push_back(static_cast<int>(S.rows.size()));
}

/// S = B M^-1 B^T, lower triangle by columns.
void addMobility(StrainRows& s) {
  const SparseRows &B = s.B, &Bt = s.Bt;
  s.S.size = B.rows();
  for (int c = 0; c < B.rows(); ++c) {
    std::map<int, double> column;
    for (int k = B.offsets[c]; k < B.offsets[c + 1]; ++k) {
      const int free = B.columns[k];
      const double w = B.values[k] * s.mobility.inverse_mass[free];
      if (w == 0) continue;
      for (int j = Bt.offsets[free]; j < Bt.offsets[free + 1]; ++j)
        if (Bt.columns[j] >= c) column[Bt.columns[j]] += w * Bt.values[j];
    }
    s.live.push_back(column.contains(c) && column[c] > 0);
    addColumn(column, c, s.live.back(), s.S);
  }
}

/// As the function above, for a mobility that is a matrix: blocks B P B^T, component by component.
void addMobilityTensors(StrainRows& s) {
  const SparseRows &B = s.B, &Bt = s.Bt, &P = s.mobility.P;
  s.S.size = B.rows();
  for (int c = 0; c < B.rows(); ++c) {
    std::map<int, std::array<double, 9>> column;  // of rows >= c
    for (int b = 0; b < 3; ++b) {
      std::map<int, double> pulled;  // column b of P B_c^T, P symmetric
      for (int k = B.offsets[c]; k < B.offsets[c + 1]; ++k) {
        const int from = 3 * B.columns[k] + b;
        for (int e = P.offsets[from]; e < P.offsets[from + 1]; ++e) pulled[P.columns[e]] += B.values[k] * P.values[e];
      }
      for (const auto& [to, value] : pulled)
        for (int j = Bt.offsets[to / 3]; j < Bt.offsets[to / 3 + 1]; ++j)
          if (Bt.columns[j] >= c) column[Bt.columns[j]][3 * (to % 3) + b] += Bt.values[j] * value;
    }
    const auto third = [](const std::array<double, 9>& t) { return (t[0] + t[4] + t[8]) / 3; };
    s.live.push_back(column.contains(c) && third(column[c]) > 0);
    if (!s.live.back()) column = {{c, {1, 0, 0, 0, 1, 0, 0, 0, 1}}};
    std::map<int, double> numbers;
    for (const auto& [row, tensor] : column) {
      numbers[row] = third(tensor);
      s.tensors.push_back(tensor);
    }
    addColumn(numbers, c, true, s.S);
  }
}

}  // namespace

void applyMobility(const Mobility& mobility, std::span<const Vec3> impulse, std::span<Vec3> velocity) {
  if (mobility.P.rows() == 0) {
    for (std::size_t k = 0; k < impulse.size(); ++k) velocity[k] = mobility.inverse_mass[k] * impulse[k];
    return;
  }
  mobility.P.multiply<double>({&impulse.data()->x, 3 * impulse.size()}, {&velocity.data()->x, 3 * velocity.size()});
}

void completeRows(StrainRows& s) {
  s.Bt = transpose(s.B);
  if (s.mobility.P.rows() == 0)
    addMobility(s);
  else
    addMobilityTensors(s);
}

void strainVectors(const StrainRows& rows, std::span<const Vec3> p, std::vector<Vec3>& e) {
  e.resize(rows.rows());
  rows.B.multiply<Vec3>(p, e);
}

std::vector<Vec2> limitStress(const StrainRows& rows, std::span<const double> multiplier) {
  std::vector<Vec2> field(rows.field_of_row[0].rows());
  std::vector<double> vertex(field.size());
  for (int direction : {0, 1}) {
    rows.field_of_row[direction].multiply<double>(multiplier, vertex);
    for (std::size_t i = 0; i < field.size(); ++i) (direction == 0 ? field[i].x : field[i].y) = vertex[i];
  }
  return field;
}

}  // namespace gambeson
