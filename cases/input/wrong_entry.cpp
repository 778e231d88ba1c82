#include "cases/input/wrong_entry.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "cases/input/overrides.hpp"

namespace gambeson {
namespace {

std::string withoutUnit(const std::string& name) {
  static constexpr std::array<std::string_view, 9> units{"_N_per_m2", "_kg_per_m_s", "_rad", "_Pa", "_Nm",
                                                         "_kg",       "_m",          "_N",   "_s"};
  for (const std::string_view unit : units)
    if (name.size() > unit.size() && name.ends_with(unit)) return name.substr(0, name.size() - unit.size());
  return name;
}

/// "supports[0].edge" -> "supports", "[0]", "edge"; an index that is no number ends it.
std::vector<std::string> stepsOf(const std::string& key) {
  std::vector<std::string> steps;
  for (std::size_t at = 0; at < key.size();) {
    const std::size_t end = std::min(key.find_first_of(".[", at + 1), key.size());
    steps.push_back(key.substr(at, end - at));
    at = end + (end < key.size() && key[end] == '.' ? 1 : 0);
  }
  return steps;
}

const JsonNode* childOf(const JsonNode& node, const std::string& step) {
  if (step[0] != '[') return node.find(step);
  const std::string digits = step.substr(1, step.find(']') - 1);
  if (node.type != JsonNode::Type::list || digits.empty() || digits.size() > 9 ||
      !std::all_of(digits.begin(), digits.end(), [](unsigned char c) { return std::isdigit(c); }))
    return nullptr;
  const std::size_t i = std::stoul(digits);
  return i < node.children.size() ? &node.children[i] : nullptr;
}

}  // namespace

std::string keyUnder(const std::string& outer, const std::string& inner) {
  const std::string last = outer.substr(outer.rfind('.') + 1);
  if (inner.empty() || inner == last || inner.starts_with("garment.")) return outer;
  if (inner.starts_with(last + ".")) return outer + withoutUnit(inner.substr(last.size()));
  return outer + "." + withoutUnit(inner);
}

void sayAt(const schema::Entry& root, const InputError& e) {
  if (!e.where().file.empty()) throw e;
  std::vector<std::string> steps = stepsOf(e.where().key);
  if (steps.size() > 1 && steps[0] == "garments" && steps[1] == "[0]" && !root.node.find("garments")) {
    steps.erase(steps.begin());
    steps[0] = "garment";
  }
  const JsonNode* node = &root.node;
  std::string path = root.path, file = root.file, rest;
  for (const std::string& step : steps) {
    const JsonNode* next = rest.empty() ? childOf(*node, step) : nullptr;
    std::string& to = next ? path : rest;
    to += (step[0] == '[' || to.empty() ? "" : ".") + step;
    if (!next) continue;
    node = next;
    if (node->file) file = *node->file;
  }
  schema::Entry{*node, path, file}.fail(rest.empty() || rest == "sheet" ? e.reason() : rest + ": " + e.reason());
}

void sayInCase(const std::filesystem::path& file, const std::vector<std::string>& overrides, const InputError& e) {
  if (!e.where().file.empty()) throw e;
  const std::string name = file.string();
  JsonNode root;
  try {
    root = readCaseNode(file, overrides);
  } catch (const InputError&) {  // a case of a program's own, or gone since
    throw InputError({name, 0, e.where().key}, e.reason());
  }
  sayAt({root, "", name}, e);
}

}  // namespace gambeson
