#pragma once
/// `gambeson gallery`: a page about many cases and studies: of each its picture, its question, its answer.

#include <filesystem>
#include <iosfwd>
#include <string>
#include <utility>
#include <vector>

#include "analysis/report/page_top.hpp"
#include "cases/study/study.hpp"

namespace gambeson::gallery {

struct Options {
  std::vector<std::filesystem::path> files;  ///< cases and studies; empty: those of a library
  std::filesystem::path library;             ///< its folder; empty: findLibrary()
  std::filesystem::path out;                 ///< takes gallery.html and a folder for each
  int jobs = 0;                              ///< at a time; 0: as many as there are threads
  int threads = 0;                           ///< of all jobs together; 0: as many as the machine has
  std::string binary = "/proc/self/exe";     ///< the command that runs a case
};

/// A file that is no exhibit, and why.
using LeftOut = std::pair<std::filesystem::path, std::string>;

/// What is to be shown, read and checked.
struct Chosen {
  study::Study cases;  ///< as a batch
  std::vector<study::Study> studies;
  std::vector<LeftOut> left_out;
};

/// The folder of cases that came with the program: share/gambeson/library or cases/library beside it or beside a folder
/// above it. Throws InputError where there is none.
std::filesystem::path findLibrary(const std::filesystem::path& program);

/// The cases and studies of a folder, and why its other files are none. Throws InputError where the folder has no case,
/// or one that is not valid.
Chosen chooseLibrary(const std::filesystem::path& folder);

/// Throws InputError: what is no valid case or study, two of one name.
Chosen chooseFiles(const std::vector<std::filesystem::path>& files);

/// The folder of a study in that of the gallery.
std::string folderOf(const study::Study& study);

enum class Sort { worn, cloth, structure, cell, study };

/// What stands on the page of one case or study.
struct Exhibit {
  Sort sort = Sort::worn;
  std::string folder, title, description;
  std::string failed;  ///< why its run failed; empty where it did not
  PageTop top;
  std::string no_page;  ///< why there is no report to link to; empty where there is one
};

/// What a description asks, in its own words; where it asks nothing, its first sentence, which says what is shown.
struct Question {
  std::string text;
  bool asked = false;
};
Question questionOf(const std::string& description);

/// The whole page; links are relative to the folder of the gallery.
std::string formatGallery(const std::vector<Exhibit>& exhibits, const std::vector<LeftOut>& left_out);

/// Exit status: 0 all are done, 1 some failed.
int runGallery(const Options& options, std::ostream& out);

}  // namespace gambeson::gallery
