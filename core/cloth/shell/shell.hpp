#pragma once
/// The NURBS Kirchhoff-Love sheet (Zheng 2013, section 2.2): force, energy and stress of a garment.

#include <optional>
#include <span>
#include <vector>

#include "core/cloth/block_law.hpp"
#include "core/cloth/cloth_state.hpp"
#include "core/cloth/draft/garment.hpp"
#include "core/cloth/draft/seams.hpp"
#include "core/cloth/law_range.hpp"
#include "core/cloth/patches/surface.hpp"
#include "core/cloth/shell/cell_rule.hpp"
#include "core/cloth/shell/point_cells.hpp"
#include "core/cloth/shell/shell_kernel.hpp"
#include "core/cloth/shell/shell_memory.hpp"
#include "core/cloth/shell/weak_seam.hpp"
#include "core/cloth/slot_gather.hpp"
#include "core/cloth/stress.hpp"

namespace gambeson {

/// Cells of one kind, packed, and where what they contribute to the force lies in ClothWork::slots.
struct ShellPart {
  ShellBlock block;
  BlockLaw law;
  long first_slot = 0;
  int cell_count = 0;  ///< the rest of the last group are copies without area
  /// The same cells where their fabric's law is an energy at a point: these instead of the kernels.
  std::optional<PointCells> points;
};

class Shell {
 public:
  /// `gauss_extra` points more than degree + 1 in each direction. Throws InputError on bad geometry or fabric.
  Shell(const Garment& garment, const KernelSet& kernels, int gauss_extra = 0, CellRule rule = CellRule::automatic);

  int controlCount() const { return control_count_; }
  /// f = - dE/dq on the control points [N]; `energy` [J] where not null. The same bits for any number of threads.
  void force(std::span<const Vec3> q, std::span<Vec3> f, ClothWork& work, double* energy = nullptr,
             const ForceTerms& terms = {}) const;
  /// The same of a state with history, and what else `out` asks for.
  /// `within`: what bounds the strains of laws that are an energy at a point, where terms ask for steepest slopes.
  void force(const ClothState& state, const ClothForce& out, ClothWork& work, const ForceTerms& terms,
             const StrainBox& within = StrainBox::all()) const;
  /// The first part of `force` alone: each cell's own contribution, written to work.slots and not yet summed on the
  /// control points. Adds to the energy.
  void cellForces(const ClothState& state, const ClothForce& out, ClothWork& work, const ForceTerms& terms = {},
                  const StrainBox& within = StrainBox::all()) const;
  /// Stress and strain at a point of a patch.
  /// `more_N_per_m` is added to the second Piola-Kirchhoff resultants along weft and warp (of strain limits, say).
  PrincipalStress stressAt(int patch, Vec2 uv, std::span<const Vec3> q, Vec2 more_N_per_m = {}) const;
  /// Strains and resultants at a point of a patch, with the history of the nearest point of its cell.
  PointState stateAt(int patch, Vec2 uv, const ClothState& state) const;
  /// Physical curvature (weft, warp, twist) at a point of a patch, the rest curvature not subtracted [1/m].
  Vec3 curvatureAt(int patch, Vec2 uv, std::span<const Vec3> q) const;
  /// Norm of the physical curvature, sqrt(k11² + k22² + 2 k12²) [1/m]: the same in every frame of the rest surface, so
  /// also where that stands across the weft.
  double bendAt(int patch, Vec2 uv, std::span<const Vec3> q) const;
  /// Of the points whose law is an energy at a point.
  LawRange lawRange(const ClothState& state) const;
  std::optional<StrainBox> lawStrains(const ClothState& state) const;

  const KernelSet& kernels() const { return *kernels_; }
  long gaussPoints() const { return gauss_points_; }
  const Garment& garment() const { return garment_; }

  const std::vector<ShellPart>& parts() const { return parts_; }
  /// The springs along seams, without those that the map T holds.
  const std::vector<HingePoint>& hinges() const { return hinges_; }
  const ShellMemory& memory() const { return memory_; }
  /// What holds weak seams together.
  const std::vector<GapPoint>& gaps() const { return gaps_; }

 private:
  struct Frame;
  /// The derivatives of the rest surface and of q in the parameters, as SurfaceBasis has them, the point itself left
  /// out.
  std::array<std::array<Vec3, 6>, 2> derivativesAt(int patch, Vec2 uv, std::span<const Vec3> q) const;
  Frame frameAt(int patch, Vec2 uv, std::span<const Vec3> q) const;

  Garment garment_;
  const KernelSet* kernels_;
  std::vector<int> offsets_;
  int control_count_ = 0;
  long gauss_points_ = 0;
  std::vector<ShellPart> parts_;
  ShellMemory memory_;
  std::vector<HingePoint> hinges_;
  long hinge_slot_ = 0;             ///< first slot of the hinges
  std::vector<long> hinge_offset_;  ///< of each hinge, in columns
  std::vector<GapPoint> gaps_;
  long gap_slot_ = 0;  ///< first slot of the gaps
  std::vector<long> gap_offset_;
  long slot_count_ = 0;
  SlotGather gather_;
};

}  // namespace gambeson
