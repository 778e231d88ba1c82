#include "cases/study/make_variant.hpp"

#include <fmt/format.h>

#include <cctype>

#include "cases/input/mistakes.hpp"
#include "core/error.hpp"

namespace gambeson::study {
namespace {

/// The name and description of the case tell its own motion, which a variant may replace: a variant has the study's.
void introduce(const Study& study, Variant& v) {
  const bool ends = study.name.ends_with('?') || study.name.ends_with('!') || study.name.ends_with('.');
  std::string label = v.label;
  if (ends && !label.empty()) label[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(label[0])));
  std::visit(
      [&](auto& c) {
        c.name = study.name + (ends ? " " : ": ") + label;
        c.description = fmt::format("One run of the study \"{}\".{}{}", study.name,
                                    study.description.empty() ? "" : " ", study.description);
      },
      v.definition);
}

}  // namespace

std::string folderName(const std::string& text) {
  std::string s;
  for (const char c : text)
    s += (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+'
             ? c
             : '_';
  return s;
}

void defineVariant(const Study& study, JsonNode& root, const std::filesystem::path& case_file,
                   const std::vector<Setting>& set, Variant& v) {
  try {
    for (const Setting& s : set) overrideValue(root, s.path, s.value, study.file.string());
    v.definition = readAnyCase(root, case_file);
  } catch (const InputError& e) {
    Mistakes of_variant;
    for (const InputError& one : mistakesOf(e))
      of_variant.add(InputError(one.where(), fmt::format("{} (variant {})", one.reason(), v.label)));
    of_variant.say();
  }
  introduce(study, v);
  identify(v);
}

void identify(Variant& v) {
  v.identity = std::visit([](const auto& c) { return caseIdentity(c); }, v.definition);
  if (const auto* c = std::get_if<Case>(&v.definition)) {
    Case rest = *c;
    rest.factors = {};
    rest.name = "rest";
    v.rest_identity = caseIdentity(rest);
  }
}

}  // namespace gambeson::study
