#include "cases/runs/recorded_case.hpp"

#include <fstream>
#include <iterator>

#include "core/error.hpp"

namespace gambeson {

std::filesystem::path caseFile(const std::filesystem::path& dir) {
  if (!std::filesystem::exists(dir / "case.json"))
    throw InputError({dir.string(), 0, ""}, "holds no results: there is no case.json as \"gambeson run\" leaves it");
  return dir / "case.json";
}

void requireRecordedCase(const std::filesystem::path& dir, const RecordingLayout& recorded) {
  const std::filesystem::path file = caseFile(dir);
  std::ifstream stream(file, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  if (text != recorded.metadata)
    throw InputError({file.string(), 0, ""}, "is not the case that was recorded in " + (dir / "frames").string() +
                                                 ": one of the two is of another run, or was changed; allowed: both "
                                                 "as \"gambeson run\" left them");
}

}  // namespace gambeson
