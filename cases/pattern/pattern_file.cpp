#include "cases/pattern/pattern_file.hpp"

#include "cases/input/wrong_entry.hpp"
#include "cases/pattern/pattern_fields.hpp"
#include "cases/pattern/seam_text.hpp"
#include "core/error.hpp"
#include "tryon/pattern/flat/panel_check.hpp"

namespace gambeson {
namespace {

std::vector<SeamPart> readSide(const schema::Entry& seam, const char* key, const std::vector<std::string>& texts,
                               const std::vector<Panel>& panels) {
  std::vector<SeamPart> out;
  const schema::Entry side = seam.member(*seam.node.find(key));
  for (std::size_t k = 0; k < texts.size(); ++k) try {
      out.push_back(partOf(texts[k], panels));
    } catch (const InputError& e) {
      side.item(k).fail(e.reason());
    }
  return out;
}

/// JSON in few lines: what fits on one stands on one.
void write(const JsonNode& node, std::size_t indent, std::string& out) {
  constexpr std::size_t widest = 118;
  const bool object = node.type == JsonNode::Type::object, list = node.type == JsonNode::Type::list;
  if (!object && !list) {
    out += schema::toText(node);
    return;
  }
  std::vector<std::string> parts;
  std::size_t length = 2;
  bool flat = true;
  for (const JsonNode& child : node.children) {
    std::string part;
    if (object) {
      JsonNode key;
      key.type = JsonNode::Type::text;
      key.text = child.key;
      part = schema::toText(key) + ": ";
    }
    write(child, indent + 1, part);
    flat = flat && part.find('\n') == std::string::npos;
    length += part.size() + 2;
    parts.push_back(std::move(part));
  }
  const bool one_line = flat && indent + length <= widest;
  const std::string between = one_line ? ", " : ",\n" + std::string(indent + 1, ' ');
  out += object ? '{' : '[';
  for (std::size_t k = 0; k < parts.size(); ++k) out += (k > 0 ? between : std::string()) + parts[k];
  out += object ? '}' : ']';
}

}  // namespace

bool isPattern(const JsonNode& root) {
  const JsonNode* format = root.type == JsonNode::Type::object ? root.find("format") : nullptr;
  return format && format->type == JsonNode::Type::text && format->text.starts_with("gambeson pattern");
}

FlatPattern readPattern(const JsonNode& root, const std::string& file) {
  schema::PatternInput in;
  const schema::Entry entry{root, "", file};
  schema::readObject(schema::patternTable(), entry, &in);
  FlatPattern& pattern = in.pattern;
  const JsonNode* seams = root.find("seams");
  for (std::size_t k = 0; k < in.seams.size(); ++k) {
    const schema::SeamInput& s = in.seams[k];
    const schema::Entry seam = entry.member(*seams).item(k);
    pattern.seams.push_back({s.name, readSide(seam, "a", s.a, pattern.panels), readSide(seam, "b", s.b, pattern.panels),
                             s.use, s.stiffness_N, s.proposed, s.open, s.buttons, s.rest_angle_rad});
  }
  try {
    checkPattern(pattern);
  } catch (const InputError& e) {
    sayAt(entry, e);
  }
  return std::move(pattern);
}

FlatPattern readPattern(const std::filesystem::path& file) {
  return readPattern(readJson(file, {.bytes = kPatternBytes}), file.string());
}

JsonNode patternNode(const FlatPattern& pattern) {
  schema::PatternInput in;
  in.pattern = pattern;
  for (const PanelSeam& s : pattern.seams) {
    schema::SeamInput seam{s.name, {}, {}, s.use, s.stiffness_N, s.proposed, s.open, s.buttons, s.rest_angle_rad};
    for (const SeamPart& p : s.a) seam.a.push_back(partText(pattern, p));
    for (const SeamPart& p : s.b) seam.b.push_back(partText(pattern, p));
    in.seams.push_back(std::move(seam));
  }
  JsonNode root = schema::writeObject(schema::patternTable(), &in);
  for (JsonNode& panel : root.find("panels")->children)
    std::erase_if(panel.children, [](const JsonNode& n) {
      return n.key != "outline" && n.type == JsonNode::Type::list && n.children.empty();
    });
  return root;
}

std::string patternText(const FlatPattern& pattern) {
  std::string out;
  write(patternNode(pattern), 0, out);
  return out + "\n";
}

}  // namespace gambeson
