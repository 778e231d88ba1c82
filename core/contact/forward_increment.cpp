#include "core/contact/forward_increment.hpp"

#include <algorithm>

#include "core/contact/contact_rows.hpp"
#include "core/contact/rubbing.hpp"

namespace gambeson {
namespace {

constexpr int kPasses = 50;

}  // namespace

ContactSolve ForwardIncrement::solve(const MethodStep& s, const LayeredRows& all, std::span<Vec3> velocity,
                                     std::span<Vec3> warm, std::span<Vec3> impulses, ContactWork& w,
                                     MethodWork& m) const {
  const std::span<const ContactRow> rows = all.rows;
  const std::size_t n = rows.size();
  m.smooth.assign(rows.begin(), rows.end());
  for (ContactRow& row : m.smooth) row.slippery = true;
  shareAreas(rows, s.WT, s.area, s.inverse_mass, w);
  m.normal_warm.resize(n);
  m.rubbed.resize(n);
  m.pressed.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3& normal = rows[i].contact.normal;
    m.normal_warm[i] = dot(warm[i], normal) * normal;
    m.rubbed[i] = w.area_of[i] * (warm[i] - m.normal_warm[i]);
  }
  ContactSolve report;
  const double goal = s.parameters.tolerance_m_per_s2 * s.dt_s;
  const auto withImpulses = [&](std::span<const Vec3> given) {
    spreadImpulses(rows, s.WT, s.inverse_mass, given, w);
    m.moving.assign(velocity.begin(), velocity.end());
    for (std::size_t f = 0; f < m.moving.size(); ++f) m.moving[f] += w.change[f];
  };
  for (int pass = 1;; ++pass) {
    withImpulses(m.rubbed);
    const ContactSolve pressing = solveContacts(m.smooth, s.WT, s.inverse_mass, s.area, s.density, s.place,
                                                s.parameters, s.dt_s, m.moving, m.normal_warm, m.normal, w);
    for (std::size_t i = 0; i < n; ++i) m.pressed[i] = dot(m.normal[i], rows[i].contact.normal);
    withImpulses(m.normal);
    m.rubbed_before = m.rubbed;
    const ContactSolve rubbing = rub(s, rows, m.pressed, m.rubbed, m.moving, w);
    for (std::size_t i = 0; i < n; ++i) m.rubbed_before[i] = m.rubbed[i] - m.rubbed_before[i];
    spreadImpulses(rows, s.WT, s.inverse_mass, m.rubbed_before, w);
    double moved2 = 0;
    for (const Vec3& change : w.change) moved2 = std::max(moved2, norm2(change));
    const bool stays = std::sqrt(moved2) <= goal;
    report.iterations += pressing.iterations;
    report.residual_m_per_s = std::max({pressing.residual_m_per_s, rubbing.residual_m_per_s, std::sqrt(moved2)});
    report.converged = pressing.converged && rubbing.converged && stays;
    if (stays || pass == kPasses) break;
  }
  applyImpulses(s, rows, m.normal, m.rubbed, velocity, warm, impulses, w);
  return report;
}

}  // namespace gambeson
