#include "core/contact/orientation.hpp"

#include <cassert>
#include <cmath>
#include <cstdint>
#include <utility>

namespace gambeson {
namespace {

/// Exact sum of doubles: parts that do not overlap, in increasing size (Shewchuk 1997, GROW-EXPANSION).
class Expansion {
 public:
  void add(double b) {
    int kept = 0;
    double carry = b;
    for (int i = 0; i < size_; ++i) {
      const double sum = carry + part_[i], virt = sum - carry;
      const double rest = (carry - (sum - virt)) + (part_[i] - virt);
      if (rest != 0) part_[kept++] = rest;
      carry = sum;
    }
    if (carry != 0) part_[kept++] = carry;
    size_ = kept;
  }
  /// Adds a b c, which has at most four parts.
  void addProduct(double a, double b, double c) {
    const double p = a * b;
    if (p == 0 || c == 0) return;
    addProduct(p, c);
    const double rest = std::fma(a, b, -p);
    if (rest != 0) addProduct(rest, c);
  }
  int sign() const { return size_ == 0 ? 0 : part_[size_ - 1] > 0 ? 1 : -1; }

 private:
  void addProduct(double a, double b) {
    const double p = a * b;
    add(std::fma(a, b, -p));
    add(p);
  }
  std::array<double, 24 * 4> part_;  // 24 permutations, four parts each
  int size_ = 0;
};

struct Permutation {
  std::array<int, 4> to;
  bool odd;
};

constexpr std::array<Permutation, 24> kPermutations = [] {
  std::array<Permutation, 24> all{};
  int n = 0;
  for (int code = 0; code < 256; ++code) {
    const std::array<int, 4> to{code & 3, code >> 2 & 3, code >> 4 & 3, code >> 6 & 3};
    int inversions = 0;
    bool different = true;
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j) {
        different = different && to[i] != to[j];
        inversions += to[i] > to[j];
      }
    if (different) all[n++] = {to, inversions % 2 != 0};
  }
  return all;
}();

/// A product of perturbations as bits: bit 3 row + 2 - column. The smaller the number, the larger the product. At most
/// one in each row and column occurs in a determinant; 84 is the first with three, whose coefficient is the constant 1.
constexpr int kLastProduct = 84;
constexpr std::array<std::array<int, 3>, kLastProduct + 1> columnsOfProducts() {
  std::array<std::array<int, 3>, kLastProduct + 1> columns{};
  for (int product = 0; product <= kLastProduct; ++product) {
    unsigned used = 0;
    bool possible = true;
    for (int row = 0; row < 3; ++row) {
      columns[product][row] = -1;
      for (int column = 0; column < 3; ++column) {
        if (!(product >> (3 * row + 2 - column) & 1)) continue;
        possible = possible && columns[product][row] < 0 && !(used >> column & 1);
        columns[product][row] = column;
        used |= 1u << column;
      }
    }
    if (!possible) columns[product][0] = -2;  // occurs in no determinant
  }
  return columns;
}
constexpr auto kProducts = columnsOfProducts();

/// Sign of det [p_i 1] of the moved points: the coefficients of the products of perturbations, largest product first,
/// from `first` on.
int perturbedSign(const std::array<const Vec3*, 4>& p, int first) {
  for (int product = first; product <= kLastProduct; ++product) {
    const auto& moved = kProducts[product];
    if (moved[0] == -2) continue;
    std::array<std::array<double, 3>, 24> terms;
    int count = 0;
    double sum = 0, size = 0;
    for (const auto& [to, odd] : kPermutations) {
      std::array<double, 3> factor{1, 1, 1};
      int factors = 0;
      bool occurs = true;
      for (int row = 0; row < 4 && occurs; ++row) {
        if (row < 3 && moved[row] >= 0)
          occurs = to[row] == moved[row];
        else if (to[row] != 3)
          factor[factors++] = (*p[row])[to[row]];  // a permutation has only three rows with a column below 3
      }
      if (!occurs || factor[0] == 0 || factor[1] == 0 || factor[2] == 0) continue;
      if (odd) factor[0] = -factor[0];
      const double term = factor[0] * factor[1] * factor[2];
      sum += term;
      size += std::abs(term);
      terms[count++] = factor;
    }
    // At most 25 roundings of u = 2^-53 each in a term and in the sums it enters.
    if (std::abs(sum) > 0x1p-48 * size) return sum > 0 ? 1 : -1;
    Expansion coefficient;
    for (int k = 0; k < count; ++k) coefficient.addProduct(terms[k][0], terms[k][1], terms[k][2]);
    if (const int sign = coefficient.sign()) return sign;
  }
  assert(false);
  return 1;
}

/// Is a - b free of rounding?
bool exactDifference(double a, double b) {
  const double d = a - b, virt = a - d;
  return (a - (d + virt)) + (virt - b) == 0;
}

bool exactDifference(const Vec3& a, const Vec3& b) {
  return exactDifference(a.x, b.x) && exactDifference(a.y, b.y) && exactDifference(a.z, b.z);
}

}  // namespace

int orientation(std::span<const Vec3> x, const std::array<int, 4>& vertices) {
  const auto& [a, b, c, d] = vertices;
  const Vec3 p = x[a] - x[d], q = x[b] - x[d], r = x[c] - x[d];
  const double qr = q.y * r.z, rq = q.z * r.y, rp = r.y * p.z, pr = r.z * p.y, pq = p.y * q.z, qp = p.z * q.y;
  const double det = p.x * (qr - rq) + q.x * (rp - pr) + r.x * (pq - qp);
  const double size = std::abs(p.x) * (std::abs(qr) + std::abs(rq)) + std::abs(q.x) * (std::abs(rp) + std::abs(pr)) +
                      std::abs(r.x) * (std::abs(pq) + std::abs(qp));
  // Shewchuk 1997, orient3d, bound A: (7 + 56 u) u, u = 2^-53.
  constexpr double u = 0x1p-53, bound = (7 + 56 * u) * u;
  if (det > bound * size) return -1;  // det = (a - d) . ((b - d) x (c - d)) is positive below the plane
  if (-det > bound * size) return 1;

  // Without rounding in p, q and r the determinant has 6 terms instead of 24.
  int first = 0;
  if (exactDifference(x[a], x[d]) && exactDifference(x[b], x[d]) && exactDifference(x[c], x[d])) {
    Expansion exact;
    exact.addProduct(p.x, q.y, r.z);
    exact.addProduct(-p.x, q.z, r.y);
    exact.addProduct(q.x, r.y, p.z);
    exact.addProduct(-q.x, r.z, p.y);
    exact.addProduct(r.x, p.y, q.z);
    exact.addProduct(-r.x, p.z, q.y);
    if (const int sign = exact.sign()) return -sign;
    first = 1;
  }

  std::array<int, 4> order = vertices;
  bool odd = false;
  for (int i = 1; i < 4; ++i)
    for (int j = i; j > 0 && order[j] < order[j - 1]; --j) {
      std::swap(order[j], order[j - 1]);
      odd = !odd;
    }
  assert(order[0] < order[1] && order[1] < order[2] && order[2] < order[3]);
  const int sign = perturbedSign({&x[order[0]], &x[order[1]], &x[order[2]], &x[order[3]]}, first);
  return odd ? sign : -sign;
}

}  // namespace gambeson
