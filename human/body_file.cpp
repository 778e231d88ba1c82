/// The body file beside a URDF: ellipsoids per link.

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "core/error.hpp"
#include "human/load.hpp"
#include "human/read_text.hpp"

namespace gambeson {
namespace {

using Json = nlohmann::json;

constexpr std::uintmax_t largest_file = std::uintmax_t{16} << 20;
constexpr double largest_m = 100;

/// Reads values of one file; errors name the element ("shapes[3].semi_axes_m").
struct Reader {
  std::string file;

  [[noreturn]] void fail(const std::string& key, const std::string& reason) const {
    throw InputError({file, 0, key}, reason);
  }

  void checkKeys(const Json& object, const std::string& at, const std::set<std::string>& needed,
                 const std::set<std::string>& optional) const {
    if (!object.is_object()) fail(at, "must be an object");
    const std::string dot = at.empty() ? "" : ".";
    for (const auto& [key, value] : object.items())
      if (!needed.contains(key) && !optional.contains(key))
        fail(std::string(at).append(dot).append(key), "is not known here");
    for (const std::string& key : needed)
      if (!object.contains(key)) fail(std::string(at).append(dot).append(key), "is missing");
  }
  double number(const Json& value, const std::string& at, double low, double high) const {
    if (!value.is_number()) fail(at, "must be a number, without a unit");
    const double x = value;
    if (!(x > low && x <= high)) fail(at, fmt::format("{} is not allowed: > {}, <= {}", x, low, high));
    return x;
  }
  Vec3 triple(const Json& value, const std::string& at, double low, double high) const {
    if (!value.is_array() || value.size() != 3) fail(at, "must be three numbers");
    Vec3 v;
    for (int k = 0; k < 3; ++k) v[k] = number(value[k], fmt::format("{}[{}]", at, k), low, high);
    return v;
  }
  std::string text(const Json& value, const std::string& at) const {
    if (!value.is_string() || value.get<std::string>().empty()) fail(at, "must be a name");
    return value;
  }

  /// Parses, and refuses keys that stand twice in an object (JSON would keep the last).
  Json parse(const std::string& source) const {
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
};

}  // namespace

Human loadHuman(const std::filesystem::path& urdf, const std::filesystem::path& body) {
  Human human = loadUrdf(urdf);
  const Reader r{body.string()};
  const Json root = r.parse(readText(body, largest_file));
  r.checkKeys(root, "", {"mass_kg", "stature_m", "shapes"}, {});
  human.mass_kg = r.number(root.at("mass_kg"), "mass_kg", 0, 1000);
  human.stature_m = r.number(root.at("stature_m"), "stature_m", 0, 10);
  const Json& shapes = root.at("shapes");
  if (!shapes.is_array() || shapes.empty()) r.fail("shapes", "must be a list with at least one shape");
  human.shapes.clear();
  std::set<std::string> names;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const std::string at = fmt::format("shapes[{}]", i);
    const Json& s = shapes[i];
    r.checkKeys(s, at, {"link", "name", "semi_axes_m", "origin_m"}, {"rpy_rad"});
    BodyShape shape;
    const std::string link = r.text(s.at("link"), at + ".link");
    shape.link = human.skeleton.link(link);
    if (shape.link < 0) r.fail(at + ".link", "the skeleton has no link '" + link + "'");
    shape.name = r.text(s.at("name"), at + ".name");
    if (!names.insert(shape.name).second) r.fail(at + ".name", "'" + shape.name + "' stands twice");
    shape.shape = Ellipsoid{r.triple(s.at("semi_axes_m"), at + ".semi_axes_m", 0, largest_m)};
    shape.X_LS.origin = r.triple(s.at("origin_m"), at + ".origin_m", -largest_m, largest_m);
    if (s.contains("rpy_rad")) {
      const Vec3 a = r.triple(s.at("rpy_rad"), at + ".rpy_rad", -100, 100);
      shape.X_LS.rotation =
          rotationAbout({0, 0, 1}, a.z) * rotationAbout({0, 1, 0}, a.y) * rotationAbout({1, 0, 0}, a.x);
    }
    human.shapes.push_back(std::move(shape));
  }
  return human;
}

}  // namespace gambeson
