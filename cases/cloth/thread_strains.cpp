#include "cases/cloth/thread_strains.hpp"

#include <algorithm>
#include <cmath>

namespace gambeson {
namespace {

const char* const places[] = {"vertex", "gauss"};
const char* const threads[] = {"weft", "warp"};

/// Over the points of one place.
struct Sum {
  double most[2] = {-0.5, -0.5}, absolute[2] = {0, 0};  // -1/2: nothing is shorter
  int count = 0;

  void add(double weft, double warp) {
    const double E[] = {weft, warp};
    for (int k = 0; k < 2; ++k) {
      if (!(E[k] <= most[k])) most[k] = E[k];  // NaN shows
      absolute[k] += std::abs(E[k]);
    }
    ++count;
  }
};

}  // namespace

ThreadStrains::ThreadStrains(const Cloth& cloth)
    : cloth_(cloth),
      rows_(cloth.strainRows({std::vector<double>(cloth.map().home.size(), 1.0), {}})),
      gauss_(cloth.lawPlaces()) {}

const std::vector<std::string>& ThreadStrains::columns() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const char* place : places)
      for (const char* thread : threads)
        for (const char* what : {"max", "mean"}) all.push_back(std::string(place) + "_" + thread + "_" + what);
    return all;
  }();
  return names;
}

std::vector<double> ThreadStrains::values(const std::vector<Vec3>& q) const {
  std::vector<Vec3> p(cloth_.map().home.size()), e;
  for (std::size_t k = 0; k < p.size(); ++k) p[k] = q[static_cast<std::size_t>(cloth_.map().home[k])];
  strainVectors(rows_, p, e);
  Sum vertex, gauss;
  for (const StrainPoint& point : rows_.points)
    vertex.add(strainOf(e[static_cast<std::size_t>(point.row[0])]),
               strainOf(e[static_cast<std::size_t>(point.row[1])]));
  for (const auto& [patch, uv] : gauss_) {
    const Vec3 strain = cloth_.stateAt(q, patch, uv).strain;
    gauss.add(strain.x, strain.y);
  }
  std::vector<double> row;
  for (const Sum* sum : {&vertex, &gauss})
    for (int k = 0; k < 2; ++k) row.insert(row.end(), {sum->most[k], sum->absolute[k] / std::max(1, sum->count)});
  return row;
}

nlohmann::ordered_json threadStrainSummary(const std::vector<std::vector<double>>& rows, std::size_t first) {
  nlohmann::ordered_json j;
  std::size_t at = first;
  for (const char* place : places)
    for (const char* thread : threads) {
      double most = -0.5;
      for (const auto& row : rows) most = std::max(most, row[at]);
      j[place][thread] = {{"largest", most}, {"mean", rows.back()[at + 1]}};
      at += 2;
    }
  return j;
}

}  // namespace gambeson
