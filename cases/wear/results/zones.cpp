/// Detail of measure.hpp: what each part of the body bears from each garment: numbers, the table zones.csv, and what
/// the page shows of it.

#include <fmt/format.h>

#include <algorithm>

#include "cases/wear/recording/zone_ledger.hpp"
#include "cases/wear/results/vector_columns.hpp"
#include "cases/wear/results/write.hpp"
#include "core/error.hpp"
#include "core/io/csv.hpp"

namespace gambeson {
namespace {

/// What a zone gets from a group of contacts: impulses.
struct ZoneColumns {
  const std::vector<double>&size, &normal, &friction;
  VectorColumns resultant;

  ZoneColumns(const RecordedTable& table, const std::string& name)
      : size(table.column(name + "_Ns")),
        normal(table.column(name + "_n_Ns")),
        friction(table.column(name + "_t_Ns")),
        resultant(table, name + "_J", "_Ns") {}
  ZoneForce at(std::size_t row) const { return {size[row], normal[row], friction[row], resultant[row]}; }
};

bool fits(const std::string& name, const std::string& zone) {
  return zone.empty() || name == zone || name == zone + "_left" || name == zone + "_right";
}

}  // namespace

ZoneForce ZonesMeasure::of(const std::string& zone, bool free_only) const {
  ZoneForce sum;
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (std::size_t z = 0; z < names.size(); ++z)
      if ((!free_only || groups[g].press == Press::free) && fits(names[z], zone)) sum += mean[g][z];
  return sum;
}

double ZonesMeasure::resultantOf(const std::string& zone, bool free_only) const {
  double sum = 0;
  for (std::size_t z = 0; z < names.size(); ++z)
    if (fits(names[z], zone)) sum += (free_only ? mean_free_resultant_N : mean_resultant_N)[z];
  return sum;
}

void measureZones(const Scenario& s, const RecordingReader& recording, Measured& out) {
  ZonesMeasure& m = out.zones;
  m.names = zoneNames(s);
  m.groups = s.contact_groups;
  m.mean.assign(m.groups.size(), std::vector<ZoneForce>(m.names.size()));
  m.mean_resultant_N.assign(m.names.size(), 0);
  m.mean_free_resultant_N.assign(m.names.size(), 0);
  double counted_s = 0;
  const RecordedTable table = recording.table("body_zones");
  const std::vector<double>&start = table.column("start_s"), &end = table.column("end_s");
  std::vector<ZoneColumns> columns;
  for (const std::string& name : ZoneLedger::names(s)) columns.emplace_back(table, name);
  for (std::size_t w = 0; w < table.rows(); ++w) {
    if (start[w] < -1e-9) continue;
    const double dt = end[w] - start[w];
    const bool counts = start[w] > out.counted_from_s - 1e-9;
    if (counts) counted_s += dt;
    m.time_s.push_back(0.5 * (start[w] + end[w]));
    m.all.emplace_back(m.names.size());
    m.free.emplace_back(m.names.size());
    for (std::size_t g = 0; g < m.groups.size(); ++g)
      for (std::size_t z = 0; z < m.names.size(); ++z) {
        const ZoneForce sum = columns[g * m.names.size() + z].at(w);
        const ZoneForce f{sum.force_N / dt, sum.normal_N / dt, sum.friction_N / dt, sum.resultant_N / dt};
        m.all.back()[z] += f;
        if (m.groups[g].press == Press::free) m.free.back()[z] += f;
        if (counts) m.mean[g][z] += sum;
      }
    for (std::size_t z = 0; counts && z < m.names.size(); ++z) {
      m.mean_resultant_N[z] += dt * norm(m.all.back()[z].resultant_N);
      m.mean_free_resultant_N[z] += dt * norm(m.free.back()[z].resultant_N);
    }
  }
  if (!(counted_s > 0)) return;
  for (auto& zones : m.mean)
    for (ZoneForce& f : zones)
      f = {f.force_N / counted_s, f.normal_N / counted_s, f.friction_N / counted_s, f.resultant_N / counted_s};
  for (auto* means : {&m.mean_resultant_N, &m.mean_free_resultant_N})
    for (double& f : *means) f /= counted_s;
}

void writeZones(const std::filesystem::path& csv, const ZonesMeasure& m) {
  std::vector<std::string> columns{"time_s"};
  for (const std::string& name : m.names)
    columns.insert(columns.end(),
                   {name + "_N", name + "_normal_N", name + "_friction_N", name + "_without_belt_and_springs_N",
                    name + "_resultant_N", name + "_resultant_without_belt_and_springs_N"});
  std::vector<std::vector<double>> rows;
  for (std::size_t w = 0; w < m.time_s.size(); ++w) {
    rows.push_back({m.time_s[w]});
    for (std::size_t z = 0; z < m.names.size(); ++z) {
      const ZoneForce& f = m.all[w][z];
      rows.back().insert(rows.back().end(), {f.force_N, f.normal_N, f.friction_N, m.free[w][z].force_N,
                                             norm(f.resultant_N), norm(m.free[w][z].resultant_N)});
    }
  }
  writeCsv(csv, columns, rows);
}

void addZones(const Measured& measured, ReportInput& in) {
  const ZonesMeasure& m = measured.zones;
  const ZoneForce total = m.of("", true);
  const bool pressed =
      std::any_of(m.groups.begin(), m.groups.end(), [](const ContactGroup& g) { return g.press != Press::free; });
  std::vector<std::size_t> order;
  for (std::size_t z = 0; z < m.names.size(); ++z) {
    double force = 0;
    for (const auto& group : m.mean) force += group[z].force_N;
    if (force > 0) order.push_back(z);
  }
  const auto freely = [&](std::size_t z) {
    ZoneForce f;
    for (std::size_t g = 0; g < m.groups.size(); ++g)
      if (m.groups[g].press == Press::free) f += m.mean[g][z];
    return f;
  };
  if (order.empty()) return;
  const char* rest = pressed ? " A belt, what lies under it, and edges on springs are not counted." : "";
  BarChart chart{"Which parts of the body bear the garment",
                 "%",
                 fmt::format("Share of the force that presses (normal to the body, sums of magnitudes).{}", rest),
                 {}};
  for (const std::size_t z : order)
    if (const double f = freely(z).normal_N; f > 0)
      chart.bars.push_back({spokenZone(m.names[z]), 100 * f / total.normal_N});
  std::stable_sort(chart.bars.begin(), chart.bars.end(), [](const Bar& a, const Bar& b) { return a.value > b.value; });
  if (!chart.bars.empty()) in.contact_charts.push_back(std::move(chart));

  Table table{
      "Force on the parts of the body",
      fmt::format("Means over time of the sums of magnitudes: opposite forces do not cancel.{} The force of each "
                  "garment stands behind.",
                  pressed ? " Force, pressing and friction without belt and edges on springs." : ""),
      {"part", "force [N]", "pressing [N]", "friction [N]", "of all that presses [%]"},
      {}};
  for (const ContactGroup& g : m.groups) table.columns.push_back(groupName(g) + " [N]");
  const auto add = [&](const std::string& name, const ZoneForce& f, auto of) {
    table.rows.push_back({name, f.force_N, f.normal_N, f.friction_N,
                          TableCell(total.normal_N > 0 ? 100 * f.normal_N / total.normal_N : 0)});
    for (std::size_t g = 0; g < m.groups.size(); ++g) table.rows.back().push_back(of(g));
  };
  for (const std::size_t z : order)
    add(spokenZone(m.names[z]), freely(z), [&](std::size_t g) { return m.mean[g][z].force_N; });
  add("sum", total, [&](std::size_t g) {
    double sum = 0;
    for (const ZoneForce& f : m.mean[g]) sum += f.force_N;
    return sum;
  });
  in.contact_tables.push_back(std::move(table));

  Plot plot{"Force on the body over time",
            fmt::format("Sums of magnitudes, both sides together; the four parts that bear most.{}", rest),
            {},
            {},
            true};
  plot.mark_from_s = measured.counted_from_s;
  std::vector<std::string> parts;
  for (const std::size_t z : order) {
    std::string part = m.names[z];
    for (const std::string side : {"_left", "_right"})
      if (part.ends_with(side)) part.resize(part.size() - side.size());
    if (std::find(parts.begin(), parts.end(), part) == parts.end()) parts.push_back(part);
  }
  std::erase_if(parts, [&](const std::string& p) { return m.of(p, true).force_N == 0; });
  std::stable_sort(parts.begin(), parts.end(), [&](const std::string& a, const std::string& b) {
    return m.of(a, true).force_N > m.of(b, true).force_N;
  });
  if (parts.size() > 4) parts.resize(4);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    Series series{spokenZone(parts[k]), "N", m.time_s, {}, static_cast<Tone>(k)};
    for (const auto& window : m.free) {
      double sum = 0;
      for (std::size_t z = 0; z < m.names.size(); ++z)
        if (fits(m.names[z], parts[k])) sum += window[z].force_N;
      series.values.push_back(sum);
    }
    plot.series.push_back(std::move(series));
  }
  if (!plot.series.empty()) in.contact_plots.push_back(std::move(plot));
}

}  // namespace gambeson
