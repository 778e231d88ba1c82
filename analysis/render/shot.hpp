#pragma once
/// How a scene is taken where its named view is not enough: from anywhere, nearer, by a camera that stays, with a note.

#include "analysis/render/camera.hpp"

namespace gambeson {

/// What a plain colour means, in the legend.
struct ColorNote {
  Color color;
  std::string words;
};

struct Shot {
  Viewpoint from;   ///< in place of the scene's view
  double zoom = 1;  ///< how much larger than what frames the scene's focus
  std::optional<ColorNote> note{};
  /// Marks an end of the bar although nothing in this scene lies beyond it, as other pictures of a film do.
  bool below = false, above = false;
};

/// The camera that frames a scene beside its texts.
Camera fitted(const Scene& scene, const Shot& shot, int width, int height);

/// The picture through a camera, which pictures of a film have in common. Throws as render of a scene alone.
Image render(const Scene& scene, const Shot& shot, const Camera& camera, int width, int height);

}  // namespace gambeson
