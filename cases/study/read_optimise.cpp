#include "cases/study/read_optimise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "cases/cloth/fabric.hpp"
#include "cases/input/table.hpp"
#include "cases/study/axes.hpp"
#include "cases/study/make_variant.hpp"
#include "cases/study/map_runs.hpp"

namespace gambeson::study {
namespace {

using schema::Entry;

constexpr std::size_t most_free = 8;  ///< of more a search of some dozen runs learns nothing

/// The regions of all garments, as the case has them.
std::vector<MapRegion> mapRegionsOf(const Case& c, const JsonNode& root) {
  std::vector<MapRegion> all;
  const bool list = root.find("garments");
  for (std::size_t g = 0; g < c.garments.size(); ++g)
    for (std::size_t r = 0; r < c.garments[g].regions.size(); ++r) {
      const RegionCase& region = c.garments[g].regions[r];
      const std::string garment = list ? fmt::format("garments[{}]", g) : std::string("garment");
      all.push_back({region.name, g, r, fmt::format("{}.regions[{}].thickness", garment, r), region.thickness,
                     c.factors.thickness * fabricOf(c, c.garments[g]).thickness(), false});
    }
  return all;
}

/// Finds each name among the regions; calls `found` with it.
template <class Found>
void eachNamed(const Entry& entry, const char* key, const std::vector<std::string>& wanted,
               std::vector<MapRegion>& regions, Found found) {
  std::vector<std::string> names;
  for (const MapRegion& r : regions) names.push_back(r.name);
  std::set<std::string> seen;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const Entry at = entry.member(*entry.node.find(key)).item(i);
    const auto r = std::find(names.begin(), names.end(), wanted[i]);
    if (r == names.end())
      at.fail(fmt::format("there is no region \"{}\"; allowed: {}", wanted[i], schema::joined(names)));
    if (!seen.insert(wanted[i]).second) at.fail(fmt::format("names \"{}\" twice", wanted[i]));
    found(regions[static_cast<std::size_t>(r - names.begin())], at);
  }
}

/// Which regions are free.
void chooseRegions(const Entry& entry, const OptimiseInput& in, std::vector<MapRegion>& regions) {
  if (!in.regions.empty()) {
    for (MapRegion& r : regions) r.kept = true;
    eachNamed(entry, "regions", in.regions, regions, [](MapRegion& r, const Entry&) { r.kept = false; });
  }
  const bool chosen = !in.regions.empty();
  eachNamed(entry, "keep", in.keep, regions, [&](MapRegion& r, const Entry& at) {
    if (chosen && !r.kept) at.fail(fmt::format("\"{}\" is among regions too; allowed: one of both", r.name));
    r.kept = true;
  });
  const auto free = static_cast<std::size_t>(std::ranges::count(regions, false, &MapRegion::kept));
  const std::size_t least = in.aim == Aim::torque ? 2 : 1;
  if (free < least || free > most_free)
    entry.fail(fmt::format("{} {} of the garment {} free; allowed: {} to {}{}", free, free == 1 ? "region" : "regions",
                           free == 1 ? "is" : "are", least, most_free,
                           regions.empty() ? " (the case names them: garment.regions)" : ""));
  for (const MapRegion& r : regions)
    if (!r.kept && !(r.factor >= in.between[0] && r.factor <= in.between[1]))
      entry.failAt("between", fmt::format("[{:g}, {:g}] leaves out the case's own factor of region \"{}\", {:g}",
                                          in.between[0], in.between[1], r.name, r.factor));
}

/// What a list of settings is called in tables.
std::string settingsName(const std::vector<Setting>& all) {
  std::string name;
  for (const Setting& s : all) {
    const std::string value = s.value.type == JsonNode::Type::text     ? s.value.text
                              : s.value.type == JsonNode::Type::number ? fmt::format("{:g}", s.value.number)
                                                                       : std::string("otherwise");
    name += fmt::format("{}{} {}", name.empty() ? "" : ", ", s.path, value);
  }
  return name;
}

/// Steps of four fifths, whatever limits them.
std::vector<Setting> shorterSteps(const TimeCase& time, int line) {
  std::vector<Setting> all;
  const auto add = [&](const char* key, double value) {
    all.push_back({fmt::format("time.{}", key), schema::nodeOf(0.8 * value)});
    all.back().value.line = line;
  };
  if (time.step_s > 0) {
    add("step", time.step_s);
  } else {
    add("step_safety", time.step_safety);
    add("max_step", time.max_step_s);
  }
  return all;
}

void readRepeats(const Entry& entry, const OptimiseInput& in, const TimeCase& time, Optimise& o) {
  if (in.repeats.type == JsonNode::Type::null) {
    o.repeats = {{"", shorterSteps(time, entry.node.line)}};
  } else {
    const Entry at = entry.member(*entry.node.find("repeats"));
    if (at.node.type != JsonNode::Type::list) at.fail("expected a list [ ], not " + describe(at.node));
    if (at.node.children.size() > 10) at.fail("more than 10 repeats; allowed: at most 10");
    for (std::size_t i = 0; i < at.node.children.size(); ++i) o.repeats.emplace_back("", settingsOf(at.item(i)));
  }
  for (auto& [name, set] : o.repeats) name = settingsName(set);
  if (in.finer.type != JsonNode::Type::null) o.finer = settingsOf(entry.member(*entry.node.find("finer")));
}

}  // namespace

void readOptimise(const Entry& root, const StudyInput& in, Study& s) {
  const OptimiseInput& from = *in.optimise;
  const Entry entry = root.member(*root.node.find("optimise"));
  for (const char* key : {"axes", "variants", "elasticities", "uncertainty", "population", "baseline"})
    if (root.node.find(key))
      root.failAt(key, "excludes optimise, which finds its variants itself; allowed: one of both");
  Optimise& o = s.optimise.emplace();
  o.aim = from.aim;
  o.joints = from.joints;
  o.mass_kg = from.mass_kg;
  o.least = from.between[0];
  o.most = from.between[1];
  o.step = from.step.value_or(0.25 * (o.most - o.least));
  o.runs = from.runs;
  o.line = entry.node.line;
  if (o.aim == Aim::mass && !from.limit_Nm) entry.failAt("limit", "is required where the mass is minimised");
  if (o.aim == Aim::torque && from.limit_Nm) entry.failAt("limit", "is for \"minimise\": \"mass\"");
  if (o.aim == Aim::mass && from.mass_kg) entry.failAt("mass", "is for \"minimise\": \"torque\"");
  o.limit_Nm = from.limit_Nm.value_or(0);
  o.base = readJson(in.file);
  o.case_file = in.file;
  if (in.set.type != JsonNode::Type::null) o.common = settingsOf(root.member(*root.node.find("set")));
  // Some dozen runs, of which the page shows two.
  if (std::ranges::none_of(o.common, [](const Setting& set) { return set.path.starts_with("output.pictures"); }))
    o.common.push_back({"output.pictures", schema::emptyList()});
  Variant first;
  first.label = "as the case is";
  JsonNode whole = o.base;
  defineVariant(s, whole, o.case_file, o.common, first);
  const auto* c = std::get_if<Case>(&first.definition);
  if (!c || !c->human) entry.fail("is for garments that a human wears: the case has none");
  readRepeats(entry, from, c->time, o);
  o.regions = mapRegionsOf(*c, whole);
  chooseRegions(entry, from, o.regions);
  for (std::size_t i = 0; i < o.joints.size(); ++i)
    if (!c->analysis.joints.empty() && std::ranges::find(c->analysis.joints, o.joints[i]) == c->analysis.joints.end())
      entry.member(*entry.node.find("joints"))
          .item(i)
          .fail(fmt::format("the case does not analyse \"{}\"; allowed: {}", o.joints[i],
                            schema::joined(c->analysis.joints)));
  // All that the search will set is tried before anything runs.
  std::vector<double> map;
  for (const MapRegion* r : o.free()) map.push_back(r->factor);
  s.variants.push_back(mapVariant(s, map, {}, ""));
  for (std::size_t i = 0; i < o.repeats.size(); ++i) mapVariant(s, map, o.repeats[i].second, repeatName(i));
  if (!o.finer.empty()) s.variants.push_back(mapVariant(s, map, o.finer, kFiner));
}

}  // namespace gambeson::study
