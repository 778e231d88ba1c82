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

std::vector<std::string> keysOf(const Object& object, const std::string* group = nullptr) {
  std::vector<std::string> keys;
  for (const Field& f : object.fields)
    if (!group || f.group == *group) keys.push_back(f.key);
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

void Place::fail(const std::string& reason) const {
  const bool from_command_line = node.line == 0;
  throw InputError({from_command_line ? "command line" : file, node.line, path}, reason);
}

void Place::failAt(const std::string& key, const std::string& reason) const {
  const JsonNode* child = node.find(key);
  if (child) member(*child).fail(reason);
  Place{node, (path.empty() ? "" : path + ".") + key, file}.fail(reason);
}

Place Place::member(const JsonNode& child) const {
  return {child, (path.empty() ? "" : path + ".") + child.key, child.file ? *child.file : file, recorded};
}

Place Place::item(std::size_t index) const {
  const JsonNode& child = node.children[index];
  return {child, fmt::format("{}[{}]", path, index), child.file ? *child.file : file, recorded};
}

const Field* Object::find(std::string_view key) const {
  for (const Field& f : fields)
    if (f.key == key) return &f;
  return nullptr;
}

void readObject(const Object& object, const Place& place, void* target) {
  const JsonNode& node = place.node;
  if (node.type != JsonNode::Type::object)
    place.fail(fmt::format("expected an object {{ }} with {}, not {}", joined(keysOf(object)), describe(node)));
  for (const JsonNode& child : node.children)
    if (!object.find(child.key)) place.member(child).fail("unknown key; " + hint(child.key, keysOf(object)));
  for (const Group& group : object.groups) {
    const JsonNode* first = nullptr;
    for (const JsonNode& child : node.children) {
      if (object.find(child.key)->group != group.name) continue;
      if (first) place.member(child).fail(fmt::format("excludes \"{}\"; give only one of them", first->key));
      first = &child;
    }
    if (group.required && !first) place.fail(fmt::format("one of {} is required", joined(keysOf(object, &group.name))));
  }
  for (const Field& field : object.fields) {
    const JsonNode* child = node.find(field.key);
    if (child)
      field.read(place.member(*child), target);
    else if (field.required)
      place.failAt(field.key, "is required: " + field.doc);
  }
  if (object.check) object.check(place, target);
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

double readNumber(const Place& place, const std::string& unit, const Range& range) {
  double x = 0;
  if (place.node.type == JsonNode::Type::number) {
    x = place.node.number;
  } else if (place.node.type == JsonNode::Type::text) {
    try {
      x = parseQuantity(place.node.text, unit);
    } catch (const InputError& e) {
      place.fail(e.reason() + "; allowed: " + range.text(unit));
    }
  } else {
    place.fail(fmt::format("expected a number{}, not {}; allowed: {}",
                           unit.empty() ? "" : fmt::format(" in {} or a text with a unit", unit), describe(place.node),
                           range.text(unit)));
  }
  if (!std::isfinite(x) || !range.contains(x))
    place.fail(fmt::format("{} is out of range; allowed: {}", withUnit(x, unit), range.text(unit)));
  return x;
}

int readInteger(const Place& place, const Range& range) {
  if (place.node.type != JsonNode::Type::number || place.node.number != std::floor(place.node.number))
    place.fail(fmt::format("expected a whole number, not {}; allowed: {}", describe(place.node), range.text()));
  if (!range.contains(place.node.number) || std::abs(place.node.number) > 1e9)
    place.fail(fmt::format("{} is out of range; allowed: {}", place.node.number, range.text()));
  return static_cast<int>(place.node.number);
}

bool readBoolean(const Place& place) {
  if (place.node.type != JsonNode::Type::boolean)
    place.fail(fmt::format("expected true or false, not {}", describe(place.node)));
  return place.node.boolean;
}

const std::string& readText(const Place& place) {
  if (place.node.type != JsonNode::Type::text)
    place.fail(fmt::format("expected a text in quotes, not {}", describe(place.node)));
  if (place.node.text.empty()) place.fail("the text is empty");
  // Names, labels and paths have no control characters; what is prose may have several lines.
  const std::string_view key = std::string_view(place.path).substr(place.path.rfind('.') + 1);
  const bool prose = key == "description" || key == "doc" || key == "note" || key == "source";
  if (const std::string why = unfitText(place.node.text, prose); !why.empty()) place.fail(why);
  return place.node.text;
}

std::size_t readChoice(const Place& place, const std::vector<std::string>& choices) {
  if (place.node.type != JsonNode::Type::text)
    place.fail(fmt::format("expected one of {}, not {}", joined(choices), describe(place.node)));
  const auto found = std::find(choices.begin(), choices.end(), place.node.text);
  if (found == choices.end())
    place.fail(fmt::format("{} is not known here; allowed: {}", describe(place.node), joined(choices)));
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
