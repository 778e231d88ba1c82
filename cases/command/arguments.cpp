#include "cases/command/arguments.hpp"
#include "cases/command/arguments_shared.hpp"

namespace gambeson {

void addOverrides(CLI::App& command, std::vector<std::string>& overrides) {
  command
      .add_option("--set", overrides,
                  "Replaces a value of the case, for instance fabric.thickness=\"0.4 mm\" or "
                  "output.pictures[0].time=peak; may be given several times")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
}

void addThreads(CLI::App& command, int& threads, const std::string& words) {
  command.add_option("--threads", threads, words)->type_name("N")->check(CLI::Range(0, 4096).description(""));
}

void addDevice(CLI::App& command, std::string& device) {
  command
      .add_option(
          "--device", device,
          "What computes the steps. cpu: the processor; cuda: an NVIDIA GPU, for fine cloth; "
          "reference: the processor, slowly, with every bit as cuda has it; auto: cpu on every machine, so that "
          "numbers do not depend on it, and a note where a GPU is there [auto]")
      ->type_name("DEVICE")
      ->check(CLI::IsMember({"auto", "cpu", "reference", "cuda"}).description(""));
}

void addTables(CLI::App& command, std::string& csv) {
  command
      .add_option("--csv", csv,
                  "european: each table also with semicolons and decimal commas, as european/NAME.csv beside it")
      ->type_name("FORM")
      ->check(CLI::IsMember({"european"}).description(""));
}

void addRun(CLI::App& app, RunArguments& a) {
  CLI::App& run =
      *app.add_subcommand("run",
                          "Runs a case: dresses the human, lets it move, measures, takes pictures, reports; or "
                          "solves a static, dynamic or modal case of a structure; or takes a cell of yarns through "
                          "loads");
  run.add_option("CASE", a.file, "Case file (JSON)")->type_name("")->required();
  run.add_option(
         "--out", a.options.out,
         "Folder for the results; an earlier run's results there are replaced [results/<name of the case file>]")
      ->type_name("DIR");
  addThreads(run, a.options.threads,
             "Threads, 0 for OMP_NUM_THREADS or else as many as the machine has [0]. The results do not depend on it");
  run.add_flag("--resume", a.options.resume,
               "Continues an interrupted run of the same case, in the same folder, from its last checkpoint; of cuda "
               "also under reference, and the other way round");
  addOverrides(run, a.overrides);
  addDevice(run, a.device);
  run.footer(
      "Time goes with the size of cells (garment.NAME.cell): a walk takes minutes with 50 mm and most of an hour with "
      "20; half\n"
      "the size takes some ten times as long. Run gambeson check first, stand before you walk, and walk coarse before "
      "fine.\n\n"
      "Leaves in DIR: report.html (start here), summary.json (all numbers), torques.csv, contact.csv, zones.csv,\n"
      "pressures.csv, stress.csv, patches.csv, straps.csv, collisions.csv, energy.csv, memory.csv, latitude.csv,\n"
      "snapshots/ (pictures; where the case names none also film.mp4) and frames.xdmf (the recording, for ParaView).\n"
      "Static, dynamic and modal cases leave path.csv (points and edges of each step) and\n"
      "shape.csv (the last shape) in place of these tables, cells of yarns curves.csv.\n\n"
      "Examples:\n"
      "  gambeson run cases/library/shorts_walk.json\n"
      "  gambeson run cases/library/shorts_walk.json --out results/thin --set fabric.thickness=\"0.4 mm\"\n"
      "  gambeson run cases/library/sleeve_flex.json --set contact.friction=0.5\n"
      "  gambeson run cases/library/cantilever.json --set sheet.cells_u=32\n"
      "  gambeson run cases/library/armour_walk.json --device cuda\n\n"
      "Exit status: 0 done; 1 the run failed, the message says why; 2 something in the input is wrong.");
}

void addDress(CLI::App& app, DressArguments& a) {
  CLI::App& command =
      *app.add_subcommand("dress", "Puts the garments of a case on its human, for many runs to start from");
  command.add_option("CASE", a.file, "Case file (JSON)")->type_name("")->required();
  command.add_option("-o,--output", a.output, "Dressed state to write (JSON)")->type_name("FILE")->required();
  addThreads(command, a.threads,
             "Threads, 0 for OMP_NUM_THREADS or else as many as the machine has [0]. The state does not depend on it");
  addOverrides(command, a.overrides);
  command.footer(
      "Examples:\n"
      "  gambeson dress armour.json -o dressed.json\n"
      "  gambeson run armour.json --set dressing.from=dressed.json\n\n"
      "Exit status: 0 done; 1 a garment could not be put on, the message says why; 2 something in the input is wrong.");
}

void addCheck(CLI::App& app, CheckArguments& a) {
  CLI::App& check = *app.add_subcommand("check", "Checks a case, or another file, without running it");
  check
      .add_option(
          "CASE", a.file,
          "Case file (JSON); not needed with --schema or --doc. Of a study, card, law, garment, pattern, motion, "
          "mesh or folder of results it says what it is and whether it is sound")
      ->type_name("");
  addOverrides(check, a.overrides);
  check.add_flag("--full", a.full, "Prints the case with all defaults written out, in SI");
  check.add_flag("--schema", a.schema,
                 "Prints the JSON Schema of cases, for editors that complete and check while you write");
  check.add_flag("--doc", a.doc, "Prints what every field of a case means (Markdown)");
  check.footer(
      "Examples:\n"
      "  gambeson check my_case.json\n"
      "  gambeson check my_case.json --full --set garment.shorts.ease=\"10 %\"\n"
      "  gambeson check --schema > case.schema.json\n\n"
      "Exit status: 0 the case is valid: all that a run starts from was built; 1 the body cannot be freed of the "
      "garment; 2 it "
      "is not valid, and the message says file, line, key and what is allowed.");
}

void addNew(CLI::App& app, NewCase& a) {
  CLI::App& command = *app.add_subcommand(
      "new", "Writes a case that runs, from five answers: options, or else questions where this is a terminal");
  command.add_option("CASE", a.file, "File to write [GARMENT_MOTION.json]")->type_name("");
  command
      .add_option("--garment", a.garment,
                  "What is worn: shorts, trousers, shirt, sleeves (a shirt with long ones), or a pattern's file that "
                  "gambeson import wrote [shorts]")
      ->type_name("GARMENT");
  command
      .add_option("--fabric", a.fabric,
                  "A card of the library (denim_a, petrak_m6_cotton_twill, ...) or a card's file [denim_a]")
      ->type_name("CARD");
  command
      .add_option("--wearer", a.wearer,
                  "male_p5, male_p50, male_p95, female_p5, female_p50, female_p95, or a body scan's file (.obj, .ply) "
                  "[male_p50]")
      ->type_name("WEARER");
  command.add_option("--motion", a.motion, "stand, walk, stairs, step_over, sit or aim [stand]")->type_name("MOTION");
  command
      .add_option("--cells", a.cells, "coarse, medium or fine: fine takes some ten times as long as coarse [coarse]")
      ->type_name("CELLS");
  command.footer(
      "The case is checked on its wearer as it is written. Its file is small and meant to be edited "
      "(cases/FIELDS.md).\n\n"
      "Examples:\n"
      "  gambeson new                                                     asks\n"
      "  gambeson new walk.json --garment trousers --wearer female_p50 --motion walk\n"
      "  gambeson new --garment shirt_pattern.json --fabric poplin.card.json --wearer scan.obj");
}

void addTogether(CLI::App& app, TogetherArguments& a) {
  CLI::App& command = *app.add_subcommand("together", "Makes the steps of a study's runs in one process")->group("");
  command.add_option("LIST", a.options.list)->required();
  command.add_option("--ended", a.options.ended)->required();
  command.add_option("--jobs", a.options.jobs)->check(CLI::Range(1, 4096));
  command.add_option("--threads", a.options.threads)->check(CLI::Range(1, 4096));
  addDevice(command, a.device);
}

void addResults(CLI::App& app, FinishOptions& o) {
  CLI::App& command = *app.add_subcommand("results", "Makes the results of a run from its recording")->group("");
  command.add_option("DIR", o.out)->required();
  command.add_option("--threads", o.threads)->check(CLI::Range(1, 4096));
}

}  // namespace gambeson
