#pragma once
/// The hash by which a case knows itself. Internal to caseIdentity.

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "core/error.hpp"

namespace gambeson {

/// FNV-1a, 64 bits, with the length after each part so that parts cannot run into each other.
class Fingerprint {
 public:
  void add(std::string_view bytes) {
    for (const char c : bytes) step(static_cast<unsigned char>(c));
    for (std::uint64_t n = bytes.size(), i = 0; i < 8; ++i, n >>= 8) step(static_cast<unsigned char>(n & 0xff));
  }
  /// A file that the case names, replaced by its content: a case moved to another folder stays the same case.
  void addFile(std::filesystem::path& path) {
    if (path.empty()) return;
    std::ifstream stream(path, std::ios::binary);
    if (!stream) throw InputError({path.string(), 0, ""}, "cannot be opened");
    add(std::string(std::istreambuf_iterator<char>(stream), {}));
    path = path.filename();
  }
  std::string text() const { return fmt::format("{:016x}", value_); }

 private:
  void step(unsigned char byte) {
    value_ ^= byte;
    value_ *= 0x100000001b3ULL;
  }
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

}  // namespace gambeson
