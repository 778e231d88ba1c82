#pragma once
/// Internal forces of a cloth on any device.

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/cloth/cloth.hpp"
#include "gpu/forces/point_motion.hpp"

namespace gambeson::gpu {

/// How the quadratic cells of most cloth are gone through (gpu/forces/quad_kernels.hpp): the same bits.
enum class QuadPath { automatic, tiles, strips };

struct ForceOptions {
  QuadPath path = QuadPath::automatic;
  /// Of tiles and strips: which of the sizes that are compiled (quadSizes); -1: what is quick. The same bits.
  int size = -1;
  int strip_rows = 0;          ///< control points along a strip; 0: what fills the device
  bool general_cells = false;  ///< quadratic cells go the way of all others: the same to rounding, for tests
};

/// Where things stand on the device, for kernels of others. Points carry the weights of control points as their fourth
/// number, which stays as it is.
struct ForceArrays {
  Point4 *free_position, *position;  ///< p; q = T p
  const Point4 *force, *free_force;  ///< f = - dE/dq; T^T f
  Point4 *velocity, *acceleration;   ///< of free points; null before setLoads
};

class Forces {
 public:
  virtual ~Forces() = default;

  virtual int points() const = 0;
  virtual int freePoints() const = 0;
  virtual ForceArrays arrays() = 0;

  virtual void setFree(std::span<const Vec3> p) = 0;
  /// All points, whatever the map T would make of free ones.
  virtual void setPositions(std::span<const Vec3> q) = 0;
  /// As Cloth has it; committed `elapsed_s` ago. Empty: new cloth.
  virtual void setHistory(std::span<const double> committed, double elapsed_s) = 0;

  // Given to the device; nothing waits.
  virtual void placePoints() = 0;  ///< q = T p
  virtual void evaluate() = 0;     ///< f of q, and what the laws would remember
  virtual void freeForces() = 0;   ///< T^T f
  /// What the laws would remember becomes what they do.
  virtual void commitHistory() = 0;

  // What else acts on free points (point_motion.hpp).
  virtual void setLoads(const PointLoads& loads) = 0;
  /// Of the springs that have anchors; a normal of 0 where they pull in all directions.
  virtual void setAnchors(std::span<const Vec3> anchors, std::span<const Vec3> normals) = 0;
  virtual void setVelocities(std::span<const Vec3> v) = 0;
  /// From T^T f and the velocities: accelerations, and the velocities half a step later. Nothing waits.
  virtual void accelerate(const Vec3& air, double half_step_s) = 0;

  // What the device has made; waits.
  virtual std::vector<Vec3> force() = 0;
  virtual std::vector<Vec3> freeForce() = 0;
  virtual std::vector<Vec3> velocity() = 0;
  virtual std::vector<Vec3> acceleration() = 0;
  virtual std::vector<double> history() = 0;  ///< what the laws would remember

  /// Median over so many passes of what one evaluation takes, ten of them in a row without the host [us].
  virtual double medianMicroseconds(int passes) = 0;
};

/// What of a cloth these forces do not carry, in words; none: they carry all.
std::optional<std::string> notCarried(const Cloth& cloth);

/// Both throw RunError that says what is not carried.
std::unique_ptr<Forces> forcesOnReference(const Cloth& cloth, const ForceOptions& options = {});
std::unique_ptr<Forces> forcesOnCuda(const Cloth& cloth, const ForceOptions& options = {});

/// Sizes of tiles and of strips that ForceOptions::size chooses from, as text.
std::vector<std::string> quadSizes(QuadPath path);

}  // namespace gambeson::gpu
