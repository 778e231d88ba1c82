#include "cases/structure/case.hpp"

#include <fmt/format.h>

#include "cases/input/overrides.hpp"
#include "cases/structure/fields.hpp"
#include "core/error.hpp"

namespace gambeson {

namespace {

StructureCase readWith(const JsonNode& root, const std::filesystem::path& file, bool recorded) {
  const std::string name = file.string();
  const schema::Entry entry{root, "", name, recorded};
  const JsonNode* word = root.find("kind");
  std::vector<std::string> words;
  for (const auto& [w, kind] : schema::structureKinds()) words.push_back(w);
  if (!word) entry.failAt("kind", "is required: " + schema::joined(words));
  StructureCase c;
  c.kind = schema::structureKinds()[schema::readChoice(entry.member(*word), words)].second;
  for (const char* key : {"obstacles", "contact"})
    if (const JsonNode* node = root.find(key); node && c.kind != StructureKind::dynamics)
      entry.member(*node).fail(
          "goes with kind dynamic and \"scheme\": \"explicit\": equilibrium and modes know no contact");
  schema::readObject(schema::structureTable(c.kind), entry, &c);
  if (!recorded) schema::applyStructureRules(entry, c);
  c.file = file;
  return c;
}

}  // namespace

StructureCase readStructureCase(const JsonNode& root, const std::filesystem::path& file) {
  return readWith(root, file, false);
}

StructureCase readRecordedStructureCase(const std::filesystem::path& file) {
  return readWith(readCaseNode(file, {}), file, true);
}

StructureCase readStructureCase(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  StructureCase c = readStructureCase(readCaseNode(file, overrides), file);
  c.overrides = overrides;
  return c;
}

std::string writeCase(const StructureCase& c) {
  return schema::toText(schema::writeObject(schema::structureTable(c.kind), &c)) + "\n";
}

}  // namespace gambeson
