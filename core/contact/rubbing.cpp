#include "core/contact/rubbing.hpp"

#include <algorithm>

#include "core/contact/contact_rows.hpp"

namespace gambeson {
namespace {

constexpr double kOfTolerance = 1e-4;

}  // namespace

ContactSolve rub(const MethodStep& s, std::span<const ContactRow> rows, std::span<const double> pressed,
                 std::span<Vec3> rubbed, std::span<Vec3> velocity, ContactWork& w) {
  const int n = static_cast<int>(rows.size());
  w.order.clear();
  for (int i = 0; i < n; ++i) {
    const Vec3& normal = rows[i].contact.normal;
    rubbed[i] = cutTo(frictionOf(s, rows[i]) * pressed[i], across(rubbed[i], normal));
    if (pressed[i] > 0) w.order.push_back(i);
  }
  w.reach.assign(n, {});
  w.reach_point.clear();
  w.reach_weight.clear();
  reachRows(rows, s.WT, s.inverse_mass, velocity, w);
  const auto push = [&](const ContactWork::Reach& reach, const Vec3& impulse) {
    for (int e = reach.first; e < reach.first + reach.count; ++e)
      velocity[w.reach_point[e]] += (w.reach_weight[e] * s.inverse_mass[w.reach_point[e]]) * impulse;
  };
  std::vector<double>& own = w.row_area;  // what an impulse of the row does to its own velocity [1/kg]
  own.assign(n, 0);
  for (const int i : w.order) {
    const ContactWork::Reach& reach = w.reach[i];
    for (int e = reach.first; e < reach.first + reach.count; ++e)
      own[i] += w.reach_weight[e] * w.reach_weight[e] * s.inverse_mass[w.reach_point[e]];
    push(reach, rubbed[i]);
  }
  ContactSolve report;
  const double goal = kOfTolerance * s.parameters.tolerance_m_per_s2 * s.dt_s;
  if (w.order.empty()) return report;
  for (;;) {
    double most2 = 0;
    for (const int i : w.order) {
      const ContactRow& row = rows[i];
      const Vec3 slip = across(velocityAt(row, s.WT, velocity), row.contact.normal);
      const Vec3 next = cutTo(frictionOf(s, row) * pressed[i], across(rubbed[i] - slip / own[i], row.contact.normal));
      const Vec3 change = next - rubbed[i];
      most2 = std::max(most2, norm2(own[i] * change));
      rubbed[i] = next;
      push(w.reach[i], change);
    }
    ++report.iterations;
    report.residual_m_per_s = std::sqrt(most2);
    report.converged = report.residual_m_per_s <= goal;
    if (report.converged || report.iterations == s.parameters.max_iterations) return report;
  }
}

void applyImpulses(const MethodStep& s, std::span<const ContactRow> rows, std::span<const Vec3> normal,
                   std::span<const Vec3> rubbed, std::span<Vec3> velocity, std::span<Vec3> traction,
                   std::span<Vec3> impulses, ContactWork& w) {
  shareAreas(rows, s.WT, s.area, s.inverse_mass, w);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    impulses[i] = normal[i] + rubbed[i];
    traction[i] = w.area_of[i] > 0 ? impulses[i] / w.area_of[i] : Vec3{};
  }
  spreadImpulses(rows, s.WT, s.inverse_mass, impulses, w);
  for (std::size_t f = 0; f < velocity.size(); ++f) velocity[f] += w.change[f];
}

}  // namespace gambeson
