/// Detail of compare.hpp: study.json and the tables as CSV.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cases/study/compare.hpp"
#include "cases/study/files.hpp"
#include "cases/study/population_answer.hpp"
#include "cases/study/table_cells.hpp"
#include "core/io/own_file.hpp"

namespace gambeson::study {
namespace {

using namespace cells;

/// Names in the order in which the runs have them first.
template <class Each>
std::vector<std::string> namesOf(const std::vector<RunNumbers>& runs, Each each) {
  std::vector<std::string> names;
  for (const RunNumbers& r : runs)
    each(r, [&](const std::string& name) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    });
  return names;
}

/// Percentiles of the region that carries the most.
StressNumbers highestStress(const RunNumbers& run) {
  StressNumbers top;
  for (const StressNumbers& s : run.stress)
    if (s.p99_N_per_m > top.p99_N_per_m) top = s;
  return top;
}

std::string variantsTable(const Study& s, const Comparison& c) {
  const auto joints = namesOf(c.runs, [](const RunNumbers& r, auto add) {
    for (const auto& j : r.joints) add(j.name);
  });
  const auto garments = namesOf(c.runs, [](const RunNumbers& r, auto add) {
    for (const auto& l : r.garments) add(l.name);
  });
  const auto segments = namesOf(c.runs, [](const RunNumbers& r, auto add) {
    for (const auto& b : r.contact)
      if (b.share > 0) add(b.segment);
  });
  std::vector<std::string> row{"variant", "status"};
  for (const Axis& a : s.axes) row.push_back(a.name);
  row.insert(row.end(), {"baseline", "control_points"});
  for (const std::string& l : garments)
    for (const char* what : {"thickness_m", "mass_kg"})
      row.push_back(fmt::format("{}_{}", l.empty() ? "garment" : l, what));
  row.insert(row.end(), {"mass_kg", "highest_joint"});
  for (const std::string& j : joints)
    for (const char* what :
         {"peak_Nm", "peak_time_s", "rms_Nm", "standing_Nm", "peak_above_standing_Nm", "of_natural", "peak_ratio",
          "rms_ratio", "correlation", "normal_mean_N", "friction_mean_N", "friction_at_peak_Nm"})
      row.push_back(fmt::format("{}_{}", j, what));
  for (const std::string& b : segments) row.push_back(fmt::format("{}_contact_share", b));
  const auto zones = namesOf(c.runs, [](const RunNumbers& r, auto add) {
    for (const auto& z : r.zones) add(z.zone);
  });
  for (const std::string& z : zones) row.push_back(fmt::format("{}_pressing_N", z));
  row.insert(row.end(), {"least_comfortable", "comfort", "pressure_mean_Pa", "limit_mean_Pa", "pressure_peak_Pa",
                         "limit_peak_Pa", "dose_kPa_min"});
  row.insert(row.end(), {"stress_region", "stress_p50_N_per_m", "stress_p95_N_per_m", "stress_p99_N_per_m",
                         "stress_max_N_per_m", "largest_strain", "failing_checks"});
  const std::size_t columns = row.size();
  std::string out = csvRow(row);
  for (std::size_t i = 0; i < s.variants.size(); ++i) {
    const Variant& v = s.variants[i];
    const RunNumbers& r = c.runs[i];
    row = {v.folder, r.good ? "done" : "failed"};
    for (std::size_t a = 0; a < s.axes.size(); ++a)
      row.push_back(s.axes[a].levels[static_cast<std::size_t>(v.levels[a])].label);
    row.push_back(v.baseline >= 0 ? s.variants[static_cast<std::size_t>(v.baseline)].folder : std::string());
    if (r.good) {
      row.push_back(std::to_string(r.control_points));
      for (const std::string& name : garments) {
        std::optional<double> thickness, mass;
        for (const GarmentNumbers& l : r.garments)
          if (l.name == name) thickness = l.thickness_m, mass = l.mass_kg;
        row.insert(row.end(), {cell(thickness), cell(mass)});
      }
      row.push_back(cell(r.mass_kg()));
      row.push_back(r.highest() ? r.highest()->name : std::string());
      for (const std::string& name : joints) {
        const JointNumbers* j = r.joint(name);
        const JointRatio* ratio = ratioOf(c, i, name);
        if (!j) {
          row.resize(row.size() + 12);
          continue;
        }
        row.insert(row.end(),
                   {cell(j->peak_Nm), cell(j->peak_time_s), cell(j->rms_Nm), cell(j->standing_Nm),
                    cell(peakAboveStanding(r, *j)), cell(j->part()), ratio ? cell(ratio->peak) : std::string(),
                    ratio ? cell(ratio->rms) : std::string(), ratio ? cell(ratio->likeness.correlation) : std::string(),
                    cell(j->normal_N), cell(j->friction_N), cell(j->friction_Nm)});
      }
      for (const std::string& name : segments) {
        std::optional<double> share;
        for (const ContactNumbers& b : r.contact)
          if (b.segment == name) share = b.share;
        row.push_back(cell(share));
      }
      for (const std::string& name : zones) {
        std::optional<double> pressing;
        for (const ZoneNumbers& z : r.zones)
          if (z.zone == name) pressing = z.normal_N;
        row.push_back(cell(pressing));
      }
      const ComfortNumbers* least = r.leastComfortable();
      row.insert(row.end(), {least ? least->zone : "", least ? least->light : "", least ? cell(least->mean_Pa) : "",
                             least ? cell(least->red_Pa) : "", least ? cell(least->peak_Pa) : "",
                             least ? cell(least->peak_limit_Pa) : "", least ? cell(least->dose_kPa_min) : ""});
      const StressNumbers top = highestStress(r);
      std::string failing;
      for (const CheckNumbers& k : r.checks)
        if (!k.holds) failing += (failing.empty() ? "" : "; ") + k.name;
      row.insert(row.end(), {top.region, cell(top.p50_N_per_m), cell(top.p95_N_per_m), cell(top.p99_N_per_m),
                             cell(top.max_N_per_m), cell(r.largest_strain), failing});
    }
    row.resize(columns);
    out += csvRow(row);
  }
  return out;
}

std::string curvesTable(const Study& s, const Comparison& c) {
  const auto joints = namesOf(c.runs, [](const RunNumbers& r, auto add) {
    for (const auto& j : r.joints) add(j.name);
  });
  std::vector<std::string> row{"variant", "time_s"};
  for (const std::string& j : joints) row.push_back(fmt::format("{}_Nm", j));
  std::string out = csvRow(row);
  for (std::size_t i = 0; i < s.variants.size(); ++i)
    for (std::size_t w = 0; w < c.runs[i].time_s.size(); ++w) {
      row = {s.variants[i].folder, cell(c.runs[i].time_s[w])};
      for (const std::string& name : joints) {
        const JointNumbers* j = c.runs[i].joint(name);
        row.push_back(j ? cell(j->torque_Nm[w]) : std::string());
      }
      out += csvRow(row);
    }
  return out;
}

std::string exponentsTable(const Comparison& c) {
  std::string out = csvRow({"axis", "setting", "joint", "quantity", "exponent", "standard_error",
                            "lowest_between_neighbours", "highest_between_neighbours", "points"});
  for (const AxisExponent& e : c.exponents)
    out += csvRow({e.axis, e.setting, e.joint, e.quantity, cell(e.law.exponent), cell(e.law.standard_error),
                   cell(e.law.lowest), cell(e.law.highest), std::to_string(e.law.points)});
  return out;
}

std::string elasticitiesTable(const Comparison& c) {
  std::string out = csvRow({"setting", "joint", "quantity", "bending", "membrane", "weight", "inertia", "drag", "sum",
                            "predicted_thickness_exponent", "measured_thickness_exponent"});
  for (const ElasticityRow& e : c.elasticities)
    out +=
        csvRow({e.setting, e.joint, e.quantity, cell(e.e.bending), cell(e.e.membrane), cell(e.e.weight),
                cell(e.e.inertia), cell(e.e.drag), cell(e.e.sum()), cell(e.e.thicknessExponent()), cell(e.measured)});
  return out;
}

std::string meshesTable(const Comparison& c) {
  std::string out = csvRow({"setting", "joint", "coarse_control_points", "fine_control_points", "coarse_peak_Nm",
                            "fine_peak_Nm", "peak_difference_ratio", "history_difference_of_peak"});
  for (const MeshRow& m : c.meshes)
    out += csvRow({m.setting, m.joint, std::to_string(m.coarse_points), std::to_string(m.fine_points),
                   cell(m.coarse_Nm), cell(m.fine_Nm), cell(m.difference), cell(m.course)});
  return out;
}

Json variantJson(const Study& s, const Comparison& c, std::size_t i) {
  const Variant& v = s.variants[i];
  const RunNumbers& r = c.runs[i];
  Json j{{"variant", v.folder}, {"label", v.label}, {"case_hash", v.identity}, {"status", r.good ? "done" : "failed"}};
  if (!r.good) j["why"] = r.why;
  for (std::size_t a = 0; a < s.axes.size(); ++a)
    j["levels"][s.axes[a].name] = s.axes[a].levels[static_cast<std::size_t>(v.levels[a])].label;
  if (v.baseline >= 0) j["baseline"] = s.variants[static_cast<std::size_t>(v.baseline)].folder;
  if (!r.good) return j;
  j["control_points"] = r.control_points;
  j["mass_kg"] = r.mass_kg();
  for (const GarmentNumbers& l : r.garments)
    j["layers"].push_back(
        {{"garment", l.name}, {"mass_kg", l.mass_kg}, {"area_m2", l.area_m2}, {"thickness_m", l.thickness_m}});
  j["light"] = nameOf(c.lights[i]);
  if (r.highest()) j["highest"] = r.highest()->name;
  for (const JointNumbers& joint : r.joints) {
    Json n{{"joint", joint.name},
           {"applies", joint.applies()},
           {"peak_Nm", number(joint.peak_Nm)},
           {"peak_time_s", joint.peak_time_s},
           {"rms_Nm", number(joint.rms_Nm)},
           {"standing_Nm", number(joint.standing_Nm)},
           {"peak_above_standing_Nm", number(peakAboveStanding(r, joint))},
           {"of_natural", number(joint.part())},
           {"normal_mean_N", joint.normal_N},
           {"friction_mean_N", joint.friction_N},
           {"friction_at_peak_Nm", number(joint.friction_Nm)}};
    if (const JointRatio* ratio = ratioOf(c, i, joint.name)) {
      n["peak_ratio"] = number(ratio->peak);
      n["rms_ratio"] = number(ratio->rms);
      n["correlation"] = number(ratio->likeness.correlation);
      n["rms_difference_ratio"] = number(ratio->likeness.relative);
    }
    j["joints"].push_back(n);
  }
  for (const ZoneNumbers& z : r.zones)
    j["body_zones"].push_back(
        {{"zone", z.zone}, {"force_N", z.force_N}, {"normal_N", z.normal_N}, {"friction_N", z.friction_N}});
  if (const ComfortNumbers* k = r.leastComfortable())
    j["least_comfortable"] = {{"zone", k->zone},
                              {"light", k->light},
                              {"mean_Pa", k->mean_Pa},
                              {"peak_Pa", k->peak_Pa},
                              {"dose_kPa_min", k->dose_kPa_min}};
  for (const CheckNumbers& k : r.checks)
    if (!k.holds) j["failing_checks"].push_back(k.name);
  return j;
}

Json elasticityJson(const ElasticityRow& e) {
  return {{"setting", e.setting},
          {"joint", e.joint},
          {"quantity", e.quantity},
          {"bending", number(e.e.bending)},
          {"membrane", number(e.e.membrane)},
          {"weight", number(e.e.weight)},
          {"inertia", number(e.e.inertia)},
          {"drag", number(e.e.drag)},
          {"sum", number(e.e.sum())},
          {"rest", e.e.sum() ? number(1 - *e.e.sum()) : Json(nullptr)},
          {"predicted_thickness_exponent", number(e.e.thicknessExponent())},
          {"measured_thickness_exponent", number(e.measured)}};
}

std::string studyJson(const Study& s, const Comparison& c) {
  Json j{{"name", s.name}, {"version", GAMBESON_VERSION}};
  const Verdict& v = c.verdict;
  const Json named = v.take >= 0 ? Json(c.input.options[static_cast<std::size_t>(v.take)].name) : Json(nullptr);
  j["verdict"] = {{"take", v.chosen ? named : Json(nullptr)},
                  {"worst", v.chosen ? Json(nullptr) : named},
                  {"light", nameOf(v.cover)},
                  {"light_of_torque", nameOf(v.light)},
                  {"doubt", v.doubt},
                  {"sentence", v.sentence},
                  {"layers", v.garments},
                  {"enough", v.enough},
                  {"estimate", v.estimate},
                  {"why", v.why},
                  {"comfort", v.comfort},
                  {"comfort_light", nameOf(v.comfort_light)},
                  {"choice", v.choice},
                  {"choice_is_sure", v.surety == Surety::yes      ? "yes"
                                     : v.surety == Surety::fairly ? "fairly"
                                                                  : "no"},
                  {"numbers", v.numbers},
                  {"mesh_error", number(c.input.mesh_error)},
                  {"next_costs_times", number(v.order)},
                  {"holds_up_to", number(v.holds_up_to)}};
  for (const auto& d : c.input.doubts)
    j["verdict"]["failing_checks"].push_back(
        {{"check", d.check}, {"what", d.text}, {"runs", d.runs.names}, {"touches_the_order", d.order}});
  j["limits"] = {{"green_below", s.limits.green}, {"red_above", s.limits.red}, {"source", s.limits.source}};
  for (const AxisExponent& e : c.exponents)
    j["exponents"].push_back({{"axis", e.axis},
                              {"setting", e.setting},
                              {"joint", e.joint},
                              {"quantity", e.quantity},
                              {"exponent", e.law.exponent},
                              {"standard_error", number(e.law.standard_error)},
                              {"lowest", e.law.lowest},
                              {"highest", e.law.highest},
                              {"points", e.law.points}});
  for (const ElasticityRow& e : c.elasticities) j["elasticities"].push_back(elasticityJson(e));
  for (const MeshRow& m : c.meshes)
    j["meshes"].push_back({{"setting", m.setting},
                           {"joint", m.joint},
                           {"coarse_control_points", m.coarse_points},
                           {"fine_control_points", m.fine_points},
                           {"coarse_peak_Nm", number(m.coarse_Nm)},
                           {"fine_peak_Nm", number(m.fine_Nm)},
                           {"peak_difference_ratio", number(m.difference)},
                           {"history_difference_of_peak", number(m.course)}});
  if (c.population) j["population"] = populationJson(s, *c.population);
  j["variants"] = Json::array();
  for (std::size_t i = 0; i < s.variants.size(); ++i) j["variants"].push_back(variantJson(s, c, i));
  return j.dump(2) + "\n";
}

}  // namespace

void writeStudyTables(const Study& s, const Comparison& c, const std::filesystem::path& out) {
  writeOwnFile(out / files::variants, variantsTable(s, c));
  writeOwnFile(out / files::curves, curvesTable(s, c));
  writeOwnFile(out / files::exponents, exponentsTable(c));
  writeOwnFile(out / files::elasticities, elasticitiesTable(c));
  writeOwnFile(out / files::meshes, meshesTable(c));
  // Of an earlier study in this folder.
  if (!c.population && isOwnFile(out / files::population)) removeOwnFile(out / files::population);
  if (c.population) writeOwnFile(out / files::population, populationCsv(s, *c.population));
  writeOwnFile(out / files::numbers, studyJson(s, c));
}

}  // namespace gambeson::study
