#include <cmath>

#include "core/motion/cloth_damping.hpp"
#include "core/motion/lanczos.hpp"
#include "core/motion/step.hpp"

namespace gambeson {
namespace {

/// K y for the parts that `terms` names, by a difference of the force over a displacement of at most 0.1 micrometre.
/// Where the cloth damps its membrane counts as K + D rate.
class Stiffness {
 public:
  /// Vectors: a block for each free point, then the rates of the inner unknowns, three in a block.
  Stiffness(const Model& model, const State& state, StepWork& work)
      : m_(model),
        p_(state.p),
        inner_(state.inner),
        within_(state.law_strains.value_or(StrainBox::all())),
        w_(work),
        blocks_(state.p.size() + (model.inner_mass.size() + 2) / 3) {}

  std::size_t blocks() const { return blocks_; }
  void dampAt(double rate_per_s) { rate_per_s_ = rate_per_s; }

  /// D y, of the cloth's own damping.
  void applyDamping(std::span<const Vec3> y, std::vector<Vec3>& out) {
    w_.q.resize(m_.cloth->points());
    m_.cloth->map().T.multiply<Vec3>(p_, w_.q);
    const std::vector<Vec3> f = clothDamping(*m_.cloth, w_.q, y.first(p_.size()));
    out.assign(blocks_, {});
    for (std::size_t i = 0; i < f.size(); ++i) out[i] = -f[i];
  }

  void apply(std::span<const Vec3> y, ForceTerms terms, bool springs, std::vector<Vec3>& out) {
    terms.steepest = true;
    double largest = 0;
    for (const Vec3& v : y) largest = std::max({largest, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    const double epsilon = kComparedOver_m / largest;
    shifted_.resize(p_.size());
    inner_shifted_.resize(inner_.size());
    inner_y_.resize(m_.inner_mass.size());
    for (std::size_t k = 0; k < inner_y_.size(); ++k) inner_y_[k] = y[p_.size() + k / 3][static_cast<int>(k % 3)];
    for (int side : {-1, 1}) {
      for (std::size_t i = 0; i < p_.size(); ++i) shifted_[i] = p_[i] + (side * epsilon) * y[i];
      w_.q.resize(m_.cloth->points());
      w_.f.resize(m_.cloth->points());
      m_.cloth->map().T.multiply<Vec3>(shifted_, w_.q);
      m_.cloth->advance(inner_, inner_y_, side * epsilon, inner_shifted_);
      w_.inner_force.resize(inner_y_.size());
      m_.cloth->steepForce({w_.q, inner_shifted_, {}}, {w_.f, w_.inner_force, {}, nullptr}, w_.cloth, terms, within_);
      std::vector<Vec3>& f = side < 0 ? before_ : after_;
      f.assign(blocks_, {});
      m_.cloth->map().Tt.multiply<Vec3>(w_.f, std::span(f).first(p_.size()));
      for (std::size_t k = 0; k < inner_y_.size(); ++k)
        f[p_.size() + k / 3][static_cast<int>(k % 3)] = w_.inner_force[k];
    }
    out.resize(blocks_);
    for (std::size_t i = 0; i < blocks_; ++i) out[i] = (before_[i] - after_[i]) / (2 * epsilon);
    if (rate_per_s_ > 0 && terms.membrane) {
      applyDamping(y, damping_);
      for (std::size_t i = 0; i < p_.size(); ++i) out[i] += rate_per_s_ * damping_[i];
    }
    if (springs) {
      negative_.assign(p_.size(), {});
      addStitchForces(m_.stitches, m_.surface.WT, y.first(p_.size()), negative_);
      for (std::size_t i = 0; i < p_.size(); ++i) out[i] -= negative_[i];
      for (const SpringSupportPoint& s : m_.springs) {
        Vec3 x{};
        const SparseRows& WT = m_.surface.WT;
        for (int k = WT.offsets[s.sample]; k < WT.offsets[s.sample + 1]; ++k) x += WT.values[k] * y[WT.columns[k]];
        for (int k = WT.offsets[s.sample]; k < WT.offsets[s.sample + 1]; ++k)
          out[WT.columns[k]] += (WT.values[k] * s.stiffness_N_per_m) * x;
      }
    }
  }

 private:
  const Model& m_;
  std::span<const Vec3> p_;
  std::span<const double> inner_;
  StrainBox within_;
  StepWork& w_;
  std::size_t blocks_;
  std::vector<double> inner_shifted_, inner_y_;
  std::vector<Vec3> shifted_, before_, after_, negative_, damping_;
  double rate_per_s_ = 0;
};

double inner(std::span<const Vec3> a, std::span<const Vec3> b) {
  double s = 0;
  for (std::size_t i = 0; i < a.size(); ++i) s += dot(a[i], b[i]);
  return s;
}

/// The largest frequency of K + D rate, and the damping of its mode, y . D y for y . M y = 1 [1/s].
Frequency estimate(const Model& m, State& state, int iterations, double rate_per_s, double& damping_per_s,
                   StepWork& work, FrequencyOf of);

}  // namespace

const char* Frequency::governing() const {
  if (membrane_share >= bending_share && membrane_share >= seam_share && membrane_share >= spring_share)
    return "membrane";
  if (bending_share >= seam_share && bending_share >= spring_share) return "bending";
  return seam_share >= spring_share ? "seam" : "spring";
}

Frequency largestFrequency(const Model& m, const Stage&, State& state, int iterations, StepWork& work, FrequencyOf of) {
  double damping = 0;
  if (!m.cloth->damps() || of != FrequencyOf::all) return estimate(m, state, iterations, 0, damping, work, of);
  // The step h is stable where h^2 K + 2 h D <= 4 M: with 2/h = w, where no eigenvalue of K + D w is above w^2. Of one
  // mode w = (d + sqrt(d^2 + 4 k))/2; from there its modes are sought again.
  constexpr int most_passes = 6;
  double rate = state.frequency_rad_per_s;
  Frequency f;
  for (int pass = 0; pass < most_passes; ++pass) {
    f = estimate(m, state, iterations, rate, damping, work, of);
    const double both = f.largest_rad_per_s * f.largest_rad_per_s, k = std::max(both - rate * damping, 0.0);
    f.largest_rad_per_s = 0.5 * (damping + std::sqrt(damping * damping + 4 * k));
    const bool found = std::abs(f.largest_rad_per_s - rate) <= 0.005 * rate;
    rate = f.largest_rad_per_s;
    if (found) break;
  }
  return f;
}

namespace {

Frequency estimate(const Model& m, State& state, int iterations, double rate_per_s, double& damping_per_s,
                   StepWork& work, FrequencyOf of) {
  const bool of_bending = of == FrequencyOf::bending, of_all = of == FrequencyOf::all;
  const ForceTerms all{!of_bending, true, !of_bending};
  Stiffness stiffness(m, state, work);
  stiffness.dampAt(rate_per_s);
  const int points = m.freeCount(), n = static_cast<int>(stiffness.blocks());
  std::vector<Vec3> root(n);  // of M^-1, by components
  for (int i = 0; i < points && of != FrequencyOf::inner; ++i) root[i] = std::sqrt(m.inverse_mass[i]) * Vec3{1, 1, 1};
  for (std::size_t k = 0; k < m.inner_mass.size(); ++k)
    root[points + static_cast<int>(k / 3)][static_cast<int>(k % 3)] = 1 / std::sqrt(m.inner_mass[k]);
  const auto scaled = [&](int i, const Vec3& v) { return Vec3{root[i].x * v.x, root[i].y * v.y, root[i].z * v.z}; };
  // What supports and sewn seams leave: M^1/2 P M^1/2, a projection.
  std::vector<Vec3> led(static_cast<std::size_t>(points));
  const auto project = [&](std::vector<Vec3>& x) {
    const bool coupled = m.supports && m.supports->couple();
    if (!coupled && m.sewing.empty()) return;
    for (int i = 0; i < points; ++i) led[i] = root[i].x * x[i];
    if (coupled) m.supports->hold(led);
    if (!m.sewing.empty()) m.sewing.hold(led, work.sewn);
    for (int i = 0; i < points; ++i)
      if (root[i].x > 0) x[i] = led[i] / root[i].x;
  };
  std::vector<std::vector<Vec3>> basis;
  std::vector<double> diagonal, off;
  std::vector<Vec3> y(n), Ky;
  {
    std::vector<Vec3> start(n);
    const bool warm = static_cast<int>(state.mode.size()) == n;
    const double noise = noiseOfLanczos(n);
    double size = 0;
    for (int i = 0; i < n; ++i) {
      start[i] = startOfLanczos(i, warm ? &state.mode[i] : nullptr, noise);
      for (int d = 0; d < 3; ++d)
        if (root[i][d] == 0) start[i][d] = 0;  // held, or no unknown
    }
    project(start);
    for (const Vec3& v : start) size += norm2(v);
    if (!(size > 0)) return {};  // nothing of this moves
    for (Vec3& v : start) v *= 1 / std::sqrt(size);
    basis.push_back(std::move(start));
  }
  for (int k = 0; k < iterations; ++k) {
    for (int i = 0; i < n; ++i) y[i] = scaled(i, basis[k][i]);
    stiffness.apply(y, all, of_all, Ky);
    for (int i = 0; i < n; ++i) Ky[i] = scaled(i, Ky[i]);
    project(Ky);
    diagonal.push_back(inner(basis[k], Ky));
    for (int pass = 0; pass < 2; ++pass)
      for (const auto& b : basis) {
        const double overlap = inner(b, Ky);
        for (int i = 0; i < n; ++i) Ky[i] -= overlap * b[i];
      }
    const double size = std::sqrt(inner(Ky, Ky));
    if (!goesOn(size, diagonal.front()) || k + 1 == iterations) break;
    off.push_back(size);
    for (Vec3& v : Ky) v *= 1 / size;
    basis.push_back(Ky);
  }
  const auto [largest, vector] = largestOf(diagonal, off);
  state.mode.assign(n, {});
  for (std::size_t k = 0; k < vector.size(); ++k)
    for (int i = 0; i < n; ++i) state.mode[i] += vector[k] * basis[k][i];

  Frequency f;
  f.largest_rad_per_s = std::sqrt(std::max(largest, 0.0));
  for (int i = 0; i < n; ++i) y[i] = scaled(i, state.mode[i]);
  const auto share = [&](ForceTerms terms, bool springs) {
    stiffness.apply(y, terms, springs, Ky);
    return inner(y, Ky) / largest;
  };
  if (!of_all) {
    f.bending_share = 1;
    return f;
  }
  f.membrane_share = share({true, false, false}, false);
  f.bending_share = share({false, true, false}, false);
  f.seam_share = share({false, false, true}, false);
  f.spring_share = share({false, false, false}, true);
  if (m.cloth->damps()) {
    stiffness.applyDamping(y, Ky);
    damping_per_s = inner(y, Ky);
  }
  return f;
}

}  // namespace

}  // namespace gambeson
