/// Detail of compare.hpp: study.json and the tables as CSV.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cases/study/compare.hpp"
#include "cases/study/files.hpp"
#include "cases/study/population_answer.hpp"
#include "cases/study/table_rows.hpp"
#include "core/io/own_file.hpp"

namespace gambeson::study {
namespace {

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
  std::string out =
      csvRow({"setting", "joint", "coarse_control_points", "fine_control_points", "coarse_peak_Nm", "fine_peak_Nm",
              "peak_difference_ratio", "history_difference_of_peak", "error_bar_of_peak"});
  for (const MeshRow& m : c.meshes)
    out += csvRow({m.setting, m.joint, std::to_string(m.coarse_points), std::to_string(m.fine_points),
                   cell(m.coarse_Nm), cell(m.fine_Nm), cell(m.difference), cell(m.course), cell(m.bar)});
  return out;
}

StudyJson variantJson(const Study& s, const Comparison& c, std::size_t i) {
  const Variant& v = s.variants[i];
  const RunNumbers& r = c.runs[i];
  StudyJson j{
      {"variant", v.folder}, {"label", v.label}, {"case_hash", v.identity}, {"status", r.good ? "done" : "failed"}};
  if (!r.good) j["why"] = r.why;
  for (std::size_t a = 0; a < s.axes.size(); ++a)
    j["levels"][s.axes[a].name] = s.axes[a].levels[static_cast<std::size_t>(v.levels[a])].label;
  if (v.part != BarPart::none) {
    j["error_bar_of"] = s.variants[static_cast<std::size_t>(v.reference)].folder;
    j["part"] = nameOf(v.part);
    if (!v.scores.empty()) j["scores"] = v.scores;
  }
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
    StudyJson n{{"joint", joint.name},
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

StudyJson elasticityJson(const ElasticityRow& e) {
  return {{"setting", e.setting},
          {"joint", e.joint},
          {"quantity", e.quantity},
          {"bending", number(e.e.bending)},
          {"membrane", number(e.e.membrane)},
          {"weight", number(e.e.weight)},
          {"inertia", number(e.e.inertia)},
          {"drag", number(e.e.drag)},
          {"sum", number(e.e.sum())},
          {"rest", e.e.sum() ? number(1 - *e.e.sum()) : StudyJson(nullptr)},
          {"predicted_thickness_exponent", number(e.e.thicknessExponent())},
          {"measured_thickness_exponent", number(e.measured)}};
}

StudyJson mapRunJson(const Optimise& o, const MapRun& r) {
  StudyJson j{{"variant", r.folder},
         {"torque_Nm", number(r.torque_Nm)},
         {"joint", r.joint},
         {"mass_kg", r.mass_kg},
         {"failing_checks", r.failing}};
  if (!r.why.empty()) j["why"] = r.why;
  const auto free = o.free();
  for (std::size_t i = 0; i < free.size(); ++i) j["factors"][free[i]->name] = r.map[i];
  return j;
}

StudyJson optimiseJson(const Optimise& o) {
  const MapGain g = gainOf(o);
  StudyJson j{{"minimise", o.aim == Aim::torque ? "torque" : "mass"},
         {"runs", o.found.runs.size()},
         {"best", mapRunJson(o, o.found.found())},
         {"start", mapRunJson(o, o.found.start())},
         {"gain", g.gain},
         {"error_bar", g.bar()},
         {"noise", g.noise},
         {"mesh", number(g.mesh)},
         {o.aim == Aim::torque ? "gain_on_finer_mesh" : "torque_on_finer_mesh_Nm", number(g.finer)},
         {"sure", g.sure},
         {"helps_until", g.helps_until + 1}};
  const auto pair = [&](const MapPair& p) {
    return StudyJson{{"what", p.what}, {"start", mapRunJson(o, p.start)}, {"best", mapRunJson(o, p.best)}};
  };
  for (const MapPair& p : o.found.repeats) j["repeats"].push_back(pair(p));
  if (o.found.finer) j["finer"] = pair(*o.found.finer);
  return j;
}

/// A row for each map in the order of the search, then those of the error bar.
std::string mapsTable(const Optimise& o) {
  std::vector<std::string> row{"variant", "what"};
  for (const MapRegion* r : o.free()) row.push_back(r->name + "_factor");
  row.insert(row.end(), {"mass_kg", "torque_Nm", "joint", "failing_checks"});
  std::string out = csvRow(row);
  const auto add = [&](const MapRun& r, const std::string& what) {
    row = {r.folder, r.why.empty() ? what : "failed"};
    for (const double factor : r.map) row.push_back(cell(factor));
    row.insert(row.end(), {cell(r.mass_kg), cell(r.torque_Nm), r.joint, std::to_string(r.failing)});
    out += csvRow(row);
  };
  for (const MapRun& r : o.found.runs) add(r, "search");
  const auto both = [&](const MapPair& p) {
    add(p.start, p.what);
    if (o.found.best > 0) add(p.best, p.what);
  };
  for (const MapPair& p : o.found.repeats) both(p);
  if (o.found.finer) both(*o.found.finer);
  return out;
}

std::string studyJson(const Study& s, const Comparison& c) {
  StudyJson j{{"name", s.name}, {"version", GAMBESON_VERSION}};
  const Verdict& v = c.verdict;
  const StudyJson named =
      v.take >= 0 ? StudyJson(c.input.options[static_cast<std::size_t>(v.take)].name) : StudyJson(nullptr);
  j["verdict"] = {{"take", v.chosen ? named : StudyJson(nullptr)},
                  {"worst", v.chosen ? StudyJson(nullptr) : named},
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
                  {"error", number(c.input.error())},
                  {"mesh_error", number(c.input.mesh_error)},
                  {"step_error", number(c.input.step_error)},
                  {"fabric_error", number(c.input.fabric_error)},
                  {"next_costs_times", number(v.order)},
                  {"holds_up_to", number(v.holds_up_to)}};
  for (const auto& d : c.input.doubts)
    j["verdict"]["failing_checks"].push_back(
        {{"check", d.check}, {"what", d.text}, {"runs", d.runs.names}, {"touches_the_order", d.order}});
  if (s.optimise) j["optimise"] = optimiseJson(*s.optimise);
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
                           {"history_difference_of_peak", number(m.course)},
                           {"error_bar_of_peak", number(m.bar)}});
  if (s.uncertainty) j["uncertainty"] = uncertaintyJson(s, c);
  if (c.population) j["population"] = populationJson(s, *c.population);
  j["variants"] = StudyJson::array();
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
  writeOwnFile(out / files::uncertainty, uncertaintyTable(s, c));
  if (s.optimise) writeOwnFile(out / files::maps, mapsTable(*s.optimise));
  // Of an earlier study in this folder.
  if (!c.population && isOwnFile(out / files::population)) removeOwnFile(out / files::population);
  if (c.population) writeOwnFile(out / files::population, populationCsv(s, *c.population));
  writeOwnFile(out / files::numbers, studyJson(s, c));
}

}  // namespace gambeson::study
