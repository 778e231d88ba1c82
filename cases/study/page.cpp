/// The page of a study: the verdict first, then what it rests on.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "analysis/report/chart.hpp"
#include "analysis/report/html.hpp"
#include "analysis/report/parts.hpp"
#include "analysis/report/xy_chart.hpp"
#include "analysis/ticks.hpp"
#include "cases/factors.hpp"
#include "cases/study/compare.hpp"
#include "cases/zone_ledger.hpp"

namespace gambeson::study {
namespace {

using html::element;
using html::escape;
using html::notice;

std::string charts(const std::string& body) { return element("div", body, " class=\"charts\""); }

/// A cell of HTML, or a number.
struct Html {
  Html(std::string h) : html(std::move(h)) {}
  /// A count.
  Html(int n) : html(std::to_string(n)), number(true) {}
  Html(double v, int digits = 3) : html(std::isfinite(v) ? formatNumber(v, digits) : "\u2013"), number(true) {}
  Html(const std::optional<double>& v, int digits = 3) : Html(v.value_or(std::nan("")), digits) {}
  std::string html;
  bool number = false;
};

/// As tableOf, with cells that are HTML; the first names the row.
std::string htmlTable(const std::string& title, const std::vector<std::string>& columns,
                      const std::vector<std::vector<Html>>& rows, const std::string& caption) {
  std::string head, body;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const bool number = k > 0 && std::any_of(rows.begin(), rows.end(), [&](const auto& r) { return r[k].number; });
    head += element("th", escape(columns[k]), number ? " scope=\"col\" class=\"number\"" : " scope=\"col\"");
  }
  for (const auto& row : rows) {
    std::string cells;
    for (std::size_t k = 0; k < row.size(); ++k)
      cells += k == 0 ? element("th", row[k].html, " scope=\"row\"")
                      : element("td", row[k].html, row[k].number ? " class=\"number\"" : "");
    body += element("tr", cells);
  }
  const std::string table = element(
      "table", element("caption", escape(title)) + element("thead", element("tr", head)) + element("tbody", body));
  return element("div",
                 element("div", table, " class=\"scroll\"") +
                     (caption.empty() ? "" : element("p", escape(caption), " class=\"caption\"")),
                 " class=\"panel\"");
}

std::string lightOf(const std::string& light) {
  return element("span", "\u25cf " + escape(light), " class=\"light " + escape(light) + "\"");
}
std::string lightOf(Light light) {
  if (light == Light::unknown) return "not known";
  return element("span", std::string("\u25cf ") + nameOf(light), std::string(" class=\"light ") + nameOf(light) + "\"");
}

std::string reason(const std::string& text) { return element("span", escape(text), " class=\"reason\""); }

std::string percent(const std::optional<double>& part) {
  if (!part || !std::isfinite(*part)) return "not known";
  return *part < 0.995 ? fmt::format("{:.2g} %", 100 * *part) : fmt::format("{:.0f} %", 100 * *part);
}

std::string linkTo(const Variant& v) {
  return element("a", escape(v.label), " href=\"" + escape(v.folder) + "/report.html\"");
}

/// The label of a variant within its group.
std::string memberName(const Study& s, const Comparison& c, std::size_t i) {
  if (c.main_axis < 0) return s.variants[i].label;
  const Axis& axis = s.axes[static_cast<std::size_t>(c.main_axis)];
  return axis.levels[static_cast<std::size_t>(s.variants[i].levels[static_cast<std::size_t>(c.main_axis)])].name;
}

std::string headline(const Study& s, const Comparison& c, const std::vector<SidePicture>& pictures) {
  const Verdict& v = c.verdict;
  std::string words = element("p", escape(v.sentence), " class=\"sentence\"");
  const auto item = [](const std::string& q, const std::string& a) {
    return element("dt", escape(q)) + element("dd", a);
  };
  std::string list;
  if (v.take >= 0) {
    const Option& o = c.input.options[static_cast<std::size_t>(v.take)];
    list += item("Take", escape(o.name));
    for (const Option::Cost& cost : o.costs)
      list += item(cost.motion.empty() ? "Costs at most" : "Costs, " + cost.motion,
                   escape(formatNumber(cost.peak_Nm) + " Nm, " + cost.joint +
                          (cost.part ? ": " + percent(cost.part) + " of natural " : " ")) +
                       lightOf(gambeson::lightOf(cost.part, s.limits.green, s.limits.red)));
    for (std::size_t i = 0; i < s.variants.size(); ++i)
      if (s.variants[i].grid && c.runs[i].good && memberName(s, c, i) == o.name) {
        list += item("Mass", escape(formatNumber(c.runs[i].mass_kg()) + " kg"));
        break;
      }
  }
  if (!v.why.empty()) list += item("Why", reason(v.why));
  list += item("How sure", reason(v.sure));
  words += element("dl", list, " class=\"answers\"");
  words += element("p",
                   escape(fmt::format("Added torque is what the garment\u2019s contact forces do about a joint: the "
                                      "wearer\u2019s muscles supply it on "
                                      "top of what the movement needs, or are spared it. Green: below {} of the "
                                      "joint\u2019s natural moment in the task, "
                                      "red: above {} ({}). What protects enough is not part of this study.",
                                      percent(s.limits.green), percent(s.limits.red), s.limits.source)),
                   " class=\"meaning\"");
  std::string body = element("div", words, " class=\"words\"");
  // The chosen one, in the first group.
  const SidePicture* shown = nullptr;
  for (const SidePicture& p : pictures)
    if (!shown && v.take >= 0 && memberName(s, c, p.variant) == c.input.options[static_cast<std::size_t>(v.take)].name)
      shown = &p;
  if (shown) body += figureOf({shown->png, shown->caption, ""});
  return element("section", body,
                 shown ? " class=\"headline pictured\" aria-label=\"The verdict\""
                       : " class=\"headline\" aria-label=\"The verdict\"");
}

std::string alarms(const Study& s, const Comparison& c, const std::vector<std::string>& failures) {
  std::string out;
  for (std::size_t i = 0; i < s.variants.size(); ++i)
    if (!c.runs[i].good)
      out += element("p", escape(fmt::format("The variant {} failed: {}", s.variants[i].label, c.runs[i].why)),
                     " class=\"alarm\" role=\"alert\"");
  if (c.input.failing_checks > 0)
    out += element("p",
                   fmt::format("Checks fail in {} of {} runs: do not rely on the numbers before you know why. See <a "
                               "href=\"#checks\">the checks</a>.",
                               c.input.failing_checks, c.input.checked_runs),
                   " class=\"alarm\" role=\"alert\"");
  for (const std::string& f : failures) out += element("p", escape(f), " class=\"alarm\" role=\"alert\"");
  return out;
}

std::string variantsOf(const Study& s, const Comparison& c) {
  std::vector<std::vector<Html>> rows;
  for (std::size_t i = 0; i < s.variants.size(); ++i) {
    const Variant& v = s.variants[i];
    const RunNumbers& r = c.runs[i];
    const JointNumbers* top = r.highest();
    if (!r.good || !top) {
      rows.push_back({r.good ? linkTo(v) : escape(v.label), Html(std::nan("")),
                      r.good ? std::string("no joints") : std::string("<span class=\"bad\">\u2717 failed</span>"),
                      Html(std::nan("")), Html(std::nan("")), Html(std::nan("")), Html(std::nan("")),
                      Html(std::nan("")), Html(std::nan("")), std::string(), Html(std::nan(""))});
      continue;
    }
    std::optional<double> peak, rms, correlation;
    const bool own = v.baseline == static_cast<int>(i);
    for (const JointRatio& ratio : c.ratios[i])
      if (ratio.joint == top->name && !own)
        peak = ratio.peak, rms = ratio.rms, correlation = ratio.likeness.correlation;
    rows.push_back({linkTo(v) + (own ? " <small>(baseline)</small>" : ""), Html(r.mass_kg()), escape(top->label),
                    Html(std::abs(top->peak_Nm)), Html(top->rms_Nm), Html(peak), Html(rms), Html(correlation),
                    top->part() ? Html(100 * *top->part(), 2) : Html(std::nan("")), lightOf(c.lights[i]),
                    Html(r.failing())});
    if (r.failing() == 0) rows.back().back() = std::string("<span class=\"good\">\u2713</span>");
  }
  return charts(htmlTable("All variants",
                          {"variant (its own report)", "mass [kg]", "highest at", "peak [Nm]", "RMS [Nm]", "peak ratio",
                           "RMS ratio", "correlation", "of natural [%]", "light", "failing checks"},
                          rows,
                          "Ratios and correlation of the histories: to the variant with the baseline\u2019s levels, "
                          "same joint. All joints are in variants.csv."));
}

std::string curves(const Study& s, const Comparison& c) {
  std::string out;
  constexpr std::size_t most = 4;  // lines that can be told apart
  for (const Group& g : c.groups) {
    std::vector<std::size_t> good;
    for (const std::size_t i : g.members)
      if (c.runs[i].good && !c.runs[i].joints.empty()) good.push_back(i);
    if (good.empty()) continue;
    // The baseline is in every plot.
    std::stable_partition(good.begin(), good.end(), [&](std::size_t i) { return static_cast<int>(i) == g.baseline; });
    const bool has_base = static_cast<int>(good[0]) == g.baseline;
    const RunNumbers& first = c.runs[good[0]];
    for (const JointNumbers& j : first.joints) {
      if (!j.applies()) continue;
      for (const bool above : {false, true}) {
        if (above && (j.name != g.joint || !j.standing_Nm)) continue;
        for (std::size_t from = has_base ? 1 : 0; from < std::max<std::size_t>(good.size(), 1 + (has_base ? 1 : 0));
             from += most - (has_base ? 1 : 0)) {
          Plot plot{j.label + (g.label.empty() ? "" : ", " + g.label) +
                        (above ? ": torque above standing" : ": added torque"),
                    "",
                    {},
                    {},
                    true,
                    first.counted_from_s};
          if (above) plot.caption = "The torque of standing dressed, before the motion, is subtracted from each.";
          std::vector<std::size_t> shown;
          if (has_base) shown.push_back(good[0]);
          for (std::size_t k = from; k < good.size() && shown.size() < most; ++k) shown.push_back(good[k]);
          for (std::size_t k = 0; k < shown.size(); ++k) {
            const RunNumbers& r = c.runs[shown[k]];
            const JointNumbers* of = r.joint(j.name);
            if (!of) continue;
            Series line{memberName(s, c, shown[k]), j.prismatic ? "N" : "Nm", r.time_s, of->torque_Nm,
                        static_cast<Tone>(k)};
            if (above)
              for (double& t : line.values) t -= of->standing_Nm.value_or(0);
            plot.series.push_back(std::move(line));
          }
          out += lineChart(plot);
        }
      }
    }
  }
  return out.empty() ? notice("No run has joint torques.") : charts(out);
}

std::string standing(const Study& s, const Comparison& c) {
  std::vector<std::vector<Html>> rows;
  for (const Group& g : c.groups)
    for (const std::size_t i : g.members) {
      const RunNumbers& r = c.runs[i];
      const JointNumbers* j = r.good ? r.joint(g.joint) : nullptr;
      if (!j || !j->standing_Nm) continue;
      const auto above = peakAboveStanding(r, *j);
      std::optional<double> ratio, base_above;
      if (g.baseline >= 0)
        if (const JointNumbers* b = c.runs[static_cast<std::size_t>(g.baseline)].joint(g.joint))
          base_above = peakAboveStanding(c.runs[static_cast<std::size_t>(g.baseline)], *b);
      if (base_above && above && *base_above > 0) ratio = *above / *base_above;
      rows.push_back({escape(s.variants[i].label), escape(j->label), Html(*j->standing_Nm), Html(std::abs(j->peak_Nm)),
                      Html(above), Html(ratio, 2)});
    }
  if (rows.empty())
    return notice(
        "No run stood dressed before its motion (dressing.settle is 0): there is no torque of standing to compare "
        "with.");
  return charts(htmlTable("Standing as the baseline",
                          {"variant", "joint", "standing [Nm]", "peak [Nm]", "peak above standing [Nm]", "its ratio"},
                          rows,
                          "Standing: the mean torque of the last 0.1 s before the motion, dressed and settled. Above "
                          "standing: that torque subtracted from the history."));
}

std::string exponents(const Study&, const Comparison& c) {
  std::string out;
  std::vector<std::vector<Html>> rows;
  std::map<std::string, XyPlot> plots;
  std::vector<std::string> order;
  for (const AxisExponent& e : c.exponents) {
    rows.push_back({escape(e.axis + (e.setting.empty() ? "" : ", " + e.setting)), escape(e.joint),
                    std::string(e.quantity), Html(e.law.exponent), Html(e.law.standard_error, 2),
                    e.law.points > 2 ? escape(formatNumber(e.law.lowest) + " to " + formatNumber(e.law.highest))
                                     : std::string("two points only"),
                    Html(e.law.points)});
    if (e.joint != "the highest" || e.quantity != "peak") continue;
    if (!plots.contains(e.axis)) {
      order.push_back(e.axis);
      plots[e.axis] = {"Highest peak over " + e.axis,
                       "Both axes logarithmic: a power law is a straight line.",
                       e.axis,
                       "peak [Nm]",
                       {},
                       true};
    }
    plots[e.axis].series.push_back({e.setting.empty() ? "peak" : e.setting, e.x, e.y});
  }
  if (rows.empty()) return notice("No axis has two or more levels that are numbers: no exponent can be fitted.");
  for (const std::string& axis : order) out += xyChart(plots[axis]);
  out += htmlTable("d ln(torque) / d ln(level)",
                   {"axis", "joint", "of", "exponent", "standard error", "between neighbours", "points"}, rows,
                   "A straight line through the logarithms. Two points have no error of their own; the range between "
                   "neighbours shows how far it is from a power law.");
  return charts(out);
}

std::string elasticities(const Comparison& c) {
  if (c.elasticities.empty())
    return notice(
        "The study has no variants of the factors bending, membrane, weight, inertia and drag (\"elasticities\" adds "
        "them): what the torque is made of is not known.");
  std::vector<std::vector<Html>> rows;
  for (const ElasticityRow& e : c.elasticities) {
    const auto sum = e.e.sum(), predicted = e.e.thicknessExponent();
    rows.push_back({escape((e.setting.empty() ? "" : e.setting + ", ") + e.joint), std::string(e.quantity),
                    Html(e.e.bending), Html(e.e.membrane), Html(e.e.weight), Html(e.e.inertia), Html(e.e.drag),
                    Html(sum), Html(sum ? 1 - *sum : std::nan(""), 2), Html(predicted), Html(e.measured),
                    predicted && e.measured ? Html(*e.measured - *predicted, 2) : Html(std::nan(""))});
  }
  return charts(htmlTable("By how many per cent the torque changes with one per cent of ...",
                          {"torque", "of", "bending", "membrane", "weight", "inertia", "drag", "sum", "rest",
                           "thickness: predicted", "measured", "difference"},
                          rows,
                          "Central differences of the logarithms. The rest, 1 - sum, is carried by what is none of the "
                          "five: above all springs of supports, which do not change with the cloth. Predicted exponent "
                          "of the thickness: membrane + weight + inertia + 3 bending."));
}

std::string forces(const Study& s, const Comparison& c) {
  std::vector<std::vector<Html>> split, shares, comfort;
  std::set<std::string> zones;
  for (const Group& g : c.groups)
    for (const std::size_t i : g.members) {
      if (!c.runs[i].good) continue;
      const double all = c.runs[i].pressing_N();
      for (const ZoneNumbers& z : c.runs[i].zones)
        if (z.normal_N > 0.005 * all) zones.insert(z.zone);
      if (const ComfortNumbers* k = c.runs[i].leastComfortable())
        comfort.push_back({escape(s.variants[i].label), lightOf(k->light), escape(spokenZone(k->zone)),
                           Html(1e-3 * k->mean_Pa), Html(1e-3 * k->red_Pa), Html(1e-3 * k->peak_Pa),
                           Html(k->dose_kPa_min)});
      const JointNumbers* j = c.runs[i].joint(g.joint);
      if (!j) continue;
      split.push_back({escape(s.variants[i].label), escape(j->label), Html(j->normal_N), Html(j->friction_N),
                       Html(std::abs(j->peak_Nm)),
                       Html(j->friction_Nm && j->peak_Nm != 0 ? 100 * *j->friction_Nm / j->peak_Nm : std::nan(""), 2)});
    }
  std::string out = htmlTable(
      "Pressing and friction",
      {"variant", "joint", "pressing, mean [N]", "friction, mean [N]", "peak torque [Nm]", "of it by friction [%]"},
      split,
      "Forces: sums of magnitudes on the segments that count for the joint. Torque: what the tangential "
      "parts of the contact forces have in it when it peaks; a negative share is of the other sense.");
  std::vector<std::string> columns{"variant", "pressing, sum [N]"};
  for (const std::string& zone : zones) columns.push_back(spokenZone(zone) + " [%]");
  for (const Group& g : c.groups)
    for (const std::size_t i : g.members) {
      if (!c.runs[i].good) continue;
      const double all = c.runs[i].pressing_N();
      std::vector<Html> row{escape(s.variants[i].label), Html(all)};
      for (const std::string& name : zones) {
        double part = 0;
        for (const ZoneNumbers& z : c.runs[i].zones)
          if (z.zone == name) part = z.normal_N;
        row.emplace_back(all > 0 ? 100 * part / all : 0, 2);
      }
      shares.push_back(std::move(row));
    }
  if (!zones.empty())
    out += htmlTable("Which parts of the body bear the garment", columns, shares,
                     "Shares of the mean force that presses, both sides together, without belt and edges on springs. "
                     "Parts with less than 0.5 % everywhere are left out.");
  if (!comfort.empty())
    out +=
        htmlTable("Comfort: the part of the body that is furthest from comfortable",
                  {"variant", "verdict", "part", "mean [kPa]", "limit [kPa]", "peak [kPa]", "dose [kPa min]"}, comfort,
                  "Pressure where it is largest, against the limits of the case. Each variant\u2019s own report "
                  "has all parts, and pictures.");
  return charts(out);
}

std::string cloth(const Study& s, const Comparison& c) {
  std::vector<std::vector<Html>> masses, stress;
  for (std::size_t i = 0; i < s.variants.size(); ++i) {
    if (!c.runs[i].good || !s.variants[i].grid) continue;
    for (const LayerNumbers& l : c.runs[i].layers)
      masses.push_back({escape(s.variants[i].label), escape(l.name.empty() ? "the garment" : l.name),
                        Html(1e3 * l.thickness_m), Html(l.mass_kg), Html(l.area_m2), Html(l.control_points)});
    const StressNumbers* top = nullptr;
    for (const StressNumbers& n : c.runs[i].stress)
      if (!top || n.p99_N_per_m > top->p99_N_per_m) top = &n;
    if (!top) continue;
    std::string region = top->region;
    std::replace(region.begin(), region.end(), '_', ' ');
    stress.push_back({escape(s.variants[i].label), escape(region), Html(top->p50_N_per_m), Html(top->p95_N_per_m),
                      Html(top->p99_N_per_m), Html(top->max_N_per_m), Html(100 * c.runs[i].largest_strain)});
  }
  if (masses.empty()) return notice("No run has a garment.");
  return charts(
      htmlTable("Mass of each layer",
                {"variant", "layer", "thickness [mm]", "mass [kg]", "area [m\u00b2]", "control points"}, masses, "") +
      htmlTable(
          "What the fabric carries",
          {"variant", "patch", "median [N/m]", "p95 [N/m]", "p99 [N/m]", "largest [N/m]", "largest strain [%]"}, stress,
          "First principal stress resultant in the patch that carries the most; percentiles by area over the motion."));
}

std::string meshes(const Comparison& c) {
  if (c.meshes.empty())
    return notice(
        "The study has one mesh: the error of the mesh is not known. An axis with the role mesh, coarse and fine, "
        "measures it.");
  std::vector<std::vector<Html>> rows;
  for (const MeshRow& m : c.meshes)
    rows.push_back({escape(m.setting.empty() ? m.joint : m.setting + ", " + m.joint), Html(m.coarse_points),
                    Html(m.fine_points), Html(std::abs(m.coarse_Nm)), Html(std::abs(m.fine_Nm)),
                    Html(100 * m.difference, 2), Html(100 * m.history, 2)});
  return charts(htmlTable("Coarse against fine",
                          {"variant", "control points, coarse", "fine", "peak, coarse [Nm]", "fine [Nm]",
                           "difference [%]", "histories differ [% of the peak]"},
                          rows, "Histories: root mean square of the difference from 0.2 s on, of the fine peak."));
}

std::string joints(const Study& s, const Comparison& c) {
  std::set<std::string> reported, idle;
  for (const RunNumbers& r : c.runs)
    for (const JointNumbers& j : r.joints) (j.applies() ? reported : idle).insert(j.label);
  std::string out;
  for (const std::string& j : idle)
    if (!reported.contains(j))
      out += element("li", escape(j + ": not applicable, the garment touches nothing beyond this joint"));
  bool elbow = false;
  for (const RunNumbers& r : c.runs)
    for (const JointNumbers& j : r.joints) elbow = elbow || j.name.starts_with("elbow");
  bool touched = false, human = false;
  for (const RunNumbers& r : c.runs)
    for (const ContactNumbers& b : r.contact)
      touched = touched || (b.share > 0 && (b.segment.find("forearm") != std::string::npos ||
                                            b.segment.find("hand") != std::string::npos));
  for (const Variant& v : s.variants)
    if (const auto* k = std::get_if<Case>(&v.definition)) human = human || k->human.has_value();
  if (human && !elbow && !touched)
    out += element("li", "elbow: not applicable without sleeves: nothing touches the forearms");
  std::set<std::string> off_all;
  bool first = true;
  std::vector<std::pair<std::string, std::set<std::string>>> off;
  for (const Variant& v : s.variants) {
    const auto* k = std::get_if<Case>(&v.definition);
    if (!k) continue;
    const auto list = switchedOff(*k);
    off.emplace_back(v.label, std::set<std::string>(list.begin(), list.end()));
    if (first) off_all = off.back().second;
    first = false;
    std::set<std::string> both;
    std::set_intersection(off_all.begin(), off_all.end(), off.back().second.begin(), off.back().second.end(),
                          std::inserter(both, both.begin()));
    off_all = both;
  }
  for (const std::string& o : off_all) out += element("li", escape("switched off in all variants: " + o));
  for (const auto& [label, list] : off)
    for (const std::string& o : list)
      if (!off_all.contains(o)) out += element("li", escape(fmt::format("switched off in {}: {}", label, o)));
  out += element("li",
                 "Factors: thickness takes mass and membrane in proportion and bending, twist and seams with the cube; "
                 "the contact distance follows it; the drag "
                 "coefficient, supports and friction stay.");
  out += element("li", "Each variant\u2019s own report says what else was assumed.");
  return element("ul", out, " class=\"assumptions\"");
}

std::string checks(const Study& s, const Comparison& c) {
  std::vector<std::vector<Html>> rows;
  for (std::size_t i = 0; i < s.variants.size(); ++i)
    for (const CheckNumbers& k : c.runs[i].checks)
      if (!k.holds)
        rows.push_back({linkTo(s.variants[i]), escape(k.name), Html(k.value), Html(k.limit), escape(k.unit),
                        std::string("<span class=\"bad\">\u2717 fails</span>")});
  if (rows.empty())
    return element("p", fmt::format("All checks hold in all {} runs that were checked.", c.input.checked_runs));
  return charts(htmlTable(
      "Checks that fail", {"variant", "check", "measured", "allowed", "unit", "verdict"}, rows,
      fmt::format("{} of {} runs; the others hold all checks.", c.input.failing_checks, c.input.checked_runs)));
}

std::string pairs(const Study& s, const std::vector<SidePicture>& pictures) {
  std::string out;
  for (std::size_t w = 0; w < s.pictures.size(); ++w) {
    std::string row;
    for (const SidePicture& p : pictures)
      if (p.wish == w) row += figureOf({p.png, p.caption, ""});
    out += element("div", row, " class=\"pictures\"");
  }
  return out;
}

}  // namespace

std::string studyPage(const Study& s, const Comparison& c, const std::vector<SidePicture>& pictures,
                      const std::vector<std::string>& failures) {
  const bool any_joint =
      std::any_of(c.runs.begin(), c.runs.end(), [](const RunNumbers& r) { return !r.joints.empty(); });
  std::string body = alarms(s, c, failures);
  const bool batch = s.file.empty();
  if (!batch) body += headline(s, c, pictures);
  body += sectionOf("variants", "The variants", "", variantsOf(s, c));
  if (any_joint && !batch) {
    body += sectionOf("curves", "Torque over time", "Variants over each other; the baseline first.", curves(s, c));
    body += sectionOf("standing", "Standing and moving", "", standing(s, c));
    body += sectionOf("exponents", "How the torque follows the numbers", "", exponents(s, c));
    body += sectionOf("elasticities", "What the torque is made of", "", elasticities(c));
  }
  if (any_joint) body += sectionOf("forces", "Where the garment presses", "", forces(s, c));
  body += sectionOf("cloth", "The cloth", "", cloth(s, c));
  if (!pictures.empty())
    body += sectionOf("pictures", "Side by side", "All at the same time of their motion, in the same colours.",
                      pairs(s, pictures));
  if (!batch) body += sectionOf("meshes", "Coarse and fine", "", meshes(c));
  body += sectionOf("checks", "Checks", "Of every step of every run.", checks(s, c));
  body += sectionOf("assumptions", "What was left out and assumed", "", joints(s, c));
  return pageOf(s.name, s.description, batch ? s.name : c.verdict.sentence, body);
}

}  // namespace gambeson::study
