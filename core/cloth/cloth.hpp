#pragma once
/// A cloth as the engine, the recorder and the pages see it. Each kind of cloth is a folder beside this file.
///
/// A cloth has points q [m], of which those that move freely determine the others (FreeMap), and inner unknowns:
/// numbers that no surface sample sees (rotations of edges, directors of a shell). Contact, pictures and tables see its
/// surface samples, x = W q. Its laws may remember: their history is a list of doubles whose size and meaning the cloth
/// owns. A force is a function of the state and of the committed history; the history that it would leave is written
/// aside and becomes the committed one when a step is accepted, never before.

#include <array>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/cloth/bulge.hpp"
#include "core/cloth/cloth_state.hpp"
#include "core/cloth/free_map.hpp"
#include "core/cloth/law_range.hpp"
#include "core/cloth/mounting.hpp"
#include "core/cloth/sewn_rows.hpp"
#include "core/cloth/strain_rows.hpp"
#include "core/cloth/stress.hpp"
#include "core/cloth/surface.hpp"
#include "core/io/patch_layout.hpp"
#include "core/material/fabric.hpp"
#include "core/math/block_matrix.hpp"

namespace gambeson {

/// A patch of a cloth: what has parameters (u, v) of its own.
struct ClothPatch {
  std::string name;                    ///< of the garment's draft; may be empty
  int garment = 0;                     ///< that it belongs to, 0 innermost
  int first_point = 0, end_point = 0;  ///< its points
  Vec2 low, high;                      ///< its range of parameters
  std::array<bool, 4> sewn{};          ///< whether its sides u0, u1, v0, v1 are joined to others
};

/// Two neighbours among the points of a patch.
struct NetEdge {
  int first = 0, second = 0;  ///< points
  double per_length2 = 0;     ///< 1 / (length at rest)^2 [1/m^2]
};

/// The exact stiffness of a cloth on its free points and its inner unknowns. Lives no longer than its cloth.
class ClothTangent {
 public:
  virtual ~ClothTangent() = default;
  /// A block row for each free point, and behind them the rates of the inner unknowns, three in a block (the last
  /// filled up with zeros). Every pair that shares an element is in the sparsity.
  virtual const BlockMatrix& sparsity() const = 0;
  /// Writes K = Tᵀ (d2E/dq2) T, and so on for the inner unknowns, symmetric, with the slopes of the laws at this
  /// history. The same bits for any number of threads.
  virtual void assemble(const ClothState& state, ClothWork& work, BlockMatrix& K,
                        const ForceTerms& terms = {}) const = 0;
  /// Writes the matrix D of Cloth::dampingForce, - Tᵀ f_d = D v, symmetric and positive semi-definite; zeros of cloth
  /// that is not damped. How D changes with positions is left out.
  virtual void assembleDamping(const ClothState& state, ClothWork& work, BlockMatrix& D) const {
    static_cast<void>(state), static_cast<void>(work);
    D = sparsity();
    D.values.assign(9 * D.columns.size(), 0.0);
  }
  /// Adds a stiffness to rates that nothing resists and nothing drives (the spin of a director about itself), so that
  /// an assembled K without mass can be solved: solutions have none of these rates, whatever it is.
  virtual void holdIdle(const ClothState& state, BlockMatrix& K) const {
    static_cast<void>(state), static_cast<void>(K);
  }
};

class Cloth {
 public:
  virtual ~Cloth() = default;

  // What it is made of.
  int points() const { return static_cast<int>(rest().size()); }
  virtual const std::vector<Vec3>& rest() const = 0;  ///< positions of all points at rest [m]
  virtual const FreeMap& map() const = 0;
  virtual const std::vector<ClothPatch>& patches() const = 0;
  /// What its elements are called and counted as: "1,234 control points" (for pages).
  virtual std::string pointName() const = 0;
  /// The instruction set that its elements are computed with.
  virtual std::string kernels() const = 0;
  /// Where a point is, in words: "control point (2, 3) of patch 0".
  virtual std::string describePoint(int point) const = 0;

  /// A place of a patch: what a draft's parameters (u, v) are there. Throws InputError where the patch was not drafted.
  virtual Vec2 placeOfDraft(int patch, Vec2 uv) const = 0;
  virtual int draftPoints() const = 0;  ///< control points of the drafts
  /// Displacements of all points where the control points of the drafts, one after the other, move so.
  virtual std::vector<Vec3> fromDraft(std::span<const Vec3> control) const = 0;

  // What contact, pictures and tables see.
  /// The surface samples. `per_cell` has a number for each patch: samples along each edge of a cell.
  virtual Surface surface(std::span<const int> per_cell) const = 0;
  /// How far the cloth stands out between the samples of that surface.
  virtual Bulges bulges(const Surface& surface, std::span<const int> per_cell) const = 0;
  /// Positions between the samples of that surface, `fineness` times as many along each edge of a cell.
  virtual SparseRows finer(int fineness, std::span<const int> per_cell) const = 0;
  /// A mesh of places all over the cloth, `per_cell` of them along each edge of a cell.
  virtual PlaceMesh placeMesh(int per_cell) const = 0;
  virtual Fabric fabricAt(int patch, Vec2 uv) const = 0;
  virtual double cellAt(int patch, Vec2 uv) const = 0;  ///< the shorter side of the cell at a place [m]
  virtual std::vector<NetEdge> net() const = 0;
  /// The patches as NURBS, for files that hold such; empty for other cloths.
  virtual std::vector<PatchLayout> geometry() const { return {}; }

  // Mass, of all points.
  virtual std::vector<double> areas() const = 0;   ///< ∫ N dA at rest [m^2]
  virtual std::vector<double> masses() const = 0;  ///< ∫ rho N dA [kg]
  /// Masses with the same sum, but no point bears less than `share` of what it would bear on a cloth without cuts.
  virtual std::vector<double> evenedMasses(double share) const { return static_cast<void>(share), masses(); }
  virtual SparseRows consistentMass() const = 0;  ///< ∫ rho N N dA [kg]

  // Forces.
  /// f = - dE/dq, and what else `out` asks for. The same bits for any number of threads.
  virtual void force(const ClothState& state, const ClothForce& out, ClothWork& work,
                     const ForceTerms& terms = {}) const = 0;
  /// The force by laws at their steepest slopes (ForceTerms::steepest); laws that are an energy at a point are as steep
  /// as within these strains.
  virtual void steepForce(const ClothState& state, const ClothForce& out, ClothWork& work, ForceTerms terms,
                          const StrainBox& within) const {
    static_cast<void>(within);
    terms.steepest = true;
    force(state, out, work, terms);
  }
  virtual std::unique_ptr<ClothTangent> tangent() const = 0;

  // Damping by the cloth itself, linear in the velocities of its points; `force` leaves it out.
  virtual bool damps() const { return false; }
  /// f = - D(q) v at the velocities of the state, into out.points, and the power that it takes, v . D v, into
  /// out.energy. To be called where the cloth damps. The same bits for any number of threads.
  virtual void dampingForce(const ClothState& state, const ClothForce& out, ClothWork& work) const {
    static_cast<void>(state), static_cast<void>(work);
    for (Vec3& f : out.points) f = {};
    if (out.energy) *out.energy = {};
  }
  /// Whether motion loses energy in the cloth, to what its laws remember or to damping.
  bool losesEnergy() const { return historySize() > 0 || damps(); }

  // What its laws remember.
  virtual std::size_t historySize() const { return 0; }
  /// Writes the history of cloth that is new. The span has historySize() doubles.
  virtual void startHistory(std::span<double> history) const { static_cast<void>(history); }

  /// Each point that remembers, in the order of the history: what tells the numbers of one garment from those of
  /// another.
  virtual std::vector<HistoryPlace> historyPlaces() const { return {}; }

  // Unknowns that no sample sees. Their rates may be fewer than their values (directors).
  virtual std::size_t innerValues() const { return 0; }
  virtual std::size_t innerRates() const { return 0; }
  int innerBlocks() const { return static_cast<int>((innerRates() + 2) / 3); }  ///< that hold the rates three by three
  virtual void startInner(std::span<double> value) const { static_cast<void>(value); }
  /// Writes the mass of each rate [kg m^2, where the rate is an angular velocity].
  virtual void innerMasses(std::span<double> mass) const { static_cast<void>(mass); }
  /// Whether values are no sums of what their rates did (directors): then `advance` alone says where they go.
  virtual bool turnsInner() const { return false; }
  /// Writes where the values go with these rates in time dt: value + dt rate, but on their manifold.
  virtual void advance(std::span<const double> value, std::span<const double> rate, double dt_s,
                       std::span<double> out) const {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = value[i] + dt_s * rate[i];
  }

  // Strain and stress.
  virtual std::unique_ptr<StressView> stress() const = 0;
  virtual PointState stateAt(const ClothState& state, int patch, Vec2 uv) const = 0;
  /// Norm of the physical curvature, sqrt(k11² + k22² + 2 k12²) [1/m].
  virtual double bendAt(const ClothState& state, int patch, Vec2 uv) const = 0;
  /// Places where the laws are evaluated, for statistics of strain.
  virtual std::vector<std::pair<int, Vec2>> lawPlaces() const = 0;
  /// Whether a fabric without moment when flat is bent at rest, by more than 1e-6 over the length [m].
  virtual bool springsAtRest(double length_m) const = 0;

  // Limits of strain. Throws InputError where this cloth cannot be limited at these points.
  virtual StrainRows strainRows(Mobility mobility, LimitPoints points = LimitPoints::vertices) const = 0;
  /// The stress of the strain limits at a place, from a field that limitStress made [N/m].
  virtual Vec2 limitStressAt(const StrainRows& rows, std::span<const Vec2> field, int patch, Vec2 uv) const = 0;

  /// Seams that steps hold together by projection (core/motion/sewing.hpp), on its points.
  virtual SewnRows sewnRows() const { return {}; }

  // Supports and loads.
  virtual const Mounting& mounting() const = 0;

  /// Takes from the rates what nothing drives and nothing resists there (ClothTangent::holdIdle).
  virtual void dropIdle(std::span<const double> value, std::span<double> rate) const {
    static_cast<void>(value), static_cast<void>(rate);
  }

  /// The strains of its points whose law is an energy at a point; none where it has no such points.
  virtual std::optional<StrainBox> lawStrains(const ClothState& state) const {
    return static_cast<void>(state), std::nullopt;
  }
  /// How many of its points are strained beyond what their law knows.
  virtual LawRange lawRange(const ClothState& state) const { return static_cast<void>(state), LawRange{}; }

  /// The force alone, and the energy stored.
  void force(std::span<const Vec3> q, std::span<Vec3> f, ClothWork& work, double* energy = nullptr,
             const ForceTerms& terms = {}) const {
    ClothEnergy both;
    force(ClothState(q), {f, {}, {}, energy ? &both : nullptr}, work, terms);
    if (energy) *energy = both.stored;
  }
};

}  // namespace gambeson
