#pragma once
/// Off-screen pictures through OSMesa: shaded surfaces, scalar fields with a colour bar, force arrows, named views.

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/math/vec.hpp"

namespace gambeson {

struct Color {
  float r = 0.8f, g = 0.8f, b = 0.8f;
};

/// Triangles with smooth normals (computed where absent: the mean over the triangles at a vertex, weighted by their
/// angle there; vertices are welded by index only, so that a seam may show as a crease). The outside is where the
/// triangles turn anticlockwise; the inside is drawn a little darker. With `scalars` (one per vertex) the colour comes
/// from the scene's colour bar; NaN scalars show the plain colour.
struct RenderMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 3>> triangles;
  std::vector<double> scalars;
  Color color;                ///< sRGB
  bool edges = false;         ///< draws boundary edges (of one triangle only) in a darker tone
  std::vector<Vec3> normals;  ///< one per vertex, or empty
};

struct Arrow {
  Vec3 from, to;
  Color color{0.85f, 0.1f, 0.1f};
};

/// A perceptually uniform map (viridis-like) from `low` to `high`; values outside are clamped and marked in the bar by
/// a pointed end. Where low = high (a field at rest) the range is widened to low .. low + |low|, or 0 .. 1.
struct ColorBar {
  std::string title;  ///< with unit, "First principal stress resultant [N/m]"
  double low = 0, high = 1;
};

/// front: seen from +x looking to -x, with `up` up ...; the body faces +x, left is +y, up is +z. `left` is seen from
/// the body's left. Named pairs are seen from 12 degrees above the horizon, `above` as front_right from 45 degrees, the
/// others exactly along their axis. Where `up` is not z, the body faces +x made orthogonal to `up` (z where `up` is x).
/// All views are orthographic: lengths across the view, the arrow legend's among them, are true.
enum class View { front, back, left, right, top, front_left, front_right, back_left, back_right, above };
std::optional<View> viewByName(const std::string& name);
const std::vector<std::string>& viewNames();

/// The bounding box of points, grown by a margin on all sides.
std::array<Vec3, 2> boxOf(std::span<const Vec3> x, double margin_m);

struct Scene {
  std::vector<RenderMesh> meshes;
  std::vector<Arrow> arrows;
  std::optional<ColorBar> bar;
  std::string title;         ///< top left
  std::string subtitle;      ///< below it
  std::string arrow_legend;  ///< "10 N" for an arrow of `arrow_legend_length_m`
  double arrow_legend_length_m = 0;
  View view = View::front_right;
  Vec3 up{0, 0, 1};
  /// What the picture frames: a bounding box; everything where absent.
  /// What lies outside fades out before it runs into the texts.
  std::optional<std::array<Vec3, 2>> focus;
  /// Height along `up` of a ground with a faint grid (0.5 m) and soft shadow [m]; none where absent.
  std::optional<double> ground_m;
};

struct Image {
  int width = 0, height = 0;
  std::vector<unsigned char> rgb;  ///< rows from the top
};

/// Draws in a core profile of OSMesa, with 4 samples in each of 2 x 2 sub-pixels. The same bits every time on one
/// machine (the software renderer compiles for the processor that it finds). Throws RunError with the reason: no
/// OSMesa context, no font, a scene that is not finite, a size outside 16 .. 8192.
Image render(const Scene& scene, int width, int height);

/// The bytes of a PNG file.
std::string encodePng(const Image& image);
/// Writes through a temporary file and renames. Throws RunError.
void writePng(const Image& image, const std::filesystem::path& file);

}  // namespace gambeson
