#include "cases/case.hpp"

#include "cases/any_case.hpp"
#include "cases/fields.hpp"
#include "cases/references.hpp"
#include "cases/rules.hpp"
#include "core/error.hpp"

namespace gambeson {

Case readCase(const JsonNode& root, const std::filesystem::path& file) {
  Case c;
  const std::string name = file.string();
  const schema::Place place{root, "", name};
  schema::readObject(schema::caseTable(), place, &c);
  schema::applyRules(place, c);
  schema::checkReferences(place, c);
  c.file = file;
  return c;
}

Case readCase(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  Case c = readCase(readCaseNode(file, overrides), file);
  c.overrides = overrides;
  return c;
}

std::string writeCase(const Case& c) { return schema::toText(schema::writeObject(schema::caseTable(), &c)) + "\n"; }

}  // namespace gambeson
