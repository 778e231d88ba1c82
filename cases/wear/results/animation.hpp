#pragma once
/// A recording as what moves: the links of its human with their shapes or skin, obstacles, and garments.

#include "analysis/animation/scene.hpp"
#include "cases/runs/picture.hpp"
#include "cases/wear/scene/scenario.hpp"
#include "core/io/recording.hpp"

namespace gambeson {

struct AnimationOptions {
  int frames = 0;       ///< at most so many, evenly, the first and the last among them; 0: all
  int color_frame = 0;  ///< of the recording: whose field the garments are coloured by
  PictureField field = PictureField::stress;
  /// Whether a skin that follows its links linearly is a SkinnedMesh: else its vertices move one by one, as those of
  /// skins that bend otherwise do.
  bool skins = true;
};

struct Animation {
  AnimatedScene scene;
  /// Of a SkinnedMesh, which has at most four links a vertex: how far a vertex is from where the recording has it, at
  /// any of the times.
  double skin_error_m = 0;
};

/// Of the recording those that are shown, `most` at most (0: all), evenly, the first and the last among them. Throws
/// RunError where there is none.
std::vector<int> shownFrames(const RecordingReader& recording, int most);

/// How many frames the animation of a recording has where all are shown.
std::size_t animatedFrames(const RecordingReader& recording);

/// The frames of the motion (of dressing, where a run ended before). Colours as in pictures (fieldRange). Throws
/// RunError where there is no frame, or none with that field.
Animation animationOf(const Scenario& scenario, const RecordingReader& recording, const AnimationOptions& options);

}  // namespace gambeson
