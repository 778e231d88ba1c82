#pragma once
/// Hashes that do not depend on the order of what is hashed: sums of mixed numbers.

#include <bit>
#include <cstdint>
#include <span>

#include "core/math/parallel.hpp"
#include "gpu/finding/pair.hpp"

namespace gambeson::gpu {

/// Every bit of x changes half of the result's (splitmix64, Steele, Lea and Flood 2014).
inline std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}
inline std::uint64_t mixed(const Pair& p) {
  return mixed(static_cast<std::uint64_t>(static_cast<std::uint32_t>(p.first)) << 32 |
               static_cast<std::uint32_t>(p.second));
}
inline std::uint64_t mixed(const Hit& h) { return mixed(mixed(h.pair) ^ std::bit_cast<std::uint64_t>(h.time)); }

template <class T>
std::uint64_t hashOf(std::span<const T> items) {
  return joined(
      Each::value, static_cast<int>(items.size()), std::uint64_t{0}, [&](int i) { return mixed(items[i]); },
      [](std::uint64_t a, std::uint64_t b) { return a + b; });
}

}  // namespace gambeson::gpu
