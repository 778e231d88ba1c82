#include "cases/command/cli.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <iostream>
#include <ostream>
#include <sstream>

#include "analysis/animation/obj.hpp"
#include "cases/cell/run.hpp"
#include "cases/cloth/kind_fields.hpp"
#include "cases/cloth/usual.hpp"
#include "cases/command/arguments.hpp"
#include "cases/command/check_file.hpp"
#include "cases/command/documents.hpp"
#include "cases/fabric/run.hpp"
#include "cases/film/film.hpp"
#include "cases/gallery/gallery.hpp"
#include "cases/input/message.hpp"
#include "cases/input/mistakes.hpp"
#include "cases/input/overrides.hpp"
#include "cases/kinds/any_case.hpp"
#include "cases/pattern/flat_draft.hpp"
#include "cases/pattern/import.hpp"
#include "cases/runs/european_tables.hpp"
#include "cases/runs/options.hpp"
#include "cases/runs/picture.hpp"
#include "cases/runs/results_folder.hpp"
#include "cases/runs/stop_message.hpp"
#include "cases/structure/fields.hpp"
#include "cases/structure/run.hpp"
#include "cases/study/run.hpp"
#include "cases/verify/verify.hpp"
#include "cases/wear/case/device_keys.hpp"
#include "cases/wear/case/fields.hpp"
#include "cases/wear/results/results.hpp"
#include "cases/wear/run/draft.hpp"
#include "cases/wear/run/dress.hpp"
#include "cases/wear/run/export.hpp"
#include "cases/wear/run/run.hpp"
#include "cases/wear/run/run_steps.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

constexpr int done = 0, failed = 1, bad_input = 2;
constexpr std::size_t kMostMistakes = 40;  ///< that are listed of one input

/// The ending, in lower case, of a file whose name says what is in it. Throws InputError ("command line", option).
std::string checkEnding(const std::filesystem::path& file, const std::string& option,
                        const std::vector<std::string>& allowed) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  if (std::find(allowed.begin(), allowed.end(), ending) == allowed.end())
    throw InputError({"command line", 0, option},
                     fmt::format("\"{}\" does not end as what is written; allowed: a name that ends in {}",
                                 file.string(), schema::joined(allowed)));
  return ending;
}

/// A blank line between what a command does and how it is used.
class HelpText : public CLI::Formatter {
 public:
  std::string make_usage(const CLI::App* app, std::string name) const override {
    return "\n" + CLI::Formatter::make_usage(app, std::move(name));
  }
};

template <class E>
E choiceOf(const std::vector<std::pair<std::string, E>>& choices, const std::string& word) {
  return std::find_if(choices.begin(), choices.end(), [&](const auto& c) { return c.first == word; })->second;
}

int fabricCommand(FabricArguments& a, std::ostream& out) {
  FabricOptions& o = a.options;
  o.specimen.cloth.kind = choiceOf(schema::specimenKinds(), a.model);
  o.specimen.cloth.mesh = choiceOf(schema::meshKinds(), a.mesh);
  o.specimen.cloth.bending = choiceOf(schema::bendingElements(), a.bending);
  for (const LabTestKind& kind : labTests())
    if (std::find(a.tests.begin(), a.tests.end(), kind.word) != a.tests.end()) o.tests.push_back(kind.test);
  if (!o.fabric.empty()) checkEnding(o.fabric, "--output", {".json"});
  if (o.out.empty() && o.fabric.empty()) {
    std::string name = o.card.stem().string();
    if (name.ends_with(".card")) name.resize(name.size() - 5);
    o.out = std::filesystem::path("results") / name;
  }
  return runFabric(o, out);
}

/// Builds what a run of the case starts from: a case that is valid can be run. Returns what there is to say of it.
std::vector<std::string> checkBuild(const AnyCase& any) {
  useThreads(0);
  if (const auto* structure = std::get_if<StructureCase>(&any)) {
    checkStructure(*structure);
    return assumedThicknesses(schema::writeObject(schema::structureTable(structure->kind), structure));
  }
  if (const auto* worn = std::get_if<Case>(&any)) return checkRun(*worn);
  checkCell(std::get<CellCase>(any));
  return {};
}

/// Numbers of the case as its file and the command line have them.
std::vector<InputError> unusualOf(const AnyCase& any, const CheckArguments& a) {
  const JsonNode root = readCaseNode(a.file, a.overrides);
  const std::string name = a.file.string();
  const schema::Entry entry{root, "", name};
  if (const auto* structure = std::get_if<StructureCase>(&any))
    return unusualNumbers(schema::structureTable(structure->kind), entry);
  return std::holds_alternative<Case>(any) ? unusualNumbers(schema::caseTable(), entry) : std::vector<InputError>{};
}

int check(const CheckArguments& a, std::ostream& out) {
  if (a.schema) out << caseSchema();
  if (a.doc) out << caseFields();
  if (a.file.empty()) {
    if (a.schema || a.doc) return done;
    throw InputError({"command line", 0, "CASE"}, "is required: the case file to check");
  }
  if (a.overrides.empty() && !a.full && checkFile(a.file, out)) return done;
  const AnyCase any = readAnyCase(a.file, a.overrides);
  for (const InputError& unusual : unusualOf(any, a)) sayNote(unusual.what());
  const std::vector<std::string> lines = checkBuild(any);
  if (a.full) {
    out << std::visit([](const auto& c) { return writeCase(c); }, any);
    return done;
  }
  out << a.file.string() << ": valid\n";
  for (const std::string& line : lines) out << "  " << messageText(line) << "\n";
  return done;
}

int draft(const DraftArguments& a, std::ostream& out) {
  using Endings = std::vector<std::string>;
  if (a.flat && a.obj) throw InputError({"command line", 0, "--flat"}, "excludes --obj; give only one of them");
  const std::string ending = checkEnding(a.garment_file, "--output",
                                         a.flat  ? Endings{".dxf", ".svg", ".json"}
                                         : a.obj ? Endings{".obj"}
                                                 : Endings{".json", ".obj"});
  const AnyCase any = readAnyCase(a.file, a.overrides);
  const auto* c = std::get_if<Case>(&any);
  if (!c) throw InputError({a.file.string(), 0, ""}, "is no case of worn cloth; garments are made by those that wear");
  if (a.flat) {
    const std::size_t garment = garmentCalled(*c, a.garment);
    checkOutput(a.garment_file, "--output", inputsOf(any));
    flatToFile(draftOf(*c, garment), a.garment_file, standsOf(fabricOf(*c, c->garments[garment])), out);
    return done;
  }
  draftToFile(*c, a.garment, a.garment_file, ending == ".obj", out);
  return done;
}

/// `auto` is the processor: numbers must not depend on the machine.
DeviceKind deviceOf(const std::string& word) {
  const auto at = std::find(kDeviceWords.begin(), kDeviceWords.end(), word);
  return at == kDeviceWords.end() ? DeviceKind::cpu : static_cast<DeviceKind>(at - kDeviceWords.begin());
}

int run(RunArguments& a) {
  a.options.device = deviceOf(a.device);
  a.options.names_gpu = a.device == "auto";
  const AnyCase any = readAnyCase(a.file, a.overrides);
  if (a.options.out.empty()) a.options.out = std::filesystem::path("results") / a.file.stem();
  checkPath(std::filesystem::absolute(a.options.out), "--out");
  if (const auto* structure = std::get_if<StructureCase>(&any)) return runStructure(*structure, a.options);
  if (const auto* cell = std::get_if<CellCase>(&any)) return runCell(*cell, a.options);
  return runCase(std::get<Case>(any), a.options);
}

/// Before anything runs: that all variants can be run on the device that was asked for.
void checkDevice(const study::Study& s, const study::Options& o, bool automatic) {
  const auto require = [&](DeviceKind device) {
    for (const study::Variant& v : s.variants)
      std::visit([&](const auto& c) { requireCarried(c, device); }, v.definition);
  };
  require(o.device);
  if (o.slurm || o.compare) return;  // where the jobs run there may be another GPU
  requireDevice(o.device);
  if (!automatic) return;
  try {
    require(DeviceKind::cuda);
  } catch (const InputError&) {
    return;  // it would not help
  }
  nameGpu();
}

/// What `study` and `batch` are told alike.
void takeOptions(StudyArguments& a, const std::string& csv) {
  a.options.slurm = a.engine == "slurm";
  a.options.device = deviceOf(a.device);
  a.options.csv = csv;
  study::checkQueue(a.options.queue, a.options.slurm);
}

int studyCommand(StudyArguments& a, std::ostream& out) {
  if (a.options.out.empty()) {
    std::string name = a.file.stem().string();
    if (name.ends_with(".study")) name.resize(name.size() - 6);
    a.options.out = std::filesystem::path("results") / name;
  }
  const study::Study s = study::readStudy(a.file);
  checkDevice(s, a.options, a.device == "auto");
  if (!a.check) return study::runStudy(s, a.options, out);
  for (const study::Variant& v : s.variants) {
    checkBuild(v.definition);
    out << v.folder << '\n';
  }
  out << fmt::format("{}: valid, {} variants\n", a.file.string(), s.variants.size());
  return done;
}

int batchCommand(StudyArguments& a, std::ostream& out) {
  const study::Study s = study::batchOf(a.cases);
  checkDevice(s, a.options, a.device == "auto");
  return study::runStudy(s, a.options, out);
}

int dressCase(const DressArguments& a) {
  checkEnding(a.output, "--output", {".json"});
  const AnyCase any = readAnyCase(a.file, a.overrides);
  const auto* c = std::get_if<Case>(&any);
  if (!c || !c->human) throw InputError({a.file.string(), 0, "human"}, "is required: whom to dress");
  checkOutput(a.output, "--output", inputsOf(any));
  useThreads(a.threads);
  const StopMessage stopped(
      "stopped by a signal; nothing is written, and dressing starts from the beginning when it is run again");
  writeDressed(dress(*c), a.output);
  fmt::print("Dressed: {}\n", a.output.string());
  return done;
}

int importCommand(const ImportArguments& a, std::ostream& out) {
  if (!a.output.empty()) checkEnding(a.output, "--output", {".json"});
  if (!a.svg.empty()) checkEnding(a.svg, "--svg", {".svg"});
  return importToFiles(a, out);
}

/// The format of each file from its name.
void chooseFormats(ExportArguments& a) {
  std::vector<std::string> allowed;
  for (const ExportFormat& f : exportFormats()) allowed.insert(allowed.end(), f.endings.begin(), f.endings.end());
  for (const std::filesystem::path& file : a.files) {
    checkPath(file, "--output");
    const std::string ending = checkEnding(file, "--output", allowed);
    for (const ExportFormat& f : exportFormats())
      if (std::find(f.endings.begin(), f.endings.end(), ending) != f.endings.end()) {
        if (!(a.options.*f.file).empty())
          throw InputError({"command line", 0, "--output"},
                           fmt::format("\"{}\" is the second file of its format", file.string()));
        a.options.*f.file = file;
      }
  }
}

/// Time and field as pictures take them.
int exportCommand(ExportArguments& a, bool tables) {
  if (tables && a.files.empty() && a.options.iges.empty() && a.options.opensim.empty()) return done;
  if (holdsCell(a.options.results))
    throw InputError({a.options.results.string(), 0, ""}, "is of a cell of yarns; allowed: results of worn cloth");
  if (!a.options.iges.empty()) checkEnding(a.options.iges, "--iges", {".igs", ".iges"});
  if (!a.options.step.empty()) checkEnding(a.options.step, "--step", {".step", ".stp"});
  const char* iges_option = a.options.iges.empty() ? "--output" : "--iges";
  const char* step_option = a.options.step.empty() ? "--output" : "--step";
  chooseFormats(a);
  JsonNode node;
  node.type = JsonNode::Type::object;
  overrideValue(node, "field", a.field);
  overrideValue(node, "time", !a.time.empty() ? a.time : a.options.glb.empty() ? "end" : "peak");
  PictureCase picture;
  const std::string none;
  schema::readObject(schema::pictureTable(), {node, "", none}, &picture);
  a.options.field = picture.field;
  a.options.when = picture.when;
  a.options.time_s = picture.time_s;
  const Paths recorded = recordedFiles(a.options.results);
  for (const auto& [file, option] :
       {std::pair{a.options.iges, iges_option}, {a.options.step, step_option}, {a.options.glb, "--output"}})
    if (!file.empty()) checkOutput(file, option, recorded);
  if (!a.options.obj.empty()) checkOutput(numbered(a.options.obj.string(), 0), "--output", recorded);
  if (!a.options.opensim.empty())
    for (const char* ending : {".xml", ".mot", ".osim", "_motion.mot"})
      checkOutput(a.options.opensim.string() + ending, "--opensim", recorded);
  return exportResults(a.options);
}

/// What --csv asks for, beside the tables that a command has left in its folder.
void writeTables(const std::filesystem::path& folder, bool must, std::ostream& out) {
  const Paths tables = folder.empty() ? Paths{} : writeEuropeanTables(folder);
  if (tables.empty() && must)
    throw InputError({"command line", 0, "--csv"}, folder.string() + " has no tables of ours");
  if (tables.empty()) return;
  out << fmt::format("{} tables with decimal commas: {}\n", tables.size(), tables.front().parent_path().string());
}

/// What films, free cameras and several runs ask for, and pictures of structures and cells do not have.
void refuseFilm(const RenderArguments& a) {
  const auto refuse = [](const std::string& option) {
    throw InputError(
        {"command line", 0, option},
        "is for worn cloth; of structures and cells there are pictures (.png) of one folder, with --field, "
        "--time, --view and --size");
  };
  if (a.request.results.size() > 1) refuse("RESULTS");
  if (FilmFormat format{}; isFilmFile(a.request.output, format)) refuse("--output");
  for (const auto& [name, text] : a.numbers)
    if (text) refuse(std::string("--") + name);
  if (a.around) refuse("--around");
  if (a.request.follow) refuse("--follow");
  if (!a.range.empty()) refuse("--range");
}

/// A picture's options go through the same table as the pictures of a case.
int render(RenderArguments& a) {
  FilmRequest& request = a.request;
  const bool film = checkEnding(request.output, "--output", {".png", ".mp4", ".webm", ".gif"}) != ".png";
  if (film && a.time)
    throw InputError({"command line", 0, "--time"}, "is for pictures (.png); a film has --from and --to");
  JsonNode node, numbers;
  node.type = numbers.type = JsonNode::Type::object;
  overrideValue(node, "field", a.field);
  overrideValue(node, "time", a.time.value_or("end"));
  overrideValue(node, "view", a.view);
  if (a.around) overrideValue(node, "around", *a.around);
  const std::size_t x = a.size.find('x');
  if (x == std::string::npos)
    throw InputError({"command line", 0, "--size"},
                     fmt::format("\"{}\" is not a size; allowed: such as 1280x960", a.size));
  overrideValue(node, "width", a.size.substr(0, x));
  overrideValue(node, "height", a.size.substr(x + 1));
  for (const auto& [name, text] : a.numbers)
    if (text) overrideValue(numbers, name, *text);
  const std::string none;
  schema::readObject(schema::pictureTable(), {node, "", none}, &request.picture);
  schema::readObject(schema::filmTable(), {numbers, "", none}, &request);
  if (!a.range.empty()) request.range = {a.range[0], a.range[1]};
  Paths recorded;
  for (const std::filesystem::path& results : request.results)
    for (const std::filesystem::path& file : recordedFiles(results)) recorded.push_back(file);
  checkOutput(request.output, "--output", recorded);
  const auto isOther = [](const std::filesystem::path& results) {
    return holdsCell(results) || holdsStructure(results);
  };
  const auto other = std::find_if(request.results.begin(), request.results.end(), isOther);
  if (other == request.results.end()) return renderFilm(request);
  refuseFilm(a);
  const PictureCase& p = request.picture;
  const RenderOptions options{*other, request.output, p.field, p.when, p.time_s, p.view, *p.width, *p.height};
  return holdsCell(*other) ? renderCellResults(options) : renderStructureResults(options);
}

}  // namespace

int runCommand(int argc, const char* const* argv, std::ostream& out, std::ostream& err) {
  CLI::App app{
      "Gambeson: what a garment costs its wearer.\n\nDresses a digital human in cloth, lets it move, and measures the "
      "joint torques that the garment adds.",
      "gambeson"};
  app.formatter(std::make_shared<HelpText>());
  app.set_version_flag("--version", "gambeson " GAMBESON_VERSION, "Prints the version");
  app.set_help_flag("-h,--help", "Prints this help");
  app.require_subcommand(1);
  app.footer(
      "Start with:\n"
      "  gambeson run cases/library/shorts_walk.json            a case of the library: a report in minutes\n"
      "  gambeson new                                           a case of your own, from five questions\n"
      "  gambeson import PATTERN -o pattern.json --svg pattern.svg   then your own: the pattern,\n"
      "  gambeson fabric CARD -o fabric.json                         the lab sheet as a card,\n"
      "  gambeson check CASE                                         the case that names both and who wears them,\n"
      "  gambeson run CASE                                           and the report (README, \"Your pattern, your "
      "cloth, your wearer\")\n\n"
      "gambeson SUBCOMMAND --help says more. The fields of a case: cases/FIELDS.md, or gambeson check --doc.");
  RunArguments run_arguments;
  NewCase new_case;
  CheckArguments check_arguments;
  DressArguments dress_arguments;
  DraftArguments draft_arguments;
  RenderArguments render_arguments;
  ReportOptions report_options;
  ExportArguments export_arguments;
  verify::Options verify_options;
  addRun(app, run_arguments);
  addNew(app, new_case);
  addDress(app, dress_arguments);
  addCheck(app, check_arguments);
  addDraft(app, draft_arguments);
  addRender(app, render_arguments);
  addReport(app, report_options);
  addExport(app, export_arguments);
  addVerify(app, verify_options);
  FabricArguments fabric_arguments;
  addFabric(app, fabric_arguments);
  ImportArguments import_arguments;
  addImport(app, import_arguments);
  HomogeniseArguments homogenise_arguments;
  addHomogenise(app, homogenise_arguments);
  StudyArguments study_arguments, batch_arguments;
  addStudy(app, study_arguments);
  addBatch(app, batch_arguments);
  gallery::Options gallery_options;
  addGallery(app, gallery_options);
  TogetherArguments together_arguments;
  addTogether(app, together_arguments);
  FinishOptions finish_options;
  addResults(app, finish_options);
  // Commands that leave tables, and where.
  std::string csv;
  const std::vector<std::pair<std::string, const std::filesystem::path*>> with_tables{
      {"run", &run_arguments.options.out},       {"study", &study_arguments.options.out},
      {"batch", &batch_arguments.options.out},   {"verify", &verify_options.out},
      {"fabric", &fabric_arguments.options.out}, {"export", &export_arguments.options.results}};
  for (const auto& [name, folder] : with_tables) addTables(*app.get_subcommand(name), csv);
  std::string subject;  // what the command works on, for messages that name no file themselves
  const auto failure = [&](const std::string& text) { err << messageText(text) << '\n'; };
  if (argc < 2) {
    err << app.help();
    return bad_input;
  }
  if (const std::string command = argv[1];
      !command.starts_with('-') &&
      app.get_subcommands([&](const CLI::App* a) { return a->get_name() == command; }).empty()) {
    failure(
        fmt::format("gambeson: there is no command \"{}\"; there are new, run, dress, check, draft, render, report, "
                    "export, verify, "
                    "study, batch, gallery, fabric, import and homogenise (see gambeson --help)",
                    command.substr(0, 80)));
    return bad_input;
  }
  const auto perform = [&] {
    app.parse(argc, argv);
    for (const auto& [path, option] : std::initializer_list<std::pair<const std::filesystem::path&, const char*>>{
             {run_arguments.file, "CASE"},
             {run_arguments.options.out, "--out"},
             {check_arguments.file, "CASE"},
             {new_case.file, "CASE"},
             {dress_arguments.file, "CASE"},
             {dress_arguments.output, "--output"},
             {draft_arguments.file, "CASE"},
             {draft_arguments.garment_file, "--output"},
             {render_arguments.request.output, "--output"},
             {report_options.results, "RESULTS"},
             {report_options.html, "--output"},
             {fabric_arguments.options.card, "CARD"},
             {fabric_arguments.options.fabric, "--output"},
             {fabric_arguments.options.out, "--out"},
             {fabric_arguments.options.loop, "--fit"},
             {import_arguments.file, "FILE"},
             {import_arguments.output, "--output"},
             {import_arguments.svg, "--svg"},
             {homogenise_arguments.file, "CELL"},
             {homogenise_arguments.law, "--output"},
             {export_arguments.options.results, "RESULTS"},
             {export_arguments.options.iges, "--iges"},
             {export_arguments.options.step, "--step"},
             {export_arguments.options.opensim, "--opensim"},
             {verify_options.dir, "--dir"},
             {verify_options.out, "--out"},
             {verify_options.results, "--results"},
             {study_arguments.file, "STUDY"},
             {study_arguments.options.out, "--out"},
             {batch_arguments.options.out, "--out"},
             {gallery_options.library, "--library"},
             {gallery_options.out, "--out"}}) {
      checkPath(path, option);
      const std::string_view name = option;
      if (!path.empty() && (name == "CASE" || name == "STUDY" || name == "RESULTS" || name == "CARD" ||
                            name == "CELL" || name == "FILE"))
        subject = path.string();
    }
    for (const auto* files : {&batch_arguments.cases, &gallery_options.files})
      for (const std::filesystem::path& file : *files) checkPath(file, "CASE");
    for (const std::filesystem::path& folder : render_arguments.request.results) {
      checkPath(folder, "RESULTS");
      subject = folder.string();
    }
    if (app.got_subcommand("run")) return run(run_arguments);
    if (app.got_subcommand("new")) {
      if (isatty(STDIN_FILENO) != 0) askForCase(new_case, std::cin, out);
      return writeNewCase(new_case, out);
    }
    if (app.got_subcommand("dress")) return dressCase(dress_arguments);
    if (app.got_subcommand("check")) return check(check_arguments, out);
    if (app.got_subcommand("draft")) return draft(draft_arguments, out);
    if (app.got_subcommand("render")) return render(render_arguments);
    if (app.got_subcommand("export")) return exportCommand(export_arguments, !csv.empty());
    if (app.got_subcommand("fabric")) return fabricCommand(fabric_arguments, out);
    if (app.got_subcommand("import")) return importCommand(import_arguments, out);
    if (app.got_subcommand("homogenise")) {
      checkEnding(homogenise_arguments.law, "--output", {".json"});
      return homogeniseCell(homogenise_arguments, out);
    }
    if (app.got_subcommand("verify")) return verify::runVerify(verify_options, out);
    for (StudyArguments* a : {&study_arguments, &batch_arguments}) takeOptions(*a, csv);
    if (app.got_subcommand("study")) return studyCommand(study_arguments, out);
    if (app.got_subcommand("together")) {
      together_arguments.options.device = deviceOf(together_arguments.device);
      return runTogether(together_arguments.options);
    }
    if (app.got_subcommand("results")) return finishApart(finish_options);
    if (app.got_subcommand("batch")) return batchCommand(batch_arguments, out);
    if (app.got_subcommand("gallery")) return gallery::runGallery(gallery_options, out);
    checkEnding(report_options.html, "--output", {".html", ".htm"});
    checkOutput(report_options.html, "--output", recordedFiles(report_options.results));
    if (holdsCell(report_options.results)) return reportCellResults(report_options);
    return holdsStructure(report_options.results) ? reportStructureResults(report_options)
                                                  : reportResults(report_options);
  };
  int status = failed;
  try {
    status = perform();
    for (const auto& [name, folder] : with_tables)
      if (!csv.empty() && status != bad_input && app.got_subcommand(name)) writeTables(*folder, name == "export", out);
  } catch (const CLI::ParseError& e) {
    std::ostringstream text;
    status = app.exit(e, out, text) == 0 ? done : bad_input;
    std::string said = text.str();
    while (said.ends_with('\n')) said.pop_back();
    if (!said.empty()) failure(said);
  } catch (const InputError& e) {
    const std::vector<InputError> all = mistakesOf(e);
    for (std::size_t i = 0; i < std::min(all.size(), kMostMistakes); ++i) {
      std::string text = all[i].what();
      std::replace(text.begin(), text.end(), '\n', ' ');
      failure(text);
    }
    if (all.size() > kMostMistakes) failure(fmt::format("... and {} more", all.size() - kMostMistakes));
    status = bad_input;
  } catch (const RunError& e) {
    failure(fmt::format("gambeson failed: {}", e.what()));
  } catch (const std::exception& e) {
    failure(fmt::format("gambeson failed: {}{}{}", subject, subject.empty() ? "" : ": ", jsonReason(e.what())));
  }
  // What was asked for on the standard output has to arrive there.
  out.flush();
  if (status == done && (!out || std::fflush(stdout) != 0 || std::ferror(stdout) != 0)) {
    failure("gambeson failed: the standard output cannot be written");
    status = failed;
  }
  return status;
}

}  // namespace gambeson
