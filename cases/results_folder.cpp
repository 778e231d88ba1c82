#include "cases/results_folder.hpp"

#include <fmt/format.h>
#include <omp.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>

#include "core/error.hpp"
#include "core/io/recording.hpp"

namespace gambeson {
namespace {

/// Files of a run beside its recording, as they stand in the results folder.
constexpr std::array kFiles{"case.json",      "run.json",     "summary.json", "torques.csv", "contact.csv",
                            "collisions.csv", "latitude.csv", "stress.csv",   "zones.csv",   "patches.csv",
                            "straps.csv",     "path.csv",     "shape.csv",    "report.html"};
/// What stays when these and the recording's layout are gone, as a run begins that replaces an earlier one.
constexpr std::array kBegun{"frames", "frames.xdmf", "snapshots", "dressed.json"};

}  // namespace

void prepareResultsFolder(const std::filesystem::path& out) {
  const auto fail = [&](const std::string& reason) {
    throw InputError({"command line", 0, "--out"}, out.string() + " " + reason);
  };
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(out, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_directory(status)) fail("is not a folder");
  std::filesystem::create_directories(out, error);
  if (error) fail("cannot be made: " + error.message());
  if (::access(out.c_str(), R_OK | W_OK | X_OK) != 0)
    fail("cannot be written: " + std::generic_category().message(errno));
  if (holdsRecording(out)) return;
  for (const char* name : kFiles)
    if (std::filesystem::exists(out / name, error))
      fail(fmt::format(
          "holds a file {} and no recording: it is not the folder of an earlier run, and this run would overwrite it; "
          "allowed: a new folder, or one of an earlier run",
          name));
}

bool holdsOnlyABegunRun(const std::filesystem::path& folder) {
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error) || holdsRecording(folder)) return false;
  for (std::filesystem::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (std::find(kBegun.begin(), kBegun.end(), it->path().filename()) == kBegun.end()) return false;
  return !error;
}

void removeEarlierResults(const std::filesystem::path& out) {
  for (const char* name : kFiles) {
    std::error_code error;
    std::filesystem::remove(out / name, error);
    if (error) throw RunError("cannot remove " + (out / name).string() + ": " + error.message());
  }
}

void useThreads(int threads) {
  if (threads == 0)  // OMP_NUM_THREADS: a number, or one for each level of nesting
    if (const char* wanted = std::getenv("OMP_NUM_THREADS")) threads = std::max(0, std::atoi(wanted));
  cpu_set_t set;
  const int machine = sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : omp_get_num_procs();
  omp_set_num_threads(threads > 0 ? threads : machine);
}

}  // namespace gambeson
