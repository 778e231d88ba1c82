#pragma once
/// Puts elements that know no law but their own numbers into the lanes of a block.

#include <algorithm>
#include <array>
#include <span>
#include <tuple>

#include "core/cloth/slot_gather.hpp"
#include "core/cloth/triangles/triangle_kernel.hpp"

namespace gambeson {

/// `rest(element, real)`: an array of the element's numbers; those of copies (not real) give no stiffness. What the
/// elements contribute to the force, [group][corner][3][lane], has slots from `first_slot` on and is listed in
/// `gather`.
template <class Element, class Rest>
PointBlock packPoints(std::span<const Element> elements, int lanes, long first_slot, SlotGather& gather,
                      const Rest& rest) {
  constexpr auto kCorners = static_cast<int>(std::tuple_size_v<decltype(Element{}.corner)>);
  constexpr auto kNumbers = static_cast<int>(std::tuple_size_v<decltype(rest(Element{}, true))>);
  const int count = static_cast<int>(elements.size());
  PointBlock block;
  block.groups = (count + lanes - 1) / lanes;
  block.corners.resize(static_cast<std::size_t>(kCorners * block.groups * lanes));
  block.rest.resize(static_cast<std::size_t>(kNumbers * block.groups * lanes));
  for (int at = 0; at < block.groups * lanes; ++at) {
    const Element& element = elements[static_cast<std::size_t>(std::min(at, count - 1))];
    const auto numbers = rest(element, at < count);
    const int group = at / lanes, lane = at % lanes;
    for (int i = 0; i < kCorners; ++i) {
      const int corner = element.corner[static_cast<std::size_t>(i)];
      block.corners[static_cast<std::size_t>((group * kCorners + i) * lanes + lane)] = corner;
      if (at < count) gather.add(corner, first_slot + 3L * (group * kCorners + i) * lanes + lane, lanes);
    }
    for (int i = 0; i < kNumbers; ++i)
      block.rest[static_cast<std::size_t>((group * kNumbers + i) * lanes + lane)] =
          numbers[static_cast<std::size_t>(i)];
  }
  return block;
}

}  // namespace gambeson
