#pragma once
/// Contact solves recorded from runs (solve0.bin and so on): rows over samples, and the samples' weights at free
/// points.

#include <filesystem>
#include <fstream>

#include "core/error.hpp"
#include "gpu/scenes/contact_problem.hpp"

namespace gambeson::gpu {

/// The file has: rows, samples, free points, islands, iterations so far (int32 each), the goal; then arrays: stencils
/// and samples as compressed rows (offsets, columns, values), 12 facts a row (normal, drift, friction, compliance,
/// slope, bound, area, nothing), velocities (4 a point), inverse masses, tractions (4 a row).
inline ContactProblem recordedSolve(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const auto get = [&](auto& items, std::size_t count) {
    items.resize(count);
    in.read(reinterpret_cast<char*>(items.data()), static_cast<std::streamsize>(count * sizeof(items[0])));
    if (!in) throw InputError({file.string(), 0, {}}, "the file ends before its data do");
  };
  std::vector<int> head, offsets, columns;
  std::vector<double> goal, values, facts, velocity, traction;
  ContactProblem p;
  p.name = file.stem().string();
  get(head, 5);
  const std::size_t rows = head[0], samples = head[1], points = head[2];
  get(goal, 1);
  get(offsets, rows + 1), get(columns, offsets.back()), get(values, offsets.back());
  get(p.WT.offsets, samples + 1), get(p.WT.columns, p.WT.offsets.back()), get(p.WT.values, p.WT.offsets.back());
  get(facts, 12 * rows), get(velocity, 4 * points), get(p.inverse_mass, points), get(traction, 4 * rows);
  p.WT.column_count = static_cast<int>(points);
  p.goal_m_per_s = goal[0];
  for (std::size_t f = 0; f < points; ++f)
    p.velocity.push_back({velocity[4 * f], velocity[4 * f + 1], velocity[4 * f + 2]});
  for (std::size_t r = 0; r < rows; ++r) {
    const double* fact = &facts[12 * r];
    ContactRow row;
    for (int e = offsets[r]; e < offsets[r + 1]; ++e) row.stencil.add(columns[e], values[e]);
    row.contact.sample = row.stencil.sample[0];
    row.contact.normal = {fact[0], fact[1], fact[2]};
    row.body_velocity = {fact[3], fact[4], fact[5]};
    row.compliance = fact[7];
    p.rows.push_back(row);
    p.friction.push_back(fact[6]), p.slope.push_back(fact[8]), p.area.push_back(fact[10]);
    p.traction.push_back({traction[4 * r], traction[4 * r + 1], traction[4 * r + 2]});
  }
  return p;
}

}  // namespace gambeson::gpu
