#pragma once
/// From drafted garments to cloth: the one place that knows which class a kind of cloth is.

#include <memory>
#include <span>
#include <string>

#include "cases/cloth/kind.hpp"
#include "core/cloth/cloth.hpp"
#include "core/cloth/draft/garment.hpp"
#include "core/cloth/shell/nurbs_shell.hpp"
#include "core/cloth/triangles/triangle_build.hpp"

namespace gambeson {

/// A garment before it is cloth.
struct ClothSource {
  const Garment& draft;
  ClothModel model;
  const TriangleGarment* mesh = nullptr;  ///< where it was read from a mesh, in place of the draft
  std::string key;                        ///< what is wrong with it is said of this key
};

/// All garments as one cloth, the first innermost: neighbours of one kind together, kinds joined. `shell`: how NURBS
/// cloth is integrated. Throws InputError.
std::unique_ptr<const Cloth> makeCloth(std::span<const ClothSource> sources, const ShellOptions& shell = {});

/// Samples along each edge of a cell, where `asked` are wanted: those of triangles are their vertices.
int samplesPerCell(const ClothModel& model, int asked);

/// What it assumes, for pages.
std::string inWords(const ClothModel& model);

}  // namespace gambeson
