#include "tryon/pattern/garment_file.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/error.hpp"
#include "core/io/own_file.hpp"
#include "human/files/read_text.hpp"
#include "tryon/pattern/check.hpp"

namespace gambeson {
namespace {

using Json = nlohmann::json;

constexpr const char* format_name = "gambeson garment 1";
constexpr std::size_t most_bytes = 32u << 20;
constexpr int deepest = 16;
constexpr double largest_coordinate_m = 1000;  // as of meshes: far beyond any garment, near enough to keep its digits
constexpr const char* side_names[] = {"u0", "u1", "v0", "v1"};

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
      if (key.empty() && name == "$schema") continue;
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

std::vector<Vec3> readPoints(const Node& points) {
  std::vector<Vec3> out;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Node point = points.at(i);
    out.push_back(point.vec());
    for (int c = 0; c < 3; ++c)
      if (!(std::abs(out.back()[c]) <= largest_coordinate_m))
        reject(point.key, shown(point.json) + " is not within 1000 m");
  }
  return out;
}

NurbsCurve readCurve(const Node& n) {
  n.requireKeys({"degree", "knots", "points"}, {"weights"});
  NurbsCurve c;
  c.knots = {n.at("degree").integer(), n.at("knots").numbers()};
  const Node points = n.at("points");
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::vector<double> uv = points.at(i).numbers();
    if (uv.size() != 2) reject(points.at(i).key, shown(points.at(i).json) + ", must be two numbers, u and v");
    c.points.push_back({uv[0], uv[1]});
  }
  c.weights = n.has("weights") ? n.at("weights").numbers() : std::vector<double>(c.points.size(), 1.0);
  try {
    validate(c);
  } catch (const InputError& e) {
    reject(n.path(e.where().key), e.reason());
  }
  return c;
}

Trim readTrim(const Node& n) {
  n.requireKeys({"loops"}, {"points_per_piece", "unused_fraction"});
  Trim t;
  const Node loops = n.at("loops");
  for (std::size_t i = 0; i < loops.size(); ++i) {
    t.loops.emplace_back();
    const Node curves = loops.at(i);
    for (std::size_t k = 0; k < curves.size(); ++k) t.loops.back().push_back(readCurve(curves.at(k)));
  }
  if (n.has("points_per_piece")) t.points_per_piece = n.at("points_per_piece").integer();
  if (t.points_per_piece > 20) reject(n.path("points_per_piece"), "must be 0 to 20");
  if (n.has("unused_fraction")) t.unused_fraction = n.at("unused_fraction").number();
  if (!(t.unused_fraction > 0 && t.unused_fraction < 1))
    reject(n.path("unused_fraction"), std::to_string(t.unused_fraction) + ", must lie between 0 and 1");
  return t;
}

NurbsPatch readPatch(const Node& n) {
  n.requireKeys({"degree", "knots_u", "knots_v", "weft", "points_m"}, {"name", "weights", "placed_m", "trim"});
  const Node degree = n.at("degree");
  if (degree.size() != 2) reject(degree.key, shown(degree.json) + ", must be two whole numbers, of u and of v");
  NurbsPatch p;
  p.u = {degree.at(std::size_t{0}).integer(), n.at("knots_u").numbers()};
  p.v = {degree.at(1).integer(), n.at("knots_v").numbers()};
  p.points = readPoints(n.at("points_m"));
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
  n.requireKeys({"a", "b", "kind"}, {"stiffness_N", "first_cell"});
  Seam s{readEdge(n.at("a")), readEdge(n.at("b")), SeamKind::G1};
  const std::string kind = n.at("kind").text();
  if (kind != "G1" && kind != "C0") reject(n.path("kind"), "\"" + kind + "\", must be \"G1\" or \"C0\"");
  s.kind = kind == "G1" ? SeamKind::G1 : SeamKind::C0;
  if (n.has("stiffness_N")) s.stiffness_N = n.at("stiffness_N").number();
  if (n.has("first_cell")) s.first_cell = n.at("first_cell").integer();
  return s;
}

Garment readGarment(const Json& json) {
  const Node root{json, ""};
  root.requireKeys({"format", "name", "patches", "seams"}, {"edges"});
  if (root.at("format").text() != format_name)
    reject("format", shown(json.at("format")) + ", must be \"" + format_name + "\"");
  Garment g;
  g.name = root.at("name").text();
  const Node patches = root.at("patches"), seams = root.at("seams");
  for (std::size_t i = 0; i < patches.size(); ++i) {
    g.patches.push_back(readPatch(patches.at(i)));
    const Node patch = patches.at(i);
    g.weft.push_back(patch.at("weft").vec());
    g.patch_names.push_back(patch.has("name") ? patch.at("name").text() : "patch_" + std::to_string(i));
    if (std::find(g.patch_names.begin(), g.patch_names.end() - 1, g.patch_names.back()) != g.patch_names.end() - 1)
      reject(patch.path("name"), "\"" + g.patch_names.back() + "\" names two patches");
    g.placed.push_back(patch.has("placed_m") ? readPoints(patch.at("placed_m")) : std::vector<Vec3>{});
    g.trims.push_back(patch.has("trim") ? readTrim(patch.at("trim")) : Trim{});
  }
  if (std::all_of(g.placed.begin(), g.placed.end(), [](const auto& p) { return p.empty(); })) g.placed.clear();
  if (std::all_of(g.trims.begin(), g.trims.end(), [](const Trim& t) { return t.loops.empty(); })) g.trims.clear();
  for (std::size_t i = 0; i < seams.size(); ++i) g.seams.push_back(readSeam(seams.at(i)));
  if (!root.has("edges")) return g;
  const Node edges = root.at("edges");
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Node n = edges.at(i);
    n.requireKeys({"name", "of"});
    NamedEdge e{n.at("name").text(), {}};
    for (const NamedEdge& other : g.edges)
      if (other.name == e.name) reject(n.path("name"), "\"" + e.name + "\" names two edges");
    for (std::size_t k = 0; k < n.at("of").size(); ++k) e.edges.push_back(readEdge(n.at("of").at(k)));
    if (e.edges.empty()) reject(n.path("of"), "is empty; must name at least one edge");
    g.edges.push_back(std::move(e));
  }
  return g;
}

std::string list(const std::vector<double>& x) { return Json(x).dump(); }
std::string list(const Vec3& x) { return Json{x.x, x.y, x.z}.dump(); }
std::string list(const std::vector<Vec3>& x) {
  std::string s = "[";
  for (std::size_t i = 0; i < x.size(); ++i) s += (i ? ",\n    " : "\n    ") + list(x[i]);
  return s + "]";
}
std::string curve(const NurbsCurve& c) {
  Json points = Json::array();
  for (const Vec2& p : c.points) points.push_back({p.x, p.y});
  std::string s = "{\"degree\": " + std::to_string(c.knots.degree) + ", \"knots\": " + list(c.knots.knots) +
                  ", \"points\": " + points.dump();
  if (std::any_of(c.weights.begin(), c.weights.end(), [](double w) { return w != 1; }))
    s += ", \"weights\": " + list(c.weights);
  return s + "}";
}
std::string trim(const Trim& t) {
  std::string s = "{\"points_per_piece\": " + std::to_string(t.points_per_piece) +
                  ", \"unused_fraction\": " + Json(t.unused_fraction).dump() + ", \"loops\": [";
  for (std::size_t i = 0; i < t.loops.size(); ++i) {
    s += i ? ",\n    [" : "\n    [";
    for (std::size_t k = 0; k < t.loops[i].size(); ++k) s += (k ? ",\n     " : "") + curve(t.loops[i][k]);
    s += "]";
  }
  return s + "]}";
}
std::string edge(const PatchEdge& e) {
  std::string s =
      "{\"patch\": " + std::to_string(e.patch) + ", \"side\": \"" + side_names[static_cast<int>(e.side)] + "\"";
  return s + (e.reversed ? ", \"reversed\": true}" : "}");
}

}  // namespace

Garment loadGarment(const std::filesystem::path& path) {
  const std::string file = path.string();
  const std::string s = readText(path, most_bytes);
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
    out << (n ? ",\n" : "\n") << "  {";
    if (!g.patch_names.empty()) out << "\"name\": " << Json(g.patch_names[n]).dump() << ", ";
    out << "\"degree\": [" << p.u.degree << ", " << p.v.degree << "],\n   \"knots_u\": " << list(p.u.knots)
        << ",\n   \"knots_v\": " << list(p.v.knots) << ",\n   \"weft\": " << list(g.weft[n])
        << ",\n   \"points_m\": " << list(p.points);
    if (std::any_of(p.weights.begin(), p.weights.end(), [](double w) { return w != 1; }))
      out << ",\n   \"weights\": " << list(p.weights);
    if (!g.placed.empty() && !g.placed[n].empty()) out << ",\n   \"placed_m\": " << list(g.placed[n]);
    if (!g.trims.empty() && !g.trims[n].loops.empty()) out << ",\n   \"trim\": " << trim(g.trims[n]);
    out << "}";
  }
  out << "],\n \"seams\": [";
  for (std::size_t n = 0; n < g.seams.size(); ++n) {
    const Seam& s = g.seams[n];
    out << (n ? ",\n" : "\n") << "  {\"a\": " << edge(s.a) << ", \"b\": " << edge(s.b) << ", \"kind\": \""
        << (s.kind == SeamKind::G1 ? "G1" : "C0") << "\", \"stiffness_N\": " << Json(s.stiffness_N).dump();
    if (s.onPart()) out << ", \"first_cell\": " << s.first_cell;
    out << "}";
  }
  out << "]";
  bool first = true;
  for (const NamedEdge& named : g.edges) {
    if (named.edges.empty()) continue;  // of a panel
    out << (first ? ",\n \"edges\": [\n" : ",\n") << "  {\"name\": " << Json(named.name).dump() << ", \"of\": [";
    for (std::size_t k = 0; k < named.edges.size(); ++k) out << (k ? ", " : "") << edge(named.edges[k]);
    out << "]}";
    first = false;
  }
  out << (first ? "}\n" : "]}\n");
  writeOwnFile(path, out.str());
}

}  // namespace gambeson
