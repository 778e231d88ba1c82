#include "cases/study/files.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace gambeson::study::files {
namespace {

constexpr std::size_t longest = 200;

std::string lowered(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

}  // namespace

std::string pictureName(const std::string& variant, std::size_t wish) {
  return fmt::format("{}_{:02d}.png", variant, wish + 1);
}

std::string unfitFolder(const std::string& name) {
  if (name.empty()) return "has no name; allowed: a label";
  if (name.size() > longest) return fmt::format("gives a folder a name longer than {} characters", longest);
  if (name[0] == '.') return fmt::format("cannot be called \"{}\": the name begins with a dot", name);
  const std::string low = lowered(name);
  const auto taken = [&](std::string_view file) { return low == file; };
  if (std::any_of(written.begin(), written.end(), taken) || std::any_of(folders.begin(), folders.end(), taken))
    return fmt::format("cannot be called \"{}\": the results have a file of that name; allowed: another label", name);
  return "";
}

}  // namespace gambeson::study::files
