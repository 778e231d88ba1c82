#pragma once
/// The bilinear degenerated shell of Man 2006 (section 2.3) as a cloth: shell_cell.hpp.
///
/// Its points are the control points of patches of degree 1, its inner unknowns a director at each (directors.hpp):
/// three numbers, whose rates are the three components of a spin, so that a block of rates is a director's. Man's two
/// rotations without drilling are the spins normal to the director; the force on the third, director x dE/d(director),
/// has none about the director, and the mass of all three is the same, so that a spin about the director never begins.
/// Where a tangent without mass is solved that spin is held by a stiffness of its own (ClothTangent::holdIdle), which
/// takes no part in the solution: it is coupled to nothing, and nothing drives it. Of modes it makes one for each
/// director that means nothing, at the frequency of shear through the thickness, the highest of the sheet.
///
/// The fabric's membrane is St. Venant-Kirchhoff, isotropic or orthotropic, with friction in shear or without; it bends
/// by a linear law, `consistent` (D = A t²/12, the thesis's), rigidities of its own or plies, or by any law of
/// core/material/laws/bending_laws.hpp, also one that remembers (shell_law.hpp). Transverse shear has the stiffness
/// factor * A66 in both directions: G t, which is E t/(2 (1 + nu)) of an isotropic sheet. An orthotropic fabric has no
/// transverse moduli of its own; that its shear modulus in the plane stands for both is an assumption. The shape at
/// rest is free of stress where curvature counts from it (hasRestCurvature); else of that in the plane and across
/// alone.

#include <memory>
#include <string>

#include "core/cloth/degenerated/degenerated_options.hpp"
#include "core/cloth/degenerated/directors.hpp"
#include "core/cloth/degenerated/shell_cell.hpp"
#include "core/cloth/patches/patch_cloth.hpp"
#include "core/cloth/slot_gather.hpp"
#include "core/math/instruction_sets.hpp"

namespace gambeson {

/// What a fabric has that such a shell has not, in words; empty where there is nothing. Jamming is left out and is no
/// such thing.
std::string whatShellLacks(const Fabric& fabric);

class DegeneratedShell : public PatchCloth {
 public:
  /// Between the nodes of a draft (nodalDraft). Throws InputError where its fabric is none that such a shell can have,
  /// and where a cell has no area or no normal.
  explicit DegeneratedShell(const Garment& draft, const DegeneratedOptions& options = {})
      : DegeneratedShell(nodalDraft(draft), options) {}
  ~DegeneratedShell() override;

  const std::vector<ShellCell>& cells() const { return cells_; }  ///< of all patches, u fastest
  int firstCell(int patch) const { return first_cell_[static_cast<std::size_t>(patch)]; }
  const Directors& directors() const { return directors_; }
  const ShellKernel& kernel() const { return kernel_; }
  /// Positions and directors of a cell's corners.
  CornerVectors cornersOf(const ShellCell& cell, const ClothState& state) const;
  /// What a cell remembers in a state; `trial`: of the cloth, may be empty.
  CellMemory memoryOf(const ShellCell& cell, const ClothState& state, std::span<double> trial = {}) const;

  std::string pointName() const override { return "points"; }
  std::string kernels() const override { return kOneForAll; }

  /// Lumped by the diagonal of each cell's consistent mass (Man 2006, eq. 2.82; Hinton, Rock and Zienkiewicz 1976).
  std::vector<double> masses() const override { return masses_; }

  using Cloth::force;
  void force(const ClothState& state, const ClothForce& out, ClothWork& work, const ForceTerms& terms) const override;
  std::unique_ptr<ClothTangent> tangent() const override;

  std::size_t historySize() const override { return history_doubles_; }
  std::vector<HistoryPlace> historyPlaces() const override;

  std::size_t innerValues() const override { return 3 * directors_.rest.size(); }
  std::size_t innerRates() const override { return 3 * directors_.rest.size(); }
  bool turnsInner() const override { return true; }
  void startInner(std::span<double> value) const override;
  void innerMasses(std::span<double> mass) const override;
  void advance(std::span<const double> value, std::span<const double> rate, double dt_s,
               std::span<double> out) const override;
  void dropIdle(std::span<const double> value, std::span<double> rate) const override;

  std::unique_ptr<StressView> stress() const override;
  PointState stateAt(const ClothState& state, int patch, Vec2 uv) const override;
  double bendAt(const ClothState& state, int patch, Vec2 uv) const override;
  std::vector<std::pair<int, Vec2>> lawPlaces() const override;
  bool springsAtRest(double length_m) const override;
  /// Of a cell, at a place in it: 0 to 1 in u and v. `total`: curvature with that at rest.
  PointState stateIn(const ShellCell& cell, const ClothState& state, Vec2 within, bool total = false) const;

  const Mounting& mounting() const override { return *mounting_; }

 private:
  DegeneratedShell(const NodalDraft& draft, const DegeneratedOptions& options);
  void buildCells(const DegeneratedOptions& options);
  void buildMasses(const DegeneratedOptions& options);

  ShellKernel kernel_;
  Directors directors_;
  std::vector<ShellCell> cells_;
  std::size_t history_doubles_ = 0;
  std::vector<int> first_cell_{0};  ///< of each patch, one more than there are patches
  std::vector<double> masses_, inertias_;
  SlotGather of_points_, of_directors_;
  std::unique_ptr<const Mounting> mounting_;
};

}  // namespace gambeson
