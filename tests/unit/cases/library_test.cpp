/// What the shipped cases say of the program: none asks for what users should not need.

#include <gtest/gtest.h>

#include <set>

#include "cases/input/json.hpp"

namespace gambeson {
namespace {

/// Paths of a case that end in `key`.
void pathsTo(const JsonNode& node, const std::string& key, const std::string& path, std::set<std::string>& found) {
  for (const JsonNode& child : node.children) {
    if (child.key == key) found.insert(path + key);
    pathsTo(child, key, path + child.key + ".", found);
  }
}

/// The automatic step keeps energy by itself.
TEST(Library, NoCaseSetsStepSafety) {
  std::set<std::string> with;
  int cases = 0;
  for (const auto& entry : std::filesystem::directory_iterator(GAMBESON_SOURCE_DIR "/cases/library")) {
    if (entry.path().extension() != ".json") continue;
    ++cases;
    std::set<std::string> found;
    pathsTo(readJson(entry.path()), "step_safety", "", found);
    if (!found.empty()) with.insert(entry.path().stem().string());
  }
  EXPECT_GT(cases, 25);
  EXPECT_EQ(with, std::set<std::string>{});
}

}  // namespace
}  // namespace gambeson
