#pragma once
/// The parts of a study's page: all HTML; empty where there is nothing to show.

#include <string>
#include <vector>

#include "cases/study/compare.hpp"

namespace gambeson::study {

/// A cell of HTML, or a number.
struct Html {
  Html(std::string h) : html(std::move(h)) {}
  /// A count.
  Html(int n) : html(std::to_string(n)), number(true) {}
  Html(double v, int digits = 3);
  Html(const std::optional<double>& v, int digits = 3);
  /// HTML that stands where numbers do.
  static Html aligned(std::string h);
  /// The first cell of a row that heads those below it.
  static Html heading(std::string h);
  std::string html;
  bool number = false, heads = false;
};

/// As tableOf, with cells that are HTML; the first names the row.
std::string htmlTable(const std::string& title, const std::vector<std::string>& columns,
                      const std::vector<std::vector<Html>>& rows, const std::string& caption);
std::string charts(const std::string& body);
/// Shown when it is asked for.
std::string folded(const std::string& summary, const std::string& body);
std::string lightOf(Light light);
std::string lightOf(const std::string& light);
/// The light of a number, as far as the run that it is of is trusted.
std::string lightOf(Light by_number, const Trust& trust);
/// The light of a part of a natural moment, as far as the run that it is of is trusted.
std::string lightOf(const Study& study, const Trust& trust, const std::optional<double>& part);
std::string percent(const std::optional<double>& part);
std::string linkTo(const Variant& variant, const std::string& text);

/// A run knows the natural moment of a joint.
bool anyNatural(const Comparison& c);

/// What "thickness x 0.5" means; empty where no axis is one of factors.
std::string multiplesOf(const Study& study);

// page_cards.cpp: plain sentences
/// What follows for the garment, as far as the study goes.
std::string changesOf(const Study& study, const Comparison& c);
/// Where the answer costs how much, the most first; empty where there is one setting.
std::string whereOf(const Study& study, const Comparison& c);
/// Whether finer cells gave less or more, where all pairs agree; completes a paragraph.
std::string trendOf(const Comparison& c);
/// What would make the answer surer: of the torque whose error bar is widest, and of the fabric where it is stretched
/// further than it is meant for.
std::string measuresOf(const Study& study, const Comparison& c);
// page_population.cpp
std::string populationHeadline(const Study& study, const Comparison& c, const std::vector<SidePicture>& pictures);
std::string populationOf(const Study& study, const Comparison& c, const std::vector<SidePicture>& pictures);
// page_pay.cpp
std::string payOf(const Study& study, const Comparison& c);
// page_torque.cpp
std::string curvesOf(const Study& study, const Comparison& c);
std::string lawsOf(const Study& study, const Comparison& c);
std::string elasticitiesOf(const Comparison& c);
std::string standingOf(const Study& study, const Comparison& c);
std::string meshesOf(const Comparison& c);
// page_cloth.cpp
std::string forcesOf(const Study& study, const Comparison& c);
/// What kinds of cloth the variants are made of, where they differ.
std::string kindsOf(const Study& study, const Comparison& c);
std::string thicknessPage(const Study& study, const Comparison& c);
std::string clothOf(const Study& study, const Comparison& c);
// page_sure.cpp
std::string sureOf(const Study& study, const Comparison& c);
/// " ± 0.31", of a number of a variant; empty where no bar is known.
std::string plusMinus(const Study& study, const Comparison& c, std::size_t variant, const Headline& what);
// page_map.cpp
/// The thickness map that was found; empty where none was searched.
std::string mapOf(const Study& study);
// page_measured.cpp
/// Ours against torques of garments that were measured or are told; empty where none corresponds.
std::string measuredOf(const Study& study, const Comparison& c);
// page_trust.cpp
std::string checksOf(const Study& study, const Comparison& c);
std::string leftOutOf(const Study& study, const Comparison& c);

}  // namespace gambeson::study
