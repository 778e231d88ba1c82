#include "core/contact/penalty.hpp"

#include <algorithm>
#include <cmath>

#include "core/contact/contact_rows.hpp"
#include "core/contact/rubbing.hpp"

namespace gambeson {

void Penalty::prepare(const MethodStep&, const RowLayer&, ContactRow& row) const { row.target_m_per_s = 0; }

ContactSolve Penalty::solve(const MethodStep& s, const LayeredRows& all, std::span<Vec3> velocity, std::span<Vec3> warm,
                            std::span<Vec3> impulses, ContactWork& w, MethodWork& m) const {
  const std::span<const ContactRow> rows = all.rows;
  shareAreas(rows, s.WT, s.area, s.inverse_mass, w);
  m.normal.resize(rows.size());
  m.pressed.resize(rows.size());
  m.rubbed.resize(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double depth = std::max(0.0, all.layer[i].m - rows[i].contact.gap_m);
    m.pressed[i] = s.dt_s * w.area_of[i] * s.parameters.penalty_Pa_per_m * depth;
    m.normal[i] = m.pressed[i] * rows[i].contact.normal;
    m.rubbed[i] = w.area_of[i] * warm[i];
  }
  spreadImpulses(rows, s.WT, s.inverse_mass, m.normal, w);
  m.moving.assign(velocity.begin(), velocity.end());
  for (std::size_t f = 0; f < m.moving.size(); ++f) m.moving[f] += w.change[f];
  const ContactSolve report = rub(s, rows, m.pressed, m.rubbed, m.moving, w);
  applyImpulses(s, rows, m.normal, m.rubbed, velocity, warm, impulses, w);
  return report;
}

double penaltyFrequency(const ContactParameters& parameters, std::span<const double> density) {
  if (parameters.method != ContactMethod::penalty || density.empty()) return 0;
  return std::sqrt(parameters.penalty_Pa_per_m / *std::min_element(density.begin(), density.end()));
}

}  // namespace gambeson
