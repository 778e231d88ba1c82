#pragma once
/// Scans whose joints are known, and what scanners and other bodies do to them.

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "core/contact/obstacle.hpp"
#include "human/character/character.hpp"
#include "unit/human/scan/scan_body.hpp"

namespace gambeson::test {

/// A body as a scanner has it, in metres, and where its joints are in the same axes.
struct KnownScan {
  TriangleMesh mesh;
  std::map<std::string, Vec3> joints;
  std::map<std::string, double> girths;  ///< by zone [m]
};

/// From a manikin's own skin.
inline KnownScan knownScan(const std::string& manikin, double arms_deg, double legs_deg = 0) {
  ScanBody b = scanBody(manikin, arms_deg, 0.02, legs_deg);
  KnownScan out{std::move(b.mesh), std::move(b.joints), std::move(b.girths)};
  for (Vec3& x : out.mesh.vertices) x = 1e-3 * Vec3{x.z, x.x, x.y};
  return out;
}

/// From a character with a rig, whose joints are where the rig's bones begin.
inline KnownScan knownScan(const CharacterOptions& options) {
  const Human h = loadCharacter(options);
  KnownScan out{h.skin->rest, {}, {}};
  for (std::size_t l = 0; l < h.skeleton.links.size(); ++l)
    out.joints[h.skeleton.links[l].name] = h.skin->bind[l].origin;
  for (const GirthPlane& plane : girthPlanes(h, h.skin->bind))
    out.girths[plane.zone] = tapeGirth(bodySection(h, plane, h.skin->bind, h.skin->rest.vertices));
  return out;
}

/// The same map of points for skin and joints.
inline KnownScan moved(KnownScan s, const std::function<Vec3(const Vec3&)>& to) {
  for (Vec3& x : s.mesh.vertices) x = to(x);
  for (auto& [link, x] : s.joints) x = to(x);
  return s;
}

inline KnownScan noisy(KnownScan s, double most_m, unsigned seed = 1) {
  std::mt19937 random(seed);
  const auto one = [&] { return (2.0 * static_cast<double>(random()) / 4294967295.0 - 1) * most_m; };
  for (Vec3& x : s.mesh.vertices) x += Vec3{one(), one(), one()};
  return s;
}

inline KnownScan without(KnownScan s, const std::function<bool(const Vec3&)>& gone) {
  std::erase_if(s.mesh.triangles, [&](const auto& t) {
    return gone((s.mesh.vertices[t[0]] + s.mesh.vertices[t[1]] + s.mesh.vertices[t[2]]) / 3);
  });
  return s;
}

/// With this share of its vertices fewer: edges at random are drawn together to their middles, where no other vertex
/// than the two across them is beside both ends.
inline KnownScan decimated(KnownScan s, double share, unsigned seed = 1) {
  auto& m = s.mesh;
  std::vector<std::vector<std::size_t>> faces(m.vertices.size());
  for (std::size_t t = 0; t < m.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) faces[static_cast<std::size_t>(m.triangles[t][k])].push_back(t);
  const auto beside = [&](int v) {
    std::set<int> out;
    for (const std::size_t t : faces[static_cast<std::size_t>(v)])
      for (int k = 0; k < 3; ++k)
        if (m.triangles[t][k] != v) out.insert(m.triangles[t][k]);
    return out;
  };
  std::mt19937 random(seed);
  std::vector<char> gone(m.triangles.size(), 0), touched(m.vertices.size(), 0);
  std::size_t left = static_cast<std::size_t>(share * static_cast<double>(m.vertices.size()));
  for (std::size_t tries = 0; left > 0 && tries < 50 * m.vertices.size(); ++tries) {
    const std::size_t t = random() % m.triangles.size();
    if (gone[t]) continue;
    const int a = m.triangles[t][0], b = m.triangles[t][1];
    const std::set<int> of_a = beside(a), of_b = beside(b);
    std::vector<int> both;
    std::set_intersection(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(), std::back_inserter(both));
    bool free = both.size() == 2;
    for (const std::set<int>* ring : {&of_a, &of_b})
      for (const int v : *ring) free = free && !touched[static_cast<std::size_t>(v)];
    if (!free) continue;
    touched[static_cast<std::size_t>(a)] = touched[static_cast<std::size_t>(b)] = 1;
    m.vertices[static_cast<std::size_t>(a)] =
        0.5 * (m.vertices[static_cast<std::size_t>(a)] + m.vertices[static_cast<std::size_t>(b)]);
    for (const std::size_t f : faces[static_cast<std::size_t>(b)]) {
      auto& corners = m.triangles[f];
      gone[f] = std::find(corners.begin(), corners.end(), a) != corners.end();
      std::replace(corners.begin(), corners.end(), b, a);
    }
    --left;
  }
  std::size_t kept = 0;
  for (std::size_t t = 0; t < m.triangles.size(); ++t)
    if (!gone[t]) m.triangles[kept++] = m.triangles[t];
  m.triangles.resize(kept);
  return s;
}

}  // namespace gambeson::test
