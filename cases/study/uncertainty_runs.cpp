#include "cases/study/uncertainty_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/uncertainty/latin_hypercube.hpp"
#include "cases/cloth/card.hpp"
#include "cases/input/table.hpp"
#include "cases/wear/case/fields.hpp"
#include "cases/wear/case/references.hpp"

namespace gambeson::study {
namespace {

using schema::Entry;

/// The largest that the cards of the fabrics say; `card`: whose it is.
std::optional<double> spreadOfCards(const Case& c, std::optional<double> FabricSpread::*which, std::string& card) {
  std::optional<double> most;
  const auto look = [&](const FabricCase& f) {
    if (f.card.empty()) return;
    const FabricCard of = readCard(f.card);
    const std::optional<double> spread = of.spread_of.*which;
    if (spread && (!most || *spread > *most)) most = spread, card = "the card of " + of.name;
  };
  for (const GarmentCase& g : c.garments) {
    look(g.fabric ? *g.fabric : c.fabric);
    for (const FabricCase& f : g.other_fabrics) look(f);
  }
  return most;
}

Setting settingOf(const Entry& entry, const std::string& path, double value, bool whole = false) {
  JsonNode node = schema::nodeOf(value);
  node.is_integer = whole;
  node.line = entry.node.line;
  return {path, node};
}

/// Cells of all garments, smaller by `times`.
std::vector<Setting> finerCells(const Entry& entry, double times, const Case& c, const JsonNode& root) {
  const JsonNode written = schema::writeObject(schema::caseTable(), &c);
  const JsonNode* list = written.find("garments");
  const bool single = root.find("garment") != nullptr;
  std::vector<Setting> all;
  for (std::size_t g = 0; g < c.garments.size(); ++g) {
    const JsonNode& garment = list ? list->children[g] : *written.find("garment");
    const std::size_t before = all.size();
    for (const JsonNode& shape : garment.children) {
      if (shape.type != JsonNode::Type::object || shape.key == "fabric") continue;
      for (const JsonNode& value : shape.children) {
        if (value.type != JsonNode::Type::number || !value.key.starts_with("cell")) continue;
        const std::string path = fmt::format(
            "{}.{}.{}", single ? std::string("garment") : fmt::format("garments[{}]", g), shape.key, value.key);
        if (value.key == "cell") {
          all.push_back(settingOf(entry, path, value.number / times));
        } else if (value.key.starts_with("cells")) {
          const double part =
              shape.key == "skirt" && value.key == "cells_around" ? 8 : 1;  // one for each of its panels
          all.push_back(settingOf(entry, path, part * std::ceil(value.number * times / part - 1e-9), true));
        }
      }
    }
    if (all.size() == before)
      entry.failAt("finer", fmt::format("the cells of {} are those of its file; allowed: 1, and a variant with "
                                        "\"finer\": true that names a finer one",
                                        c.garments[g].name.empty() ? "the garment" : c.garments[g].name));
  }
  return all;
}

std::vector<Setting> halfSteps(const Entry& entry, double duration_s, const TimeCase& t) {
  std::vector<Setting> all{settingOf(entry, "time.step_safety", 0.5 * t.step_safety),
                           settingOf(entry, "time.max_step", 0.5 * t.max_step_s),
                           settingOf(entry, "time.duration", duration_s)};
  if (t.step_s > 0) all.push_back(settingOf(entry, "time.step", 0.5 * t.step_s));
  return all;
}

/// The factors of a sample: those of the reference times its own.
std::vector<Setting> sampleOf(const Entry& entry, const std::vector<StudiedSpread>& spreads,
                              const std::vector<double>& scores, const FactorsCase& reference) {
  FactorsCase f = reference;
  for (std::size_t k = 0; k < spreads.size(); ++k) {
    const double times = multipleOf(spreads[k].deviation, scores[k]);
    if (spreads[k].name == "thickness") f.thickness *= times, f.bending /= times * times * times;
    if (spreads[k].name == "moduli") f.membrane *= times;
    if (spreads[k].name == "bending") f.bending *= times;
    if (spreads[k].name == "friction") f.friction *= times;
  }
  std::vector<Setting> all;
  for (const auto& [key, which] :
       {std::pair("thickness", &FactorsCase::thickness), std::pair("membrane", &FactorsCase::membrane),
        std::pair("bending", &FactorsCase::bending), std::pair("friction", &FactorsCase::friction)})
    if (f.*which != reference.*which) all.push_back(settingOf(entry, fmt::format("factors.{}", key), f.*which));
  return all;
}

}  // namespace

Uncertainty uncertaintyOf(const Entry& entry, const UncertaintyInput& in, const Case& c, bool meshes_of_its_own) {
  Uncertainty asked;
  for (const auto& [name, which] : kSpreads) {
    std::string source = "the study";
    std::optional<double> spread = in.spread.*which;
    if (!spread) spread = spreadOfCards(c, which, source);
    if (!spread)
      asked.unknown.emplace_back(name);
    else if (*spread > 0)
      asked.spreads.push_back({std::string(name), *spread, source});
  }
  asked.source = in.source;
  asked.runs = asked.spreads.empty() ? 0 : in.runs;
  asked.step = in.step;
  asked.mesh = in.finer.value_or(meshes_of_its_own ? 1 : 1.5) > 1;
  if (asked.runs == 0 && !asked.step && !asked.mesh)
    entry.fail("asks for nothing; allowed: a spread, step or finer (no card of a fabric has spread_of)");
  return asked;
}

std::vector<UncertaintyRun> uncertaintyRuns(const Entry& entry, const UncertaintyInput& in, const Uncertainty& asked,
                                            const Case& c, const JsonNode& root) {
  std::vector<UncertaintyRun> runs;
  if (asked.mesh) {
    const double times = in.finer.value_or(1.5);
    runs.push_back(
        {BarPart::mesh, fmt::format("cells {:g} times smaller", times), finerCells(entry, times, c, root), {}});
  }
  if (asked.step) {
    const double planned = plannedDuration(c), frame = c.output.frame_s;
    const double half = std::min(planned, frame * std::max(1.0, std::ceil(0.5 * planned / frame - 1e-9)));
    const double played = in.step_duration_s.value_or(half);
    if (!(played <= planned))
      entry.failAt("step_duration",
                   fmt::format("{} s is out of range; allowed: at most the motion's {} s", played, planned));
    runs.push_back({BarPart::step, "half steps", halfSteps(entry, played, c.time), {}});
  }
  if (asked.runs == 0) return runs;
  const auto scores =
      latinHypercube(asked.runs, static_cast<int>(asked.spreads.size()), static_cast<std::uint64_t>(in.seed));
  const int digits = static_cast<int>(std::to_string(asked.runs).size());
  for (std::size_t i = 0; i < scores.size(); ++i)
    runs.push_back({BarPart::fabric, fmt::format("fabric {:0{}}", i + 1, digits),
                    sampleOf(entry, asked.spreads, scores[i], c.factors), scores[i]});
  return runs;
}

}  // namespace gambeson::study
