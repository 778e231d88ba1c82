#pragma once
/// What a file holds.

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace gambeson {

inline std::string content(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace gambeson
