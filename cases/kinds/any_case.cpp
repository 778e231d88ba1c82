#include "cases/kinds/any_case.hpp"

#include <fmt/format.h>

#include "cases/cell/fields.hpp"
#include "cases/input/mistakes.hpp"
#include "cases/input/overrides.hpp"
#include "cases/structure/fields.hpp"
#include "cases/wear/case/fields.hpp"

namespace gambeson {

std::vector<schema::KindOfFile> kindsOfCase() {
  std::vector<schema::KindOfFile> kinds{{"wear", &schema::caseTable()}};
  for (const auto& [word, kind] : schema::structureKinds()) kinds.push_back({word, &schema::structureTable(kind)});
  kinds.push_back({"cell", &schema::cellTable()});
  return kinds;
}

namespace {

/// The kinds of case that have this key at the top, "" where none has.
std::string kindsWith(const std::string& key) {
  std::vector<std::string> words;
  for (const schema::KindOfFile& k : kindsOfCase())
    if (k.root->find(key)) words.push_back(k.kind);
  return schema::joined(words);
}

AnyCase readOfItsKind(const JsonNode& root, const std::filesystem::path& file) {
  const JsonNode* kind = root.find("kind");
  if (!kind) return readCase(root, file);
  std::vector<std::string> words;
  for (const schema::KindOfFile& k : kindsOfCase()) words.push_back(k.kind);
  const std::string name = file.string();
  const schema::Entry entry{root, "", name};
  const std::size_t which = schema::readChoice(entry.member(*kind), words);
  if (which == 0) return readCase(root, file);
  if (words[which] == "cell") return readCellCase(root, file);
  return readStructureCase(root, file);
}

}  // namespace

AnyCase readAnyCase(const JsonNode& root, const std::filesystem::path& file) {
  try {
    return readOfItsKind(root, file);
  } catch (const InputErrors& errors) {
    Mistakes hinted;
    for (const InputError& e : errors.all()) {
      const std::string kinds = e.reason().starts_with(kUnknownKey) ? kindsWith(e.where().key) : "";
      hinted.add(kinds.empty() ? e
                               : InputError(e.where(), fmt::format("{}cases of \"kind\" {} have it; {}", kUnknownKey,
                                                                   kinds, e.reason().substr(kUnknownKey.size()))));
    }
    hinted.say();
    throw;
  }
}

AnyCase readAnyCase(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  AnyCase any = readAnyCase(readCaseNode(file, overrides), file);
  std::visit([&](auto& c) { c.overrides = overrides; }, any);
  return any;
}

std::vector<std::filesystem::path> inputsOf(const AnyCase& any) {
  return std::visit([](const auto& c) { return inputsOf(c); }, any);
}

}  // namespace gambeson
