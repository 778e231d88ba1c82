#include "cases/input/schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

#include "cases/input/message.hpp"
#include "cases/input/mistakes.hpp"
#include "cases/input/typed.hpp"
#include "cases/input/units.hpp"
#include "core/error.hpp"

namespace gambeson::schema {
namespace {

std::string withUnit(double x, const std::string& unit) {
  return unit.empty() ? fmt::format("{}", x) : fmt::format("{} {}", x, unit);
}

/// A value of SI in a unit; SI itself to the last digit.
std::string inUnits(double si, double factor) {
  return factor == 1 ? fmt::format("{}", si) : fmt::format("{:.6g}", si / factor);
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

constexpr int kDeepestHint = 5;

/// A place where a file has a key: nearer to the top is less, and at one depth where it is required.
struct Place {
  int depth = kDeepestHint + 1;
  bool optional = true;
  std::string path;
  bool operator<(const Place& b) const { return std::pair(depth, optional) < std::pair(b.depth, b.optional); }
};

/// The least of the places of a key in an object and below it; its path is empty where there is none.
Place placeOf(std::string_view key, const Object& object, int depth = 0) {
  if (const Field* f = object.find(key)) return {depth, !f->required, f->key};
  Place best;
  if (depth >= kDeepestHint) return best;
  for (const Field& f : object.fields) {
    if (!f.object) continue;
    Place below = placeOf(key, *f.object, depth + 1);
    if (!(below < best)) continue;
    below.path = f.key + (f.kind == Kind::list ? "[]." : ".") + below.path;
    best = below;
  }
  return best;
}

/// The same mistakes; of keys that stand elsewhere in the file it is said where.
void sayInFile(const Mistakes& mistakes, const Object& file) {
  try {
    mistakes.say();
  } catch (const InputErrors& errors) {
    Mistakes hinted;
    for (const InputError& e : errors.all()) {
      const std::string key = e.where().key.substr(e.where().key.rfind('.') + 1);
      const std::string place = e.reason().starts_with(kUnknownKey) ? placeOf(key, file).path : "";
      if (place.empty()) {
        hinted.add(e);
        continue;
      }
      const std::size_t dot = place.rfind('.');
      const std::string under = dot == std::string::npos ? "at the top of the file" : "under " + place.substr(0, dot);
      hinted.add(InputError(e.where(), fmt::format("{}\"{}\" belongs {}; {}", kUnknownKey, key, under,
                                                   e.reason().substr(kUnknownKey.size()))));
    }
    hinted.say();
  }
}

}  // namespace

std::string rangeText(const Range& range, const Quantity& in) {
  const bool has_low = std::isfinite(range.low), has_high = std::isfinite(range.high);
  std::string s;
  if (has_low) s = fmt::format("{} {}", range.low_open ? ">" : ">=", inUnits(range.low, in.factor));
  if (has_high)
    s += fmt::format("{}{} {}", has_low ? " and " : "", range.high_open ? "<" : "<=", inUnits(range.high, in.factor));
  if (s.empty()) return "any";
  return in.unit.empty() ? s : s + " " + in.unit;
}

std::string inUnitOf(const Entry& object, const std::string& key, double si, const std::string& unit) {
  const JsonNode* child = object.node.find(key);
  if (!child || child->type != JsonNode::Type::text) return withUnit(si, unit);
  const Quantity typed = readQuantity(child->text, unit);
  return typed.unit.empty() ? withUnit(si, unit) : inUnits(si, typed.factor) + " " + typed.unit;
}

std::string Range::text(const std::string& unit) const { return rangeText(*this, {.unit = unit}); }

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

namespace {

/// At most one field of each set of alternatives, and one where that is required. An unknown key may be meant as one.
void checkAlternatives(const Object& object, const Entry& entry, bool all_known) {
  for (const Alternatives& alternatives : object.alternatives) {
    const JsonNode* first = nullptr;
    for (const JsonNode& child : entry.node.children) {
      const Field* field = object.find(child.key);
      if (!field || field->alternatives != alternatives.name) continue;
      if (first) entry.member(child).fail(fmt::format("excludes \"{}\"; give only one of them", first->key));
      first = &child;
    }
    if (alternatives.required && !first && all_known)
      entry.fail(fmt::format("one of {} is required", joined(keysOf(object, &alternatives.name))));
  }
}

/// A value that lies beyond a bound by the rounding of its conversion alone is the bound: 10 us are 1e-5 s less an ulp.
double roundedTo(const Range& range, double x) {
  if (!std::isfinite(x) || range.contains(x)) return x;
  for (const double bound : {range.low, range.high})
    if (std::abs(x - bound) <= 4 * std::numeric_limits<double>::epsilon() * std::abs(x)) return bound;
  return x;
}

}  // namespace

void readObject(const Object& object, const Entry& entry, void* target) {
  const bool whole_file = entry.path.empty();
  const JsonNode& node = entry.node;
  // Of what is read from a file its name alone may stand there: say how it is written.
  const auto file = std::find_if(object.fields.begin(), object.fields.end(),
                                 [](const Field& f) { return f.required && f.kind == Kind::path; });
  if (node.type == JsonNode::Type::text && file != object.fields.end())
    entry.fail(fmt::format("expected an object {{\"{0}\": {1}}}, not the text {1}", file->key, toText(node)));
  if (node.type != JsonNode::Type::object)
    entry.fail(fmt::format("expected an object {{ }} with {}, not {}", joined(keysOf(object)), describe(node)));
  Mistakes mistakes;
  std::set<std::string> meant;  // fields that unknown keys resemble
  for (const JsonNode& child : node.children) {
    if (object.find(child.key) || mistakes.full()) continue;
    const Entry member = entry.member(child);
    if (whole_file && child.key == "$schema") {
      mistakes.without([&] { readText(member); });
      continue;
    }
    meant.insert(closest(child.key, keysOf(object)));
    mistakes.without([&] { member.fail(kUnknownKey + hint(child.key, keysOf(object))); });
  }
  mistakes.without([&] { checkAlternatives(object, entry, meant.empty()); });
  for (const Field& field : object.fields) {
    const JsonNode* child = node.find(field.key);
    if (!child && (!field.required || meant.contains(field.key))) continue;
    mistakes.without([&] {
      if (!child) entry.failAt(field.key, "is required: " + field.doc);
      field.read(entry.member(*child), target);
    });
  }
  if (whole_file)
    sayInFile(mistakes, object);
  else
    mistakes.say();
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
  Quantity typed{.unit = unit};
  if (entry.node.type == JsonNode::Type::number) {
    typed.si = entry.node.number;
  } else if (entry.node.type == JsonNode::Type::text) {
    try {
      typed = readQuantity(entry.node.text, unit);
    } catch (const InputError& e) {
      entry.fail(e.reason() + "; allowed: " + range.text(unit));
    }
  } else {
    entry.fail(fmt::format("expected a number{}, not {}; allowed: {}",
                           unit.empty() ? "" : fmt::format(" in {} or a text with a unit", unit), describe(entry.node),
                           range.text(unit)));
  }
  typed.si = roundedTo(range, typed.si);
  if (!std::isfinite(typed.si) || !range.contains(typed.si))
    entry.fail(fmt::format("{} is out of range; allowed: {}",
                           entry.node.type == JsonNode::Type::text ? entry.node.text : withUnit(typed.si, unit),
                           rangeText(range, typed)));
  return typed.si;
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
  const auto has = [&](std::string_view word) { return std::find(words.begin(), words.end(), word) != words.end(); };
  // What others call our keys.
  constexpr std::pair<std::string_view, std::string_view> synonyms[]{
      {"weight", "surface_density"},        {"gsm", "surface_density"},  {"areal_density", "surface_density"},
      {"mass_per_area", "surface_density"}, {"youngs_modulus", "young"}, {"elastic_modulus", "young"}};
  for (const auto& [other, ours] : synonyms)
    if (wrong == other && has(ours)) return std::string(ours);
  // A key of ours with a word behind it: "young_modulus", "poisson_ratio".
  std::string best;
  for (const std::string& word : words)
    if (word.size() > 2 && word.size() > best.size() && wrong.starts_with(word + "_")) best = word;
  if (!best.empty()) return best;
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
