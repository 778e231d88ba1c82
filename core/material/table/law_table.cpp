#include "core/material/table/law_table.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/error.hpp"

namespace gambeson {
namespace {

/// Margins beyond the ends of the range at which slopes are looked at: just beyond, within the margin, far.
constexpr std::initializer_list<double> kBeyond{1e-9, 0.5, 1, 10};
constexpr int kPairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};

template <std::size_t kParts>
std::span<const double> flat(const std::vector<std::array<double, kParts>>& values) {
  return values.empty() ? std::span<const double>{} : std::span(values.front().data(), kParts * values.size());
}

StrainSpline<1> membraneOf(const LawTableData& data) {
  checkLawTable(data);
  return {data.membrane, data.energy, {data.even_in_shear ? 1 : 0}};
}

StrainSpline<3> momentOf(const LawTableData& data) {
  if (data.moment.empty()) return {};
  const int even = data.even_in_shear ? 1 : 0;
  return {data.bending, flat(data.moment), {even, even, -even}};
}

StrainSpline<6> rigidityOf(const LawTableData& data) {
  const int even = data.even_in_shear ? 1 : 0;
  return {data.bending, flat(data.rigidity), {even, even, even, even, -even, -even}};
}

Eigen::Matrix3d second(const StrainTaylor& t) {
  Eigen::Matrix3d H;
  for (int p = 0; p < 6; ++p)
    H(kPairs[p][0], kPairs[p][1]) = H(kPairs[p][1], kPairs[p][0]) = t.second[static_cast<std::size_t>(p)];
  return H;
}

double leastEigenvalue(const StrainTaylor& t) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(second(t), Eigen::EigenvaluesOnly).eigenvalues()[0];
}

template <class F>
void forEachPlace(const std::array<std::vector<double>, 3>& places, F&& f) {
  for (double e11 : places[0])
    for (double e22 : places[1])
      for (double g12 : places[2]) f(std::array{e11, e22, g12});
}

}  // namespace

LawTable::LawTable(const LawTableData& data)
    : data_(data), membrane_(membraneOf(data_)), moment_(momentOf(data_)), rigidity_(rigidityOf(data_)) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::vector<double>& nodes = data_.membrane.nodes[i];
    const double low = data_.even_in_shear && i == 2 ? -nodes.back() : nodes.front();
    ends_[i][0].at = low;
    ends_[i][1].at = nodes.back();
    for (End& end : ends_[i]) end.margin = 0.25 * (nodes.back() - low);
  }
  settleMargins();
  settleEnds();
  settleSteepest();
  settleRows();
}

std::array<std::array<double, 2>, 3> LawTable::range() const {
  std::array<std::array<double, 2>, 3> out{};
  for (std::size_t i = 0; i < 3; ++i) out[i] = {ends_[i][0].at, ends_[i][1].at};
  return out;
}

LawTable::Continued LawTable::continued(const Ends& ends, double strain) {
  Continued c{strain};
  if (strain >= ends[0].at && strain <= ends[1].at) return c;
  const bool up = strain > ends[1].at;
  const End& end = ends[up ? 1 : 0];
  const double out = up ? 1 : -1, m = end.margin, d = out * (strain - end.at);
  const double a = std::exp(-d / m), gone = -std::expm1(-d / m), more = end.force - end.stiffness * m;
  c.at = end.at + out * m * gone;
  c.at1 = a;
  c.at2 = -out * a / m;
  c.energy = more * (d - m * gone) + 0.5 * end.stiffness * d * d;
  c.energy1 = out * (more * gone + end.stiffness * d);
  c.energy2 = more * a / m + end.stiffness;
  c.beyond = true;
  return c;
}

SheetAnswer LawTable::answer(const SheetStrain& point, SheetParts parts) const {
  std::array<Continued, 3> c;
  std::array<double, 3> at{};
  SheetAnswer out;
  for (std::size_t i = 0; i < 3; ++i) {
    c[i] = continued(ends_[i], point.strain[i]);
    at[i] = c[i].at;
    out.beyond |= c[i].beyond;
  }
  const bool slopes = parts == SheetParts::slopes;
  std::array<StrainTaylor, 1> W;
  std::array<StrainTaylor, 6> D;
  membrane_.evaluate(at, W, slopes);
  rigidity_.evaluate(at, D, slopes);

  // Of the splines: what the energy is of the strain at this curvature, and the moments' derivatives in the strain.
  const std::array<double, 3>& k = point.curvature;
  StrainTaylor all = W[0];
  std::array<std::array<double, 3>, 3> coupled{};
  if (!data_.moment.empty()) {
    std::array<StrainTaylor, 3> b;
    moment_.evaluate(at, b, slopes);
    for (std::size_t i = 0; i < 3; ++i) {
      out.moment[i] = b[i].value;
      coupled[i] = b[i].first;
      all.value += k[i] * b[i].value;
      for (std::size_t p = 0; p < 3; ++p) all.first[p] += k[i] * b[i].first[p];
      for (std::size_t p = 0; p < 6; ++p) all.second[p] += k[i] * b[i].second[p];
    }
  }
  for (std::size_t v = 0; v < 6; ++v) {
    const auto i = static_cast<std::size_t>(kPairs[v][0]), j = static_cast<std::size_t>(kPairs[v][1]);
    const double half = i == j ? 0.5 * k[i] * k[i] : k[i] * k[j];
    all.value += half * D[v].value;
    for (std::size_t p = 0; p < 3; ++p) all.first[p] += half * D[v].first[p];
    for (std::size_t p = 0; p < 6; ++p) all.second[p] += half * D[v].second[p];
    out.moment[i] += D[v].value * k[j];
    for (std::size_t p = 0; p < 3; ++p) coupled[i][p] += D[v].first[p] * k[j];
    if (i == j) continue;
    out.moment[j] += D[v].value * k[i];
    for (std::size_t p = 0; p < 3; ++p) coupled[j][p] += D[v].first[p] * k[i];
  }

  out.energy_J_per_m2 = all.value;
  for (std::size_t i = 0; i < 3; ++i) {
    out.energy_J_per_m2 += c[i].energy;
    out.resultant[i] = c[i].at1 * all.first[i] + c[i].energy1;
  }
  if (!slopes) return out;
  for (std::size_t v = 0; v < 6; ++v) {
    const auto i = static_cast<std::size_t>(kPairs[v][0]), j = static_cast<std::size_t>(kPairs[v][1]);
    double stiffness = c[i].at1 * c[j].at1 * all.second[v];
    if (i == j) stiffness += all.first[i] * c[i].at2 + c[i].energy2;
    out.slope[6 * i + j] = out.slope[6 * j + i] = stiffness;
    out.slope[6 * (3 + i) + 3 + j] = out.slope[6 * (3 + j) + 3 + i] = D[v].value;
  }
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t p = 0; p < 3; ++p)
      out.slope[6 * p + 3 + i] = out.slope[6 * (3 + i) + p] = c[p].at1 * coupled[i][p];
  return out;
}

void LawTable::evaluate(std::span<const SheetStrain> points, SheetParts parts, std::span<const double>,
                        std::span<double>, std::span<SheetAnswer> out) const {
  for (std::size_t i = 0; i < points.size(); ++i) out[i] = answer(points[i], parts);
}

std::vector<double> LawTable::places(int direction, std::initializer_list<double> margins) const {
  const auto i = static_cast<std::size_t>(direction);
  std::vector<double> out = data_.membrane.nodes[i];
  if (data_.even_in_shear && direction == 2)
    for (std::size_t k = data_.membrane.nodes[i].size(); k-- > 1;) out.push_back(-data_.membrane.nodes[i][k]);
  for (double margin : margins) {
    out.push_back(ends_[i][0].at - margin * ends_[i][0].margin);
    out.push_back(ends_[i][1].at + margin * ends_[i][1].margin);
  }
  return out;
}

void LawTable::settleMargins() {
  constexpr int kHalvings = 12;
  for (int halving = 0;; ++halving) {
    bool convex = true, lost = false;
    forEachPlace({places(0, {0.5, 1}), places(1, {0.5, 1}), places(2, {0.5, 1})}, [&](const std::array<double, 3>& E) {
      std::array<double, 3> inside{};
      for (std::size_t i = 0; i < 3; ++i) inside[i] = std::clamp(E[i], ends_[i][0].at, ends_[i][1].at);
      std::array<StrainTaylor, 1> W;
      membrane_.evaluate(E, W);
      if (leastEigenvalue(W[0]) >= 0) return;
      convex = false;
      if (inside == E) return;
      membrane_.evaluate(inside, W);
      lost |= leastEigenvalue(W[0]) >= 0;
    });
    convex_ = convex;
    if (!lost || halving == kHalvings) return;
    for (Ends& ends : ends_)
      for (End& end : ends) end.margin *= 0.5;
  }
}

void LawTable::settleEnds() {
  std::array<Ends, 3> found = ends_;
  for (int i = 0; i < 3; ++i)
    for (int side = 0; side < 2; ++side) {
      const auto direction = static_cast<std::size_t>(i);
      End& end = found[direction][static_cast<std::size_t>(side)];
      const double out = side == 0 ? -1 : 1;
      std::array<std::vector<double>, 3> at{places(0, {0.5, 1}), places(1, {0.5, 1}), places(2, {0.5, 1})};
      at[direction] = {end.at, end.at + 0.5 * out * end.margin, end.at + out * end.margin};
      forEachPlace(at, [&](const std::array<double, 3>& E) {
        std::array<StrainTaylor, 1> W;
        membrane_.evaluate(E, W);
        end.force = std::max(end.force, out * W[0].first[direction]);
        end.stiffness = std::max(end.stiffness, W[0].second[direction]);
      });
    }
  ends_ = found;
}

void LawTable::settleSteepest() {
  constexpr double kRounding = 1e-10;
  using Slopes = Eigen::Matrix<double, 6, 6>;
  std::vector<Slopes> slopes;
  forEachPlace({places(0, kBeyond), places(1, kBeyond), places(2, kBeyond)}, [&](const std::array<double, 3>& E) {
    slopes.emplace_back(answer({E, {}}, SheetParts::slopes).slope.data());
  });
  Eigen::Matrix<double, 6, 1> greatest = Eigen::Matrix<double, 6, 1>::Zero();
  for (const Slopes& s : slopes) greatest = greatest.cwiseMax(s.diagonal());
  double energy = 0;
  for (double w : data_.energy) energy = std::max(energy, std::abs(w));
  for (std::size_t i = 0; i < 3; ++i) {
    const double width = ends_[i][1].at - ends_[i][0].at;
    if (!(greatest[static_cast<long>(i)] > kRounding * energy / (width * width)))
      throw InputError({"", 0, "membrane.energy"}, "must be stiff somewhere in each direction of strain");
  }
  const Eigen::Matrix<double, 6, 1> unit = greatest.cwiseSqrt().cwiseInverse();
  double factor = 1;
  for (const Slopes& s : slopes) {
    const Slopes scaled = unit.asDiagonal() * s * unit.asDiagonal();
    factor = std::max(factor, Eigen::SelfAdjointEigenSolver<Slopes>(scaled, Eigen::EigenvaluesOnly).eigenvalues()[5]);
  }
  for (std::size_t i = 0; i < 6; ++i) steepest_[7 * i] = factor * greatest[static_cast<long>(i)];
}

void LawTable::settleRows() {
  std::array<double, 6> unit{};
  for (std::size_t i = 0; i < 6; ++i) unit[i] = 1 / std::sqrt(steepest_[7 * i]);
  for (std::size_t i = 0; i < 3; ++i) {
    std::vector<double>& at = looked_[i];
    at = data_.membrane.nodes[i];
    for (std::size_t k = 1; k < data_.membrane.nodes[i].size(); ++k)
      at.push_back(0.5 * (data_.membrane.nodes[i][k - 1] + data_.membrane.nodes[i][k]));
    for (const double margin : kBeyond) {
      if (!(data_.even_in_shear && i == 2)) at.push_back(ends_[i][0].at - margin * ends_[i][0].margin);
      at.push_back(ends_[i][1].at + margin * ends_[i][1].margin);
    }
    std::sort(at.begin(), at.end());
  }
  forEachPlace(looked_, [&](const std::array<double, 3>& E) {
    const SheetAnswer a = answer({E, {}}, SheetParts::slopes);
    std::array<double, 6>& sums = rows_.emplace_back();
    // The bound of all strains bounds their bending: of its rows only what couples it with strain is added to that.
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j)
        if (i < 3 || j < 3) sums[i] += std::abs(a.slope[6 * i + j]) * unit[j] / unit[i];
  });
}

std::array<double, 36> LawTable::steepest(const StrainBox& within) const {
  std::array<std::size_t, 3> first{}, end{};
  for (std::size_t i = 0; i < 3; ++i) {
    double low = within.low[i], high = within.high[i];
    if (data_.even_in_shear && i == 2) {
      const double far = std::max(std::abs(low), std::abs(high));
      low = low <= 0 && high >= 0 ? 0 : std::min(std::abs(low), std::abs(high)), high = far;
    }
    const std::vector<double>& at = looked_[i];
    if (!(low >= at.front() && high <= at.back())) return steepest_;
    first[i] = static_cast<std::size_t>(std::upper_bound(at.begin(), at.end(), low) - at.begin()) - 1;
    end[i] = static_cast<std::size_t>(std::lower_bound(at.begin(), at.end(), high) - at.begin()) + 1;
  }
  std::array<double, 6> most{};
  for (std::size_t a = first[0]; a < end[0]; ++a)
    for (std::size_t b = first[1]; b < end[1]; ++b)
      for (std::size_t c = first[2]; c < end[2]; ++c)
        for (std::size_t i = 0; i < 6; ++i)
          most[i] = std::max(most[i], rows_[(a * looked_[1].size() + b) * looked_[2].size() + c][i]);
  std::array<double, 36> out{};
  for (std::size_t i = 0; i < 6; ++i) {
    if (i < 3 && !(most[i] <= steepest_[7 * i])) return steepest_;
    out[7 * i] = i < 3 ? most[i] : steepest_[7 * i] + most[i];
  }
  return out;
}

}  // namespace gambeson
