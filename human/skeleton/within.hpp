#pragma once
/// A joint's values within its limits.

#include <algorithm>

#include "human/skeleton/skeleton.hpp"

namespace gambeson {

/// The value within the limits that is nearest.
inline double within(const Joint& joint, double value) { return std::clamp(value, joint.lower, joint.upper); }

}  // namespace gambeson
