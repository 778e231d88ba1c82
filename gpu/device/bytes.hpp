#pragma once
/// What buffers take.

#include <cstddef>

namespace gambeson::gpu {

template <class... Buffers>
std::size_t bytesOf(const Buffers&... buffers) {
  return (std::size_t{0} + ... + (buffers.size() * sizeof(*buffers.data())));
}

}  // namespace gambeson::gpu
