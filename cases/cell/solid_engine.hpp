#pragma once
/// Yarns as solids of hexahedra: core/yarn/solid_cell.hpp.

#include "cases/cell/engine.hpp"
#include "core/yarn/solid_path.hpp"

namespace gambeson {

/// The skins of a cell's yarns as pictures see them. Of a quarter also of its three images, so that it is one repeat.
class SolidSkin {
 public:
  explicit SolidSkin(const SolidCell& cell);
  const YarnSurface& surface() const { return surface_; }
  YarnShape shape(const SolidCell& cell, const SolidCellState& state) const;

 private:
  struct Vertex {
    int node, weft, warp;  ///< of the image that so many glides along either direction make
  };
  void addImage(const SolidCell& cell, int weft, int warp);

  YarnSurface surface_;
  std::vector<Vertex> vertices_;
};

class SolidEngine : public CellEngine {
 public:
  /// Throws InputError as SolidCell. `height_m` divides forces per width into stresses.
  SolidEngine(const SolidCellDesign& design, const SolidLoadOptions& options, double height_m);

  std::unique_ptr<CellSpecimen> specimen() const override;
  const YarnSurface& surface() const override { return skin_.surface(); }
  std::vector<std::string> assumptions() const override;

 private:
  SolidCell cell_;
  SolidLoadOptions options_;
  double height_m_;
  SolidSkin skin_;
};

}  // namespace gambeson
