#pragma once
/// Angles at the boundaries.

#include <numbers>

namespace gambeson {

inline constexpr double rad_per_deg = std::numbers::pi / 180;

}  // namespace gambeson
