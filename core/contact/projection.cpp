#include "core/contact/projection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/contact/contact_rows.hpp"
#include "core/contact/ellipsoid.hpp"
#include "core/contact/rubbing.hpp"
#include "core/error.hpp"
#include "core/math/parallel.hpp"

namespace gambeson {
namespace {

constexpr int kSweeps = 200;           ///< over the bodies of a node
constexpr double kOfTolerance = 1e-8;  ///< of a solve, that a node moves by at the end: nothing but rounding
constexpr double kRounding = 8e-16;    ///< of a coordinate

/// The ellipsoid that a row keeps its sample on.
EllipsoidMetric layered(const Ellipsoid& shape, const RowLayer& layer, double scale) {
  const Vec3& e = shape.semi_axes;
  const double a = std::max({e.x, e.y, e.z}), b = std::min({e.x, e.y, e.z});
  const double grown = (layer.m - layer.beyond_m + layer.beyond_m * (a + b) / (2 * std::sqrt(a * b))) / scale;
  return ellipsoidMetric({e + Vec3{grown, grown, grown}});
}

/// How deep a point is in the surface of a row, negative outside [m], and the way out.
struct Depth {
  double m = 0;
  Vec3 out;
};

/// The surface that a row keeps its sample on, where the obstacle stands at one end of the step.
Depth depthOf(const MethodStep& s, const ContactRow& row, const RowLayer& layer, const Placement& X, const Vec3& x) {
  const Contact& c = row.contact;
  if (const auto* shape = std::get_if<Ellipsoid>(&s.obstacles[c.obstacle].shape)) {
    const GradientFoot foot = footAlongGradient(layered(*shape, layer, X.scale), toLocal(X, x));
    return {X.scale * foot.distance_m, X.rotation * foot.direction};
  }
  const Vec3 normal = X.rotation * transposeTimes(s.start[c.obstacle].rotation, c.normal);
  return {layer.m - dot(x - X * c.local, normal), normal};
}

/// Takes the rows of a node in turn until it stays; returns by how much it still moved [m].
double settleNode(const MethodStep& s, const LayeredRows& all, std::span<const int> of_node, double mass, Vec3& v,
                  MethodWork& m) {
  const double dt = s.dt_s, goal = kOfTolerance * s.parameters.tolerance_m_per_s2 * dt * dt;
  double moved = 0;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    const Vec3 before = v;
    moved = 0;
    double size = 0;
    for (const int i : of_node) {
      const ContactRow& row = all.rows[i];
      const Vec3 x = s.x0[row.contact.sample] + dt * v;
      const Depth end = depthOf(s, row, all.layer[i], s.end[row.contact.obstacle], x);
      if (end.m <= 0 && m.pressed[i] == 0) continue;
      const double start = depthOf(s, row, all.layer[i], s.start[row.contact.obstacle], s.x0[row.contact.sample]).m;
      const double left = std::max(0.0, start - row.target_m_per_s * dt);  // of the depth, for later steps
      const double pressed = std::max(0.0, m.pressed[i] + mass * (end.m - left) / dt);
      const Vec3 normal = pressed > 0 ? m.normal[i] + (pressed - m.pressed[i]) * end.out : Vec3{};
      v += (normal - m.normal[i]) / mass;
      m.pressed[i] = pressed;
      m.normal[i] = normal;
      const Vec3 slip = across(v - row.body_velocity, row.contact.normal);
      const Vec3 rubbed = cutTo(frictionOf(s, row) * pressed, across(m.rubbed[i] - mass * slip, row.contact.normal));
      v += (rubbed - m.rubbed[i]) / mass;
      m.rubbed[i] = rubbed;
      size = std::max(size, std::abs(x.x) + std::abs(x.y) + std::abs(x.z));
    }
    moved = dt * norm(v - before);
    if (moved <= std::max(goal, kRounding * size)) return 0;
  }
  return moved;
}

/// Rows by the free point of their sample: m.by_point, from m.first_of_point on.
void sortByPoint(const MethodStep& s, std::span<const ContactRow> rows, MethodWork& m) {
  const auto pointOf = [&](int i) { return s.WT.columns[s.WT.offsets[rows[i].contact.sample]]; };
  m.by_point.clear();
  for (int i = 0; i < static_cast<int>(rows.size()); ++i)
    if (s.inverse_mass[pointOf(i)] > 0) m.by_point.push_back(i);
  std::stable_sort(m.by_point.begin(), m.by_point.end(), [&](int a, int b) { return pointOf(a) < pointOf(b); });
  m.first_of_point.clear();
  for (int k = 0; k < static_cast<int>(m.by_point.size()); ++k)
    if (k == 0 || pointOf(m.by_point[k]) != pointOf(m.by_point[k - 1])) m.first_of_point.push_back(k);
  m.first_of_point.push_back(static_cast<int>(m.by_point.size()));
}

bool isFlat(const TriangleMesh& mesh) {
  const auto at = [&](const std::array<int, 3>& t, int k) { return mesh.vertices[t[k]]; };
  const std::array<int, 3>& first = mesh.triangles.front();
  const Vec3 normal = normalized(cross(at(first, 1) - at(first, 0), at(first, 2) - at(first, 0)));
  constexpr double kFlat = 1e-9;
  return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const std::array<int, 3>& t) {
    const Vec3 own = cross(at(t, 1) - at(t, 0), at(t, 2) - at(t, 0)), way = at(t, 0) - at(first, 0);
    return norm(cross(own, normal)) <= kFlat * norm(own) && dot(own, normal) > 0 &&
           std::abs(dot(way, normal)) <= kFlat * norm(way);
  });
}

}  // namespace

GradientFoot footAlongGradient(const EllipsoidMetric& e, const Vec3& p) {
  const Vec3 g{p.x * e.inverse2.x, p.y * e.inverse2.y, p.z * e.inverse2.z};
  const double size = norm(g);
  if (!(size > 0)) {
    GradientFoot foot{e.min_axis_m, {}};
    foot.direction[e.smallest] = 1;
    return foot;
  }
  const Vec3 n = g / size;
  const auto over = [&](const Vec3& v) { return Vec3{v.x * e.inverse.x, v.y * e.inverse.y, v.z * e.inverse.z}; };
  // |over(p + k n)|^2 = 1; p lies out of the centre along n, so that B > 0 and the root is the one next to 0.
  const double A = norm2(over(n)), B = dot(over(p), over(n)), C = ellipsoidFunction(e, p);
  return {-C / (B + std::sqrt(std::max(0.0, B * B - A * C))), n};
}

bool Projection::takes(const ContactRow& row) const { return BodyMethod::takes(row) && row.stencil.count == 1; }

void Projection::prepare(const MethodStep& s, const RowLayer& layer, ContactRow& row) const {
  const Placement& X = s.start[row.contact.obstacle];
  const Depth depth = depthOf(s, row, layer, X, s.x0[row.contact.sample]);
  const double share = -std::expm1(-s.dt_s / s.parameters.relaxation_s);
  const double restored = depth.m > 0 ? share * depth.m / s.dt_s : 0;
  row.target_m_per_s = row.contact.gap_m < 0 ? std::min(restored, row.target_m_per_s) : restored;
  row.contact.normal = depth.out;
}

ContactSolve Projection::solve(const MethodStep& s, const LayeredRows& all, std::span<Vec3> velocity,
                               std::span<Vec3> warm, std::span<Vec3> impulses, ContactWork& w, MethodWork& m) const {
  const std::size_t n = all.rows.size();
  m.normal.assign(n, {});
  m.rubbed.assign(n, {});
  m.pressed.assign(n, 0);
  sortByPoint(s, all.rows, m);
  ContactSolve report;
  report.iterations = 1;
  const double left = largestOf(Each::sum, static_cast<int>(m.first_of_point.size()) - 1, 0.0, [&](int k) {
    const std::span<const int> of_node(m.by_point.data() + m.first_of_point[k],
                                       m.by_point.data() + m.first_of_point[k + 1]);
    const int point = s.WT.columns[s.WT.offsets[all.rows[of_node[0]].contact.sample]];
    Vec3 v = velocity[point];
    return settleNode(s, all, of_node, 1 / s.inverse_mass[point], v, m);
  });
  report.residual_m_per_s = left / s.dt_s;
  report.converged = report.residual_m_per_s <= s.parameters.tolerance_m_per_s2 * s.dt_s;
  applyImpulses(s, all.rows, m.normal, m.rubbed, velocity, warm, impulses, w);
  return report;
}

void checkProjection(const SparseRows& WT, std::span<const Obstacle> obstacles) {
  const auto refuse = [](const std::string& why) {
    throw InputError({"", 0, "contact.method"}, why + "; allowed there: together, penalty, forward_increment");
  };
  for (int s = 0; s < WT.rows(); ++s)
    if (WT.offsets[s + 1] - WT.offsets[s] != 1 || WT.values[WT.offsets[s]] != 1)
      refuse(
          "projection moves samples that are points of the cloth, as in cloth of triangles; this cloth's samples "
          "depend "
          "on several points");
  for (const Obstacle& o : obstacles) {
    const auto* mesh = std::get_if<TriangleMesh>(&o.shape);
    if (mesh && (o.deforms || !isFlat(*mesh)))
      refuse(
          fmt::format("projection knows ellipsoids, exact spheres and planes, and \"{}\" is none of these", o.segment));
  }
}

}  // namespace gambeson
