#pragma once
/// Raw loops of instruments as CSV.

#include <filesystem>
#include <vector>

#include "core/material/fit_stops.hpp"

namespace gambeson {

/// Two columns of a header: curvature_per_cm or curvature_per_m, and moment_gf_cm_per_cm, moment_N or moment_mN; others
/// are left out. Throws InputError with file and line.
std::vector<LoopSample> readLoop(const std::filesystem::path& file);

}  // namespace gambeson
