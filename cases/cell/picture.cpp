#include "cases/cell/picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/ticks.hpp"
#include "cases/runs/frame_field.hpp"
#include "cases/yarns/design.hpp"
#include "core/error.hpp"
#include "core/yarn/cell_faces.hpp"

namespace gambeson {
namespace {

constexpr Color kWeft{0.80f, 0.50f, 0.26f}, kWarp{0.36f, 0.50f, 0.68f};

int numberOf(const RecordedCell& cell, const std::string& path) {
  const std::vector<PathCase>& paths = cell.definition().paths;
  return static_cast<int>(std::find_if(paths.begin(), paths.end(), [&](const PathCase& p) { return p.name == path; }) -
                          paths.begin());
}

/// Frame 0 is the cell at rest.
int frameOf(const RecordedCell& cell, const std::string& path) {
  if (path.empty()) return 0;
  const int k = numberOf(cell, path);
  if (k >= static_cast<int>(cell.paths().size()) || !cell.paths()[static_cast<std::size_t>(k)].last_frame)
    throw RunError(fmt::format("no shape of the load {} is recorded, which was not walked to its end", path));
  return *cell.paths()[static_cast<std::size_t>(k)].last_frame;
}

const char* wordOf(CellField field) {
  return field == CellField::stress ? "stress" : field == CellField::pressure ? "pressure" : "direction";
}

/// g to the power of k.
Pose power(const Pose& g, int k) {
  Pose p;
  for (; k > 0; --k) p = g * p;
  return p;
}

std::string captionOf(const RecordedCell& cell, const CellPicture& picture) {
  std::string view = viewNames()[static_cast<std::size_t>(picture.view)];
  std::replace(view.begin(), view.end(), '_', ' ');
  const std::string what = picture.field == CellField::stress ? "Stress along the yarns"
                           : picture.field == CellField::pressure
                               ? "Pressure of the warp, which is taken off, on the weft"
                               : "Weft (orange) and warp (blue)";
  const std::string where =
      picture.path.empty()
          ? "at rest"
          : fmt::format("at the end of {}: {}", picture.path,
                        inWords(cell.definition().paths[static_cast<std::size_t>(numberOf(cell, picture.path))].load));
  return fmt::format("{} {}, seen from {}", what, where, view == "above" ? "above" : "the " + view);
}

std::vector<CellPicture> picturesOf(const RecordedCell& cell) {
  constexpr std::size_t kMost = 8;
  const CellCase& c = cell.definition();
  if (c.output.shapes == CellShapesKept::none) return {};
  if (!c.output.pictures.empty()) return c.output.pictures;
  std::vector<CellPicture> pictures(1);
  pictures[0].field = CellField::direction;
  for (std::size_t k = 0; k < std::min(cell.paths().size(), kMost); ++k) {
    if (!cell.paths()[k].last_frame) continue;
    CellPicture& picture = pictures.emplace_back();
    picture.path = c.paths[k].name;
    if (std::holds_alternative<BendingPath>(c.paths[k].load)) picture.view = View::front_right;
  }
  return pictures;
}

}  // namespace

void renderCell(const RecordedCell& cell, const CellPicture& picture, const std::filesystem::path& png) {
  constexpr int kYarns = 4;
  const CellCase& c = cell.definition();
  const WovenYarns yarns = wovenYarns(c);
  const Frame frame = cell.reader().frame(frameOf(cell, picture.path));
  const bool pressed = picture.field == CellField::pressure;
  const Field &shown = fieldOf(frame, pressed ? "pressure" : "stress"), &direction = fieldOf(frame, "direction");
  const std::size_t vertices = frame.positions.size() / 3;
  if (shown.data.size() != vertices || direction.data.size() != vertices)
    throw RunError("a shape of the recording has not one value for each of its vertices");
  const CellFaces faces = facesOf(yarns, cell.loadOf(frame));
  const int fewest = std::min(yarns.weave.warps, yarns.weave.wefts);
  const int repeats = picture.repeats.value_or(std::max(1, (kYarns + fewest - 1) / fewest));

  Scene scene;
  double low = 0, high = 0;
  for (const float s : shown.data) low = std::min(low, 1e-6 * s), high = std::max(high, 1e-6 * s);
  const bool colours = picture.field != CellField::direction;
  if (colours)
    scene.bar = ColorBar{pressed ? "Pressure [MPa]" : "Stress along the yarns [MPa]",
                         low < -0.05 * high ? -roundedUp(-low) : 0, roundedUp(high)};
  for (int i = 0; i < repeats; ++i)
    for (int j = 0; j < repeats; ++j) {
      const Pose place = power(faces.step[along_weft], i) * power(faces.step[along_warp], j);
      for (const int d : {along_weft, along_warp}) {
        if (pressed && d == along_warp) continue;  // it hides where it presses
        RenderMesh mesh;
        mesh.color = d == along_weft ? kWeft : kWarp;
        std::vector<int> index(vertices, -1);
        for (std::size_t v = 0; v < vertices; ++v) {
          if (static_cast<int>(direction.data[v]) != d) continue;
          index[v] = static_cast<int>(mesh.vertices.size());
          mesh.vertices.push_back(place *
                                  Vec3{frame.positions[3 * v], frame.positions[3 * v + 1], frame.positions[3 * v + 2]});
          if (colours) mesh.scalars.push_back(1e-6 * shown.data[v]);
        }
        for (const std::array<int, 3>& t : cell.reader().layout().triangles)
          if (index.at(t[0]) >= 0) mesh.triangles.push_back({index.at(t[0]), index.at(t[1]), index.at(t[2])});
        scene.meshes.push_back(std::move(mesh));
      }
    }
  scene.title = c.name;
  scene.subtitle = captionOf(cell, picture);
  scene.view = picture.view;
  writePng(render(scene, picture.width, picture.height), png);
}

std::vector<Picture> takeCellPictures(const RecordedCell& cell, const std::filesystem::path& folder,
                                      std::vector<std::string>& failures) {
  std::vector<Picture> pictures;
  std::filesystem::create_directories(folder);
  for (const CellPicture& picture : picturesOf(cell)) {
    const std::string name = fmt::format("{:02d}_{}_{}.png", pictures.size() + 1,
                                         picture.path.empty() ? "rest" : picture.path, wordOf(picture.field));
    try {
      renderCell(cell, picture, folder / name);
      pictures.push_back({folder / name, captionOf(cell, picture), ""});
    } catch (const RunError& e) {
      failures.push_back(fmt::format("The picture {} could not be drawn: {}", name, e.what()));
    }
  }
  return pictures;
}

}  // namespace gambeson
