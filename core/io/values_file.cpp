#include "core/io/values_file.hpp"

#include "core/io/own_file.hpp"
#include "core/io/segment.hpp"

namespace gambeson {

void writeValues(const std::filesystem::path& file, const std::string& identity,
                 const std::map<std::string, Values>& values) {
  RecordingLayout layout;
  layout.identity = identity;
  layout.scene = values;
  writeOwnFile(file, layoutImage(layout));
}

std::optional<std::map<std::string, Values>> readValues(const std::filesystem::path& file,
                                                        const std::string& identity) {
  if (!std::filesystem::exists(file)) return {};
  RecordingLayout layout = layoutIn(file);
  if (layout.identity != identity) return {};
  return std::move(layout.scene);
}

}  // namespace gambeson
