#pragma once
/// Where the public data files are, where they are there.

#include <cstdlib>
#include <filesystem>

namespace gambeson::test {

inline std::filesystem::path dataFolder() {
  if (const char* set = std::getenv("GAMBESON_DATA")) return set;
  return std::filesystem::path(GAMBESON_SOURCE_DIR) / ".." / "shared" / "data";
}

/// Frames and query files about collisions.
inline std::filesystem::path collisionFolder() { return dataFolder() / "real" / "collision"; }

}  // namespace gambeson::test
