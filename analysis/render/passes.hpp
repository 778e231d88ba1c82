#pragma once
/// What is drawn of a picture in each pass, before it is put together.

#include <vector>

#include "analysis/render/colormap.hpp"
#include "analysis/render/geometry.hpp"

namespace gambeson {

/// What to draw, in camera coordinates.
struct PassInput {
  DrawList surfaces, arrows, legend;
  Camera camera;
  Vec3 up_camera;                  ///< the scene's up in camera coordinates
  std::optional<double> ground_m;  ///< height of the ground along up, from the camera's origin
  ColorTable colors;
  double arrow_radius_m = 0;
};

/// Rows from the bottom. Colours are encoded (sRGB) times coverage.
struct Passes {
  int width = 0, height = 0;             ///< of the picture; surfaces and arrows have twice as many pixels each way
  std::vector<unsigned char> surfaces;   ///< RGBA
  std::vector<unsigned char> arrows;     ///< RGBA, the legend's arrow in it
  std::vector<unsigned char> occlusion;  ///< RGBA, r: 255 in the open
};

Passes drawPasses(const PassInput& input, int width, int height);

}  // namespace gambeson
