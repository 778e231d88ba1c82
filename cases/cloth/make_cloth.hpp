#pragma once
/// From drafted garments to cloth: the one place that knows which class a kind of cloth is.

#include <memory>
#include <span>
#include <string>

#include "cases/cloth/kind.hpp"
#include "core/cloth/cloth.hpp"
#include "core/cloth/draft/garment.hpp"
#include "core/cloth/draft/mesh_draft.hpp"

namespace gambeson {

/// A garment before it is cloth.
struct ClothSource {
  const Garment& draft;
  ClothModel model;
  const MeshDraft* mesh = nullptr;  ///< where it was read from a mesh, in place of the draft
  std::string key;                  ///< what is wrong with it is said of this key
  bool closed = true;               ///< seams of panels of triangles are closed, or rows close them
};

/// All garments as one cloth, the first innermost: neighbours of one kind together, kinds joined. Throws
/// InputError.
std::unique_ptr<const Cloth> makeCloth(std::span<const ClothSource> sources);

/// A draft as the mesh that cloth of triangles would be made of. Throws InputError.
MeshDraft meshOf(const Garment& draft, const ClothModel& model);

/// Samples along each edge of a cell, where `asked` are wanted (0: as few as the cloth has points): those of triangles
/// are their vertices.
int samplesPerCell(const ClothModel& model, int asked);

/// What it assumes, for pages.
std::string inWords(const ClothModel& model);

/// What takes the place of the fabric's own laws, for pages; empty where nothing does.
std::string ownLawsInWords(const ClothModel& model);

}  // namespace gambeson
