/// Detail of study.hpp: from the file of a study to its variants.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <set>

#include "cases/input/table.hpp"
#include "cases/study/axes.hpp"
#include "cases/study/files.hpp"
#include "cases/study/input.hpp"
#include "cases/study/make_variant.hpp"
#include "cases/study/maker.hpp"
#include "cases/study/read_optimise.hpp"
#include "cases/study/read_population.hpp"
#include "cases/study/uncertainty_runs.hpp"
#include "core/error.hpp"

namespace gambeson::study {
namespace {

using schema::Entry;

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

/// Takes of each axis that the key "where" names the levels that it lists.
void takeWhere(const Entry& entry, const Study& s, std::vector<std::vector<int>>& choices,
               const std::function<void(const Entry&, const Axis&)>& check) {
  const JsonNode* list = entry.node.find("where");
  if (!list) return;
  const Entry where = entry.member(*list);
  if (list->type != JsonNode::Type::object)
    where.fail("expected an object { } of axis: list of labels, not " + describe(*list));
  for (const JsonNode& child : where.node.children) {
    const Entry at = where.member(child);
    const std::size_t axis = axisNamed(at, s, child.key);
    check(at, s.axes[axis]);
    if (child.type != JsonNode::Type::list || child.children.empty())
      at.fail("expected a list of labels, not " + describe(child));
    choices[axis].clear();
    for (std::size_t i = 0; i < child.children.size(); ++i)
      choices[axis].push_back(levelNamed(at.item(i), s.axes[axis], child.children[i]));
  }
}

std::vector<PictureCase> usualPictures(const StudyInput& in) {
  PictureCase stress{PictureTime::peak, 0, PictureField::stress, View::front_right};
  if (!in.optimise) return {stress};
  std::vector<PictureCase> all{stress, stress, stress};
  all[0].field = all[1].field = PictureField::thickness;
  all[0].around = all[1].around = PictureAround::garment;
  all[1].view = View::back_left;
  return all;
}

void addElasticities(const Entry& root, const ElasticityInput& in, Maker& maker, Study& s) {
  const Entry entry = root.member(*root.node.find("elasticities"));
  std::vector<std::vector<int>> choices = allLevels(s);
  for (std::size_t a = 0; a < s.axes.size(); ++a)
    if (isFactor(s.axes[a])) choices[a] = {baselineLevel(s, a)};
  takeWhere(entry, s, choices, [](const Entry& at, const Axis& axis) {
    if (isFactor(axis)) at.fail("is an axis of factors, which stay at the baseline; allowed: another axis");
  });
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

/// Adds to each reference the runs that tell how sure its numbers are. Without axes the first variant is one, whose
/// values are `first`.
void addUncertainty(const Entry& root, const UncertaintyInput& in, const std::vector<Setting>& first, Maker& maker,
                    Study& s) {
  const Entry entry = root.member(*root.node.find("uncertainty"));
  std::vector<std::vector<int>> choices = allLevels(s);
  bool meshes = std::any_of(s.variants.begin(), s.variants.end(), [](const Variant& v) { return v.finer; });
  for (std::size_t a = 0; a < s.axes.size(); ++a) {
    const Role role = s.axes[a].role;
    meshes = meshes || (role == Role::mesh && s.axes[a].levels.size() > 1);
    if (role == Role::mesh || isFactor(s.axes[a]) || isChosen(role)) choices[a] = {baselineLevel(s, a)};
  }
  takeWhere(entry, s, choices, [](const Entry&, const Axis&) {});
  for (const auto& levels : combinations(choices, 1, entry)) {
    std::size_t reference = 0;
    while (!s.axes.empty() && !(s.variants[reference].grid && s.variants[reference].levels == levels)) ++reference;
    const auto* held = std::get_if<Case>(&s.variants[reference].definition);
    if (!held) entry.fail("is of worn cloth; allowed: a study of cases without \"kind\"");
    const Case c = *held;  // variants are added below
    s.uncertainty = uncertaintyOf(entry, in, c, meshes);
    for (UncertaintyRun& run : uncertaintyRuns(entry, in, *s.uncertainty, c, maker.root())) {
      std::vector<Setting> set = first;
      set.insert(set.end(), run.set.begin(), run.set.end());
      const std::string label = s.axes.empty() ? s.variants[0].label + ", " + run.label : run.label;
      maker.add(levels, set, label, entry);
      Variant& v = s.variants.back();
      v.part = run.part;
      v.finer = run.part == BarPart::mesh;
      v.reference = static_cast<int>(reference);
      v.scores = std::move(run.scores);
    }
  }
}

/// Without axes the first variant is what the others are compared with.
void linkBaselines(Study& s) {
  if (s.axes.empty())
    for (Variant& v : s.variants) v.grid = v.part == BarPart::none;
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
  s.pictures = in.pictures.value_or(usualPictures(in));
  for (PictureCase& p : s.pictures) {
    const PictureSize size = sizeOf(p, {720, 960});  // several stand side by side
    p.width = size.width, p.height = size.height;
  }
  if (in.optimise) {
    readOptimise(entry, in, s);
    return s;
  }
  if (in.axes.empty() && in.variants.empty() && !in.uncertainty && !in.population)
    entry.fail("one of axes, variants, optimise, uncertainty or population is required, and not empty");
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
  if (s.variants.empty()) maker.add({}, {}, "the case", entry);
  if (in.elasticities) addElasticities(entry, *in.elasticities, maker, s);
  if (in.uncertainty) {
    const auto first = s.axes.empty() && !in.variants.empty()
                           ? settingsOf(entry.member(*root.find("variants")).item(0).member(in.variants[0].set))
                           : std::vector<Setting>{};
    addUncertainty(entry, *in.uncertainty, first, maker, s);
  }
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
    v.folder = v.label = folderName(file.stem().string());
    v.grid = true;
    if (const std::string why = files::unfitFolder(v.folder); !why.empty())
      throw InputError({"command line", 0, file.string()}, fmt::format("a case {}", why));
    if (const auto [other, fresh] = seen.insert({v.folder, file}); !fresh)
      throw InputError({"command line", 0, file.string()},
                       fmt::format("has the same name as {}; allowed: cases whose files have names of their own",
                                   other->second.string()));
    v.definition = readAnyCase(file);
    identify(v);
    s.variants.push_back(std::move(v));
  }
  return s;
}

}  // namespace gambeson::study
