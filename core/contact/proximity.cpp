#include "core/contact/proximity.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>

#include "core/contact/ellipsoid.hpp"
#include "core/contact/mesh_surface.hpp"
#include "core/error.hpp"
#include "core/math/parallel.hpp"

namespace gambeson {

namespace {

constexpr ContactKind kOnBody = ContactKind::sample_on_body;

/// Consecutive samples are neighbours on the cloth: whole blocks of them are culled at once.
constexpr int kBlock = 16;
/// A reject must be certain in spite of rounding.
constexpr double kSlack = 1 + 1e-9;

/// A shape ready for queries, and its box in its own frame. Of a mesh that deforms nothing is known before its
/// vertices.
struct Prepared {
  std::variant<EllipsoidMetric, MeshSurface, std::monostate> shape;
  Box local;
};

Prepared prepare(const Obstacle& obstacle) {
  const Shape& shape = obstacle.shape;
  if (obstacle.deforms) {
    meshTopology(std::get<TriangleMesh>(shape));  // says what is wrong with it
    return {std::monostate{}, {}};
  }
  if (const auto* e = std::get_if<Ellipsoid>(&shape)) {
    const EllipsoidMetric m = ellipsoidMetric(*e);
    return {m, Box{-m.semi_axes, m.semi_axes}};
  }
  MeshSurface s(std::get<TriangleMesh>(shape));
  const Box b = s.bounds();
  return {std::move(s), b};
}

double component(const Vec3& v) { return std::max({v.x, v.y, v.z}); }

Box worldBox(const Prepared& p, const Placement& X) {
  if (std::holds_alternative<EllipsoidMetric>(p.shape)) return boxAround(p.local.hi, X);
  const Mat3& R = X.rotation;
  const Vec3 l = p.local.halfSize();
  Vec3 h;
  for (int i = 0; i < 3; ++i)
    h[i] = X.scale * (std::abs(R.a[i]) * l.x + std::abs(R.b[i]) * l.y + std::abs(R.c[i]) * l.z);
  const Vec3 c = X * p.local.centre();
  // Larger by the rounding of the placement.
  const Box box{c - h, c + h};
  return box.grown(1e-12 * (norm(h) + norm(c)));
}

/// How far a point of the shape can move from start to end: the motion is affine, so a corner of the box moves most.
double motionBound_m(const Box& local, const Placement& start, const Placement& end) {
  if (start == end) return 0;
  double d2 = 0;
  for (int i = 0; i < 8; ++i) d2 = std::max(d2, norm2(end * local.corner(i) - start * local.corner(i)));
  return std::sqrt(d2);
}

bool finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void requireFinite(std::span<const Vec3> x, const char* what) {
  const int n = static_cast<int>(x.size());
  if (countOf(Each::value, n, [&](int i) { return !finite(x[i]); }) == 0) return;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!finite(x[i])) throw RunError(std::string(what) + " of sample " + std::to_string(i) + " is not finite");
}

/// Runs append(block, scratch, list) over all blocks, in their order.
template <class Scratch, class Found, class Append>
void collect(int blocks, std::vector<Found>& out, Append&& append) {
  out.clear();
  appendInOrder(blocks, Each::much, out, [&](int first, int end, std::vector<Found>& list) {
    Scratch scratch;
    for (int b = first; b < end; ++b) append(b, scratch, list);
  });
}

/// Whether points one after the other, each near the last, are inside of a mesh: not as long as they are nearer to a
/// point that is not than the surface is, and where they have to ask, the last foot tells how near the surface is.
struct Beside {
  Vec3 at, foot;
  double clear_m = -1;  ///< `at` is outside by so much; negative: nothing is known yet

  void wayOut(const MeshSurface& surface, const Vec3& p, std::vector<MeshPoint>& inside) {
    if (norm(p - at) < clear_m) return;
    const auto near = clear_m < 0 ? surface.wayOut(p) : surface.wayOut(p, norm(p - foot) * kSlack + 1e-9);
    if (!near) return;
    if (!(near->distance_m > 0)) inside.push_back(*near);
    *this = {p, near->position, std::max(0.0, near->distance_m) * (1 - 1e-9)};
  }
};

/// Of a block of samples.
struct Scratch {
  std::vector<int> obstacles;  ///< that may be near
  std::vector<Beside> beside;  ///< of each obstacle
  std::vector<int> triangles;  ///< of one sample and obstacle
  std::vector<MeshPoint> feet;
};

}  // namespace

struct ProximityQuery::Impl {
  std::vector<Prepared> shapes;
};

ProximityQuery::ProximityQuery(std::span<const Obstacle> obstacles) : impl_(std::make_unique<Impl>()) {
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    try {
      impl_->shapes.push_back(prepare(obstacles[i]));
    } catch (const InputError& e) {
      throw InputError(e.where(), "obstacle " + std::to_string(i) + " (" + obstacles[i].segment + "): " + e.reason());
    }
  }
}
ProximityQuery::~ProximityQuery() = default;
ProximityQuery::ProximityQuery(ProximityQuery&&) noexcept = default;

void ProximityQuery::near(std::span<const Placement> start, std::span<const Placement> end, std::span<const Vec3> x,
                          std::span<const double> reach_m, std::vector<Contact>& out, MeshCandidates* candidates_of,
                          const DeformedSurfaces* deformed) const {
  const auto& shapes = impl_->shapes;
  const int n_obstacles = static_cast<int>(shapes.size()), n = static_cast<int>(x.size());
  assert(static_cast<int>(start.size()) == n_obstacles && static_cast<int>(end.size()) == n_obstacles);
  assert(static_cast<int>(reach_m.size()) == n);
  requireFinite(x, "position");
  if (candidates_of) candidates_of->outside.resize(static_cast<std::size_t>(n_obstacles) * n);
  if (candidates_of && deformed && !deformed->empty())
    candidates_of->outside_of.resize(static_cast<std::size_t>(n_obstacles) * n, 0);
  std::vector<double> motion(n_obstacles);
  std::vector<Box> box(n_obstacles);  // of the shape at start, grown by its motion
  for (int o = 0; o < n_obstacles; ++o) {
    const bool deforms = std::holds_alternative<std::monostate>(shapes[o].shape);
    if (deforms && !deformed) throw std::logic_error("an obstacle deforms and its vertices are not given");
    motion[o] = deforms ? deformed->motion_m(o) : motionBound_m(shapes[o].local, start[o], end[o]);
    box[o] = (deforms ? deformed->of(o).bounds() : worldBox(shapes[o], start[o])).grown(motion[o]);
  }
  // Most samples have nothing to ask of a mesh that deforms: none of its triangles is near, and they are known to be
  // outside.
  const auto listed = [&](int o) { return candidates_of && std::holds_alternative<std::monostate>(shapes[o].shape); };
  const auto asks = [&](int o, int from, int to) {
    const auto outside = candidates_of->outside_of.begin() + static_cast<std::ptrdiff_t>(o) * n;
    return candidates_of->first[from] < candidates_of->first[to] ||
           std::find(outside + from, outside + to, char{0}) != outside + to;
  };
  bool all_listed = true;
  for (int o = 0; o < n_obstacles; ++o) all_listed = all_listed && listed(o);
  collect<Scratch>((n + kBlock - 1) / kBlock, out, [&](int b, Scratch& scratch, std::vector<Contact>& list) {
    const int first = b * kBlock, last = std::min(n, first + kBlock);
    auto& [obstacles, beside, triangles, feet] = scratch;
    Box block;
    if (!all_listed)
      for (int i = first; i < last; ++i) block.add(Box{x[i], x[i]}.grown(reach_m[i] * kSlack));
    obstacles.clear();
    for (int o = 0; o < n_obstacles; ++o)
      if (listed(o) ? asks(o, first, last) : overlap(block, box[o])) obstacles.push_back(o);
    if (obstacles.empty()) return;
    beside.assign(n_obstacles, {});
    // Sample by sample, so that the list comes out sorted.
    for (int i = first; i < last; ++i) {
      for (int o : obstacles) {
        if (listed(o) && !asks(o, i, i + 1)) continue;
        const double r = reach_m[i] * kSlack;
        if (component(maximum(x[i] - box[o].hi, box[o].lo - x[i])) > r) continue;
        const Placement& X = start[o];
        const double limit_m = reach_m[i] + motion[o];
        if (const auto* e = std::get_if<EllipsoidMetric>(&shapes[o].shape)) {
          const Vec3 p = toLocal(X, x[i]);
          if (surelyBeyond(*e, p, limit_m / X.scale)) continue;
          const SurfacePoint s = closestOnEllipsoid(*e, p);
          const double gap = X.scale * s.distance_m;
          if (gap < limit_m) list.push_back({i, o, 0, kOnBody, X.rotation * s.normal, gap, s.position, {}});
        } else if (std::holds_alternative<std::monostate>(shapes[o].shape)) {
          feet.clear();
          const MeshSurface& surface = deformed->of(o);
          if (candidates_of) {
            triangles.clear();
            for (int k = candidates_of->first[i]; k < candidates_of->first[i + 1]; ++k)
              if (candidates_of->items[k].obstacle == o) triangles.push_back(candidates_of->items[k].triangle);
            char& outside = candidates_of->outside_of[static_cast<std::size_t>(o) * n + i];
            if (!triangles.empty()) {
              surface.touching(x[i], limit_m, triangles, feet, outside);
            } else if (!outside) {
              beside[o].wayOut(surface, x[i], feet);
            }
            outside = std::all_of(feet.begin(), feet.end(), [](const MeshPoint& f) { return f.distance_m > 0; });
          } else {
            surface.touching(x[i], limit_m, feet);
          }
          for (const MeshPoint& f : feet)
            if (f.distance_m < limit_m)
              list.push_back({i, o, f.feature, kOnBody, f.normal, f.distance_m, f.position, surface.material(f)});
        } else {
          feet.clear();
          const auto& surface = std::get<MeshSurface>(shapes[o].shape);
          const Vec3 p = toLocal(X, x[i]);
          if (candidates_of) {
            triangles.clear();
            for (int k = candidates_of->first[i]; k < candidates_of->first[i + 1]; ++k)
              if (candidates_of->items[k].obstacle == o) triangles.push_back(candidates_of->items[k].triangle);
            if (triangles.empty()) {
              MeshCandidates::Ball& ball = candidates_of->outside[static_cast<std::size_t>(o) * n + i];
              if (norm(p - ball.centre) < ball.radius) continue;
              const auto foot = surface.wayOut(p);
              if (!foot) continue;
              if (foot->distance_m > 0)
                ball = {p, foot->distance_m * (1 - 1e-9)};
              else
                feet.push_back(*foot);
            } else {
              surface.touching(p, limit_m / X.scale, triangles, feet);
            }
          } else {
            surface.touching(p, limit_m / X.scale, feet);
          }
          for (const MeshPoint& f : feet) {
            const double gap = X.scale * f.distance_m;
            if (gap < limit_m) list.push_back({i, o, f.feature, kOnBody, X.rotation * f.normal, gap, f.position, {}});
          }
        }
      }
    }
  });
}

void ProximityQuery::impacts(std::span<const Placement> start, std::span<const Placement> end, std::span<const Vec3> x0,
                             std::span<const Vec3> x1, std::vector<SampleHit>& out) const {
  const auto& shapes = impl_->shapes;
  const int n_obstacles = static_cast<int>(shapes.size()), n = static_cast<int>(x0.size());
  assert(static_cast<int>(start.size()) == n_obstacles && static_cast<int>(end.size()) == n_obstacles);
  assert(x0.size() == x1.size());
  requireFinite(x0, "position");
  requireFinite(x1, "predicted position");
  out.clear();
  if (std::ranges::none_of(shapes, [](const Prepared& s) { return std::holds_alternative<EllipsoidMetric>(s.shape); }))
    return;
  std::vector<EllipsoidSweep> sweep(n_obstacles);
  for (int o = 0; o < n_obstacles; ++o)
    if (const auto* e = std::get_if<EllipsoidMetric>(&shapes[o].shape)) sweep[o] = sweepOf(*e, start[o], end[o]);
  collect<std::vector<int>>((n + kBlock - 1) / kBlock, out, [&](int b, std::vector<int>& candidates, auto& list) {
    const int first = b * kBlock, last = std::min(n, first + kBlock);
    Box block, starts;
    double step2 = 0;
    for (int i = first; i < last; ++i) {
      starts.add(x0[i]);
      block.add(x1[i]);
      step2 = std::max(step2, norm2(x1[i] - x0[i]));
    }
    block.add(starts);
    const double step = std::sqrt(step2);
    candidates.clear();
    for (int o = 0; o < n_obstacles; ++o) {
      if (!std::holds_alternative<EllipsoidMetric>(shapes[o].shape)) continue;
      if (sweep[o].mayMeet(starts, block, step, start[o].origin)) candidates.push_back(o);
    }
    for (int i = first; i < last && !candidates.empty(); ++i) {
      for (int o : candidates) {
        EllipsoidHit hit;
        if (pathEnters(std::get<EllipsoidMetric>(shapes[o].shape), start[o], toLocal(start[o], x0[i]),
                       toLocal(end[o], x1[i]), hit))
          list.push_back({{i, o, 0, kOnBody, hit.normal, hit.gap_m, hit.local, {}}, hit.time});
      }
    }
  });
}

double ProximityQuery::signedDistance(int obstacle, const Placement& placement, const Vec3& x,
                                      const DeformedSurfaces* deformed) const {
  const Prepared& s = impl_->shapes.at(obstacle);
  if (std::holds_alternative<std::monostate>(s.shape)) {
    if (!deformed) throw std::logic_error("an obstacle deforms and its vertices are not given");
    return nearest(obstacle, x, *deformed).gap_m;
  }
  const Vec3 p = toLocal(placement, x);
  if (const auto* e = std::get_if<EllipsoidMetric>(&s.shape))
    return placement.scale * closestOnEllipsoid(*e, p).distance_m;
  const auto n = std::get<MeshSurface>(s.shape).nearest(p, std::numeric_limits<double>::infinity());
  return n ? placement.scale * n->distance_m : std::numeric_limits<double>::quiet_NaN();
}

Contact ProximityQuery::nearest(int obstacle, const Vec3& x, const DeformedSurfaces& deformed) const {
  const MeshSurface& surface = deformed.of(obstacle);
  const auto n = surface.nearest(x, std::numeric_limits<double>::infinity());
  if (!n) return {-1, obstacle, 0, kOnBody, {}, std::numeric_limits<double>::quiet_NaN(), x, {}};
  return {-1, obstacle, n->feature, kOnBody, n->normal, n->distance_m, n->position, surface.material(*n)};
}

}  // namespace gambeson
