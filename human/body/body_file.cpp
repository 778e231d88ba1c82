/// The body file beside a URDF: ellipsoids per link.

#include "human/body/body_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "core/error.hpp"
#include "human/body/urdf.hpp"
#include "human/files/json_file.hpp"
#include "human/files/read_text.hpp"

namespace gambeson {
namespace {

using Json = JsonFile::Json;

constexpr std::uintmax_t largest_file = std::uintmax_t{16} << 20;
constexpr double largest_m = 100;

}  // namespace

Human loadHuman(const std::filesystem::path& urdf, const std::filesystem::path& body) {
  Human human = loadUrdf(urdf);
  const JsonFile r{body.string()};
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
