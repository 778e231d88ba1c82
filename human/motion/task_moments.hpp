#pragma once
/// Joint moments that people need for a movement, to compare a garment's torque with.

#include <string>
#include <vector>

namespace gambeson {

/// Peak absolute moment [N m] of a task ("Natural" level walking, "Ascending", "Descending" stairs) at a joint
/// (hip_flexion, hip_adduction, knee_flexion, ankle_flexion, with or without _right, _left), in proportion to body
/// mass; Bovi et al. 2011, healthy adults. Throws InputError for what the data lack (hip_rotation, say).
double naturalPeakMoment_Nm(const std::string& task, const std::string& joint, double mass_kg);

/// The mean moment [N m] over a stride of natural walking, own foot strike to foot strike every 2 % (51 values), for
/// hip_flexion, hip_adduction and knee_flexion; extensor and abductor moments are +.
std::vector<double> naturalMoment_Nm(const std::string& joint, double mass_kg);

}  // namespace gambeson
