#pragma once
/// Values of a JSON file that a user hands in; errors name the file, the line of bad syntax, the element otherwise
/// ("shapes[3].semi_axes_m").

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "core/math/vec.hpp"

namespace gambeson {

struct JsonFile {
  using Json = nlohmann::json;
  std::string file;

  [[noreturn]] void fail(const std::string& key, const std::string& reason) const;
  void checkKeys(const Json& object, const std::string& at, const std::set<std::string>& needed,
                 const std::set<std::string>& optional) const;
  /// A number in (low, high].
  double number(const Json& value, const std::string& at, double low, double high) const;
  Vec3 triple(const Json& value, const std::string& at, double low, double high) const;
  std::string text(const Json& value, const std::string& at) const;
  /// Parses, and refuses keys that stand twice in an object (JSON would keep the last).
  Json parse(std::string_view source) const;
};

}  // namespace gambeson
