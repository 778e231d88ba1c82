#include "cases/pattern/seam_text.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "cases/input/schema.hpp"
#include "core/error.hpp"
#include "tryon/pattern/flat/panel_geometry.hpp"

namespace gambeson {
namespace {

[[noreturn]] void reject(std::string_view text, const std::string& reason) {
  throw InputError({"", 0, ""}, fmt::format("\"{}\" {}", text, reason));
}

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

int edgeNumber(std::string_view whole, std::string_view word, const Panel& panel) {
  if (double number = -1; toNumber(word, number)) {
    if (number == std::floor(number) && number >= 0 && number < edgeCount(panel)) return static_cast<int>(number);
    reject(whole, fmt::format("names no edge: there is no edge {} of panel \"{}\"; allowed: {}", word, panel.name,
                              edgesText(panel)));
  }
  int found = -1, count = 0;
  for (int e = 0; e < edgeCount(panel); ++e)
    if (edgeOf(panel, e).name == word) found = e, ++count;
  if (count == 1) return found;
  reject(whole, count > 1
                    ? fmt::format("names {} edges of panel \"{}\"; allowed: one, by its number", count, panel.name)
                    : fmt::format("names no edge of panel \"{}\"; allowed: {}", panel.name, edgesText(panel)));
}

}  // namespace

std::string edgesText(const Panel& panel) {
  std::string out = fmt::format("0 to {}", edgeCount(panel) - 1);
  for (int e = 0; e < edgeCount(panel); ++e)
    if (const std::string& name = edgeOf(panel, e).name; !name.empty()) out += fmt::format(", {} ({})", name, e);
  return out;
}

SeamPart partOf(std::string_view text, std::span<const Panel> panels) {
  const std::string_view whole = text;
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
  std::string_view name = text, edge;
  if (!cut(name, ".", edge) || edge.empty())
    reject(whole,
           "names no edge; allowed: PANEL.EDGE, as \"front.3\", \"front.hem\", \"front.3 reversed\" or \"front.3 "
           "from 0.25 to 1\"");
  std::vector<std::string> names;
  for (const Panel& panel : panels) {
    if (panel.name == name) {
      part.panel = static_cast<int>(names.size());
      part.edge = edgeNumber(whole, edge, panel);
      return part;
    }
    names.push_back(panel.name);
  }
  const std::string near = schema::closest(name, names);
  reject(whole, "names no panel of this pattern; " +
                    (near.empty() ? "allowed: " + schema::joined(names) : "did you mean \"" + near + "\"?"));
}

std::string partText(const FlatPattern& pattern, const SeamPart& part) {
  const std::string edge = fmt::format("{}.{}", pattern.panels[static_cast<std::size_t>(part.panel)].name, part.edge);
  if (part.from == 0 && part.to == 1) return edge;
  if (part.from == 1 && part.to == 0) return edge + " reversed";
  return fmt::format("{} from {} to {}", edge, part.from, part.to);
}

}  // namespace gambeson
