/// Detail of results.hpp: report.html of a structure, from the files of its run.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "analysis/report/html.hpp"
#include "analysis/report/parts.hpp"
#include "analysis/report/xy_chart.hpp"
#include "analysis/ticks.hpp"
#include "cases/cloth/fabric_input.hpp"
#include "cases/cloth/make_cloth.hpp"
#include "cases/cloth/usual.hpp"
#include "cases/input/message.hpp"
#include "cases/structure/fields.hpp"
#include "cases/structure/results.hpp"
#include "core/error.hpp"
#include "core/io/csv_text.hpp"
#include "core/io/own_file.hpp"

namespace gambeson {
namespace {

using html::element;
using html::escape;
using Json = nlohmann::ordered_json;

Json summaryOf(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw InputError({file.string(), 0, ""}, "cannot be opened");
  try {
    return Json::parse(stream);
  } catch (const nlohmann::json::exception& e) {
    throw InputError({file.string(), 0, ""}, jsonReason(e.what()));
  }
}

/// What is not finite is null in the file.
double numberOf(const Json& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

PathTable tableFrom(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw InputError({file.string(), 0, ""}, "cannot be opened");
  PathTable table;
  std::string line;
  if (std::getline(stream, line)) table.columns = csvCells(line);
  while (std::getline(stream, line)) {
    std::vector<double> row;
    for (const std::string& part : csvCells(line)) {
      const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), row.emplace_back());
      if (error != std::errc() || end != part.data() + part.size())
        throw InputError({file.string(), static_cast<int>(table.rows.size()) + 2, ""}, "\"" + part + "\" is no number");
    }
    if (row.size() != table.columns.size()) throw InputError({file.string(), 0, ""}, "a row has another length");
    table.rows.push_back(std::move(row));
  }
  return table;
}

double largest(const std::vector<double>& v) {
  double most = 0;
  for (const double x : v) most = std::max(most, std::abs(x));
  return most;
}

/// Numbers below this part of what they stand beside are rounding, and not shown.
constexpr double kRounding = 1e-9;

/// One plot per named point and edge. Static: load factor over displacement, as the literature draws it; dynamic:
/// displacement over time. `force_N`, `moment_Nm`: what reactions stand beside.
std::string plots(const StructureCase& c, const PathTable& t, double force_N, double moment_Nm) {
  std::string out;
  const bool statics = c.kind == StructureKind::statics;
  const std::vector<double> lead = t.column(statics ? "factor" : "time_s");
  const auto plot = [&](const std::string& name, const char* letter, const std::string& unit, const std::string& what,
                        bool over) {
    XyPlot p{what + (letter[0] == 'f' ? " on " : " of ") + name,
             "",
             over      ? what + " [" + unit + "]"
             : statics ? "load factor"
                       : "time [s]",
             over ? "load factor" : what + " [" + unit + "]",
             {},
             false};
    double most = letter[0] == 'r' || letter[0] == 'f' ? force_N : letter[0] == 'm' ? moment_Nm : 0;
    for (const char* axis : {"x", "y", "z"})
      most = std::max(most, largest(t.column(name + "_" + letter + axis + "_" + unit)));
    for (const char* axis : {"x", "y", "z"}) {
      const std::vector<double> values = t.column(name + "_" + letter + axis + "_" + unit);
      // Components that are rounding beside the others are left out.
      if (values.empty() || !(largest(values) > kRounding * most)) continue;
      XySeries series{std::string(axis), over ? values : lead, over ? lead : values, false};
      p.series.push_back(std::move(series));
    }
    if (!p.series.empty()) out += xyChart(p);
  };
  for (const OutputPoint& p : c.output.points) plot(p.name, "u", "m", "displacement", statics);
  for (const OutputEdge& e : c.output.edges) {
    plot(e.name, "u", "m", "displacement", statics);
    plot(e.name, "r", "N", "reaction", false);
    plot(e.name, "m", "Nm", "reaction moment", false);
  }
  for (const ObstacleCase& o : c.obstacles) plot(o.name, "f", "N", "force", false);
  if (!statics) {
    XyPlot p{"Energy", "", "time [s]", "energy [J]", {}, false};
    for (const auto& [column, name] :
         {std::pair("kinetic_energy_J", "kinetic"), std::pair("strain_energy_J", "strain"),
          std::pair("external_energy_J", "of the loads"), std::pair("total_energy_J", "total")})
      p.series.push_back({name, lead, t.column(column), false});
    if (c.contact) p.series.push_back({"work of contact", lead, t.column(contact_work_column), false});
    out += xyChart(p);
  } else {
    out += xyChart({"Strain energy",
                    "",
                    "load factor",
                    "strain energy [J]",
                    {{"strain energy", lead, t.column("strain_energy_J"), false}},
                    false});
  }
  return out;
}

std::string placesTable(const Json& summary) {
  std::string out;
  for (const auto& [list, title] :
       {std::pair("points", "Named points at the end"), std::pair("edges", "Named edges at the end")}) {
    if (!summary.contains(list) || summary.at(list).empty()) continue;
    Table table{title, "", {"name"}, {}};
    const Json& first = summary.at(list).front();
    for (const auto& [key, value] : first.items())
      if (key != "name") table.columns.push_back(key);
    for (const Json& place : summary.at(list)) {
      std::vector<TableCell> row{TableCell(place.at("name").get<std::string>())};
      for (std::size_t k = 1; k < table.columns.size(); ++k)
        row.push_back(place.contains(table.columns[k]) ? TableCell(numberOf(place.at(table.columns[k])), 5)
                                                       : TableCell(""));
      table.rows.push_back(std::move(row));
    }
    out += tableOf(table);
  }
  return out;
}

std::string modesTable(const Json& summary) {
  Table table{"Natural frequencies",
              "A negative frequency marks an equilibrium that is not stable.",
              {"mode", "frequency [Hz]", "omega [rad/s]", "residual"},
              {}};
  int k = 0;
  for (const Json& m : summary.at("modes"))
    table.rows.push_back({TableCell(std::to_string(++k)), TableCell(numberOf(m.at("frequency_Hz")), 6),
                          TableCell(numberOf(m.at("omega_rad_per_s")), 6), TableCell(numberOf(m.at("residual")), 2)});
  return tableOf(table);
}

/// The result in one sentence.
std::string sentenceOf(const StructureCase& c, const Json& s) {
  if (c.kind == StructureKind::modal) {
    if (s.at("modes").empty()) return "No frequency was found.";
    return fmt::format("The lowest natural frequency is {} Hz.",
                       formatNumber(numberOf(s.at("modes")[0].at("frequency_Hz")), 5));
  }
  const std::string moved = formatNumber(numberOf(s.at("largest_displacement_m")), 4);
  if (c.kind == StructureKind::dynamics)
    return fmt::format("At {} s the largest displacement is {} m.", formatNumber(numberOf(s.at("time_s")), 4), moved);
  std::string text = fmt::format("At load factor {} the largest displacement is {} m",
                                 formatNumber(numberOf(s.at("factor")), 4), moved);
  if (c.output.points.size() == 1 && !s.at("points").empty()) {
    const Json& p = s.at("points")[0];
    if (p.contains("ux_m")) {
      const double u[] = {numberOf(p.at("ux_m")), numberOf(p.at("uy_m")), numberOf(p.at("uz_m"))};
      const double most = std::max({std::abs(u[0]), std::abs(u[1]), std::abs(u[2])});
      const auto shown = [&](double v) { return formatNumber(std::abs(v) > kRounding * most ? v : 0, 4); };
      text +=
          fmt::format("; {} moves by ({}, {}, {}) m", c.output.points[0].name, shown(u[0]), shown(u[1]), shown(u[2]));
    }
  }
  return text + ".";
}

std::string contactInWords(const StructureCase& c) {
  if (!c.contact) return "No contact; the sheet may pass through itself.";
  std::string what;
  for (std::size_t k = 0; k < c.obstacles.size(); ++k)
    what += (k == 0 ? "" : k + 1 == c.obstacles.size() ? " and " : ", ") + c.obstacles[k].name;
  const std::string self = c.contact->self ? "itself" : "";
  const FrictionLaw& friction = c.contact->friction;
  return fmt::format("The sheet touches {}{}{}, with {}{}.", what, what.empty() || self.empty() ? "" : ", and ", self,
                     friction.isCoulomb() ? "Coulomb friction " + formatNumber(friction.kinetic, 3) : inWords(friction),
                     self.empty() ? "; it may pass through itself" : "");
}

std::vector<std::string> assumptionsOf(const StructureCase& c) {
  const schema::Object& table = schema::structureTable(c.kind);
  const JsonNode node = schema::writeObject(table, &c);
  std::vector<std::string> a = unusualNumbers(table, node);
  for (std::string& note : assumedThicknesses(node)) a.push_back(std::move(note));
  a.push_back(inWords(c.sheet.cloth));
  if (std::string own = ownLawsInWords(c.sheet.cloth); !own.empty()) a.push_back(std::move(own));
  const bool linear = c.kind == StructureKind::statics && c.statics.linear;
  a.push_back(linear ? "Small displacements: forces, strains and stress are linear in them."
                     : "Displacements and rotations of any size.");
  struct Law {
    std::string operator()(const IsotropicMaterial&) const {
      return "St. Venant-Kirchhoff material in plane stress, isotropic; bending by h\u00b2/12 of the membrane.";
    }
    std::string operator()(const OrthotropicMaterial&) const {
      return "St. Venant-Kirchhoff material in plane stress, orthotropic about the weft; bending by h\u00b2/12 of the "
             "membrane.";
    }
    std::string operator()(const LaminateMaterial&) const {
      return "Classical laminate: plies from the bottom (\u2212normal) to the top, angles from the weft towards the "
             "warp; the reference surface is at half of the thickness.";
    }
    std::string operator()(const Fabric& f) const {
      return "Fabric: orthotropic membrane (Zheng 2013, eq. 2.13). " + schema::bendingInWords(f.law);
    }
  };
  a.push_back(c.material.energy_source ? "Fabric. " + schema::lawInWords(*c.material.energy_source)
                                       : std::visit(Law{}, c.material.law));
  if (c.material.tension_field)
    a.push_back("The membrane carries no compression (tension field): wrinkles are not resolved.");
  bool dead = false, follow = false;
  for (const StructureLoad& l : c.loads) {
    const bool follows =
        l.sort == LoadSort::pressure || l.sort == LoadSort::moment || l.sort == LoadSort::moment_per_length;
    (follows ? follow : dead) = true;
  }
  if (dead) a.push_back("Forces keep their direction and size, per rest length or area.");
  if (follow) a.push_back("Pressure and edge moments follow the sheet.");
  if (c.sheet.imperfection) a.push_back("The stress-free shape deviates from the ideal one as the case says.");
  if (c.strain_limit) a.push_back(limitInWords(*c.strain_limit, "the last step"));
  if (c.kind == StructureKind::dynamics) a.push_back(contactInWords(c));
  if (c.kind == StructureKind::modal)
    a.push_back(c.modal.at_equilibrium ? "Frequencies about the equilibrium under the loads."
                                       : "Frequencies about the rest shape, without loads.");
  a.push_back("Numbers without a unit in the case count as SI.");
  return a;
}

std::vector<AuditCheck> checksOf(const Json& s) {
  std::vector<AuditCheck> checks;
  if (s.contains("checks"))
    for (const Json& k : s.at("checks"))
      checks.push_back({k.at("check").get<std::string>(), numberOf(k.at("value")), numberOf(k.at("limit")),
                        k.at("unit").get<std::string>(), k.at("meaning").get<std::string>(),
                        k.at("wrong").get<std::string>()});
  return checks;
}

/// What a path by arc length went by.
std::string passedOf(const Json& arc) {
  Table t{"What the path passed", "", {"", "how many", "before the points at load factor"}, {}};
  for (const auto& [key, name] :
       {std::pair("limit_points", "limit points: the load turned"),
        std::pair("bifurcations", "bifurcations: another path branches off, which was not followed"),
        std::pair("unknown_before", "places where the path bends more than the arcs could follow")}) {
    std::string at;
    for (const Json& factor : arc.at(key)) at += (at.empty() ? "" : ", ") + formatNumber(numberOf(factor), 4);
    t.rows.push_back({TableCell(name), TableCell(std::to_string(arc.at(key).size())), TableCell(at)});
  }
  return pageSectionOf(
      "passed", "What the path passed",
      "Arcs are made so short that a straight line between two points misses little of the path. Where that did "
      "not succeed the last row says so: a limit point may lie there unseen.",
      element("div", tableOf(t), " class=\"charts\""));
}

std::string factsTable(const Json& s) {
  Table t{"The run", "", {"fact", "value"}, {}};
  const auto number = [&](const char* key, const char* name, const char* unit) {
    if (!s.contains(key)) return;
    const Json& value = s.at(key);
    t.rows.push_back({TableCell(name),
                      TableCell(value.is_number_integer() ? value.dump() : formatNumber(numberOf(value), 5) + unit)});
  };
  number("patches", "Patches", "");
  number("control_points", "Control points", "");
  number("unknowns", "Unknowns", "");
  number("area_m2", "Area", " m\u00b2");
  number("mass_kg", "Mass", " kg");
  number("strain_energy_J", "Strain energy at the end", " J");
  number("largest_stress_N_per_m", "Largest stress resultant", " N/m");
  number("largest_strain", "Largest strain", "");
  if (s.contains("thread_strain"))
    for (const auto& [where, threads] : s.at("thread_strain").items())
      for (const auto& [thread, values] : threads.items())
        t.rows.push_back(
            {TableCell(fmt::format("Strain of the {} at {} points: largest, mean at the end", thread, where)),
             TableCell(formatNumber(numberOf(values.at("largest")), 3) + ", " +
                       formatNumber(numberOf(values.at("mean")), 3))});
  if (s.contains("contact")) {
    const Json& k = s.at("contact");
    t.rows.push_back({TableCell("Contact: deepest penetration"),
                      TableCell(formatNumber(1e3 * numberOf(k.at("deepest_penetration_m")), 3) + " mm")});
    t.rows.push_back({TableCell("Contact: steps not solved"), TableCell(k.at("unsolved_steps").dump())});
  }
  if (s.contains("strain_limit"))
    for (const auto& [key, value] : s.at("strain_limit").items())
      t.rows.push_back({TableCell("Strain limit: " + key), TableCell(formatNumber(numberOf(value), 3))});
  for (const auto& [key, value] : s.at("solver").items())
    if (value != 0) t.rows.push_back({TableCell("Solver: " + key), TableCell(value.dump())});
  t.rows.push_back(
      {TableCell("Computed in"),
       TableCell(fmt::format("{} s; threads: {}; kernels: {}", formatNumber(numberOf(s.at("timings").at("wall_s"))),
                             s.at("timings").at("threads").dump(), s.at("kernels").get<std::string>()))});
  t.rows.push_back({TableCell("Gambeson"), TableCell(s.at("version").get<std::string>())});
  t.rows.push_back({TableCell("Case hash"), TableCell(s.at("case_hash").get<std::string>())});
  return tableOf(t);
}

std::string structurePage(const StructureCase& c, const Json& s, const PathTable& path,
                          const std::vector<Picture>& pictures) {
  const auto charts = [](const std::string& body) { return element("div", body, " class=\"charts\""); };
  std::string body;
  if (!s.at("finished").get<bool>())
    body += element("p",
                    escape("The run did not reach its end: " + s.at("why").get<std::string>() +
                           ". What follows is what converged before."),
                    " class=\"alarm\" role=\"alert\"");
  const std::vector<AuditCheck> checks = checksOf(s);
  body += alarmOf(checks);
  if (s.contains("jumps") && s.at("jumps").get<int>() > 0 && !s.contains("arc_length"))
    body += html::notice(
        "A load step went over a limit point and landed on a stable state beyond it (column \"jumped\" of path.csv): "
        "the path between is not known. \"arc_length\": true follows it.");
  if (s.contains("rounded_residual") && numberOf(s.at("rounded_residual")) > 1e-6)
    body += html::notice(fmt::format(
        "Rounding kept the forces of some points (column \"rounded\" of path.csv) from balancing within the tolerance: "
        "up to {} of them is left, since the loads are small beside the stiffness.",
        formatNumber(numberOf(s.at("rounded_residual")), 2)));
  if (s.contains("strain_limit") && s.at("strain_limit").at("unconverged_steps").get<long>() > 0)
    body += html::notice(fmt::format(
        "{} of {} steps did not reach the strain limit within its tolerance; the strain missed it by up to {}.",
        s.at("strain_limit").at("unconverged_steps").dump(), s.at("solver").at("steps").dump(),
        formatNumber(numberOf(s.at("strain_limit").at("largest_residual")))));
  const std::string sentence = sentenceOf(c, s);
  std::string head = element("div", element("p", escape(sentence), " class=\"sentence\""), " class=\"words\"");
  if (!pictures.empty()) head += figureOf(pictures.front());
  body += element("section", head,
                  pictures.empty() ? " class=\"headline\" aria-label=\"The result\""
                                   : " class=\"headline pictured\" aria-label=\"The result\"");
  if (c.kind == StructureKind::modal) {
    body += pageSectionOf("modes", "Frequencies", "", charts(modesTable(s)));
  } else {
    const double size = std::sqrt(numberOf(s.at("area_m2"))), force = numberOf(s.at("largest_stress_N_per_m")) * size;
    body += pageSectionOf("path", c.kind == StructureKind::statics ? "The path" : "The motion",
                          "All numbers are in path.csv.", charts(plots(c, path, force, force * size) + placesTable(s)));
  }
  if (pictures.size() > 1) {
    std::string more;
    for (std::size_t k = 1; k < pictures.size(); ++k) more += figureOf(pictures[k]);
    body += pageSectionOf("pictures", "Pictures", "", element("div", more, " class=\"pictures\""));
  }
  if (s.contains("arc_length")) body += passedOf(s.at("arc_length"));
  if (!checks.empty())
    body +=
        pageSectionOf("audit", "Why to trust these numbers", "", charts(auditTableOf(checks, "Checks of this run")));
  std::string assumed;
  for (const std::string& a : assumptionsOf(c)) assumed += element("li", escape(a));
  body += pageSectionOf("assumptions", "What was assumed", "", element("ul", assumed, " class=\"assumptions\""));
  body += pageSectionOf("run", "How it was computed", "", charts(factsTable(s)));
  return pageOf(c.name, c.description, sentence, body);
}

}  // namespace

void writeStructurePage(const StructureCase& c, const std::filesystem::path& results,
                        const std::vector<Picture>& pictures, const std::filesystem::path& file) {
  const std::filesystem::path summary = results / "summary.json";
  const Json s = summaryOf(summary);
  const PathTable path = tableFrom(results / "path.csv");
  std::string page;
  try {
    page = structurePage(c, s, path, pictures);
  } catch (const nlohmann::json::exception& e) {  // a value of another type than a run writes
    throw InputError({summary.string(), 0, ""}, jsonReason(e.what()));
  }
  writeOwnFile(file, page);
}

}  // namespace gambeson
