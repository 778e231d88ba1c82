/// Detail of study.hpp: from the file of a study to its variants.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "cases/input/table.hpp"
#include "cases/input/units.hpp"
#include "cases/study/files.hpp"
#include "cases/study/maker.hpp"
#include "cases/study/read_population.hpp"
#include "core/error.hpp"

namespace gambeson::study {
namespace {

using schema::Entry;

// --- From the fields to axes ------------------------------------------------------------------------------------

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
  axis.multiple = in.path.starts_with("factors.");
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
    level.folder = safe(name);
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

/// Object axis: label.
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
      if (isFactor(s.axes[a]) && s.axes[a].levels[l].number == 1.0) {
        s.compared.push_back(static_cast<int>(a));
        s.baseline.push_back(static_cast<int>(l));
      }
  if (!s.compared.empty() || s.axes.empty()) return;
  const auto first = std::min_element(s.axes.begin(), s.axes.end(),
                                      [](const Axis& a, const Axis& b) { return rankOf(a.role) < rankOf(b.role); });
  s.compared = {static_cast<int>(first - s.axes.begin())};
  s.baseline = {0};
}

// --- From the axes to variants ----------------------------------------------------------------------------------

/// All combinations of levels of the axes, the last axis fastest, each for `runs` variants. Counted first: they may be
/// too many to be built.
std::vector<std::vector<int>> combinations(const std::vector<std::vector<int>>& choices, std::size_t runs,
                                           const Entry& at) {
  std::size_t count = runs;
  for (const std::vector<int>& choice : choices)
    if ((count *= choice.size()) > most_variants) tooMany(at);
  std::vector<std::vector<int>> all{{}};
  for (const std::vector<int>& choice : choices) {
    std::vector<std::vector<int>> next;
    for (const auto& before : all)
      for (const int level : choice) {
        next.push_back(before);
        next.back().push_back(level);
      }
    all = std::move(next);
  }
  return all;
}

std::vector<std::vector<int>> allLevels(const Study& s) {
  std::vector<std::vector<int>> choices;
  for (const Axis& a : s.axes) {
    choices.emplace_back();
    for (std::size_t l = 0; l < a.levels.size(); ++l) choices.back().push_back(static_cast<int>(l));
  }
  return choices;
}

int baselineLevel(const Study& s, std::size_t axis) {
  for (std::size_t k = 0; k < s.compared.size(); ++k)
    if (s.compared[k] == static_cast<int>(axis)) return s.baseline[k];
  return 0;
}

void addElasticities(const Entry& root, const ElasticityInput& in, Maker& maker, Study& s) {
  const Entry entry = root.member(*root.node.find("elasticities"));
  std::vector<std::vector<int>> choices = allLevels(s);
  for (std::size_t a = 0; a < s.axes.size(); ++a)
    if (isFactor(s.axes[a])) choices[a] = {baselineLevel(s, a)};
  if (in.where.type != JsonNode::Type::null) {
    const Entry where = entry.member(*entry.node.find("where"));
    if (in.where.type != JsonNode::Type::object)
      where.fail("expected an object { } of axis: list of labels, not " + describe(in.where));
    for (const JsonNode& child : where.node.children) {
      const Entry at = where.member(child);
      const std::size_t axis = axisNamed(at, s, child.key);
      if (isFactor(s.axes[axis])) at.fail("is an axis of factors, which stay at the baseline; allowed: another axis");
      if (child.type != JsonNode::Type::list || child.children.empty())
        at.fail("expected a list of labels, not " + describe(child));
      choices[axis].clear();
      for (std::size_t i = 0; i < child.children.size(); ++i)
        choices[axis].push_back(levelNamed(at.item(i), s.axes[axis], child.children[i]));
    }
  }
  const std::array<const char*, 5> factors{"bending", "membrane", "weight", "inertia", "drag"};
  const std::array<double, 2> values{1 - in.step, 1 + in.step};
  for (const auto& levels : combinations(choices, factors.size() * values.size(), entry))
    for (const char* factor : factors)
      for (const double value : values) {
        JsonNode node = schema::nodeOf(value);
        node.line = entry.node.line;
        maker.add(levels, {{fmt::format("factors.{}", factor), node}}, fmt::format("{} x {:g}", factor, value), entry);
      }
}

/// Without axes the first variant is what the others are compared with.
void linkBaselines(Study& s) {
  if (s.axes.empty())
    for (Variant& v : s.variants) v.grid = true;
  for (Variant& v : s.variants) {
    std::vector<int> wanted = v.levels;
    for (std::size_t k = 0; k < s.compared.size(); ++k) wanted[static_cast<std::size_t>(s.compared[k])] = s.baseline[k];
    for (std::size_t i = 0; i < s.variants.size(); ++i)
      if (s.variants[i].grid && s.variants[i].levels == wanted) v.baseline = static_cast<int>(i);
  }
}

}  // namespace

Study readStudy(const std::filesystem::path& file) {
  const JsonNode root = readJson(file);
  const std::string name = file.string();
  const Entry entry{root, "", name};
  StudyInput in;
  schema::readObject(studyTable(), entry, &in);
  Study s;
  s.name = in.name;
  s.description = in.description;
  s.file = file;
  s.limits = in.limits;
  s.pictures = in.pictures;
  if (in.axes.empty() && in.variants.empty() && !in.population)
    entry.fail("one of axes, variants or population is required, and not empty");
  if (in.population) addPopulation(entry, in, s);
  for (std::size_t a = 0; a < in.axes.size(); ++a) {
    const Entry at = entry.member(*root.find("axes")).item(a);
    Axis axis = axisOf(at, in.axes[a]);
    for (const Axis& other : s.axes)
      if (other.name == axis.name)
        at.failAt("name", fmt::format("\"{}\" names two axes; allowed: a name of its own", axis.name));
    s.axes.push_back(std::move(axis));
  }
  if (!s.population) findBaseline(entry, in, s);
  Maker maker(entry, in, s);
  if (s.population) {
    addWearers(entry, maker, s);
  } else if (!s.axes.empty()) {
    const Entry axes = entry.member(*root.find("axes"));
    for (const auto& levels : combinations(allLevels(s), 1, axes)) maker.add(levels, {}, "", axes);
  }
  for (std::size_t i = 0; i < in.variants.size(); ++i) {
    const Entry at = entry.member(*root.find("variants")).item(i);
    std::vector<int> levels;
    for (std::size_t a = 0; a < s.axes.size(); ++a) levels.push_back(baselineLevel(s, a));
    if (in.variants[i].at.type != JsonNode::Type::null)
      for (const auto& [axis, level] : levelsAt(at.member(*at.node.find("at")), s)) levels[axis] = level;
    if (!at.node.find("set")) at.failAt("set", "is required: object path: value");
    maker.add(levels, settingsOf(at.member(*at.node.find("set"))), in.variants[i].label, at);
    s.variants.back().finer = in.variants[i].finer;
  }
  if (in.elasticities) addElasticities(entry, *in.elasticities, maker, s);
  if (!s.population) linkBaselines(s);
  return s;
}

Study batchOf(const std::vector<std::filesystem::path>& cases) {
  Study s;
  s.name = "Batch of cases";
  s.limits = publishedLimits();
  std::map<std::string, std::filesystem::path> seen;
  for (const std::filesystem::path& file : cases) {
    Variant v;
    v.folder = v.label = safe(file.stem().string());
    v.grid = true;
    if (const std::string why = files::unfitFolder(v.folder); !why.empty())
      throw InputError({"command line", 0, file.string()}, fmt::format("a case {}", why));
    if (const auto [other, fresh] = seen.insert({v.folder, file}); !fresh)
      throw InputError({"command line", 0, file.string()},
                       fmt::format("has the same name as {}; allowed: cases whose files have names of their own",
                                   other->second.string()));
    v.definition = readAnyCase(file);
    Maker::identify(v);
    s.variants.push_back(std::move(v));
  }
  return s;
}

}  // namespace gambeson::study
