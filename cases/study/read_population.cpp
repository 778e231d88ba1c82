#include "cases/study/read_population.hpp"

#include "cases/input/table.hpp"
#include "cases/study/axes.hpp"
#include "cases/study/make_variant.hpp"

namespace gambeson::study {

using schema::Entry;

namespace {

/// Messages about a value that the study makes point at the line that it follows from.
void placeAt(JsonNode& node, int line) {
  node.line = line;
  for (JsonNode& child : node.children) placeAt(child, line);
}

}  // namespace

void addPopulation(const Entry& root, const StudyInput& in, Study& s) {
  const Entry at = root.member(*root.node.find("population"));
  for (const char* key : {"axes", "variants", "elasticities", "uncertainty", "baseline"})
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
    Level level{size.label, "size " + size.label, "size_" + folderName(size.label), {}, {}};
    if (size.set.type != JsonNode::Type::null)
      level.set = settingsOf(list.item(k).member(*list.item(k).node.find("set")));
    sizes.levels.push_back(std::move(level));
  }
  s.axes.push_back(std::move(sizes));
}

void addWearers(const Entry& root, Maker& maker, Study& s) {
  const Entry at = root.member(*root.node.find("population"));
  const Population& p = *s.population;
  for (std::size_t w = 0; w < p.wearers.size(); ++w) {
    if (!p.sized()) maker.add({static_cast<int>(w)}, {}, "", at);
    for (const int size : p.wearers[w].sizes) {
      std::vector<Setting> grades;
      for (const Grade& g : p.input.grades) {
        JsonNode ease = schema::nodeOf(easeOf(g, p.input.sizes[static_cast<std::size_t>(size)], p.wearers[w].measures));
        placeAt(ease, at.node.line);
        grades.push_back({g.path, ease});
      }
      maker.add({static_cast<int>(w), size}, grades, "", at);
      s.variants.back().grid = true;
    }
  }
  if (s.variants.empty()) at.failAt("sizes", "no size is wide enough for any wearer; allowed: one that is");
}

}  // namespace gambeson::study
