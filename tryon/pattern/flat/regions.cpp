#include "tryon/pattern/flat/regions.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

namespace gambeson {
namespace {

using Part = RegionPart;
using Side = RegionSide;
using Face = RegionFace;

struct Word {
  std::string name;
  PanelRegion region;
};
const std::vector<Word>& words() {
  static const std::vector<Word> all{{"front", {Part::trunk, Side::both, Face::front}},
                                     {"back", {Part::trunk, Side::both, Face::back}},
                                     {"left_front", {Part::trunk, Side::left, Face::front}},
                                     {"right_front", {Part::trunk, Side::right, Face::front}},
                                     {"left_back", {Part::trunk, Side::left, Face::back}},
                                     {"right_back", {Part::trunk, Side::right, Face::back}},
                                     {"left_sleeve", {Part::sleeve, Side::left, Face::both}},
                                     {"right_sleeve", {Part::sleeve, Side::right, Face::both}},
                                     {"collar", {Part::collar, Side::both, Face::both}},
                                     {"waistband", {Part::waistband, Side::both, Face::both}},
                                     {"skirt_front", {Part::skirt, Side::both, Face::front}},
                                     {"skirt_back", {Part::skirt, Side::both, Face::back}},
                                     {"left_leg_front", {Part::leg, Side::left, Face::front}},
                                     {"left_leg_back", {Part::leg, Side::left, Face::back}},
                                     {"right_leg_front", {Part::leg, Side::right, Face::front}},
                                     {"right_leg_back", {Part::leg, Side::right, Face::back}}};
  return all;
}

/// What one word of a name says.
enum class Hint { left, right, front, back, skirt, leg, sleeve, collar, waistband, apart };

/// Whole words. Single letters count beside a longer word that says something.
const std::vector<std::pair<const char*, Hint>>& wholeWords() {
  static const std::vector<std::pair<const char*, Hint>> all{{"l", Hint::left},
                                                             {"lh", Hint::left},
                                                             {"left", Hint::left},
                                                             {"links", Hint::left},
                                                             {"linke", Hint::left},
                                                             {"linker", Hint::left},
                                                             {"linkes", Hint::left},
                                                             {"li", Hint::left},
                                                             {"gauche", Hint::left},
                                                             {"izq", Hint::left},
                                                             {"izquierda", Hint::left},
                                                             {"izquierdo", Hint::left},
                                                             {"r", Hint::right},
                                                             {"rh", Hint::right},
                                                             {"right", Hint::right},
                                                             {"rechts", Hint::right},
                                                             {"rechte", Hint::right},
                                                             {"rechter", Hint::right},
                                                             {"rechtes", Hint::right},
                                                             {"re", Hint::right},
                                                             {"droit", Hint::right},
                                                             {"droite", Hint::right},
                                                             {"derecha", Hint::right},
                                                             {"derecho", Hint::right},
                                                             {"f", Hint::front},
                                                             {"fr", Hint::front},
                                                             {"front", Hint::front},
                                                             {"ftorso", Hint::front},
                                                             {"devant", Hint::front},
                                                             {"vorne", Hint::front},
                                                             {"vorn", Hint::front},
                                                             {"delantero", Hint::front},
                                                             {"frente", Hint::front},
                                                             {"delantera", Hint::front},
                                                             {"b", Hint::back},
                                                             {"bk", Hint::back},
                                                             {"back", Hint::back},
                                                             {"btorso", Hint::back},
                                                             {"dos", Hint::back},
                                                             {"espalda", Hint::back},
                                                             {"hinten", Hint::back},
                                                             {"trasero", Hint::back},
                                                             {"trasera", Hint::back},
                                                             {"jupe", Hint::skirt},
                                                             {"falda", Hint::skirt},
                                                             {"leg", Hint::leg},
                                                             {"bein", Hint::leg},
                                                             {"jambe", Hint::leg},
                                                             {"pernera", Hint::leg},
                                                             {"pant", Hint::leg},
                                                             {"pants", Hint::leg},
                                                             {"jeans", Hint::leg},
                                                             {"pantalon", Hint::leg},
                                                             {"manche", Hint::sleeve},
                                                             {"manga", Hint::sleeve},
                                                             {"slv", Hint::sleeve},
                                                             {"cuello", Hint::collar},
                                                             {"wb", Hint::waistband},
                                                             {"bund", Hint::waistband},
                                                             {"ceinture", Hint::waistband},
                                                             {"pretina", Hint::waistband},
                                                             {"tie", Hint::apart},
                                                             {"poche", Hint::apart},
                                                             {"belt", Hint::apart}};
  return all;
}
/// Parts of words, as of "Vorderhose" and "waistband".
const std::vector<std::pair<const char*, Hint>>& wordParts() {
  static const std::vector<std::pair<const char*, Hint>> all{
      {"front", Hint::front},        {"vorder", Hint::front},        {"back", Hint::back},
      {"rueck", Hint::back},         {"hinter", Hint::back},         {"skirt", Hint::skirt},
      {"rock", Hint::skirt},         {"trouser", Hint::leg},         {"hose", Hint::leg},
      {"sleeve", Hint::sleeve},      {"aermel", Hint::sleeve},       {"collar", Hint::collar},
      {"kragen", Hint::collar},      {"waistband", Hint::waistband}, {"hosenbund", Hint::waistband},
      {"rockbund", Hint::waistband}, {"pocket", Hint::apart},        {"facing", Hint::apart},
      {"lining", Hint::apart},       {"tasche", Hint::apart},        {"beleg", Hint::apart},
      {"futter", Hint::apart},       {"bolsillo", Hint::apart},      {"cuff", Hint::apart},
      {"manschette", Hint::apart},   {"manchette", Hint::apart},     {"doublure", Hint::apart},
      {"forro", Hint::apart},        {"flap", Hint::apart},          {"placket", Hint::apart},
      {"loop", Hint::apart},         {"hood", Hint::apart},          {"kapuze", Hint::apart},
      {"gusset", Hint::apart},       {"strap", Hint::apart},         {"undercollar", Hint::apart}};
  return all;
}

/// Small letters of ASCII, with accents and umlauts written out; what is neither letter nor digit is a space.
std::string plain(std::string_view name) {
  static const std::array<std::pair<std::string_view, std::string_view>, 20> letters{
      {{"ä", "ae"}, {"Ä", "ae"}, {"ö", "oe"}, {"Ö", "oe"}, {"ü", "ue"}, {"Ü", "ue"}, {"ß", "ss"},
       {"é", "e"},  {"É", "e"},  {"è", "e"},  {"ê", "e"},  {"à", "a"},  {"á", "a"},  {"í", "i"},
       {"ó", "o"},  {"ú", "u"},  {"ñ", "n"},  {"ç", "c"},  {"Ç", "c"},  {"â", "a"}}};
  std::string out;
  char before = 0;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const auto known = std::find_if(letters.begin(), letters.end(),
                                    [&](const auto& l) { return name.substr(i).starts_with(l.first); });
    if (known != letters.end()) {
      const bool large = known->first < std::string_view("\xc3\xa0");  // "à", the first small one
      if (before >= 'a' && before <= 'z' && large) out += ' ';
      out += known->second;
      i += known->first.size() - 1;
      before = large ? 'A' : 'a';
      continue;
    }
    const char c = name[i];
    const bool small = c >= 'a' && c <= 'z', large = c >= 'A' && c <= 'Z';
    if (large && before >= 'a' && before <= 'z') out += ' ';  // "frontLeft"
    out += small ? c : large ? static_cast<char>(c - 'A' + 'a') : ' ';
    before = c;
  }
  return out;
}

std::vector<std::string> wordsOf(const std::string& text) {
  std::vector<std::string> out;
  std::string word;
  for (const char c : text + " ") {
    if (c != ' ') {
      word += c;
    } else if (!word.empty()) {
      out.push_back(word);
      word.clear();
    }
  }
  return out;
}

}  // namespace

const std::vector<std::string>& regionNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> out;
    for (const Word& w : words()) out.push_back(w.name);
    return out;
  }();
  return names;
}

std::optional<PanelRegion> regionOf(std::string_view word) {
  std::string key;
  for (const char c : word)
    key += c == ' ' || c == '-' ? '_' : c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  for (const Word& w : words())
    if (w.name == key) return w.region;
  return {};
}

std::string wordOf(const PanelRegion& region) {
  for (const Word& w : words())
    if (w.region == region) return w.name;
  return {};
}

std::string proposedRegion(std::string_view name) {
  std::set<Hint> hints, letters;
  for (const std::string& word : wordsOf(plain(name))) {
    if (word == "band") hints.insert(Hint::waistband);
    bool whole = word == "frock";
    for (const auto& [known, hint] : wholeWords())
      if (word == known) {
        (word.size() > 1 ? hints : letters).insert(hint);
        whole = true;
      }
    for (const auto& [part, hint] : wordParts())
      if (!whole && word.find(part) != std::string::npos) hints.insert(hint);
  }
  if (hints.empty() || hints.contains(Hint::apart)) return {};
  hints.insert(letters.begin(), letters.end());
  const auto has = [&](Hint h) { return hints.contains(h); };
  if ((has(Hint::left) && has(Hint::right)) || (has(Hint::front) && has(Hint::back))) return {};
  const Side side = has(Hint::left) ? Side::left : has(Hint::right) ? Side::right : Side::both;
  const Face face = has(Hint::front) ? Face::front : has(Hint::back) ? Face::back : Face::both;
  if (has(Hint::waistband)) hints.erase(Hint::skirt), hints.erase(Hint::leg);  // "skirt waistband"
  std::vector<Part> parts;
  for (const auto& [hint, part] : {std::pair(Hint::skirt, Part::skirt),
                                   {Hint::leg, Part::leg},
                                   {Hint::sleeve, Part::sleeve},
                                   {Hint::collar, Part::collar},
                                   {Hint::waistband, Part::waistband}})
    if (has(hint)) parts.push_back(part);
  if (parts.size() > 1) return {};
  const Part part = parts.empty() ? Part::trunk : parts[0];
  // Sleeves and collars are worn all around, whatever half of them it is; a skirt's seams tell its sides apart.
  const bool around = part == Part::sleeve || part == Part::collar || part == Part::waistband;
  const bool sided = part == Part::sleeve || part == Part::leg || part == Part::trunk;
  return wordOf({part, sided ? side : Side::both, around ? Face::both : face});
}

}  // namespace gambeson
