/// Detail of gallery.hpp: which cases and studies are shown, and why other files of a library are not.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "cases/gallery/gallery.hpp"
#include "cases/input/json.hpp"
#include "cases/study/files.hpp"
#include "core/error.hpp"

namespace gambeson::gallery {
namespace {

using Path = std::filesystem::path;

constexpr std::string_view kStudy = ".study.json", kCard = ".card.json";

bool endsWith(const Path& file, std::string_view ending) { return file.filename().string().ends_with(ending); }

/// By what only cases have; patterns, laws and cards are JSON too.
bool isCase(const Path& file) {
  const JsonNode root = readJson(file);
  const auto has = [&](const char* key) { return root.find(key) != nullptr; };
  return root.type == JsonNode::Type::object && (has("kind") || has("garment") || has("garments"));
}

Chosen read(const std::vector<Path>& cases, const std::vector<Path>& studies) {
  Chosen chosen;
  chosen.cases = study::batchOf(cases);
  std::map<std::string, Path> seen;
  for (const Path& file : studies) {
    chosen.studies.push_back(study::readStudy(file));
    const std::string name = folderOf(chosen.studies.back());
    if (const auto [other, fresh] = seen.insert({name, file}); !fresh)
      throw InputError({"command line", 0, file.string()},
                       fmt::format("has the same name as {}; allowed: studies whose files have names of their own",
                                   other->second.string()));
    if (const std::string why = study::files::unfitFolder(name); !why.empty())
      throw InputError({"command line", 0, file.string()}, fmt::format("a study {}", why));
  }
  for (const study::Variant& v : chosen.cases.variants) {
    const Path file = std::visit([](const auto& c) { return c.file; }, v.definition);
    if (const auto other = seen.find(v.folder); other != seen.end() || v.folder == "gallery.html")
      throw InputError(
          {"command line", 0, file.string()},
          "has the name of another file of the gallery; allowed: cases whose files have names of their own");
  }
  return chosen;
}

}  // namespace

std::string folderOf(const study::Study& study) { return study.file.stem().string(); }

std::filesystem::path findLibrary(const std::filesystem::path& program) {
  std::error_code error;
  for (Path above = program.parent_path(); above != above.root_path(); above = above.parent_path())
    for (const char* folder : {"share/gambeson/library", "cases/library"})
      if (std::filesystem::is_directory(above / folder, error)) return above / folder;
  throw InputError({"command line", 0, "--library"},
                   "no library of cases is beside the program; allowed: its folder, or CASE, the cases to show");
}

Chosen chooseLibrary(const std::filesystem::path& folder) {
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error))
    throw InputError({"command line", 0, "--library"}, fmt::format("there is no folder {}", folder.string()));
  std::vector<Path> files, cases, studies, others;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && !entry.path().filename().string().starts_with('.')) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const Path& file : files) {
    const bool at_top = file.parent_path() == folder;
    (endsWith(file, kStudy)                                                            ? studies
     : at_top && file.extension() == ".json" && !endsWith(file, kCard) && isCase(file) ? cases
                                                                                       : others)
        .push_back(file);
  }
  if (cases.empty() && studies.empty())
    throw InputError({"command line", 0, "--library"}, fmt::format("{} holds no cases", folder.string()));
  Chosen chosen = read(cases, studies);
  std::map<Path, std::vector<std::string>> part_of;
  for (const study::Variant& v : chosen.cases.variants)
    for (const Path& input : inputsOf(v.definition)) part_of[input.lexically_normal()].push_back(v.folder);
  for (const Path& file : others) {
    const auto uses = part_of.find(file.lexically_normal());
    std::string why = "no case and no study: nothing of it can be run";
    if (endsWith(file, kCard)) {
      std::string name = file.stem().string();
      name.resize(name.size() - 5);
      why = fmt::format("a fabric card: gambeson fabric {} shows what it measures", name);
    } else if (uses != part_of.end()) {
      why = fmt::format("a part of {}", fmt::join(uses->second, ", "));
    } else if (file.extension() == ".png") {
      why = "a picture";
    }
    chosen.left_out.emplace_back(file.lexically_relative(folder), why);
  }
  return chosen;
}

Chosen chooseFiles(const std::vector<std::filesystem::path>& files) {
  std::vector<Path> cases, studies;
  for (const Path& file : files) (endsWith(file, kStudy) ? studies : cases).push_back(file);
  return read(cases, studies);
}

}  // namespace gambeson::gallery
