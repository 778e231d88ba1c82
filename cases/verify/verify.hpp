#pragma once
/// Published references against this program: what a reference is, how it is read, run, judged and shown.
///
/// A reference is one file tests/verify/<id>.json: runs (a case, with values set in it), and checks, which compare
/// numbers that the runs leave (summary.json, tables) with published ones. The runs are processes of the command
/// itself: what is verified is what the user gets.

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cases/input/json.hpp"

namespace gambeson::verify {

/// One run: a case file, or a case written in the reference, with values set in it.
struct Run {
  std::string name;
  std::filesystem::path file;                                ///< empty: `inline_case`
  JsonNode inline_case;                                      ///< null: the reference's own case
  std::vector<std::pair<std::string, std::string>> changes;  ///< path, value as JSON
  double limit_s = 1800;                                     ///< of wall time; a run that takes longer has failed
};

/// One number of a run. For several runs (seeds, say) their median, mean, least or largest.
struct Quantity {
  enum class Of { median, mean, least, largest };
  std::vector<std::string> runs;
  Of of = Of::median;
  std::string summary;  ///< path of a number of summary.json; or else
  std::string column;   ///< of a table
  std::string table = "path.csv";
  std::string along;         ///< the column that `at` is a value of; empty: the first
  std::optional<double> at;  ///< linear between rows; absent: the last row
  double scale = 1, offset = 0;
  double convert(double x) const { return scale * x + offset; }
};

/// A course in time of a run: columns of a table whose first column is the time, joined row by row.
struct RunCourse {
  enum class Of {
    sum,
    mean,
    largest,
    magnitude  ///< root of the sum of squares: of components, or of one column without its sign
  };
  std::string run, table = "torques.csv";
  std::vector<std::string> columns;
  Of of = Of::sum;
  double scale = 1;
  std::optional<double> from_s, to_s;  ///< instead of the check's
};

/// A column of a run's table beside a column of the reference's table.
struct Pair {
  std::string column, reference;
  double scale = 1, offset = 0;
};

/// Compares; what the members mean depends on the kind.
struct Check {
  enum class Kind { value, course, curve, table, rate, waves, wrinkles };
  Kind kind = Kind::value;
  /// Of a list of claims: which one, and how much hangs on it. Only what must hold is gated.
  enum class Priority { none, must, should, nice };
  std::string item;
  Priority priority = Priority::none;
  std::string quantity, unit;  ///< what is measured, in words
  std::string note;            ///< on the page: where the tolerance comes from
  std::string why;             ///< of what is reported only: why; empty: as the reference says
  bool gated = true;
  /// Whether a deviation is a failure: nothing of a list of claims but what must hold.
  bool gates() const { return gated && (priority == Priority::none || priority == Priority::must); }

  // value: (of - minus) / over
  Quantity of;
  std::optional<Quantity> minus, over;
  std::optional<double> reference, relative, absolute, at_least, at_most;
  std::optional<double> period;  ///< the difference is taken to the nearest whole number of these

  // course: of `first` and `second` at the times of `first` from `from_s` to `to_s`, `second` shift_s later
  enum class Course {
    correlation,    ///< Pearson's
    difference,     ///< RMS of their difference over the peak of `first`
    rank,           ///< Spearman's, of `first` with time
    peak,           ///< max |first|
    peak_ratio,     ///< max |first| / max |second|
    peak_time,      ///< of max |first|, of max second the time later: first - second
    mean,           ///< of `first`
    mean_ratio,     ///< mean of `first` / mean of `second`
    growth,         ///< |first| at to_s / |first| at from_s
    last_ratio,     ///< |first| / |second| at to_s
    other_at_peak,  ///< |second| / |first| where |first| is largest
    greater_share,  ///< part of the times at which first > second
    linearity,      ///< R^2 of the straight line in time that fits `first` best
    half_time,      ///< the last time at which |first| is half its peak or more: first - second
  };
  Course course = Course::peak;
  std::optional<RunCourse> first, second;
  double shift_s = 0, from_s = 0, to_s = 0;

  // curve and table
  std::string run;
  std::vector<std::string> also;  ///< other runs, reported: mesh convergence
  std::string file = "path.csv";
  Pair x, y;
  double bound = 0;           ///< of the largest deviation over the column's largest value
  bool interpolated = false;  ///< table: between rows of the run, else each row must be hit
  struct Reported {
    std::string column;
    double from = 0, to = 0;
  };
  std::optional<Reported> reported;  ///< rows of the reference that are shown, not gated

  // rate: the order in h of |u - exact|^power; `of` without a run is taken from each of `runs`
  std::vector<std::string> runs;
  std::vector<double> sizes;
  std::optional<double> exact;  ///< absent: from three runs of sizes in geometric progression
  double power = 1;

  // waves: crests of y over x
  double prominence = 0.1;  ///< of a crest, as a part of the largest less the least value
  bool closed = false;      ///< the profile closes on itself: crests are counted; else their mean distance is measured
  std::optional<Reported> where;  ///< only rows of the run's table in this range
  /// Instead of `run`: the median over `runs` (seeds); against that over `reference_runs` where there are some.
  std::vector<std::string> reference_runs;
  std::optional<Pair> with;  ///< second component: the profile is sqrt(y^2 + with^2), a radius

  // wrinkles of `height` over a grid of x and y
  enum class Measure { wavelength, angle };
  Pair height;
  Measure measure = Measure::wavelength;
  double margin = 0.15;  ///< part of each extent that is left out at both ends
};

/// The published numbers that curve and table checks refer to.
struct ReferenceTable {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
};

struct Reference {
  std::filesystem::path file;
  std::string id, title, heading, source, doc;
  std::string why;  ///< why checks are reported only that do not say it themselves
  bool quick = false;
  bool on_demand = false;  ///< runs only where a filter names it: it takes an hour
  JsonNode inline_case;
  std::filesystem::path case_file;
  ReferenceTable table;
  std::vector<Run> runs;
  std::vector<Check> checks;
};

/// Throws InputError: file, line, key.
Reference readReference(const std::filesystem::path& file);

/// Table of numbers as a run leaves it; cells that are not numbers are NaN.
struct Numbers {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
  /// Throws RunError with the columns that there are.
  std::size_t find(const std::string& column) const;
};
Numbers parseCsv(std::string_view text, const std::string& name);

/// What became of a run.
struct Outcome {
  std::string why;  ///< empty: it succeeded
  double seconds = 0;
  std::filesystem::path folder;
  bool kept = false;  ///< an earlier run was taken as it is
};

/// The numbers of the runs of one reference. Throw RunError where there is no such number.
class RunNumbers {
 public:
  virtual ~RunNumbers() = default;
  virtual double summary(const std::string& run, const std::string& path) const = 0;
  virtual const Numbers& table(const std::string& run, const std::string& file) const = 0;
};

/// One line of verify.json. Absent: there is no number, `note` says why.
struct Result {
  std::string id, source, quantity, unit;
  std::string item, priority;  ///< of a list of claims, or empty
  std::optional<double> measured, reference, tolerance;
  bool passed = false, gated = true;
  bool other_run = false;  ///< of a run named in `also`: the page shows it as convergence
  double seconds = 0;
  std::string note, why;
};

/// Points of a check for the page: measured lines and reference points.
struct Shown {
  struct Line {
    std::string name;
    std::vector<double> x, y;
  };
  std::string title, x_name, y_name;
  std::vector<Line> measured;
  Line reference;
  bool logarithmic = false;
  /// Row by row: the reference's x and y, what was measured there, the deviation as a part of the largest value.
  struct Row {
    double x = 0, y = 0, measured_x = 0, measured_y = 0, deviation = 0;
    bool gated = true;
  };
  std::vector<Row> rows;
};

/// Results of one check: the gated run first, then the others.
struct Judged {
  std::vector<Result> results;
  std::optional<Shown> shown;
  /// Mesh convergence: run and measured value (or deviation).
  std::vector<std::pair<std::string, double>> convergence;
};

/// Never throws for what a run left: a number that is missing fails with its reason.
Judged judge(const Reference& reference, const Check& check, const RunNumbers& numbers);

/// Distance of a point from a polyline [units of the axes after division by sx, sy], and where it is met.
struct Nearest {
  double distance = 0, x = 0, y = 0;
};
Nearest nearestOnPolyline(const std::vector<double>& x, const std::vector<double>& y, double px, double py, double sx,
                          double sy);

/// Places of the crests of y whose prominence is at least `prominence` (height above the higher of the two saddles
/// that part it from higher ground or from the ends). Closed: the last point is followed by the first.
std::vector<std::size_t> crests(const std::vector<double>& y, double prominence, bool closed);

/// Straight wrinkles over a rectangular grid.
struct Wrinkles {
  double angle_deg = 0;      ///< of the crests from the x axis, in [0, 180)
  double wavelength = 0;     ///< across the crests
  std::vector<double> x, w;  ///< the middle line that the crests were counted on
};
/// Angle from the gradients' mean square tensor (its first principal direction is across the crests); wavelength from
/// the mean distance of the crests along the middle line y = const, times sin(angle). Throws RunError where the points
/// are no grid or the line has less than three crests.
Wrinkles wrinklesOf(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& w,
                    double margin, double prominence);

/// A reference with its runs done.
struct Verified {
  Reference reference;
  std::vector<Outcome> outcomes;  ///< of its runs
  std::vector<Judged> judged;     ///< of its checks
  double seconds = 0;             ///< of its runs together
  std::vector<Result> results() const;
  bool passed() const;
  /// Whether anything could fail: runs apart, a reference that only reports passes whatever it measures.
  bool gates() const;
};

/// Judges all checks; runs that failed are failures of their own.
Verified assess(const Reference& reference, const std::vector<Outcome>& outcomes);

struct Options {
  std::filesystem::path dir = "tests/verify", out = "results/verify";
  std::filesystem::path results;     ///< where runs are looked for that need not be repeated; empty: nowhere
  std::vector<std::string> filters;  ///< shell patterns of ids; empty: all
  int jobs = 0;                      ///< 0: one for each core
  bool quick = false;
  std::string binary = "/proc/self/exe";  ///< the command that runs a case
};

/// Identity (caseIdentity) of a run's case with its values set; nothing for a case of structures, or one that cannot be
/// read (its run says why).
std::optional<std::string> caseHash(const Reference& reference, const Run& run);
/// Wall time of the run that `folder` holds, where it is of that case and came to its planned end.
std::optional<double> completeRun(const std::filesystem::path& folder, const std::string& hash);
/// Whether `folder` holds the recording of a run of that case.
bool interruptedRun(const std::filesystem::path& folder, const std::optional<std::string>& hash);

/// References of the folder that the options choose, by id. Throws InputError: no such folder, nothing chosen.
std::vector<Reference> chooseReferences(const Options& options);

/// Runs and writes verify.json and verify.html. Exit status: 0 all passed, 1 some failed.
int runVerify(const Options& options, std::ostream& out);

std::string formatJson(const std::vector<Verified>& all);
/// A page beside this one, and its title.
struct PageLink {
  std::string file, title;
};
std::string formatPage(const std::vector<Verified>& all, const std::string& command, double wall_s,
                       const std::vector<PageLink>& pages = {});

}  // namespace gambeson::verify
