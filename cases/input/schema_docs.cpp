/// Detail of schema.hpp: what the field table says about itself: JSON, JSON Schema, Markdown.

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "cases/input/schema.hpp"

namespace gambeson::schema {
namespace {

using Json = nlohmann::ordered_json;

Json toJson(const JsonNode& node) {
  switch (node.type) {
    case JsonNode::Type::null:
      return nullptr;
    case JsonNode::Type::boolean:
      return node.boolean;
    case JsonNode::Type::number:
      if (node.number == std::floor(node.number) && std::abs(node.number) < 1e9)
        return static_cast<long long>(node.number);
      return node.number;
    case JsonNode::Type::text:
      return node.text;
    case JsonNode::Type::list: {
      Json list = Json::array();
      for (const JsonNode& c : node.children) list.push_back(toJson(c));
      return list;
    }
    case JsonNode::Type::object: {
      Json object = Json::object();
      for (const JsonNode& c : node.children) object[c.key] = toJson(c);
      return object;
    }
  }
  return nullptr;
}

/// What stands for a default that is a plain value: with its unit, so that it can be copied.
std::string defaultText(const Field& f) {
  if (f.required) return "required";
  if (!f.default_note.empty()) return f.default_note;
  if (!f.alternatives.empty()) return "";
  if (!f.default_value) return f.kind == Kind::object ? "as below" : "";
  const JsonNode& v = *f.default_value;
  if (v.type == JsonNode::Type::number && !f.unit.empty()) return fmt::format("{} {}", v.number, f.unit);
  if (v.type == JsonNode::Type::text) return v.text;
  if (v.type == JsonNode::Type::list && !v.children.empty()) {
    std::string s;
    for (const JsonNode& c : v.children) s += (s.empty() ? "[" : ", ") + fmt::format("{}", c.number);
    return s + "]" + (f.unit.empty() ? "" : " " + f.unit);
  }
  return toJson(v).dump();
}

std::string typeText(const Field& f) {
  switch (f.kind) {
    case Kind::number:
      return f.choices.empty() ? "number" : "number or word";
    case Kind::integer:
      return "whole number";
    case Kind::boolean:
      return "true or false";
    case Kind::text:
      return "text";
    case Kind::path:
      return "file";
    case Kind::choice:
      return "word";
    case Kind::vector:
      return f.choices.empty() ? "[x, y, z]" : "[x, y, z] or word";
    case Kind::pair:
      return "[s, t]";
    case Kind::numbers:
      return "list of numbers";
    case Kind::lists:
      return f.choices.empty() ? "list of lists of numbers" : "list of lists of numbers, or word";
    case Kind::map:
      return "name: list of lists of numbers";
    case Kind::object:
      return "object";
    case Kind::number_or_object:
      return "number or object";
    case Kind::word_or_object:
      return "word or object";
    case Kind::list:
      return "list of objects";
    case Kind::text_list:
      return "list of texts";
    case Kind::any:
      return "see meaning";
  }
  return "";
}

std::string allowedText(const Field& f) {
  std::string s;
  for (const std::string& c : f.choices) s += (s.empty() ? "" : ", ") + c;
  const bool ranged = f.kind == Kind::number || f.kind == Kind::integer || f.kind == Kind::vector ||
                      f.kind == Kind::pair || f.kind == Kind::numbers || f.kind == Kind::lists ||
                      f.kind == Kind::number_or_object;
  if (ranged && f.range.text() != "any") s = f.range.text(f.unit) + (s.empty() ? "" : "; or " + s);
  if (ranged && s.empty()) s = f.unit;
  return s;
}

Json numberSchema(const Field& f) {
  Json number{{"type", f.kind == Kind::integer ? "integer" : "number"}};
  if (std::isfinite(f.range.low)) number[f.range.low_open ? "exclusiveMinimum" : "minimum"] = f.range.low;
  if (std::isfinite(f.range.high)) number[f.range.high_open ? "exclusiveMaximum" : "maximum"] = f.range.high;
  if (f.kind == Kind::integer) return number;
  const std::string sort = f.unit.empty() ? "a number, or a text with %" : "SI (" + f.unit + "), or a text with a unit";
  return {{"description", sort}, {"anyOf", Json::array({number, Json{{"type", "string"}}})}};
}

Json rowsSchema(const Field& f) {
  return {{"type", "array"}, {"items", {{"type", "array"}, {"items", numberSchema(f)}}}};
}

Json objectSchema(const Object& object);

Json fieldSchema(const Field& f) {
  Json s;
  switch (f.kind) {
    case Kind::number:
    case Kind::integer:
      s = numberSchema(f);
      break;
    case Kind::vector:
      s = {{"type", "array"}, {"items", numberSchema(f)}, {"minItems", 3}, {"maxItems", 3}};
      if (!f.choices.empty()) s = {{"anyOf", Json::array({s, Json{{"enum", f.choices}}})}};
      break;
    case Kind::boolean:
      s = {{"type", "boolean"}};
      break;
    case Kind::pair:
      s = {{"type", "array"}, {"items", numberSchema(f)}, {"minItems", 2}, {"maxItems", 2}};
      break;
    case Kind::numbers:
      s = {{"type", "array"}, {"items", numberSchema(f)}};
      break;
    case Kind::lists:
      s = rowsSchema(f);
      if (!f.choices.empty()) s = {{"anyOf", Json::array({s, Json{{"enum", f.choices}}})}};
      break;
    case Kind::map:
      s = {{"type", "object"}, {"additionalProperties", rowsSchema(f)}};
      break;
    case Kind::text:
    case Kind::path:
      s = {{"type", "string"}, {"minLength", 1}};
      break;
    case Kind::choice:
      s = {{"enum", f.choices}};
      break;
    case Kind::object:
      s = objectSchema(*f.object);
      break;
    case Kind::number_or_object:
      s = {{"anyOf", Json::array({numberSchema(f), objectSchema(*f.object)})}};
      break;
    case Kind::word_or_object:
      s = {{"anyOf", Json::array({Json{{"enum", f.choices}}, objectSchema(*f.object)})}};
      break;
    case Kind::list:
      s = {{"type", "array"}, {"items", objectSchema(*f.object)}};
      break;
    case Kind::text_list:
      s = {{"type", "array"}, {"items", {{"type", "string"}, {"minLength", 1}}}};
      break;
    case Kind::any:
      s = Json::object();
      break;
  }
  s["description"] = f.doc + (s.contains("description") ? "; " + s["description"].get<std::string>() : "");
  if (f.default_value) s["default"] = toJson(*f.default_value);
  return s;
}

/// What a whole file may have under "$schema".
Json schemaName() {
  return {{"type", "string"}, {"description", "the JSON Schema of this file, for editors; not read"}};
}

Json objectSchema(const Object& object) {
  Json s{{"title", object.title}, {"type", "object"}, {"additionalProperties", false}};
  Json required = Json::array();
  for (const Field& f : object.fields) {
    s["properties"][f.key] = fieldSchema(f);
    if (f.required) required.push_back(f.key);
  }
  if (!required.empty()) s["required"] = required;
  Json rules = Json::array();
  for (const Alternatives& g : object.alternatives) {
    Json choices = Json::array();
    Json none = Json::array();
    for (const Field& f : object.fields) {
      if (f.alternatives != g.name) continue;
      choices.push_back({{"required", {f.key}}});
      none.push_back({{"required", {f.key}}});
    }
    if (!g.required) choices.push_back({{"not", {{"anyOf", none}}}});
    rules.push_back({{"oneOf", choices}});
  }
  if (!rules.empty()) s["allOf"] = rules;
  return s;
}

/// What is said of an object alone.
std::string sectionOf(const Object& object) {
  std::string section;
  for (const Alternatives& g : object.alternatives) {
    std::vector<std::string> keys;
    for (const Field& f : object.fields)
      if (f.alternatives == g.name) keys.push_back("`" + f.key + "`");
    section += fmt::format("{} of {}.\n\n", g.required ? "Exactly one" : "At most one", joined(keys));
  }
  section += "| key | type | default | allowed | meaning |\n|---|---|---|---|---|\n";
  for (const Field& f : object.fields)
    section += fmt::format("| `{}` | {} | {} | {} | {} |\n", f.key, typeText(f), defaultText(f), allowedText(f), f.doc);
  return section;
}

/// What is said of an object and all below it.
std::string wholeOf(const Object& object) {
  std::string whole = object.title + sectionOf(object);
  for (const Field& f : object.fields)
    if (f.object) whole += wholeOf(*f.object);
  return whole;
}

/// `seen`: the sections written so far; `places`: objects with all below them, and where they stand in this kind.
void describeObject(const Object& object, const std::string& path, std::map<std::string, std::string>& places,
                    std::set<std::string>& seen, std::string& out) {
  std::string section = fmt::format("\n## {}{}\n\n", path.empty() ? "" : "`" + path + "`: ", object.title);
  const auto [first, fresh] = places.insert({wholeOf(object), path});
  if (!fresh) {
    section += fmt::format("As `{}`.\n", first->second);
    if (seen.insert(section).second) out += section;
    return;
  }
  section += sectionOf(object);
  if (seen.insert(section).second) out += section;
  for (const Field& f : object.fields)
    if (f.object)
      describeObject(*f.object, (path.empty() ? "" : path + ".") + f.key + (f.kind == Kind::list ? "[]" : ""), places,
                     seen, out);
}

}  // namespace

std::string toText(const JsonNode& node) { return toJson(node).dump(2); }

std::string jsonSchema(const Object& root) {
  Json s{{"$schema", "https://json-schema.org/draft/2020-12/schema"}};
  s.update(objectSchema(root));
  s["properties"]["$schema"] = schemaName();
  return s.dump(2) + "\n";
}

std::string jsonSchema(const std::vector<KindOfFile>& kinds) {
  Json s{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"type", "object"}};
  Json words = Json::array();
  // Of the branches only the one of the file's own kind speaks, so that an editor's messages are about that kind.
  for (const KindOfFile& k : kinds) {
    words.push_back(k.kind);
    Json is{{"properties", {{"kind", {{"const", k.kind}}}}}};
    if (k.root != kinds.front().root) is["required"] = {"kind"};
    Json then = objectSchema(*k.root);
    then["properties"]["$schema"] = schemaName();
    s["allOf"].push_back({{"if", is}, {"then", then}});
  }
  s["properties"]["kind"] = {{"enum", words}};
  return s.dump(2) + "\n";
}

namespace {

const std::string heading =
    "# Fields of a case\n\n"
    "Written by `gambeson check --doc` from the table that reads the cases; do not edit it by hand.\n\n"
    "A number is SI, or a text with a unit: `0.000762` or `\"0.762 mm\"`, `\"57 deg\"`, `\"4 kg/(m^2 s)\"`, `\"6 "
    "%\"`. Units: m g s N Pa\n"
    "J Hz rad tex gf bar with the prefixes n u m c d k M G, and deg ° % min in \" mil ft yd oz lb lbf psi ksi mmHg gsm "
    "den; products by a\n"
    "space, `·` or `.`, quotients by `/`, powers by `^`: `\"0.17 gf.cm2/cm\"`, `\"8 oz/yd^2\"`, `\"900 N/5cm\"`. A "
    "comma is "
    "the decimal point where it\n"
    "can be nothing else: `\"0,45 mm\"`. A file may name its schema under `$schema`. Files are\n"
    "found relative to the folder of the case. Keys that are not listed here are errors.\n";

}  // namespace

std::string markdown(const Object& root) {
  std::string out = heading;
  std::set<std::string> seen;
  std::map<std::string, std::string> places;
  describeObject(root, "", places, seen, out);
  return out;
}

std::string markdown(const std::vector<KindOfFile>& kinds) {
  std::string out = heading + "\nThe key `kind` says what a case is:\n\n";
  for (const KindOfFile& k : kinds)
    out += fmt::format("- `{}`{}: {}\n", k.kind, k.root == kinds.front().root ? " (where the key is absent)" : "",
                       k.root->about);
  std::set<std::string> seen;
  for (const KindOfFile& k : kinds) {
    out += fmt::format("\n# Kind `{}`\n\n{}.\n", k.kind, k.root->about);
    std::map<std::string, std::string> places;
    describeObject(*k.root, "", places, seen, out);
  }
  return out;
}

std::string chapter(const std::string& title, const Object& root) {
  std::string out = fmt::format("\n# {}\n\n{}.\n", title, root.about);
  std::set<std::string> seen;
  std::map<std::string, std::string> places;
  describeObject(root, "", places, seen, out);
  return out;
}

}  // namespace gambeson::schema
