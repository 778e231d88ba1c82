#include "core/math/conjugate_gradients.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/parallel.hpp"

namespace gambeson {

BlockProduct::BlockProduct(const BlockMatrix& A) : offsets_(static_cast<std::size_t>(A.rows()) + 1, 0) {
  for (int r = 0; r < A.rows(); ++r)
    for (long k = A.offsets[r]; k < A.offsets[r + 1]; ++k) {
      ++offsets_[r + 1];
      if (A.columns[k] > r) ++offsets_[A.columns[k] + 1];
    }
  for (int r = 0; r < A.rows(); ++r) offsets_[r + 1] += offsets_[r];
  columns_.resize(offsets_.back());
  block_.resize(offsets_.back());
  std::vector<long> at(offsets_.begin(), offsets_.end() - 1);
  const auto put = [&](int row, int column, long block) {
    columns_[at[row]] = column;
    block_[at[row]++] = block;
  };
  for (int r = 0; r < A.rows(); ++r)
    for (long k = A.offsets[r]; k < A.offsets[r + 1]; ++k)
      if (A.columns[k] > r) put(A.columns[k], r, k);
  for (int r = 0; r < A.rows(); ++r)
    for (long k = A.offsets[r]; k < A.offsets[r + 1]; ++k) put(r, A.columns[k], k);
  used_.resize(A.rows());
  used_columns_.resize(columns_.size());
  values_.resize(12 * columns_.size());
}

void BlockProduct::set(const BlockMatrix& A) {
  forAll(Each::sum, A.rows(), [&](int r) {
    long to = offsets_[r];
    for (long k = offsets_[r]; k < offsets_[r + 1]; ++k) {
      const double* b = &A.values[9 * block_[k]];
      double size = 0;
      for (int i = 0; i < 9; ++i) size = std::max(size, std::abs(b[i]));
      if (size == 0) continue;
      double* out = &values_[12 * to];
      const bool transposed = columns_[k] < r;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) out[4 * j + i] = transposed ? b[3 * j + i] : b[3 * i + j];
      used_columns_[to++] = columns_[k];
    }
    used_[r] = static_cast<int>(to - offsets_[r]);
  });
}

namespace {

typedef double Column __attribute__((vector_size(32), aligned(8)));

/// The rows [first, end) of y = A x. Products of a row are rounded one by one, whatever the instructions.
[[gnu::always_inline]] inline void multiplyRows(int first, int end, const long* offsets, const int* used,
                                                const int* columns, const double* values, const Vec3* x, Vec3* y) {
  for (int r = first; r < end; ++r) {
    Column sum{};
    const double* b = values + 12 * offsets[r];
    const int* column = columns + offsets[r];
    for (int k = 0; k < used[r]; ++k, b += 12) {
      const Vec3& v = x[column[k]];
      const auto* of = reinterpret_cast<const Column*>(b);
      sum += of[0] * v.x + of[1] * v.y + of[2] * v.z;
    }
    y[r] = {sum[0], sum[1], sum[2]};
  }
}

using MultiplyRows = void (*)(int, int, const long*, const int*, const int*, const double*, const Vec3*, Vec3*);

void anyRows(int first, int end, const long* offsets, const int* used, const int* columns, const double* values,
             const Vec3* x, Vec3* y) {
  multiplyRows(first, end, offsets, used, columns, values, x, y);
}

#ifdef __x86_64__
[[gnu::target("avx2")]] void wideRows(int first, int end, const long* offsets, const int* used, const int* columns,
                                      const double* values, const Vec3* x, Vec3* y) {
  multiplyRows(first, end, offsets, used, columns, values, x, y);
}
MultiplyRows rowProducts() { return __builtin_cpu_supports("avx2") ? wideRows : anyRows; }
#else
MultiplyRows rowProducts() { return anyRows; }
#endif

}  // namespace

void BlockProduct::multiply(std::span<const Vec3> x, std::span<Vec3> y) const {
  constexpr int kRows = 256;
  static const MultiplyRows rows = rowProducts();
  const int n = static_cast<int>(used_.size()), chunks = (n + kRows - 1) / kRows;
  forAll(Each::much, chunks, [&](int c) {
    rows(c * kRows, std::min(n, (c + 1) * kRows), offsets_.data(), used_.data(), used_columns_.data(), values_.data(),
         x.data(), y.data());
  });
}

bool BlockInverses::set(std::span<const double> blocks) {
  const std::size_t n = blocks.size() / 9;
  values_.resize(6 * n);
  return countOf(Each::value, static_cast<int>(n), [&](int i) {
           const double* b = &blocks[9 * static_cast<std::size_t>(i)];
           const double a = b[0], d = b[4], f = b[8], p = b[1], q = b[2], s = b[5];
           const double xx = d * f - s * s, xy = q * s - p * f, xz = p * s - q * d;
           const double det = a * xx + p * xy + q * xz;
           double* out = &values_[6 * static_cast<std::size_t>(i)];
           out[0] = xx / det;
           out[1] = (a * f - q * q) / det;
           out[2] = (a * d - p * p) / det;
           out[3] = xy / det;
           out[4] = xz / det;
           out[5] = (p * q - a * s) / det;
           return !(a > 0 && a * d - p * p > 0 && det > 0);
         }) == 0;
}

void BlockInverses::multiply(std::span<const Vec3> x, std::span<Vec3> y) const {
  forAll(Each::value, static_cast<int>(x.size()), [&](int i) {
    const double* b = &values_[6 * static_cast<std::size_t>(i)];
    const Vec3 v = x[i];
    y[i] = {b[0] * v.x + b[3] * v.y + b[4] * v.z, b[3] * v.x + b[1] * v.y + b[5] * v.z,
            b[4] * v.x + b[5] * v.y + b[2] * v.z};
  });
}

namespace {

/// In blocks of a fixed length, whatever the threads.
double product(std::span<const Vec3> a, std::span<const Vec3> b, std::vector<double>& parts) {
  constexpr int kBlock = 512;
  const int n = static_cast<int>(a.size()), blocks = (n + kBlock - 1) / kBlock;
  parts.resize(static_cast<std::size_t>(blocks));
  forAll(Each::element, blocks, [&](int k) {
    double sum = 0;
    for (int i = k * kBlock; i < std::min(n, (k + 1) * kBlock); ++i) sum += dot(a[i], b[i]);
    parts[static_cast<std::size_t>(k)] = sum;
  });
  double sum = 0;
  for (double part : parts) sum += part;
  return sum;
}

}  // namespace

CgReport solveCg(const ConjugateGradients& s, std::span<const Vec3> b, double tolerance, int most, std::span<Vec3> x,
                 CgWork& w) {
  const int n = static_cast<int>(b.size());
  for (std::vector<Vec3>* v : {&w.r, &w.z, &w.p, &w.Ap}) v->resize(b.size());
  const auto precondition = [&] {
    s.precondition(w.r, w.z);
    if (s.filter) s.filter(w.z);
  };
  CgReport report;
  // The size of what is asked for.
  std::copy(b.begin(), b.end(), w.r.begin());
  if (s.forces) s.forces(w.r);
  precondition();
  const double size2 = product(w.r, w.z, w.parts);
  if (size2 == 0) std::fill(x.begin(), x.end(), Vec3{});
  if (!(size2 > 0)) {
    report.converged = size2 == 0;
    return report;
  }
  s.multiply(x, w.Ap);
  for (int i = 0; i < n; ++i) w.r[i] = b[i] - w.Ap[i];
  if (s.forces) s.forces(w.r);
  precondition();
  double left2 = product(w.r, w.z, w.parts);
  std::copy(w.z.begin(), w.z.end(), w.p.begin());
  for (;;) {
    report.residual = std::sqrt(left2 / size2);
    report.converged = report.residual <= tolerance;
    if (report.converged || report.iterations == most || !std::isfinite(left2)) return report;
    s.multiply(w.p, w.Ap);
    const double curvature = product(w.p, w.Ap, w.parts);
    report.positive = curvature > 0;
    if (!report.positive) return report;
    const double alpha = left2 / curvature;
    forAll(Each::value, n, [&](int i) {
      x[i] += alpha * w.p[i];
      w.r[i] -= alpha * w.Ap[i];
    });
    if (s.forces) s.forces(w.r);
    precondition();
    const double now2 = product(w.r, w.z, w.parts), beta = now2 / left2;
    forAll(Each::value, n, [&](int i) { w.p[i] = w.z[i] + beta * w.p[i]; });
    left2 = now2;
    ++report.iterations;
  }
}

}  // namespace gambeson
