#include "analysis/tables.hpp"

#include "core/io/csv.hpp"

namespace gambeson {

void writeTorques(const std::filesystem::path& csv, const Skeleton& skeleton, const TorqueSeries& series,
                  std::span<const TorqueVariant> variants) {
  std::vector<std::string> columns{"time_s"};
  const auto name = [&](const std::string& variant) {
    for (const int j : series.joints) {
      const Joint& joint = skeleton.joints[static_cast<std::size_t>(j)];
      columns.push_back(joint.name + variant + (joint.type == JointType::prismatic ? "_N" : "_Nm"));
    }
  };
  name("");
  for (const TorqueVariant& v : variants) name("_" + v.name);
  std::vector<std::vector<double>> rows;
  for (std::size_t w = 0; w < series.time_s.size(); ++w) {
    rows.push_back({series.time_s[w]});
    rows.back().insert(rows.back().end(), series.value[w].begin(), series.value[w].end());
    for (const TorqueVariant& v : variants)
      rows.back().insert(rows.back().end(), v.series->value[w].begin(), v.series->value[w].end());
  }
  writeCsv(csv, columns, rows);
}

void writeContact(const std::filesystem::path& csv, const Human& human, std::span<const ContactWindow> windows) {
  const std::vector<int> links = segmentLinks(human);
  std::vector<std::string> columns{"time_s"};
  for (const int l : links)
    for (const char* unit : {"_N", "_x_N", "_y_N", "_z_N"})
      columns.push_back(human.skeleton.links[static_cast<std::size_t>(l)].name + unit);
  std::vector<std::vector<double>> rows;
  for (const ContactWindow& w : windows) {
    rows.push_back({w.middle()});
    for (const int l : links) {
      const Vec3 force = w.links[static_cast<std::size_t>(l)].force_Ns / w.duration();
      rows.back().insert(rows.back().end(), {norm(force), force.x, force.y, force.z});
    }
  }
  writeCsv(csv, columns, rows);
}

void writeStress(const std::filesystem::path& csv, const Regions& regions, std::span<const StressFrame> frames) {
  std::vector<std::string> columns{"time_s"};
  for (const std::string& name : regions.names)
    for (const char* what : {"_p50_N_per_m", "_p95_N_per_m", "_p99_N_per_m", "_max_N_per_m", "_max_strain"})
      columns.push_back(name + what);
  std::vector<std::vector<double>> rows;
  for (const StressFrame& frame : frames) {
    rows.push_back({frame.time_s});
    for (const StressSummary& s : summarizeStress(regions, {&frame, 1}))
      rows.back().insert(rows.back().end(), {s.p50_N_per_m, s.p95_N_per_m, s.p99_N_per_m, s.max_N_per_m, s.max_strain});
  }
  writeCsv(csv, columns, rows);
}

}  // namespace gambeson
