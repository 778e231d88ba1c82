#include "cases/runs/european_tables.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

#include "core/error.hpp"
#include "core/io/csv_text.hpp"
#include "core/io/own_file.hpp"

namespace gambeson {
namespace {

namespace fs = std::filesystem;

std::string contentOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw RunError(file.string() + " cannot be read");
  return text.str();
}

}  // namespace

std::vector<fs::path> writeEuropeanTables(const fs::path& folder) {
  std::vector<fs::path> folders{folder};
  std::error_code error;
  for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (!it->is_directory(error) || it->is_symlink(error)) continue;
    if (it->path().filename() == kEuropeanTables)
      it.disable_recursion_pending();
    else
      folders.push_back(it->path());
  }
  std::sort(folders.begin(), folders.end());
  std::vector<fs::path> written;
  for (const fs::path& f : folders)
    for (const fs::path& table : ownFiles(f)) {
      if (table.extension() != ".csv") continue;
      const fs::path to = f / kEuropeanTables;
      fs::create_directory(to, error);
      if (error) throw RunError(to.string() + " cannot be made: " + error.message());
      writeOwnFile(to / table.filename(), europeanCsv(contentOf(f / table.filename())));
      written.push_back(to / table.filename());
    }
  return written;
}

}  // namespace gambeson
