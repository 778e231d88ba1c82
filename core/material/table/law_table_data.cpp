#include "core/material/table/law_table_data.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.hpp"

namespace gambeson {
namespace {

constexpr const char* kDirections[3] = {"e11", "e22", "g12"};

[[noreturn]] void reject(const std::string& key, const std::string& reason) { throw InputError({"", 0, key}, reason); }

void checkNodes(const std::vector<double>& nodes, const std::string& key, bool extension, std::size_t least) {
  if (nodes.size() < least) reject(key, "has too few nodes; allowed: at least " + std::to_string(least));
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (!std::isfinite(nodes[k])) reject(key, "must be finite");
    if (extension && !(nodes[k] > -0.5)) reject(key, "is the strain of no plane; allowed: > -1/2");
    if (k > 0 && !(nodes[k] > nodes[k - 1])) reject(key, "must ascend strictly");
  }
}

template <std::size_t kParts>
void checkValues(const std::vector<std::array<double, kParts>>& values, const StrainGrid& grid, const char* key) {
  if (values.size() != grid.count())
    reject(key, "has values at " + std::to_string(values.size()) + " nodes; allowed: " + std::to_string(grid.count()) +
                    ", all nodes of the grid");
  for (const auto& at : values)
    for (double v : at)
      if (!std::isfinite(v)) reject(key, "must be finite");
}

bool isPositive(const std::array<double, 6>& D) {
  const double second = D[0] * D[1] - D[3] * D[3];
  return D[0] > 0 && second > 0 && D[2] * second + 2 * D[3] * D[4] * D[5] - D[0] * D[5] * D[5] - D[1] * D[4] * D[4] > 0;
}

}  // namespace

void checkLawTable(const LawTableData& data) {
  const auto& nodes = data.membrane.nodes;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string key = std::string("membrane.") + kDirections[i];
    const bool even = data.even_in_shear && i == 2;
    checkNodes(nodes[i], key, i < 2, even ? 2 : 3);
    if (even ? nodes[i].front() != 0 : !(nodes[i].front() <= 0 && nodes[i].back() > 0))
      reject(key, even ? "starts at 0 where the law is even in shear" : "must have the strain 0 in its range, and not at its end");
  }
  if (data.energy.size() != data.membrane.count())
    reject("membrane.energy", "has " + std::to_string(data.energy.size()) +
                                  " values; allowed: " + std::to_string(data.membrane.count()) + ", one for each node");
  if (!std::all_of(data.energy.begin(), data.energy.end(), [](double v) { return std::isfinite(v); }))
    reject("membrane.energy", "must be finite");

  const auto& bends = data.bending.nodes;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string key = std::string("bending.") + kDirections[i];
    checkNodes(bends[i], key, i < 2, 1);
    if (bends[i].size() > 1 && (bends[i].front() != nodes[i].front() || bends[i].back() != nodes[i].back()))
      reject(key, "has one node or the ends of the membrane's");
  }
  checkValues(data.rigidity, data.bending, "bending.rigidity");
  if (!std::all_of(data.rigidity.begin(), data.rigidity.end(), isPositive))
    reject("bending.rigidity", "must be positive definite");
  if (!data.moment.empty()) checkValues(data.moment, data.bending, "bending.moment");
  if (!data.even_in_shear || bends[2].size() > 1) return;
  for (const auto& D : data.rigidity)
    if (D[4] != 0 || D[5] != 0) reject("bending.rigidity", "D13 and D23 are odd in shear: with one node they are 0");
  for (const auto& b : data.moment)
    if (b[2] != 0) reject("bending.moment", "b3 is odd in shear: with one node it is 0");
}

}  // namespace gambeson
