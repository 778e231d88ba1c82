/// What the README shows is true.

#include <gtest/gtest.h>

#include "cases/kinds/any_case.hpp"
#include "unit/cases/example.hpp"

namespace gambeson {
namespace {

TEST(Readme, ItsCasesAreValid) {
  std::ifstream file(GAMBESON_SOURCE_DIR "/README.md");
  const Folder folder;
  std::string line, text;
  bool inside = false;
  int cases = 0;
  while (std::getline(file, line)) {
    if (line == "```json") {
      inside = true;
      text.clear();
    } else if (inside && line == "```") {
      inside = false;
      ++cases;
      EXPECT_NO_THROW(readAnyCase(folder.write("readme.json", text), {})) << text;
    } else if (inside) {
      text += line + "\n";
    }
  }
  EXPECT_GE(cases, 2);
}

}  // namespace
}  // namespace gambeson
