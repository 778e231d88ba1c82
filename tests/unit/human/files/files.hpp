#pragma once
/// Temporary files and the check that an input is refused with a file, a line or element, and a reason.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/error.hpp"

namespace gambeson::test {

/// A folder that lives as long as the test.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "gambeson_human_XXXXXX").string();
    path = mkdtemp(name.data());
  }
  ~Folder() { std::filesystem::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path / name, std::ios::binary) << text;
    return path / name;
  }
  std::filesystem::path path;
};

/// `load` must throw an InputError that names `file`, has `line` (0: any) and holds `words`.
template <class Load>
void expectRefused(Load load, const std::filesystem::path& file, int line, const std::string& words) {
  try {
    load(file);
    ADD_FAILURE() << file << " was accepted; expected: " << words;
  } catch (const InputError& e) {
    EXPECT_EQ(e.where().file, file.string()) << e.what();
    if (line > 0) {
      EXPECT_EQ(e.where().line, line) << e.what();
    }
    EXPECT_FALSE(e.reason().empty());
    EXPECT_NE(std::string(e.what()).find(words), std::string::npos) << e.what();
  }
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("test text lacks " + from);
  return text.replace(at, from.size(), to);
}

}  // namespace gambeson::test
