#include "cases/pattern/dxf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>

#include "cases/input/schema.hpp"
#include "cases/pattern/dxf_piece.hpp"
#include "cases/pattern/dxf_write.hpp"
#include "cases/pattern/pattern_file.hpp"
#include "core/error.hpp"
#include "tryon/pattern/flat/panel_check.hpp"
#include "tryon/pattern/flat/panel_geometry.hpp"
#include "tryon/pattern/flat/propose_seams.hpp"

namespace gambeson {
namespace {

/// Largest panels of clothes lie between these.
constexpr double kSmall_m = 0.15, kLarge_m = 2.5;

[[noreturn]] void reject(const std::filesystem::path& file, const std::string& key, const std::string& reason) {
  throw InputError({file.string(), 0, key}, reason);
}

/// "KEY: value" texts of a style or a piece.
std::string value(const std::vector<DxfEntity>& entities, const std::string& key) {
  for (const DxfEntity& e : entities)
    if (const auto said = systemText(e); said && said->first == key) return said->second;
  return "";
}

/// Width and height of the largest boundary, in the file's unit.
Vec2 largest(const DxfFile& dxf) {
  Vec2 most{0, 0};
  const auto take = [&](const std::vector<DxfEntity>& entities) {
    Vec2 low{1e300, 1e300}, high{-1e300, -1e300};
    for (const DxfEntity& e : entities)
      if (e.layer == "1" && e.kind == DxfEntity::Kind::polyline)
        for (const Vec2& p : e.points) {
          low = {std::min(low.x, p.x), std::min(low.y, p.y)};
          high = {std::max(high.x, p.x), std::max(high.y, p.y)};
        }
    if (high.x - low.x > most.x) most = {high.x - low.x, high.y - low.y};
  };
  for (const DxfBlock& b : dxf.blocks) take(b.entities);
  if (most.x == 0) take(dxf.entities);
  return most;
}

/// The unit that the file says: in the words of the standard, or of AutoCAD.
std::string unitOf(const std::filesystem::path& file, const DxfFile& dxf, const ImportChoices& choices,
                   std::vector<std::string>& notes) {
  std::string word = value(dxf.entities, "UNITS");
  for (std::size_t b = 0; word.empty() && b < dxf.blocks.size(); ++b) word = value(dxf.blocks[b].entities, "UNITS");
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::toupper(c); });
  const std::map<std::string, std::string> words{{"METRIC", "mm"},   {"MM", "mm"},          {"MILLIMETERS", "mm"},
                                                 {"CM", "cm"},       {"CENTIMETERS", "cm"}, {"ENGLISH", "in"},
                                                 {"IMPERIAL", "in"}, {"INCH", "in"},        {"INCHES", "in"}};
  const std::map<int, std::string> numbers{{1, "in"}, {2, "ft"}, {4, "mm"}, {5, "cm"}, {6, "m"}};
  std::string said;
  if (const auto known = words.find(word); known != words.end()) said = known->second;
  const auto number = numbers.find(dxf.insert_units);
  if (!said.empty() && number != numbers.end() && number->second != said)
    notes.push_back(fmt::format("UNITS: {} means {}, $INSUNITS {} means {}: the text counts; --unit overrules it", word,
                                said, dxf.insert_units, number->second));
  if (said.empty() && number != numbers.end()) said = number->second;
  if (!choices.unit.empty()) {
    if (!said.empty() && metresOf(said) != metresOf(choices.unit))
      notes.push_back(fmt::format("the file says {}; read in {} as asked for", said, choices.unit));
    return choices.unit;
  }
  if (!said.empty()) return said;
  const Vec2 size = largest(dxf);
  reject(file, "units",
         fmt::format("the file does not say its unit ({}no $INSUNITS){}; its largest piece is {:.4g} by {:.4g}: {:.0f} "
                     "cm wide in mm, {:.0f} cm in inches. Say which with --unit mm, --unit cm or --unit in",
                     word.empty() ? "no UNITS: METRIC or ENGLISH, "
                                  : "UNITS: " + word.substr(0, 20) +
                                        " is neither METRIC "
                                        "nor ENGLISH, ",
                     dxf.measurement < 0    ? ""
                     : dxf.measurement == 0 ? ", only $MEASUREMENT 0, which hints at inches"
                                            : ", only $MEASUREMENT 1, which hints at mm",
                     size.x, size.y, 0.1 * size.x, 2.54 * size.x));
}

/// Which size of a graded pattern, or empty where there is one.
std::string sizeOf(const std::filesystem::path& file, const DxfFile& dxf, const std::vector<const DxfBlock*>& pieces,
                   const ImportChoices& choices) {
  std::set<std::string> sizes;
  for (const DxfBlock* b : pieces) sizes.insert(value(b->entities, "SIZE"));
  std::vector<std::string> list(sizes.begin(), sizes.end());
  std::erase(list, "");
  if (!choices.size.empty()) {
    if (!sizes.contains(choices.size))
      throw InputError({"command line", 0, "--size"},
                       fmt::format("there is no size \"{}\" in {}; allowed: {}", choices.size, file.string(),
                                   list.empty() ? "none, it has no sizes" : schema::joined(list)));
    return choices.size;
  }
  if (list.size() < 2) return "";
  const std::string sample = value(dxf.entities, "SAMPLE SIZE");
  if (sizes.contains(sample) && !sample.empty()) return sample;
  reject(file, "SIZE",
         fmt::format("there are {} sizes and no SAMPLE SIZE; say which with --size: {}", list.size(),
                     schema::joined(list)));
}

/// By how much the only insert of a block enlarges it.
double scaleOf(const std::filesystem::path& file, const DxfFile& dxf, const std::string& block,
               std::vector<std::string>& notes) {
  for (const DxfEntity& e : dxf.entities) {
    if (e.kind != DxfEntity::Kind::insert || e.text != block) continue;
    const double s = e.scale[0];
    if (!(s > 1e-6 && s < 1e6) || std::abs(e.scale[1] - s) > 1e-6 * s)
      reject(file, "INSERT of \"" + block + "\"",
             fmt::format("is scaled by {:g} and {:g}; allowed: the same positive number for x and y", e.scale[0],
                         e.scale[1]));
    if (std::abs(s - 1) < 1e-6) return 1;
    notes.push_back(fmt::format("block \"{}\" is inserted {:g} times as large as it is drawn, and read so", block, s));
    return s;
  }
  return 1;
}

/// Programs that write cm call that METRIC too.
void doubtUnit(const FlatPattern& pattern, std::vector<std::string>& notes) {
  double most = 0;
  for (const Panel& p : pattern.panels) {
    const PanelBox box = boxOf(p.outline);
    most = std::max({most, box.high.x - box.low.x, box.high.y - box.low.y});
  }
  if (most < kSmall_m || most > kLarge_m)
    notes.push_back(
        fmt::format("the largest panel measures {:.1f} cm in {}; if that is not so, say the unit with --unit",
                    100 * most, pattern.source.unit));
}

void checkFinite(const std::filesystem::path& file, const DxfFile& dxf) {
  const auto check = [&](const std::vector<DxfEntity>& entities, const std::string& where) {
    for (const DxfEntity& e : entities) {
      bool good = std::isfinite(e.size);
      for (const Vec2& p : e.points) good = good && std::isfinite(p.x) && std::isfinite(p.y);
      for (const double b : e.bulges) good = good && std::isfinite(b);
      if (!good)
        reject(file, where, fmt::format("a {} on layer {} has a number that is none; mend the file", e.type, e.layer));
    }
  };
  for (const DxfBlock& b : dxf.blocks) check(b.entities, "block \"" + b.name + "\"");
  check(dxf.entities, "ENTITIES");
}

/// Blocks with a boundary.
std::vector<const DxfBlock*> piecesOf(const DxfFile& dxf) {
  std::vector<const DxfBlock*> out;
  for (const DxfBlock& b : dxf.blocks)
    if (std::any_of(b.entities.begin(), b.entities.end(), [](const DxfEntity& e) {
          return e.layer == "1" && (e.kind == DxfEntity::Kind::polyline || e.kind == DxfEntity::Kind::circle);
        }))
      out.push_back(&b);
  return out;
}

/// Piece names, or where two pieces share one, names of their blocks.
void nameApart(std::vector<Panel>& panels, const std::vector<const DxfBlock*>& blocks,
               std::vector<std::string>& notes) {
  std::map<std::string, int> count;
  for (const Panel& p : panels) ++count[p.name];
  for (std::size_t k = 0; k < panels.size(); ++k)
    if (count[panels[k].name] > 1) {
      notes.push_back(fmt::format("PIECE NAME: {} names {} pieces; block \"{}\" gives its name to one of them",
                                  panels[k].name, count[panels[k].name], blocks[k]->name));
      panels[k].name = blocks[k]->name;
    }
}

bool isSeam(const DxfEntity& e) { return e.kind == DxfEntity::Kind::text && e.text.starts_with(kDxfSeam); }

/// The seams of texts of ours (patternDxf).
std::vector<PanelSeam> seamsIn(const std::filesystem::path& file, const DxfFile& dxf, const FlatPattern& pattern) {
  JsonNode root = patternNode(pattern), seams;
  seams.type = JsonNode::Type::list;
  seams.key = "seams";
  for (const DxfEntity& e : dxf.entities)
    if (isSeam(e)) {
      try {
        seams.children.push_back(parseJson(e.text.substr(std::strlen(kDxfSeam)), file.string()));
      } catch (const InputError& bad) {
        reject(file, fmt::format("GAMBESON SEAM text {}", seams.children.size() + 1), bad.reason());
      }
    }
  if (seams.children.empty()) return {};
  std::erase_if(root.children, [](const JsonNode& n) { return n.key == "seams"; });
  root.children.push_back(std::move(seams));
  try {
    return readPattern(root, "").seams;
  } catch (const InputError& e) {
    reject(file, e.where().key, e.reason());
  }
}

}  // namespace

ImportedPattern readDxf(const std::filesystem::path& file, const ImportChoices& choices) {
  const DxfFile dxf = readDxfFile(file);
  checkFinite(file, dxf);
  ImportedPattern out;
  std::vector<const DxfBlock*> all = piecesOf(dxf);
  const auto none = [&] {
    reject(file, "BLOCKS",
           "holds no piece: no block has a polyline on layer 1, which is where AAMA and ASTM D6673 have boundaries. "
           "Export the pattern as DXF-AAMA or DXF-ASTM");
  };
  if (all.empty() && largest(dxf).x == 0) none();
  const std::string unit = unitOf(file, dxf, choices, out.notes);
  std::vector<DxfBlock> loose;
  DxfCounts counts;
  if (all.empty()) {
    loose = loosePieces(dxf.entities, metresOf(unit), counts);
    for (const DxfBlock& b : loose) all.push_back(&b);
    if (all.empty()) none();
    out.notes.push_back("has no blocks: each closed line of layer 1 in ENTITIES is a piece, with what lies within it");
  }
  const std::string size = sizeOf(file, dxf, all, choices);
  std::vector<const DxfBlock*> blocks;
  for (const DxfBlock* b : all)
    if (const std::string its = value(b->entities, "SIZE"); size.empty() || its.empty() || its == size)
      blocks.push_back(b);
  if (blocks.size() < all.size())
    out.dropped.push_back(fmt::format("{} pieces of other sizes than {}", all.size() - blocks.size(), size));
  FlatPattern& pattern = out.pattern;
  const std::string style = value(dxf.entities, "STYLE NAME");
  pattern.name = style.empty() ? file.stem().string() : style;
  pattern.source = {file.filename().string(), "DXF-AAMA/ASTM", unit};
  for (const DxfBlock* b : blocks)
    pattern.panels.push_back(
        panelOf(file, *b, metresOf(unit) * scaleOf(file, dxf, b->name, out.notes), choices.unfold, out.notes, counts));
  for (std::string& words : counts.words()) out.dropped.push_back(std::move(words));
  std::string style_texts;
  for (const DxfEntity& e : dxf.entities)
    if (const auto said = systemText(e);
        said && said->first != "STYLE NAME" && said->first != "UNITS" && said->first != "SAMPLE SIZE")
      style_texts += (style_texts.empty() ? "" : ", ") + said->first;
  if (!style_texts.empty()) out.dropped.push_back("texts of the style: " + style_texts);
  for (const char* ending : {".rul", ".RUL"})
    if (std::filesystem::path rules = file; std::filesystem::exists(rules.replace_extension(ending)))
      out.dropped.push_back("grade rules (" + rules.filename().string() +
                            " beside it): sizes are read as they are drawn");
  nameApart(pattern.panels, blocks, out.notes);
  try {
    checkPattern(pattern);
    if (choices.unit.empty()) doubtUnit(pattern, out.notes);
    pattern.seams = seamsIn(file, dxf, pattern);
    if (pattern.seams.empty()) {
      ProposedSeams proposed = proposeSeams(pattern);
      pattern.seams = std::move(proposed.seams);
      if (proposed.edges_left > 0)
        out.notes.push_back(fmt::format("{} edges fit no other and are in no proposed seam", proposed.edges_left));
    }
    checkPattern(pattern);
  } catch (const InputError& e) {
    if (!e.where().file.empty()) throw;
    throw InputError({file.string(), 0, e.where().key}, e.reason());
  }
  return out;
}

}  // namespace gambeson
