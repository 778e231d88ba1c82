#pragma once
/// Recorded motions from files: OpenSim .mot and .sto, .bvh, .trc; a window of time, put on our human and on the
/// ground.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "human/motion/foot_ground.hpp"
#include "human/motion/motion.hpp"

namespace gambeson {

enum class Heading {
  keep,     ///< the recorded path, turned as a whole so that the window's first second faces x
  straight  ///< turns are taken out: the path is unrolled along x
};
enum class Travel {
  file,  ///< the recorded path of the hips
  feet   ///< where the feet take it: the lower foot stands still on the ground (treadmills, walks on the spot)
};

struct MotionFileOptions {
  std::filesystem::path path;
  std::filesystem::path model;         ///< scaled OpenSim model (.osim) of the subject, for markers
  std::string map;                     ///< name of a map that ships, or a file; empty: by the names in the file
  std::optional<double> from_s, to_s;  ///< window in the file's own time; absent: its begin, its end
  double stand_s = 0;                  ///< time at rest, standing
  double lead_in_s = 0.5;              ///< from standing into the window; 0: it starts in the window's first posture
  int repeat = 1;                      ///< a clip of one whole stride is walked this many times
  double slower = 1;                   ///< the file's time times this
  std::optional<double> scale;  ///< of the recorded path; absent: ratio of the legs' lengths, or what the feet say
  /// Height of the ground in the file [m]: the hips stand as high above it as the file says, times the scale. Absent:
  /// the feet are put on the ground.
  std::optional<double> floor_m;
  std::string forward, up;  ///< axes of the file's world, "x", "-y", ...; both or none; empty: those of the map
  Heading heading = Heading::keep;
  Travel travel = Travel::file;
  /// Held on top of what was recorded, so that limbs thicker than the subject's stay apart.
  double hips_apart_rad = 0, arms_apart_rad = 0;
};

/// What was read, for reports.
struct MotionFileNotes {
  std::string map;
  double from_s = 0, to_s = 0;   ///< the window in the file's time
  double window_s = 0;           ///< when it begins in the motion: after standing and lead-in
  double scale = 1;              ///< of the path
  double beyond_limits_deg = 0;  ///< how far a joint goes beyond its limits, and which
  std::string beyond_joint;
  FeetReport feet;  ///< within the window
  std::vector<std::string> lines;
};

/// Throws InputError with file and line.
std::unique_ptr<Motion> loadMotionFile(const MotionFileOptions& options, const Human& human,
                                       MotionFileNotes* notes = nullptr);

}  // namespace gambeson
