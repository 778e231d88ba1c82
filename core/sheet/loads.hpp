#pragma once
/// Loads on a sheet, with the stiffness of those that follow it.

#include <memory>
#include <span>
#include <vector>

#include "core/math/block_matrix.hpp"
#include "core/sheet/cells.hpp"
#include "core/sheet/seams.hpp"

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
std::vector<Vec3> edgeForce(const Garment& garment, const PatchEdge& edge, const Vec3& force_N_per_m);
std::vector<Vec3> surfaceForce(const Garment& garment, int patch, const Vec3& force_N_per_m2);
std::vector<Vec3> pointForce(const Garment& garment, int patch, Vec2 uv, const Vec3& force_N);
/// Weight: ∫ N rho g dA over all patches, with the local surface density.
std::vector<Vec3> weightForce(const Garment& garment, const Vec3& gravity_m_per_s2);

/// All loads of a structure. Programs give the factor of each load at a time.
class Loads {
 public:
  Loads(const Garment& garment, std::vector<DeadLoad> dead, std::vector<PressureLoad> pressure,
        std::vector<EdgeMoment> moments);
  /// Adds the forces on the control points to f. `value[k]` is program k's.
  void add(std::span<const Vec3> q, std::span<const double> value, std::span<Vec3> f) const;
  /// Adds - df/dq, symmetrised, to K on the free points (all pairs of points of a cell are in its pattern).
  void addStiffness(std::span<const Vec3> q, std::span<const double> value, const FreeMap& map, BlockMatrix& K) const;
  bool follow() const;  ///< whether any load has a stiffness

 private:
  struct Point;  ///< a quadrature point of a following load
  std::vector<DeadLoad> dead_;
  std::vector<std::shared_ptr<const Point>> points_;
};

}  // namespace gambeson
