#include "cases/command/new_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <istream>
#include <nlohmann/json.hpp>
#include <ostream>
#include <vector>

#include "cases/cloth/card_library.hpp"
#include "cases/input/message.hpp"
#include "cases/input/schema.hpp"
#include "cases/wear/case/case.hpp"
#include "cases/wear/run/run.hpp"
#include "core/error.hpp"
#include "core/io/own_file.hpp"
#include "human/manikin/manikin.hpp"

namespace gambeson {
namespace {

using Json = nlohmann::ordered_json;

struct Motion {
  const char *word, *in_title, *json;
};
constexpr Motion motions[]{{"stand", "standing", R"({"stand": {"duration": "0.5 s"}})"},
                           {"walk", "walking", R"({"walk": {"strides": 1}})"},
                           {"stairs", "climbing stairs", R"({"stairs": {"strides": 1, "lead_in_strides": 0}})"},
                           {"step_over", "stepping over an obstacle", R"({"step_over": {"height": "0.25 m"}})"},
                           {"sit", "sitting down", R"({"sit": {}})"},
                           {"aim", "taking aim", R"({"aim": {"duration": "1.5 s"}})"}};
struct Cells {
  const char *word, *size;
};
constexpr Cells sizes[]{{"coarse", "35 mm"}, {"medium", "25 mm"}, {"fine", "18 mm"}};
const std::vector<std::string> drafts{"shorts", "trousers", "shirt", "sleeves"};

/// Of the stature: legs down to the ankle, and sleeves to the wrist, a few centimetres shorter than the longest that
/// the manikins' drafts reach (0.416 and 0.308 of it on the smallest woman).
constexpr double legs = 0.40, sleeves = 0.295, scanned_stature_m = 1.65;

template <class List>
std::vector<std::string> wordsOf(const List& list) {
  std::vector<std::string> words;
  for (const auto& one : list) words.push_back(one.word);
  return words;
}

std::vector<std::string> cardNames() {
  std::vector<std::string> names;
  for (const auto& [name, text] : libraryCards()) names.emplace_back(name);
  return names;
}

bool holds(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// What may be answered: one of some words, or a file with one of some endings.
struct Question {
  std::string NewCase::*answer;
  const char *option, *asks, *usual;
  std::vector<std::string> words, endings;
  const char* file;  ///< what such a file is

  std::string allowed() const {
    std::string text = schema::joined(words);
    if (!endings.empty()) text += fmt::format(", or {} ({})", file, schema::joined(endings));
    return text;
  }
  void check(const std::string& said) const {
    const auto refuse = [&](const std::string& why) {
      throw InputError({"command line", 0, option}, fmt::format("{}; allowed: {}", why, allowed()));
    };
    if (holds(words, said)) return;
    if (!holds(endings, std::filesystem::path(said).extension().string()))
      refuse(fmt::format("there is no \"{}\"", said));
    if (!std::filesystem::is_regular_file(said)) refuse(fmt::format("there is no file {}", said));
  }
};

std::vector<Question> questions() {
  return {{&NewCase::garment, "--garment", "What is worn?", "shorts", drafts, {".json"}, "a pattern's file"},
          {&NewCase::fabric, "--fabric", "Of which fabric?", "denim_a", cardNames(), {".json"}, "a card's file"},
          {&NewCase::wearer, "--wearer", "Who wears it?", "male_p50", manikinNames(), {".obj", ".ply"}, "a body scan"},
          {&NewCase::motion, "--motion", "What does the wearer do?", "stand", wordsOf(motions), {}, ""},
          {&NewCase::cells,
           "--cells",
           "How fine is the cloth computed? Fine takes some ten times as long as coarse.",
           "coarse",
           wordsOf(sizes),
           {},
           ""}};
}

std::string centimetres(double m) { return fmt::format("{:.0f} cm", 100 * m); }

bool isDraft(const NewCase& a) { return holds(drafts, a.garment); }
bool isOnLegs(const NewCase& a) { return a.garment == "shorts" || a.garment == "trousers"; }

/// A file as the case names it, from the case's folder.
std::string fromCase(const NewCase& a, const std::string& file) {
  const std::filesystem::path folder = std::filesystem::absolute(a.file).parent_path();
  return std::filesystem::proximate(std::filesystem::absolute(file), folder).string();
}

Json garmentOf(const NewCase& a, double stature_m) {
  const char* cell =
      std::find_if(std::begin(sizes), std::end(sizes), [&](const Cells& c) { return a.cells == c.word; })->size;
  if (!isDraft(a)) return {{"pattern", {{"path", fromCase(a, a.garment)}, {"cell", cell}}}, {"model", "triangles"}};
  Json of;
  if (isOnLegs(a)) {
    const std::string inseam = a.garment == "shorts" ? "20 cm" : centimetres(legs * stature_m);
    of["shorts"] = {{"inseam", inseam}, {"ease", "12 %"}, {"waist_ease", "6 %"}, {"cell", cell}};
  } else {
    of["shirt"] = Json::object();
    if (a.garment == "sleeves")
      of["shirt"] = {{"sleeve_length", centimetres(sleeves * stature_m)}, {"sleeve_ease", "15 %"}};
    of["shirt"]["cell"] = cell;
  }
  of["samples_per_cell"] = 3;  // with two, cloth bulges into a body between them
  return of;
}

/// "Trousers of denim_a on male_p50, walking".
std::string titleOf(const NewCase& a, const Motion& motion) {
  std::string worn = a.garment == "sleeves" ? "shirt with sleeves"
                     : isDraft(a)           ? a.garment
                                            : std::filesystem::path(a.garment).stem().string();
  worn[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(worn[0])));
  const auto named = [](const std::string& word) { return std::filesystem::path(word).stem().string(); };
  return fmt::format("{} of {} on {}, {}", worn, named(a.fabric), named(a.wearer), motion.in_title);
}

Json caseOf(const NewCase& a) {
  const bool scanned = !holds(manikinNames(), a.wearer);
  const Motion& motion =
      *std::find_if(std::begin(motions), std::end(motions), [&](const Motion& m) { return a.motion == m.word; });
  Json c;
  c["name"] = titleOf(a, motion);
  c["garment"] = garmentOf(a, scanned ? scanned_stature_m : makeManikin(a.wearer).stature_m);
  c["fabric"] = {{"card", isLibraryName(a.fabric) ? a.fabric : fromCase(a, a.fabric)}};
  c["human"] = scanned ? Json{{"scan", {{"file", fromCase(a, a.wearer)}, {"bridge_folds", "10 mm"}}}}
                       : Json{{"manikin", a.wearer}, {"skin", {{"cell", "14 mm"}}}};
  c["human"]["motion"] = Json::parse(motion.json);
  if (isOnLegs(a))
    c["supports"] = Json::array({{{"springs", {{"edge", "waist"}, {"stiffness", "8000 N/m^2"}, {"link", "pelvis"}}}}});
  c["contact"] = {{"friction", 0.3}};
  if (isOnLegs(a)) c["dressing"]["projecting"] = {{"clearance", "5 mm"}, {"grow", "0.3 s"}};
  if (!isDraft(a)) c["dressing"]["layer_by_layer"] = true;
  c["dressing"]["settle"] = "0.5 s";
  Json joints = Json::array();
  for (const char* joint : {"hip_flexion", "knee_flexion", "shoulder_flexion", "elbow_flexion"})
    for (const char* side : {"left", "right"})
      if (!isDraft(a) || isOnLegs(a) == (joint[0] == 'h' || joint[0] == 'k'))
        joints.push_back(fmt::format("{}_{}", joint, side));
  c["analysis"] = {{"joints", joints}, {"counting", "all_distal"}};
  return c;
}

/// As people write it: what fits into a line stands in one.
std::string laidOut(const Json& j, std::size_t indent = 0, bool in_line = false) {
  constexpr std::size_t kWidth = 100;
  if (!j.is_structured()) return j.dump();
  const auto text = [&](bool one_line) {
    const std::size_t inner = indent + 2;
    const std::string between = one_line ? " " : "\n" + std::string(inner, ' ');
    std::string out;
    for (const auto& [key, value] : j.items()) {
      out += (out.empty() ? (one_line ? "" : between) : "," + between);
      if (j.is_object()) out += fmt::format("\"{}\": ", key);
      out += laidOut(value, inner, one_line);
    }
    if (!one_line) out += "\n" + std::string(indent, ' ');
    return (j.is_object() ? "{" : "[") + out + (j.is_object() ? "}" : "]");
  };
  const std::string line = text(true);
  return in_line || indent + line.size() <= kWidth ? line : text(false);
}

}  // namespace

void askForCase(NewCase& answers, std::istream& in, std::ostream& out) {
  for (const Question& q : questions()) {
    std::string& answer = answers.*q.answer;
    if (!answer.empty()) continue;
    out << q.asks << "\n  " << q.allowed() << "\n";
    while (answer.empty()) {
      out << fmt::format("[{}] ", q.usual) << std::flush;
      std::string line;
      if (!std::getline(in, line) || line.empty()) line = q.usual;
      try {
        q.check(line);
        answer = line;
      } catch (const InputError& e) {
        out << messageText(e.reason()) << "\n";
      }
    }
  }
}

int writeNewCase(const NewCase& given, std::ostream& out) {
  NewCase a = given;
  for (const Question& q : questions()) {
    std::string& answer = a.*q.answer;
    if (answer.empty()) answer = q.usual;
    q.check(answer);
  }
  if (a.file.empty()) a.file = fmt::format("{}_{}.json", std::filesystem::path(a.garment).stem().string(), a.motion);
  if (std::filesystem::exists(a.file))
    throw InputError({"command line", 0, "CASE"},
                     fmt::format("{} is there already; allowed: a new name", a.file.string()));
  writeOwnFile(a.file, laidOut(caseOf(a)) + "\n");
  const Case c = readCase(a.file);
  out << fmt::format("{}: written. It is checked ...\n", a.file.string()) << std::flush;
  for (const std::string& line : checkRun(c)) out << "  " << messageText(line) << "\n";
  out << fmt::format("It is valid. To run it, with a report at the end:\n  gambeson run {}\n", a.file.string());
  return 0;
}

}  // namespace gambeson
