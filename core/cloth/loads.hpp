#pragma once
/// Loads on a sheet, with the stiffness of those that follow it.

#include <array>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/cloth/free_map.hpp"
#include "core/cloth/patch_edge.hpp"
#include "core/math/block_matrix.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

class Mounting;

/// Dead load: constant forces of the control points at program value 1 [N].
struct DeadLoad {
  std::vector<Vec3> force_N;
  int program = 0;
};
/// Pressure on a patch along its current normal a3, per current area [Pa].
struct PressureLoad {
  int patch = 0;
  double pressure_Pa = 0;
  int program = 0;
};
/// Moment per rest length of an edge about its current tangent (in the sense of the edge), right-handed [N m/m]:
/// virtual work = ∫ m dw ds, dw the rotation of the surface normal about the tangent.
struct EdgeMoment {
  PatchEdge edge;
  double moment_N = 0;
  int program = 0;
};

/// A quadrature point of a following load. `n` is N (pressure only); `d1`, `d2` are the derivatives in u and v of a
/// pressed patch, or along and into the patch at an edge.
struct FollowingPoint {
  std::vector<double> n, d1, d2;
  double weight = 0;  ///< pressure: p du dv [Pa]; moment: m ds [N m]
};

/// The points of one cell or one piece of an edge: they share their columns, points of the cloth.
struct FollowingLoad {
  int program = 0;
  bool pressure = false;
  std::vector<int> columns;
  std::vector<FollowingPoint> points;
  /// What the load does to inner unknowns: constant forces at program value 1 [N m, where they are angles].
  std::vector<std::pair<int, double>> inner{};

  void add(std::span<const Vec3> q, double value, std::span<Vec3> f) const;
  /// Adds - value df_I/dq_J, not symmetrised, to blocks[I * n + J].
  void addStiffness(std::span<const Vec3> q, double value, std::vector<std::array<double, 9>>& blocks) const;
};

/// All loads of a structure. Programs give the factor of each load at a time.
class Loads {
 public:
  /// Takes the loads of a cloth that has `points` points. Throws InputError where a patch, an edge or a program does
  /// not exist, or a number is not finite.
  Loads(const Mounting& mounting, int points, std::vector<DeadLoad> dead, const std::vector<PressureLoad>& pressure,
        const std::vector<EdgeMoment>& moments);
  /// Adds the forces on the points to f. `value[k]` is program k's.
  void add(std::span<const Vec3> q, std::span<const double> value, std::span<Vec3> f) const;
  /// Adds the forces on the inner unknowns.
  void addInner(std::span<const double> value, std::span<double> f) const;
  /// Adds - df/dq, symmetrised, to K on the free points (all pairs of points of a cell are in its sparsity).
  /// What is lost: pressure's is symmetric but for a term on the boundary of the pressed surface, which vanishes
  /// where that is held or closed (Schweizerhof and Ramm 1984); an edge moment's is symmetric where the edge keeps its
  /// direction. Elsewhere Newton converges to the same solution, linearly at the end.
  void addStiffness(std::span<const Vec3> q, std::span<const double> value, const FreeMap& map, BlockMatrix& K) const;
  /// Whether any load has a stiffness.
  bool follow() const { return !following_.empty(); }
  int programs() const { return programs_; }  ///< one more than the largest index in use

 private:
  int point_count_ = 0;
  int programs_ = 0;
  std::vector<DeadLoad> dead_;
  std::vector<std::shared_ptr<const FollowingLoad>> following_;
};

}  // namespace gambeson
