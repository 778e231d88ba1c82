#include "cases/wear/case/human.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cases/input/wrong_entry.hpp"
#include "human/body/body_file.hpp"
#include "human/body/skin.hpp"
#include "human/body/urdf.hpp"
#include "human/manikin/manikin.hpp"
#include "human/skin/make_skin.hpp"

namespace gambeson {

namespace {

void tell(WearerNotes* notes, const std::string& fact) {
  if (notes) notes->facts.push_back(fact);
}

Human measured(const ManikinMeasures& measures, WearerNotes* notes) {
  MeasuresReport made;
  Human human = underKey("manikin", [&] { return makeManikin(measures, &made); });
  for (const MadeGirth& g : made.girths)
    tell(notes, fmt::format("manikin: {} {:.1f} cm, asked for {:.1f} cm", g.name, 100 * g.made_m, 100 * g.asked_m));
  if (notes) notes->notes.insert(notes->notes.end(), made.notes.begin(), made.notes.end());
  return human;
}

Human fromCharacter(const CharacterOptions& options, WearerNotes* notes) {
  CharacterReport found;
  Human human = loadCharacter(options, &found);
  const std::string file = options.file.filename().string();
  tell(notes, fmt::format("character {}: bones as in the map {}, {}-pose (arms {:.0f} degrees from hanging down), "
                          "{:.3f} m tall, {:.1f} litres",
                          file, found.map, found.pose, found.arms_deg, found.height_m, 1000 * found.volume_m3));
  for (const std::string& note : found.notes) tell(notes, fmt::format("character {}: {}", file, note));
  return human;
}

Human fromScan(const ScanOptions& options, WearerNotes* notes) {
  ScanReport found;
  Human human = loadScan(options, &found);
  const std::string file = options.file.filename().string();
  for (const std::string& note : found.notes) tell(notes, fmt::format("scan {}: {}", file, note));
  tell(notes, fmt::format("scan {}: {}-pose (arms {:.0f} degrees from hanging down), {:.3f} m tall, {:.1f} litres",
                          file, found.pose, found.arms_deg, found.height_m, 1000 * found.volume_m3));
  std::string girths;
  for (const ScanGirth& g : found.girths) {
    std::string name = g.name;
    std::replace(name.begin(), name.end(), '_', ' ');
    girths += fmt::format("{}{} {:.1f}, {:.1f}", girths.empty() ? "" : "; ", name, 100 * g.scan_m, 100 * g.standing_m);
  }
  if (!girths.empty()) tell(notes, fmt::format("scan {}: girths in cm as scanned, and standing: {}", file, girths));
  return human;
}

}  // namespace

Human skeletonOf(const HumanCase& h, WearerNotes* notes) {
  if (!h.manikin.empty()) return makeManikin(h.manikin);
  if (h.measures) return measured(*h.measures, notes);
  if (h.character) return fromCharacter(*h.character, notes);
  if (h.scan) return fromScan(*h.scan, notes);
  if (!h.segments.empty()) return markedHuman(h.segments);
  return h.body.empty() ? loadUrdf(h.urdf) : loadHuman(h.urdf, h.body);
}

Human humanOf(const HumanCase& h, WearerNotes* notes) {
  Human human = skeletonOf(h, notes);
  if (h.skin) human.skin = std::make_shared<const Skin>(makeSkin(human, *h.skin));
  return human;
}

std::string wearerName(const HumanCase& h) {
  if (h.character) return h.character->file.stem().string();
  if (h.scan) return h.scan->file.stem().string();
  return h.manikin.empty() ? "own" : h.manikin;
}

}  // namespace gambeson
