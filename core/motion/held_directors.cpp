#include "core/motion/held_directors.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/math/vec.hpp"
#include "core/statics/structure_system.hpp"

namespace gambeson {

HeldDirectors::HeldDirectors(const Structure& s) {
  if (!s.cloth->turnsInner()) return;
  const DofMap& dofs = s.dofs;
  const int first = 3 * dofs.points, directors = static_cast<int>(s.cloth->innerRates()) / 3;
  for (int d = 0; d < directors; ++d) {
    std::vector<Vec3> axes;  // what each unknown of the director turns it about
    std::vector<int> unknown;
    bool turned = false;
    for (int i = 0; i < 3; ++i) {
      const int r = first + 3 * d + i;
      for (int k = dofs.C.offsets[r]; k < dofs.C.offsets[r + 1]; ++k) {
        const int column = dofs.C.columns[k];
        if ((dofs.component[static_cast<std::size_t>(column)] - first) / 3 != d ||
            dofs.component[static_cast<std::size_t>(column)] < first)
          throw InputError({"", 0, "supports"}, "explicit steps cannot tie a director to anything else");
        auto at = std::find(unknown.begin(), unknown.end(), column);
        if (at == unknown.end()) at = unknown.insert(unknown.end(), column), axes.emplace_back();
        axes[static_cast<std::size_t>(at - unknown.begin())][i] = dofs.C.values[k];
      }
      for (const std::vector<double>& shift : dofs.shift)
        turned = turned || (!shift.empty() && shift[static_cast<std::size_t>(r)] != 0);
    }
    if (axes.size() == 3) continue;
    if (turned && !axes.empty())
      throw InputError({"", 0, "supports"}, "explicit steps turn a director only where its support holds it whole");
    Held held{d, axes.empty(), {}};
    for (std::size_t k = 0; k < axes.size(); ++k) {
      if (k == 1) axes[1] -= dot(axes[1], axes[0]) * axes[0];
      axes[k] = normalized(axes[k]);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) held.on[static_cast<std::size_t>(3 * i + j)] += axes[k][i] * axes[k][j];
    }
    any_whole_ = any_whole_ || held.whole;
    held_.push_back(held);
  }
}

void HeldDirectors::place(const Structure& s, double t, std::span<double> inner) const {
  if (!any_whole_) return;
  const std::vector<double> rest(static_cast<std::size_t>(s.dofs.unknowns()), 0.0);
  const std::vector<double> all = innerValues(s, rest, programValues(s, t, ProgramEnds::constant));
  for (const Held& h : held_)
    if (h.whole) std::copy_n(all.begin() + 3L * h.director, 3, inner.begin() + 3L * h.director);
}

void HeldDirectors::hold(std::span<double> torque) const {
  for (const Held& h : held_) {
    double* const t = torque.data() + 3L * h.director;
    const std::array<double, 3> all{t[0], t[1], t[2]};
    for (std::size_t i = 0; i < 3; ++i)
      t[i] = h.on[3 * i] * all[0] + h.on[3 * i + 1] * all[1] + h.on[3 * i + 2] * all[2];
  }
}

}  // namespace gambeson
