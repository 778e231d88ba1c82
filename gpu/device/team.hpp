#pragma once
/// Teams: groups that work on one thing and meet at barriers of their own.

#include "core/math/vec.hpp"
#ifdef __CUDACC__
#include <cuda/atomic>
#endif

namespace gambeson::gpu {

/// What another group of the team may have written since this one last looked.
template <class T>
GAMBESON_HD T current(const T& at) {
#ifdef __CUDA_ARCH__
  return __ldcg(&at);
#else
  return at;
#endif
}
GAMBESON_HD inline Vec3 current(const Vec3& at) { return {current(at.x), current(at.y), current(at.z)}; }

/// On the host a team is one group.
template <class Group>
class TeamOf {
 public:
  GAMBESON_HD TeamOf(const Group& group, int rank, int groups, int* arrived)
      : group_(group), rank_(rank), groups_(groups), arrived_(arrived) {}
  GAMBESON_HD int rank() const { return rank_; }
  GAMBESON_HD int groups() const { return groups_; }
  /// What any group of the team wrote before is seen by all of them after. `arrived` is 0 before a run.
  GAMBESON_HD void sync() const {
    group_.sync();
#ifdef __CUDA_ARCH__
    if (groups_ == 1) return;
    if (threadIdx.x == 0) {
      cuda::atomic_ref<int, cuda::thread_scope_device> count(*arrived_);
      const int turn = count.fetch_add(1, cuda::memory_order_acq_rel) / groups_;
      while (count.load(cuda::memory_order_acquire) / groups_ <= turn) {
      }
    }
    group_.sync();
#endif
  }

 private:
  const Group& group_;
  int rank_, groups_;
  int* arrived_;
};

}  // namespace gambeson::gpu
