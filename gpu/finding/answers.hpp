#pragma once
/// Queries by themselves, one a lane: to compare a device with core.

#include "core/contact/impact_query.hpp"
#include "gpu/finding/impact_search.hpp"

namespace gambeson::gpu {

struct AnswerQuestion {
  const ImpactQuestion* question;
  ImpactAnswer* answer;

  GAMBESON_HD void operator()(int i) const {
    const ImpactQuestion& q = question[i];
    const auto hit = q.kind == PairKind::pointTriangle
                         ? certified::findImpact<3>(q.x0, q.x1, q.separation_m, q.tolerance_m)
                         : certified::findImpact<4>(q.x0, q.x1, q.separation_m, q.tolerance_m);
    answer[i] = {hit.has_value(), hit ? *hit : ImpactTime{}};
  }
};

template <class Device>
std::vector<ImpactAnswer> answers(std::span<const ImpactQuestion> questions) {
  typename Device::template Buffer<ImpactQuestion> question(questions.size());
  typename Device::template Buffer<ImpactAnswer> answer(questions.size());
  typename Device::Queue queue;
  queue.upload(questions, question);
  queue.forEach(static_cast<int>(questions.size()), AnswerQuestion{question.data(), answer.data()});
  return queue.download(answer, questions.size());
}

}  // namespace gambeson::gpu
