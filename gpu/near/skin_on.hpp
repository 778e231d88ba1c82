#pragma once
/// Detail of skin_bender.hpp: on a device.

#include <algorithm>

#include "core/error.hpp"
#include "gpu/finding/stage.hpp"
#include "gpu/near/skin_bender.hpp"
#include "gpu/near/skin_kernels.hpp"

namespace gambeson::gpu {

template <class Device>
class SkinOn final : public SkinBender {
 public:
  template <class T>
  using Buffer = typename Device::template Buffer<T>;
  using Queue = typename Device::Queue;

  SkinOn(const Skin& skin, int most_times) : most_times_(most_times) {
    view_.links = static_cast<int>(skin.bind.size());
    view_.vertices = static_cast<int>(skin.rest.vertices.size());
    view_.bends = static_cast<int>(skin.bends.size());
    view_.crease_gap_m = skin.crease_gap_m;
    rest_ = uploaded<Device>(queue_, skin.rest.vertices);
    bind_ = uploaded<Device>(queue_, skin.bind);
    view_.rest = rest_.data(), view_.bind = bind_.data();
    if (view_.bends > 0)
      flattenBends(skin);
    else
      flattenLinks(skin);
    const auto times = static_cast<std::size_t>(most_times);
    const auto room = [&](int each) { return times * static_cast<std::size_t>(each); };
    poses_ = Buffer<Pose>(room(view_.links)), move_ = Buffer<Pose>(room(view_.links));
    turn_ = Buffer<skin_bend::Quaternion>(room(view_.bends));
    motion_ = Buffer<RunMotion>(room(view_.motions));
    crease_ = Buffer<skin_bend::Crease>(room(view_.creases));
    x_ = Buffer<Vec3>(room(view_.vertices));
  }

  void bend(std::span<const Pose> poses, int times) override {
    if (times < 1 || times > most_times_ || poses.size() != static_cast<std::size_t>(times * view_.links))
      throw RunError("SkinBender: " + std::to_string(poses.size()) + " poses for " + std::to_string(times) +
                     " times of " + std::to_string(view_.links) + " links, " + std::to_string(most_times_) +
                     " times at most");
    bend(queue_, poses, times);
    queue_.wait();
  }
  /// The same, given to another's queue.
  void bend(Queue& queue, std::span<const Pose> poses, int times) {
    times_ = times;
    queue.uploadLater(poses, poses_);
    give(queue);
  }
  std::vector<Vec3> positions(int time) override {
    const std::vector<Vec3> all =
        queue_.download(x_, static_cast<std::size_t>(times_) * static_cast<std::size_t>(view_.vertices));
    return {all.begin() + static_cast<std::ptrdiff_t>(time) * view_.vertices,
            all.begin() + static_cast<std::ptrdiff_t>(time + 1) * view_.vertices};
  }
  double medianMilliseconds(int passes) override {
    return medianTime<Device>(queue_, passes, [&] { give(queue_); });
  }
  /// Of the last window, on the device: those of a time together.
  const Vec3* data() const { return x_.data(); }

 private:
  void give(Queue& queue) {
    const SkinMotion of{poses_.data(), turn_.data(), motion_.data(), crease_.data(), move_.data(), x_.data()};
    queue.forEach(times_ * (view_.bends > 0 ? view_.bends : view_.links), TurnJoints{view_, of});
    if (view_.bends > 0) queue.forEach(times_ * (view_.runs + view_.creases), MoveRuns{view_, of});
    queue.forEach(times_ * view_.vertices, MoveVertices{view_, of});
  }

  void flattenBends(const Skin& skin) {
    std::vector<FlatBend> bends;
    for (const SkinBend& b : skin.bends) bends.push_back({b.parent, b.child, b.centre, b.normal, b.offset_m});
    std::vector<FlatRun> runs;
    std::vector<RunBend> run_bends;
    std::vector<double> shares;
    std::vector<int> run_of_vertex(skin.rest.vertices.size(), 0);
    for (const SkinRun& r : skin.runs) {
      FlatRun run{r.begin, r.end,         static_cast<int>(run_bends.size()),
                  0,       view_.motions, static_cast<int>(shares.size())};
      for (std::size_t k = 0; k < r.bends.size(); ++k) {
        run_bends.push_back({r.bends[k], r.partial[k] != 0});
        view_.motions += r.partial[k] != 0;
      }
      ++view_.motions;
      run.last_bend = static_cast<int>(run_bends.size());
      shares.insert(shares.end(), r.share.begin(), r.share.end());
      std::fill(run_of_vertex.begin() + r.begin, run_of_vertex.begin() + r.end, static_cast<int>(runs.size()));
      runs.push_back(run);
    }
    std::vector<int> crease_bend, first{0};
    std::vector<std::vector<VertexCrease>> of_vertex(skin.rest.vertices.size());
    for (const SkinCrease& c : skin.creases) {
      for (std::size_t k = 0; k < c.vertex.size(); ++k)
        of_vertex[static_cast<std::size_t>(c.vertex[k])].push_back(
            {static_cast<int>(crease_bend.size()), c.side[k], c.strength[k]});
      crease_bend.push_back(c.bend);
    }
    std::vector<VertexCrease> creases;
    for (const auto& of : of_vertex) {
      creases.insert(creases.end(), of.begin(), of.end());
      first.push_back(static_cast<int>(creases.size()));
    }
    view_.runs = static_cast<int>(runs.size());
    view_.creases = static_cast<int>(crease_bend.size());
    const auto up = [&](auto& to, const auto& from, auto& at) {
      to = uploaded<Device>(queue_, from);
      at = to.data();
    };
    up(bend_, bends, view_.bend);
    up(run_, runs, view_.run);
    up(run_bend_, run_bends, view_.run_bend);
    up(share_, shares, view_.share);
    up(run_of_vertex_, run_of_vertex, view_.run_of_vertex);
    up(crease_bend_, crease_bend, view_.crease_bend);
    up(first_, first, view_.first_crease);
    up(vertex_crease_, creases, view_.vertex_crease);
  }
  void flattenLinks(const Skin& skin) {
    first_ = uploaded<Device>(queue_, skin.first);
    link_ = uploaded<Device>(queue_, skin.link);
    share_ = uploaded<Device>(queue_, skin.weight);
    view_.first_link = first_.data(), view_.link = link_.data(), view_.weight = share_.data();
  }

  Queue queue_;
  int most_times_, times_ = 1;
  SkinView view_;
  Buffer<Vec3> rest_, x_;
  Buffer<Pose> bind_, poses_, move_;
  Buffer<FlatBend> bend_;
  Buffer<FlatRun> run_;
  Buffer<RunBend> run_bend_;
  Buffer<double> share_;
  Buffer<int> run_of_vertex_, crease_bend_, first_, link_;
  Buffer<VertexCrease> vertex_crease_;
  Buffer<skin_bend::Quaternion> turn_;
  Buffer<RunMotion> motion_;
  Buffer<skin_bend::Crease> crease_;
};

}  // namespace gambeson::gpu
