#include "cases/study/numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "analysis/ticks.hpp"
#include "cases/input/json_at.hpp"
#include "cases/input/message.hpp"
#include "cases/wear/results/check_words.hpp"
#include "core/error.hpp"
#include "core/io/csv_text.hpp"

namespace gambeson::study {
namespace {

using Json = JsonAt;

/// "hip_flexion_left": "left hip (flexion)".
std::string labelOf(const std::string& joint, const std::string& side) {
  std::string rest = joint;
  if (!side.empty()) rest.resize(rest.size() - side.size() - 1);
  const std::size_t cut = rest.rfind('_');
  std::string label = cut == std::string::npos ? rest : rest.substr(0, cut) + " (" + rest.substr(cut + 1) + ")";
  std::replace(label.begin(), label.end(), '_', ' ');
  return side.empty() ? label : side + " " + label;
}

std::optional<double> optional(const Json& j, const std::string& key) {
  return j.contains(key) && j.at(key).is_number() ? std::optional(j.at(key).number()) : std::nullopt;
}

JointNumbers jointOf(const Json& j) {
  JointNumbers n;
  n.name = j.at("joint").text();
  if (const std::string side = j.at("side").text(); !side.empty() && !n.name.ends_with("_" + side))
    throw Json::Error("the joint \"" + n.name + "\" is not one of the side \"" + side + "\"");
  n.label = labelOf(n.name, j.at("side").text());
  n.prismatic = j.contains("peak_N");
  const std::string unit = n.prismatic ? "_N" : "_Nm";
  n.peak_Nm = j.at("peak" + unit).number();
  n.peak_time_s = j.at("peak_time_s").number();
  n.rms_Nm = j.at("rms" + unit).number();
  n.standing_Nm = optional(j, "standing" + unit);
  n.rate_at_peak = j.at("joint_rate_at_peak").number();
  if (j.contains("cause")) n.cause = j.at("cause").text();
  n.natural_Nm = optional(j, "natural_peak_Nm");
  if (j.contains("natural_is_held")) {
    n.foot_part = optional(j.at("natural_is_held"), "foot_share_of_weight");
    n.lever_m = optional(j.at("natural_is_held"), "lever_m");
  }
  n.normal_N = j.at("normal_mean_N").number();
  n.friction_N = j.at("friction_mean_N").number();
  n.friction_Nm = optional(j, "friction_at_peak" + unit);
  return n;
}

void readZones(const Json& rows, RunNumbers& run) {
  for (const Json& r : rows.list()) {
    if (r.at("press").text() != "free") continue;
    std::string zone = r.at("zone").text();
    for (const std::string side : {"_left", "_right"})
      if (zone.ends_with(side)) zone.resize(zone.size() - side.size());
    auto at = std::find_if(run.zones.begin(), run.zones.end(), [&](const ZoneNumbers& z) { return z.zone == zone; });
    if (at == run.zones.end()) at = run.zones.insert(at, {zone, 0, 0, 0});
    at->force_N += r.at("force_N").number();
    at->normal_N += r.at("normal_N").number();
    at->friction_N += r.at("friction_N").number();
  }
}

/// Crossings in the last window before the motion, which starts at 0, or in the first where nothing is dressed.
std::optional<int> crossingsDressed(const Json& windows) {
  int end = -1, crossings = -1, k = 0;
  for (const Json& column : windows.at("columns").list()) {
    if (column.text() == "end_s") end = k;
    if (column.text() == "most_intersections") crossings = k;
    ++k;
  }
  std::optional<int> found;
  for (const Json& row : windows.at("rows").list()) {
    int at = 0;
    double end_s = 0, count = 0;
    for (const Json& value : row.list()) {
      if (at == end) end_s = value.number();
      if (at == crossings) count = value.number();
      ++at;
    }
    if (found && end_s > 1e-9) break;
    found = static_cast<int>(count);
  }
  return end < 0 || crossings < 0 ? std::nullopt : found;
}

/// A table of numbers over time; the first column is the time.
struct Curves {
  std::string file;
  std::vector<std::string> columns;
  std::vector<std::vector<double>> values;  ///< [column]

  explicit Curves(const std::filesystem::path& csv) : file(csv.string()) {
    std::ifstream stream(csv);
    std::string line;
    if (!std::getline(stream, line)) throw RunError(file + " cannot be read");
    columns = csvCells(line);
    values.resize(columns.size());
    while (std::getline(stream, line)) {
      const std::vector<std::string> row = csvCells(line);
      if (row.size() != columns.size())
        throw RunError(file + " has not one value per time of every column");
      for (std::size_t c = 0; c < row.size(); ++c) {
        double value = 0;
        const auto [end, error] = std::from_chars(row[c].data(), row[c].data() + row[c].size(), value);
        if (error != std::errc() || end != row[c].data() + row[c].size())
          throw RunError(fmt::format("{}: \"{}\" is no number", file, row[c]));
        values[c].push_back(value);
      }
    }
    if (columns.empty() || columns[0] != "time_s") throw RunError(file + " does not begin with time_s");
  }

  const std::vector<double>& of(const std::string& column) const {
    const auto at = std::find(columns.begin(), columns.end(), column);
    if (at == columns.end()) throw RunError(file + " has no column " + column);
    return values[static_cast<std::size_t>(at - columns.begin())];
  }
};

void readTorques(const std::filesystem::path& csv, RunNumbers& run) {
  const Curves curves(csv);
  run.time_s = curves.values[0];
  for (JointNumbers& j : run.joints) j.torque_Nm = curves.of(j.name + (j.prismatic ? "_N" : "_Nm"));
}

void readPressures(const std::filesystem::path& csv, RunNumbers& run) {
  const Curves curves(csv);
  run.pressure_time_s = curves.values[0];
  for (ComfortNumbers& c : run.comfort) {
    c.largest_Pa = curves.of(c.zone + "_largest_Pa");
    c.mean_so_far_Pa = curves.of(c.zone + "_mean_so_far_Pa");
  }
}

}  // namespace

std::string JointNumbers::movement() const {
  const std::size_t cut = label.find('(');
  return cut == std::string::npos ? "" : label.substr(cut + 1, label.size() - cut - 2);
}

std::optional<double> JointNumbers::part() const {
  return natural_Nm && *natural_Nm > 0 ? std::optional(std::abs(peak_Nm) / *natural_Nm) : std::nullopt;
}

double ComfortNumbers::part_of_limit() const { return std::max(mean_Pa / red_Pa, peak_Pa / peak_limit_Pa); }

double RunNumbers::mass_kg() const {
  double m = 0;
  for (const GarmentNumbers& l : garments) m += l.mass_kg;
  return m;
}

int RunNumbers::failing() const {
  return static_cast<int>(std::count_if(checks.begin(), checks.end(), [](const CheckNumbers& c) { return !c.holds; }));
}

const JointNumbers* RunNumbers::highest() const {
  const JointNumbers* best = nullptr;
  for (const JointNumbers& j : joints)
    if (!j.prismatic && j.applies() && std::isfinite(j.peak_Nm) &&
        (!best || std::abs(j.peak_Nm) > std::abs(best->peak_Nm)))
      best = &j;
  return best;
}

const JointNumbers* RunNumbers::decisive() const {
  const JointNumbers* best = nullptr;
  for (const JointNumbers& j : joints)
    if (!j.prismatic && j.applies() && j.part() && (!best || *j.part() > *best->part())) best = &j;
  return best ? best : highest();
}

Trust RunNumbers::trust() const {
  Trust t;
  for (const CheckNumbers& c : checks) t.check(c.holds, checkWords(c.name, c.value, c.limit, c.unit).order);
  for (const Stretch& s : stretch) t.stretch(s);
  t.unplayed = !played;
  return t;
}

double RunNumbers::p99_strain() const {
  double most = std::nan("");
  for (const StressNumbers& s : stress) most = std::fmax(most, s.p99_strain);
  return most;
}

bool RunNumbers::natural() const {
  return std::any_of(joints.begin(), joints.end(), [](const JointNumbers& j) { return j.part().has_value(); });
}

double RunNumbers::thinnest_mm() const {
  double least = 0;
  for (const GarmentNumbers& l : garments)
    least = least > 0 ? std::min(least, 1e3 * l.thickness_m) : 1e3 * l.thickness_m;
  return least;
}

std::string RunNumbers::heldAgainst(const std::string& check) const {
  return check.starts_with("Penetration") && thinnest_mm() > 0
             ? fmt::format(", thinnest cloth {} mm", formatNumber(thinnest_mm(), 2))
             : "";
}

double RunNumbers::sinking_mm() const {
  double most = std::nan("");
  for (const CheckNumbers& c : checks)
    if (c.name.starts_with("Sinking") && c.unit == "mm") most = std::fmax(most, c.value);
  return most;
}

const JointNumbers* RunNumbers::joint(const std::string& name) const {
  for (const JointNumbers& j : joints)
    if (j.name == name) return &j;
  return nullptr;
}

const ComfortNumbers* RunNumbers::comfortOf(const std::string& zone) const {
  for (const ComfortNumbers& c : comfort)
    if (c.zone == zone) return &c;
  return nullptr;
}

const ComfortNumbers* RunNumbers::leastComfortable() const {
  const auto rank = [](const ComfortNumbers& c) { return c.light == "red" ? 2 : c.light == "amber" ? 1 : 0; };
  const ComfortNumbers* worst = nullptr;
  for (const ComfortNumbers& c : comfort)
    if (!worst || rank(c) > rank(*worst) || (rank(c) == rank(*worst) && c.part_of_limit() > worst->part_of_limit()))
      worst = &c;
  return worst;
}

double RunNumbers::pressing_N() const {
  double sum = 0;
  for (const ZoneNumbers& z : zones) sum += z.normal_N;
  return sum;
}

RunNumbers readRun(const std::filesystem::path& folder) {
  RunNumbers run;
  try {
    std::ifstream stream(folder / "summary.json");
    if (!stream) throw RunError((folder / "summary.json").string() + " cannot be read");
    const auto parsed = nlohmann::json::parse(stream);
    const Json j(parsed);
    if (!j.contains("joints")) {  // a structure: its own page says what there is
      run.good = true;
      return run;
    }
    run.recorded_to_s = j.at("recorded_to_s").number();
    run.planned_to_s = j.at("planned_to_s").number();
    run.counted_from_s = j.at("counted_from_s").number();
    run.control_points = j.at("control_points").integer();
    run.largest_strain = j.at("largest_strain").number();
    for (const Json& l : j.at("garments").list())
      run.garments.push_back({l.at("garment").text(), l.at("mass_kg").number(), l.at("area_m2").number(),
                              l.at("thickness_m").number(), l.at("control_points").integer()});
    for (const Json& joint : j.at("joints").list()) run.joints.push_back(jointOf(joint));
    for (const Json& c : j.at("contact").list())
      run.contact.push_back({c.at("segment").text(), c.at("share").number(), c.at("mean_N").number(),
                             c.at("peak_N").number(), c.at("normal_mean_N").number(),
                             c.at("friction_mean_N").number()});
    readZones(j.at("body_zones").at("rows"), run);
    for (const auto& [zone, k] : j.at("comfort").items())
      run.comfort.push_back({zone, k.at("light").text(), k.at("mean_Pa").number(), k.at("peak_Pa").number(),
                             k.at("red_Pa").number(), k.at("peak_limit_Pa").number(), k.at("dose_kPa_min").number(),
                             k.at("peak_time_s").number(), k.at("amber_Pa").number(), k.at("peak_during").text()});
    for (const Json& s : j.at("stress").list())
      run.stress.push_back({s.at("region").text(), s.at("p50_N_per_m").number(), s.at("p95_N_per_m").number(),
                            s.at("p99_N_per_m").number(), s.at("max_N_per_m").number(),
                            optional(s, "p99_strain").value_or(std::nan("")), s.at("max_strain").number()});
    if (j.contains("collisions")) run.crossings_dressed = crossingsDressed(j.at("collisions").at("windows"));
    if (j.contains("played")) {
      const std::string played = j.at("played").text();
      run.played = played != "nothing" && played != "the lead-in";
    }
    for (const Json& s : j.at("stretch").list())
      run.stretch.push_back({s.at("limit").number(), s.at("p99_strain").number(), s.at("max_strain").number(),
                             s.at("stated").flag(), s.at("garment").text(), s.at("along").text()});
    for (const Json& c : j.at("audit").list())
      run.checks.push_back({c.at("check").text(), c.at("value").is_number() ? c.at("value").number() : std::nan(""),
                            c.at("limit").number(), c.at("unit").text(), c.at("holds").flag()});
    if (!run.joints.empty()) readTorques(folder / "torques.csv", run);
    if (!run.comfort.empty()) readPressures(folder / "pressures.csv", run);
    run.good = true;
  } catch (const Json::Error& e) {
    run = {};
    run.why = fmt::format("{}: {}", (folder / "summary.json").string(), e.what());
  } catch (const nlohmann::json::exception& e) {
    run = {};
    run.why = fmt::format("{}: {}", (folder / "summary.json").string(), jsonReason(e.what()));
  } catch (const RunError& e) {
    run = {};
    run.why = e.what();
  }
  return run;
}

}  // namespace gambeson::study
