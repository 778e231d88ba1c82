#include "core/motion/velocity_system.hpp"

#include <algorithm>

namespace gambeson {
namespace {

constexpr int kMostIterations = 3000;

/// Adds w (I - n n^T) to a block of nine values.
void addAcross(double w, const Vec3& n, double* block) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) block[3 * i + j] += w * ((i == j ? 1 : 0) - n[i] * n[j]);
}

}  // namespace

bool VelocitySystem::assemble(const Model& m, const State& s, const AnchorFrames& frames, const ForceTerms& terms,
                              double dt, StepWork& w) {
  if (model_ != &m) {
    model_ = &m;
    tangent_ = m.cloth->tangent();
    A_ = tangent_->sparsity();
    product_ = BlockProduct(A_);
    if (m.cloth->damps()) damping_product_ = BlockProduct(A_);
  }
  dt_s_ = dt;
  const int n = m.freeCount(), blocks = A_.rows();
  w.q.resize(m.cloth->points());
  m.cloth->map().T.multiply<Vec3>(s.p, w.q);
  ForceTerms definite = terms;
  definite.definite = true;
  tangent_->assemble({w.q, s.inner, s.history}, w.cloth, A_, definite);
  const bool damps = m.cloth->damps();
  if (damps) {
    tangent_->assembleDamping({w.q, s.inner, s.history}, w.cloth, D_);
    damping_product_.set(D_);
  }
  own_.resize(blocks);
  diagonal_.resize(9 * static_cast<std::size_t>(blocks));
  const auto ownOf = [&](int r) {
    if (r < n) return (m.mass_kg[r] + dt * m.drag_kg_per_s[r]) * Vec3{1, 1, 1};
    Vec3 mass{1, 1, 1};
    for (int d = 0; d < 3; ++d)
      if (const std::size_t k = 3 * static_cast<std::size_t>(r - n) + d; k < m.inner_mass.size())
        mass[d] = m.inner_mass[k] * (1 + dt * m.inner_drag_per_s);
    return mass;
  };
  forAll(Each::sum, blocks, [&](int r) {
    for (long k = 9 * A_.offsets[r]; k < 9 * A_.offsets[r + 1]; ++k) {
      A_.values[k] *= dt * dt;
      if (damps) A_.values[k] += dt * D_.values[k];
    }
    own_[r] = ownOf(r);
    double* block = &A_.values[9 * A_.offsets[r]];  // its diagonal comes first
    for (int d = 0; d < 3; ++d) block[4 * d] += own_[r][d];
    std::copy(block, block + 9, &diagonal_[9 * static_cast<std::size_t>(r)]);
  });
  product_.set(A_);
  links_.clear();
  for (const SpringSupportPoint& spring : m.springs)
    links_.push_back({spring.sample, -1, dt * dt * spring.stiffness_N_per_m, frames.normal(spring)});
  for (const Stitch& stitch : m.stitches)
    links_.push_back({stitch.a, stitch.b, dt * dt * stitch.stiffness_N_per_m, {}});
  const SparseRows& WT = m.surface.WT;
  for (const Link& link : links_)
    for (const int sample : {link.a, link.b})
      if (sample >= 0)
        for (int k = WT.offsets[sample]; k < WT.offsets[sample + 1]; ++k)
          addAcross(link.weight * WT.values[k] * WT.values[k], link.normal,
                    &diagonal_[9 * static_cast<std::size_t>(WT.columns[k])]);
  return inverses_.set(diagonal_);
}

void VelocitySystem::multiply(std::span<const Vec3> x, std::span<Vec3> y) const {
  product_.multiply(x, y);
  const SparseRows& WT = model_->surface.WT;
  for (const Link& link : links_) {
    Vec3 d = sampleAt(WT, link.a, x);
    if (link.b >= 0) d -= sampleAt(WT, link.b, x);
    const Vec3 f = link.weight * (d - dot(d, link.normal) * link.normal);
    for (int k = WT.offsets[link.a]; k < WT.offsets[link.a + 1]; ++k) y[WT.columns[k]] += WT.values[k] * f;
    if (link.b >= 0)
      for (int k = WT.offsets[link.b]; k < WT.offsets[link.b + 1]; ++k) y[WT.columns[k]] -= WT.values[k] * f;
  }
}

bool VelocitySystem::damping(std::span<const Vec3> x, std::span<Vec3> out) const {
  if (!model_->cloth->damps()) return false;
  damping_product_.multiply(x, out);
  return true;
}

void VelocitySystem::stiffness(std::span<const Vec3> x, std::span<Vec3> out) const {
  multiply(x, out);
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = (1 / dt_s_) * (out[i] - Vec3{own_[i].x * x[i].x, own_[i].y * x[i].y, own_[i].z * x[i].z});
  scratch_.resize(out.size());
  if (damping(x, scratch_))
    for (std::size_t i = 0; i < out.size(); ++i) out[i] -= scratch_[i];
}

void VelocitySystem::hold(std::span<Vec3> change) const {
  if (model_->supports) {
    const std::size_t n = model_->mass_kg.size();
    model_->supports->hold(change.first(n));
    // What supports lead of the inner unknowns does not move by itself.
    inner_.resize(model_->inner_mass.size());
    unled_.resize(n);
    if (change.size() == n) return;
    for (std::size_t k = 0; k < inner_.size(); ++k) inner_[k] = change[n + k / 3][static_cast<int>(k % 3)];
    model_->supports->handInner(inner_, unled_);
    for (std::size_t k = 0; k < inner_.size(); ++k) change[n + k / 3][static_cast<int>(k % 3)] = inner_[k];
    return;
  }
  for (const int i : model_->held_points) change[i] = {};
}

CgReport VelocitySystem::solve(std::span<const Vec3> b, double tolerance, std::span<Vec3> x) {
  const Model& m = *model_;
  ConjugateGradients cg;
  cg.multiply = [this](std::span<const Vec3> in, std::span<Vec3> out) { multiply(in, out); };
  cg.precondition = [this](std::span<const Vec3> in, std::span<Vec3> out) { inverses_.multiply(in, out); };
  const bool couples = m.supports && m.supports->couple();
  if (!m.held_points.empty() || couples) {
    cg.filter = [this](std::span<Vec3> v) { hold(v); };
    cg.forces = cg.filter;
    // What supports leave, P M, has the transpose M P = M (P M) M^-1.
    if (couples)
      cg.forces = [this, &m](std::span<Vec3> r) {
        const std::size_t n = m.mass_kg.size();
        scratch_.assign(r.begin(), r.begin() + static_cast<long>(n));
        for (std::size_t i = 0; i < n; ++i) scratch_[i] = scratch_[i] / m.mass_kg[i];
        hold(scratch_);
        for (std::size_t i = 0; i < n; ++i) r[i] = m.mass_kg[i] * scratch_[i];
      };
  }
  if (cg.filter) cg.filter(x);
  return solveCg(cg, b, tolerance, kMostIterations, x, work_);
}

}  // namespace gambeson
