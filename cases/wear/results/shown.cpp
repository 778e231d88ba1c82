#include "cases/wear/results/shown.hpp"

#include <fmt/format.h>

#include <map>

#include "cases/runs/frame_field.hpp"
#include "cases/wear/results/measure.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

/// Of the garments in turn.
constexpr std::array<Color, 5> cloth_colors{Color{0.42f, 0.50f, 0.62f}, Color{0.76f, 0.57f, 0.35f},
                                            Color{0.44f, 0.60f, 0.45f}, Color{0.62f, 0.45f, 0.56f},
                                            Color{0.68f, 0.66f, 0.42f}};

}  // namespace

FieldWords fieldWords(PictureField field) {
  switch (field) {
    case PictureField::stress:
      return {"stress", "Stress in the fabric: largest pull [N/m]", "stress in the fabric", 1};
    case PictureField::pressure:
      return {"pressure", "Contact pressure of single points [kPa]", "contact pressure of single points", 1e-3};
    case PictureField::strain:
      return {"strain", "Largest stretch of the fabric [%]", "stretch of the fabric", 100};
    case PictureField::thickness:
      return {"", "Thickness of the cloth at rest [mm]", "thickness of the cloth", 1e3};
    case PictureField::body_pressure:
      return {"", "Largest pressure on the body, mean over {:g} mm [kPa]", "largest pressure on the body", 1e-3};
    case PictureField::set:
      return {"set", "Curvature that is set in the fabric [1/m]", "curvature set in the fabric", 1};
    case PictureField::friction:
      return {"friction_left", "Friction in bending that is left [%]", "friction in bending that is left", 100};
    case PictureField::plain:
      break;
  }
  return {"", "", "the garment", 1};
}

std::vector<double> shownOf(const Scenario& s, const Frame& frame, PictureField field) {
  std::vector<double> shown;
  if (field == PictureField::plain) return shown;
  const FieldWords words = fieldWords(field);
  if (field == PictureField::thickness)
    for (const double h : thicknessOf(s)) shown.push_back(words.scale * h);
  else
    for (const float v : fieldOf(frame, words.field).data) shown.push_back(words.scale * static_cast<double>(v));
  if (shown.size() != static_cast<std::size_t>(s.model->surface.size()))
    throw RunError(fmt::format("the recording has {} values of {} for {} samples", shown.size(), words.word,
                               s.model->surface.size()));
  return shown;
}

std::vector<WornMesh> wornMeshes(const Scenario& s) {
  const Surface& surface = s.model->surface;
  std::map<int, WornMesh> garments;
  std::vector<int> at(static_cast<std::size_t>(surface.size()), -1);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const int garment = s.model->cloth->patches()[static_cast<std::size_t>(surface.triangle_patch[t])].garment;
    WornMesh& mesh = garments[garment];
    std::array<int, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      const int sample = surface.triangles[t][k];
      int& vertex = at[static_cast<std::size_t>(sample)];
      if (vertex < 0) {
        vertex = static_cast<int>(mesh.samples.size());
        mesh.samples.push_back(sample);
      }
      corners[k] = vertex;
    }
    mesh.triangles.push_back(corners);
  }
  std::vector<WornMesh> out;
  for (auto& [garment, mesh] : garments) {
    const auto g = static_cast<std::size_t>(garment);
    const auto& cases = s.definition.garments;
    mesh.name = g < cases.size() && !cases[g].name.empty() ? cases[g].name : "garment";
    mesh.color = cloth_colors[g % cloth_colors.size()];
    out.push_back(std::move(mesh));
  }
  return out;
}

}  // namespace gambeson
