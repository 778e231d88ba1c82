#include "cases/pattern/seam_edits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "cases/input/wrong_entry.hpp"
#include "cases/pattern/seam_text.hpp"
#include "tryon/pattern/flat/panel_check.hpp"

namespace gambeson {
namespace {

constexpr std::string_view kSeams = "seams[";

[[noreturn]] void reject(const char* key, const std::string& reason) { throw InputError({"", 0, key}, reason); }

/// The seam of an error's key, "seams[k]...", and what follows it; -1: of no seam.
int seamOf(const InputError& e, std::string& rest) {
  const std::string& key = e.where().key;
  const std::size_t end = key.find(']');
  if (!key.starts_with(kSeams) || end == std::string::npos) return -1;
  rest = key.substr(end + 1);
  return std::atoi(key.c_str() + kSeams.size());
}

/// The seam that a text names, by its name or by an edge that is sewn in it.
std::size_t find(const FlatPattern& pattern, const std::string& text) {
  std::vector<std::string> names;
  if (text.empty()) reject("seam", "is empty; allowed: the name of a seam, or an edge that is sewn, as \"front.3\"");
  for (std::size_t k = 0; k < pattern.seams.size(); ++k) {
    if (pattern.seams[k].name == text) return k;
    if (!pattern.seams[k].name.empty()) names.push_back(pattern.seams[k].name);
  }
  const std::string allowed =
      (names.empty() ? "" : schema::joined(names) + ", or ") + std::string("an edge that is sewn, as \"front.3\"");
  if (text.find('.') == std::string::npos) {
    const std::string near = schema::closest(text, names);
    reject("seam", fmt::format("\"{}\" is no seam of this pattern; {}", text,
                               near.empty() ? "allowed: " + allowed : "did you mean \"" + near + "\"?"));
  }
  const SeamPart edge = underKey("seam", [&] { return partOf(text, pattern.panels); });
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < pattern.seams.size(); ++k)
    for (const auto* side : {&pattern.seams[k].a, &pattern.seams[k].b})
      if (std::any_of(side->begin(), side->end(),
                      [&](const SeamPart& p) { return p.panel == edge.panel && p.edge == edge.edge; }) &&
          (found.empty() || found.back() != k))
        found.push_back(k);
  if (found.empty()) reject("seam", fmt::format("\"{}\" is sewn to nothing; allowed: {}", text, allowed));
  if (found.size() > 1)
    reject("seam", fmt::format("\"{}\" is in {} seams; allowed: one of them by its name{}", text, found.size(),
                               names.empty() ? ", which they lack: name them in the pattern's file" : ""));
  return found[0];
}

std::vector<SeamPart> sideOf(const char* key, const std::vector<std::string>& texts, const FlatPattern& pattern) {
  std::vector<SeamPart> side;
  for (std::size_t k = 0; k < texts.size(); ++k)
    side.push_back(underKey(fmt::format("{}[{}]", key, k), [&] { return partOf(texts[k], pattern.panels); }));
  return side;
}

template <class T>
void take(const std::optional<T>& said, T& to) {
  if (said) to = *said;
}

void apply(const SeamEdit& edit, int number, EditedPattern& to) {
  FlatPattern& pattern = to.pattern;
  const bool adds = !edit.a.empty() || !edit.b.empty();
  std::size_t k = pattern.seams.size();
  if (adds) {
    if (std::any_of(pattern.seams.begin(), pattern.seams.end(),
                    [&](const PanelSeam& s) { return s.name == edit.seam; }))
      reject("seam",
             fmt::format("\"{}\" is a seam already; allowed with \"a\" and \"b\": the name of a new one, or its "
                         "name after an entry that says \"remove\": true of it",
                         edit.seam));
    PanelSeam seam;
    seam.name = edit.seam;
    seam.a = sideOf("a", edit.a, pattern);
    seam.b = sideOf("b", edit.b, pattern);
    pattern.seams.push_back(std::move(seam));
    to.origins.emplace_back();
  } else {
    k = find(pattern, edit.seam);
  }
  if (edit.remove) {
    pattern.seams.erase(pattern.seams.begin() + static_cast<std::ptrdiff_t>(k));
    to.origins.erase(to.origins.begin() + static_cast<std::ptrdiff_t>(k));
    return;
  }
  PanelSeam& seam = pattern.seams[k];
  take(edit.use, seam.use);
  take(edit.open, seam.open);
  take(edit.buttons, seam.buttons);
  take(edit.stiffness_N, seam.stiffness_N);
  take(edit.rest_angle_rad, seam.rest_angle_rad);
  seam.proposed = false;
  to.origins[k].edit = number;
}

}  // namespace

InputError EditedPattern::inFile(const InputError& e) const {
  std::string rest;
  const int k = seamOf(e, rest);
  if (k < 0 || k >= static_cast<int>(origins.size())) return e;
  return {{"", 0, fmt::format("seams[{}]{}", origins[static_cast<std::size_t>(k)].file, rest)}, e.reason()};
}

bool EditedPattern::isOfEdit(const InputError& e, std::string& key) const {
  std::string rest;
  const int k = seamOf(e, rest);
  if (k < 0 || k >= static_cast<int>(origins.size())) return false;
  const int edit = origins[static_cast<std::size_t>(k)].edit;
  if (edit >= 0) key = fmt::format("seams[{}]{}", edit, rest);
  return edit >= 0;
}

EditedPattern editSeams(FlatPattern pattern, std::span<const SeamEdit> edits) {
  EditedPattern out{std::move(pattern), {}};
  for (std::size_t k = 0; k < out.pattern.seams.size(); ++k) out.origins.push_back({-1, static_cast<int>(k)});
  for (std::size_t i = 0; i < edits.size(); ++i)
    underKey(fmt::format("seams[{}]", i), [&] { apply(edits[i], static_cast<int>(i), out); });
  if (!edits.empty()) try {
      checkPattern(out.pattern);
    } catch (const InputError& e) {
      std::string key = e.where().key;
      out.isOfEdit(e, key);
      throw InputError({"", 0, key}, e.reason());
    }
  return out;
}

}  // namespace gambeson
