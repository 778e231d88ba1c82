#include "cases/wear/results/force_clusters.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "cases/runs/frame_field.hpp"

namespace gambeson {

std::vector<ForceCluster> forceClusters(const PlacedBodies& placed, const Frame& frame, const std::vector<Vec3>& x) {
  const Field& contact = fieldOf(frame, "contact_force");
  std::map<std::array<int, 4>, ForceCluster> cells;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Vec3 force{-contact.data[3 * i], -contact.data[3 * i + 1], -contact.data[3 * i + 2]};
    const double size = norm(force);
    if (!(size > 0)) continue;
    const int body = placed.nearest(x[i]).body;
    const auto cell = [&](double v) { return static_cast<int>(std::floor(v / kArrowCell_m)); };
    ForceCluster& cluster = cells[{body, cell(x[i].x), cell(x[i].y), cell(x[i].z)}];
    cluster.force += force;
    cluster.moment_of_size += size * x[i];
    cluster.size += size;
  }
  std::vector<ForceCluster> clusters;
  for (const auto& [key, cluster] : cells) clusters.push_back(cluster);
  return clusters;
}

double largestForce(const std::vector<ForceCluster>& clusters) {
  double most = 0;
  for (const ForceCluster& c : clusters) most = std::max(most, norm(c.force));
  return most;
}

}  // namespace gambeson
