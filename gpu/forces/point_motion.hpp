#pragma once
/// What acts on free points beside the cloth itself, and the accelerations that follow: gravity, drag, constant forces,
/// springs of supports and stitches (core/motion/forces.cpp).

#include <optional>
#include <string>
#include <vector>

#include "core/motion/model.hpp"
#include "gpu/forces/sliced_rows.hpp"

namespace gambeson::gpu {

/// A spring between the cloth and an anchor, or between two samples of the cloth: with d = row . p (less the anchor)
/// and n the unit normal along which it does not pull, g = k (d - (d . n) n), the force on point i is - row_i g.
struct PointLoads {
  std::vector<double> mass_kg, drag_kg_per_s;
  std::vector<char> held;          ///< points that do not move
  std::vector<Vec3> dead_force_N;  ///< empty: none
  Vec3 gravity_m_per_s2;
  SparseRows springs;                     ///< their rows over free points
  std::vector<double> stiffness_N_per_m;  ///< of each
  int anchored = 0;                       ///< the first springs have an anchor each, the others none
};

/// The loads of a model: its supports' springs first, then its stitches.
PointLoads pointLoads(const Model& model);

/// What of a model's forces is not carried, its cloth included; none: all is.
std::optional<std::string> notCarried(const Model& model);

struct SpringPulls {
  SlicedView row;
  const double* stiffness;
  int anchored;
  const Point4 *position, *anchor, *normal;  ///< of free points; of the anchored springs
  Point4* pull;
  GAMBESON_HD void operator()(int i) const {
    Vec3 d = vec(row.times(i, position));
    if (i < anchored) {
      const Vec3 n = vec(normal[i]);
      d -= vec(anchor[i]);
      d -= dot(d, n) * n;
    }
    const Vec3 g = stiffness[i] * d;
    pull[i] = {g.x, g.y, g.z, 0.0};
  }
};

/// (m + h d) a = f + m g + dead - d (v - air), v the velocity at the half step with what lasts; v becomes v + h a. Held
/// points have a = 0 and v = 0.
struct AcceleratePoints {
  const Point4* force;
  SlicedView pulled;  ///< of each point: the springs that pull at it
  const Point4* pull;
  int springs;
  const double *mass, *drag;
  const char* held;
  const Point4* dead;  ///< null: none
  Vec3 gravity, air;
  double half_step_s;
  Point4 *velocity, *acceleration;
  GAMBESON_HD void operator()(int i) const {
    if (held[i]) {
      velocity[i] = acceleration[i] = {};
      return;
    }
    const Vec3 start = vec(velocity[i]);
    Vec3 f = vec(force[i]);
    if (springs > 0) f -= vec(pulled.times(i, pull));
    f += mass[i] * gravity - drag[i] * (start - air);
    if (dead) f += vec(dead[i]);
    const Vec3 a = f / (mass[i] + drag[i] * half_step_s), v = start + half_step_s * a;
    acceleration[i] = {a.x, a.y, a.z, 0.0};
    velocity[i] = {v.x, v.y, v.z, 0.0};
  }
};

template <class Device>
class PointMotion {
  template <class T>
  using Buffer = typename Device::template Buffer<T>;

 public:
  PointMotion(typename Device::Queue& queue, const PointLoads& loads)
      : springs_(loads.springs.rows()), anchored_(loads.anchored), gravity_(loads.gravity_m_per_s2) {
    const std::size_t n = loads.mass_kg.size();
    put(queue, loads.mass_kg, mass_);
    put(queue, loads.drag_kg_per_s, drag_);
    put(queue, loads.held, held_);
    if (!loads.dead_force_N.empty()) put(queue, points(loads.dead_force_N), dead_);
    put(queue, loads.stiffness_N_per_m, stiffness_);
    velocity_ = Buffer<Point4>(n);
    acceleration_ = Buffer<Point4>(n);
    if (springs_ == 0) return;
    rows_ = SlicedRows<Device>(queue, loads.springs);
    pulled_ = SlicedRows<Device>(queue, transpose(loads.springs));
    pull_ = Buffer<Point4>(static_cast<std::size_t>(springs_));
    anchor_ = Buffer<Point4>(static_cast<std::size_t>(anchored_));
    normal_ = Buffer<Point4>(static_cast<std::size_t>(anchored_));
  }

  /// Of the anchored springs; a normal of 0 where they pull in all directions.
  void setAnchors(typename Device::Queue& queue, std::span<const Vec3> anchors, std::span<const Vec3> normals) {
    if (anchored_ == 0) return;
    queue.uploadLater(std::span<const Point4>(points(anchors)), anchor_);
    queue.uploadLater(std::span<const Point4>(points(normals)), normal_);
  }
  /// The anchored springs' normals, for kernels that set them.
  Point4* normals() { return normal_.data(); }
  void setVelocities(typename Device::Queue& queue, std::span<const Vec3> v) {
    queue.upload(std::span<const Point4>(points(v)), velocity_);
  }

  /// Given to the queue; nothing waits. `force`: of the cloth, on free points.
  void give(typename Device::Queue& queue, const Point4* position, const Point4* force, const Vec3& air,
            double half_step_s) {
    if (springs_ > 0)
      queue.forEach(springs_, SpringPulls{rows_.view(), stiffness_.data(), anchored_, position, anchor_.data(),
                                          normal_.data(), pull_.data()});
    queue.forEach(static_cast<int>(mass_.size()),
                  AcceleratePoints{force, pulled_.view(), pull_.data(), springs_, mass_.data(), drag_.data(),
                                   held_.data(), dead_.size() > 0 ? dead_.data() : nullptr, gravity_, air, half_step_s,
                                   velocity_.data(), acceleration_.data()});
  }
  /// What all springs pull at points that are moved by `y`, from no pull, whatever their normals: for pulled().
  const Point4* pulls(typename Device::Queue& queue, const Point4* y) {
    if (springs_ > 0)
      queue.forEach(springs_, SpringPulls{rows_.view(), stiffness_.data(), 0, y, nullptr, nullptr, pull_.data()});
    return pull_.data();
  }
  /// Of each point the springs that pull at it.
  SlicedView pulled() const { return pulled_.view(); }
  int springs() const { return springs_; }
  Buffer<Point4>& velocity() { return velocity_; }
  Buffer<Point4>& acceleration() { return acceleration_; }

 private:
  static std::vector<Point4> points(std::span<const Vec3> from) {
    std::vector<Point4> to;
    for (const Vec3& v : from) to.push_back({v.x, v.y, v.z, 0.0});
    return to;
  }
  template <class List, class T>
  static void put(typename Device::Queue& queue, const List& from, Buffer<T>& to) {
    to = Buffer<T>(from.size());
    queue.upload(std::span<const T>(from.data(), from.size()), to);
  }

  int springs_, anchored_;
  Vec3 gravity_;
  Buffer<double> mass_, drag_, stiffness_;
  Buffer<char> held_;
  Buffer<Point4> dead_, velocity_, acceleration_, pull_, anchor_, normal_;
  SlicedRows<Device> rows_, pulled_;
};

}  // namespace gambeson::gpu
