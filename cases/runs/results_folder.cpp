#include "cases/runs/results_folder.hpp"

#include <fmt/format.h>
#include <omp.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdlib>

#include "cases/runs/european_tables.hpp"
#include "core/error.hpp"
#include "core/io/own_file.hpp"
#include "core/io/recording.hpp"
#include "core/io/segment_name.hpp"

namespace gambeson {
namespace {

namespace fs = std::filesystem;

/// Files of a run beside its recording, as they stand in the results folder.
constexpr std::array kFiles{"case.json",      "run.json",     "summary.json", "torques.csv", "contact.csv",
                            "collisions.csv", "latitude.csv", "stress.csv",   "zones.csv",   "patches.csv",
                            "straps.csv",     "path.csv",     "shape.csv",    "report.html", "dressed.json",
                            "energy.csv",     "memory.csv",   "curves.csv",   "pressures.csv",
                            kFilmFile};
constexpr const char* kPictures = "snapshots";
/// What stays when these and the recording's layout are gone, as a run begins that replaces an earlier one.
constexpr std::array kBegun{"frames",         "frames.xdmf", kPictures,    kEuropeanTables,
                            FolderLock::file, kDressingFile, kProgressFile};

[[noreturn]] void fail(const std::string& option, const std::string& reason) {
  throw InputError({"command line", 0, option}, reason);
}

/// "01_stress_peak_front.png", "body_pressure_back.png": what a run calls its pictures.
bool isPicture(const std::string& name) {
  const auto digit = [&](std::size_t k) {
    return k < name.size() && std::isdigit(static_cast<unsigned char>(name[k]));
  };
  return name.ends_with(".png") && ((digit(0) && digit(1)) || name.starts_with("body_pressure_"));
}

/// Those of a folder's entries that `pick` wants, by name.
template <class Pick>
Paths entriesOf(const fs::path& folder, Pick pick) {
  Paths found;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (pick(it->path().filename().string())) found.push_back(it->path());
  std::sort(found.begin(), found.end());
  return found;
}

bool isTable(const std::string& name) { return name.ends_with(".csv"); }

void requireWritable(const fs::path& folder, const std::string& option) {
  if (::access(folder.c_str(), R_OK | W_OK | X_OK) != 0)
    fail(option, folder.string() + " cannot be written: " + std::generic_category().message(errno));
}

}  // namespace

void requireFolder(const fs::path& folder) {
  std::error_code error;
  const fs::file_status status = fs::symlink_status(folder, error);
  if (fs::is_symlink(status))
    fail("--out", folder.string() + " is a symbolic link, which is not followed; allowed: a folder, or nothing there");
  if (fs::exists(status) && !fs::is_directory(status)) fail("--out", folder.string() + " is not a folder");
}

void makeFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) fail("--out", folder.string() + " cannot be made: " + error.message());
  requireWritable(folder, "--out");
}

void requireFreeOf(const fs::path& file, const Paths& inputs, const std::string& option) {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(file, error))) return;
  for (const fs::path& input : inputs)
    if (fs::equivalent(file, input, error))
      fail(option, file.string() + " is read by this command and would be overwritten; allowed: another name");
  requireFree(file, {"command line", 0, option});
}

void checkOutput(const fs::path& file, const std::string& option, const Paths& inputs) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  std::error_code error;
  if (!file.has_filename()) fail(option, file.string() + " is a folder; allowed: the name of a file");
  if (!fs::is_directory(folder, error)) fail(option, "there is no folder " + folder.string());
  requireFreeOf(file, inputs, option);
  requireWritable(folder, option);
}

Paths recordedFiles(const fs::path& results) {
  Paths files;
  for (const std::string name : kFiles)
    if (name != "report.html") files.push_back(results / name);
  files.push_back(results / "frames.xdmf");
  for (const fs::path& file : entriesOf(results / "frames", isRecorded)) files.push_back(file);
  return files;
}

void checkResultsFolder(const fs::path& out, const Paths& inputs, bool resume) {
  std::error_code error;
  const fs::file_status status = fs::status(out, error);
  if (!fs::exists(status)) return;
  if (!fs::is_directory(status)) fail("--out", out.string() + " is not a folder");
  requireWritable(out, "--out");
  for (const char* folder : {"frames", kPictures, kEuropeanTables}) requireFolder(out / folder);
  for (const std::string name : kFiles)
    if (!resume || name != "case.json") requireFreeOf(out / name, inputs, "--out");
  for (const char* file : {"frames.xdmf", kDressingFile, kProgressFile}) requireFreeOf(out / file, inputs, "--out");
  if (!resume)
    for (const fs::path& file : entriesOf(out / "frames", isRecorded)) requireFreeOf(file, inputs, "--out");
  for (const fs::path& file : entriesOf(out / kPictures, isPicture)) requireFreeOf(file, inputs, "--out");
  for (const fs::path& file : entriesOf(out / kEuropeanTables, isTable)) requireFreeOf(file, inputs, "--out");
}

ResultsFolder::ResultsFolder(const fs::path& out, const Paths& inputs, bool resume)
    : lock_([&] {
        // Before anything is made, so that a folder that is refused stays as it is.
        checkResultsFolder(out, inputs, resume && closedSegments(out) > 0);
        makeFolder(out);
        return out;
      }()),
      resumes_(resume && closedSegments(out) > 0) {
  checkResultsFolder(out, inputs, resumes_);  // what another command has left meanwhile
}

bool holdsOnlyABegunRun(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error) || holdsRecording(folder)) return false;
  return entriesOf(folder,
                   [](const std::string& name) {
                     return !name.starts_with(kOwnFiles) &&
                            std::find(kBegun.begin(), kBegun.end(), name) == kBegun.end();
                   })
      .empty();
}

void removeEarlierResults(const fs::path& out) {
  for (const char* name : kFiles) removeOwnFile(out / name);
  for (const fs::path& picture : entriesOf(out / kPictures, isPicture)) removeOwnFile(picture);
  for (const fs::path& table : entriesOf(out / kEuropeanTables, isTable)) removeOwnFile(table);
}

void useThreads(int threads) {
  if (threads == 0)  // OMP_NUM_THREADS: a number, or one for each level of nesting
    if (const char* wanted = std::getenv("OMP_NUM_THREADS")) threads = std::max(0, std::atoi(wanted));
  cpu_set_t set;
  const int machine = sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : omp_get_num_procs();
  omp_set_num_threads(threads > 0 ? threads : machine);
}

}  // namespace gambeson
