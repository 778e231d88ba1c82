#include "cases/study/maker.hpp"

#include <fmt/format.h>

#include <cctype>

#include "cases/input/mistakes.hpp"
#include "cases/input/table.hpp"
#include "cases/study/files.hpp"
#include "core/error.hpp"

namespace gambeson::study {

using schema::Entry;

void tooMany(const Entry& at) { at.fail("more than 2,000 variants; allowed: at most 2,000 together"); }

/// What a folder's name may have.
std::string safe(const std::string& text) {
  std::string s;
  for (const char c : text)
    s += (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+'
             ? c
             : '_';
  return s;
}

std::vector<Setting> settingsOf(const Entry& entry) {
  if (entry.node.type != JsonNode::Type::object)
    entry.fail("expected an object { } of path: value, not " + describe(entry.node));
  if (entry.node.children.empty()) entry.fail("is empty; allowed: at least one path: value");
  std::vector<Setting> all;
  for (const JsonNode& child : entry.node.children) all.push_back({child.key, child});
  return all;
}

Maker::Maker(const schema::Entry& entry, const StudyInput& in, Study& study) : entry_(entry), in_(in), study_(study) {
  base_ = readJson(in.file);
  if (in.set.type != JsonNode::Type::null) common_ = settingsOf(entry.member(*entry.node.find("set")));
}

void Maker::add(std::vector<int> levels, const std::vector<Setting>& more, const std::string& extra_label,
                const schema::Entry& at) {
  Variant v;
  v.levels = std::move(levels);
  v.grid = more.empty();
  JsonNode root = base_;
  std::vector<Setting> all = common_;
  for (std::size_t a = 0; a < study_.axes.size(); ++a) {
    const Axis& axis = study_.axes[a];
    const Level& level = axis.levels[static_cast<std::size_t>(v.levels[a])];
    all.insert(all.end(), level.set.begin(), level.set.end());
    v.folder += (v.folder.empty() ? "" : "__") + level.folder;
    v.label += (v.label.empty() ? "" : ", ") + level.name;
  }
  all.insert(all.end(), more.begin(), more.end());
  if (!extra_label.empty()) {
    v.folder += (v.folder.empty() ? "" : "__") + safe(extra_label);
    v.label += (v.label.empty() ? "" : ", ") + extra_label;
  }
  if (const std::string why = files::unfitFolder(v.folder); !why.empty()) at.fail(fmt::format("a variant {}", why));
  if (!folders_.insert(v.folder).second)
    at.fail(fmt::format("there are two variants {}; allowed: labels that differ", v.label));
  if (study_.variants.size() >= most_variants) tooMany(at);
  try {
    for (const Setting& s : all) overrideValue(root, s.path, s.value, entry_.file);
    v.definition = readAnyCase(root, in_.file);
  } catch (const InputError& e) {
    Mistakes of_variant;
    for (const InputError& one : mistakesOf(e))
      of_variant.add(InputError(one.where(), fmt::format("{} (variant {})", one.reason(), v.label)));
    of_variant.say();
  }
  introduce(v);
  identify(v);
  study_.variants.push_back(std::move(v));
}

void Maker::identify(Variant& v) {
  v.identity = std::visit([](const auto& c) { return caseIdentity(c); }, v.definition);
  if (const auto* c = std::get_if<Case>(&v.definition)) {
    Case rest = *c;
    rest.factors = {};
    rest.name = "rest";
    v.rest_identity = caseIdentity(rest);
  }
}

void Maker::introduce(Variant& v) const {
  const bool ends = study_.name.ends_with('?') || study_.name.ends_with('!') || study_.name.ends_with('.');
  std::string label = v.label;
  if (ends && !label.empty()) label[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(label[0])));
  std::visit(
      [&](auto& c) {
        c.name = study_.name + (ends ? " " : ": ") + label;
        c.description = fmt::format("One run of the study \"{}\".{}{}", study_.name,
                                    study_.description.empty() ? "" : " ", study_.description);
      },
      v.definition);
}

}  // namespace gambeson::study
