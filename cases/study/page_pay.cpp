/// Detail of page_parts.hpp: what each joint pays in each variant.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/report/html.hpp"
#include "analysis/ticks.hpp"
#include "cases/study/page_parts.hpp"
#include "cases/wear/recording/zone_ledger.hpp"
#include "cases/wear/results/joint_words.hpp"

namespace gambeson::study {
namespace {

using html::element;
using html::escape;

/// The natural moment of a joint that all runs of a group share; nothing where they have their own, as wearers do.
std::optional<double> sharedNatural(const Comparison& c, const VariantGroup& g, const std::string& joint) {
  std::optional<double> shared;
  for (const std::size_t i : g.members) {
    const JointNumbers* j = c.runs[i].joint(joint);
    if (!j || !j->natural_Nm) continue;
    if (shared && std::abs(*j->natural_Nm - *shared) > 1e-9 * *shared) return {};
    shared = j->natural_Nm;
  }
  return shared;
}

/// One joint of one run, in two lines; with its natural moment where that is its own.
Html payment(const Study& s, const Comparison& c, std::size_t i, const JointNumbers& j, bool own_natural) {
  std::string first = j.part() ? escape(percentBeside(*j.part(), s.limits.green, s.limits.red)) + " " +
                                     lightOf(s, c.runs[i].trust(), j.part())
                               : "";
  std::string second = formatNumber(std::abs(j.peak_Nm)) +
                       (j.prismatic ? " N" : plusMinus(s, c, i, {Headline::Quantity::peak, j.name, j.label}) + " Nm");
  if (own_natural && j.natural_Nm) second += "<br>of natural " + formatNumber(*j.natural_Nm) + " Nm";
  if (const JointRatio* r = ratioOf(c, i, j.name); r && !isBaseline(s, i) && std::isfinite(r->peak))
    second += "<br>" + formatNumber(r->peak, 2) + " of the baseline\u2019s";
  if (!j.prismatic) second += std::string("<br>") + nameOf(pushOf(j.peak_Nm, j.rate_at_peak));
  return Html::aligned(first + (first.empty() ? "" : "<br>") + element("small", second));
}

/// The natural moment of a joint in a motion, and where it is of holding still what makes it.
Html naturalOf(const Comparison& c, const VariantGroup& g, const std::string& joint) {
  if (!sharedNatural(c, g, joint)) return Html::aligned("");
  for (const std::size_t i : g.members) {
    const JointNumbers* j = c.runs[i].joint(joint);
    if (!j || !j->natural_Nm) continue;
    std::string text = "natural " + escape(formatNumber(*j->natural_Nm)) + " Nm";
    if (j->foot_part && j->lever_m)
      text += fmt::format("<br>foot bears {},<br>{} cm off the joint", percent(j->foot_part),
                          formatNumber(100 * *j->lever_m, 2));
    return Html::aligned(element("small", text));
  }
  return Html::aligned("");
}

/// Tells how the numbers of the table of payments are meant.
std::string readingOf(const Study& s, const Comparison& c) {
  std::string list;
  const auto say = [&](const std::string& text) { list += element("li", escape(text)); };
  std::string counted;
  bool lead_in = false;
  for (const VariantGroup& g : c.groups)
    for (const std::size_t i : g.members)
      if (const RunNumbers& r = c.runs[i]; r.good && !r.time_s.empty()) {
        lead_in = lead_in || r.counted_from_s > 0;
        counted += fmt::format("{}{}from {}", counted.empty() ? "" : "; ", g.label.empty() ? "" : g.label + " ",
                               r.counted_from_s > 0 ? html::seconds(r.counted_from_s) + " on" : "the start");
        break;
      }
  if (lead_in)
    say("Peak: the largest added torque of either sense once the motion repeats itself (" + counted +
        "). Before that the wearer gets going from standing: the curves show it, the numbers leave it out.");
  say("Against the motion: when its torque peaks, the garment hinders, and the muscles must turn the joint against it. "
      "With the motion: it then turns the joint the way it goes, which helps unless the muscles are braking.");
  std::vector<std::string> told;
  for (const VariantGroup& g : c.groups) {
    const auto* k = std::get_if<Case>(&s.variants[g.members[0]].definition);
    const bool known =
        std::any_of(g.members.begin(), g.members.end(), [&](std::size_t i) { return c.runs[i].natural(); });
    const std::string natural = k && known ? naturalMeaning(k->analysis.task) : "";
    if (natural.empty() || std::find(told.begin(), told.end(), natural) != told.end()) continue;
    told.push_back(natural);
    const JointNumbers* j = c.runs[g.members[0]].joint(g.joint());
    say((g.label.empty() ? "" : g.label + ": ") + natural +
        (j && j->foot_part
             ? " Under each: the part of the weight on that foot, and how far from the joint the ground\u2019s "
               "force on it passes."
             : ""));
  }
  say(std::string("Shown are the joint that decides (") +
      (anyNatural(c) ? "the largest share of its natural moment), those that are not green somewhere, "
                     : "of the largest torque) ") +
      "and those with a fifth of the largest torque. Joints beyond which the garment touches nothing are left out. All "
      "are in variants.csv.");
  return element("ul", list, " class=\"assumptions\"");
}

using Joints = std::vector<std::pair<std::string, std::string>>;  ///< names and labels

/// The joints that the table of payments shows, first those that decide in a group.
Joints jointsShown(const Comparison& c) {
  Joints shown;
  const auto add = [&](const VariantGroup& g, const std::string& name) {
    if (std::any_of(shown.begin(), shown.end(), [&](const auto& k) { return k.first == name; })) return;
    for (const std::size_t i : g.members)
      if (const JointNumbers* j = c.runs[i].joint(name)) {
        shown.emplace_back(name, j->label);
        return;
      }
  };
  for (const VariantGroup& g : c.groups)
    if (!g.joints.empty()) add(g, g.joints[0]);
  for (const VariantGroup& g : c.groups)
    for (const std::string& name : g.joints) add(g, name);
  return shown;
}

/// Joints that the first table has no room for.
std::string furtherJoints(const Study& s, const Comparison& c, const Joints& joints) {
  std::vector<std::string> columns{"variant"};
  for (const auto& [name, label] : joints) columns.push_back(label);
  std::vector<std::vector<Html>> rows;
  for (const VariantGroup& g : c.groups)
    for (const std::size_t i : g.members) {
      std::vector<Html> row{escape(s.variants[i].label)};
      for (const auto& [name, label] : joints) {
        const JointNumbers* j = c.runs[i].joint(name);
        row.push_back(j && j->applies() ? payment(s, c, i, *j, true) : Html::aligned("\u2013"));
      }
      rows.push_back(std::move(row));
    }
  return charts(htmlTable("Further joints", columns, rows, ""));
}

}  // namespace

std::string payOf(const Study& s, const Comparison& c) {
  constexpr std::size_t most_columns = 4;  // as many as a page is wide
  const Joints all = jointsShown(c);
  Joints joints = all;
  if (joints.size() > most_columns) joints.resize(most_columns);
  // What leaves a row in doubt stands beside its name, in sight on a narrow page too.
  std::vector<std::string> columns{"variant (its own report)", "failing checks"};
  for (const auto& [name, label] : joints) columns.push_back(label);
  columns.insert(columns.end(), {"mass [kg]", "least comfortable"});
  const auto rowOf = [&](std::size_t i, const std::string& name, const VariantGroup* g) {
    const Variant& v = s.variants[i];
    const RunNumbers& r = c.runs[i];
    std::string below;
    for (const GarmentNumbers& l : r.garments)
      if (c.input.sized)
        below += (below.empty() ? "" : ", ") + l.name + (l.name.empty() ? "" : " ") + formatNumber(1e3 * l.thickness_m);
    if (!below.empty()) below = "<br>" + element("small", escape(below + " mm"), " class=\"q\"");
    const char* base = isBaseline(s, i) ? " <small>baseline</small>" : "";
    std::vector<Html> row{r.good ? linkTo(v, name) + base + below
                                 : escape(name) + " <span class=\"bad\">\u2717 failed</span>"};
    row.push_back(Html::aligned(!r.good           ? "\u2013"
                                : r.failing() > 0 ? fmt::format("<span class=\"bad\">\u2717 {}</span>", r.failing())
                                                  : "<span class=\"good\">\u2713</span>"));
    for (const auto& [joint, label] : joints) {
      const JointNumbers* j = r.good ? r.joint(joint) : nullptr;
      row.push_back(j && j->applies() ? payment(s, c, i, *j, !g || !sharedNatural(c, *g, joint))
                                      : Html::aligned("\u2013"));
    }
    row.push_back(r.good && r.mass_kg() > 0 ? Html(r.mass_kg()) : Html(std::nan("")));
    const ComfortNumbers* k = r.leastComfortable();
    row.push_back(k ? Html(escape(spokenZone(k->zone)) + " " + lightOf(lightNamed(k->light), r.trust()))
                    : Html(std::string("\u2013")));
    return row;
  };
  std::vector<std::vector<Html>> rows, others;
  for (const VariantGroup& g : c.groups) {
    std::vector<Html> heading{Html::heading(escape(g.label)), Html(std::string())};
    for (const auto& [name, label] : joints) heading.push_back(naturalOf(c, g, name));
    const bool any = std::any_of(heading.begin(), heading.end(), [](const Html& h) { return !h.html.empty(); });
    if (c.groups.size() > 1 || any) {
      heading.insert(heading.end(), 2, Html(std::string()));
      rows.push_back(heading);
    }
    for (const std::size_t i : g.members) rows.push_back(rowOf(i, memberName(s, c, i), &g));
  }
  for (std::size_t i = 0; i < s.variants.size(); ++i)
    if (std::none_of(c.groups.begin(), c.groups.end(), [&](const VariantGroup& g) {
          return std::find(g.members.begin(), g.members.end(), i) != g.members.end();
        }))
      others.push_back(rowOf(i, s.variants[i].label, nullptr));
  std::string out = charts(htmlTable(s.file.empty() ? "All runs" : "All variants", columns, rows, ""));
  if (!joints.empty()) out += readingOf(s, c);
  std::string more;
  for (std::size_t from = joints.size(); from < all.size(); from += most_columns) {
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(from);
    more +=
        furtherJoints(s, c, {first, first + static_cast<std::ptrdiff_t>(std::min(most_columns, all.size() - from))});
  }
  if (!more.empty()) out += folded("The other joints that matter", more);
  if (!others.empty())
    out += folded(
        fmt::format("{} more {}, beside the variants compared", others.size(), others.size() == 1 ? "run" : "runs"),
        charts(htmlTable("Further runs", columns, others, "")));
  return out;
}

}  // namespace gambeson::study
