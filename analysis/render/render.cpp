#include "analysis/render/render.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/render/overlay.hpp"
#include "analysis/render/passes.hpp"
#include "analysis/render/shot.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

/// A light sheet of paper, a little darker below.
Color backgroundAt(double t) {
  const float f = static_cast<float>(t);
  return {0.992f - 0.034f * f, 0.992f - 0.030f * f, 0.990f - 0.024f * f};
}

struct Linear {
  std::array<float, 256> value;
  Linear() {
    for (int i = 0; i < 256; ++i) value[static_cast<std::size_t>(i)] = linearOfSrgb(float(i) / 255);
  }
};

/// Lays a sub-pixel (encoded colour times coverage) over `c`, both linear. `darker` multiplies the colour.
void over(std::array<float, 3>& c, const unsigned char* p, const Linear& linear, float darker, float strength) {
  if (p[3] == 0) return;
  const float coverage = strength * float(p[3]) / 255;
  for (std::size_t i = 0; i < 3; ++i) {
    const int straight = std::min(255, (255 * p[i] + p[3] / 2) / p[3]);
    c[i] += coverage * (darker * linear.value[static_cast<std::size_t>(straight)] - c[i]);
  }
}

/// Rows of a picture, counted from above: those that are drawn at a time, and of them those that are shown.
struct Strip {
  int drawn_from = 0, drawn_to = 0, from = 0, to = 0;
};

/// Strips of at most some two million pixels, so that a large picture takes no more memory than a screen's; around what
/// is shown, what shadows of corners and folds reach over. A picture as large as a screen is one strip.
std::vector<Strip> stripsOf(int width, int height) {
  constexpr int most_pixels = 2100000, margin = 64;
  if (static_cast<long>(width) * height <= most_pixels) return {{0, height, 0, height}};
  const int rows = std::max(192, most_pixels / width - 2 * margin);
  std::vector<Strip> strips;
  for (int from = 0; from < height; from += rows) {
    const int to = std::min(height, from + rows);
    strips.push_back({std::max(0, from - margin), std::min(height, to + margin), from, to});
  }
  return strips;
}

void compose(const Passes& passes, const Strip& strip, const Overlay& overlay, bool fade, Image& image) {
  constexpr float occlusion_strength = 0.75f;
  const Linear linear;
  const std::size_t w = static_cast<std::size_t>(image.width), h = static_cast<std::size_t>(image.height);
  for (auto y = static_cast<std::size_t>(strip.from); y < static_cast<std::size_t>(strip.to); ++y) {
    const Color paper = backgroundAt(double(y) / double(h));
    const std::array<float, 3> ground{linearOfSrgb(paper.r), linearOfSrgb(paper.g), linearOfSrgb(paper.b)};
    const std::size_t row = static_cast<std::size_t>(strip.drawn_to) - 1 - y;  // the passes start below
    for (std::size_t x = 0; x < w; ++x) {
      const float open = float(passes.occlusion[4 * (row * w + x)]) / 255;
      const float darker = 1 - occlusion_strength * (1 - open);
      const float strength = fade ? fadeAt(overlay, double(x), double(y)) : 1;
      std::array<float, 3> sum{};
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t at = 4 * ((2 * row + k / 2) * 2 * w + 2 * x + k % 2);
        std::array<float, 3> c = ground;
        over(c, &passes.surfaces[at], linear, darker, strength);
        over(c, &passes.arrows[at], linear, 1, 1);
        for (std::size_t i = 0; i < 3; ++i) sum[i] += 0.25f * c[i];
      }
      for (std::size_t i = 0; i < 3; ++i)
        image.rgb[3 * (y * w + x) + i] =
            static_cast<unsigned char>(std::lround(255 * std::clamp(srgbOfLinear(sum[i]), 0.0f, 1.0f)));
    }
  }
}

Beyond beyondOf(const Scene& scene, const Shot& shot, const ColorBar& bar) {
  // The ends themselves are within; a millionth of the range takes up rounding.
  const double slack = 1e-6 * (bar.high - bar.low);
  Beyond b{shot.below, shot.above};
  for (const auto& mesh : scene.meshes)
    for (const double s : mesh.scalars) b.below |= s<bar.low - slack, b.above |= s> bar.high + slack;
  return b;
}

bool finite(const Vec3& a) { return std::isfinite(norm2(a)); }

/// Throws RunError where it cannot be drawn.
void check(const Scene& scene, int width, int height) {
  if (width < 16 || height < 16 || width > 8192 || height > 8192)
    throw RunError("a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                   " pixels is outside 16 .. 8192");
  if (!(norm2(scene.up) > 0) || !finite(scene.up))
    throw RunError("cannot draw: the up direction of the scene is no direction");
  for (std::size_t i = 0; i < scene.arrows.size(); ++i)
    if (!finite(scene.arrows[i].from) || !finite(scene.arrows[i].to))
      throw RunError("cannot draw arrow " + std::to_string(i) + ": it is not finite");
}

}  // namespace

Camera fitted(const Scene& scene, const Shot& shot, int width, int height) {
  check(scene, width, height);
  Camera camera = fitCamera(scene, shot.from, layOut(scene, shot, loadFonts(width, height), width, height).free);
  camera.pixels_per_m *= shot.zoom;
  return camera;
}

Image render(const Scene& scene, int width, int height) {
  const Shot shot{scene.view};
  return render(scene, shot, fitted(scene, shot, width, height), width, height);
}

Image render(const Scene& scene, const Shot& shot, const Camera& camera, int width, int height) {
  check(scene, width, height);
  const ColorBar bar = scene.bar ? effective(*scene.bar) : ColorBar{};
  const Fonts fonts = loadFonts(width, height);
  const Overlay overlay = layOut(scene, shot, fonts, width, height);

  PassInput in;
  in.camera = camera;
  in.colors = makeColorTable();
  const double pixel_m = 1 / in.camera.pixels_per_m;
  in.arrow_radius_m = 3.2 * overlay.unit * pixel_m;
  in.surfaces = drawListOf(scene.meshes, in.camera, bar.low, bar.high, std::max(1.8 * overlay.unit, 1.5) * pixel_m);
  if (!scene.bar)
    for (auto& v : in.surfaces.vertices) v.mapped = 0;
  for (const Arrow& a : scene.arrows)
    addArrow(in.arrows, in.camera.toCamera(a.from), in.camera.toCamera(a.to), in.arrow_radius_m, a.color);
  if (overlay.legend.width() > 0) {
    const double y = overlay.legend.bottom - 0.35 * fonts.text.size(), x = overlay.legend.left;
    const Color color = scene.arrows.empty() ? Arrow{}.color : scene.arrows.front().color;
    const Vec3 from = in.camera.fromPixel(x, y, 0), to = from + Vec3{scene.arrow_legend_length_m, 0, 0};
    addArrow(in.legend, from, to, in.arrow_radius_m, color);
  }
  const CameraAxes& axes = in.camera.axes;
  const Vec3 up = normalized(scene.up);
  in.up_camera = {dot(axes.right, up), dot(axes.up, up), dot(axes.towards, up)};
  if (scene.ground_m) in.ground_m = *scene.ground_m - dot(up, in.camera.origin);

  Image image;
  image.width = width, image.height = height;
  image.rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const double centre = in.camera.center_y;
  for (const Strip& strip : stripsOf(width, height)) {
    in.camera.center_y = centre - strip.drawn_from;
    compose(drawPasses(in, width, strip.drawn_to - strip.drawn_from), strip, overlay,
            scene.focus.has_value() || scene.ground_m.has_value(), image);
  }
  drawOverlay(image, scene, shot, overlay, fonts, in.colors, scene.bar ? beyondOf(scene, shot, bar) : Beyond{});
  return image;
}

}  // namespace gambeson
