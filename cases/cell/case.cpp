#include "cases/cell/case.hpp"

#include "cases/cell/fields.hpp"
#include "cases/input/fingerprint.hpp"
#include "cases/input/overrides.hpp"

namespace gambeson {
namespace {

CellCase readWith(const JsonNode& root, const std::filesystem::path& file, bool recorded) {
  const std::string name = file.string();
  const schema::Entry entry{root, "", name, recorded};
  CellCase c;
  schema::readObject(schema::cellTable(), entry, &c);
  if (!recorded) schema::applyCellRules(entry, c);
  c.file = file;
  return c;
}

}  // namespace

CellCase readCellCase(const JsonNode& root, const std::filesystem::path& file) { return readWith(root, file, false); }

CellCase readRecordedCellCase(const std::filesystem::path& file) {
  return readWith(readCaseNode(file, {}), file, true);
}

CellCase readCellCase(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  CellCase c = readCellCase(readCaseNode(file, overrides), file);
  c.overrides = overrides;
  return c;
}

std::string writeCase(const CellCase& c) { return schema::toText(schema::writeObject(schema::cellTable(), &c)) + "\n"; }

std::string caseIdentity(const CellCase& c) {
  Fingerprint hash;
  hash.add(writeCase(c));
  return hash.text();
}

std::vector<std::filesystem::path> inputsOf(const CellCase& c) { return {c.file}; }

}  // namespace gambeson
