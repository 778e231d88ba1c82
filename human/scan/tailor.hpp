#pragma once
/// Girths of a scan where tailors take them (ISO 8559-1): where the body is widest and narrowest, not at joints.

#include <vector>

#include "human/scan/scan.hpp"

namespace gambeson {

/// "widest hip" (between crotch and waist), "narrowest waist" (between lumbar joint and chest) and "top of thigh_left",
/// "top of thigh_right" (across the leg where the legs part). The scan's body stands in `human.skin->bind`, its crotch
/// at a height of `crotch_m`; `standing` are the link poses of the other posture, which the planes follow.
std::vector<ScanGirth> tailorsGirths(const Human& human, double crotch_m, const std::vector<Pose>& standing);

}  // namespace gambeson
