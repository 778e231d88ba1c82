#pragma once
/// What cloth does to a body, as OpenSim applies it to a model of its own: ExternalLoads (.xml) and their data (.mot).

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "analysis/torque.hpp"

namespace gambeson {

/// One ExternalForce: what acts on a body at a point, in OpenSim's ground frame (x forward, y up, z to the right).
struct ExternalLoad {
  std::string body;                               ///< of the OpenSim model
  std::vector<Vec3> force_N, point_m, moment_Nm;  ///< at each time; the moment about the point
};

/// From our world (x forward, y to the left, z up).
inline Vec3 openSimGround(const Vec3& v) { return {v.x, v.z, 0 - v.y}; }

/// The body of OpenSim's models of the whole body (gait2392, Rajagopal 2016 and their kin) that a link of our manikins
/// is; other links keep their name. The head belongs to the torso there.
std::string openSimBody(const std::string& link);

/// Of each body that is touched: the mean force of each window and its moment about the origin of the link's frame (the
/// joint's centre), at the middle of the window, where the motion puts that point. Links that are one body of OpenSim's
/// are summed about the first of them.
std::vector<ExternalLoad> externalLoads(const Human& human, const Motion& motion, double motion_start_s,
                                        std::span<const ContactWindow> windows);

/// Writes `prefix`.xml and `prefix`.mot, each whole or not at all; the .xml names the .mot without a folder. RunError
/// where they cannot be written.
void writeExternalLoads(const std::filesystem::path& prefix, const std::string& name, std::span<const double> time_s,
                        std::span<const ExternalLoad> loads);

}  // namespace gambeson
