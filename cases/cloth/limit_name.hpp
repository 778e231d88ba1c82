#pragma once
/// What checks call the fabric whose limit of stretch they are about.

#include <filesystem>
#include <string>

namespace gambeson {

/// Its name, and the card that the limit may be of: "Denim A (card denim_a)".
inline std::string nameOfLimit(const std::filesystem::path& card, const std::string& name) {
  const std::string file = card.filename().string();
  return card.empty() ? (name.empty() ? "the fabric" : name) : name.empty() ? file : name + " (card " + file + ")";
}

}  // namespace gambeson
