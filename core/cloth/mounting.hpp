#pragma once
/// How supports and loads take hold of a cloth.

#include <span>
#include <string>
#include <vector>

#include "core/cloth/constraint.hpp"
#include "core/cloth/loads.hpp"
#include "core/cloth/patch_edge.hpp"

namespace gambeson {

/// A motion that a support prescribes: displacement at program value 1 [m].
struct Prescribed {
  Vec3 displacement_m;
  int program = -1;
};

/// A place as rows on the points of a cloth, sum_k row[k] x[columns[k]]: its position and its derivatives in u and v.
struct PlaceRow {
  std::vector<int> columns;
  std::vector<double> value, d1, d2;
};

/// Throws InputError (key `name`) unless directions are unit vectors, one or more, and a motion is finite and has a
/// program.
void checkSupport(const std::string& name, std::span<const Vec3> directions, const Prescribed& motion);
/// An equation without terms yet; its program counts only where it moves something.
LinearConstraint supportEquation(const std::string& name, const Vec3& direction, const Prescribed& motion);
/// Throws InputError (key `name`) unless the vector is finite.
void checkFiniteLoad(const Vec3& v, const char* name);

/// What each kind of cloth says of its places and edges, for the supports and loads of a structure. All throw
/// InputError where there is no such patch, place or edge. Lives no longer than its cloth.
class Mounting {
 public:
  virtual ~Mounting() = default;

  virtual PlaceRow place(int patch, Vec2 uv) const = 0;
  /// The derivative of the position along the weft at rest, of length 1 there: its `value` alone.
  virtual PlaceRow weft(int patch, Vec2 uv) const = 0;
  /// The points that hold an edge, and the rows of them beside it into the patch; the whole patch where it has no more.
  virtual std::vector<int> edgePoints(const PatchEdge& edge, int rows = 1) const = 0;
  virtual double edgeLength(const PatchEdge& edge) const = 0;  ///< at rest [m]

  /// Holds (or moves) the components of an edge along `directions` (unit vectors; three orthogonal ones hold it whole).
  virtual std::vector<LinearConstraint> holdEdge(const PatchEdge& edge, std::span<const Vec3> directions,
                                                 const Prescribed& motion) const = 0;
  /// Holds (or moves) a place along directions.
  virtual std::vector<LinearConstraint> holdPlace(int patch, Vec2 uv, std::span<const Vec3> directions,
                                                  const Prescribed& motion) const = 0;
  /// Equations that let the sheet not rotate about the edge.
  virtual std::vector<LinearConstraint> clampEdge(const PatchEdge& edge) const = 0;
  /// Mirror symmetry about the plane through the edge with unit normal `normal`.
  virtual std::vector<LinearConstraint> mirrorEdge(const PatchEdge& edge, const Vec3& normal) const = 0;
  /// All points of the edge move alike along `direction`.
  virtual std::vector<LinearConstraint> tieEdge(const PatchEdge& edge, const Vec3& direction) const = 0;
  /// Turns the directors of an edge by this rotation at program value 1; cloth without directors refuses (InputError).
  virtual std::vector<LinearConstraint> turnEdge(const PatchEdge& edge, const Vec3& turn_rad, int program) const;

  /// Forces on the points [N] of a load per length of an edge [N/m], per area of a patch [N/m^2], at a place [N], and
  /// of the weight under `gravity` [m/s^2].
  virtual std::vector<Vec3> edgeForce(const PatchEdge& edge, const Vec3& force_N_per_m) const = 0;
  virtual std::vector<Vec3> surfaceForce(int patch, const Vec3& force_N_per_m2) const = 0;
  virtual std::vector<Vec3> placeForce(int patch, Vec2 uv, const Vec3& force_N) const = 0;
  virtual std::vector<Vec3> weightForce(const Vec3& gravity_m_per_s2) const = 0;
  /// Loads that follow the sheet: a pressure along the normal of a patch, per current area [Pa]; a moment per rest
  /// length of an edge about its tangent [N m/m].
  virtual std::vector<FollowingLoad> pressure(int patch, double pressure_Pa) const = 0;
  virtual std::vector<FollowingLoad> edgeMoment(const PatchEdge& edge, double moment_N) const = 0;
};

}  // namespace gambeson
