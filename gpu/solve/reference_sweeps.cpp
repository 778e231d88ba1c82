#include <algorithm>
#include <chrono>

#include "core/contact/iteration_lanes.hpp"
#include "core/error.hpp"
#include "gpu/solve/contact_sweeps.hpp"
#include "gpu/solve/flat_solve.hpp"
#include "gpu/solve/island_sweeps.hpp"

namespace gambeson::gpu {
namespace {

template <int Q>
class ReferenceSweeps : public ContactSweeps {
 public:
  void set(const ContactWork& work) override {
    flat_ = flatSolve(work);
    now_ = flat_;
    pace_.resize(flat_.facts.size());
    largest2_.resize(2 * flat_.chunks.size());
    against_.resize(2 * flat_.chunks.size());
    spilled_.resize(flat_.chunk_points.size());
    spilled_before_.resize(flat_.moved.size());
  }
  void run(double goal, int last, int most) override {
    using Group = HostQuads<Q>;
    const SolveData data = dataOf();
    const SweepLimits limits{goal, last, most - most / 4};
    const int n = static_cast<int>(flat_.islands.size());
#pragma omp parallel for schedule(dynamic)
    for (int i = 0; i < n; ++i) {
      typename IslandSweeps<Group>::Shared shared;
      std::vector<Vec3> room(kRoom);
      const IslandSweeps<Group> sweeps(data, limits, shared, room.data(), kRoom);
      const int island = flat_.by_size[i];
      if (isLarge(flat_.islands[island]))
        sweeps.runTeam(Group{}, {island, 0, 1, nullptr});
      else
        sweeps.runAlone(Group{}, island);
    }
  }
  void get(ContactWork& w) const override {
    w.islands = now_.islands;
    for (std::size_t k = 0; k < w.order.size(); ++k) {
      const RowState state = RowState::of(now_.state.data(), static_cast<int>(k));
      w.candidate[k] = quadOf(state.now);
      w.previous[k] = quadOf(state.before);
    }
    for (std::size_t f = 0; f < now_.moved.size(); ++f) {
      w.moved[f] = quadOf(now_.moved[f]);
      w.moved_before[f] = quadOf(now_.moved_before[f]);
    }
  }
  double medianMilliseconds(double goal, int last, int most, int runs) override {
    std::vector<double> times;
    for (int i = 0; i < runs; ++i) {
      const auto start = std::chrono::steady_clock::now();
      run(goal, last, most);
      times.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    }
    std::ranges::nth_element(times, times.begin() + runs / 2);
    return times[runs / 2];
  }
  void begin(double goal, int last, int most) override { run(goal, last, most); }
  void wait() override {}

 private:
  static constexpr int kRoom = 2048;  ///< so that larger ones take the other way

  SolveData dataOf() {
    return {flat_.islands.data(), now_.islands.data(),       flat_.chunks.data(), flat_.steps.data(),
            flat_.facts.data(),   flat_.own.data(),          flat_.slope.data(),  flat_.entries.data(),
            flat_.state.data(),   now_.state.data(),         pace_.data(),        flat_.point.data(),
            flat_.weight.data(),  flat_.push.data(),         flat_.free.data(),   flat_.chunk_points.data(),
            flat_.moved.data(),   flat_.moved_before.data(), now_.moved.data(),   now_.moved_before.data(),
            largest2_.data(),     against_.data(),           spilled_.data(),     spilled_before_.data()};
  }

  FlatSolve flat_, now_;
  std::vector<double> pace_;  ///< RowPace
  std::vector<double> largest2_, against_;
  std::vector<Vec3> spilled_, spilled_before_;
};

}  // namespace

std::unique_ptr<ContactSweeps> sweepsOnReference(int quads) {
  switch (quads) {
    case 1:
      return std::make_unique<ReferenceSweeps<1>>();
    case 8:
      return std::make_unique<ReferenceSweeps<8>>();
    case 16:
      return std::make_unique<ReferenceSweeps<16>>();
    case 64:
      return std::make_unique<ReferenceSweeps<64>>();
    default:
      throw RunError("groups have 1, 8, 16 or 64 quads");
  }
}

}  // namespace gambeson::gpu
