#pragma once
/// Loads on a sheet, with the stiffness of those that follow it.

#include <memory>
#include <span>
#include <vector>

#include "core/cloth/shell/cells.hpp"
#include "core/cloth/shell/seams.hpp"
#include "core/math/block_matrix.hpp"

namespace gambeson {

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

/// ∫ N t ds along an edge at rest, t [N/m]; ∫ N b dA over a patch at rest, b [N/m^2]; N F at a point. Control points.
/// Total force and moment about any point are those of the load, as the basis sums to 1 and reproduces the rest shape.
std::vector<Vec3> edgeForce(const Garment& garment, const PatchEdge& edge, const Vec3& force_N_per_m);
std::vector<Vec3> surfaceForce(const Garment& garment, int patch, const Vec3& force_N_per_m2);
std::vector<Vec3> pointForce(const Garment& garment, int patch, Vec2 uv, const Vec3& force_N);
/// The same on all patches.
std::vector<Vec3> garmentForce(const Garment& garment, const Vec3& force_N_per_m2);
/// Weight: ∫ N rho g dA over all patches, with the local surface density.
std::vector<Vec3> weightForce(const Garment& garment, const Vec3& gravity_m_per_s2);
/// The same pressure on every patch, each along its own normal.
std::vector<PressureLoad> garmentPressure(const Garment& garment, double pressure_Pa, int program = 0);

/// All loads of a structure. Programs give the factor of each load at a time.
class Loads {
 public:
  /// Throws InputError where a patch, an edge or a program does not exist, or a number is not finite.
  Loads(const Garment& garment, std::vector<DeadLoad> dead, std::vector<PressureLoad> pressure,
        std::vector<EdgeMoment> moments);
  Loads(const Loads&) = default;
  Loads& operator=(const Loads&) = default;
  /// Adds the forces on the control points to f. `value[k]` is program k's.
  void add(std::span<const Vec3> q, std::span<const double> value, std::span<Vec3> f) const;
  /// Adds - df/dq, symmetrised, to K on the free points (all pairs of points of a cell are in its pattern).
  /// What is lost: pressure's is symmetric but for a term on the boundary of the pressed surface, which vanishes
  /// where that is held or closed (Schweizerhof and Ramm 1984); an edge moment's is symmetric where the edge keeps its
  /// direction. Elsewhere Newton converges to the same solution, linearly at the end.
  void addStiffness(std::span<const Vec3> q, std::span<const double> value, const FreeMap& map, BlockMatrix& K) const;
  /// Whether any load has a stiffness.
  bool follow() const { return !elements_.empty(); }
  int programs() const { return programs_; }  ///< one more than the largest index in use

 private:
  struct Point;    ///< a quadrature point of a following load
  struct Element;  ///< those of one cell or one piece of an edge: they share their control points
  int control_count_ = 0;
  int programs_ = 0;
  std::vector<DeadLoad> dead_;
  std::vector<std::shared_ptr<const Element>> elements_;
};

}  // namespace gambeson
