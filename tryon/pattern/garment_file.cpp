#include "tryon/pattern/garment_file.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/error.hpp"
#include "core/io/atomic_file.hpp"
#include "tryon/pattern/check.hpp"

namespace gambeson {
namespace {

using Json = nlohmann::json;

constexpr const char* format_name = "gambeson garment 1";
constexpr std::size_t most_bytes = 256u << 20;
constexpr int deepest = 16;
constexpr double largest_coordinate_m = 1000;  // as of meshes: far beyond any garment, near enough to keep its digits
constexpr const char* side_names[] = {"u0", "u1", "v0", "v1"};

[[noreturn]] void reject(const std::string& key, const std::string& reason) { throw InputError({"", 0, key}, reason); }

std::string shown(const Json& j) {
  std::string s = j.dump(-1, ' ', false, Json::error_handler_t::replace);
  return s.size() > 40 ? s.substr(0, 40) + "..." : s;
}

/// A value and where it stands, so that every error names its key.
struct Node {
  const Json& json;
  std::string key;

  void requireKeys(std::initializer_list<const char*> required,
                   std::initializer_list<const char*> optional = {}) const {
    if (!json.is_object()) reject(key, shown(json) + ", must be an object");
    for (const char* name : required)
      if (!json.contains(name)) reject(path(name), "is missing");
    for (const auto& [name, value] : json.items()) {
      const auto is = [&](const char* k) { return name == k; };
      if (std::none_of(required.begin(), required.end(), is) && std::none_of(optional.begin(), optional.end(), is))
        reject(path(name), "unknown key");
    }
  }
  std::string path(const std::string& name) const { return key.empty() ? name : key + "." + name; }
  bool has(const char* name) const { return json.contains(name); }
  Node at(const char* name) const { return {json.at(name), path(name)}; }
  Node at(std::size_t i) const { return {json.at(i), key + "[" + std::to_string(i) + "]"}; }
  std::size_t size() const {
    if (!json.is_array()) reject(key, shown(json) + ", must be a list");
    return json.size();
  }
  double number() const {
    if (!json.is_number()) reject(key, shown(json) + ", must be a number");
    return json.get<double>();
  }
  int integer() const {
    if (!json.is_number_integer()) reject(key, shown(json) + ", must be a whole number");
    const double x = json.get<double>();
    if (!(x >= 0 && x <= 1e6)) reject(key, shown(json) + ", must be 0 to 1000000");
    return static_cast<int>(x);
  }
  std::string text() const {
    if (!json.is_string()) reject(key, shown(json) + ", must be a string");
    return json.get<std::string>();
  }
  bool boolean() const {
    if (!json.is_boolean()) reject(key, shown(json) + ", must be true or false");
    return json.get<bool>();
  }
  std::vector<double> numbers() const {
    std::vector<double> out;
    for (std::size_t i = 0; i < size(); ++i) out.push_back(at(i).number());
    return out;
  }
  Vec3 vec() const {
    if (size() != 3) reject(key, shown(json) + ", must be three numbers");
    return {at(std::size_t{0}).number(), at(1).number(), at(2).number()};
  }
};

NurbsPatch readPatch(const Node& n) {
  n.requireKeys({"degree", "knots_u", "knots_v", "weft", "points_m"}, {"weights"});
  const Node degree = n.at("degree");
  if (degree.size() != 2) reject(degree.key, shown(degree.json) + ", must be two whole numbers, of u and of v");
  NurbsPatch p;
  p.u = {degree.at(std::size_t{0}).integer(), n.at("knots_u").numbers()};
  p.v = {degree.at(1).integer(), n.at("knots_v").numbers()};
  const Node points = n.at("points_m");
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Node point = points.at(i);
    p.points.push_back(point.vec());
    for (int c = 0; c < 3; ++c)
      if (!(std::abs(p.points.back()[c]) <= largest_coordinate_m))
        reject(point.key, shown(point.json) + " is not within 1000 m");
  }
  p.weights = n.has("weights") ? n.at("weights").numbers() : std::vector<double>(p.points.size(), 1.0);
  return p;
}

PatchEdge readEdge(const Node& n) {
  n.requireKeys({"patch", "side"}, {"reversed"});
  PatchEdge e;
  e.patch = n.at("patch").integer();
  const std::string side = n.at("side").text();
  const auto it = std::find(std::begin(side_names), std::end(side_names), side);
  if (it == std::end(side_names)) reject(n.path("side"), "\"" + side + "\", must be \"u0\", \"u1\", \"v0\" or \"v1\"");
  e.side = static_cast<Side>(it - std::begin(side_names));
  e.reversed = n.has("reversed") && n.at("reversed").boolean();
  return e;
}

Seam readSeam(const Node& n) {
  n.requireKeys({"a", "b", "kind"}, {"stiffness_N"});
  Seam s{readEdge(n.at("a")), readEdge(n.at("b")), SeamKind::G1, 0};
  const std::string kind = n.at("kind").text();
  if (kind != "G1" && kind != "C0") reject(n.path("kind"), "\"" + kind + "\", must be \"G1\" or \"C0\"");
  s.kind = kind == "G1" ? SeamKind::G1 : SeamKind::C0;
  if (n.has("stiffness_N")) s.stiffness_N = n.at("stiffness_N").number();
  return s;
}

Garment readGarment(const Json& json) {
  const Node root{json, ""};
  root.requireKeys({"format", "name", "patches", "seams"});
  if (root.at("format").text() != format_name)
    reject("format", shown(json.at("format")) + ", must be \"" + format_name + "\"");
  Garment g;
  g.name = root.at("name").text();
  const Node patches = root.at("patches"), seams = root.at("seams");
  for (std::size_t i = 0; i < patches.size(); ++i) {
    g.patches.push_back(readPatch(patches.at(i)));
    g.weft.push_back(patches.at(i).at("weft").vec());
  }
  for (std::size_t i = 0; i < seams.size(); ++i) g.seams.push_back(readSeam(seams.at(i)));
  return g;
}

std::string list(const std::vector<double>& x) { return Json(x).dump(); }
std::string list(const Vec3& x) { return Json{x.x, x.y, x.z}.dump(); }
std::string edge(const PatchEdge& e) {
  std::string s =
      "{\"patch\": " + std::to_string(e.patch) + ", \"side\": \"" + side_names[static_cast<int>(e.side)] + "\"";
  return s + (e.reversed ? ", \"reversed\": true}" : "}");
}

}  // namespace

Garment loadGarment(const std::filesystem::path& path) {
  const std::string file = path.string();
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) throw InputError({file, 0, ""}, "is not a readable file");
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  if (!in || std::filesystem::file_size(path) > most_bytes)
    throw InputError({file, 0, ""}, in ? "is larger than 256 MiB" : "cannot be read");
  text << in.rdbuf();
  const std::string s = text.str();
  Json json;
  try {
    // Deeper nesting than a garment has would only overflow the stack where a value is shown.
    json = Json::parse(s, [&](int depth, Json::parse_event_t, Json&) {
      if (depth > deepest)
        throw InputError({file, 0, ""}, "is nested deeper than " + std::to_string(deepest) + " levels");
      return true;
    });
  } catch (const Json::parse_error& e) {
    const std::size_t at = std::min(e.byte, s.size());
    throw InputError({file, 1 + static_cast<int>(std::count(s.begin(), s.begin() + at, '\n')), ""}, e.what());
  } catch (const Json::exception& e) {  // numbers beyond double precision's range
    throw InputError({file, 0, ""}, e.what());
  }
  try {
    Garment g = readGarment(json);
    validate(g);
    return g;
  } catch (const InputError& e) {
    throw InputError({file, e.where().line, e.where().key}, e.reason());
  }
}

void writeGarment(const Garment& g, const std::filesystem::path& path) {
  std::ostringstream out;
  out << "{\"format\": \"" << format_name << "\",\n \"name\": " << Json(g.name).dump() << ",\n \"patches\": [";
  for (std::size_t n = 0; n < g.patches.size(); ++n) {
    const NurbsPatch& p = g.patches[n];
    out << (n ? ",\n" : "\n") << "  {\"degree\": [" << p.u.degree << ", " << p.v.degree
        << "],\n   \"knots_u\": " << list(p.u.knots) << ",\n   \"knots_v\": " << list(p.v.knots)
        << ",\n   \"weft\": " << list(g.weft[n]) << ",\n   \"points_m\": [";
    for (std::size_t i = 0; i < p.points.size(); ++i) out << (i ? ",\n    " : "\n    ") << list(p.points[i]);
    out << "]";
    if (std::any_of(p.weights.begin(), p.weights.end(), [](double w) { return w != 1; }))
      out << ",\n   \"weights\": " << list(p.weights);
    out << "}";
  }
  out << "],\n \"seams\": [";
  for (std::size_t n = 0; n < g.seams.size(); ++n) {
    const Seam& s = g.seams[n];
    out << (n ? ",\n" : "\n") << "  {\"a\": " << edge(s.a) << ", \"b\": " << edge(s.b) << ", \"kind\": \""
        << (s.kind == SeamKind::G1 ? "G1" : "C0") << "\", \"stiffness_N\": " << Json(s.stiffness_N).dump() << "}";
  }
  out << "]}\n";
  writeFileAtomically(path, out.str());
}

}  // namespace gambeson
