#pragma once
/// Yarns as rods: core/yarn/rod_cell.hpp.

#include "cases/cell/engine.hpp"
#include "core/yarn/cell_equilibrium.hpp"

namespace gambeson {

class RodEngine : public CellEngine {
 public:
  /// Throws InputError as RodCell.
  RodEngine(const RodCellDesign& design, const EquilibriumOptions& options);

  std::unique_ptr<CellSpecimen> specimen() const override;
  const YarnSurface& surface() const override { return surface_; }
  std::vector<std::string> assumptions() const override;

 private:
  RodCell cell_;
  EquilibriumOptions options_;
  YarnSurface surface_;
};

}  // namespace gambeson
