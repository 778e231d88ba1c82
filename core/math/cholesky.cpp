#include "core/math/cholesky.hpp"

#include <cholmod.h>
#include <omp.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace gambeson {
namespace {

/// A pivot below this part of its diagonal entry is rounding: elimination subtracts terms of the diagonal's size.
constexpr double kSingularPivot = 1e-14;

/// Keeps CHOLMOD on the caller's thread. SuiteSparse 5 fixes its loops over small blocks at four threads
/// (CHOLMOD_OMP_NUM_THREADS) whatever OMP_NUM_THREADS says; on two cores these cost three times the factorisation.
class OneThread {
 public:
  OneThread() { omp_set_max_active_levels(0); }
  ~OneThread() { omp_set_max_active_levels(before_); }
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

 private:
  const int before_ = omp_get_max_active_levels();
};

}  // namespace

struct SymmetricFactor::Implementation {
  cholmod_common common{};
  SymmetricMatrix matrix;                 ///< the last one factorised, for the refinement
  cholmod_factor* supernodal = nullptr;   ///< L Lᵀ
  cholmod_factor* simplicial = nullptr;   ///< L D Lᵀ, analysed when first needed, with the same ordering
  const cholmod_factor* valid = nullptr;  ///< of the two, the one that holds the last factorisation
  int negative = 0;
  int weakest = 0;
  double weakest_ratio = 0;
  double smallest = 0;
  std::vector<int> wanted;   ///< unknowns
  std::vector<int> place;    ///< of each wanted unknown in the factor's order
  std::vector<int> reached;  ///< supernodes, ascending
  std::vector<double> y, below;

  Implementation() {
    cholmod_start(&common);
    common.print = 0;
    common.error_handler = nullptr;
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_AMD;
    common.postorder = 1;
    common.quick_return_if_not_posdef = 1;
  }
  ~Implementation() {
    cholmod_free_factor(&supernodal, &common);
    cholmod_free_factor(&simplicial, &common);
    cholmod_finish(&common);
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  cholmod_sparse view() {
    cholmod_sparse a{};
    a.nrow = a.ncol = static_cast<std::size_t>(matrix.size);
    a.nzmax = matrix.rows.size();
    a.p = matrix.offsets.data();
    a.i = matrix.rows.data();
    a.x = matrix.values.data();
    a.stype = -1;
    a.itype = CHOLMOD_INT;
    a.xtype = CHOLMOD_REAL;
    a.dtype = CHOLMOD_DOUBLE;
    a.sorted = 1;
    a.packed = 1;
    return a;
  }

  void check(const char* what) const {
    if (common.status == CHOLMOD_OUT_OF_MEMORY) throw RunError(std::string(what) + ": out of memory");
    if (common.status == CHOLMOD_TOO_LARGE) throw RunError(std::string(what) + ": the matrix is too large");
    if (common.status < CHOLMOD_OK) throw RunError(std::string(what) + " failed");
  }

  /// Looks at the pivot of the unknown `at`.
  void pivot(int at, double value, double diagonal) {
    if (value < 0) ++negative;
    smallest = std::min(smallest, std::abs(value));
    const double ratio = diagonal != 0 ? std::abs(value / diagonal) : 0.0;
    if (!(ratio >= weakest_ratio)) weakest_ratio = std::isnan(ratio) ? 0.0 : ratio, weakest = at;
  }

  double diagonal(int column) const { return matrix.values[matrix.offsets[column]]; }

  void scanSupernodal() {
    const auto* super = static_cast<const int*>(supernodal->super);
    const auto* pi = static_cast<const int*>(supernodal->pi);
    const auto* px = static_cast<const int*>(supernodal->px);
    const auto* perm = static_cast<const int*>(supernodal->Perm);
    const auto* x = static_cast<const double*>(supernodal->x);
    for (std::size_t s = 0; s < supernodal->nsuper; ++s)
      for (int j = super[s]; j < super[s + 1]; ++j) {
        const long local = j - super[s], rows = pi[s + 1] - pi[s];
        const double l = x[px[s] + local * (rows + 1)];
        pivot(perm[j], l * l, diagonal(perm[j]));
      }
  }

  void scanSimplicial() {
    const auto* p = static_cast<const int*>(simplicial->p);
    const auto* perm = static_cast<const int*>(simplicial->Perm);
    const auto* x = static_cast<const double*>(simplicial->x);
    for (std::size_t j = 0; j < simplicial->n; ++j) pivot(perm[j], x[p[j]], diagonal(perm[j]));
  }

  /// The supernodes on the ways from the wanted unknowns to the root of the elimination tree.
  void reach() {
    const auto* super = static_cast<const int*>(supernodal->super);
    const auto* pi = static_cast<const int*>(supernodal->pi);
    const auto* rows = static_cast<const int*>(supernodal->s);
    const auto* perm = static_cast<const int*>(supernodal->Perm);
    const int count = static_cast<int>(supernodal->nsuper), n = static_cast<int>(supernodal->n);
    std::vector<int> place_of(n), node_of(n);
    for (int s = 0; s < count; ++s)
      for (int j = super[s]; j < super[s + 1]; ++j) place_of[perm[j]] = j, node_of[j] = s;
    place.clear();
    std::vector<char> marked(count, 0);
    for (const int unknown : wanted) {
      place.push_back(place_of[unknown]);
      for (int s = node_of[place.back()]; !marked[s];) {
        marked[s] = 1;
        const int columns = super[s + 1] - super[s];
        if (pi[s + 1] - pi[s] > columns) s = node_of[rows[pi[s] + columns]];
      }
    }
    reached.clear();
    for (int s = 0; s < count; ++s)
      if (marked[s]) reached.push_back(s);
    y.assign(n, 0.0);
    below.resize(n);
  }

  /// Solves for the wanted unknowns with the blocks of the reached supernodes alone: columns of L below the diagonal
  /// block lie at rows of reached ones too.
  void solveReached(std::span<const double> b, std::span<double> x) {
    using Block = Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
    const auto* super = static_cast<const int*>(supernodal->super);
    const auto* pi = static_cast<const int*>(supernodal->pi);
    const auto* px = static_cast<const int*>(supernodal->px);
    const auto* all_rows = static_cast<const int*>(supernodal->s);
    const auto* values = static_cast<const double*>(supernodal->x);
    for (const int s : reached) std::fill(y.begin() + super[s], y.begin() + super[s + 1], 0.0);
    for (std::size_t k = 0; k < place.size(); ++k) y[place[k]] = b[k];
    const auto visit = [&](int s, const auto& work) {
      const int columns = super[s + 1] - super[s], rows = pi[s + 1] - pi[s], rest = rows - columns;
      const double* at = values + px[s];
      work(Block(at, columns, columns, Eigen::OuterStride<>(rows)),
           Block(at + columns, rest, columns, Eigen::OuterStride<>(rows)),
           Eigen::Map<Eigen::VectorXd>(y.data() + super[s], columns), Eigen::Map<Eigen::VectorXd>(below.data(), rest),
           all_rows + pi[s] + columns);
    };
    for (const int s : reached)
      visit(s, [&](const Block& L, const Block& R, auto here, auto there, const int* rows) {
        L.triangularView<Eigen::Lower>().solveInPlace(here);
        there.noalias() = R * here;
        for (int i = 0; i < there.size(); ++i) y[rows[i]] -= there[i];
      });
    for (auto s = reached.rbegin(); s != reached.rend(); ++s)
      visit(*s, [&](const Block& L, const Block& R, auto here, auto there, const int* rows) {
        for (int i = 0; i < there.size(); ++i) there[i] = y[rows[i]];
        here.noalias() -= R.transpose() * there;
        L.transpose().triangularView<Eigen::Upper>().solveInPlace(here);
      });
    for (std::size_t k = 0; k < place.size(); ++k) x[k] = y[place[k]];
  }

  void solveOnce(std::span<const double> b, std::span<double> x) {
    cholmod_dense right{};
    right.nrow = right.d = right.nzmax = b.size();
    right.ncol = 1;
    right.x = const_cast<double*>(b.data());  // CHOLMOD does not write it
    right.xtype = CHOLMOD_REAL;
    right.dtype = CHOLMOD_DOUBLE;
    cholmod_dense* result = cholmod_solve(CHOLMOD_A, const_cast<cholmod_factor*>(valid), &right, &common);
    if (!result) check("solution of a linear system");
    std::copy_n(static_cast<const double*>(result->x), b.size(), x.begin());
    cholmod_free_dense(&result, &common);
  }
};

void multiply(const SymmetricMatrix& a, std::span<const double> x, std::span<double> y) {
  std::fill(y.begin(), y.end(), 0.0);
  for (int c = 0; c < a.size; ++c) {
    double sum = 0;
    for (int k = a.offsets[c]; k < a.offsets[c + 1]; ++k) {
      const int r = a.rows[k];
      sum += a.values[k] * x[r];
      if (r != c) y[r] += a.values[k] * x[c];
    }
    y[c] += sum;
  }
}

SymmetricFactor::SymmetricFactor(const SymmetricMatrix& sparsity, Elimination elimination)
    : self_(std::make_unique<Implementation>()) {
  Implementation& s = *self_;
  s.matrix = sparsity;
  s.matrix.values.resize(sparsity.rows.size());
  s.common.supernodal = CHOLMOD_SUPERNODAL;
  s.common.final_ll = 1;
  const OneThread one_thread;
  cholmod_sparse a = s.view();
  const bool in_blocks = elimination == Elimination::blocks;
  if (!in_blocks) s.common.supernodal = CHOLMOD_SIMPLICIAL, s.common.final_ll = 0;
  (in_blocks ? s.supernodal : s.simplicial) = cholmod_analyze(&a, &s.common);
  if (!s.supernodal && !s.simplicial) s.check("symbolic factorisation");
}

SymmetricFactor::~SymmetricFactor() = default;
SymmetricFactor::SymmetricFactor(SymmetricFactor&&) noexcept = default;
SymmetricFactor& SymmetricFactor::operator=(SymmetricFactor&&) noexcept = default;

Definiteness SymmetricFactor::factorise(const SymmetricMatrix& matrix) {
  Implementation& s = *self_;
  assert(matrix.size == s.matrix.size && matrix.rows.size() == s.matrix.rows.size());
  s.matrix.values = matrix.values;
  s.valid = nullptr;
  s.negative = 0;
  s.weakest = 0;
  s.weakest_ratio = s.smallest = std::numeric_limits<double>::infinity();
  if (matrix.size == 0) return Definiteness::positive;
  if (!std::all_of(matrix.values.begin(), matrix.values.end(), [](double v) { return std::isfinite(v); }))
    throw RunError("factorisation: the matrix is not finite");

  const OneThread one_thread;
  cholmod_sparse a = s.view();
  if (s.supernodal) {
    cholmod_factorize(&a, s.supernodal, &s.common);
    s.check("factorisation");
    if (s.common.status == CHOLMOD_OK) {
      s.valid = s.supernodal;
      s.scanSupernodal();
      return s.weakest_ratio < kSingularPivot ? Definiteness::singular : Definiteness::positive;
    }
  }
  // Entry by entry, or not positive definite: L D Lᵀ, with the ordering of the blocks where there are some.
  s.common.supernodal = CHOLMOD_SIMPLICIAL;
  s.common.final_ll = 0;
  if (!s.simplicial) {
    const int ordering = s.common.method[0].ordering;
    s.common.method[0].ordering = CHOLMOD_GIVEN;
    s.common.postorder = 0;
    s.simplicial = cholmod_analyze_p(&a, static_cast<int*>(s.supernodal->Perm), nullptr, 0, &s.common);
    s.common.method[0].ordering = ordering;
    s.common.postorder = 1;
  }
  if (s.simplicial) cholmod_factorize(&a, s.simplicial, &s.common);
  const bool zero_pivot = s.common.status == CHOLMOD_NOT_POSDEF;
  s.common.supernodal = CHOLMOD_SUPERNODAL;
  s.common.final_ll = 1;
  s.check("factorisation");
  if (zero_pivot) {  // exactly zero: the rest is not computed
    s.weakest = static_cast<const int*>(s.simplicial->Perm)[std::min(s.simplicial->minor, s.simplicial->n - 1)];
    s.weakest_ratio = s.smallest = 0;
    return Definiteness::singular;
  }
  s.valid = s.simplicial;
  s.scanSimplicial();
  if (s.weakest_ratio < kSingularPivot) return Definiteness::singular;
  return s.negative > 0 ? Definiteness::indefinite : Definiteness::positive;
}

int SymmetricFactor::negativePivots() const { return self_->negative; }
int SymmetricFactor::weakestUnknown() const { return self_->weakest; }
double SymmetricFactor::smallestPivot() const { return self_->smallest; }
bool SymmetricFactor::solvable() const { return self_->valid != nullptr || self_->matrix.size == 0; }

void SymmetricFactor::solveOnce(std::span<const double> b, std::span<double> x) const {
  assert(solvable());
  if (self_->matrix.size == 0) return;
  const OneThread one_thread;
  self_->solveOnce(b, x);
}

void SymmetricFactor::want(std::span<const int> unknowns) {
  self_->wanted.assign(unknowns.begin(), unknowns.end());
  self_->reach();
}

void SymmetricFactor::solveWanted(std::span<const double> b, std::span<double> x) const {
  Implementation& s = *self_;
  assert(solvable());
  if (s.valid == s.supernodal) {
    s.solveReached(b, x);
    return;
  }
  std::vector<double> right(s.matrix.size, 0.0), all(s.matrix.size);
  for (std::size_t k = 0; k < s.wanted.size(); ++k) right[s.wanted[k]] = b[k];
  solveOnce(right, all);
  for (std::size_t k = 0; k < s.wanted.size(); ++k) x[k] = all[s.wanted[k]];
}

void SymmetricFactor::solve(std::span<const double> b, std::span<double> x) const {
  Implementation& s = *self_;
  assert(solvable());
  if (s.matrix.size == 0) return;
  const OneThread one_thread;
  s.solveOnce(b, x);
  std::vector<double> residual(b.size()), correction(b.size());
  multiply(s.matrix, x, residual);
  for (std::size_t i = 0; i < b.size(); ++i) residual[i] = b[i] - residual[i];
  s.solveOnce(residual, correction);
  for (std::size_t i = 0; i < b.size(); ++i) x[i] += correction[i];
}

}  // namespace gambeson
