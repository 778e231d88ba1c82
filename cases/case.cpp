#include "cases/case.hpp"

#include "cases/fields.hpp"
#include "cases/references.hpp"
#include "cases/rules.hpp"
#include "core/error.hpp"

namespace gambeson {

Case readCase(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  JsonNode root = readJson(file);
  for (const std::string& text : overrides) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      throw InputError({"command line", 0, text},
                       "write --set path=value, for example --set fabric.thickness=\"0.4 mm\"");
    overrideValue(root, text.substr(0, equals), text.substr(equals + 1));
  }
  Case c;
  const std::string name = file.string();
  const schema::Place place{root, "", name};
  schema::readObject(schema::caseTable(), place, &c);
  schema::applyRules(place, c);
  schema::checkReferences(place, c);
  c.file = file;
  c.overrides = overrides;
  return c;
}

std::string writeCase(const Case& c) { return schema::toText(schema::writeObject(schema::caseTable(), &c)) + "\n"; }

}  // namespace gambeson
