#include "core/contact/bluntness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/contact/sharp.hpp"
#include "core/math/parallel.hpp"

namespace gambeson {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kHorizons = 3;        ///< what counts as blunt is expected to stay so for so many
constexpr double kLeastRoom_m = 2e-5;  ///< and by more than this
constexpr double kRounding = 1e-6;     ///< of sines, far more than it is
constexpr int kMeans = 8;              ///< steps towards the shortest mean

}  // namespace

Bluntness::Bluntness(const ContactMesh& mesh, std::span<const char> deforms) {
  for (int e = 0; e < static_cast<int>(mesh.edges.size()); ++e)
    if (deforms[mesh.edges[e][0]]) edges_.push_back(e);
  if (edges_.empty()) return;
  for (int v = 0; v < mesh.vertex_count; ++v)
    if (deforms[v]) vertices_.push_back(v);
  features_.edge.assign(mesh.edges.size(), 0);
  features_.vertex.assign(mesh.vertex_count, 0);
  way_m_.assign(mesh.edges.size(), 0);
  edge_room_m_.assign(mesh.edges.size(), kNever);
  corner_room_m_.assign(mesh.vertex_count, kNever);
}

/// How far the vectors of all edges of its faces may change while the edge stays blunt; negative where it is not.
double Bluntness::edgeRoom(const ContactMesh& mesh, std::span<const Vec3> x, int edge) const {
  const std::span<const int> faces = mesh.edge_faces[edge];
  if (faces.size() != 2) return -1;
  const auto [a, b] = mesh.edges[edge];
  const Vec3 e = x[b] - x[a];
  const double e2 = norm2(e);
  Vec3 sum{};
  double slope = 0;
  for (int t : faces) {
    Vec3 f{};
    for (int c : mesh.triangles[t])
      if (c != a && c != b) f = x[c] - x[a];
    const Vec3 h = f - (dot(f, e) / e2) * e;
    const double height = norm(h);
    sum += h / height;
    slope += 2 * (1 + std::sqrt(norm2(f) / e2)) / height;
  }
  const double room = (2 * kSharpEdge - norm(sum) - kRounding) / slope;
  return std::isfinite(room) ? room : -1;
}

/// How far the vectors of the edges that end at a vertex may change while its corner stays blunt; negative where it is
/// not known to be.
double Bluntness::cornerRoom(const ContactMesh& mesh, std::span<const Vec3> x, int vertex) const {
  const std::span<const int> around = mesh.vertex_edges[vertex];
  if (around.empty()) return -1;
  Vec3 mean{};
  double shortest2 = kNever;
  const auto along = [&](int e) {
    const auto [a, b] = mesh.edges[e];
    return a == vertex ? x[b] - x[a] : x[a] - x[b];
  };
  for (int e : around) {
    const Vec3 d = along(e);
    const double length2 = norm2(d);
    shortest2 = std::min(shortest2, length2);
    mean += d / std::sqrt(length2);
  }
  mean *= 1.0 / static_cast<double>(around.size());
  // Towards whichever edge leads back most, as far as the mean becomes shorter.
  for (int k = 0; k < kMeans && norm2(mean) > 0.01; ++k) {
    double least = kNever;
    Vec3 back{};
    for (int e : around) {
      const Vec3 a = normalized(along(e));
      if (const double s = dot(a, mean); s < least) least = s, back = a;
    }
    const Vec3 way = back - mean;
    mean += std::clamp(-dot(mean, way) / norm2(way), 0.0, 1.0) * way;
  }
  const double room = (kSharpCorner - norm(mean) - kRounding) * 0.5 * std::sqrt(shortest2);
  return std::isfinite(room) ? room : -1;
}

bool Bluntness::holds(std::span<const Vec3> x, std::span<const Vec3> velocity, double time_s) const {
  const int n = static_cast<int>(watched_.size());
  const auto fails = [&](int k) {
    const Watch& w = watched_[k];
    Vec3 d = x[w.b] - x[w.a];
    if (!velocity.empty()) d += time_s * (velocity[w.b] - velocity[w.a]);
    const float dx = static_cast<float>(d.x) - w.x, dy = static_cast<float>(d.y) - w.y,
                dz = static_cast<float>(d.z) - w.z;
    return !(dx * dx + dy * dy + dz * dz <= w.most2);
  };
  return countOf(Each::value, n, fails) == 0;
}

void Bluntness::ask(const ContactMesh& mesh, const ListedMotion& motion, const Box& where) {
  // On straight paths an edge's vector is farthest from where it was at one of the ends.
  if (!watched_.empty() && holds(motion.x, {}, 0) && holds(motion.x, motion.velocity_m_per_s, motion.horizon_s)) return;
  const std::span<const Vec3> x = motion.x;
  const int edge_count = static_cast<int>(edges_.size()), vertex_count = static_cast<int>(vertices_.size());
  const auto inside = [&](int v) { return overlap(Box{x[v], x[v]}, where); };
  forAll(Each::sum, edge_count, [&](int k) {
    const auto [a, b] = mesh.edges[edges_[k]];
    way_m_[edges_[k]] = motion.horizon_s * norm(motion.velocity(b) - motion.velocity(a));
  });
  const auto lasts = [&](double room, double way) { return room > kHorizons * way + kLeastRoom_m; };
  forAll(Each::sum, edge_count, [&](int k) {
    const int e = edges_[k];
    edge_room_m_[e] = kNever;
    features_.edge[e] = 0;
    if (!inside(mesh.edges[e][0]) && !inside(mesh.edges[e][1])) return;
    const double room = edgeRoom(mesh, x, e);
    double way = 0;
    for (int t : mesh.edge_faces[e])
      for (int f : mesh.face_edges[t]) way = std::max(way, way_m_[f]);
    if (!lasts(room, way)) return;
    edge_room_m_[e] = room;
    features_.edge[e] = 1;
  });
  forAll(Each::sum, vertex_count, [&](int k) {
    const int v = vertices_[k];
    corner_room_m_[v] = kNever;
    features_.vertex[v] = 0;
    if (!inside(v)) return;
    const double room = cornerRoom(mesh, x, v);
    double way = 0;
    for (int e : mesh.vertex_edges[v]) way = std::max(way, way_m_[e]);
    if (!lasts(room, way)) return;
    corner_room_m_[v] = room;
    features_.vertex[v] = 1;
  });
  watched_.clear();
  for (int e : edges_) {
    const auto [a, b] = mesh.edges[e];
    double most = std::min(corner_room_m_[a], corner_room_m_[b]);
    for (int t : mesh.edge_faces[e])
      for (int f : mesh.face_edges[t]) most = std::min(most, edge_room_m_[f]);
    if (most == kNever) continue;
    const Vec3 d = x[b] - x[a];
    // Less by the rounding of `holds`.
    most = std::max(0.0, (1 - 1e-6) * most - 1e-6 * norm(d) - 1e-9);
    watched_.push_back({a, b, static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z),
                        static_cast<float>(most * most)});
  }
}

}  // namespace gambeson
