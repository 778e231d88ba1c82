#include "core/cloth/constraint.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/error.hpp"

namespace gambeson {
namespace {

/// Coefficients below this part of an equation's largest are rounding of the elimination.
constexpr double kRounding = 1e-11;

using Terms = std::vector<std::pair<int, double>>;  ///< component, coefficient; ascending components

/// u_pivot = sum coefficient u_component + sum rhs_k s_k
struct Row {
  int pivot = -1;
  Terms terms;
  std::vector<std::pair<int, double>> rhs;  ///< program, metres
};

/// a += factor b for sorted lists; scratch in `out`.
void addScaled(Terms& a, double factor, const Terms& b, Terms& out) {
  out.clear();
  std::size_t i = 0, j = 0;
  while (i < a.size() || j < b.size()) {
    if (j == b.size() || (i < a.size() && a[i].first < b[j].first)) {
      out.push_back(a[i++]);
    } else if (i == a.size() || b[j].first < a[i].first) {
      out.emplace_back(b[j].first, factor * b[j].second);
      ++j;
    } else {
      out.emplace_back(a[i].first, a[i].second + factor * b[j].second);
      ++i, ++j;
    }
  }
  a.swap(out);
}

double largest(const Terms& terms) {
  double most = 0;
  for (const auto& t : terms) most = std::max(most, std::abs(t.second));
  return most;
}

void dropBelow(Terms& terms, double size) {
  std::erase_if(terms, [&](const auto& t) { return !(std::abs(t.second) > size); });
}

/// The equation on the components of the free points and, behind them, the inner unknowns.
Terms onFreePoints(const FreeMap& map, const LinearConstraint& c, int inner_count) {
  Terms terms;
  for (const auto& [control, coefficient] : c.terms) {
    if (control < 0 || control >= map.T.rows())
      throw InputError({"", 0, c.name}, "control point " + std::to_string(control) + " does not exist");
    for (int k = map.T.offsets[control]; k < map.T.offsets[control + 1]; ++k)
      for (int d = 0; d < 3; ++d)
        if (coefficient[d] != 0) terms.emplace_back(3 * map.T.columns[k] + d, map.T.values[k] * coefficient[d]);
  }
  for (const auto& [inner, coefficient] : c.inner) {
    if (inner < 0 || inner >= inner_count)
      throw InputError({"", 0, c.name}, "inner unknown " + std::to_string(inner) + " does not exist");
    terms.emplace_back(3 * map.T.column_count + inner, coefficient);
  }
  std::stable_sort(terms.begin(), terms.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  Terms merged;
  for (const auto& t : terms)
    if (!merged.empty() && merged.back().first == t.first)
      merged.back().second += t.second;
    else
      merged.push_back(t);
  return merged;
}

}  // namespace

DofMap buildDofMap(const FreeMap& map, std::span<const LinearConstraint> constraints, int programs,
                   std::span<const double> inner_length_m) {
  const int of_points = 3 * map.T.column_count, inner_count = static_cast<int>(inner_length_m.size()),
            n = of_points + (inner_count + 2) / 3 * 3;
  std::vector<Row> rows;
  std::vector<int> row_of(n, -1);         // of a pivot component
  std::vector<std::vector<int>> used(n);  // rows whose terms may hold a component
  Terms scratch;
  for (const LinearConstraint& c : constraints) {
    Row row;
    row.terms = onFreePoints(map, c, inner_count);
    const double size = largest(row.terms);
    double scale = std::abs(c.amount_m);  // of the right-hand sides that meet here
    if (!std::isfinite(scale) ||
        !std::all_of(row.terms.begin(), row.terms.end(), [](const auto& t) { return std::isfinite(t.second); }))
      throw InputError({"", 0, c.name}, "is not finite");
    if (c.amount_m != 0) {
      if (c.program < 0 || c.program >= programs)
        throw InputError({"", 0, c.name}, "program " + std::to_string(c.program) + " does not exist");
      row.rhs.emplace_back(c.program, c.amount_m);
    }
    // Substitute what earlier equations fix. Their rows hold no pivots, so one pass is enough.
    Terms fixed;
    for (const auto& t : row.terms)
      if (row_of[t.first] >= 0) fixed.push_back(t);
    std::erase_if(row.terms, [&](const auto& t) { return row_of[t.first] >= 0; });
    for (const auto& [component, coefficient] : fixed) {
      const Row& other = rows[row_of[component]];
      addScaled(row.terms, coefficient, other.terms, scratch);
      for (const auto& r : other.rhs) scale = std::max(scale, std::abs(coefficient * r.second));
      Terms minus = other.rhs;
      addScaled(row.rhs, -coefficient, minus, scratch);
    }
    dropBelow(row.terms, kRounding * size);
    if (row.terms.empty()) {
      for (const auto& r : row.rhs)
        if (std::abs(r.second) > 1e-9 * scale)
          throw InputError({"", 0, c.name}, "contradicts the supports before it: it asks for " +
                                                std::to_string(r.second) + " m of a motion that they already fix");
      continue;
    }
    dropBelow(row.rhs, 1e-14 * scale);
    // The largest coefficient; the last of equals, so that chains of ties hang on their first point.
    auto pivot = row.terms.begin();
    const double most = largest(row.terms);
    for (auto it = row.terms.begin(); it != row.terms.end(); ++it)
      if (std::abs(it->second) > (1 - 1e-9) * most) pivot = it;
    if (row.terms.back().first >= of_points) pivot = row.terms.end() - 1;
    row.pivot = pivot->first;
    const double inverse = 1 / pivot->second;
    row.terms.erase(pivot);
    for (auto& t : row.terms) t.second *= -inverse;
    for (auto& r : row.rhs) r.second *= inverse;
    // Earlier rows must not hold the new pivot.
    for (int k : used[row.pivot]) {
      Row& earlier = rows[k];
      const auto it = std::lower_bound(earlier.terms.begin(), earlier.terms.end(), row.pivot,
                                       [](const auto& t, int component) { return t.first < component; });
      if (it == earlier.terms.end() || it->first != row.pivot) continue;
      const double coefficient = it->second;
      earlier.terms.erase(it);
      addScaled(earlier.terms, coefficient, row.terms, scratch);
      dropBelow(earlier.terms, kRounding);
      addScaled(earlier.rhs, coefficient, row.rhs, scratch);
      for (const auto& t : row.terms) used[t.first].push_back(k);
    }
    used[row.pivot].clear();
    const int index = static_cast<int>(rows.size());
    row_of[row.pivot] = index;
    for (const auto& t : row.terms) used[t.first].push_back(index);
    rows.push_back(std::move(row));
  }

  DofMap dofs;
  std::vector<int> unknown(n, -1);
  int count = 0;
  for (int i = 0; i < of_points + inner_count; ++i)
    if (row_of[i] < 0) {
      unknown[i] = count++;
      dofs.component.push_back(i);
    }
  dofs.C.column_count = count;
  dofs.shift.resize(programs);
  dofs.points = map.T.column_count;
  dofs.inner_length_m.assign(inner_length_m.begin(), inner_length_m.end());
  const auto perUnknown = [&](int component) {
    return component < of_points ? 1.0 : 1 / inner_length_m[static_cast<std::size_t>(component - of_points)];
  };
  for (int i = 0; i < n; ++i) {
    if (i >= of_points + inner_count) {  // fills a block up
    } else if (row_of[i] < 0) {
      dofs.C.add(unknown[i], perUnknown(i));
    } else {
      const Row& row = rows[row_of[i]];
      for (const auto& [component, coefficient] : row.terms)
        dofs.C.add(unknown[component], coefficient * perUnknown(component));
      for (const auto& [program, metres] : row.rhs) {
        auto& shift = dofs.shift[program];
        if (shift.empty()) shift.assign(n, 0.0);
        shift[i] = metres;
      }
    }
    dofs.C.endRow();
  }
  dofs.Ct = transpose(dofs.C);
  return dofs;
}

DofMap pointsOf(const DofMap& dofs) {
  DofMap of;
  of.points = dofs.points;
  const int rows = 3 * dofs.points;
  for (const int component : dofs.component)
    if (component < rows) of.component.push_back(component);
  of.C.column_count = static_cast<int>(of.component.size());
  for (int r = 0; r < rows; ++r) {
    for (int k = dofs.C.offsets[r]; k < dofs.C.offsets[r + 1]; ++k) {
      assert(dofs.C.columns[k] < of.C.column_count);
      of.C.add(dofs.C.columns[k], dofs.C.values[k]);
    }
    of.C.endRow();
  }
  of.Ct = transpose(of.C);
  for (const std::vector<double>& shift : dofs.shift)
    of.shift.emplace_back(shift.begin(), shift.empty() ? shift.end() : shift.begin() + rows);
  return of;
}

}  // namespace gambeson
