#pragma once
/// What each command of the command line is told, and the options that tell it.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cases/command/new_case.hpp"
#include "cases/fabric/run.hpp"
#include "cases/gallery/gallery.hpp"
#include "cases/homogenise/homogenise.hpp"
#include "cases/pattern/import.hpp"
#include "cases/study/run.hpp"
#include "cases/verify/verify.hpp"
#include "cases/wear/results/film.hpp"
#include "cases/wear/run/export.hpp"
#include "cases/wear/run/run.hpp"
#include "cases/wear/run/together.hpp"

namespace gambeson {

struct CheckArguments {
  std::filesystem::path file;
  std::vector<std::string> overrides;
  bool full = false, schema = false, doc = false;
};

struct RunArguments {
  std::filesystem::path file;
  std::vector<std::string> overrides;
  std::string device = "auto";
  RunOptions options;
};

struct DressArguments {
  std::filesystem::path file, output;
  std::vector<std::string> overrides;
  int threads = 0;
};

struct DraftArguments {
  std::filesystem::path file, garment_file;
  std::vector<std::string> overrides;
  std::string garment;
  bool obj = false, flat = false;
};

struct RenderArguments {
  FilmRequest request;
  std::string field = "stress", view = "front_right", size = "1280x960";
  std::optional<std::string> time, around;
  /// Of those that are given: what schema::filmTable reads.
  std::vector<std::pair<const char*, std::optional<std::string>>> numbers{
      {"from", {}}, {"to", {}}, {"fps", {}}, {"azimuth", {}}, {"elevation", {}}, {"zoom", {}}};
  std::vector<double> range;
};

struct ExportArguments {
  ExportOptions options;
  std::vector<std::filesystem::path> files;
  std::string field = "stress", time;
};

struct FabricArguments {
  FabricOptions options;
  std::vector<std::string> tests;
  std::string model = "nurbs", mesh = "single", bending = "midedge";
};

struct StudyArguments {
  std::filesystem::path file;
  std::vector<std::filesystem::path> cases;
  std::string engine = "local", device = "auto";
  bool check = false;
  study::Options options;
};

struct TogetherArguments {
  TogetherOptions options;
  std::string device = "reference";
};

/// Each adds one command, whose options fill what it is told.
void addRun(CLI::App& app, RunArguments& a);
void addNew(CLI::App& app, NewCase& answers);
void addDress(CLI::App& app, DressArguments& a);
void addCheck(CLI::App& app, CheckArguments& a);
void addDraft(CLI::App& app, DraftArguments& a);
void addRender(CLI::App& app, RenderArguments& a);
void addReport(CLI::App& app, ReportOptions& options);
void addExport(CLI::App& app, ExportArguments& a);
void addFabric(CLI::App& app, FabricArguments& a);
void addImport(CLI::App& app, ImportArguments& a);
void addHomogenise(CLI::App& app, HomogeniseArguments& a);
void addVerify(CLI::App& app, verify::Options& o);
void addStudy(CLI::App& app, StudyArguments& a);
void addBatch(CLI::App& app, StudyArguments& a);
void addGallery(CLI::App& app, gallery::Options& o);
/// --csv, of a command that leaves tables.
void addTables(CLI::App& command, std::string& csv);
/// What `study` starts; no help names them.
void addTogether(CLI::App& app, TogetherArguments& a);
void addResults(CLI::App& app, FinishOptions& options);

}  // namespace gambeson
