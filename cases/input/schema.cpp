#include "cases/input/schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cases/input/message.hpp"
#include "cases/input/units.hpp"
#include "core/error.hpp"

namespace gambeson::schema {
namespace {

std::string withUnit(double x, const std::string& unit) {
  return unit.empty() ? fmt::format("{}", x) : fmt::format("{} {}", x, unit);
}

/// Edits (insert, delete, replace) that make `a` into `b`: Levenshtein's distance.
std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

/// "did you mean "x"?", or the list of what is allowed.
std::string hint(std::string_view wrong, const std::vector<std::string>& words) {
  const std::string near = closest(wrong, words);
  return near.empty() ? "allowed: " + joined(words) : fmt::format("did you mean \"{}\"?", near);
}

std::vector<std::string> keysOf(const Object& object, const std::string* alternatives = nullptr) {
  std::vector<std::string> keys;
  for (const Field& f : object.fields)
    if (!alternatives || f.alternatives == *alternatives) keys.push_back(f.key);
  return keys;
}

}  // namespace

std::string Range::text(const std::string& unit) const {
  const bool has_low = std::isfinite(low), has_high = std::isfinite(high);
  std::string s;
  if (has_low) s = fmt::format("{} {}", low_open ? ">" : ">=", low);
  if (has_high) s += fmt::format("{}{} {}", has_low ? " and " : "", high_open ? "<" : "<=", high);
  if (s.empty()) return "any";
  return unit.empty() ? s : s + " " + unit;
}

void Entry::fail(const std::string& reason) const {
  const bool from_command_line = node.line == 0;
  throw InputError({from_command_line ? "command line" : file, node.line, path}, reason);
}

void Entry::failAt(const std::string& key, const std::string& reason) const {
  const JsonNode* child = node.find(key);
  if (child) member(*child).fail(reason);
  Entry{node, (path.empty() ? "" : path + ".") + key, file}.fail(reason);
}

Entry Entry::member(const JsonNode& child) const {
  return {child, (path.empty() ? "" : path + ".") + child.key, child.file ? *child.file : file, recorded};
}

Entry Entry::item(std::size_t index) const {
  const JsonNode& child = node.children[index];
  return {child, fmt::format("{}[{}]", path, index), child.file ? *child.file : file, recorded};
}

const Field* Object::find(std::string_view key) const {
  for (const Field& f : fields)
    if (f.key == key) return &f;
  return nullptr;
}

void readObject(const Object& object, const Entry& entry, void* target) {
  const JsonNode& node = entry.node;
  if (node.type != JsonNode::Type::object)
    entry.fail(fmt::format("expected an object {{ }} with {}, not {}", joined(keysOf(object)), describe(node)));
  for (const JsonNode& child : node.children)
    if (!object.find(child.key)) entry.member(child).fail("unknown key; " + hint(child.key, keysOf(object)));
  for (const Alternatives& alternatives : object.alternatives) {
    const JsonNode* first = nullptr;
    for (const JsonNode& child : node.children) {
      if (object.find(child.key)->alternatives != alternatives.name) continue;
      if (first) entry.member(child).fail(fmt::format("excludes \"{}\"; give only one of them", first->key));
      first = &child;
    }
    if (alternatives.required && !first)
      entry.fail(fmt::format("one of {} is required", joined(keysOf(object, &alternatives.name))));
  }
  for (const Field& field : object.fields) {
    const JsonNode* child = node.find(field.key);
    if (child)
      field.read(entry.member(*child), target);
    else if (field.required)
      entry.failAt(field.key, "is required: " + field.doc);
  }
  if (object.check) object.check(entry, target);
}

JsonNode writeObject(const Object& object, const void* source) {
  JsonNode node;
  node.type = JsonNode::Type::object;
  for (const Field& field : object.fields) {
    std::optional<JsonNode> value = field.write(source);
    if (!value) continue;
    value->key = field.key;
    node.children.push_back(std::move(*value));
  }
  return node;
}

double readNumber(const Entry& entry, const std::string& unit, const Range& range) {
  double x = 0;
  if (entry.node.type == JsonNode::Type::number) {
    x = entry.node.number;
  } else if (entry.node.type == JsonNode::Type::text) {
    try {
      x = parseQuantity(entry.node.text, unit);
    } catch (const InputError& e) {
      entry.fail(e.reason() + "; allowed: " + range.text(unit));
    }
  } else {
    entry.fail(fmt::format("expected a number{}, not {}; allowed: {}",
                           unit.empty() ? "" : fmt::format(" in {} or a text with a unit", unit), describe(entry.node),
                           range.text(unit)));
  }
  if (!std::isfinite(x) || !range.contains(x))
    entry.fail(fmt::format("{} is out of range; allowed: {}", withUnit(x, unit), range.text(unit)));
  return x;
}

int readInteger(const Entry& entry, const Range& range) {
  if (entry.node.type != JsonNode::Type::number || entry.node.number != std::floor(entry.node.number))
    entry.fail(fmt::format("expected a whole number, not {}; allowed: {}", describe(entry.node), range.text()));
  if (!range.contains(entry.node.number) || std::abs(entry.node.number) > 1e9)
    entry.fail(fmt::format("{} is out of range; allowed: {}", entry.node.number, range.text()));
  return static_cast<int>(entry.node.number);
}

bool readBoolean(const Entry& entry) {
  if (entry.node.type != JsonNode::Type::boolean)
    entry.fail(fmt::format("expected true or false, not {}", describe(entry.node)));
  return entry.node.boolean;
}

const std::string& readText(const Entry& entry) {
  if (entry.node.type != JsonNode::Type::text)
    entry.fail(fmt::format("expected a text in quotes, not {}", describe(entry.node)));
  if (entry.node.text.empty()) entry.fail("the text is empty");
  // Names, labels and paths have no control characters; what is prose may have several lines.
  const std::string_view key = std::string_view(entry.path).substr(entry.path.rfind('.') + 1);
  const bool prose = key == "description" || key == "doc" || key == "note" || key == "source";
  if (const std::string why = unfitText(entry.node.text, prose); !why.empty()) entry.fail(why);
  return entry.node.text;
}

std::size_t readChoice(const Entry& entry, const std::vector<std::string>& choices) {
  if (entry.node.type != JsonNode::Type::text)
    entry.fail(fmt::format("expected one of {}, not {}", joined(choices), describe(entry.node)));
  const auto found = std::find(choices.begin(), choices.end(), entry.node.text);
  if (found == choices.end())
    entry.fail(fmt::format("{} is not known here; allowed: {}", describe(entry.node), joined(choices)));
  return static_cast<std::size_t>(found - choices.begin());
}

std::string closest(std::string_view wrong, const std::vector<std::string>& words) {
  std::string best;
  std::size_t least = std::max<std::size_t>(2, wrong.size() / 3) + 1;
  if (wrong.size() > 100) return best;
  for (const std::string& word : words) {
    const std::size_t d = editDistance(wrong, word);
    if (d < least && d < word.size()) {
      least = d;
      best = word;
    }
  }
  return best;
}

std::string joined(const std::vector<std::string>& words) {
  std::string s;
  for (std::size_t i = 0; i < words.size(); ++i) s += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + words[i];
  return s;
}

}  // namespace gambeson::schema
