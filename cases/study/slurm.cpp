/// Detail of run.hpp: the script of an array of jobs.

#include <fmt/format.h>

#include <algorithm>

#include "cases/runs/shell_word.hpp"
#include "cases/study/files.hpp"
#include "cases/study/run.hpp"

namespace gambeson::study {

std::string slurmScript(const Study& s, const Options& o, const std::vector<Stand>& stands) {
  std::string folders, again;
  std::size_t count = 0;
  for (std::size_t i = 0; i < s.variants.size(); ++i) {
    if (stands[i] == Stand::done) continue;
    folders.append(" ").append(shellWord(s.variants[i].folder));
    again += stands[i] == Stand::interrupted ? " --resume" : " ''";
    ++count;
  }
  const std::string limit = o.jobs > 0 ? fmt::format("%{}", o.jobs) : "";
  std::error_code error;
  const std::filesystem::path binary = std::filesystem::canonical(o.binary, error);
  // No text of the user's stands in a line of #SBATCH, which has rules of its own: the script opens its log itself.
  return fmt::format(
      "#!/usr/bin/env bash\n"
      "# {} variants, each a job of its own. When all are done, compare them: gambeson study ... --out ... --resume\n"
      "#SBATCH --array=0-{}{}\n"
      "#SBATCH --cpus-per-task={}\n"
      "{}"
      "#SBATCH --output=/dev/null\n"
      "gambeson={}\n"
      "out={}\n"
      "folders=({})\n"
      "again=({})\n"
      "i=$SLURM_ARRAY_TASK_ID\n"
      "exec \"$gambeson\" run \"$out/{}/${{folders[i]}}.json\" --out \"$out/${{folders[i]}}\" --threads "
      "\"$SLURM_CPUS_PER_TASK\" --device {} ${{again[i]}} > \"$out/{}/${{folders[i]}}.log\" 2>&1\n",
      count, count > 0 ? count - 1 : 0, limit, std::max(1, o.threads),
      o.device == DeviceKind::cuda ? "#SBATCH --gres=gpu:1\n" : "", shellWord(error ? o.binary : binary.string()),
      shellWord(o.out.string()), folders, again, files::cases, wordOf(o.device), files::logs);
}

}  // namespace gambeson::study
