#include "cases/cell/results.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cases/cell/fields.hpp"
#include "cases/cell/loops.hpp"
#include "cases/input/json_at.hpp"
#include "cases/input/message.hpp"
#include "cases/runs/check_json.hpp"
#include "cases/yarns/design.hpp"
#include "core/error.hpp"
#include "core/io/csv.hpp"
#include "core/io/own_file.hpp"

namespace gambeson {
namespace {

using Json = nlohmann::ordered_json;

Json stiffnessOf(const RestStiffness& rest) {
  Json j = Json::object();
  if (rest.membrane_N_per_m) {
    const std::array<double, 9>& A = *rest.membrane_N_per_m;
    j.update({{"A11_N_per_m", A[0]},
              {"A22_N_per_m", A[4]},
              {"A12_N_per_m", A[1]},
              {"A66_N_per_m", A[8]},
              {"A16_N_per_m", A[2]},
              {"A26_N_per_m", A[5]}});
  }
  if (rest.bending_Nm) {
    const std::array<double, 3>& D = *rest.bending_Nm;
    j.update({{"D11_Nm", D[0]}, {"D22_Nm", D[1]}, {"D12_plus_2_D66_Nm", D[2]}});
  }
  if (!rest.why.empty()) j["why"] = rest.why;
  return j;
}

Json pathOf(const PathCase& path, const RecordedPath& walked, bool rubs) {
  Json j{{"name", path.name},
         {"load", schema::wordOf(path.load)},
         {"reached", walked.reached},
         {"rows", walked.rows.rows()}};
  if (!walked.reached) j["why"] = walked.why;
  if (walked.rows.empty()) return j;
  double iterations = 0;
  for (const double n : walked.rows.column("iterations")) iterations += n;
  j["iterations"] = static_cast<long>(iterations);
  // With cycles the end of the way is not the last row.
  const std::vector<double>& part = walked.rows.column("part");
  const auto end = static_cast<std::size_t>(std::max_element(part.begin(), part.end()) - part.begin());
  Json at = Json::object();
  for (const std::string& column : curveColumns())
    if (column != "iterations" && column != "residual" && column != "rounded")
      at[column] = walked.rows.column(column)[end];
  j["end"] = std::move(at);
  if (!rubs) return j;
  for (const CellWork& loop : loopsOf(path, walked.rows))
    j["loops"].push_back(
        {{"work_J_per_m2", loop.work}, {"stored_J_per_m2", loop.stored}, {"lost_J_per_m2", loop.lost}});
  return j;
}

}  // namespace

void writeCellRunFacts(const CellRunFacts& facts, const std::filesystem::path& results) {
  const Json j{
      {"version", GAMBESON_VERSION}, {"threads", facts.threads}, {"wall_s", facts.wall_s}, {"resumed", facts.resumed}};
  writeOwnFile(results / "run.json", j.dump(2) + "\n");
}

CellRunFacts readCellRunFacts(const std::filesystem::path& results) {
  const std::filesystem::path file = results / "run.json";
  std::ifstream stream(file);
  if (!stream) throw InputError({file.string(), 0, ""}, "cannot be opened");
  try {
    const auto parsed = nlohmann::json::parse(stream);
    const JsonAt j(parsed);
    return {j.at("wall_s").number(), j.at("threads").integer(), j.at("resumed").flag()};
  } catch (const JsonAt::Error& e) {
    throw InputError({file.string(), 0, ""}, e.what());
  } catch (const nlohmann::json::exception& e) {
    throw InputError({file.string(), 0, ""}, jsonReason(e.what()));
  }
}

void writeCurves(const RecordedCell& cell, const std::filesystem::path& csv) {
  std::vector<std::string> labels;
  std::vector<std::vector<double>> rows;
  for (std::size_t k = 0; k < cell.paths().size(); ++k) {
    const RecordedTable& table = cell.paths()[k].rows;
    for (std::size_t row = 0; row < table.rows(); ++row) {
      labels.push_back(cell.definition().paths[k].name);
      rows.emplace_back();
      for (const std::string& column : curveColumns()) rows.back().push_back(table.column(column)[row]);
    }
  }
  writeOwnFile(csv, formatCsv("load", labels, curveColumns(), rows));
}

CellMeasures measuresOf(const CellCase& c) {
  const WovenYarns yarns = wovenYarns(c);
  CellMeasures m;
  m.length_m = yarns.period_m(along_weft);
  m.width_m = yarns.period_m(along_warp);
  m.height_m = *c.height_m;
  double volume_m3 = 0;
  for (const int d : {along_weft, along_warp}) {
    const WovenYarn& yarn = yarns.yarn[d];
    double length_m = 0;
    for (int k = 0; k < yarns.count(d); ++k) length_m += yarns.arcLength_m(d, k, 0, yarns.period_m(d));
    volume_m3 += length_m * std::numbers::pi * yarn.half_width_m * yarn.half_thickness_m;
    m.crimp[d] = length_m / (yarns.count(d) * yarns.period_m(d)) - 1;
  }
  m.volume_fraction = volume_m3 / (yarns.area_m2() * m.height_m);
  return m;
}

double harmonicMean(const PeriodicBar& bar) {
  double length = 0, compliance = 0;
  for (std::size_t k = 0; k < bar.length.size(); ++k) {
    length += bar.length[k];
    compliance += bar.length[k] / bar.young_Pa[k];
  }
  return length / compliance;
}

void writeCellSummary(const RecordedCell& cell, const std::vector<AuditCheck>& checks, const CellRunFacts& facts,
                      const std::filesystem::path& file) {
  const CellCase& c = cell.definition();
  const CellMeasures m = measuresOf(c);
  const WovenYarns yarns = wovenYarns(c);
  Json j{{"name", c.name},
         {"kind", "cell"},
         {"version", GAMBESON_VERSION},
         {"case_hash", caseIdentity(c)},
         {"finished", cell.whole()}};
  j["cell"] = {{"warps", yarns.weave.warps},
               {"wefts", yarns.weave.wefts},
               {"length_m", m.length_m},
               {"width_m", m.width_m},
               {"height_m", m.height_m},
               {"volume_fraction", m.volume_fraction},
               {"crimp_weft", m.crimp[along_weft]},
               {"crimp_warp", m.crimp[along_warp]}};
  j["at_rest"] = stiffnessOf(cell.rest());
  j["loads"] = Json::array();
  for (std::size_t k = 0; k < cell.paths().size(); ++k)
    j["loads"].push_back(pathOf(c.paths[k], cell.paths()[k], c.friction.has_value()));
  j["bars"] = Json::array();
  for (const BarCase& bar : c.bars) {
    const HomogenisedBar mean = homogenise(bar.bar);
    j["bars"].push_back({{"name", bar.name},
                         {"young_Pa", mean.young_Pa},
                         {"harmonic_mean_Pa", harmonicMean(bar.bar)},
                         {"characteristic_m", mean.characteristic}});
  }
  j["checks"] = checkJson(checks);
  j["timings"] = {{"wall_s", facts.wall_s}, {"threads", facts.threads}};
  writeOwnFile(file, j.dump(2) + "\n");
}

}  // namespace gambeson
