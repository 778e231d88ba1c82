#include "gpu/scenes/solve_facts.hpp"

#include "core/contact/contact_iteration.hpp"
#include "gpu/finding/hash.hpp"

namespace gambeson::gpu {

SweepFacts factsOf(const ContactWork& w) {
  SweepFacts facts{static_cast<int>(w.order.size()), static_cast<int>(w.islands.size()), 0, 0};
  const auto take = [&](double x) { facts.hash = mixed(facts.hash ^ std::bit_cast<std::uint64_t>(x)); };
  for (const auto* quads : {&w.candidate, &w.previous, &w.moved, &w.moved_before})
    for (const ContactWork::Quad& quad : *quads)
      for (int k = 0; k < 3; ++k) take(quad.lane[k]);
  for (const ContactWork::Island& i : w.islands) {
    for (double x : {i.beta, i.momentum, i.caution, i.best, i.residual_m_per_s}) take(x);
    for (int n : {i.waiting, i.iterations, static_cast<int>(i.done)}) take(n);
    facts.iterations = std::max(facts.iterations, i.iterations);
  }
  return facts;
}

ContactWork solved(const ContactProblem& problem, int most, ContactSweeps* device) {
  ContactWork work;
  startProblem(problem, work);
  if (device) {
    device->set(work);
    device->run(problem.goal_m_per_s, most, 4 * most);
    device->get(work);
  } else {
    iterate(problem.goal_m_per_s, most, 4 * most, work);
  }
  return work;
}

std::vector<ContactProblem> manifestProblems() {
  return {contactStack({1, 12, 0.3}),
          besides({contactStack({3, 4, 1}, 1), contactStack({1, 1, 0.5}, 2), contactStack({2, 7, 0.6}, 3)}),
          contactStack({2, 16, 0.7})};
}

}  // namespace gambeson::gpu
