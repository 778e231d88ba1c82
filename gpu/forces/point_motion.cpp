#include "gpu/forces/point_motion.hpp"

#include <map>

#include "gpu/forces/forces.hpp"

namespace gambeson::gpu {

PointLoads pointLoads(const Model& m) {
  PointLoads loads{m.mass_kg, m.drag_kg_per_s, m.held, m.dead_force_N, m.environment.gravity_m_per_s2, {}, {}, 0};
  const SparseRows& WT = m.surface.WT;
  loads.springs.column_count = m.freeCount();
  std::map<int, double> row;
  const auto add = [&](int sample, double sign) {
    for (int e = WT.offsets[sample]; e < WT.offsets[sample + 1]; ++e) row[WT.columns[e]] += sign * WT.values[e];
  };
  const auto close = [&](double stiffness) {
    for (const auto& [column, value] : row) loads.springs.add(column, value);
    loads.springs.endRow();
    loads.stiffness_N_per_m.push_back(stiffness);
    row.clear();
  };
  for (const SpringSupportPoint& spring : m.springs) {
    add(spring.sample, 1);
    close(spring.stiffness_N_per_m);
  }
  loads.anchored = static_cast<int>(m.springs.size());
  for (const Stitch& stitch : m.stitches) {
    add(stitch.b, 1);
    add(stitch.a, -1);
    close(stitch.stiffness_N_per_m);
  }
  return loads;
}

std::optional<std::string> notCarried(const Model& m) {
  if (m.supports) return "supports and loads of a structure";
  if (m.held_motion_count > 0) return "held points that are moved";
  if (m.cloth->damps()) return "damping by the cloth itself";
  if (!m.inner_mass.empty()) return "inner unknowns";
  return notCarried(*m.cloth);
}

}  // namespace gambeson::gpu
