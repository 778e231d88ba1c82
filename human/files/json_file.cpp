#include "human/files/json_file.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <vector>

#include "core/error.hpp"

namespace gambeson {

void JsonFile::fail(const std::string& key, const std::string& reason) const {
  throw InputError({file, 0, key}, reason);
}

void JsonFile::checkKeys(const Json& object, const std::string& at, const std::set<std::string>& needed,
                         const std::set<std::string>& optional) const {
  if (!object.is_object()) fail(at, "must be an object");
  const std::string dot = at.empty() ? "" : ".";
  for (const auto& [key, value] : object.items())
    if (!needed.contains(key) && !optional.contains(key) && !(at.empty() && key == "$schema"))
      fail(std::string(at).append(dot).append(key), "is not known here");
  for (const std::string& key : needed)
    if (!object.contains(key)) fail(std::string(at).append(dot).append(key), "is missing");
}

double JsonFile::number(const Json& value, const std::string& at, double low, double high) const {
  if (!value.is_number()) fail(at, "must be a number, without a unit");
  const double x = value;
  if (!(x > low && x <= high)) fail(at, fmt::format("{} is not allowed: > {}, <= {}", x, low, high));
  return x;
}

Vec3 JsonFile::triple(const Json& value, const std::string& at, double low, double high) const {
  if (!value.is_array() || value.size() != 3) fail(at, "must be three numbers");
  Vec3 v;
  for (int k = 0; k < 3; ++k) v[k] = number(value[k], fmt::format("{}[{}]", at, k), low, high);
  return v;
}

std::string JsonFile::text(const Json& value, const std::string& at) const {
  if (!value.is_string() || value.get<std::string>().empty()) fail(at, "must be a name");
  return value;
}

JsonFile::Json JsonFile::parse(std::string_view source) const {
  std::vector<std::set<std::string>> open;
  const auto seen = [&](int, Json::parse_event_t event, Json& parsed) {
    if (event == Json::parse_event_t::object_start) open.emplace_back();
    if (event == Json::parse_event_t::object_end) open.pop_back();
    if (event == Json::parse_event_t::key && !open.back().insert(parsed.get<std::string>()).second)
      fail(parsed.get<std::string>(), "stands twice in an object");
    return true;
  };
  try {
    return Json::parse(source, seen);
  } catch (const Json::exception& e) {  // its message holds line and column
    std::string reason = e.what();
    int line = 0;
    if (const std::size_t at = reason.find("at line "); at != std::string::npos)
      line = std::atoi(reason.c_str() + at + 8);
    throw InputError({file, line, ""}, "is not JSON: " + reason);
  }
}

}  // namespace gambeson
