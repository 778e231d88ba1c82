#pragma once
/// Everything that a run leaves beside its recording: the numbers, tables, pictures and the report.

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cases/runs/options.hpp"
#include "cases/wear/scene/scenario.hpp"
#include "core/io/recording.hpp"

namespace gambeson {

/// How long a window of a run took to compute.
struct WindowTimes {
  double start_s = 0, end_s = 0;  ///< of the window
  std::vector<double> phases_s;   ///< of each phase
  /// All numbers, as tables have them.
  std::vector<double> row() const;
};

/// What made the steps of a run.
struct DeviceFacts {
  DeviceKind kind = DeviceKind::cpu;
  std::string gpu, driver, runtime;  ///< of `cuda`: names and versions
  std::string kernels;               ///< what the device's kernels find, as a hash
  // Of steps on a device; of a resumed run's last part.
  long steps = 0, by_cpu = 0, repeated = 0;  ///< all; made by the CPU; passes repeated with more room
  std::map<std::string, long> reasons{};     ///< of those by the CPU
};

/// What the run knows of itself and the recording does not; DIR/run.json.
struct RunFacts {
  int threads = 0;
  std::string kernels, version;  ///< this program's version is written where it is empty
  double wall_s = 0;
  std::vector<std::pair<std::string, double>> phases_s;
  bool resumed = false;
  long searches = 0;                   ///< steps that looked for intersections
  double searched_steps_s = 0;         ///< their time, all phases
  std::vector<WindowTimes> windows{};  ///< those of a resumed run's last part
  std::string recording{};             ///< identity of the recording that the run wrote
  DeviceFacts device{};
};
void writeRunFacts(const RunFacts& facts, const std::filesystem::path& dir);
/// Throws InputError where DIR/run.json is damaged; a run that was killed left none: empty facts.
RunFacts readRunFacts(const std::filesystem::path& dir);

/// Reads DIR's recording and run.json; writes summary.json, the tables, the pictures and report.html. What the
/// recording holds alone decides the bytes, but for the object "timings".
void writeResults(const std::filesystem::path& dir);

/// A run, finished or not, as its folder holds it. No file that its case names is looked at.
struct RecordedRun {
  RecordingReader recording;
  std::unique_ptr<Scenario> scenario;
  RunFacts facts;
};
/// Throws InputError where DIR/case.json or the recording is missing or damaged, or where one of these and DIR/run.json
/// is of another run.
RecordedRun recordedRun(const std::filesystem::path& dir);

/// What `gambeson report` does with a results folder. Returns the exit status.
int reportResults(const ReportOptions& options);

/// Top of the colour bar of a field: the 99th percentile by area over the frames of the motion (all, where it has
/// none), rounded up to a number that reads well. 0 for a field at rest and for `plain`.
double fieldRange(const Scenario& scenario, const RecordingReader& recording, PictureField field);

/// What pictures that stand side by side have in common, so that the same colour is the same value and the same length
/// the same force.
struct PictureScale {
  double high = 0;    ///< top of the colour bar
  double most_N = 0;  ///< force of the longest arrow; 0: no arrows
  double size_m = 0;  ///< of what is shown, what arrows are measured by
  Vec3 box_m;         ///< that the picture frames, around the middle of what it shows
  /// The larger of both in everything.
  void include(const PictureScale& other);
};

/// Of one frame alone: colours up to the 99th percentile by area, rounded up as that of fieldRange.
PictureScale scaleOf(const Scenario& scenario, const RecordingReader& recording, int frame, const PictureCase& picture);

/// Draws one frame as `picture` asks (its time is not looked at). Colours begin at 0.
void renderFrame(const Scenario& scenario, const RecordingReader& recording, int frame, const PictureCase& picture,
                 const PictureScale& scale, const std::filesystem::path& png);

}  // namespace gambeson
