/// What the shipped cases say of the program: none asks for what users should not need.

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "cases/input/json.hpp"
#include "cases/study/study.hpp"

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

/// All variants of all studies are cases; those of Man's sleeve are as many as his section 5.3 asks for.
TEST(Library, StudiesAreValid) {
  std::map<std::string, std::size_t> variants;
  for (const auto& entry : std::filesystem::directory_iterator(GAMBESON_SOURCE_DIR "/cases/library")) {
    const std::string name = entry.path().filename();
    if (!name.ends_with(".study.json")) continue;
    ASSERT_NO_THROW(variants[name] = study::readStudy(entry.path()).variants.size()) << name;
  }
  EXPECT_EQ(variants.size(), 11u);
  EXPECT_EQ(variants["sleeve.study.json"], 2u * 4u * 2u + 1u);  // cloths, meshes, frictions; exact inertia
  EXPECT_EQ(variants["sleeve_fit.study.json"], 4u * 2u * 2u);   // sleeves, cloths, meshes
  EXPECT_EQ(variants["sleeve_material.study.json"], 4u * 2u);   // materials, meshes
  EXPECT_EQ(variants["sleeve_starts.study.json"], 8u * 5u);     // sleeves, starts
  EXPECT_EQ(variants["models.study.json"], 4u);
  EXPECT_EQ(variants["shorts_population.study.json"], 24u);  // wearers
}

}  // namespace
}  // namespace gambeson
