#pragma once
/// One place of a good case broken, and what the reader must say of it.

#include <gtest/gtest.h>

#include <string>
#include <vector>

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
      EXPECT_EQ(e.where().file, file.string()) << e.what();
      EXPECT_EQ(e.where().line, c.line) << e.what();
      if (!c.key.empty()) {
        EXPECT_EQ(e.where().key, c.key) << e.what();
      }
      EXPECT_NE(e.reason().find(c.reason), std::string::npos) << e.what();
    }
  }
}

}  // namespace gambeson
