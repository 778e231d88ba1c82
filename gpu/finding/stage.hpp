#pragma once
/// A pass cut into stages: given to queues one after the other, or timed each alone.

#include <algorithm>
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

constexpr int kWarmUp = 3;  ///< passes that are not counted

inline double medianOf(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + static_cast<long>(values.size() / 2));
  return values[values.size() / 2];
}

/// Median time of work() [ms].
template <class Device, class Work>
double medianTime(typename Device::Queue& queue, int passes, const Work& work) {
  std::vector<double> ms;
  for (int k = -kWarmUp; k < passes; ++k) {
    const double took = Device::milliseconds(queue, work);
    if (k >= 0) ms.push_back(took);
  }
  return medianOf(ms);
}

/// The same of what give() puts into the queue, recorded and replayed.
template <class Device, class Give>
double medianReplay(typename Device::Queue& queue, int passes, const Give& give) {
  typename Device::Replay replay(queue, give);
  return medianTime<Device>(queue, passes, [&] { replay.run(queue); });
}

/// Median times of stages, each alone in passes through all of them [ms].
template <class Device>
std::vector<double> medianTimes(typename Device::Queue& queue, int passes, const Stages<Device>& stages) {
  std::vector<std::vector<double>> ms(stages.size());
  for (int k = -kWarmUp; k < passes; ++k)
    for (std::size_t i = 0; i < stages.size(); ++i) {
      const double took = Device::milliseconds(queue, [&] { stages[i].work(queue); });
      if (k >= 0) ms[i].push_back(took);
    }
  std::vector<double> medians;
  for (const std::vector<double>& of_stage : ms) medians.push_back(medianOf(of_stage));
  return medians;
}

}  // namespace gambeson::gpu
