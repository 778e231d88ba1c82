#pragma once
/// From a motion captured from a subject to a motion of our human on our ground.

#include "human/motion/curve.hpp"
#include "human/recorded/captured_motion.hpp"
#include "human/recorded/motion_file.hpp"

namespace gambeson {

/// A clip of one stride walked `times` times: the small difference between its ends is spread over it. Throws
/// InputError where a joint does not come back to within 15 degrees.
CapturedMotion repeated(const CapturedMotion& captured, int times, const Human& human);

/// Window, size, path, ground and lead-in of the options; path, map and model are not looked at. Joints and orientation
/// go through the recorded instants of the window by C² splines of the whole captured motion. The lead-in mixes
/// standing with the motion that leads into the window, time running up from rest: with s from 0 to 1 smoothly (6 s^5 -
/// 15 s^4 + 10 s^3), q = (1 - s) q_stand + s q(t(s)), dt = s dt. Where the file has nothing before the window the
/// motion is continued backwards to rest within some hundredths of a second.
std::unique_ptr<Motion> retarget(const CapturedMotion& captured, const Human& human, const MotionFileOptions& options,
                                 MotionFileNotes& notes);

}  // namespace gambeson
