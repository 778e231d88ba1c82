#pragma once
/// Bending that recovers in time: a law with a Maxwell branch beside it.

#include "core/material/laws/given_rigidities.hpp"
#include "core/material/laws/law.hpp"

namespace gambeson {

/// Law L, and beside it along each component i a spring of v D_i [N m] in series with a dashpot whose curvature q_i
/// [1/m] follows in the time tau [s] (Maxwell's element):
///   m_i = m_i(L) + v D_i (k_i - q_i),   dq_i/dt = (k_i - q_i)/tau,
/// D the rigidities beyond friction. Cloth that is held bent relaxes, and what was bent for long opens slowly: the fold
/// that is left when the moment is taken away goes back in time to that of L alone. A step of dt takes q to the end of
/// an implicit Euler step, q + (k - q) x/(1 + x), x = dt/tau: m is the gradient of stored + lost for any dt, first order
/// in x. In statics no time passes within a load step that the branch could bear (dt infinite): it is relaxed. With D as
/// an isotropic law has it, the branch is isotropic too. Valid for v >= 0, tau > 0. History: that of L, then q.
template <class L>
struct Recovering : L {
  double part = 0;    ///< v
  double time_s = 1;  ///< tau

  static constexpr int number_count = L::number_count + 2, history_size = L::history_size + 3;

  bool operator==(const Recovering&) const = default;
  std::array<double, number_count> numbers() const {
    std::array<double, number_count> all{};
    const auto own = L::numbers();
    std::copy(own.begin(), own.end(), all.begin());
    all[L::number_count] = part;
    all[L::number_count + 1] = 1 / time_s;
    return all;
  }
  void check(const Refusal& refuse) const {
    L::check(refuse);
    if (!(part >= 0)) refuse("recovery", "must be >= 0");
    if (!(time_s > 0)) refuse("recovery_time", "must be > 0");
  }
  double most_Nm() const { return L::most_Nm() + part * GivenRigidities::most_Nm(); }
  static Recovering mixed(const Recovering& a, const Recovering& b, double w) {
    Recovering c;
    static_cast<L&>(c) = L::mixed(a, b, w);
    c.part = mix(a.part, b.part, w);
    c.time_s = 1 / mix(1 / a.time_s, 1 / b.time_s, w);
    return c;
  }

  template <unsigned kParts, class S, class P>
  GAMBESON_LAW static void bend(const P* D, const P* numbers, const S* k, History<S> history, Answer<S, 3>& out) {
    L::template bend<kParts>(D, numbers, k, history, out);
    const P stiffness = numbers[L::number_count], rate = numbers[L::number_count + 1];
    const S share = spread<S>(1.0 / (1.0 + history.elapsed_s * rate));
    for (int i = 0; i < 3; ++i) {
      const S follower = history.before(L::history_size + i), off = k[i] - follower, left = share * off;
      const S rigidity = spread<S>(stiffness * D[i]);
      out.resultant[i] += rigidity * left;
      if constexpr (kParts & with_energy) {
        out.energy += 0.5 * rigidity * left * left;
        out.lost += 0.5 * rigidity * left * (off - left);
      }
      if constexpr (kParts & with_slope) out.slope[i] += rigidity * share;
      history.keep(L::history_size + i, k[i] - left);
    }
  }
  template <class P>
  GAMBESON_LAW static P steepest(int i, const P* D, const P* numbers) {
    return L::steepest(i, D, numbers) + numbers[L::number_count] * D[i];
  }
};

}  // namespace gambeson
