#pragma once
/// Constant arrays on a device.

#include <span>
#include <vector>

namespace gambeson::gpu {

template <class Device, class T>
typename Device::template Buffer<T> uploaded(typename Device::Queue& queue, std::span<const T> from) {
  typename Device::template Buffer<T> to(from.size());
  if (!from.empty()) queue.upload(from, to);
  return to;
}
template <class Device, class T>
typename Device::template Buffer<T> uploaded(typename Device::Queue& queue, const std::vector<T>& from) {
  return uploaded<Device>(queue, std::span<const T>(from));
}

}  // namespace gambeson::gpu
