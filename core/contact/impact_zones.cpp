#include "core/contact/impact_zones.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <map>
#include <numeric>

namespace gambeson {

void ImpactZones::add(const ImpactZone& zone) {
  points.add(zone.points);
  touched.add(zone.touched);
  body.push_back(zone.body);
  pinched.push_back(zone.pinched);
}

void ImpactZones::clear() { *this = {}; }

void joinImpactZones(std::span<const ContactRow> rows, const SparseRows& WT, ImpactZones& impact_zones) {
  // Each row and each impact zone is a set of points; sets that share one are joined.
  struct Set {
    std::vector<int> points;
    int body = -1;
    bool pinched = false;
    std::vector<int> touched;
  };
  std::vector<Set> sets;
  for (int k = 0; k < impact_zones.size(); ++k) {
    const ImpactZone z = impact_zones[k];
    sets.push_back({{z.points.begin(), z.points.end()}, z.body, z.pinched, {z.touched.begin(), z.touched.end()}});
  }
  for (const ContactRow& row : rows) {
    Set set;
    for (int k = 0; k < row.stencil.count; ++k) {
      const int s = row.stencil.sample[k];
      set.points.insert(set.points.end(), WT.columns.begin() + WT.offsets[s], WT.columns.begin() + WT.offsets[s + 1]);
    }
    set.body = std::max(row.contact.obstacle, -1);
    for (int v : row.contact.touched.vertex)
      if (v >= 0) set.touched.push_back(v);
    sets.push_back(std::move(set));
  }
  std::vector<int> parent(sets.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto find = [&](int i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  std::map<int, int> owner;  // of a point: a set
  for (std::size_t i = 0; i < sets.size(); ++i)
    for (int p : sets[i].points) {
      const auto [at, fresh] = owner.insert({p, static_cast<int>(i)});
      if (fresh) continue;
      const int a = find(at->second), b = find(static_cast<int>(i));
      parent[std::max(a, b)] = std::min(a, b);
    }
  std::map<int, Set> joined;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    Set& z = joined[find(static_cast<int>(i))];
    z.points.insert(z.points.end(), sets[i].points.begin(), sets[i].points.end());
    z.pinched = z.pinched || sets[i].pinched || (sets[i].body >= 0 && z.body >= 0 && sets[i].body != z.body);
    z.body = std::max(z.body, sets[i].body);
    z.touched.insert(z.touched.end(), sets[i].touched.begin(), sets[i].touched.end());
  }
  std::vector<Set> sorted;
  for (auto& [root, z] : joined) {
    std::sort(z.points.begin(), z.points.end());
    z.points.erase(std::unique(z.points.begin(), z.points.end()), z.points.end());
    std::sort(z.touched.begin(), z.touched.end());
    z.touched.erase(std::unique(z.touched.begin(), z.touched.end()), z.touched.end());
    sorted.push_back(std::move(z));
  }
  std::sort(sorted.begin(), sorted.end(),
            [](const Set& a, const Set& b) { return a.points.front() < b.points.front(); });
  impact_zones.clear();
  for (const Set& z : sorted) impact_zones.add({z.points, z.body, z.pinched, z.touched});
}

RigidVelocity nearestRigid(std::span<const int> points, std::span<const Vec3> p, std::span<const double> mass,
                           std::span<const Vec3> velocity) {
  double total = 0;
  Vec3 centre{}, momentum{};
  for (int i : points) {
    total += mass[i];
    centre += mass[i] * p[i];
    momentum += mass[i] * velocity[i];
  }
  centre = centre / total;
  const Vec3 mean = momentum / total;
  Vec3 turn{};
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (int i : points) {
    const Vec3 r = p[i] - centre;
    turn += mass[i] * cross(r, velocity[i] - mean);
    const Eigen::Vector3d e{r.x, r.y, r.z};
    inertia += mass[i] * (e.squaredNorm() * Eigen::Matrix3d::Identity() - e * e.transpose());
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(inertia);
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();
  const Eigen::Vector3d L{turn.x, turn.y, turn.z};
  for (int k = 0; k < 3; ++k)
    if (axes.eigenvalues()[k] > 1e-12 * axes.eigenvalues()[2])
      spin += axes.eigenvectors().col(k).dot(L) / axes.eigenvalues()[k] * axes.eigenvectors().col(k);
  return {centre, mean, {spin.x(), spin.y(), spin.z()}};
}

void makeRigid(const ImpactZone& zone, std::span<const Vec3> p, std::span<const double> mass,
               std::span<Vec3> velocity) {
  const RigidVelocity rigid = nearestRigid(zone.points, p, mass, velocity);
  for (int i : zone.points) velocity[i] = rigid.at(p[i]);
}

}  // namespace gambeson
