/// Detail of compare.hpp: the page of a study: the verdict first, then what it rests on.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/report/html.hpp"
#include "analysis/report/parts.hpp"
#include "analysis/ticks.hpp"
#include "cases/study/page_parts.hpp"

namespace gambeson::study {

using html::element;
using html::escape;
using html::prose;

Html::Html(double v, int digits) : html(std::isfinite(v) ? formatNumber(v, digits) : "\u2013"), number(true) {}
Html::Html(const std::optional<double>& v, int digits) : Html(v.value_or(std::nan("")), digits) {}
Html Html::aligned(std::string h) {
  Html cell(std::move(h));
  cell.number = true;
  return cell;
}

Html Html::heading(std::string h) {
  Html cell(std::move(h));
  cell.heads = true;
  return cell;
}

std::string htmlTable(const std::string& title, const std::vector<std::string>& columns,
                      const std::vector<std::vector<Html>>& rows, const std::string& caption) {
  std::string head, body;
  // "thickness x 0.5" stays on one line.
  const auto together = [](std::string name) {
    for (std::size_t at = 0; (at = name.find(" x ", at)) != std::string::npos; ++at) name.replace(at, 3, " x&nbsp;");
    return name;
  };
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const bool number =
        k > 0 && std::any_of(rows.begin(), rows.end(), [&](const auto& r) { return k < r.size() && r[k].number; });
    head += element("th", escape(columns[k]), number ? " scope=\"col\" class=\"number\"" : " scope=\"col\"");
  }
  for (const auto& row : rows) {
    std::string cells;
    // One that has no cells beside it runs over all columns.
    if (row[0].heads && row.size() == 1)
      cells = element("th", together(row[0].html), fmt::format(" scope=\"rowgroup\" colspan=\"{}\"", columns.size()));
    else
      for (std::size_t k = 0; k < row.size(); ++k)
        cells += k == 0 ? element("th", together(row[k].html), " scope=\"row\"")
                        : element("td", row[k].html, row[k].number ? " class=\"number\"" : "");
    body += element("tr", cells, row[0].heads ? " class=\"group\"" : "");
  }
  return html::tablePanel(title, element("thead", element("tr", head)) + element("tbody", body),
                          caption.empty() ? "" : element("p", escape(caption), " class=\"caption\""));
}

std::string charts(const std::string& body) { return element("div", body, " class=\"charts\""); }

std::string folded(const std::string& summary, const std::string& body) {
  return element("details", element("summary", escape(summary)) + body);
}

std::string lightOf(const std::string& light) { return html::lightOf(light); }
std::string lightOf(Light light) {
  return light == Light::unknown ? element("span", "not known", " class=\"light unknown\"")
                                 : html::lightOf(nameOf(light));
}
std::string lightOf(Light by_number, const Trust& trust) {
  // A number is known there, and no light is shown for it.
  if (trust.spoiling > 0) return element("span", "not judged", " class=\"light unknown\"");
  return lightOf(shownLight(by_number, trust));
}

std::string lightOf(const Study& s, const Trust& trust, const std::optional<double>& part) {
  return lightOf(gambeson::lightOf(part, s.limits.green, s.limits.red), trust);
}

bool anyNatural(const Comparison& c) {
  return std::any_of(c.runs.begin(), c.runs.end(), [](const RunNumbers& r) { return r.natural(); });
}

std::string percent(const std::optional<double>& part) {
  if (!part || !std::isfinite(*part)) return "not known";
  return *part < 0.995 ? fmt::format("{:.2g} %", 100 * *part) : fmt::format("{:.0f} %", 100 * *part);
}

std::string linkTo(const Variant& v, const std::string& text) {
  return element("a", escape(text), " href=\"" + escape(v.folder) + "/report.html\"");
}

std::string multiplesOf(const Study& s) {
  std::string text;
  for (const Axis& a : s.axes) {
    if (!a.multiple || a.levels.size() < 2) continue;
    const auto least = std::min_element(a.levels.begin(), a.levels.end(), [](const Level& x, const Level& y) {
      return x.number.value_or(1) < y.number.value_or(1);
    });
    if (!least->number) continue;
    const std::string& path = least->set[0].path;
    text += fmt::format(
        "{}\u201c{} x {}\u201d means {} times the {} that the garment was designed with{}; x 1 is the "
        "design.",
        text.empty() ? "" : " ", a.name, least->label, least->label, a.name,
        a.role != Role::thickness      ? ""
        : path.starts_with("factors.") ? ", in every garment, and is no measure in mm"
                                       : ", in that region, and is no measure in mm");
  }
  return text;
}

namespace {

std::string judged(Light light, const std::string& text) {
  if (text.empty()) return "";
  const std::string name = light == Light::unknown ? "unknown" : nameOf(light);
  return element("p", element("strong", html::markOf(name), " aria-hidden=\"true\"") + prose(text),
                 " class=\"judged " + name + "\"");
}

std::string item(const std::string& question, const std::string& html) {
  return element("dt", escape(question)) + element("dd", html);
}

/// The joint of a cost of an option, and the variant whose it is; null where there is none.
std::pair<const JointNumbers*, std::size_t> payerOf(const Study& s, const Comparison& c, const Option& option,
                                                    const Option::Cost& cost) {
  for (const VariantGroup& g : c.groups)
    for (const std::size_t i : g.members)
      if (g.label == cost.motion && memberName(s, c, i) == option.name)
        for (const JointNumbers& j : c.runs[i].joints)
          if (j.label == cost.joint) return {&j, i};
  return {nullptr, 0};
}

/// "4 % of natural 52.0 Nm: 2.08 ± 0.31 Nm, left hip (flexion), at 0.84 s, during swing ..." with its light.
std::string costOf(const Study& s, const Comparison& c, const Option& option, const Option::Cost& worst) {
  const std::string share =
      worst.part ? fmt::format("{} of natural {} Nm: ", percentBeside(*worst.part, s.limits.green, s.limits.red),
                               formatNumber(worst.peak_Nm / *worst.part))
                 : "";
  const auto [payer, variant] = payerOf(s, c, option, worst);
  std::string bar, when;
  if (payer) {
    bar = plusMinus(s, c, variant, {Headline::Quantity::peak, payer->name, payer->label});
    when = ", at " + html::seconds(payer->peak_time_s) + (payer->cause.empty() ? "" : ", during " + payer->cause);
  }
  // Where no run knows a natural moment, no light is missing.
  return fmt::format(
      "{}{}", anyNatural(c) ? lightOf(s, trustOf(c.input), worst.part) + " " : "",
      element("span", prose(fmt::format("{}{}{} Nm, {}{}", share, formatNumber(worst.peak_Nm), bar, worst.joint, when)),
              " class=\"reason\""));
}

/// "thickness x 1": the options whose runs tell the error bars; empty where none has a name.
std::string barred(const Study& s, const Comparison& c) {
  std::vector<std::string> names;
  for (const Budget& b : c.budgets)
    if (const std::string name = memberName(s, c, b.reference);
        !name.empty() && std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(name);
  return names.empty() ? "" : schema::joined(names);
}

/// The error bars of the pressure that decides of the option that is taken; empty where none is known.
std::string comfortBar(const Study& s, const Comparison& c) {
  if (c.verdict.take < 0 || c.verdict.comfort.empty()) return "";
  using Q = Headline::Quantity;
  std::size_t worst = 0;
  const ComfortNumbers* least = nullptr;
  for (const VariantGroup& g : c.groups)
    for (const std::size_t i : g.members)
      if (memberName(s, c, i) == c.input.options[static_cast<std::size_t>(c.verdict.take)].name)
        if (const ComfortNumbers* k = c.runs[i].leastComfortable();
            k && (!least || k->part_of_limit() > least->part_of_limit()))
          least = k, worst = i;
  if (!least) return "";
  std::string text;
  for (const auto& [quantity, name] : {std::pair(Q::mean_pressure, "mean"), std::pair(Q::peak_pressure, "peak")})
    if (const auto n = gambeson::study::barOf(s, c, worst, {quantity, least->zone, ""}); n && n->relative())
      text += fmt::format("{} of the {} \u00b1 {}", text.empty() ? " Error bar" : ",", name, percent(*n->relative()));
  if (!text.empty()) text += ".";
  // The runs of the error bars are those of another variant, and may fare worse.
  int all = 0, worse = 0;
  for (std::size_t i = 0; i < s.variants.size(); ++i) {
    const ComfortNumbers* k = s.variants[i].part != BarPart::none ? c.runs[i].leastComfortable() : nullptr;
    all += k != nullptr, worse += k && (k->light == "amber" || k->light == "red");
  }
  const std::string whose = barred(s, c);
  if (worse > 0)
    text += fmt::format(" Of the {} runs{} that tell the error bars {} {} a part of the body that is amber or red.",
                        all, whose.empty() ? "" : " of " + whose, worse, worse == 1 ? "has" : "have");
  return text;
}

/// Where none is taken: each, with its own natural moments.
std::string eachOf(const Study& s, const Comparison& c) {
  std::string list;
  for (const Option& o : c.input.options) {
    std::string costs;
    for (const VariantGroup& g : c.groups)
      if (const Option::Cost* worst = worstCost(o, &g.label))
        costs +=
            (costs.empty() ? "" : "<br>") + (g.label.empty() ? "" : escape(g.label) + ": ") + costOf(s, c, o, *worst);
    list += item(o.name, costs.empty() ? (o.untouched ? "touches nothing that a joint moves" : "not known") : costs);
  }
  return element("dl", list, " class=\"answers\"");
}

/// "0.272 to 0.279 kg", "0.272 kg"; nothing where there is none above 0.
std::string fromTo(const std::vector<double>& values, const char* unit) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  if (values.empty() || !(*most > 0)) return "";
  const std::string low = formatNumber(*least), high = formatNumber(*most);
  return fmt::format("{}{} {}", low, low == high ? "" : " to " + high, unit);
}

/// Of the option taken: what it is, and what it costs in each motion.
std::string takenOf(const Study& s, const Comparison& c) {
  if (c.verdict.take < 0 || trustOf(c.input).spoiling > 0) return "";
  if (!c.verdict.chosen) return eachOf(s, c);
  std::string list;
  const Option& o = c.input.options[static_cast<std::size_t>(c.verdict.take)];
  std::vector<double> mass, base;  // of each wearer or motion
  for (std::size_t i = 0; i < s.variants.size(); ++i) {
    if (!s.variants[i].grid || !c.runs[i].good) continue;
    if (memberName(s, c, i) == o.name) mass.push_back(c.runs[i].mass_kg());
    if (s.variants[i].baseline == static_cast<int>(i)) base.push_back(c.runs[i].mass_kg());
  }
  const std::string weighs = fromTo(mass, "kg"), instead = fromTo(base, "kg");
  if (!c.verdict.garments.empty()) list += item("Thickness", prose(c.verdict.garments));
  if (!weighs.empty())
    list += item("Weighs", !instead.empty() && instead != weighs ? weighs + " instead of " + instead : weighs);
  for (const VariantGroup& g : c.groups) {
    const Option::Cost* worst = worstCost(o, &g.label);
    if (!worst) continue;
    list += item(g.label.empty() ? "Costs" : fmt::format("Costs, {}", g.label), costOf(s, c, o, *worst));
  }
  return element("dl", list, " class=\"answers\"");
}

std::string card(const std::string& title, const std::string& text, const std::string& after = "") {
  return text.empty()
             ? ""
             : element("div", element("h3", escape(title)) + element("p", prose(text)) + after, " class=\"card\"");
}

/// What the words of the verdict mean, with every word of the lights.
std::string meaningOf(const Study& s, const Comparison& c) {
  std::string text =
      "Added torque: the garment pushes on the body and so turns its joints; the wearer\u2019s muscles must give as "
      "much against it, on top of what the movement needs. Where the garment pushes the way the joint moves, they are "
      "spared it. ";
  if (anyNatural(c))
    text += fmt::format(
        "Natural moment: the largest that the joint needs for the movement without the garment. Green: the added "
        "torque is below {0} of it. Amber: between {0} and {1}. Red: above {1} ({2}). Not known: of that joint no "
        "natural moment is known. ",
        percent(s.limits.green), percent(s.limits.red), s.limits.source);
  else
    text += "No natural moment of this task is known: torques have no light, and the lights are those of comfort. ";
  text +=
      "Comfort: green where the mean pressure over time is at most the comfortable one, amber between that and its "
      "limit, red above, or where the peak is above the limit of peaks (suggestions too; a case sets its own). "
      "Doubtful: green by its number, but a check of a run fails, or the fabric stretches further than it is meant "
      "for. Not judged: a check fails that leaves none of the numbers.";
  return element("h3", "What the words mean", " class=\"words-mean\"") +
         element("p", escape(text), " class=\"meaning\"");
}

std::string headline(const Study& s, const Comparison& c, const std::vector<SidePicture>& pictures) {
  const Verdict& v = c.verdict;
  // What leaves the answer in doubt stands in its sentence, in smaller letters.
  const std::size_t doubt = v.doubt.empty() ? std::string::npos : v.sentence.find(v.doubt);
  std::string words = element(
      "p",
      prose(v.sentence.substr(0, doubt)) +
          (doubt == std::string::npos ? "" : element("span", prose(v.sentence.substr(doubt)), " class=\"doubted\"")),
      " class=\"sentence\"");
  words += judged(v.cover, v.enough) + judged(v.comfort_light, v.comfort.empty() ? "" : v.comfort + comfortBar(s, c)) +
           takenOf(s, c);
  std::string meaning;
  for (const std::string& note :
       {multiplesOf(s),
        std::string(c.input.role == Role::model
                        ? "Kinds of cloth are ways to compute one garment, and none is a design to take: how far they "
                          "are apart tells how far a torque hangs on the way."
                        : "")})
    if (!note.empty()) meaning += element("p", prose(note), " class=\"meaning\"");
  meaning += element("p", "<strong>Effort and comfort only: what protects enough is not part of this study.</strong>",
                     " class=\"meaning\"");
  std::string body = element("div", words, " class=\"words\"");
  // The one taken, in the motion that decides.
  const SidePicture* shown = nullptr;
  if (v.take >= 0) {
    const Option& o = c.input.options[static_cast<std::size_t>(v.take)];
    const Option::Cost* worst = worstCost(o);
    for (const VariantGroup& g : c.groups)
      for (const SidePicture& p : pictures)
        if (!shown && worst && g.label == worst->motion && memberName(s, c, p.variant) == o.name &&
            std::find(g.members.begin(), g.members.end(), p.variant) != g.members.end())
          shown = &p;
  }
  if (shown) body += figureOf({shown->png, shown->caption, ""});
  std::string doubts;
  for (const auto& d : c.input.doubts)
    doubts += element("li", prose(fmt::format("{}, {}", d.check, placeOf(d.runs, c.input))));
  const std::string whose = barred(s, c);
  const std::string carried =
      whose.empty()
          ? ""
          : fmt::format(" It was found with {}; of the others it is taken to be the same part of their torques.",
                        whose);
  const char* surety[]{"not sure", "fairly sure", "sure"};
  const std::string cards =
      card(v.chosen && v.light != Light::red ? "Why this one" : "How they differ", v.why) +
      card("Where it costs most", whereOf(s, c)) + card("What to change", changesOf(s, c)) +
      card("Thinner still?", v.estimate) +
      card(fmt::format("{}: {}",
                       v.chosen                      ? "Which one"
                       : c.input.role == Role::model ? "The largest"
                                                     : "The worst",
                       surety[static_cast<int>(v.surety)]),
           v.choice) +
      card(
          c.input.error() ? fmt::format("How much: \u00b1 {}", percent(c.input.error()))
                          : std::string("How much: no error bar"),
          v.numbers + (c.verdict.take >= 0 ? trendOf(c) : "") + carried,
          (c.budgets.empty() ? "" : element("p", "<a href=\"#sure\">What that is made of</a>")) +
              (doubts.empty() ? "" : element("ul", doubts) + element("p", "<a href=\"#checks\">What that means</a>"))) +
      card("What to measure", measuresOf(s, c));
  return element("section", body + meaning,
                 shown ? " class=\"headline pictured\" aria-label=\"The verdict\""
                       : " class=\"headline\" aria-label=\"The verdict\"") +
         element("div", cards, " class=\"cards reasons\"") + meaningOf(s, c);
}

std::string alarms(const Study& s, const Comparison& c, const std::vector<std::string>& failures) {
  std::string out;
  const auto alarm = [&](const std::string& html) { out += element("p", html, " class=\"alarm\" role=\"alert\""); };
  for (std::size_t i = 0; i < s.variants.size(); ++i)
    if (!c.runs[i].good) alarm(escape(fmt::format("The variant {} failed: {}", s.variants[i].label, c.runs[i].why)));
  for (const auto& d : c.input.doubts)
    if (d.order)
      alarm(escape(fmt::format("Do not rely on this page before you know why the check {} fails {}.", d.check,
                               placeOf(d.runs, c.input))) +
            " <a href=\"#checks\">What that means</a>");
  for (const std::string& f : failures) alarm(escape(f));
  return out;
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
                      const std::vector<std::string>& failures, const std::vector<ViewerRun>& views) {
  const bool batch = s.file.empty();
  std::string body = alarms(s, c, failures);
  const auto pageSection = [&](const char* id, const char* title, const std::string& lead, const std::string& what) {
    if (!what.empty()) body += pageSectionOf(id, title, lead, what);
  };
  if (c.population)
    body += populationHeadline(s, c, pictures);
  else if (!batch)
    body += headline(s, c, pictures);
  if (c.population)
    pageSection("population", "Whom it fits, whom it burdens",
                "Wearers are people drawn from a survey; each has a run, and a report, of their own.",
                populationOf(s, c, pictures));
  pageSection("map", "The thickness map",
              "How thick each region of the garment should be, so that it costs its wearer least.", mapOf(s));
  body += viewerSection(views);
  const bool joints = std::any_of(c.runs.begin(), c.runs.end(), [](const RunNumbers& r) { return r.highest(); });
  const std::string shares = anyNatural(c) ? ": in per cent of the joint\u2019s natural moment, in Nm," : " in Nm,";
  pageSection(
      "pay", batch || !joints ? "The runs" : "What each joint pays",
      !joints ? ""
      : c.population
          ? "The largest added torque" + shares + " of each wearer."
          : "The largest added torque" + shares +
                " and as a part of that of the baseline, the variant that the others are compared with, in the same "
                "motion.",
      payOf(s, c));
  if (!batch && !c.population) {
    pageSection("curves", "Added torque over time", "Each variant has one colour throughout.", curvesOf(s, c));
  }
  pageSection("forces", "Comfort, and where the garment presses", "", forcesOf(s, c));
  if (!batch && !c.population) {
    pageSection("laws", "How the torque changes with what varies", "", lawsOf(s, c));
    pageSection("elasticities", "What the torque is made of", "", elasticitiesOf(c));
    pageSection("meshes", "Coarse and fine", "What the error bar of the verdict comes from.", meshesOf(c));
    pageSection("sure", "How sure",
                "Each number is off by its mesh and its time step, and no two pieces of a fabric are alike. Which of "
                "these counts, and what would make the number surer?",
                sureOf(s, c));
    pageSection("standing", "Standing and moving", "", standingOf(s, c));
  }
  pageSection("measured", "Against measured garments", "Where garment and motion correspond.", measuredOf(s, c));
  pageSection("garments", "The garments", "", kindsOf(s, c) + thicknessPage(s, c));
  pageSection("cloth", "How it sits", "", clothOf(s, c));
  if (!pictures.empty() && !c.population)
    pageSection(
        "pictures", "Side by side",
        "Of each motion all variants at the same time. The same colour means the same value, and arrows of the same "
        "length the same force, in all pictures. Colours end at a value that 99 % of the cloth stays below in every "
        "picture; a pointed end of the bar stands for what lies beyond it.",
        pairs(s, pictures));
  pageSection("checks", "Checks", "Every run checks itself, step by step.", checksOf(s, c));
  pageSection("assumptions", "What was left out and assumed", "", leftOutOf(s, c));
  return pageOf(s.name, s.description,
                batch          ? s.name
                : c.population ? c.population->sentence
                               : c.verdict.sentence,
                body, !views.empty());
}

}  // namespace gambeson::study
