/// Detail of measure.hpp: what the steps reported, the energy balance, and what the frames hold.

#include <algorithm>
#include <cmath>
#include <limits>

#include "cases/wear/recording/recorder.hpp"
#include "cases/wear/results/measure.hpp"
#include "cases/wear/results/write.hpp"
#include "core/error.hpp"
#include "core/io/csv.hpp"

namespace gambeson {

void measureSteps(const RecordingReader& recording, Measured& out) {
  StepMeasure& m = out.steps;
  EnergyMeasure& e = out.energy;
  m.shortest_s = std::numeric_limits<double>::infinity();
  double time = 0, iterations = 0, first_energy = 0;
  bool moving = false;
  const RecordedTable table = recording.table("steps");
  for (std::size_t w = 0; w < table.rows(); ++w) {
    const auto at = [&](const char* name) { return table.column(name)[w]; };
    const double start = at("start_s"), end = at("end_s"), middle = 0.5 * (start + end);
    out.recorded_end_s = end;
    time += end - start;
    iterations += at("iterations");
    m.steps += std::lround(at("steps"));
    m.unconverged += std::lround(at("unconverged_steps"));
    m.yielded += std::lround(at("yielded_steps"));
    m.projections += std::lround(at("projections"));
    // While cloth settles, what it starts stretched by is taken back slowly.
    double& residual = start < -1e-9 ? m.largest_limit_residual_settling : m.largest_limit_residual;
    residual = std::max(residual, at("largest_limit_residual"));
    if (start >= -1e-9) {
      m.limited += std::lround(at("steps"));
      m.unlimited += std::lround(at("unlimited_steps"));
    }
    m.impacts += std::lround(at("impacts"));
    if (table.has(solve_columns[0])) {
      m.solves += std::lround(at("steps"));
      m.solve_iterations += at(solve_columns[0]);
      m.largest_missed_impulse = std::max(m.largest_missed_impulse, at(solve_columns[1]));
    }
    const auto count = [&](const char* name) { return std::lround(at(name)); };
    m.collisions.push_back({start, end, count("most_contacts"), count("most_cloth_contacts"), count("impacts"),
                            count("zones"), count("cut_steps"), count("pinched"), count("most_intersections"),
                            at("smallest_gap_m"), at("largest_residual_m_per_s"),
                            at("iterations") / std::max(1.0, at("steps")), at("largest_way_cells")});
    m.shortest_s = std::min(m.shortest_s, at("shortest_step_s"));
    m.longest_s = std::max(m.longest_s, at("longest_step_s"));
    m.largest_residual_m_per_s = std::max(m.largest_residual_m_per_s, at("largest_residual_m_per_s"));
    // Not std::max: a NaN must win.
    if (!(at("momentum_error") <= m.momentum_error))
      m.momentum_error = at("momentum_error"), m.momentum_error_time_s = middle;
    if (at("frequency_rad_per_s") > m.frequency_rad_per_s) {
      m.frequency_rad_per_s = at("frequency_rad_per_s");
      m.frequency_time_s = middle;
      m.shares = {at("membrane_share"), at("bending_share"), at("seam_share"), at("spring_share")};
    }
    if (start < -1e-9) continue;
    if (at("deepest_m") > m.deepest_m) m.deepest_m = at("deepest_m"), m.deepest_time_s = middle;
    const double energy = at("kinetic_J") + at("internal_J") + at("gravity_J") + at("springs_J");
    e.rows.push_back({end, at("kinetic_J"), at("internal_J"), at("gravity_J"), at("springs_J"), at("work_contact_J"),
                      at("work_drag_J"), at("work_supports_J"), at("work_limit_J"),
                      table.has(lost_column) ? at(lost_column) : 0, at("dissipated_J")});
    if (!moving) {
      moving = true;
      first_energy = energy;
      continue;
    }
    e.change = energy - first_energy;
    e.contact += at("work_contact_J");
    e.friction += at("work_friction_J");
    e.separation += at("work_separation_J");
    e.restoring += at("work_restoring_J");
    e.drag += at("work_drag_J");
    e.dissipated += at("dissipated_J");
    e.supports += at("work_supports_J");
    e.limit += at("work_limit_J");
    const double lost = table.has(lost_column) ? at(lost_column) : 0;
    e.lost += lost;
    if (table.has(integrator_column)) e.integrator = e.integrator.value_or(0) + at(integrator_column);
    e.absolute += std::abs(at("work_contact_J")) + std::abs(at("work_drag_J")) + std::abs(at("work_supports_J")) +
                  std::abs(at("work_limit_J")) + lost;
  }
  if (m.steps == 0) m.shortest_s = 0;
  m.mean_s = m.steps > 0 ? time / static_cast<double>(m.steps) : 0;
  m.mean_iterations = m.steps > 0 ? iterations / static_cast<double>(m.steps) : 0;
  const Frequency f{m.frequency_rad_per_s, m.shares[0], m.shares[1], m.shares[2], m.shares[3]};
  m.governing = f.governing();
}

CollisionTable collisionTable(std::span<const CollisionWindow> windows) {
  CollisionTable t{{"start_s", "end_s", "most_contacts", "most_cloth_contacts", "impacts", "rigid_zones", "cut_steps",
                    "pinched_samples", "most_intersections", "smallest_gap_m", "largest_residual_m_per_s",
                    "mean_iterations", "largest_way_cells", "sticking_share", "sticking_share_cloth"},
                   {}};
  for (const CollisionWindow& w : windows) {
    t.rows.push_back({w.start_s, w.end_s});
    for (long n : {w.contacts, w.cloth_contacts, w.impacts, w.impact_zones, w.cut_steps, w.pinched, w.intersections})
      t.rows.back().push_back(static_cast<double>(n));
    t.rows.back().insert(t.rows.back().end(),
                         {w.contacts > 0 ? w.smallest_gap_m : 0, w.residual_m_per_s, w.iterations, w.way_cells,
                          std::isfinite(w.sticking) ? w.sticking : 0,
                          std::isfinite(w.cloth_sticking) ? w.cloth_sticking : 0});
  }
  return t;
}

void writeCollisions(const std::filesystem::path& csv, std::span<const CollisionWindow> windows) {
  const CollisionTable t = collisionTable(windows);
  writeCsv(csv, t.columns, t.rows);
}

void writeEnergy(const std::filesystem::path& csv, std::span<const std::array<double, 11>> rows) {
  std::vector<std::vector<double>> table;
  for (const auto& row : rows) table.emplace_back(row.begin(), row.end());
  writeCsv(csv,
           {"time_s", "kinetic_J", "internal_J", "gravity_J", "springs_J", "work_contact_J", "work_drag_J",
            "work_supports_J", "work_limit_J", "lost_in_cloth_J", "dissipated_J"},
           table);
}

void measureFrames(const RecordingReader& recording, Measured& out) {
  RecordedRange range;
  range.stress_low = std::numeric_limits<float>::infinity();
  range.stress_high = -range.stress_low;
  for (int k = 0; k < recording.frameCount(); ++k) {
    const Frame frame = recording.frame(k);
    const Field &stress = fieldOf(frame, "stress"), &strain = fieldOf(frame, "strain");
    if (stress.data.empty()) throw RunError("the recording has frames without samples");
    const auto [low, high] = std::minmax_element(stress.data.begin(), stress.data.end());
    range.stress_low = std::min(range.stress_low, *low);
    range.stress_high = std::max(range.stress_high, *high);
    if (k == recording.frameCount() - 1) {
      range.last_stress_low = *low;
      range.last_stress_high = *high;
      for (std::size_t c = 0; c < 3; ++c) {
        range.low[c] = range.high[c] = frame.positions[c];
        for (std::size_t i = c; i < frame.positions.size(); i += 3) {
          range.low[c] = std::min(range.low[c], frame.positions[i]);
          range.high[c] = std::max(range.high[c], frame.positions[i]);
        }
      }
    }
    if (frame.time_s > 1e-9) out.frames.push_back({frame.time_s, stress.data, strain.data});
  }
  if (recording.frameCount() > 0) out.recorded = range;
  if (!out.frames.empty()) out.stress = summarizeStress(out.regions, out.frames);
}

}  // namespace gambeson
