#include <cmath>

#include "core/error.hpp"
#include "core/nurbs/nurbs.hpp"

namespace gambeson {
namespace {

[[noreturn]] void reject(const std::string& key, const std::string& reason) { throw InputError({"", 0, key}, reason); }

void validate(const KnotVector& k, const std::string& key) {
  const int p = k.degree, n = static_cast<int>(k.knots.size());
  if (p < 1) reject(key + ".degree", std::to_string(p) + ", must be at least 1");
  if (p > n || n < 2 * (p + 1))
    reject(key + ".knots",
           std::to_string(n) + " knots, at least 2 (degree + 1) are needed, degree " + std::to_string(p));
  for (int i = 0; i < n; ++i) {
    if (!std::isfinite(k.knots[i])) reject(key + ".knots[" + std::to_string(i) + "]", "must be finite");
    if (i > 0 && !(k.knots[i] >= k.knots[i - 1]))
      reject(key + ".knots[" + std::to_string(i) + "]", "below the knot before it; knots must not descend");
  }
  if (!(k.back() > k.front())) reject(key + ".knots", "no non-empty cell");
  // An inner knot of multiplicity degree + 1 would tear the surface; at the ends degree + 1 is allowed.
  for (int i = 0; i + p < n; ++i) {
    const bool inner = k.knots[i] > k.front() && k.knots[i] < k.back();
    const int most = inner ? p : p + 1;
    if (i + most < n && k.knots[i] == k.knots[i + most])
      reject(key + ".knots[" + std::to_string(i) + "]",
             "multiplicity above " + std::to_string(most) + (inner ? " (the degree)" : " (degree + 1)"));
  }
}

}  // namespace

void validate(const NurbsPatch& patch) {
  validate(patch.u, "u");
  validate(patch.v, "v");
  // In 64 bits: two vectors of 50,000 knots would overflow size().
  const long long n = static_cast<long long>(patch.u.count()) * patch.v.count();
  const auto expect = std::to_string(n) + " (" + std::to_string(patch.u.count()) + " x " +
                      std::to_string(patch.v.count()) + ") expected";
  if (static_cast<long long>(patch.points.size()) != n)
    reject("points", std::to_string(patch.points.size()) + " given, " + expect);
  if (static_cast<long long>(patch.weights.size()) != n)
    reject("weights", std::to_string(patch.weights.size()) + " given, " + expect);
  for (std::size_t i = 0; i < patch.points.size(); ++i) {
    for (int d = 0; d < 3; ++d)
      if (!std::isfinite(patch.points[i][d])) reject("points[" + std::to_string(i) + "]", "must be finite");
    if (!(patch.weights[i] > 0) || !std::isfinite(patch.weights[i]))
      reject("weights[" + std::to_string(i) + "]", "must be positive and finite");
  }
}

// R = a / W with a = w N M and W = sum a; each derivative from the product rule on R W = a (Zheng 2013, eq. 2.4, 2.5).
SurfaceBasis surfaceBasis(const NurbsPatch& patch, double u, double v) {
  const int p = patch.u.degree, q = patch.v.degree, n = (p + 1) * (q + 1);
  const int su = findSpan(patch.u, u), sv = findSpan(patch.v, v);
  std::vector<double> bu(3 * (p + 1)), bv(3 * (q + 1));
  basisDerivatives(patch.u, su, u, 2, bu);
  basisDerivatives(patch.v, sv, v, 2, bv);

  static constexpr int du[6] = {0, 1, 0, 2, 0, 1}, dv[6] = {0, 0, 1, 0, 2, 1};
  SurfaceBasis out;
  out.columns.resize(n);
  for (auto& values : out.values) values.resize(n);
  std::array<double, 6> W{};
  for (int j = 0; j <= q; ++j)
    for (int i = 0; i <= p; ++i) {
      const int k = i + (p + 1) * j, column = patch.index(su - p + i, sv - q + j);
      out.columns[k] = column;
      for (int d = 0; d < 6; ++d) {
        const double a = patch.weights[column] * bu[du[d] * (p + 1) + i] * bv[dv[d] * (q + 1) + j];
        out.values[d][k] = a;
        W[d] += a;
      }
    }
  auto& [r, ru, rv, ruu, rvv, ruv] = out.values;
  for (int k = 0; k < n; ++k) {
    r[k] = r[k] / W[0];
    ru[k] = (ru[k] - r[k] * W[1]) / W[0];
    rv[k] = (rv[k] - r[k] * W[2]) / W[0];
    ruu[k] = (ruu[k] - 2 * ru[k] * W[1] - r[k] * W[3]) / W[0];
    rvv[k] = (rvv[k] - 2 * rv[k] * W[2] - r[k] * W[4]) / W[0];
    ruv[k] = (ruv[k] - ru[k] * W[2] - rv[k] * W[1] - r[k] * W[5]) / W[0];
  }
  return out;
}

std::array<Vec3, 6> surfaceDerivatives(const NurbsPatch& patch, double u, double v) {
  const SurfaceBasis basis = surfaceBasis(patch, u, v);
  std::array<Vec3, 6> out{};
  for (int d = 0; d < 6; ++d)
    for (std::size_t k = 0; k < basis.columns.size(); ++k)
      out[d] += basis.values[d][k] * patch.points[basis.columns[k]];
  return out;
}

}  // namespace gambeson
