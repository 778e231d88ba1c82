#pragma once
/// The impacts of a step (impact_step.hpp) on a device.

#include <chrono>

#include "gpu/step/impact_step.hpp"
#include "gpu/step/step_impacts.hpp"

namespace gambeson::gpu {

template <class Device>
class ImpactStepOn final : public ImpactStep {
 public:
  template <class T>
  using Buffer = typename Device::template Buffer<T>;
  using Queue = typename Device::Queue;

  ImpactStepOn(const Model& model, std::span<const Vec3> start, const ImpactSizes& room)
      : impacts_(queue_, model, start, room),
        x0_(start.size()),
        x1_(start.size()),
        exempt_(static_cast<std::size_t>(model.collisions.cloth.cloth_vertices)) {
    for (std::size_t o = 0; o < model.obstacles.size(); ++o)
      if (const auto* e = std::get_if<Ellipsoid>(&model.obstacles[o].shape)) {
        EllipsoidBody body;
        body.metric = ellipsoidMetric(*e);
        body.obstacle = static_cast<int>(o);
        bodies_.push_back(body);
      }
    ellipsoid_ = Buffer<EllipsoidBody>(bodies_.size());
    setRows({}, 16);
  }

  void setMotion(const ImpactMotion& motion) override {
    queue_.upload(motion.x0, x0_);
    queue_.upload(motion.x1, x1_);
    queue_.upload(motion.exempt, exempt_);
    for (EllipsoidBody& b : bodies_) {
      b.start = motion.start[static_cast<std::size_t>(b.obstacle)];
      b.end = motion.end[static_cast<std::size_t>(b.obstacle)];
    }
    if (!bodies_.empty()) queue_.upload(std::span<const EllipsoidBody>(bodies_), ellipsoid_);
  }
  ImpactCounts find(Trees trees) override { return impacts_.find(paths(), trees); }
  std::vector<StepHit> hits() override { return impacts_.hits(); }
  const ImpactSizes& sizes() const override { return impacts_.sizes(); }
  int repeats() const override { return impacts_.repeats(); }

  void setRows(const HostRows& rows, unsigned long long room) override {
    facts_ = Buffer<ContactFacts>(room), stencil_ = Buffer<ContactStencil>(room);
    touch_ = Buffer<BodyTouch>(room), terms_ = Buffer<RowTerms>(room);
    traction_ = Buffer<Vec3>(room), impulse_ = Buffer<Vec3>(room);
    const Count n = rows.size();
    queue_.upload(std::span<const Count>(&n, 1), row_count_);
    if (n == 0) return;
    const auto up = [this](const auto& from, auto& to) { queue_.upload(std::span(from), to); };
    up(rows.facts, facts_), up(rows.stencil, stencil_), up(rows.touch, touch_), up(rows.terms, terms_);
    up(rows.traction, traction_), up(rows.impulse, impulse_);
  }
  void addRows(const ImpactRowTerms& step) override {
    for (;; ++row_repeats_) {
      impacts_.addRows(view(), step);
      const Count need = queue_.download(row_count_, 1)[0], room = facts_.size();
      if (need <= room) return;
      setRows(rows(), std::max(need, 2 * room));
    }
  }
  HostRows rows() override {
    const std::size_t n = std::min<Count>(queue_.download(row_count_, 1)[0], facts_.size());
    return {queue_.download(facts_, n), queue_.download(stencil_, n),  queue_.download(touch_, n),
            queue_.download(terms_, n), queue_.download(traction_, n), queue_.download(impulse_, n)};
  }
  int rowRepeats() const override { return row_repeats_; }

  double medianMilliseconds(Trees trees, int passes) override {
    return medianReplay<Device>(queue_, passes, [&] { impacts_.give(paths(), trees); });
  }
  double medianOfFinds(Trees trees, int passes) override {
    std::vector<double> ms;
    for (int k = -kWarmUp; k < passes; ++k) {
      const auto start = std::chrono::steady_clock::now();
      impacts_.find(paths(), trees);
      if (k >= 0)
        ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    }
    return medianOf(ms);
  }
  double medianOfRows(const ImpactRowTerms& step, int passes) override {
    return medianReplay<Device>(queue_, passes, [&] { impacts_.addRows(view(), step); });
  }
  std::vector<ImpactSearch::StageTime> stageTimes(int passes) override {
    const Stages<Device> all = impacts_.stages();
    const std::vector<double> ms = medianTimes<Device>(queue_, passes, all);
    std::vector<ImpactSearch::StageTime> times;
    for (std::size_t i = 0; i < all.size(); ++i) times.push_back({all[i].name, ms[i]});
    return times;
  }

 private:
  ImpactPaths paths() const { return {x0_.data(), x1_.data(), exempt_.data(), ellipsoid_.data()}; }
  StepRows view() {
    return {facts_.data(),    stencil_.data(), touch_.data(),     terms_.data(),
            traction_.data(), impulse_.data(), row_count_.data(), facts_.size()};
  }

  Queue queue_;
  StepImpacts<Device> impacts_;
  Buffer<Vec3> x0_, x1_;
  Buffer<char> exempt_;
  std::vector<EllipsoidBody> bodies_;
  Buffer<EllipsoidBody> ellipsoid_;
  Buffer<ContactFacts> facts_;
  Buffer<ContactStencil> stencil_;
  Buffer<BodyTouch> touch_;
  Buffer<RowTerms> terms_;
  Buffer<Vec3> traction_, impulse_;
  Buffer<Count> row_count_{1};
  int row_repeats_ = 0;
};

}  // namespace gambeson::gpu
