#include "cases/input/overrides.hpp"

#include "core/error.hpp"

namespace gambeson {

JsonNode readCaseNode(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  JsonNode root = readJson(file);
  for (const std::string& text : overrides) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      throw InputError({"command line", 0, text},
                       "write --set path=value, for example --set fabric.thickness=\"0.4 mm\"");
    overrideValue(root, text.substr(0, equals), text.substr(equals + 1));
  }
  return root;
}

}  // namespace gambeson
