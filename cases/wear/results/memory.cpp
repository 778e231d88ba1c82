/// Detail of measure.hpp: what the cloth remembers of its bending, and how much of its contact sticks.

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "analysis/ticks.hpp"
#include "cases/wear/recording/cloth_memory.hpp"
#include "cases/wear/results/measure.hpp"
#include "cases/wear/results/write.hpp"
#include "core/io/csv.hpp"

namespace gambeson {

void measureMemory(const Scenario& s, const RecordingReader& recording, Measured& out) {
  const auto& tables = recording.layout().tables;
  const auto share = [](double stuck, double all) {
    return all > 0 ? stuck / all : std::numeric_limits<double>::quiet_NaN();
  };
  if (tables.contains("sticking")) {
    const RecordedTable table = recording.table("sticking");
    const std::vector<double>&n = table.column("bodies_n_Ns"), &stuck = table.column("bodies_stuck_Ns"),
                       &cloth_n = table.column("cloth_n_Ns"), &cloth_stuck = table.column("cloth_stuck_Ns");
    double sums[4] = {};
    for (std::size_t w = 0; w < table.rows() && w < out.steps.collisions.size(); ++w) {
      out.steps.collisions[w].sticking = share(stuck[w], n[w]);
      out.steps.collisions[w].cloth_sticking = share(cloth_stuck[w], cloth_n[w]);
      if (table.column("start_s")[w] < -1e-9) continue;
      sums[0] += n[w];
      sums[1] += stuck[w];
      sums[2] += cloth_n[w];
      sums[3] += cloth_stuck[w];
    }
    out.sticking = {share(sums[1], sums[0]), share(sums[3], sums[2])};
  }
  if (!tables.contains("memory")) return;
  const RecordedTable table = recording.table("memory");
  out.memory.patches = s.patch_names;
  const std::vector<std::string> columns = ClothMemoryView::columns(s.patch_names);
  for (std::size_t w = 0; w < table.rows(); ++w) {
    if (table.column("start_s")[w] < -1e-9) continue;
    out.memory.time_s.push_back(table.column("end_s")[w]);
    std::vector<MemoryMeasure::Of>& row = out.memory.rows.emplace_back();
    for (std::size_t p = 0; p < s.patch_names.size(); ++p) {
      const auto at = [&](std::size_t k) {
        const std::string& name = columns[ClothMemoryView::kColumns * p + k];
        return table.has(name) ? table.column(name)[w] : std::numeric_limits<double>::quiet_NaN();
      };
      row.push_back({at(0), at(1), at(2), at(3)});
    }
  }
}

void writeMemory(const std::filesystem::path& csv, const MemoryMeasure& m) {
  std::vector<std::string> columns{"time_s"};
  for (const std::string& name : ClothMemoryView::columns(m.patches)) columns.push_back(name);
  std::vector<std::vector<double>> rows;
  for (std::size_t w = 0; w < m.rows.size(); ++w) {
    rows.push_back({m.time_s[w]});
    for (const MemoryMeasure::Of& of : m.rows[w])
      rows.back().insert(rows.back().end(),
                         {of.set_per_m, of.largest_set_per_m, of.friction_left, of.least_friction_left});
  }
  writeCsv(csv, columns, rows);
}

void addMemory(const Measured& m, ReportInput& in) {
  if (!m.memory.rows.empty()) {
    Table table{
        "What the cloth remembers at the end",
        fmt::format("Set: the curvature at which the cloth now rests in place of flat (10 1/m is a radius of 10 cm). "
                    "Friction left: how much of its friction in bending fatigue has left, where new cloth has 100 %. "
                    "Mean: over the area of the patch. Largest and least: at its worst place. Over the motion the "
                    "cloth itself lost {} J, to friction and setting within it and to its damping.",
                    formatNumber(m.energy.lost)),
        {"patch", "set, mean [1/m]", "set, largest [1/m]", "friction left, mean [%]", "friction left, least [%]"},
        {}};
    for (std::size_t p = 0; p < m.memory.patches.size(); ++p) {
      const MemoryMeasure::Of& of = m.memory.rows.back()[p];
      // A space that does not break, as the other columns take the width.
      std::string name;
      for (const char c : m.memory.patches[p]) name += c == '_' ? "\u00a0" : std::string(1, c);
      table.rows.push_back({name, of.set_per_m, of.largest_set_per_m, 100 * of.friction_left,
                            100 * of.least_friction_left});
    }
    in.stress_tables.push_back(std::move(table));
  }
  Table table{"How much of the contact sticks",
              "How much of the pressing force acts where cloth does not slip over what it touches, over the motion.",
              {"contact", "sticking [%]"},
              {}};
  if (std::isfinite(m.sticking.bodies)) table.rows.push_back({"of cloth with bodies", 100 * m.sticking.bodies});
  if (std::isfinite(m.sticking.cloth)) table.rows.push_back({"of cloth with cloth", 100 * m.sticking.cloth});
  if (table.rows.empty()) return;
  in.collision_tables.push_back(std::move(table));
  Plot plot{"Contact that sticks",
            "Of the pressing force of each window; the line has gaps where nothing touches.",
            {},
            {},
            false};
  const auto course = [&](const char* name, Tone tone, auto value) {
    Series s{name, "%", {}, {}, tone};
    for (const CollisionWindow& w : m.steps.collisions) {
      s.time_s.push_back(0.5 * (w.start_s + w.end_s));
      s.values.push_back(100 * value(w));
    }
    s.gaps = true;
    plot.series.push_back(std::move(s));
  };
  if (std::isfinite(m.sticking.bodies))
    course("with bodies", Tone::left, [](const CollisionWindow& w) { return w.sticking; });
  if (std::isfinite(m.sticking.cloth))
    course("cloth with cloth", Tone::right, [](const CollisionWindow& w) { return w.cloth_sticking; });
  in.collision_plots.push_back(std::move(plot));
}

}  // namespace gambeson
