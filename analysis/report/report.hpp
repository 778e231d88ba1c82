#pragma once
/// One self-contained page about one run: what the garment costs its wearer, first in a sentence, then in numbers,
/// plots and pictures, then why to trust it. The page asks the network for nothing and is whole without its scripts.
///
/// Comparing several runs is a page of its own that takes a list of these inputs; nothing here assumes that there is
/// one.

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "analysis/trust.hpp"
#include "analysis/viewer/viewer.hpp"

namespace gambeson {

/// A text, or a number that the page rounds to `digits` significant digits.
struct TableCell {
  TableCell(std::string t) : text(std::move(t)) {}
  TableCell(const char* t) : text(t) {}
  TableCell(double v, int digits = 3);
  /// A traffic light: "green", "amber" or "red".
  static TableCell signal(const std::string& light);
  std::string text;
  bool number = false;
  std::string light{};
};

/// What one joint pays. Absent values show as "not known".
struct JointSummary {
  std::string joint;   ///< "hip", "knee": as in a sentence
  std::string side;    ///< "left", "right", or empty where the joint has none
  double peak_Nm = 0;  ///< signed; the page shows its size and says where the sign matters
  double peak_time_s = 0;
  std::string cause;  ///< completes "during ...": "hip flexion (swing)"; empty where not known
  double rms_Nm = 0;
  std::optional<double> natural_percent;     ///< of the natural moment of this joint in this task, at its peak
  std::optional<double> natural_Nm{};        ///< that moment, of this wearer
  std::optional<double> drag_percent;        ///< the part of the peak that air drag on the cloth has
  std::optional<double> friction_percent{};  ///< and the part that the friction of contact has
  std::string light{};                       ///< of natural_percent, as shownLight has it; empty where not judged
};

enum class Tone { left, right, third, fourth };  ///< colours; left and right are the same in every plot

/// Values over time. A value that is not finite interrupts the line, and the page says so.
struct Series {
  std::string name, unit;
  std::vector<double> time_s, values;
  Tone tone = Tone::third;
  bool gaps = false;  ///< a value that is not a number says that there is nothing at that time, and no notice is given
};

/// A vertical line: "left heel strike".
struct TimeMark {
  double time_s = 0;
  std::string label;
};

/// All series in one unit.
struct Plot {
  std::string title, caption;
  std::vector<Series> series;
  std::vector<TimeMark> marks;
  bool mark_peak = true;        ///< the largest magnitude of all series, or of the one named
  std::string mark_of{};        ///< the name of a series; empty, or of none that is shown: of all
  double mark_from_s = -1e300;  ///< from here on: what comes before is shaded, shown but not judged
  std::string peak_note{};      ///< completes the mark: "against the motion"
};

struct Bar {
  std::string label;
  double value = 0;
};

struct BarChart {
  std::string title, unit, caption;
  std::vector<Bar> bars;
};

/// The first column names the row. Units stand in the column names: "peak [N]".
struct Table {
  std::string title, caption;
  std::vector<std::string> columns;
  std::vector<std::vector<TableCell>> rows;
};

/// A PNG: a file, or its bytes. A picture that cannot be read shows as a message in its place.
struct Picture {
  std::variant<std::filesystem::path, std::string> png;
  std::string caption;
  std::string alt;  ///< what one sees, for those who do not
};

/// Holds where |value| <= limit; NaN fails.
struct AuditCheck {
  std::string name;
  double value = 0, limit = 0;
  std::string unit;
  std::string meaning;  ///< what is compared with what
  std::string wrong{};  ///< where it fails, what that is in plain words; completes a sentence
  bool spoils = false;  ///< where it fails, none of the numbers can be used
  bool holds() const { return value <= limit && -value <= limit; }
};

struct ReportInput {
  std::string title;                  ///< "Shorts, walking at natural speed"
  std::string description;            ///< who wears what and does what, in one or two sentences
  std::string task;                   ///< names the reference: "walking at natural speed"; empty where there is none
  std::vector<std::string> warnings;  ///< shown at the top: "The run stopped at 1.2 s: ..."
  bool played = true;  ///< what the run is to judge was played; else no light is green, and a warning says why
  std::string no_share = "this task has no reference moment";  ///< why a share of the natural moment is not known
  std::vector<std::string> notes;    ///< in a milder tone, with the headline: what bears on it
  std::vector<std::string> found;    ///< folded below the headline: what was found and made on the way; those with the
                                     ///< same words before their first colon stand under these
  std::vector<JointSummary> joints;  ///< the headline is the largest |peak|
  std::string outcome;               ///< the headline of a run without joints, one or two sentences
  std::vector<Plot> torques;
  std::vector<BarChart> contact_charts;
  std::vector<Table> contact_tables, stress_tables, support_tables;
  std::vector<Plot> contact_plots;
  std::string comfort;  ///< in a sentence; empty where nothing is judged
  std::vector<Table> comfort_tables;
  std::vector<Picture> comfort_pictures;
  std::vector<Plot> collision_plots;  ///< what met what, window by window
  std::vector<Table> collision_tables;
  std::vector<Picture> pictures;  ///< the first stands beside the headline
  std::vector<ViewerRun> viewer;  ///< one run to look around in, or none
  std::vector<AuditCheck> audit;
  std::vector<Stretch> stretch;  ///< of the fabrics, against what they are meant for
  std::vector<std::string> assumptions;
  std::vector<std::pair<std::string, std::string>> facts;  ///< "Smallest time step", "12.3 µs (governed by bending)"
  std::vector<Table> fact_tables;                          ///< timings per phase
  std::vector<Plot> fact_plots;                            ///< the same over time
};

/// What its lights stand on.
Trust trustOf(const ReportInput& input);

/// The joint with the largest |peak|; null where no peak is finite.
const JointSummary* highestJoint(const ReportInput& input);

/// "Peak added hip torque: 1.83 Nm, right side, at 1.24 s, during hip flexion (swing); 3.3 % of the natural hip
/// moment."
std::string headlineOf(const ReportInput& input);

/// The whole page, UTF-8.
std::string formatReport(const ReportInput& input);

/// Writes the page so that it is whole or absent; throws RunError.
void writeReport(const ReportInput& input, const std::filesystem::path& html);

}  // namespace gambeson
