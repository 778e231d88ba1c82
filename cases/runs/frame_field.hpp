#pragma once
/// What a recorded frame holds, by name.

#include <string>

#include "core/io/recording.hpp"

namespace gambeson {

/// The field of a frame by name; throws RunError where the frame has none.
const Field& fieldOf(const Frame& frame, const std::string& name);

}  // namespace gambeson
