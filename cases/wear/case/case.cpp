#include "cases/wear/case/case.hpp"

#include "cases/input/overrides.hpp"
#include "cases/wear/case/fields.hpp"
#include "cases/wear/case/references.hpp"
#include "cases/wear/case/rules.hpp"
#include "core/error.hpp"
#include "core/motion/step_control.hpp"

namespace gambeson {

namespace {

Case readWith(const JsonNode& root, const std::filesystem::path& file, bool recorded) {
  Case c;
  const std::string name = file.string();
  const schema::Entry entry{root, "", name, recorded};
  schema::readObject(schema::caseTable(), entry, &c);
  if (!recorded) {
    schema::applyRules(entry, c);
    schema::checkReferences(entry, c);
  }
  c.file = file;
  return c;
}

}  // namespace

Case readCase(const JsonNode& root, const std::filesystem::path& file) { return readWith(root, file, false); }

Case readRecordedCase(const std::filesystem::path& file) { return readWith(readCaseNode(file, {}), file, true); }

Case readCase(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  Case c = readCase(readCaseNode(file, overrides), file);
  c.overrides = overrides;
  return c;
}

StepControl TimeCase::control() const {
  StepControl control;
  control.safety = step_safety;
  control.max_step_s = max_step_s;
  control.fixed_s = step_s;
  control.audits_energy = auditsEnergy();
  return control;
}

std::string writeCase(const Case& c) { return schema::toText(schema::writeObject(schema::caseTable(), &c)) + "\n"; }

}  // namespace gambeson
