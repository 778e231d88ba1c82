/// Detail of gallery.hpp: runs what is not done yet, as processes of the command itself, and writes the page.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <ostream>
#include <thread>

#include "cases/gallery/gallery.hpp"
#include "cases/input/message.hpp"
#include "cases/runs/folder_lock.hpp"
#include "cases/runs/process_pool.hpp"
#include "cases/runs/progress.hpp"
#include "cases/runs/results_folder.hpp"
#include "cases/study/files.hpp"
#include "cases/study/run.hpp"
#include "core/error.hpp"
#include "core/io/own_file.hpp"

namespace gambeson::gallery {
namespace {

using Path = std::filesystem::path;
using study::Stand;

constexpr const char* kPage = "gallery.html";
constexpr const char* kReport = "report.html";

/// A case or a study, where it stands, and what becomes of it.
struct Job {
  Exhibit exhibit;
  Path file;
  Paths inputs;
  Stand stand = Stand::fresh;
  bool is_study = false;
};

/// A structure's page is whole although its run came to no end: such a run is made again, and fails again.
bool cameToItsEnd(const Path& folder) {
  std::ifstream stream(folder / "summary.json");
  const auto j = nlohmann::json::parse(stream, nullptr, false);
  return !j.is_object() || j.value("finished", true);
}

Stand standOfCase(const Path& folder, const std::string& identity) {
  const Stand stand = study::standOf(folder, identity);
  return stand == Stand::done && !cameToItsEnd(folder) ? Stand::fresh : stand;
}

/// Done where all its variants are, and its page is there.
Stand standOfStudy(const Path& folder, const study::Study& s) {
  const bool done = std::all_of(s.variants.begin(), s.variants.end(), [&](const study::Variant& v) {
    return standOfCase(folder / v.folder, v.identity) == Stand::done;
  });
  return done && isOwnFile(folder / kReport) ? Stand::done : Stand::fresh;
}

Sort sortOf(const AnyCase& any) {
  if (std::holds_alternative<StructureCase>(any)) return Sort::structure;
  if (std::holds_alternative<CellCase>(any)) return Sort::cell;
  return std::get<Case>(any).human ? Sort::worn : Sort::cloth;
}

std::vector<Job> jobsOf(const Chosen& chosen, const Path& out) {
  std::vector<Job> jobs;
  for (const study::Variant& v : chosen.cases.variants) {
    Job job;
    std::visit(
        [&](const auto& c) {
          job.exhibit = {sortOf(v.definition), v.folder, c.name, c.description, "", {}, ""};
          job.file = c.file;
        },
        v.definition);
    job.inputs = inputsOf(v.definition);
    job.stand = standOfCase(out / v.folder, v.identity);
    jobs.push_back(std::move(job));
  }
  for (const study::Study& s : chosen.studies) {
    Job job;
    job.exhibit = {Sort::study, folderOf(s), s.name, s.description, "", {}, ""};
    job.file = s.file;
    job.inputs = {s.file};
    job.stand = standOfStudy(out / folderOf(s), s);
    job.is_study = true;
    jobs.push_back(std::move(job));
  }
  return jobs;
}

Path logFile(const Path& out, const Job& job) { return out / study::files::logs / (job.exhibit.folder + ".log"); }

/// All that would be written, before anything is made or computed: files of others and inputs are refused (InputError).
void checkFolder(const std::vector<Job>& jobs, const Path& out) {
  std::error_code error;
  if (!std::filesystem::exists(out, error)) return;
  if (!std::filesystem::is_directory(out, error))
    throw InputError({"command line", 0, "--out"}, out.string() + " is not a folder");
  Paths inputs;
  for (const Job& job : jobs) inputs.insert(inputs.end(), job.inputs.begin(), job.inputs.end());
  requireFreeOf(out / kPage, inputs, "--out");
  requireFolder(out / study::files::logs);
  for (const Job& job : jobs) {
    requireFolder(out / job.exhibit.folder);
    requireFreeOf(logFile(out, job), inputs, "--out");
    if (job.stand != Stand::done && !job.is_study)
      checkResultsFolder(out / job.exhibit.folder, job.inputs, job.stand == Stand::interrupted);
  }
}

Process processOf(const Job& job, const Options& o, int threads) {
  const Path folder = o.out / job.exhibit.folder;
  makeFolder(folder);
  // What an earlier run left is not taken for results of this one, even where this one never begins.
  if (job.stand == Stand::fresh && !job.is_study) removeEarlierResults(folder);
  if (job.is_study) removeOwnFile(folder / kReport);
  claimFile(logFile(o.out, job));
  Process process{{o.binary, job.is_study ? "study" : "run", std::filesystem::absolute(job.file).string(), "--out",
                   folder.string(), "--threads", std::to_string(threads), "--device", "cpu"},
                  logFile(o.out, job)};
  if (job.is_study || job.stand == Stand::interrupted) process.command.emplace_back("--resume");
  return process;
}

/// What its run left at the top of its page.
void readTop(Exhibit& e, const Path& out) {
  const Path page = out / e.folder / kReport;
  try {
    if (!std::filesystem::exists(page)) throw RunError("its run left no report.");
    if (!isOwnFile(page))
      throw RunError("its report was changed after it was written; once it is removed, it is made again.");
    e.top = readPageTop(page);
  } catch (const RunError& error) {
    e.no_page = error.what();
    if (e.failed.empty()) e.failed = e.no_page;
  }
}

}  // namespace

int runGallery(const Options& chosen_options, std::ostream& out) {
  const auto begin = std::chrono::steady_clock::now();
  const Signals signals;
  Options o = chosen_options;
  if (!o.files.empty() && !o.library.empty())
    throw InputError({"command line", 0, "--library"}, "excludes CASE; give only one of them");
  const Path library = !o.library.empty() ? o.library
                       : o.files.empty()  ? findLibrary(std::filesystem::read_symlink("/proc/self/exe"))
                                          : Path();
  const Chosen chosen = o.files.empty() ? chooseLibrary(library) : chooseFiles(o.files);
  o.out = std::filesystem::absolute(o.out).lexically_normal();
  checkPath(o.out, "--out");
  checkFolder(jobsOf(chosen, o.out), o.out);
  makeFolder(o.out);
  makeFolder(o.out / study::files::logs);
  const FolderLock lock(o.out);
  std::vector<Job> jobs = jobsOf(chosen, o.out);
  checkFolder(jobs, o.out);  // what another command has left meanwhile

  const int threads = o.threads > 0 ? o.threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  std::vector<std::size_t> waiting;
  for (std::size_t i = 0; i < jobs.size(); ++i)
    if (jobs[i].stand != Stand::done) waiting.push_back(i);
  // Those interrupted first: they are nearest to their end.
  std::stable_partition(waiting.begin(), waiting.end(),
                        [&](std::size_t i) { return jobs[i].stand == Stand::interrupted; });
  const int parallel = std::clamp(o.jobs > 0 ? o.jobs : threads, 1, std::max(1, static_cast<int>(waiting.size())));
  std::vector<Process> processes;
  for (const std::size_t i : waiting) processes.push_back(processOf(jobs[i], o, std::max(1, threads / parallel)));
  if (waiting.size() < jobs.size())
    out << fmt::format("{} of {} are done already\n", jobs.size() - waiting.size(), jobs.size()) << std::flush;
  ProcessPool pool;
  pool.parallel = parallel;
  pool.ended = [&](std::size_t k, const Ended& e) {
    Exhibit& exhibit = jobs[waiting[k]].exhibit;
    exhibit.failed = e.why;
    out << (e.good ? fmt::format("done    {}  {}\n", exhibit.folder, durationText(e.seconds))
                   : fmt::format("FAILED  {}  {}\n", exhibit.folder, e.why))
        << std::flush;
  };
  if (!runProcesses(processes, pool, signals, lock.descriptor()))
    throw RunError(fmt::format(
        "stopped by a signal; what is done stands in {}, and the same command goes on from there", o.out.string()));
  std::vector<Exhibit> exhibits;
  int failed = 0;
  for (Job& job : jobs) {
    const bool ran_well = job.exhibit.failed.empty();
    readTop(job.exhibit, o.out);
    if (ran_well && !job.exhibit.failed.empty())
      out << fmt::format("FAILED  {}  {}\n", job.exhibit.folder, job.exhibit.failed);
    failed += !job.exhibit.failed.empty();
    exhibits.push_back(std::move(job.exhibit));
  }
  writeOwnFile(o.out / kPage, formatGallery(exhibits, chosen.left_out));
  if (failed > 0) out << fmt::format("{} of {} failed: the page says why\n", failed, exhibits.size());
  const double wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  out << fmt::format("Gallery, after {}: {}\n", durationText(wall_s), (o.out / kPage).string());
  return failed > 0 ? 1 : 0;
}

}  // namespace gambeson::gallery
