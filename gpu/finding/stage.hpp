#pragma once
/// A pass cut into stages: given to queues one after the other, or timed each alone.

#include <functional>
#include <string>
#include <vector>

namespace gambeson::gpu {

template <class Device>
struct Stage {
  std::string name;
  std::function<void(typename Device::Queue&)> work;
  bool rebuilds = false;  ///< left out where trees are only refitted
};

template <class Device>
using Stages = std::vector<Stage<Device>>;

}  // namespace gambeson::gpu
