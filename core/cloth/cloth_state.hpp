#pragma once
/// A cloth at one instant, and what an evaluation of its forces writes.

#include <span>
#include <vector>

#include "core/math/aligned.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

/// Where a cloth is, what its laws remember, and how it moves.
struct ClothState {
  std::span<const Vec3> q;          ///< all points [m]
  std::span<const double> inner;    ///< values of the inner unknowns; empty: none, or as they start
  std::span<const double> history;  ///< committed; empty where laws remember nothing
  std::span<const Vec3> v;          ///< velocities of all points [m/s]; for damping alone, else empty
  double elapsed_s = 0;             ///< since the history was committed; infinite in statics, where no time passes

  ClothState() = default;
  ClothState(std::span<const Vec3> points) : q(points) {}     // NOLINT: a cloth without inner unknowns and history
  ClothState(const std::vector<Vec3>& points) : q(points) {}  // NOLINT
  ClothState(std::span<const Vec3> points, std::span<const double> inner_values, std::span<const double> committed,
             std::span<const Vec3> velocities = {}, double elapsed = 0)
      : q(points), inner(inner_values), history(committed), v(velocities), elapsed_s(elapsed) {}
};

/// A point of a cloth that remembers: its place, and where in the history its numbers stand, `count` of them `stride`
/// apart.
struct HistoryPlace {
  int patch = 0;
  Vec2 place;
  std::size_t first = 0, count = 0, stride = 1;
};

/// Which parts of the force to evaluate; the three add up to it. `steepest` takes each law at its steepest slope,
/// without history: what the stable time step must allow for.
struct ForceTerms {
  bool membrane = true, bending = true, seams = true;
  bool steepest = false;
  /// Of a tangent: positive semidefinite for positive slopes of the laws, in each element by itself. Of what membranes
  /// carry only the tension stiffens, and what folds and seams carry does not turn.
  bool definite = false;
};

/// Energy of a cloth [J]: what it holds, and what its laws have lost since their history was committed. Of damping, the
/// power that it takes [W], at least 0.
struct ClothEnergy {
  double stored = 0, lost = 0, power_W = 0;
};

/// What an evaluation writes.
struct ClothForce {
  std::span<Vec3> points;     ///< - dE/dq [N]
  std::span<double> inner;    ///< conjugate to the rates of the inner unknowns
  std::span<double> history;  ///< what the laws would remember; empty: not asked
  ClothEnergy* energy = nullptr;
};

/// Scratch of a cloth; nobody else reads it.
struct ClothWork {
  AlignedVector<double> slots, lane_energy, lane_lost, tangent_slots;
  std::vector<ClothWork> parts;  ///< of cloths that are made of several
};

}  // namespace gambeson
