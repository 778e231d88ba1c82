/// Detail of page_parts.hpp: ours against torques of garments that were measured or are told.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/report/html.hpp"
#include "analysis/ticks.hpp"
#include "cases/study/page_parts.hpp"
#include "cases/wear/case/factors.hpp"
#include "cases/wear/case/garments/kind.hpp"
#include "cases/wear/case/motions/kind.hpp"
#include "human/files/data.hpp"

namespace gambeson::study {
namespace {

using Json = nlohmann::json;

bool has(const Json& words, const std::string& word) {
  return std::any_of(words.begin(), words.end(), [&](const Json& w) { return w == word; });
}

/// The joint "hip_flexion_left" is of the hip.
bool isOf(const Json& parts, const std::string& joint) {
  return std::any_of(parts.begin(), parts.end(),
                     [&](const Json& part) { return joint.starts_with(part.get<std::string>() + "_"); });
}

/// The largest torque of a run among the joints of an entry; null where garment, motion or joints are others.
const JointNumbers* corresponding(const Json& entry, double light_below_kg_per_m2, const Case& written,
                                  const RunNumbers& run) {
  if (!written.human || !run.good || !run.played) return nullptr;
  if (!has(entry.at("motions"), kindOf(*written.human).word)) return nullptr;
  const Case c = withFactors(written);
  bool garment = false;
  for (const GarmentCase& g : c.garments)
    garment = garment || (has(entry.at("garments"), kindOf(g).word) &&
                          (fabricOf(c, g).surfaceDensity() >= light_below_kg_per_m2) == entry.at("heavy").get<bool>());
  const JointNumbers* largest = nullptr;
  for (const JointNumbers& j : run.joints)
    if (garment && !j.prismatic && j.applies() && isOf(entry.at("joints"), j.name) &&
        (!largest || std::abs(j.peak_Nm) > std::abs(largest->peak_Nm)))
      largest = &j;
  return largest;
}

/// What it says that of our variants some lie within a range and others beside it.
std::string whyOther(const std::vector<double>& ours_Nm, double low_Nm, double high_Nm) {
  const auto count = [&](auto beside) { return std::count_if(ours_Nm.begin(), ours_Nm.end(), beside); };
  const auto above = count([&](double x) { return x > high_Nm; }), below = count([&](double x) { return x < low_Nm; });
  const auto all = static_cast<std::ptrdiff_t>(ours_Nm.size()), within = all - above - below;
  std::string text;
  const auto say = [&](std::ptrdiff_t n, const char* where) {
    if (n == 0) return;
    const std::string who = n < all ? fmt::format("{} of {}", n, all) : all == 1 ? "Ours" : all == 2 ? "Both" : "All";
    text += fmt::format("{}{} {} {}", text.empty() ? "" : ", ", who, n == 1 ? "lies" : "lie", where);
  };
  say(within, "within it");
  say(above, "above it");
  say(below, "below it");
  text += ".";
  if (within > 0) text += " To lie within it confirms no more than the order of magnitude.";
  if (within < all)
    text +=
        " Fabric, cut and fit behind the number are not known; ours has a body that does not give way and a motion "
        "that does not yield to the garment, which both add, and coarse cells add too: see the error bar.";
  return text;
}

}  // namespace

std::string measuredOf(const Study& s, const Comparison& c) {
  const Json facts = Json::parse(data::garment_measurements);
  const double light_below = facts.at("light_below_kg_per_m2").get<double>();
  std::vector<std::vector<Html>> rows;
  for (const Json& entry : facts.at("torques")) {
    std::string list;
    std::vector<double> ours_Nm;
    for (std::size_t i = 0; i < s.variants.size(); ++i) {
      const auto* definition = std::get_if<Case>(&s.variants[i].definition);
      const JointNumbers* j =
          definition && s.variants[i].grid ? corresponding(entry, light_below, *definition, c.runs[i]) : nullptr;
      if (!j) continue;
      ours_Nm.push_back(std::abs(j->peak_Nm));
      list += html::element("li", html::prose(fmt::format("{} Nm", formatNumber(ours_Nm.back()))) + "<br>" +
                                      html::escape(fmt::format("{}, {}", s.variants[i].label, j->label)));
    }
    if (ours_Nm.empty()) continue;
    const double low = entry.at("low_Nm").get<double>(), high = entry.at("high_Nm").get<double>();
    const std::string range = low > 0 ? fmt::format("{} to {}", formatNumber(low), formatNumber(high))
                                      : fmt::format("up to {}", formatNumber(high));
    const std::string word = entry.at("class").get<std::string>();
    const auto sentences = [](const std::string& text) {
      return html::element("div", html::escape(text), " class=\"sentences\"");
    };
    rows.push_back({html::escape(entry.at("what").get<std::string>()), Html::aligned(html::escape(range)),
                    html::element("ul", list, " class=\"plain\""),
                    sentences(fmt::format("{}, {} confidence: {}", word, entry.at("confidence").get<std::string>(),
                                          facts.at("classes").at(word).get<std::string>())),
                    sentences(whyOther(ours_Nm, low, high))});
  }
  if (rows.empty()) return "";
  return charts(htmlTable(
      "Measured garments and ours",
      {"what was measured", "there [Nm]", "ours, peak", "class of evidence", "why they differ"}, rows,
      fmt::format("Heavy: from {:g} kg/m\u00b2 on ({}).", light_below, facts.at("light_reason").get<std::string>())));
}

}  // namespace gambeson::study
