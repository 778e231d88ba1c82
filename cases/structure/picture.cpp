/// Detail of results.hpp: pictures of a structure's recorded shapes.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/ticks.hpp"
#include "cases/runs/frame_field.hpp"
#include "cases/structure/results.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

constexpr Color sheet_color{0.42f, 0.50f, 0.62f}, rest_color{0.80f, 0.80f, 0.80f}, obstacle_color{0.74f, 0.73f, 0.72f};

/// Throws InputError where a frame has no such field.
const Field& bodyFieldOf(const Frame& frame, const std::string& name) {
  for (const Field& f : frame.body_fields)
    if (f.name == name) return f;
  throw InputError({"frames", 0, name}, "the frame holds no such field of the obstacles");
}

/// What a picture of a sheet among obstacles frames: the sheet and its rest shape with a margin, in which what it
/// touches is seen, but no more of that than there is.
std::array<Vec3, 2> focusOn(const RenderMesh& sheet, const RenderMesh& rest, const RenderMesh& obstacles) {
  constexpr double kMargin = 0.15;  ///< of the diagonal
  std::vector<Vec3> shown = sheet.vertices;
  shown.insert(shown.end(), rest.vertices.begin(), rest.vertices.end());
  const std::array<Vec3, 2> bare = boxOf(shown, 0);
  std::array<Vec3, 2> focus = boxOf(shown, kMargin * norm(bare[1] - bare[0]));
  shown.insert(shown.end(), obstacles.vertices.begin(), obstacles.vertices.end());
  const std::array<Vec3, 2> all = boxOf(shown, 0);
  for (int k = 0; k < 3; ++k) {
    focus[0][k] = std::max(focus[0][k], all[0][k]);
    focus[1][k] = std::min(focus[1][k], all[1][k]);
  }
  return focus;
}

struct FieldWords {
  const char *field, *title, *word;
  double scale;
};

FieldWords wordsOf(const StructureCase& c, StructureField field) {
  const bool mode = c.kind == StructureKind::modal;
  switch (field) {
    case StructureField::automatic:
      return wordsOf(c, mode ? StructureField::displacement : StructureField::stress);
    case StructureField::stress:
      return {"stress1",
              mode ? "First principal stress resultant / its largest value" : "First principal stress resultant [N/m]",
              "stress", 1};
    case StructureField::strain:
      return {"strain1", mode ? "First principal strain / its largest value" : "First principal strain [%]", "strain",
              mode ? 1. : 100.};
    case StructureField::displacement:
      return {"displacement", mode ? "Displacement / its largest value" : "Displacement [m]", "displacement", 1};
    case StructureField::plain:
      break;
  }
  return {"", "", "shape", 1};
}

std::string placeOf(const StructureCase& c, const Frame& frame) {
  const double at = frameValue(frame);
  return c.kind == StructureKind::statics    ? fmt::format("at load factor {:.4g}", at)
         : c.kind == StructureKind::dynamics ? fmt::format("at {:.4g} s", at)
                                             : fmt::format("of mode {:.0f}", at);
}

std::string captionOf(const StructureCase& c, const Frame& frame, const StructurePicture& picture) {
  std::string view = viewNames()[static_cast<std::size_t>(picture.view)];
  std::replace(view.begin(), view.end(), '_', ' ');
  std::string what = wordsOf(c, picture.field).word;
  what[0] = static_cast<char>(what[0] - 'a' + 'A');
  return fmt::format("{} {}{}, seen from the {}", what, placeOf(c, frame),
                     picture.scale != 1 ? fmt::format(", displacements times {:g}", picture.scale) : "", view);
}

/// What a case without pictures shows: the last shape, or the first four modes.
std::vector<StructurePicture> picturesOf(const StructureCase& c) {
  if (!c.output.pictures.empty()) return c.output.pictures;
  std::vector<StructurePicture> pictures(1);
  if (c.kind == StructureKind::modal) {
    pictures.resize(static_cast<std::size_t>(std::min(4, c.modal.count)));
    for (std::size_t k = 0; k < pictures.size(); ++k) pictures[k].mode = static_cast<int>(k) + 1;
  }
  return pictures;
}

}  // namespace

void renderStructure(const StructureCase& c, const RecordingLayout& layout, const Frame& frame,
                     const StructurePicture& picture, const std::filesystem::path& png) {
  const FieldWords words = wordsOf(c, picture.field);
  const Field& displacement = fieldOf(frame, "displacement");
  RenderMesh sheet, rest;
  sheet.triangles = rest.triangles = layout.triangles;
  sheet.color = sheet_color;
  rest.color = rest_color;
  sheet.edges = true;
  const std::size_t n = frame.positions.size() / 3;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 x{frame.positions[3 * i], frame.positions[3 * i + 1], frame.positions[3 * i + 2]};
    const Vec3 d{displacement.data[3 * i], displacement.data[3 * i + 1], displacement.data[3 * i + 2]};
    rest.vertices.push_back(x - d);
    sheet.vertices.push_back(x - d + picture.scale * d);
  }
  Scene scene;
  if (picture.field != StructureField::plain) {
    const Field& field = fieldOf(frame, words.field);
    double low = 0, high = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double v = field.components == 1 ? field.data[i]
                                             : std::hypot(double(field.data[3 * i]), double(field.data[3 * i + 1]),
                                                          double(field.data[3 * i + 2]));
      sheet.scalars.push_back(words.scale * v);
      low = std::min(low, words.scale * v);
      high = std::max(high, words.scale * v);
    }
    if (c.kind == StructureKind::modal && high > 0) {
      for (double& v : sheet.scalars) v /= high;
      low /= high;
      high = 1;
    }
    // A small compression beside a large tension is not worth a colour of its own.
    scene.bar = ColorBar{words.title, low < -0.05 * high ? -roundedUp(-low) : 0, roundedUp(high)};
  }
  if (!layout.body_triangles.empty()) {
    RenderMesh obstacles;
    obstacles.triangles = layout.body_triangles;
    obstacles.color = obstacle_color;
    const std::vector<float>& x = bodyFieldOf(frame, "position").data;
    for (std::size_t i = 0; i + 2 < x.size(); i += 3) obstacles.vertices.push_back({x[i], x[i + 1], x[i + 2]});
    if (n > 0) scene.focus = focusOn(sheet, rest, obstacles);
    scene.meshes.push_back(std::move(obstacles));
  }
  scene.meshes.insert(scene.meshes.begin(), std::move(sheet));
  scene.title = c.name;
  scene.subtitle = captionOf(c, frame, picture);
  scene.view = picture.view;
  writePng(render(scene, picture.width, picture.height), png);
}

std::vector<Picture> takeStructurePictures(const StructureCase& c, const std::filesystem::path& results,
                                           const std::filesystem::path& folder, std::vector<std::string>& failures) {
  std::vector<Picture> pictures;
  if (c.output.shapes == ShapesKept::none) return pictures;
  std::filesystem::create_directories(folder);
  const RecordingReader recording(results);
  const int frames = recording.frameCount();
  for (const StructurePicture& picture : picturesOf(c)) {
    const int k = c.kind == StructureKind::modal ? std::min(picture.mode, frames) - 1 : frames - 1;
    if (k < 0) continue;
    const std::string name = fmt::format("{:02d}_{}_{}.png", pictures.size() + 1, wordsOf(c, picture.field).word,
                                         viewNames()[static_cast<std::size_t>(picture.view)]);
    try {
      const Frame frame = recording.frame(k);
      renderStructure(c, recording.layout(), frame, picture, folder / name);
      pictures.push_back({folder / name, captionOf(c, frame, picture), ""});
    } catch (const RunError& e) {
      failures.push_back(fmt::format("The picture {} could not be drawn: {}", name, e.what()));
    }
  }
  return pictures;
}

}  // namespace gambeson
