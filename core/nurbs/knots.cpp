#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/error.hpp"
#include "core/nurbs/nurbs.hpp"

namespace gambeson {

KnotVector uniformKnots(int degree, int cells) {
  if (degree < 1) throw InputError({"", 0, "degree"}, std::to_string(degree) + ", must be at least 1");
  if (cells < 1) throw InputError({"", 0, "cells"}, std::to_string(cells) + ", must be at least 1");
  KnotVector k{degree, {}};
  k.knots.assign(degree, 0.0);
  for (int i = 0; i <= cells; ++i) k.knots.push_back(static_cast<double>(i) / cells);
  k.knots.insert(k.knots.end(), degree, 1.0);
  return k;
}

std::vector<double> breakpoints(const KnotVector& k) {
  std::vector<double> out(k.knots.begin() + k.degree, k.knots.end() - k.degree);
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

std::vector<double> grevillePoints(const KnotVector& k) {
  std::vector<double> out(k.count());
  for (int i = 0; i < k.count(); ++i) {
    double sum = 0;
    for (int j = 1; j <= k.degree; ++j) sum += k.knots[i + j];
    out[i] = std::clamp(sum / k.degree, k.front(), k.back());
  }
  return out;
}

int findSpan(const KnotVector& k, double u) {
  assert(!std::isnan(u));
  // upper_bound leaves the last knot that is <= u; beyond the ends the end cells are continued.
  const auto first = k.knots.begin() + k.degree, last = k.knots.end() - k.degree;
  if (u >= k.back())  // the last non-empty cell
    return static_cast<int>(std::lower_bound(first, last, k.back()) - k.knots.begin()) - 1;
  u = std::max(u, k.front());
  return static_cast<int>(std::upper_bound(first, last, u) - k.knots.begin()) - 1;
}

// Piegl and Tiller, algorithm A2.3. `ndu` holds the functions of all lower degrees in its upper triangle and the knot
// differences in its lower one; the derivatives follow from eq. 2.9 and 2.10 with the coefficients a_{k,j} in two rows.
void basisDerivatives(const KnotVector& k, int span, double u, int order, std::span<double> out) {
  const int p = k.degree, w = p + 1;
  assert(span >= p && span + 1 < static_cast<int>(k.knots.size()) - p && k.knots[span] < k.knots[span + 1]);
  assert(out.size() >= static_cast<std::size_t>((order + 1) * w));
  std::vector<double> work(static_cast<std::size_t>(w) * w + 4 * w);
  double* ndu = work.data();
  double *left = ndu + w * w, *right = left + w, *previous = right + w, *current = previous + w;
  const double* U = k.knots.data();

  ndu[0] = 1;
  for (int j = 1; j <= p; ++j) {
    left[j] = u - U[span + 1 - j];
    right[j] = U[span + j] - u;
    double saved = 0;
    for (int r = 0; r < j; ++r) {
      ndu[j * w + r] = U[span + r + 1] - U[span + 1 - (j - r)];
      const double t = ndu[r * w + j - 1] / ndu[j * w + r];
      ndu[r * w + j] = saved + right[r + 1] * t;
      saved = left[j - r] * t;
    }
    ndu[j * w + j] = saved;
  }
  std::fill(out.begin(), out.begin() + (order + 1) * w, 0.0);
  for (int r = 0; r <= p; ++r) out[r] = ndu[r * w + p];

  for (int r = 0; r <= p; ++r) {
    previous[0] = 1;
    double factor = 1;
    for (int d = 1; d <= std::min(order, p); ++d) {
      const int q = p - d;  // degree of the functions that remain
      factor *= q + 1;
      double sum = 0;
      // a_{d,j} = (a_{d-1,j} - a_{d-1,j-1}) / (knot difference), a_{d-1,-1} = a_{d-1,d} = 0; the function r - d + j of
      // degree q exists for 0 <= r - d + j <= q only, and the coefficients of the others are never asked for.
      for (int j = 0; j <= d; ++j) {
        const int i = r - d + j;
        if (i < 0 || i > q) {
          current[j] = 0;
          continue;
        }
        const double upper = j < d ? previous[j] : 0, lower = j > 0 ? previous[j - 1] : 0;
        current[j] = (upper - lower) / ndu[(q + 1) * w + i];
        sum += current[j] * ndu[i * w + q];
      }
      out[d * w + r] = factor * sum;
      std::swap(previous, current);
    }
  }
}

}  // namespace gambeson
