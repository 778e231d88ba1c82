/// Detail of study.hpp: from the file of a study to its variants.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "cases/input/mistakes.hpp"
#include "cases/input/table.hpp"
#include "cases/input/units.hpp"
#include "cases/study/files.hpp"
#include "cases/study/input.hpp"
#include "core/error.hpp"

namespace gambeson::study {
namespace {

using schema::Entry;

constexpr std::size_t most_variants = 2000;

[[noreturn]] void tooMany(const Entry& at) { at.fail("more than 2,000 variants; allowed: at most 2,000 together"); }

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

/// What a folder's name may have.
std::string safe(const std::string& text) {
  std::string s;
  for (const char c : text)
    s += (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+'
             ? c
             : '_';
  return s;
}

/// Messages about a value that the study makes point at the line that it follows from.
void placeAt(JsonNode& node, int line) {
  node.line = line;
  for (JsonNode& child : node.children) placeAt(child, line);
}

std::vector<Setting> settingsOf(const Entry& entry) {
  if (entry.node.type != JsonNode::Type::object)
    entry.fail("expected an object { } of path: value, not " + describe(entry.node));
  if (entry.node.children.empty()) entry.fail("is empty; allowed: at least one path: value");
  std::vector<Setting> all;
  for (const JsonNode& child : entry.node.children) all.push_back({child.key, child});
  return all;
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

/// Builds and checks variants one by one.
class Maker {
 public:
  Maker(const Entry& entry, const StudyInput& in, Study& study) : entry_(entry), in_(in), study_(study) {
    base_ = readJson(in.file);
    if (in.set.type != JsonNode::Type::null) common_ = settingsOf(entry.member(*entry.node.find("set")));
  }

  void add(std::vector<int> levels, const std::vector<Setting>& more, const std::string& extra_label, const Entry& at) {
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

  static void identify(Variant& v) {
    v.identity = std::visit([](const auto& c) { return caseIdentity(c); }, v.definition);
    if (const auto* c = std::get_if<Case>(&v.definition)) {
      Case rest = *c;
      rest.factors = {};
      rest.name = "rest";
      v.rest_identity = caseIdentity(rest);
    }
  }

 private:
  /// The name and description of the case tell its own motion, which a variant may replace: a variant has the study's.
  void introduce(Variant& v) const {
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

  const Entry& entry_;
  const StudyInput& in_;
  Study& study_;
  JsonNode base_;
  std::vector<Setting> common_;
  std::set<std::string> folders_;
};

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

/// Axes of the wearers and of their sizes, and a variant for each size that a wearer tries.
void addPopulation(const Entry& root, const StudyInput& in, Study& s) {
  const Entry at = root.member(*root.node.find("population"));
  for (const char* key : {"axes", "variants", "elasticities", "baseline"})
    if (root.node.find(key)) root.failAt(key, "excludes population; allowed: one of both");
  s.population = drawPopulation(*in.population);
  s.compared = {0};
  s.baseline = {0};  // in the order of the wearers; none of them is what others are compared with
  Axis wearers;
  wearers.name = "wearer";
  wearers.role = Role::wearer;
  wearers.labelled = true;
  for (const Wearer& w : s.population->wearers) {
    JsonNode manikin = manikinNode(w.measures);
    placeAt(manikin, at.node.line);
    wearers.levels.push_back({w.label, w.name, w.folder, {{"human.manikin", manikin}}, {}});
  }
  s.axes.push_back(std::move(wearers));
  if (!s.population->sized()) return;
  Axis sizes;
  sizes.name = "size";
  sizes.role = Role::size;
  sizes.labelled = true;
  const Entry list = at.member(*at.node.find("sizes"));
  for (std::size_t k = 0; k < in.population->sizes.size(); ++k) {
    const GarmentSize& size = in.population->sizes[k];
    Level level{size.label, "size " + size.label, "size_" + safe(size.label), {}, {}};
    if (size.set.type != JsonNode::Type::null)
      level.set = settingsOf(list.item(k).member(*list.item(k).node.find("set")));
    sizes.levels.push_back(std::move(level));
  }
  s.axes.push_back(std::move(sizes));
}

/// A variant for each wearer, or for each size that a wearer tries.
void addWearers(const Entry& root, Maker& maker, Study& s) {
  const Entry at = root.member(*root.node.find("population"));
  const Population& p = *s.population;
  for (std::size_t w = 0; w < p.wearers.size(); ++w) {
    if (!p.sized()) maker.add({static_cast<int>(w)}, {}, "", at);
    for (const int size : p.wearers[w].sizes) {
      std::vector<Setting> grades;
      for (const Grade& g : p.input.grades) {
        JsonNode ease =
            schema::nodeOf(easeOf(g, p.input.sizes[static_cast<std::size_t>(size)], p.wearers[w].measures));
        placeAt(ease, at.node.line);
        grades.push_back({g.path, ease});
      }
      maker.add({static_cast<int>(w), size}, grades, "", at);
      s.variants.back().grid = true;
    }
  }
  if (s.variants.empty()) at.failAt("sizes", "no size is wide enough for any wearer; allowed: one that is");
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
