#pragma once
/// One place of a good case broken, and what the reader must say of it.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cases/input/mistakes.hpp"
#include "cases/kinds/any_case.hpp"
#include "core/error.hpp"
#include "unit/cases/example.hpp"

namespace gambeson {

/// `from`, which stands once in the case, becomes `to`.
struct Bad {
  std::string from, to;
  int line;
  std::string key;  ///< empty: any
  std::string reason;
};

inline void expectRefused(const std::string& good, const std::vector<Bad>& cases) {
  const Folder folder;
  ASSERT_NO_THROW(readAnyCase(folder.write("good.json", good)));
  for (const Bad& c : cases) {
    SCOPED_TRACE(c.from + " -> " + c.to);
    const std::filesystem::path file = folder.write("example.json", replaced(good, c.from, c.to));
    try {
      readAnyCase(file);
      ADD_FAILURE() << "accepted";
    } catch (const InputError& e) {
      // A change of kind leaves several keys without a meaning: the one that is looked for is among those said.
      std::string said;
      bool found = false;
      for (const InputError& one : mistakesOf(e)) {
        said += std::string(one.what()) + "\n";
        found =
            found || (one.where().file == file.string() && one.where().line == c.line &&
                      (c.key.empty() || one.where().key == c.key) && one.reason().find(c.reason) != std::string::npos);
      }
      EXPECT_TRUE(found) << "expected " << c.line << ": " << c.key << ": " << c.reason << "\n" << said;
    }
  }
}

}  // namespace gambeson
