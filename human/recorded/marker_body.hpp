#pragma once
/// A body of ellipsoids that markers move directly, segment by segment (Man 2006, section 5.1).

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "human/body/body.hpp"
#include "human/motion/motion.hpp"
#include "human/recorded/captured_motion.hpp"
#include "human/recorded/markers.hpp"
#include "human/skeleton/joint_map.hpp"

namespace gambeson {

/// A segment: where its joints and its marker are in the file, each the mean of the markers named, and its ellipsoid.
struct MarkedSegment {
  std::string name;
  Points J1, J2, M;
  Vec3 semi_axes_m;  ///< along the bone, towards M, across both
};

/// A human whose segments hang on nothing: a link each, with the joints <name>_x, _y, _z [m] and <name>_pitch, _roll,
/// _yaw [rad] after a root that stays. No masses. Throws InputError with the name of the segment where two have one
/// name, where a point names no marker, or where a semi-axis is not above 0.
Human markedHuman(const std::vector<MarkedSegment>& segments);

/// Its motion: at each instant of the file the ellipsoids stand as segmentPose (human/body/segment_ellipsoid.hpp) has
/// them, to rounding: no skeleton comes between. Between the instants C² splines go through positions and angles; the
/// file's first instant is at 0. Angles are those of Ry(pitch) Rx(roll) Rz(yaw), 0 for a bone that points down with M
/// in front: a bone that points along y has none that are its own, and the splines are rough near that. Throws
/// InputError with the name of the marker where one is missing or was not seen, and as segmentPoses does.
std::unique_ptr<Motion> markedMotion(const MarkerTable& table, const std::vector<MarkedSegment>& segments,
                                     const WorldAxes& world);

/// What a file of markers is taken for.
struct MarkersOptions {
  std::filesystem::path path;          ///< .trc
  std::string forward{"x"}, up{"z"};   ///< axes of the file's world, "x", "-y", ...
  std::optional<double> from_s, to_s;  ///< window in the file's own time; absent: its begin, its end
};
/// Reads the file. Throws InputError with file and key, as above too.
std::unique_ptr<Motion> loadMarkers(const MarkersOptions& options, const std::vector<MarkedSegment>& segments);

}  // namespace gambeson
