#pragma once
/// What the files of a recording are called.

#include <optional>
#include <string>
#include <string_view>

namespace gambeson {

/// N where `name` is "segment_N.h5" as segmentPath writes it.
inline std::optional<int> segmentIndex(const std::string& name) {
  constexpr std::string_view head = "segment_", tail = ".h5";
  if (name.size() < head.size() + tail.size() + 6 || !name.starts_with(head) || !name.ends_with(tail)) return {};
  const std::string digits = name.substr(head.size(), name.size() - head.size() - tail.size());
  if (digits.size() > 9 || digits.find_first_not_of("0123456789") != std::string::npos) return {};
  return std::stoi(digits);
}

/// Whether a recording's folder `frames` has files of that name.
inline bool isRecorded(const std::string& name) { return name == "layout.h5" || segmentIndex(name).has_value(); }

}  // namespace gambeson
