#pragma once
/// Concurrent cells: a cloth whose law is a cell of yarns, solved at every point (FE² of Feyel, with rods below).

#include <array>

#include "core/material/point_energy.hpp"
#include "core/yarn/cell_bending.hpp"
#include "core/yarn/cell_equilibrium.hpp"

namespace gambeson {

/// W(E, k) = Wm(E) + k . b + 1/2 k . D . k [J/m^2]. Wm is the energy of the flat cell in equilibrium under E, its
/// resultants are what the faces carry (resultantsOf), its slope is condensed from the cell's tangent
/// (membraneTangent). b and D are those of the cell at rest (bendingOf): a lattice bends to cylinders alone, so two
/// curvatures go into the quadratic form of five directions; and what strain does to the rigidity is left out, so that
/// W stays an energy whose forces cost one equilibrium. Yarns slide without friction.
///
/// A point remembers the strain of its last accepted state and the sections there; from these the next equilibrium is
/// sought (changeLoad), so that an answer depends on strain and history alone. Valid: strains under which the cell has
/// a stable equilibrium near the remembered one, curvatures small against 1 / the height of the cell. A point whose
/// cell finds none has NaN, upon which solvers shorten their step. Strains below 1e-13 are the rounding of positions
/// and count as none, so that a sheet at rest, which yarns that slide let move freely, has no force at all. Of statics:
/// nothing bounds its slopes.
class CellEnergy : public PointEnergy {
 public:
  /// Throws InputError as RodCell; key "faces" where these are held, which cannot bend; RunError where the cell at rest
  /// is not stable.
  explicit CellEnergy(const RodCellDesign& design, const EquilibriumOptions& options = {1e-10, 200, 8});

  void evaluate(std::span<const SheetStrain> points, SheetParts parts, std::span<const double> history,
                std::span<double> remembered, std::span<SheetAnswer> out) const override;
  std::string whyNone(const SheetStrain& point, std::span<const double> history) const override;
  std::size_t historySize() const override;
  std::array<double, 36> steepest(const StrainBox& within = StrainBox::all()) const override;

  const RodCell& cell() const { return cell_; }
  const CellBending& bending() const { return bending_; }

 private:
  /// What the point is like that has this history.
  CellLoad remembered(std::span<const double> history, std::vector<Pose>& sections) const;
  void remember(const CellLoad& load, std::span<const Pose> sections, std::span<double> history) const;
  SheetAnswer answer(const SheetStrain& point, SheetParts parts, CellLoad& load, std::vector<Pose>& sections,
                     EquilibriumWork& work) const;

  RodCell cell_;
  EquilibriumOptions options_;
  CellBending bending_;
};

}  // namespace gambeson
