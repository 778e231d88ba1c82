/// Detail of run.hpp: the scripts that Slurm is handed.

#include <fmt/format.h>

#include <algorithm>
#include <regex>

#include "cases/runs/shell_word.hpp"
#include "cases/study/files.hpp"
#include "cases/study/run.hpp"
#include "core/error.hpp"

namespace gambeson::study {
namespace {

/// What both scripts say in their heads. Paths of the user's stand in no line of #SBATCH, which has rules of its own:
/// the scripts open their logs themselves. What stands there is what checkQueue allows.
std::string head(const Options& o, const std::string& more, const std::string& name_ending) {
  const Queue& q = o.queue;
  std::string text = more;
  text += fmt::format("#SBATCH --cpus-per-task={}\n", std::max(1, o.threads));
  if (q.time) text += fmt::format("#SBATCH --time={}\n", *q.time);
  if (q.memory) text += fmt::format("#SBATCH --mem={}\n", *q.memory);
  if (q.partition) text += fmt::format("#SBATCH --partition={}\n", *q.partition);
  if (q.job_name) text += fmt::format("#SBATCH --job-name={}{}\n", *q.job_name, name_ending);
  return text + "#SBATCH --requeue\n#SBATCH --output=/dev/null\n";
}

std::string absoluteWord(const std::filesystem::path& file) {
  return shellWord(std::filesystem::absolute(file).lexically_normal().string());
}

std::string programWord(const Options& o) {
  std::error_code error;
  const std::filesystem::path binary = std::filesystem::canonical(o.binary, error);
  return shellWord(error ? o.binary : binary.string());
}

struct Wish {
  const std::optional<std::string>& text;
  const char *option, *pattern, *allowed;
};

}  // namespace

void checkQueue(const Queue& q, bool slurm) {
  const Wish wishes[]{
      {q.time, "--time", R"(\d{1,9}(:\d{1,2}){0,2}|\d{1,6}-\d{1,2}(:\d{1,2}){0,2})",
       "MINUTES, MINUTES:SECONDS, HOURS:MINUTES:SECONDS, DAYS-HOURS or DAYS-HOURS:MINUTES:SECONDS, such as 02:30:00"},
      {q.memory, "--mem", R"(\d{1,12}[KMGT]?)", "a whole number of MB, or of K, M, G or T, such as 8G"},
      {q.partition, "--partition", R"([A-Za-z0-9_][A-Za-z0-9_.-]*(,[A-Za-z0-9_][A-Za-z0-9_.-]*)*)",
       "names of letters, digits and _.- with commas between them"},
      {q.job_name, "--job-name", R"([A-Za-z0-9_][A-Za-z0-9_.-]{0,99})", "up to 100 letters, digits and _.-"}};
  for (const Wish& wish : wishes) {
    if (!wish.text) continue;
    const InputError::Where where{"command line", 0, wish.option};
    if (!slurm) throw InputError(where, fmt::format("\"{}\" is for Slurm; allowed: with --engine slurm", *wish.text));
    if (!std::regex_match(*wish.text, std::regex(wish.pattern)))
      throw InputError(where, fmt::format("\"{}\" cannot be passed on; allowed: {}", *wish.text, wish.allowed));
  }
}

std::string slurmScript(const Study& s, const Options& o, const std::vector<Stand>& stands) {
  std::string folders, again;
  std::size_t count = 0;
  for (std::size_t i = 0; i < s.variants.size(); ++i) {
    if (stands[i] == Stand::done) continue;
    folders.append(" ").append(shellWord(s.variants[i].folder));
    again += goesOn(s.variants[i]) ? " --resume" : " ''";
    ++count;
  }
  const std::string limit = o.jobs > 0 ? fmt::format("%{}", o.jobs) : "";
  std::string more = fmt::format("#SBATCH --array=0-{}{}\n", count > 0 ? count - 1 : 0, limit);
  if (o.device == DeviceKind::cuda) more += "#SBATCH --gres=gpu:1\n";
  return fmt::format(
      "#!/usr/bin/env bash\n"
      "# {} variants, each a job of its own. Jobs that Slurm starts again, and those of a script that is handed in\n"
      "# again, go on from the last checkpoint. submit.sh hands this in, and compare.slurm after it.\n"
      "{}"
      "gambeson={}\n"
      "out={}\n"
      "folders=({})\n"
      "again=({})\n"
      "i=$SLURM_ARRAY_TASK_ID\n"
      "exec \"$gambeson\" run \"$out/{}/${{folders[i]}}.json\" --out \"$out/${{folders[i]}}\" --threads "
      "\"$SLURM_CPUS_PER_TASK\" --device {} ${{again[i]}} > \"$out/{}/${{folders[i]}}.log\" 2>&1\n",
      count, head(o, more, ""), programWord(o), shellWord(o.out.string()), folders, again, files::cases,
      wordOf(o.device), files::logs);
}

std::string compareScript(const Study& s, const Options& o) {
  std::string what = s.file.empty() ? "batch" : fmt::format("study {}", absoluteWord(s.file));
  if (s.file.empty())
    for (const Variant& v : s.variants)
      what.append(" ").append(std::visit([](const auto& c) { return absoluteWord(c.file); }, v.definition));
  return fmt::format(
      "#!/usr/bin/env bash\n"
      "# Compares the variants that are done and says which are not. Runs nothing.\n"
      "{}"
      "gambeson={}\n"
      "out={}\n"
      "exec \"$gambeson\" {} --out \"$out\" --compare --threads \"$SLURM_CPUS_PER_TASK\" --device {}{} > "
      "\"$out/{}\" 2>&1\n",
      head(o, "", "_compare"), programWord(o), shellWord(o.out.string()), what, wordOf(o.device),
      o.csv.empty() ? "" : " --csv " + o.csv, files::compare_log);
}

std::string submitScript(const Options& o) {
  return fmt::format(
      "#!/usr/bin/env bash\n"
      "# Hands the runs to Slurm, and what compares them, which waits until each of them has ended, however that was.\n"
      "# Options of sbatch are passed on to both: bash submit.sh --account=NAME\n"
      "out={}\n"
      "runs=$(sbatch --parsable \"$@\" \"$out/{}\") || exit 1\n"
      "runs=${{runs%%;*}}\n"
      "compares=$(sbatch --parsable --dependency=\"afterany:$runs\" \"$@\" \"$out/{}\") || {{\n"
      "  scancel \"$runs\"\n"
      "  exit 1\n"
      "}}\n"
      "echo \"The runs are job $runs; job ${{compares%%;*}} compares them\"\n",
      shellWord(o.out.string()), files::script, files::compare_script);
}

}  // namespace gambeson::study
