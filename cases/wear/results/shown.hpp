#pragma once
/// What pictures and animations show of a frame: garments as meshes, and a field as numbers with words.

#include <array>
#include <string>
#include <vector>

#include "analysis/render/render.hpp"
#include "cases/runs/picture.hpp"
#include "cases/wear/scene/scenario.hpp"
#include "core/io/recording.hpp"

namespace gambeson {

inline constexpr Color kBodyColor{0.74f, 0.73f, 0.72f};

struct FieldWords {
  const char *field, *title, *word;
  double scale;  ///< to the unit of the title
};
FieldWords fieldWords(PictureField field);

/// The field at each sample in the unit of its title; empty for `plain`. Throws RunError where the frame has it not.
std::vector<double> shownOf(const Scenario& scenario, const Frame& frame, PictureField field);

/// A garment as a mesh with its samples alone.
struct WornMesh {
  std::string name;          ///< its own, or "garment" where it has none
  std::vector<int> samples;  ///< of the surface, one for each vertex
  std::vector<std::array<int, 3>> triangles;
  Color color;
};
/// Of each garment, innermost first.
std::vector<WornMesh> wornMeshes(const Scenario& scenario);

}  // namespace gambeson
