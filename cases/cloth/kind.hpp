#pragma once
/// Which kind of cloth a garment or a sheet is made into.

#include <optional>

#include "core/cloth/degenerated/degenerated_options.hpp"
#include "core/cloth/draft/bending_elements.hpp"
#include "core/cloth/draft/membrane_elements.hpp"
#include "core/cloth/shell/cell_rule.hpp"
#include "core/cloth/springs/spring_numbers.hpp"
#include "core/cloth/triangles/mesh_kind.hpp"

namespace gambeson {

enum class ClothKind { nurbs, triangles, springs, shell };

/// `model` of a garment or a sheet, with the keys that go with it.
struct ClothModel {
  ClothKind kind = ClothKind::nurbs;
  // Of triangles.
  MeshKind mesh = MeshKind::single;
  BendingElements bending = BendingElements::midedge;
  double bending_spring_N_per_m = 0;  ///< of crossed springs; 0: from the fabric's rigidities
  MembraneModel membrane;
  // Of springs; none: from the fabric.
  std::optional<SpringNumbers> springs;
  // Of the degenerated shell; none: the default.
  std::optional<DegeneratedOptions> shell;
  // Of NURBS; keys of sheets alone.
  CellRule rule = CellRule::automatic;
  int gauss_extra = 0;  ///< points more than degree + 1 in each direction
};

}  // namespace gambeson
