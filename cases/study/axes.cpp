#include "cases/study/axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "cases/input/units.hpp"
#include "cases/study/make_variant.hpp"

namespace gambeson::study {

using schema::Entry;

std::string textOf(const JsonNode& value) {
  switch (value.type) {
    case JsonNode::Type::number:
      return fmt::format("{}", value.number);
    case JsonNode::Type::text:
      return value.text;
    case JsonNode::Type::boolean:
      return value.boolean ? "true" : "false";
    default:
      return "";
  }
}

bool isRegionFactor(const std::string& path) {
  return path.starts_with("garment") && path.find(".regions[") != std::string::npos && path.ends_with("].thickness");
}

std::vector<Setting> settingsOf(const Entry& entry) {
  if (entry.node.type != JsonNode::Type::object)
    entry.fail("expected an object { } of path: value, not " + describe(entry.node));
  if (entry.node.children.empty()) entry.fail("is empty; allowed: at least one path: value");
  std::vector<Setting> all;
  for (const JsonNode& child : entry.node.children) all.push_back({child.key, child});
  return all;
}

namespace {

/// What a value of the case is about.
Role roleOfPath(const std::string& path) {
  const std::string last = path.substr(path.rfind('.') + 1), within = "." + path + ".";
  const auto in = [&](const std::string& part) { return within.find("." + part + ".") != std::string::npos; };
  if (last == "thickness") return Role::thickness;
  if (last == "cell" || last.starts_with("cells")) return Role::mesh;
  if (path.starts_with("human.motion")) return Role::motion;
  if (path == "human" || path.starts_with("human.")) return Role::wearer;
  if (in("fabric")) return Role::material;
  if (path == "contact.friction") return Role::friction;
  if (last == "model") return Role::model;
  // A measure of the garment, "garment.shorts.ease": not how finely it is computed.
  for (const char* shape : {"sheet", "disc", "tube", "shorts", "trousers", "belt", "shirt", "skirt"})
    if (path.starts_with("garment") && in(shape) && last != "degree") return Role::fit;
  return Role::other;
}

/// The role that is given, else that of the name, else that of the paths where those that have one agree.
Role roleOf(const AxisInput& in, const std::string& name, const Axis& axis) {
  if (in.role) return *in.role;
  for (const auto& [role, text] : roleNames())
    if (name == role && text != Role::other) return text;
  std::set<Role> roles;
  for (const Level& level : axis.levels)
    for (const Setting& s : level.set)
      if (const Role role = roleOfPath(s.path); role != Role::other) roles.insert(role);
  // A garment that goes with its wearer is worn by who it fits.
  if (roles.contains(Role::wearer)) return Role::wearer;
  return roles.size() == 1 ? *roles.begin() : Role::other;
}

/// Numbers of the levels where all are plain numbers, or all are numbers with one and the same unit.
void findNumbers(Axis& axis, const JsonNode& values) {
  std::vector<double> numbers;
  std::set<std::string> units;
  for (const JsonNode& v : values.children) {
    if (v.type == JsonNode::Type::number) {
      numbers.push_back(v.number);
      units.insert("");
      continue;
    }
    if (v.type != JsonNode::Type::text) return;
    const std::optional<Quantity> typed = anyQuantity(v.text);
    if (!typed) return;
    numbers.push_back(typed->value);
    units.insert(typed->unit);
  }
  if (units.size() != 1) return;
  for (std::size_t i = 0; i < numbers.size(); ++i) axis.levels[i].number = numbers[i];
}

}  // namespace

Axis axisOf(const Entry& entry, const AxisInput& in) {
  const bool sets = in.sets.type != JsonNode::Type::null, values = in.values.type != JsonNode::Type::null;
  if (sets && (values || !in.path.empty()))
    entry.failAt("sets", "excludes path and values; give either sets, or path and values");
  if (!sets && in.path.empty()) entry.failAt("path", "is required: the value of the case that varies (or sets)");
  if (!sets && !values) entry.failAt("values", "is required: a list of values");
  Axis axis;
  axis.name = in.name.empty() ? in.path.substr(in.path.rfind('.') + 1) : in.name;
  if (axis.name.empty()) entry.failAt("name", "is required where sets are given");
  axis.unit = in.unit;
  axis.multiple = in.path.starts_with("factors.") || isRegionFactor(in.path);
  axis.labelled = !in.labels.empty();
  const std::string key = sets ? "sets" : "values";
  const JsonNode& list = sets ? in.sets : in.values;
  const Entry at = entry.member(*entry.node.find(key));
  if (list.type != JsonNode::Type::list) at.fail("expected a list [ ], not " + describe(list));
  if (list.children.empty()) at.fail("the list is empty; allowed: at least one level");
  if (!in.labels.empty() && in.labels.size() != list.children.size())
    entry.failAt("labels", fmt::format("{} labels for {} {}; allowed: one for each", in.labels.size(),
                                       list.children.size(), key));
  std::map<std::string, std::string> folders;
  for (std::size_t i = 0; i < list.children.size(); ++i) {
    Level level;
    const JsonNode& value = list.children[i];
    level.label = in.labels.empty() ? (sets ? "" : textOf(value)) : in.labels[i];
    if (level.label.empty())
      entry.failAt("labels", "is required: what no number, text or flag names needs a label for each level");
    const std::string name = in.labels.empty() ? axis.name + "_" + level.label : level.label;
    level.folder = folderName(name);
    // A factor is a multiple, and read as such: "thickness x 0.5" is no length.
    level.name = !in.labels.empty() ? level.label
                                    : fmt::format("{} {}{}{}{}", axis.name, axis.multiple ? "x " : "", level.label,
                                                  axis.unit.empty() ? "" : " ", axis.unit);
    if (level.label.size() > 60) at.item(i).fail("its label is longer than 60 characters; give shorter labels");
    const Entry where = in.labels.empty() ? at.item(i) : entry.member(*entry.node.find("labels")).item(i);
    if (const auto [other, fresh] = folders.insert({level.folder, level.label}); !fresh)
      where.fail(fmt::format("\"{}\" and \"{}\" name two levels alike; allowed: labels that differ in more than signs",
                             level.label, other->second));
    if (sets)
      level.set = settingsOf(at.item(i));
    else
      level.set = {{in.path, value}};
    axis.levels.push_back(std::move(level));
  }
  if (!sets) findNumbers(axis, list);
  axis.role = roleOf(in, axis.name, axis);
  return axis;
}

std::size_t axisNamed(const Entry& entry, const Study& s, const std::string& name) {
  std::vector<std::string> names;
  for (std::size_t a = 0; a < s.axes.size(); ++a) {
    if (s.axes[a].name == name) return a;
    names.push_back(s.axes[a].name);
  }
  entry.fail(names.empty() ? "there are no axes"
                           : fmt::format("there is no axis \"{}\"; allowed: {}", name, schema::joined(names)));
}

int levelNamed(const Entry& entry, const Axis& axis, const JsonNode& value) {
  const std::string wanted = textOf(value);
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < axis.levels.size(); ++i) {
    if (axis.levels[i].label == wanted) return static_cast<int>(i);
    labels.push_back(axis.levels[i].label);
  }
  entry.fail(
      fmt::format("{} is no level of the axis {}; allowed: {}", describe(value), axis.name, schema::joined(labels)));
}

std::map<std::size_t, int> levelsAt(const Entry& entry, const Study& s) {
  if (entry.node.type != JsonNode::Type::object)
    entry.fail("expected an object { } of axis: label, not " + describe(entry.node));
  std::map<std::size_t, int> levels;
  for (const JsonNode& child : entry.node.children) {
    const Entry at = entry.member(child);
    const std::size_t axis = axisNamed(at, s, child.key);
    levels[axis] = levelNamed(at, s.axes[axis], child);
  }
  return levels;
}

namespace {

/// The factors of regions are multiples too, of which elasticities know nothing.
bool isOfRegion(const Axis& axis) {
  return std::any_of(axis.levels.begin(), axis.levels.end(), [](const Level& l) {
    return std::any_of(l.set.begin(), l.set.end(), [](const Setting& s) { return isRegionFactor(s.path); });
  });
}

}  // namespace

bool isFactor(const Axis& axis) {
  return std::any_of(axis.levels.begin(), axis.levels.end(), [](const Level& l) {
    return std::any_of(l.set.begin(), l.set.end(), [](const Setting& s) { return s.path.starts_with("factors"); });
  });
}

void findBaseline(const Entry& root, const StudyInput& in, Study& s) {
  if (in.baseline.type != JsonNode::Type::null) {
    const Entry entry = root.member(*root.node.find("baseline"));
    const auto levels = levelsAt(entry, s);
    if (levels.empty()) entry.fail("is empty; allowed: at least one axis: label");
    // What is not chosen is compared with itself: a motion with the same motion, a wearer with himself.
    int best = 3;
    for (const auto& [axis, level] : levels) best = std::min(best, rankOf(s.axes[axis].role));
    for (const auto& [axis, level] : levels) {
      if (rankOf(s.axes[axis].role) > best && rankOf(s.axes[axis].role) < 3) continue;
      s.compared.push_back(static_cast<int>(axis));
      s.baseline.push_back(level);
    }
    return;
  }
  for (std::size_t a = 0; a < s.axes.size(); ++a)
    for (std::size_t l = 0; l < s.axes[a].levels.size(); ++l)
      if ((isFactor(s.axes[a]) || isOfRegion(s.axes[a])) && s.axes[a].levels[l].number == 1.0) {
        s.compared.push_back(static_cast<int>(a));
        s.baseline.push_back(static_cast<int>(l));
      }
  if (!s.compared.empty() || s.axes.empty()) return;
  const auto first = std::min_element(s.axes.begin(), s.axes.end(),
                                      [](const Axis& a, const Axis& b) { return rankOf(a.role) < rankOf(b.role); });
  s.compared = {static_cast<int>(first - s.axes.begin())};
  s.baseline = {0};
}

}  // namespace gambeson::study
