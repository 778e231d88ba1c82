#include "cases/any_case.hpp"

#include "cases/fields.hpp"
#include "cases/structure_fields.hpp"
#include "cases/study/study.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

std::vector<schema::KindOfFile> allKinds() {
  std::vector<schema::KindOfFile> kinds{{"wear", &schema::caseTable()}};
  for (const auto& [word, kind] : schema::structureKinds()) kinds.push_back({word, &schema::structureTable(kind)});
  return kinds;
}

}  // namespace

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

AnyCase readAnyCase(const JsonNode& root, const std::filesystem::path& file) {
  const JsonNode* kind = root.find("kind");
  if (!kind) return readCase(root, file);
  std::vector<std::string> words;
  for (const schema::KindOfFile& k : allKinds()) words.push_back(k.kind);
  const std::string name = file.string();
  const schema::Place place{root, "", name};
  if (schema::readChoice(place.member(*kind), words) == 0) return readCase(root, file);
  return readStructureCase(root, file);
}

AnyCase readAnyCase(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  AnyCase any = readAnyCase(readCaseNode(file, overrides), file);
  std::visit([&](auto& c) { c.overrides = overrides; }, any);
  return any;
}

std::string caseSchema() { return schema::jsonSchema(allKinds()); }
std::string caseFields() { return schema::markdown(allKinds()) + schema::chapter("Studies", study::studyTable()); }

}  // namespace gambeson
