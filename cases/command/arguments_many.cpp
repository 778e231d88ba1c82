/// Detail of arguments.hpp: many runs.
#include "cases/command/arguments.hpp"
#include "cases/command/arguments_shared.hpp"

namespace gambeson {

void addVerify(CLI::App& app, verify::Options& o) {
  CLI::App& command =
      *app.add_subcommand("verify", "Runs published references: measured against reference, tolerance, on one page");
  command.add_option("--filter", o.filters, "Only references whose id fits the pattern, such as 'sze_*' [all]")
      ->type_name("GLOB")
      ->allow_extra_args(false);
  command.add_flag("--quick", o.quick, "Only the quick half");
  command.add_option("--dir", o.dir, "Folder of the references [tests/verify]")->type_name("DIR");
  command.add_option("--out", o.out, "Folder for the results [results/verify]")->type_name("DIR");
  command
      .add_option("--results", o.results,
                  "Takes runs from here (DIR/REFERENCE/RUN or DIR/RUN) that are complete and of the same case, instead "
                  "of running them; runs that were interrupted in the folder of --out go on")
      ->type_name("DIR");
  command.add_option("--jobs", o.jobs, "Runs at a time, of one thread each; 0 for one on each core [0]")
      ->type_name("N")
      ->check(CLI::Range(0, 4096).description(""));
  command.footer(
      "Leaves in DIR: verify.html (start here), verify.json and a folder for each run.\n\n"
      "Examples:\n"
      "  gambeson verify --quick\n"
      "  gambeson verify --filter 'sze_3_4*' --out results/hemisphere\n"
      "  gambeson verify --filter armour --out results/armour --results results/armour\n\n"
      "Exit status: 0 all references passed; 1 some failed; 2 something in the input is wrong.");
}

static void addSlurm(CLI::App& command, StudyArguments& a) {
  command
      .add_option("--engine", a.engine,
                  "local: runs here; slurm: runs nothing and writes scripts for Slurm into DIR, an array of jobs "
                  "(study.slurm; with --device cuda each asks for a GPU), a job that compares (compare.slurm), and "
                  "submit.sh, which hands both in [local]")
      ->type_name("ENGINE")
      ->check(CLI::IsMember({"local", "slurm"}).description(""));
  const auto add = [&](const char* option, std::optional<std::string>& text, const char* type, const char* what) {
    command.add_option(option, text, what)->type_name(type);
  };
  study::Queue& q = a.options.queue;
  add("--time", q.time, "TIME", "With slurm: time that each job may take, such as 02:30:00 or 1-12 (days-hours)");
  add("--mem", q.memory, "SIZE", "With slurm: memory of each job, such as 8G");
  add("--partition", q.partition, "NAME", "With slurm: partition of the cluster");
  add("--job-name", q.job_name, "NAME", "With slurm: name of the jobs; the one that compares is NAME_compare");
  CLI::Option* compare = command.add_flag("--compare", a.options.compare,
                                          "Runs nothing: compares what is done in DIR, and lists the others as failed");
  for (const char* other : {"--engine", "--jobs", "--resume"}) compare->excludes(command.get_option(other));
}

/// How much runs at once, of options that have both; `elsewhere`, `each`: what 0 jobs mean on a GPU and with Slurm, and
/// what threads with Slurm.
template <class Options>
static void addParallel(CLI::App& command, Options& o, const std::string& elsewhere = "",
                        const std::string& each = "") {
  command.add_option("--jobs", o.jobs, "Runs at a time; 0 for as many as there are threads" + elsewhere + " [0]")
      ->type_name("N")
      ->check(CLI::Range(0, 4096).description(""));
  addThreads(command, o.threads, "Threads of all runs together, 0 for as many as the machine has" + each + " [0]");
}

static void addJobs(CLI::App& command, study::Options& o) {
  addParallel(command, o, ", on a GPU for 16 as far as its memory goes, with slurm for as many as the cluster starts",
              "; with slurm those of each job, 0 for one");
  command.add_flag("--resume", o.resume,
                   "Keeps runs that are done with the same case, continues those that were interrupted, and runs the "
                   "others; without it all run again");
}

void addStudy(CLI::App& app, StudyArguments& a) {
  CLI::App& command = *app.add_subcommand(
      "study",
      "Runs the variants of a case side by side and compares them: which one to take, why, and how sure that is");
  command.add_option("STUDY", a.file, "Study file (JSON)")->type_name("")->required();
  command.add_option("--out", a.options.out, "Folder for the results [results/<name of the study file>]")
      ->type_name("DIR");
  addJobs(command, a.options);
  addDevice(command, a.device);
  addSlurm(command, a);
  command.add_flag("--check", a.check, "Only checks the study and all its variants, and lists them");
  command.footer(
      "Leaves in DIR: report.html (start here), study.json (all numbers), variants.csv (a row for each variant), "
      "curves.csv\n"
      "(torques over time), exponents.csv, elasticities.csv, meshes.csv, uncertainty.csv, pictures/, logs/, and a "
      "folder with the run "
      "of\n"
      "each variant.\n\n"
      "Examples:\n"
      "  gambeson study cases/library/shorts_thickness.study.json\n"
      "  gambeson study my.study.json --out results/mine --jobs 4 --resume\n"
      "  gambeson study my.study.json --out results/mine --engine slurm --threads 2 --time 02:30:00 --mem 8G\n"
      "  bash results/mine/submit.sh            what is left goes on with the same two lines and --resume\n\n"
      "Exit status: 0 all variants are done; 1 some failed, and the report compares the others; 2 something in the "
      "input\n"
      "of any variant is wrong, and nothing ran.");
}

void addBatch(CLI::App& app, StudyArguments& a) {
  CLI::App& command =
      *app.add_subcommand("batch", "Runs several cases as a study does, each in a folder named after its file");
  command.add_option("CASE", a.cases, "Case files (JSON)")->type_name("")->required();
  command.add_option("--out", a.options.out, "Folder for the results")->type_name("DIR")->required();
  addJobs(command, a.options);
  addDevice(command, a.device);
  addSlurm(command, a);
  command.footer(
      "Examples:\n"
      "  gambeson batch cases/library/flag.json cases/library/stack_mixed.json --out results/cloth\n"
      "  gambeson batch a.json b.json --out results/ab --engine slurm --time 60 && bash results/ab/submit.sh\n\n"
      "Exit status: 0 all cases are done; 1 some failed; 2 something in the input is wrong, and nothing ran.");
}

void addGallery(CLI::App& app, gallery::Options& o) {
  CLI::App& command = *app.add_subcommand(
      "gallery", "Makes a page of many cases: of each its picture, its question, its answer, and a link to its report");
  command.add_option("CASE", o.files, "Case and study files (JSON) [all of the library]")->type_name("");
  command.add_option("-o,--out", o.out, "Folder for the page and the results")->type_name("DIR")->required();
  command
      .add_option(
          "--library", o.library,
          "Folder of cases, where none is named [share/gambeson/library or cases/library, beside the program or "
          "above it]")
      ->type_name("DIR");
  addParallel(command, o);
  command.footer(
      "Runs what is not done yet, each in DIR/NAME: results of the same case are taken as they are, and runs that "
      "were\n"
      "interrupted go on. Leaves DIR/gallery.html (start here), logs/ and a folder for each. The whole library takes\n"
      "hours.\n\n"
      "Examples:\n"
      "  gambeson gallery cases/library/cantilever.json cases/library/cell_twill.json -o results/gallery\n"
      "  gambeson gallery -o results/library --jobs 2                              the whole library\n\n"
      "Exit status: 0 all are done; 1 some failed, and the page shows why beside the others; 2 something in the input "
      "is\nwrong, and nothing ran.");
}

}  // namespace gambeson
