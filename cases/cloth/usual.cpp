#include "cases/cloth/usual.hpp"

#include <fmt/format.h>

#include "analysis/ticks.hpp"
#include "cases/cloth/card.hpp"
#include "cases/input/typed.hpp"

namespace gambeson {
namespace {

using schema::between;
using schema::Entry;
using schema::Object;

/// Wider than any textile that we know of, from silk organza (20 g/m^2, 0.05 mm) to felt and armour of many layers:
/// beyond it a unit was mistaken, not a fabric found. Stiffest are fibres alone (M5, 3e11 Pa); their cloth reaches a
/// third of it.
struct Usual {
  std::string_view title, key;  ///< of the table and its field
  schema::Range range;
};

const std::vector<Usual>& rows() {
  static const std::vector<Usual> all{
      {"Fabric", "thickness", between(2e-5, 0.02)},
      {"Fabric", "density", between(20, 3000)},
      {"Fabric", "surface_density", between(0.005, 20)},
      {"Fabric", "young", between(1e3, 1e11)},
      {"Fabric", "young_weft", between(1e3, 1e11)},
      {"Fabric", "young_warp", between(1e3, 1e11)},
      {"Fabric", "shear", between(10, 1e11)},
      {"Fabric", "stiffness", between(1, 1e8)},
      {"Fabric", "stiffness_weft", between(1, 1e8)},
      {"Fabric", "stiffness_warp", between(1, 1e8)},
      {"Fabric", "shear_stiffness", between(0.1, 1e8)},
      {"Fabric card", "thickness", between(2e-5, 0.02)},
      {"Fabric card", "weight", between(0.005, 5)},
  };
  return all;
}

const Usual* usualOf(const Object& object, const std::string& key) {
  for (const Usual& u : rows())
    if (u.title == object.title && u.key == key) return &u;
  return nullptr;
}

void warnOf(const Usual& usual, const std::string& unit, const Entry& entry, std::vector<InputError>& warnings) {
  const bool text = entry.node.type == JsonNode::Type::text;
  if (!text && entry.node.type != JsonNode::Type::number) return;
  Quantity typed{.si = entry.node.number, .unit = unit};
  try {
    if (text) typed = readQuantity(entry.node.text, unit);
  } catch (const InputError&) {
    return;
  }
  if (usual.range.contains(typed.si)) return;
  const std::string value = text ? entry.node.text : fmt::format("{:.6g} {}", entry.node.number, unit);
  warnings.push_back(InputError(
      {entry.node.line == 0 ? "command line" : entry.file, entry.node.line, entry.path},
      fmt::format("{} is unusual: fabrics have {}; check its unit", value, schema::rangeText(usual.range, typed))));
}

void walk(const Object& object, const Entry& entry, std::vector<InputError>& warnings) {
  if (entry.node.type != JsonNode::Type::object) return;
  for (const JsonNode& child : entry.node.children) {
    const schema::Field* field = object.find(child.key);
    if (!field) continue;
    const Entry member = entry.member(child);
    if (const Usual* usual = usualOf(object, child.key)) warnOf(*usual, field->unit, member, warnings);
    if (!field->object) continue;
    walk(*field->object, member, warnings);
    if (child.type == JsonNode::Type::list)
      for (std::size_t i = 0; i < child.children.size(); ++i) walk(*field->object, member.item(i), warnings);
  }
}

}  // namespace

std::vector<InputError> unusualNumbers(const Object& object, const Entry& entry) {
  std::vector<InputError> warnings;
  walk(object, entry, warnings);
  return warnings;
}

std::vector<std::string> unusualNumbers(const Object& object, const JsonNode& written) {
  const std::string none;
  std::vector<std::string> texts;
  for (const InputError& w : unusualNumbers(object, Entry{written, "", none}))
    texts.push_back(w.where().key + ": " + w.reason());
  return texts;
}

std::vector<std::string> assumedThicknesses(const JsonNode& written) {
  const std::string none;
  std::vector<std::string> notes;
  const auto look = [&](const auto& self, const Entry& entry) -> void {
    const JsonNode *assumed = entry.node.find("thickness_assumed"), *thickness = entry.node.find("thickness");
    if (assumed && assumed->boolean && thickness)
      notes.push_back(fmt::format(
          "{}: {} mm is assumed, the weight over {} kg/m^3, since nobody gave one; no force per width depends on it, "
          "but stress in Pa does",
          entry.member(*thickness).path, formatNumber(1000 * thickness->number, 3),
          formatNumber(kCardDensity_kg_per_m3)));
    for (std::size_t i = 0; i < entry.node.children.size(); ++i)
      self(self, entry.node.type == JsonNode::Type::list ? entry.item(i) : entry.member(entry.node.children[i]));
  };
  look(look, Entry{written, "", none});
  return notes;
}

std::vector<InputError> unusualOfCard(const std::filesystem::path& card) {
  const JsonNode root = readJson(card);
  const std::string name = card.string();
  return unusualNumbers(schema::cardTable(), Entry{root, "", name});
}

}  // namespace gambeson
