#include "cases/wear/results/check_words.hpp"

#include <fmt/format.h>

#include <cmath>

#include "analysis/ticks.hpp"

namespace gambeson {
namespace {

/// A share of all works: above 100 % as a multiple, with what its sign means.
CheckWords energyWords(double value, double limit, int digits) {
  const std::string allowed = fmt::format(" (allowed: {} % either way)", formatNumber(limit, digits));
  const char* sign =
      value < 0 ? "lost energy that no work on it explains" : "gained energy that no work on it explains";
  if (!std::isfinite(value))
    return {"the energy of the cloth is no number", "The motion has broken down: none of its numbers can be used.",
            true};
  if (std::abs(value) > 100)
    return {
        fmt::format("the cloth {}, {} times the work of all forces together{}", sign,
                    formatNumber(std::abs(value) / 100, 2), allowed),
        "Either next to no work was done, as on cloth that stands still, or forces are wrong: what changes over the "
        "motion cannot be relied on. The table of checks says how much energy that is.",
        false};
  return {fmt::format("the cloth {}, {} % of the work of all forces{}", sign, formatNumber(std::abs(value), digits),
                      allowed),
          "Averages of the torques over the motion may be off by about this share.", false};
}

}  // namespace

CheckWords checkWords(const std::string& check, double value, double limit, const std::string& unit) {
  // As many digits as tell the two apart.
  int digits = 2;
  while (digits < 5 && value != limit && formatNumber(value, digits) == formatNumber(limit, digits)) ++digits;
  const auto withUnit = [&](double x) { return formatNumber(x, digits) + (unit.empty() ? "" : " ") + unit; };
  const std::string much = withUnit(value) + (limit > 0 ? " (allowed: " + withUnit(limit) + ")" : "");
  const std::string count = fmt::format("{:.0f}", value);
  if (check == "Momentum")
    return {"the forces on cloth and body do not balance",
            "The body does not receive what the cloth gives: the torques are not those of this cloth. Do not use them.",
            true};
  if (check == "Energy") return energyWords(value, limit, digits);
  if (check == "Integrator")
    return {fmt::format("the integrator made {} of the work of all forces", much),
            "Averages of the torques over the motion may be off by about this share; shorter steps make less.", false};
  if (check == "Penetration")
    return {fmt::format("contact points of the cloth lie up to {} inside the body", much),
            "Contact gave way there: pressing forces, and torques with them, are rather too small.", false};
  if (check == "Penetration between samples")
    return {fmt::format("between its contact points the cloth dips up to {} into the skin", much),
            "Forces act at the contact points, which stay outside, so that no force is missing; but the cloth lies "
            "this much too near to the body, which counts where it is as much as the cloth is thick. Finer cells or "
            "more contact points in each (\u201csamples_per_cell\u201d of the garment) lessen it.",
            false};
  if (check == "Seams")
    return {fmt::format("seams gape by up to {} of a cell", much),
            "Cloth is not held together there: what it bears across the seam is too small. Contact that is not solved "
            "parts them, or cloth too tight for its wearer.",
            false};
  if (check == "Contact solver")
    return {fmt::format("contact forces are not solved to the tolerance in {} of the steps", much),
            "Forces of those steps are approximate. Peaks that fall among them are less sure than root mean squares; "
            "the energy check bounds what it does over the motion. contact.newton may solve them.",
            false};
  if (check == "Intersections")
    return {fmt::format("cloth passes through cloth at {} places at the end", count),
            "Garments bear on each other in the wrong order there: forces between them are wrong.", true};
  if (check == "Movement")
    return {fmt::format("cloth goes up to {} in one step", much),
            "Contacts may have been missed on the way: forces may be wrong anywhere.", true};
  if (check == "Pinched")
    return {fmt::format("{} times a point of the cloth was squeezed between two bodies and let through", count),
            "Forces at those places and times are not known; elsewhere they are.", false};
  if (check == "Pressure on flesh")
    return {fmt::format("the cloth presses on the body with up to {}", much),
            "Cloth is wedged there, as in a fold between two parts of the body. Flesh would have given way, and the "
            "body here does not: torques and pressures of that moment are far too large, and peaks that fall into it "
            "are none. A garment with more room, or that folds elsewhere, avoids it.",
            false};
  if (check == "Strain limit")
    return {fmt::format("threads stretch more than their limit in {} of the steps", much),
            "The cloth is softer than the case says: torques are rather too small.", false};
  if (check == "Law range")
    return {
        fmt::format("{} of the cloth is strained beyond the range of its law", withUnit(value)),
        "Stress there is a guess: the energy goes on as stiff as at the table's end. A table of a wider range, or a "
        "looser garment, settles it.",
        false};
  if (check.starts_with("Stretch along the ")) {
    const std::string who = check.substr(check.find(", ") + 2);
    return {fmt::format("{} is stretched by {} along its {}", who, much, check.substr(18, 4)),
            "It may not come back, or tear: the garment is too tight for this fabric.", false};
  }
  if (check.starts_with("Sinking"))
    return {fmt::format("an edge on springs slides {} along the body", much),
            "The garment hangs lower than it was made to: the torques are those of a garment that slipped.", false};
  if (check.starts_with("Slipping"))
    return {fmt::format("{} slips down the body by {}",
                        check.size() > 10 ? check.substr(10) : std::string("the garment"), much),
            "It is not worn as it was made to: the torques are those of a garment that falls off. Hold it by supports, "
            "or cut it closer.",
            true};
  if (check.starts_with("Layer order, "))
    return {
        fmt::format("{}: {} of the upper garment lies inside of the lower one", check.substr(13), much),
        "The garments are worn in the wrong order there and cross nowhere, so nothing brings them out: the torques are "
        "those of another outfit. Put them on together (dressing.projecting without layer_by_layer), or place the "
        "upper one higher.",
        true};
  if (check.starts_with("Repeatability, shape"))
    return {fmt::format("the second stride is not like the first (correlation {}, 1 for the same course; allowed: at "
                        "least {})",
                        formatNumber(1 - value, 2), formatNumber(1 - limit, 2)),
            "The garment has not found its place yet: peaks depend on how it was put on.", false};
  if (check.starts_with("Repeatability, size"))
    return {fmt::format("the second stride differs from the first by {}", much),
            "The garment has not found its place yet: peaks are uncertain by about this much.", false};
  return {fmt::format("the check \"{}\" fails", check), "See the run\u2019s own report.", true};
}

std::string notMet(const std::string& check, double value, double limit, const std::string& unit) {
  return fmt::format("check not met: {} {:.4g}{}{} (allowed {:.4g}): {}", check, value, unit.empty() ? "" : " ", unit,
                     limit, checkWords(check, value, limit, unit).means);
}

}  // namespace gambeson
