#include "cases/pattern/pattern_file.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <numbers>

#include "cases/input/wrong_entry.hpp"
#include "cases/pattern/pattern_fields.hpp"
#include "core/error.hpp"
#include "tryon/pattern/flat/panel_check.hpp"

namespace gambeson {
namespace {

bool toNumber(std::string_view text, double& x) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(x);
}

/// What stands before the last `word`, which stays out of both.
bool cut(std::string_view& text, std::string_view word, std::string_view& after) {
  const std::size_t at = text.rfind(word);
  if (at == std::string_view::npos) return false;
  after = text.substr(at + word.size());
  text = text.substr(0, at);
  return true;
}

SeamPart readPart(const schema::Entry& p, std::string_view text, const std::vector<Panel>& panels) {
  const std::string whole(text);
  const auto fail = [&](const std::string& reason) { p.fail("\"" + whole + "\" " + reason); };
  SeamPart part;
  if (std::string_view rest = text, nothing; rest.ends_with(" reversed") && cut(rest, " reversed", nothing)) {
    text = rest;
    std::swap(part.from, part.to);
  } else {
    std::string_view to, from;
    rest = text;
    if (cut(rest, " to ", to) && cut(rest, " from ", from) && toNumber(to, part.to) && toNumber(from, part.from))
      text = rest;
  }
  std::string_view number, name = text;
  double edge = -1;
  if (!cut(name, ".", number) || !toNumber(number, edge) || edge != std::floor(edge) || !(edge >= 0 && edge < 1e6))
    fail("names no edge; allowed: PANEL.EDGE, as \"front.3\", \"front.3 reversed\" or \"front.3 from 0.25 to 1\"");
  part.edge = static_cast<int>(edge);
  std::vector<std::string> names;
  for (const Panel& q : panels) {
    if (q.name == name) {
      part.panel = static_cast<int>(names.size());
      return part;
    }
    names.push_back(q.name);
  }
  const std::string near = schema::closest(name, names);
  fail("names no panel of this file" + (near.empty() ? std::string() : "; did you mean \"" + near + "\"?"));
  return part;
}

std::vector<SeamPart> readSide(const schema::Entry& seam, const char* key, const std::vector<std::string>& texts,
                               const std::vector<Panel>& panels) {
  std::vector<SeamPart> out;
  const schema::Entry side = seam.member(*seam.node.find(key));
  for (std::size_t k = 0; k < texts.size(); ++k) out.push_back(readPart(side.item(k), texts[k], panels));
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

std::string partText(const FlatPattern& pattern, const SeamPart& part) {
  const std::string edge = fmt::format("{}.{}", pattern.panels[static_cast<std::size_t>(part.panel)].name, part.edge);
  if (part.from == 0 && part.to == 1) return edge;
  if (part.from == 1 && part.to == 0) return edge + " reversed";
  return fmt::format("{} from {} to {}", edge, part.from, part.to);
}

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
