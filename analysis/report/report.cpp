#include "analysis/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "analysis/report/chart.hpp"
#include "analysis/report/html.hpp"
#include "analysis/report/parts.hpp"
#include "analysis/report/style.hpp"
#include "analysis/ticks.hpp"
#include "core/io/own_file.hpp"

namespace gambeson {
namespace {

using html::element;
using html::escape;
using html::lightOf;
using html::notice;
using html::prose;
using html::seconds;

std::string percent(double p) { return (p > 0 && p < 0.1 ? "less than 0.1" : formatNumber(p, 2)) + " %"; }

std::string capital(std::string s) {
  if (!s.empty() && s[0] >= 'a' && s[0] <= 'z') s[0] = static_cast<char>(s[0] - 'a' + 'A');
  return s;
}
/// Prose never shows a minus: the page speaks of sizes.
double sizeOf(const JointSummary& j) { return std::abs(j.peak_Nm); }
std::string shareOf(const JointSummary& j) {
  return j.natural_percent ? percent(*j.natural_percent) + " of the natural " + j.joint + " moment" +
                                 (j.natural_Nm ? " of " + formatNumber(*j.natural_Nm) + " Nm" : "")
                           : "";
}

std::string answers(const ReportInput& in, const JointSummary& j) {
  const auto item = [](const std::string& q, const std::string& a) {
    return element("dt", escape(q)) + element("dd", prose(a));
  };
  std::string list = item("Peak added torque", formatNumber(sizeOf(j)) + " Nm, at the " + j.joint);
  if (!j.side.empty()) list += item("Side", j.side);
  list += item("When", seconds(j.peak_time_s));
  list += item("Cause", j.cause.empty() ? "not known" : j.cause);
  list += item("Share of the natural moment", j.natural_percent ? shareOf(j) + (in.task.empty() ? "" : " in " + in.task)
                                                                : "not known: " + in.no_share);
  if (j.friction_percent) list += item("Part of it from friction", percent(*j.friction_percent));
  if (j.drag_percent) list += item("Part of it from air drag", percent(*j.drag_percent));
  return element("dl", list, " class=\"answers\"");
}

std::string headline(const ReportInput& in) {
  std::string words = element("p", prose(headlineOf(in)), " class=\"sentence\""), meaning;
  if (const JointSummary* j = highestJoint(in)) {
    words += answers(in, *j);
    meaning =
        element("p",
                "Added torque: the garment pushes on the body and so turns its joints; the wearer\u2019s muscles "
                "must give as much against it, on top of what the movement needs. Where the garment pushes the way "
                "the joint moves, they are spared it.",
                " class=\"meaning\"");
  }
  std::string body = element("div", words, " class=\"words\"");
  if (!in.pictures.empty()) body += figureOf(in.pictures.front());
  return element("section", body + meaning,
                 in.pictures.empty() ? " class=\"headline\" aria-label=\"The result\""
                                     : " class=\"headline pictured\" aria-label=\"The result\"");
}

std::string alarms(const ReportInput& in) {
  std::string out;
  for (const auto& w : in.warnings) out += element("p", escape(w), " class=\"alarm\" role=\"alert\"");
  const Trust trust = trustOf(in);
  if (!trust.reliable()) out += alarmOf(in.audit);
  if (const Stretch* worst = worstOf(in.stretch); trust.stretched > 0)
    out += notice(sentenceOf(*worst) +
                  (in.joints.empty() && in.comfort_tables.empty() ? "" : " No light of this page is green for that."));
  return out;
}

/// What bears on the headline stands in it, at its end; more than a few fold.
std::string notesOf(const std::vector<std::string>& notes) {
  constexpr std::size_t few = 3;
  std::string items;
  for (const std::string& n : notes) items += element("li", escape(n));
  const std::string list = element("ul", items, " class=\"notes\"");
  if (notes.size() <= few) return notes.empty() ? "" : element("div", list, " class=\"notice\"");
  return element("details", element("summary", fmt::format("{} notes that bear on this result", notes.size())) + list,
                 " class=\"notice\"");
}

/// What was found in files and made of measures, under the words that several begin with.
std::string foundText(const std::vector<std::string>& facts) {
  if (facts.empty()) return "";
  std::vector<std::pair<std::string, std::string>> groups;  // words, items
  const auto beginning = [](const std::string& fact) {
    const std::size_t colon = fact.find(": ");
    return colon == std::string::npos ? std::string() : fact.substr(0, colon);
  };
  for (const std::string& fact : facts) {
    std::string about = beginning(fact);
    if (std::count_if(facts.begin(), facts.end(), [&](const auto& f) { return beginning(f) == about; }) < 2) about = "";
    auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return g.first == about; });
    if (group == groups.end()) group = groups.insert(group, {about, ""});
    group->second += element("li", escape(about.empty() ? fact : fact.substr(about.size() + 2)));
  }
  std::string body;
  for (const auto& [about, items] : groups)
    body += (about.empty() ? "" : element("p", escape(capital(about)), " class=\"about\"")) +
            element("ul", items, " class=\"notes\"");
  return element("details",
                 element("summary", fmt::format("What was found of wearer and scene ({} notes)", facts.size())) + body,
                 " class=\"facts\"");
}

std::string jointName(const JointSummary& j) { return capital(j.joint) + (j.side.empty() ? "" : ", " + j.side); }

std::string joints(const ReportInput& in) {
  if (in.joints.empty()) return notice("This run has no joint torques.");
  constexpr std::size_t most_cards = 6;
  std::vector<const JointSummary*> order;
  for (const auto& j : in.joints) order.push_back(&j);
  std::stable_sort(order.begin(), order.end(), [](const auto* a, const auto* b) {
    const auto key = [](const JointSummary* j) { return std::isfinite(j->peak_Nm) ? sizeOf(*j) : -1; };
    return key(a) > key(b);
  });
  std::string cards;
  for (std::size_t i = 0; i < std::min(order.size(), most_cards); ++i) {
    const JointSummary& j = *order[i];
    std::string c =
        element("h3", (&j == highestJoint(in) ? "<span class=\"tag\">highest</span>" : "") + escape(jointName(j)));
    if (std::isfinite(j.peak_Nm))
      c += element("p", escape(formatNumber(sizeOf(j))) + " <small>Nm peak</small>", " class=\"big\"") +
           element("p", prose("at " + seconds(j.peak_time_s) + (j.cause.empty() ? "" : ", during " + j.cause)));
    else
      c += notice("The peak is " + formatNumber(j.peak_Nm) + ".");
    c += element("p",
                 prose(j.natural_percent ? shareOf(j) : "share of a natural moment: not known") +
                     (j.light.empty() ? "" : " " + lightOf(j.light)),
                 j.natural_percent ? "" : " class=\"soft\"");
    c += element("p",
                 prose("root mean square " + formatNumber(j.rms_Nm) + " Nm" +
                       (j.friction_percent ? "; friction " + percent(*j.friction_percent) + " of the peak" : "") +
                       (j.drag_percent ? "; air drag " + percent(*j.drag_percent) + " of the peak" : "")),
                 " class=\"soft\"");
    cards += element("div", c, " class=\"card " + escape(j.side) + "\"");
  }
  std::string out = element("div", cards, " class=\"cards\"");
  if (order.size() > most_cards) {
    Table all{"All joints",
              "",
              {"joint", "peak [Nm]", "at [s]", "during", "root mean square [Nm]", "of the natural moment [%]",
               "from friction [%]", "from air drag [%]"},
              {}};
    const auto optional = [](const std::optional<double>& v) { return v ? TableCell(*v, 2) : TableCell("not known"); };
    for (const auto* j : order)
      all.rows.push_back({jointName(*j), j->peak_Nm, j->peak_time_s, j->cause, j->rms_Nm, optional(j->natural_percent),
                          optional(j->friction_percent), optional(j->drag_percent)});
    out += element("div", tableOf(all), " class=\"charts\"");
  }
  return out;
}

template <class Item, class Show>
std::string each(const std::vector<Item>& items, Show show) {
  std::string out;
  for (const auto& i : items) out += show(i);
  return out;
}

std::string charts(const std::string& body) { return element("div", body, " class=\"charts\""); }

}  // namespace

std::string tableOf(const Table& t) {
  const auto ofNumbers = [&](std::size_t c) {
    return c > 0 &&
           std::any_of(t.rows.begin(), t.rows.end(), [&](const auto& r) { return c < r.size() && r[c].number; });
  };
  // A sentence keeps room for a few words in a line where the table is wider than its place.
  const auto styleOf = [&](const TableCell& cell, std::size_t c) {
    constexpr std::size_t sentence = 40;
    return cell.number || (ofNumbers(c) && cell.light.empty()) ? " class=\"number\""
           : cell.text.size() > sentence                       ? " class=\"sentences\""
                                                               : "";
  };
  std::string head;
  for (std::size_t c = 0; c < t.columns.size(); ++c)
    head += element("th", escape(t.columns[c]), ofNumbers(c) ? " scope=\"col\" class=\"number\"" : " scope=\"col\"");
  std::string body;
  for (const auto& row : t.rows) {
    std::string cells;
    for (std::size_t c = 0; c < row.size(); ++c)
      cells += c == 0 ? element("th", escape(row[c].text), " scope=\"row\"")
                      : element("td", row[c].light.empty() ? escape(row[c].text) : lightOf(row[c].light),
                                styleOf(row[c], c));
    body += element("tr", cells);
  }
  std::string after;
  if (t.rows.empty()) after += notice("There are no rows.");
  if (!t.caption.empty()) after += element("p", escape(t.caption), " class=\"caption\"");
  return html::tablePanel(t.title, element("thead", element("tr", head)) + element("tbody", body), after);
}

std::string figureOf(const Picture& p) {
  std::string bytes, why;
  if (const auto* file = std::get_if<std::filesystem::path>(&p.png)) {
    std::ifstream in(*file, std::ios::binary);
    std::ostringstream all;
    if (in) all << in.rdbuf();
    bytes = all.str();
    if (!in) why = "The picture " + file->string() + " cannot be read.";
  } else {
    bytes = std::get<std::string>(p.png);
  }
  if (why.empty() && bytes.rfind("\x89PNG\r\n\x1a\n", 0) != 0) why = "A picture is not a PNG.";
  const std::string shown = why.empty() ? "<img alt=\"" + escape(p.alt.empty() ? p.caption : p.alt) +
                                              "\" src=\"data:image/png;base64," + html::base64(bytes) + "\">"
                                        : notice(why);
  return element("figure", shown + element("figcaption", escape(p.caption)));
}

std::string pageSectionOf(const std::string& id, const std::string& title, const std::string& lead,
                          const std::string& body) {
  return element(
      "section",
      element("h2", escape(title), " id=\"" + id + "\"") + (lead.empty() ? "" : element("p", escape(lead))) + body,
      " aria-labelledby=\"" + id + "\"");
}

std::string pageOf(const std::string& title, const std::string& description, const std::string& summary,
                   const std::string& body, bool viewed, const std::string& style) {
  const std::string head =
      std::string(
          "<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
          "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src "
          "'unsafe-inline'; script-src 'unsafe-inline'\">\n") +
      "<meta name=\"description\" content=\"" + escape(summary) + "\">\n" + element("title", escape(title)) +
      element("style", report::kStyle + style) + (viewed ? element("style", viewerStyle()) : "");
  return "<!DOCTYPE html>\n" +
         element(
             "html",
             element("head", head) +
                 element("body",
                         element("header", element("h1", escape(title)) + element("p", escape(description)),
                                 " class=\"page\"") +
                             element("main", body + element("footer",
                                                            "Made by Gambeson. This page holds everything it shows.")) +
                             element("script", report::kScript)),
             " lang=\"en\"");
}

TableCell TableCell::signal(const std::string& light) {
  TableCell c(light);
  c.light = light;
  return c;
}

std::string alarmOf(const std::vector<AuditCheck>& checks) {
  int failed = 0;
  std::string wrong;
  for (const AuditCheck& c : checks) {
    if (c.holds()) continue;
    ++failed;
    if (!c.wrong.empty()) wrong += (wrong.empty() ? ": " : "; ") + c.wrong;
  }
  if (failed == 0) return "";
  return element("p",
                 fmt::format("{} of {} checks of this run {}{}. Do not rely on its numbers before you know what that "
                             "does to them: <a href=\"#audit\">the checks</a>.",
                             failed, checks.size(), failed == 1 ? "fails" : "fail", escape(wrong)),
                 " class=\"alarm\" role=\"alert\"");
}

std::string auditTableOf(const std::vector<AuditCheck>& checks, const std::string& caption) {
  std::string rows;
  for (const AuditCheck& c : checks)
    rows += element("tr", element("th", escape(c.name), " scope=\"row\"") +
                              element("td", escape(c.meaning), " class=\"sentences\"") +
                              element("td", escape(formatNumber(c.value, 2) + " " + c.unit), " class=\"number\"") +
                              element("td", escape(formatNumber(c.limit, 2) + " " + c.unit), " class=\"number\"") +
                              element("td", c.holds() ? "<span class=\"good\">\u2713 holds</span>"
                                                      : "<span class=\"bad\">\u2717 fails</span>"));
  const std::string head =
      element("tr", element("th", "check", " scope=\"col\"") + element("th", "what is compared", " scope=\"col\"") +
                        element("th", "measured", " scope=\"col\" class=\"number\"") +
                        element("th", "allowed", " scope=\"col\" class=\"number\"") +
                        element("th", "verdict", " scope=\"col\""));
  return html::tablePanel(caption, element("thead", head) + element("tbody", rows));
}

TableCell::TableCell(double v, int digits) : text(formatNumber(v, digits)), number(true) {}

Trust trustOf(const ReportInput& input) {
  Trust trust;
  for (const AuditCheck& c : input.audit) trust.check(c.holds(), c.spoils);
  for (const Stretch& s : input.stretch) trust.stretch(s);
  trust.unplayed = !input.played;
  return trust;
}

const JointSummary* highestJoint(const ReportInput& input) {
  const JointSummary* best = nullptr;
  for (const auto& j : input.joints)
    if (std::isfinite(j.peak_Nm) && (!best || sizeOf(j) > sizeOf(*best))) best = &j;
  return best;
}

std::string headlineOf(const ReportInput& input) {
  const JointSummary* j = highestJoint(input);
  if (!j && input.joints.empty() && !input.outcome.empty()) return input.outcome;
  if (!j)
    return input.joints.empty() ? "This run measured no joint torques."
                                : "No joint torque of this run is a finite number.";
  // What leaves none of the numbers comes before them.
  std::string s = "Peak";
  for (const AuditCheck& c : input.audit)
    if (!c.holds() && c.spoils) {
      s = fmt::format("Not to be relied on{}: peak", c.wrong.empty() ? "" : ", as " + c.wrong);
      break;
    }
  s += fmt::format(" added {} torque: {} Nm", j->joint, formatNumber(sizeOf(*j)));
  if (!j->side.empty()) s += ", " + j->side + " side";
  s += ", at " + seconds(j->peak_time_s);
  if (!j->cause.empty()) s += ", during " + j->cause;
  if (j->natural_percent) s += "; " + shareOf(*j);
  return s + ".";
}

std::string formatReport(const ReportInput& in) {
  std::string body = alarms(in) + headline(in) + notesOf(in.notes) + foundText(in.found) + viewerSection(in.viewer);
  if (!in.joints.empty() || in.outcome.empty())
    body +=
        pageSectionOf("joints", "What each joint pays",
                      "Highest first. The share compares the peak with the moment that the joint needs in this task "
                      "without the garment.",
                      joints(in));
  const bool strides =
      std::any_of(in.torques.begin(), in.torques.end(), [](const Plot& p) { return !p.marks.empty(); });
  if (!in.torques.empty())
    body += pageSectionOf("torques", "Torque over time", strides ? "Dotted vertical lines mark the strides." : "",
                          charts(each(in.torques, lineChart)));
  if (!in.contact_charts.empty() || !in.contact_tables.empty())
    body += pageSectionOf("contact", "Where the garment presses", "Contact force of the cloth on the body.",
                          charts(each(in.contact_charts, barChart) + each(in.contact_plots, lineChart) +
                                 each(in.contact_tables, tableOf)));
  if (!in.comfort_tables.empty())
    body += pageSectionOf(
        "comfort", "How it feels", in.comfort,
        (in.comfort_pictures.empty() ? ""
                                     : element("div", each(in.comfort_pictures, figureOf), " class=\"pictures\"")) +
            element("div", each(in.comfort_tables, tableOf), " class=\"wide\""));
  if (!in.collision_plots.empty() || !in.collision_tables.empty())
    body +=
        pageSectionOf("collisions", "What met what",
                      "Cloth with bodies and cloth with cloth, window by window; the numbers stand in collisions.csv.",
                      charts(each(in.collision_tables, tableOf) + each(in.collision_plots, lineChart)));
  if (!in.stress_tables.empty())
    body += pageSectionOf("stress", "What the fabric carries", "", charts(each(in.stress_tables, tableOf)));
  if (in.pictures.size() > 1)
    body +=
        pageSectionOf("pictures", "Pictures", "",
                      element("div", each(std::vector<Picture>(in.pictures.begin() + 1, in.pictures.end()), figureOf),
                              " class=\"pictures\""));
  if (!in.support_tables.empty())
    body += pageSectionOf("supports", "What holds the garment",
                          "Reactions of the supports are reported apart and are part of no joint torque.",
                          charts(each(in.support_tables, tableOf)));
  body += pageSectionOf(
      "audit", "Why to trust these numbers", "",
      in.audit.empty() ? notice("This run was not audited.") : charts(auditTableOf(in.audit, "Checks of every step")));
  body +=
      pageSectionOf("assumptions", "What was assumed", "",
                    in.assumptions.empty()
                        ? notice("The assumptions of this run were not recorded.")
                        : element("ul", each(in.assumptions, [](const auto& a) { return element("li", escape(a)); }),
                                  " class=\"assumptions\""));
  if (!in.facts.empty() || !in.fact_tables.empty()) {
    Table facts{"The run", "", {"fact", "value"}, {}};
    for (const auto& [name, value] : in.facts) facts.rows.push_back({name, value});
    body += pageSectionOf("run", "How it was computed", "",
                          charts((in.facts.empty() ? "" : tableOf(facts)) + each(in.fact_tables, tableOf) +
                                 each(in.fact_plots, lineChart)));
  }
  return pageOf(in.title, in.description, headlineOf(in), body, !in.viewer.empty());
}

void writeReport(const ReportInput& input, const std::filesystem::path& html) {
  writeOwnFile(html, formatReport(input));
}

}  // namespace gambeson
