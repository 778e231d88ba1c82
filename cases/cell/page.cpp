/// Detail of results.hpp: report.html of a cell.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/report/html.hpp"
#include "analysis/report/parts.hpp"
#include "analysis/report/xy_chart.hpp"
#include "analysis/ticks.hpp"
#include "cases/cell/loops.hpp"
#include "cases/cell/results.hpp"
#include "core/io/own_file.hpp"

namespace gambeson {
namespace {

using html::element;
using html::escape;

std::string charts(const std::string& body) { return element("div", body, " class=\"charts\""); }

std::string capital(std::string s) {
  if (!s.empty() && s[0] >= 'a' && s[0] <= 'z') s[0] = static_cast<char>(s[0] - 'a' + 'A');
  return s;
}

/// The row at the end of the way, which with cycles is not the last.
std::size_t endOf(const RecordedPath& path) {
  const std::vector<double>& part = path.rows.column("part");
  return static_cast<std::size_t>(std::max_element(part.begin(), part.end()) - part.begin());
}

double at(const RecordedPath& path, const char* column, std::size_t row) { return path.rows.column(column)[row]; }

/// What a load drives, by column of curves.csv and name; each group is a plot of its own.
using Curves = std::vector<std::pair<const char*, const char*>>;
struct CurveGroup {
  const char *title, *unit;
  Curves curves;
};
std::vector<CurveGroup> groupsOf(const PathLoads& load) {
  const Curves tensions{{"n11_N_per_m", "N11 (weft)"}, {"n22_N_per_m", "N22 (warp)"}};
  if (std::holds_alternative<BendingPath>(load)) return {{"moment", "moment per width [N]", {{"moment_N", "moment"}}}};
  if (std::holds_alternative<ShearPath>(load) || std::holds_alternative<TrellisPath>(load))
    return {{"shear force", "force per width [N/m]", {{"n12_N_per_m", "N12"}}},
            {"tensions", "force per width [N/m]", tensions}};
  return {{"tensions", "force per width [N/m]", tensions}};
}

std::string forcesOf(const PathCase& path, const RecordedPath& walked) {
  const PathAbscissa x = abscissaOf(path.load);
  std::string out;
  for (const CurveGroup& group : groupsOf(path.load)) {
    XyPlot plot{fmt::format("{}: {}", path.name, group.title),
                capital(inWords(path.load)) + (walked.reached ? "." : ". It ends " + walked.why + "."),
                x.title,
                group.unit,
                {},
                false};
    for (const auto& [column, name] : group.curves)
      plot.series.push_back({name, walked.rows.column(x.column), walked.rows.column(column), false});
    out += xyChart(plot);
  }
  return out;
}

/// The thesis's figures: stress by the height of the cell, loads of one sort over each other.
std::string stressOf(const RecordedCell& cell) {
  XyPlot pulled{"Stress along the yarns that are pulled", "", "strain", "stress [GPa]", {}, false},
      sheared{"Shear stress", "", "shear strain E12", "stress [GPa]", {}, false};
  const CellCase& c = cell.definition();
  for (std::size_t k = 0; k < cell.paths().size(); ++k) {
    const RecordedTable& rows = cell.paths()[k].rows;
    if (rows.empty()) continue;
    const PathAbscissa x = abscissaOf(c.paths[k].load);
    if (x.column == "e11")
      pulled.series.push_back({c.paths[k].name, rows.column("e11"), rows.column("s11_GPa"), false});
    if (x.column == "e22")
      pulled.series.push_back({c.paths[k].name, rows.column("e22"), rows.column("s22_GPa"), false});
    if (x.column == "e12")
      sheared.series.push_back({c.paths[k].name, rows.column("e12"), rows.column("s12_GPa"), false});
  }
  std::string out;
  for (const XyPlot* plot : {&pulled, &sheared})
    if (plot->series.size() > 1) out += xyChart(*plot);
  return out;
}

std::string endsTable(const RecordedCell& cell) {
  Table t{"At the end of each load",
          "Strains are Green-Lagrange; forces per width are second Piola-Kirchhoff, and stress is force per width over "
          "the height of the cell.",
          {"load", "E11", "E22", "E12", "N11 [N/m]", "N22 [N/m]", "N12 [N/m]", "S11 [GPa]", "S22 [GPa]", "S12 [GPa]",
           "moment [N]", "energy stored [J/m\u00b2]", "energy lost [J/m\u00b2]", "yarn, weft [N]", "yarn, warp [N]"},
          {}};
  constexpr double kRounding = 1e-6;
  const double height_m = *cell.definition().height_m;
  for (std::size_t k = 0; k < cell.paths().size(); ++k) {
    const RecordedPath& path = cell.paths()[k];
    std::vector<TableCell> row{TableCell(cell.definition().paths[k].name + (path.reached ? "" : " (not reached)"))};
    /// Beside the largest force what is less reads as 0.
    const auto scaleOf = [&](const std::string& column) {
      double most = 0;
      for (const char* force : {"n11_N_per_m", "n22_N_per_m", "n12_N_per_m"})
        most = std::max(most, std::abs(at(path, force, endOf(path))));
      return column.starts_with('n')   ? most
             : column.starts_with('s') ? 1e-9 * most / height_m
             : column == "moment_N"    ? most * height_m
                                       : 0;
    };
    for (const char* column :
         {"e11", "e22", "e12", "n11_N_per_m", "n22_N_per_m", "n12_N_per_m", "s11_GPa", "s22_GPa", "s12_GPa", "moment_N",
          "energy_J_per_m2", "lost_J_per_m2", "tension_weft_N", "tension_warp_N"}) {
      if (path.rows.empty()) {
        row.emplace_back("");
        continue;
      }
      const double v = at(path, column, endOf(path));
      row.emplace_back(std::abs(v) < kRounding * scaleOf(column) ? 0. : v);
    }
    t.rows.push_back(std::move(row));
  }
  return tableOf(t);
}

/// Of yarns that rub.
std::string loopsTable(const RecordedCell& cell) {
  Table t{
      "Energy lost in loops",
      "Each way there and back: what forces do on the cloth, what friction between yarns loses of it, and what more "
      "the yarns keep.",
      {"load", "loop", "work [J/m\u00b2]", "lost [J/m\u00b2]", "kept [J/m\u00b2]"},
      {}};
  if (!cell.definition().friction) return "";
  for (std::size_t k = 0; k < cell.paths().size(); ++k) {
    const PathCase& path = cell.definition().paths[k];
    int number = 0;
    for (const CellWork& loop : loopsOf(path, cell.paths()[k].rows))
      t.rows.push_back({TableCell(path.name), TableCell(std::to_string(++number)), TableCell(loop.work),
                        TableCell(loop.lost), TableCell(loop.stored)});
  }
  return t.rows.empty() ? "" : tableOf(t);
}

/// Of solids.
std::string meanTable(const RecordedCell& cell) {
  Table t{
      "Stress of the cloth and mean stress of its yarns",
      "What the faces of the cell carry is the derivative of the energy. The mean of the stress in the yarns over "
      "the cell, which the thesis prints (Man 2006, eq. 4.64), is not where yarns press on each other across voids.",
      {"load", "S11 [GPa]", "mean", "S22 [GPa]", "mean", "S12 [GPa]", "mean"},
      {}};
  if (cell.definition().yarns != YarnModel::solid) return "";
  for (std::size_t k = 0; k < cell.paths().size(); ++k) {
    const RecordedPath& path = cell.paths()[k];
    if (path.rows.empty()) continue;
    std::vector<TableCell> row{TableCell(cell.definition().paths[k].name)};
    double most = 0;
    for (const char* column : {"s11_GPa", "s22_GPa", "s12_GPa"})
      most = std::max(most, std::abs(at(path, column, endOf(path))));
    for (const char* column : {"s11_GPa", "mean_s11_GPa", "s22_GPa", "mean_s22_GPa", "s12_GPa", "mean_s12_GPa"}) {
      const double v = at(path, column, endOf(path));
      row.emplace_back(std::abs(v) < 1e-6 * most ? 0. : v);
    }
    t.rows.push_back(std::move(row));
  }
  return t.rows.empty() ? "" : tableOf(t);
}

std::string stiffnessTable(const RestStiffness& rest) {
  Table t{
      "Stiffness at rest",
      "For small strains and curvatures, by which a fabric can be described at first. D12 + 2 D66 is what cylinders "
      "on the bias tell.",
      {"", "value", "unit", "what it resists"},
      {}};
  const auto add = [&](const char* name, double value, const char* unit, const char* what) {
    t.rows.push_back({TableCell(name), TableCell(value, 4), TableCell(unit), TableCell(what)});
  };
  if (rest.membrane_N_per_m) {
    const std::array<double, 9>& A = *rest.membrane_N_per_m;
    const double most = std::max(A[0], A[4]);
    const auto rounded = [&](double v) { return std::abs(v) < 1e-9 * most ? 0 : v; };
    add("A11", A[0], "N/m", "extension along the weft, the warp held");
    add("A22", A[4], "N/m", "extension along the warp, the weft held");
    add("A12", rounded(A[1]), "N/m", "extension of one by the other");
    add("A66", rounded(A[8]), "N/m", "shear");
  }
  if (rest.bending_Nm) {
    const std::array<double, 3>& D = *rest.bending_Nm;
    add("D11", D[0], "N m", "bending along the weft");
    add("D22", D[1], "N m", "bending along the warp");
    add("D12 + 2 D66", D[2], "N m", "bending on the bias, with both");
  }
  return t.rows.empty() ? "" : tableOf(t);
}

std::string barsTable(const CellCase& c) {
  Table t{"Bars of periodic stiffness",
          "The mean of E (1 + dchi/dy) over a period, from its characteristic function chi (Man 2006, 4.29 to 4.32).",
          {"bar", "pieces", "homogenised [GPa]", "harmonic mean [GPa]"},
          {}};
  for (const BarCase& bar : c.bars)
    t.rows.push_back({TableCell(bar.name), TableCell(std::to_string(bar.bar.length.size())),
                      TableCell(1e-9 * homogenise(bar.bar).young_Pa, 6), TableCell(1e-9 * harmonicMean(bar.bar), 6)});
  return tableOf(t);
}

std::string factsTable(const RecordedCell& cell, const CellRunFacts& facts) {
  const CellCase& c = cell.definition();
  const CellMeasures m = measuresOf(c);
  Table t{"The cell and its run", "", {"fact", "value"}, {}};
  const auto add = [&](const char* name, const std::string& value) {
    t.rows.push_back({TableCell(name), TableCell(value)});
  };
  const auto mm = [](double m_) { return formatNumber(1e3 * m_, 4); };
  add("One repeat", fmt::format("{} x {} mm, {} mm high", mm(m.length_m), mm(m.width_m), mm(m.height_m)));
  add("Part of it that yarns fill", formatNumber(100 * m.volume_fraction, 4) + " %");
  add("Crimp: length of a yarn beyond that of the cloth",
      fmt::format("weft {} %, warp {} %", formatNumber(100 * m.crimp[along_weft], 3),
                  formatNumber(100 * m.crimp[along_warp], 3)));
  double iterations = 0, rows = 0;
  for (const RecordedPath& path : cell.paths()) {
    rows += static_cast<double>(path.rows.rows());
    for (const double n : path.rows.column("iterations")) iterations += n;
  }
  add("Steps of all loads", formatNumber(rows, 6));
  if (iterations > 0) add("Iterations", formatNumber(iterations, 6));
  add("Computed in", fmt::format("{} s; threads: {}{}", formatNumber(facts.wall_s), facts.threads,
                                 facts.resumed ? "; the last of several starts" : ""));
  add("Gambeson", GAMBESON_VERSION);
  add("Case hash", caseIdentity(c));
  return tableOf(t);
}

/// The first load and its end in a sentence; without a load the stiffness at rest.
std::string sentenceOf(const RecordedCell& cell) {
  const CellCase& c = cell.definition();
  if (cell.paths().empty() || cell.paths().front().rows.empty()) {
    if (!cell.rest().membrane_N_per_m) return "The cell was not taken through a load.";
    const std::array<double, 9>& A = *cell.rest().membrane_N_per_m;
    return fmt::format("At rest the cloth resists extension with {} N/m along the weft and {} N/m along the warp.",
                       formatNumber(A[0], 3), formatNumber(A[4], 3));
  }
  const RecordedPath& path = cell.paths().front();
  const std::size_t end = endOf(path);
  const std::string how = capital(path.reached ? inWords(c.paths.front().load)
                                               : fmt::format("at the last step reached of {}", c.paths.front().name));
  const PathLoads& load = c.paths.front().load;
  if (std::holds_alternative<BendingPath>(load))
    return fmt::format("{}, the cloth resists with a moment of {} N.", how, formatNumber(at(path, "moment_N", end), 3));
  if (std::holds_alternative<ShearPath>(load) || std::holds_alternative<TrellisPath>(load))
    return fmt::format("{}, the cloth resists with a shear force of {} N/m.", how,
                       formatNumber(at(path, "n12_N_per_m", end), 3));
  return fmt::format("{}, the cloth carries {} N/m along the weft and {} N/m along the warp.", how,
                     formatNumber(at(path, "n11_N_per_m", end), 3), formatNumber(at(path, "n22_N_per_m", end), 3));
}

std::string cellPage(const RecordedCell& cell, const std::vector<AuditCheck>& checks, const CellRunFacts& facts,
                     const std::vector<Picture>& pictures) {
  const CellCase& c = cell.definition();
  std::string body = alarmOf(checks);
  const std::string sentence = sentenceOf(cell);
  std::string head = element("div", element("p", escape(sentence), " class=\"sentence\""), " class=\"words\"");
  if (!pictures.empty()) head += figureOf(pictures.front());
  body += element("section", head,
                  pictures.empty() ? " class=\"headline\" aria-label=\"The result\""
                                   : " class=\"headline pictured\" aria-label=\"The result\"");
  if (!cell.paths().empty()) {
    std::string curves = stressOf(cell);
    for (std::size_t k = 0; k < cell.paths().size(); ++k)
      if (!cell.paths()[k].rows.empty()) curves += forcesOf(c.paths[k], cell.paths()[k]);
    body += pageSectionOf("curves", "What the cloth carries", "All numbers are in curves.csv.",
                          charts(curves + endsTable(cell) + meanTable(cell) + loopsTable(cell)));
  }
  if (const std::string stiffness = stiffnessTable(cell.rest()); !stiffness.empty())
    body += pageSectionOf("stiffness", "Stiffness", "", charts(stiffness));
  if (pictures.size() > 1) {
    std::string more;
    for (std::size_t k = 1; k < pictures.size(); ++k) more += figureOf(pictures[k]);
    body += pageSectionOf("pictures", "Pictures", "", element("div", more, " class=\"pictures\""));
  }
  if (!c.bars.empty()) body += pageSectionOf("bars", "Bars", "", charts(barsTable(c)));
  body += pageSectionOf("audit", "Why to trust these numbers", "", charts(auditTableOf(checks, "Checks of this run")));
  std::string assumed;
  for (const std::string& a : makeEngine(c)->assumptions()) assumed += element("li", escape(a));
  body += pageSectionOf("assumptions", "What was assumed", "", element("ul", assumed, " class=\"assumptions\""));
  body += pageSectionOf("run", "How it was computed", "", charts(factsTable(cell, facts)));
  return pageOf(c.name, c.description, sentence, body);
}

}  // namespace

void writeCellPage(const RecordedCell& cell, const std::vector<AuditCheck>& checks, const CellRunFacts& facts,
                   const std::vector<Picture>& pictures, const std::filesystem::path& html) {
  writeOwnFile(html, cellPage(cell, checks, facts, pictures));
}

}  // namespace gambeson
