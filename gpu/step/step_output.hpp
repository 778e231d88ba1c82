#pragma once
/// What a step leaves for its ledger: arrays that come to the host while the device goes on.

#include <atomic>
#include <memory>

#include "gpu/step/contact_row.hpp"
#include "gpu/step/step_kernels.hpp"
#include "gpu/step/step_on_device.hpp"

namespace gambeson::gpu {

template <class Device>
class StepOutput final : public StepArrays {
  template <class T>
  using Buffer = typename Device::template Buffer<T>;
  template <class T>
  using HostBuffer = typename Device::template HostBuffer<T>;
  using Queue = typename Device::Queue;

 public:
  /// `held`: forces of free points belong to it.
  StepOutput(int points, bool held)
      : n_(static_cast<std::size_t>(points)), of_points_((held ? 4 : 3) * n_), points_(of_points_), host_(of_points_) {}

  /// Velocities, accelerations, pressures and perhaps forces of the points, one after the other.
  Vec3* points() { return points_.data(); }
  /// Rows that carry something, as many as there is room for.
  CarryingRow* rows() { return rows_.data(); }
  int room() const { return static_cast<int>(rows_.size()); }
  void makeRoom(std::size_t rows) { rows_ = Buffer<CarryingRow>(rows), host_rows_ = HostBuffer<CarryingRow>(rows); }

  /// On their way, with so many rows, behind what `queue` has been given.
  void send(Queue& copies, Queue& queue, std::size_t rows) {
    count_ = rows;
    copies.after(queue);
    copies.downloadLater(points_, of_points_, host_);
    if (rows > 0) copies.downloadLater(rows_, rows, host_rows_);
    copies.set(there_);
  }
  void unpack(StepDone& done) override {
    there_.wait();
    const auto part = [&](std::size_t k, std::vector<Vec3>& to) {
      to.assign(host_.data() + k * n_, host_.data() + (k + 1) * n_);
    };
    part(0, done.velocity), part(1, done.acceleration), part(2, done.pressed);
    if (of_points_ > 3 * n_) part(3, done.free_force);
    done.rows.reserve(count_), done.tractions.reserve(count_), done.impulses.reserve(count_);
    for (std::size_t k = 0; k < count_; ++k) {
      const CarryingRow& r = host_rows_.data()[k];
      done.rows.push_back(contactRow(r.facts, r.stencil, r.touch, r.terms));
      done.tractions.push_back(r.traction);
      done.impulses.push_back(r.impulse);
    }
  }

 private:
  std::size_t n_, of_points_, count_ = 0;
  Buffer<Vec3> points_;
  Buffer<CarryingRow> rows_;
  HostBuffer<Vec3> host_;
  HostBuffer<CarryingRow> host_rows_;
  typename Device::Mark there_;
};

/// As many of them as are under way.
template <class Device>
class StepOutputs {
 public:
  StepOutputs(int points, bool held) : points_(points), held_(held) {}

  /// One that nobody needs any more.
  std::shared_ptr<StepOutput<Device>> next() {
    for (const auto& one : all_) {
      if (one.use_count() > 1) continue;
      std::atomic_thread_fence(std::memory_order_acquire);  // its last user was another thread
      return one;
    }
    return all_.emplace_back(std::make_shared<StepOutput<Device>>(points_, held_));
  }

 private:
  int points_;
  bool held_;
  std::vector<std::shared_ptr<StepOutput<Device>>> all_;
};

}  // namespace gambeson::gpu
