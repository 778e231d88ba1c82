/// Detail of page_parts.hpp: whom the garment fits and whom it burdens, of wearers that were drawn.

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "analysis/report/chart.hpp"
#include "analysis/report/html.hpp"
#include "analysis/report/parts.hpp"
#include "analysis/report/xy_chart.hpp"
#include "analysis/ticks.hpp"
#include "cases/study/page_parts.hpp"
#include "cases/wear/recording/zone_ledger.hpp"

namespace gambeson::study {
namespace {

using html::element;
using html::escape;
using html::prose;

std::string answerItem(const std::string& question, const std::string& html) {
  return element("dt", escape(question)) + element("dd", html);
}

std::string whole(double part) { return fmt::format("{:.0f}", 100 * part); }

/// "22 of 24: 92 % (of all people 74 to 98 %)"
std::string shareText(const PopulationShare& p) {
  if (p.of() == 0) return "not known of anyone";
  if (!p.touched) return "as without the garment, which touches nothing beyond it";
  const ShareInterval i = p.interval();
  std::string text = fmt::format("{} of {}: {} % (between {} and {} % of all people)", p.yes, p.of(),
                                 whole(static_cast<double>(p.yes) / p.of()), whole(i.low), whole(i.high));
  if (p.doubtful > 0)
    text += fmt::format("; {} of them doubtful: a check fails, or the fabric stretches further than it is meant for",
                        p.doubtful);
  if (p.unknown > 0) text += fmt::format("; {} not known", p.unknown);
  return text;
}

/// How many wearers a part of the body, both sides together, is the least comfortable of; the most first.
std::vector<std::pair<std::string, int>> pressedOf(const PopulationAnswer& a) {
  std::map<std::string, int> count;
  for (const WearerAnswer& w : a.wearers) {
    if (!w.taken() || !w.taken()->on() || w.taken()->presses.empty()) continue;
    std::string zone = w.taken()->presses;
    for (const std::string side : {"_left", "_right"})
      if (zone.ends_with(side)) zone.resize(zone.size() - side.size());
    ++count[spokenZone(zone)];
  }
  std::vector<std::pair<std::string, int>> all(count.begin(), count.end());
  std::stable_sort(all.begin(), all.end(), [](const auto& x, const auto& y) { return x.second > y.second; });
  return all;
}

/// Wearers of each size, in the order of the sizes; the last number is that of those whom none fits.
std::vector<int> takersOf(const Study& s, const PopulationAnswer& a) {
  std::vector<int> takers(s.population->input.sizes.size() + 1);
  for (const WearerAnswer& w : a.wearers)
    ++takers[w.taken() && w.taken()->on() ? static_cast<std::size_t>(w.taken()->size) : takers.size() - 1];
  return takers;
}

std::string peopleOf(const Population& p) {
  std::string text;
  const auto add = [&](int n, const char* one, const char* many) {
    if (n > 0) text += fmt::format("{}{} {}", text.empty() ? "" : " and ", n, n == 1 ? one : many);
  };
  add(p.men, "man", "men");
  add(p.women, "woman", "women");
  return text;
}

// --- Plots ------------------------------------------------------------------------------------------------------

/// Of how many wearers a joint pays at most so much.
std::string burdenPlot(const Study& s, const PopulationAnswer& a) {
  XyPlot plot;
  plot.title = "How the burden is spread";
  plot.x_name = "largest added torque, of the natural moment [%]";
  plot.y_name = "wearers who pay at most that [%]";
  double most = 100 * s.limits.green;
  for (std::size_t k = 0; k < kBurdened.size(); ++k) {
    std::vector<double> parts;
    for (const WearerAnswer& w : a.wearers)
      if (w.taken() && w.taken()->on() && w.taken()->burdens[k].part)
        parts.push_back(100 * *w.taken()->burdens[k].part);
    if (parts.empty()) continue;
    std::sort(parts.begin(), parts.end());
    XySeries line{kBurdened[k], {0}, {0}};
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const double below = 100. * static_cast<double>(i) / static_cast<double>(parts.size()),
                   upto = 100. * static_cast<double>(i + 1) / static_cast<double>(parts.size());
      line.x.insert(line.x.end(), {parts[i], parts[i]});
      line.y.insert(line.y.end(), {below, upto});
    }
    most = std::max(most, parts.back());
    plot.series.push_back(std::move(line));
  }
  if (plot.series.empty()) return "";
  XySeries limit{
      fmt::format("green below {:g} %", 100 * s.limits.green), {100 * s.limits.green, 100 * s.limits.green}, {0, 100}};
  plot.series.push_back(std::move(limit));
  if (most > 100 * s.limits.red)
    plot.series.push_back(
        {fmt::format("red above {:g} %", 100 * s.limits.red), {100 * s.limits.red, 100 * s.limits.red}, {0, 100}});
  plot.caption = "Of the wearers who can put it on. A steep line: it costs all of them about the same.";
  return xyChart(plot);
}

/// The worst of what its joints say; green where all that the garment reaches are known to be.
PointMark markOf(const WearerAnswer& w) {
  if (!w.taken() || !w.taken()->on()) return PointMark::unknown;
  Light worst = Light::green;
  bool unknown = false;
  for (const JointBurden& b : w.taken()->burdens) {
    unknown = unknown || (b.looked && b.touched && b.light == Light::unknown);
    if (b.looked && b.light != Light::unknown) worst = std::max(worst, b.light);
  }
  if (unknown && worst == Light::green) return PointMark::unknown;
  return worst == Light::red        ? PointMark::red
         : worst == Light::amber    ? PointMark::amber
         : worst == Light::doubtful ? PointMark::doubtful
                                    : PointMark::green;
}

/// Each wearer as a point, by two numbers of his body.
template <class X, class Y>
std::string bodiesPlot(const Study& s, const PopulationAnswer& a, XyPlot plot, X x, Y y) {
  const std::pair<PointMark, const char*> marks[]{{PointMark::green, "all joints green"},
                                                  {PointMark::doubtful, "green, but doubtful"},
                                                  {PointMark::amber, "a joint amber"},
                                                  {PointMark::red, "a joint red"},
                                                  {PointMark::unknown, "not known, or cannot put it on"}};
  for (const auto& [mark, name] : marks) {
    XySeries points{name, {}, {}, true, mark};
    for (std::size_t w = 0; w < a.wearers.size(); ++w)
      if (markOf(a.wearers[w]) == mark) {
        points.x.push_back(x(s.population->wearers[w], a.wearers[w]));
        points.y.push_back(y(s.population->wearers[w], a.wearers[w]));
      }
    if (!points.x.empty()) plot.series.push_back(std::move(points));
  }
  return plot.series.empty() ? "" : xyChart(plot);
}

std::string plotsOf(const Study& s, const PopulationAnswer& a) {
  std::string out = burdenPlot(s, a);
  XyPlot bodies;
  bodies.title = "Who they are";
  bodies.x_name = "stature [m]";
  bodies.y_name = "mass [kg]";
  bodies.caption = "Each sign is a wearer.";
  out += bodiesPlot(
      s, a, bodies, [](const Wearer& w, const auto&) { return w.measures.stature_m; },
      [](const Wearer& w, const auto&) { return w.measures.mass_kg; });
  XyPlot girths;
  girths.title = "Whom it burdens";
  girths.x_name = "mass [kg]";
  girths.y_name = "largest added torque of any joint, of its natural moment [%]";
  girths.caption = "Natural moments grow with the wearer\u2019s mass.";
  out += bodiesPlot(
      s, a, girths, [](const Wearer& w, const auto&) { return w.measures.mass_kg; },
      [](const Wearer&, const WearerAnswer& w) {
        return w.taken() && w.taken()->worst_part ? 100 * *w.taken()->worst_part : std::nan("");
      });
  const auto share = [&](int count) { return 100. * count / static_cast<double>(a.wearers.size()); };
  BarChart pressed{
      "Where it presses", "%", "Of how many of the wearers this part of the body is the least comfortable one.", {}};
  for (const auto& [zone, count] : pressedOf(a)) pressed.bars.push_back({zone, share(count)});
  if (!pressed.bars.empty()) out += barChart(pressed);
  if (s.population->sized()) {
    BarChart sizes{"Which size for how many", "%", "Of each wearer the size that goes on and burdens least.", {}};
    const std::vector<int> takers = takersOf(s, a);
    for (std::size_t k = 0; k < takers.size(); ++k)
      if (k + 1 < takers.size() || takers[k] > 0)
        sizes.bars.push_back(
            {k + 1 < takers.size() ? s.population->input.sizes[k].label : std::string("none"), share(takers[k])});
    out += barChart(sizes);
  }
  return charts(out);
}

// --- Table ------------------------------------------------------------------------------------------------------

Html burdenCell(const Study& s, const JointBurden& b) {
  if (!b.looked) return Html::aligned("\u2013");
  if (!b.touched) return Html::aligned(element("small", "not touched"));
  const std::string number = b.part ? escape(percentBeside(*b.part, s.limits.green, s.limits.red)) + " " : "";
  return Html::aligned(number + lightOf(b.light));
}

std::string wearersTable(const Study& s, const PopulationAnswer& a) {
  const Population& p = *s.population;
  std::vector<std::string> columns{"wearer (report)", "stature [m]", "mass [kg]", "waist [cm]", "hip [cm]"};
  if (p.sized()) columns.emplace_back("size");
  columns.emplace_back("goes on");
  std::array<bool, kBurdened.size()> looked{};
  for (const WearerAnswer& w : a.wearers)
    for (const Fitting& f : w.fittings)
      for (std::size_t k = 0; k < kBurdened.size(); ++k) looked[k] = looked[k] || f.burdens[k].looked;
  for (std::size_t k = 0; k < kBurdened.size(); ++k)
    if (looked[k]) columns.emplace_back(kBurdened[k]);
  columns.emplace_back("least comfortable");
  std::vector<std::vector<Html>> rows;
  for (std::size_t w = 0; w < a.wearers.size(); ++w) {
    const Wearer& of = p.wearers[w];
    const Fitting* f = a.wearers[w].taken();
    const std::string name = escape(of.label) + (of.extrapolated ? " *" : "");
    std::vector<Html> row{f && f->dressed != Dressed::failed
                              ? linkTo(s.variants[f->variant], of.label) + (of.extrapolated ? " *" : "")
                              : name,
                          Html(of.measures.stature_m), Html(of.measures.mass_kg), Html(100 * *of.measures.waist_m),
                          Html(100 * *of.measures.hip_m)};
    if (p.sized()) row.emplace_back(f ? escape(p.input.sizes[static_cast<std::size_t>(f->size)].label) : "\u2013");
    row.emplace_back(f && f->on() ? std::string("<span class=\"good\">\u2713</span>")
                                  : "<span class=\"bad\">\u2717</span> " + prose(f ? f->why : of.no_size));
    for (std::size_t k = 0; k < kBurdened.size(); ++k)
      if (looked[k]) row.push_back(f && f->on() ? burdenCell(s, f->burdens[k]) : Html::aligned("\u2013"));
    row.push_back(f && !f->presses.empty() ? Html(escape(spokenZone(f->presses)) + " " + lightOf(f->comfort))
                                           : Html(std::string("\u2013")));
    rows.push_back(std::move(row));
  }
  return charts(htmlTable("Each wearer", columns, rows,
                          "Joints: the largest added torque of both sides and all movements, of its natural moment. "
                          "All measures, and what other sizes would cost, are in population.csv. * beyond the 1st or "
                          "99th percentile of stature or mass of the people measured: the body is extrapolated."));
}

std::string drawingOf(const Study& s, const PopulationAnswer& a) {
  const Population& p = *s.population;
  std::string list;
  const auto say = [&](const std::string& text) { list += element("li", prose(text)); };
  say("People of ANSUR II (US Army 2012: 4082 men, 1986 women), who are not those of any other army or country. "
      "Stature "
      "and mass are lognormal together (Silverman and Lipscombe 2022), with the survey\u2019s means, spreads and "
      "correlation (0.47 men, 0.53 women); girths of chest, waist and hip and the inseam follow by regression with its "
      "residual spread. That residuals go together, as a wide waist and a wide chest do, is left out; all other "
      "measures "
      "of the body are the mean for stature and mass.");
  say(fmt::format(
      "Wearers are drawn evenly (a Sobol sequence, seed {}), not independently; the intervals are Wilson\u2019s "
      "of independent draws, for 95 %, and rather too wide. They are about the sample alone, and not about "
      "what a run is off by.",
      p.input.seed));
  if (p.contradicting > 0)
    say(fmt::format("{} draws whose measures go with no body were taken again.", p.contradicting));
  say(std::string("Can put it on: the run comes to its end, no cloth passes through cloth as it has been put on") +
      (a.judged_stretch ? ", and no fabric is stretched over the motion by more than its card states."
                        : ". The fabric states no limit of stretch (limit_strain, elongation), so none is held against "
                          "it."));
  if (p.sized())
    say("Sizes fix the girths that are graded, everything else of the garment follows the wearer as its draft does. A "
        "size that would have less ease than allowed is not tried.");
  else
    say("The garment is made to measure: what its case drafts on the body is drafted on each wearer.");
  say("Green: below " + percent(s.limits.green) +
      " of the natural moment of the wearer\u2019s own mass; a joint beyond "
      "which the garment touches nothing is green.");
  return element("ul", list, " class=\"assumptions\"");
}

}  // namespace

std::string populationHeadline(const Study& s, const Comparison& c, const std::vector<SidePicture>& pictures) {
  const PopulationAnswer& a = *c.population;
  std::string list;
  for (const PopulationShare& share : a.shares) {
    std::string what = share.what;
    what[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(what[0])));
    list += answerItem(what, element("span", prose(shareText(share)), " class=\"reason\""));
  }
  std::string pressed;
  for (const auto& [zone, count] : pressedOf(a))
    pressed += fmt::format("{}{} {}", pressed.empty() ? "" : ", ", zone, count);
  if (!pressed.empty()) list += answerItem("Presses most at", prose(pressed));
  if (s.population->sized()) {
    const std::vector<int> takers = takersOf(s, a);
    std::string sizes;
    for (std::size_t k = 0; k + 1 < takers.size(); ++k)
      sizes += fmt::format("{}{} {}", sizes.empty() ? "" : ", ", s.population->input.sizes[k].label, takers[k]);
    if (takers.back() > 0) sizes += fmt::format(", none {}", takers.back());
    list += answerItem("Sizes", prose(sizes));
  }
  std::string burdened;
  for (const std::size_t w : a.worst) {
    const Fitting& f = *a.wearers[w].taken();
    const std::string cost = !f.on() ? "cannot put it on"
                             : f.worst_part
                                 ? percentBeside(*f.worst_part, s.limits.green, s.limits.red) + ", " + f.worst_joint
                                 : "no natural moment known";
    burdened += (burdened.empty() ? "" : "<br>") + linkTo(s.variants[f.variant], s.population->wearers[w].name) +
                element("span", prose(" " + cost), " class=\"reason\"");
  }
  if (!burdened.empty()) list += answerItem("Burdens most", burdened);
  std::string words =
      element("p", prose(a.sentence), " class=\"sentence\"") + element("dl", list, " class=\"answers\"");
  std::string body = element("div", words, " class=\"words\"");
  const SidePicture* shown = nullptr;
  for (const std::size_t w : a.worst)
    for (const SidePicture& p : pictures)
      if (!shown && p.variant == a.wearers[w].taken()->variant) shown = &p;
  if (shown) body += figureOf({shown->png, shown->caption, ""});
  body +=
      element("p",
              prose(fmt::format("Of {}, drawn from the survey ANSUR II. Effort and comfort only: what protects enough "
                                "is not part of this study.",
                                peopleOf(*s.population))),
              " class=\"meaning\"");
  return element("section", body,
                 shown ? " class=\"headline pictured\" aria-label=\"The answer\""
                       : " class=\"headline\" aria-label=\"The answer\"");
}

std::string populationOf(const Study& s, const Comparison& c, const std::vector<SidePicture>& pictures) {
  std::string worst;
  for (const std::size_t w : c.population->worst)
    for (const SidePicture& p : pictures)
      if (p.variant == c.population->wearers[w].taken()->variant) worst += figureOf({p.png, p.caption, ""});
  std::string out = plotsOf(s, *c.population) + wearersTable(s, *c.population);
  if (!worst.empty())
    out += element("h3", "Those it burdens most, at the peak of each") + element("div", worst, " class=\"pictures\"");
  return out + folded("How the wearers were drawn, and what counts", drawingOf(s, *c.population));
}

}  // namespace gambeson::study
