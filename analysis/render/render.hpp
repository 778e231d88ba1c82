#pragma once
/// Off-screen pictures through OSMesa: shaded surfaces, scalar fields with a colour bar, force arrows, named views.

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/math/vec.hpp"

namespace gambeson {

struct Color {
  float r = 0.8f, g = 0.8f, b = 0.8f;
};

/// Triangles with smooth normals (computed where absent). With `scalars` (one per vertex) the colour comes from the scene's
/// colour bar; NaN scalars show the plain colour.
struct RenderMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 3>> triangles;
  std::vector<double> scalars;
  Color color;
  bool edges = false;  ///< draws boundary edges in a darker tone
};

struct Arrow {
  Vec3 from, to;
  Color color{0.85f, 0.1f, 0.1f};
};

/// A perceptually uniform map (viridis-like) from `low` to `high`; values outside are clamped and marked in the bar.
struct ColorBar {
  std::string title;  ///< with unit, "First principal stress resultant [N/m]"
  double low = 0, high = 1;
};

/// front: seen from +x looking to -x, with `up` up ...; the body faces +x, left is +y, up is +z.
enum class View { front, back, left, right, top, front_left, front_right, back_left, back_right };
std::optional<View> viewByName(const std::string& name);
const std::vector<std::string>& viewNames();

struct Scene {
  std::vector<RenderMesh> meshes;
  std::vector<Arrow> arrows;
  std::optional<ColorBar> bar;
  std::string title;                   ///< top left
  std::string subtitle;                ///< below it
  std::string arrow_legend;            ///< "10 N" for an arrow of `arrow_legend_length_m`
  double arrow_legend_length_m = 0;
  View view = View::front_right;
  Vec3 up{0, 0, 1};
  /// What the picture frames: a bounding box; everything where absent.
  std::optional<std::array<Vec3, 2>> focus;
};

struct Image {
  int width = 0, height = 0;
  std::vector<unsigned char> rgb;  ///< rows from the top
};

Image render(const Scene& scene, int width, int height);
/// Writes through a temporary file and renames. Throws RunError.
void writePng(const Image& image, const std::filesystem::path& file);

}  // namespace gambeson
