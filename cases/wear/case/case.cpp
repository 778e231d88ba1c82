#include "cases/wear/case/case.hpp"

#include "cases/input/overrides.hpp"
#include "cases/wear/case/fields.hpp"
#include "cases/wear/case/references.hpp"
#include "cases/wear/case/rules.hpp"
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
