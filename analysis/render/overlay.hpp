#pragma once
/// Where the texts stand, and what they leave free: a column on the left of wide pictures, bands above and below in
/// others.

#include <string>
#include <vector>

#include "analysis/render/colormap.hpp"
#include "analysis/render/shot.hpp"
#include "analysis/render/text.hpp"

namespace gambeson {

/// Values of the scene's meshes beyond the bar's ends.
struct Beyond {
  bool below = false, above = false;
};

struct Overlay {
  PixelRect free;  ///< for the scene
  std::vector<std::string> title, subtitle, note, bar_title;
  double margin = 0, unit = 1;  ///< unit: 1 at 1100 x 1100 pixels
  PixelRect block_title;        ///< title, subtitle and note
  PixelRect bar;                ///< the bar itself, without its pointed ends
  PixelRect legend;             ///< text and arrow
  bool wide = false;
};

struct Fonts {
  Font title, text, small;
};
/// Fonts for a picture of this size.
Fonts loadFonts(int width, int height);

Overlay layOut(const Scene& scene, const Shot& shot, const Fonts& fonts, int width, int height);

/// The bar's range as drawn: see ColorBar. Throws RunError where it is not finite or high < low.
ColorBar effective(const ColorBar& bar);

/// Draws title, note, bar and the legend's text (its arrow is drawn in the arrows' pass).
void drawOverlay(Image& image, const Scene& scene, const Shot& shot, const Overlay& overlay, const Fonts& fonts,
                 const ColorTable& colors, Beyond beyond);

/// 1 where the scene shows in full, falling to 0 in the texts' zones.
float fadeAt(const Overlay& overlay, double x, double y);

}  // namespace gambeson
