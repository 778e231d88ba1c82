#include "cases/cell/loops.hpp"

namespace gambeson {

std::vector<CellWork> workAlong(const RecordedTable& rows) {
  std::vector<CellWork> along(rows.rows());
  const auto column = [&](const char* name) -> const std::vector<double>& { return rows.column(name); };
  const std::vector<double>&stored = column("energy_J_per_m2"), &lost = column("lost_J_per_m2");
  double work = 0;
  for (std::size_t k = 1; k < along.size(); ++k) {
    const auto add = [&](const char* force, const char* strain, double times) {
      work += 0.5 * times * (column(force)[k] + column(force)[k - 1]) * (column(strain)[k] - column(strain)[k - 1]);
    };
    add("n11_N_per_m", "e11", 1);
    add("n22_N_per_m", "e22", 1);
    add("n12_N_per_m", "e12", 2);
    add("moment_N", "curvature_per_m", 1);
    along[k] = {work, stored[k] - stored[0], lost[k] - lost[0]};
  }
  return along;
}

std::vector<CellWork> loopsOf(const PathCase& path, const RecordedTable& rows) {
  const std::vector<CellWork> along = workAlong(rows);
  std::vector<CellWork> loops;
  if (path.cycles == 0) return loops;
  const auto round = 2 * static_cast<std::size_t>(path.steps);
  for (std::size_t end = round; end < along.size(); end += round) {
    const CellWork &a = along[end - round], &b = along[end];
    loops.push_back({b.work - a.work, b.stored - a.stored, b.lost - a.lost});
  }
  return loops;
}

}  // namespace gambeson
