#include "core/contact/method.hpp"

#include <algorithm>

#include "core/contact/contact_rows.hpp"
#include "core/contact/forward_increment.hpp"
#include "core/contact/penalty.hpp"
#include "core/contact/projection.hpp"

namespace gambeson {
namespace {

constexpr int kTurns = 100;

void copyOut(const LayeredRows& rows, std::span<const Vec3> warm, std::span<const int> which, MethodWork::Part& part) {
  part.rows.clear();
  part.layer.clear();
  part.warm.clear();
  for (const int i : which) {
    part.rows.push_back(rows.rows[i]);
    part.layer.push_back(rows.layer[i]);
    part.warm.push_back(warm[i]);
  }
}

void copyBack(const MethodWork::Part& part, std::span<const int> which, std::span<Vec3> warm,
              std::span<Vec3> impulses) {
  for (std::size_t k = 0; k < which.size(); ++k) {
    warm[which[k]] = part.warm[k];
    impulses[which[k]] = part.impulses[k];
  }
}

/// A sample that meets the surface itself rubs there: of two frictions at one point neither would come to an end.
void leaveFriction(std::span<const ContactRow> others, std::span<ContactRow> own) {
  for (const ContactRow& hit : others) {
    if (!hit.impact || !hit.contact.onBody() || hit.stencil.count > 1) continue;
    for (ContactRow& row : own)
      if (row.stencil.count == 1 && row.contact.sample == hit.contact.sample &&
          row.contact.obstacle == hit.contact.obstacle)
        row.slippery = true;
  }
}

double largestDifference(std::span<const Vec3> a, std::span<const Vec3> b) {
  double most2 = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most2 = std::max(most2, norm2(a[i] - b[i]));
  return std::sqrt(most2);
}

}  // namespace

bool BodyMethod::takes(const ContactRow& row) const {
  const ContactKind kind = row.contact.kind;
  return row.contact.onBody() && !row.impact && !row.slippery &&
         (kind == ContactKind::sample_on_body || kind == ContactKind::edge_on_body);
}

std::unique_ptr<const BodyMethod> bodyMethod(const ContactParameters& parameters) {
  switch (parameters.method) {
    case ContactMethod::together:
      return nullptr;
    case ContactMethod::penalty:
      return std::make_unique<Penalty>();
    case ContactMethod::forward_increment:
      return std::make_unique<ForwardIncrement>();
    case ContactMethod::projection:
      return std::make_unique<Projection>();
  }
  return nullptr;
}

ContactSolve solveByMethod(const BodyMethod& method, const MethodStep& s, const LayeredRows& all,
                           std::span<Vec3> velocity, std::span<Vec3> warm, std::vector<Vec3>& impulses, ContactWork& w,
                           MethodWork& m) {
  const int n = static_cast<int>(all.rows.size());
  impulses.assign(n, {});
  m.own.clear();
  m.others.clear();
  for (int i = 0; i < n; ++i) (method.takes(all.rows[i]) ? m.own : m.others).push_back(i);
  if (m.others.empty()) return method.solve(s, all, velocity, warm, impulses, w, m);
  MethodWork::Part &own = m.of_own, &others = m.of_others;
  copyOut(all, warm, m.own, own);
  copyOut(all, warm, m.others, others);
  own.impulses.assign(m.own.size(), {});
  own.change.assign(velocity.size(), {});
  shareAreas(others.rows, s.WT, s.area, s.inverse_mass, w);
  others.impulses = others.warm;
  for (std::size_t k = 0; k < others.impulses.size(); ++k) others.impulses[k] *= w.area_of[k];
  spreadImpulses(others.rows, s.WT, s.inverse_mass, others.impulses, w);
  others.change = w.change;
  // `change`: what the impulses of a part alone do.
  const auto without = [&](const MethodWork::Part& part) {
    m.velocity.assign(velocity.begin(), velocity.end());
    for (std::size_t f = 0; f < velocity.size(); ++f) m.velocity[f] += part.change[f];
  };
  const auto solveOwn = [&] {
    without(others);
    const ContactSolve solve = method.solve(s, {own.rows, own.layer}, m.velocity, own.warm, own.impulses, w, m);
    spreadImpulses(own.rows, s.WT, s.inverse_mass, own.impulses, w);
    own.before.swap(own.change);
    own.change = w.change;
    return solve;
  };
  leaveFriction(others.rows, own.rows);
  ContactSolve report = solveOwn();
  const double goal = s.parameters.tolerance_m_per_s2 * s.dt_s;
  for (int turn = 1;; ++turn) {
    without(own);
    const ContactSolve of_others = solveContacts(others.rows, s.WT, s.inverse_mass, s.area, s.density, s.place,
                                                 s.parameters, s.dt_s, m.velocity, others.warm, others.impulses, w);
    spreadImpulses(others.rows, s.WT, s.inverse_mass, others.impulses, w);
    others.change = w.change;
    const ContactSolve of_own = solveOwn();
    const double moved = largestDifference(own.change, own.before);
    report.iterations += of_others.iterations + of_own.iterations;
    report.residual_m_per_s = std::max({of_others.residual_m_per_s, of_own.residual_m_per_s, moved});
    report.converged = of_others.converged && of_own.converged && moved <= goal;
    if (moved <= goal || turn == kTurns) break;
  }
  for (std::size_t f = 0; f < velocity.size(); ++f) velocity[f] += others.change[f] + own.change[f];
  copyBack(own, m.own, warm, impulses);
  copyBack(others, m.others, warm, impulses);
  return report;
}

}  // namespace gambeson
