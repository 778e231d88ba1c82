#include "cases/cell/run.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <mutex>

#include "cases/cell/checks.hpp"
#include "cases/cell/picture.hpp"
#include "cases/cell/results.hpp"
#include "cases/input/message.hpp"
#include "cases/input/overrides.hpp"
#include "cases/input/wrong_entry.hpp"
#include "cases/runs/disk_space.hpp"
#include "cases/runs/progress.hpp"
#include "cases/runs/recorded_case.hpp"
#include "cases/runs/results_folder.hpp"
#include "cases/runs/stop_message.hpp"
#include "cases/runs/temporary_folder.hpp"
#include "core/error.hpp"
#include "core/io/own_file.hpp"
#include "core/math/parallel.hpp"

namespace gambeson {
namespace {

std::unique_ptr<const CellEngine> engineOf(const CellCase& c) {
  try {
    return makeEngine(c);
  } catch (const InputError& e) {
    sayInCase(c.file, c.overrides, e);
  }
}

/// Says how much the recording is going to take where that is much.
void foretell(const CellCase& c, const CellEngine& engine, const std::filesystem::path& out) {
  double shapes = 1, rows = 0;
  for (const PathCase& path : c.paths) {
    const double count = static_cast<double>(partsOf(path).size());
    rows += count;
    shapes += c.output.shapes == CellShapesKept::all ? count : 1;
  }
  const double bytes = 4 * 6 * static_cast<double>(engine.surface().direction.size()) * shapes +
                       16 * static_cast<double>(curveColumns(c).size()) * rows;
  if (const std::string note = sizeNote(bytes, freeBytes(out)); !note.empty()) sayNote(note);
}

/// The units that the recording lacks, side by side; recorded in their order, each as soon as all before it are.
class Units {
 public:
  Units(const CellCase& c, const CellEngine& engine, CellRecorder& recorder)
      : c_(c), engine_(engine), recorder_(recorder), first_(recorder.units()), walked_(c.paths.size()) {
    std::size_t done = 0, all = 0;
    for (std::size_t k = 0; k < c.paths.size(); ++k) {
      const std::size_t rows = partsOf(c.paths[k]).size();
      all += rows;
      if (static_cast<int>(k) + 1 < first_) done += rows;
    }
    rows_ = done;
    progress_.emplace(static_cast<double>(std::max<std::size_t>(all, 1)), static_cast<double>(done), stderr, " rows");
  }

  void run() {
    const int units = static_cast<int>(c_.paths.size()) + 1;
    forAllUneven(Each::much, units - first_, [&](int k) { make(first_ + k); });
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void make(int unit) {
    try {
      if (unit == 0) {
        RestStiffness rest = restStiffness(engine_);
        const std::lock_guard<std::mutex> guard(lock_);
        rest_ = std::move(rest);
        record();
        return;
      }
      const auto path = static_cast<std::size_t>(unit) - 1;
      WalkedPath walked = walk(engine_, c_.paths[path], c_.output.shapes, [&] {
        const std::lock_guard<std::mutex> guard(lock_);
        progress_->update(static_cast<double>(++rows_), "loading");
      });
      const std::lock_guard<std::mutex> guard(lock_);
      walked_[path] = std::move(walked);
      record();
    } catch (...) {
      const std::lock_guard<std::mutex> guard(lock_);
      if (!failure_) failure_ = std::current_exception();
    }
  }

  void record() {
    if (recorder_.units() == 0 && rest_) recorder_.add(*rest_);
    while (recorder_.units() > 0 && recorder_.units() <= static_cast<int>(walked_.size())) {
      std::optional<WalkedPath>& next = walked_[static_cast<std::size_t>(recorder_.units()) - 1];
      if (!next) return;
      recorder_.add(*next);
      next.reset();
    }
  }

  const CellCase& c_;
  const CellEngine& engine_;
  CellRecorder& recorder_;
  int first_;
  std::optional<RestStiffness> rest_;
  std::vector<std::optional<WalkedPath>> walked_;
  std::size_t rows_ = 0;
  std::optional<Progress> progress_;
  std::mutex lock_;
  std::exception_ptr failure_;
};

/// Tables, pictures and page of a folder. Throws RunError where a load failed, a check leaves no number, or a picture
/// could not be drawn.
void leaveResults(const std::filesystem::path& out, const CellRunFacts& facts) {
  writeCellRunFacts(facts, out);
  const RecordedCell cell(out);
  writeCurves(cell, out / "curves.csv");
  const std::vector<AuditCheck> checks = cellChecks(cell);
  writeCellSummary(cell, checks, facts, out / "summary.json");
  std::vector<std::string> failures;
  const std::vector<Picture> pictures = takeCellPictures(cell, out / "snapshots", failures);
  writeCellPage(cell, checks, facts, pictures, out / "report.html");
  const std::string where = fmt::format("\nThe report is in {}", out.string());
  for (std::size_t k = 0; k < cell.paths().size(); ++k)
    if (const RecordedPath& path = cell.paths()[k]; !path.reached)
      throw RunError(fmt::format("the load {} ends {}{}", cell.definition().paths[k].name, path.why, where));
  for (const AuditCheck& k : checks) {
    if (!k.holds() && k.spoils) throw RunError(k.wrong + where);
    if (!k.holds()) fmt::print(stderr, "{}\n", messageText("A check fails: " + k.wrong));
  }
  if (!failures.empty()) throw RunError(failures.front() + where);
}

}  // namespace

void checkCell(const CellCase& c) {
  engineOf(c);
  caseIdentity(c);
}

void requireCarried(const CellCase& c, DeviceKind device) {
  if (device == DeviceKind::cpu) return;
  sayInCase(c.file, c.overrides,
            InputError({"", 0, "kind"}, fmt::format("cells are not carried by --device {}; allowed with it: \"wear\"; "
                                                    "without: --device cpu",
                                                    wordOf(device))));
}

int runCell(const CellCase& c, const RunOptions& options) {
  requireCarried(c, options.device);
  useThreads(options.threads);
  const auto start = std::chrono::steady_clock::now();
  const ResultsFolder folder(options.out, inputsOf(c), options.resume);
  const std::unique_ptr<const CellEngine> engine = engineOf(c);
  if (options.resume && !folder.resumes())
    fmt::print(notes(), "{} holds no load to go on from: starting at the beginning\n", options.out.string());
  if (!folder.resumes()) removeEarlierResults(options.out);
  const StopMessage stopped(fmt::format(
      "stopped by a signal; {} holds the loads that were walked to their ends: the same command with --resume goes on "
      "after them",
      options.out.string()));
  CellRecorder recorder(c, *engine, options.out, folder.resumes());
  if (!folder.resumes()) writeOwnFile(options.out / "case.json", writeCase(c));
  foretell(c, *engine, options.out);
  Units(c, *engine, recorder).run();
  const double wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  leaveResults(options.out, {wall_s, omp_get_max_threads(), folder.resumes()});
  fmt::print("Report: {}\n", (options.out / "report.html").string());
  return 0;
}

bool holdsCell(const std::filesystem::path& results) {
  if (!std::filesystem::exists(results / "case.json")) return false;
  const JsonNode root = readCaseNode(results / "case.json", {});
  const JsonNode* kind = root.find("kind");
  return kind && kind->text == "cell";
}

int renderCellResults(const RenderOptions& o) {
  const auto refuse = [](const char* option, const std::string& reason) {
    throw InputError({"command line", 0, option}, reason);
  };
  if (o.when == PictureTime::peak)
    refuse("--time", "there is no peak here; allowed: end, or the number of a load, 0 for the cell at rest");
  const RecordedCell cell(o.results);
  const bool solid = cell.definition().yarns == YarnModel::solid;
  if (o.field != PictureField::stress && o.field != PictureField::plain &&
      !(solid && o.field == PictureField::pressure))
    refuse("--field", fmt::format("pictures of cells show the stress along the yarns, weft and warp, or of solids the "
                                  "pressure on each other; allowed: stress{} or plain",
                                  solid ? ", pressure" : ""));
  CellPicture picture;
  picture.field = o.field == PictureField::stress     ? CellField::stress
                  : o.field == PictureField::pressure ? CellField::pressure
                                                      : CellField::direction;
  picture.view = o.view;
  picture.width = o.width;
  picture.height = o.height;
  const int loads = static_cast<int>(cell.paths().size());
  int load = loads;
  if (o.when == PictureTime::at) {
    load = o.time_s >= 0 && o.time_s <= loads ? static_cast<int>(o.time_s) : -1;
    if (static_cast<double>(load) != o.time_s)
      refuse("--time", fmt::format("there is no load {:g}; allowed: end, or 0 (at rest) to {}", o.time_s, loads));
  }
  if (load > 0) picture.path = cell.definition().paths[static_cast<std::size_t>(load) - 1].name;
  renderCell(cell, picture, o.png);
  return 0;
}

int reportCellResults(const ReportOptions& o) {
  const RecordedCell cell(o.results);
  const TemporaryFolder folder;
  std::vector<std::string> failures;
  const std::vector<Picture> pictures = takeCellPictures(cell, folder.path(), failures);
  writeCellPage(cell, cellChecks(cell), readCellRunFacts(o.results), pictures, o.html);
  if (!failures.empty()) throw RunError(failures.front() + " (the report is " + o.html.string() + ")");
  return 0;
}

}  // namespace gambeson
