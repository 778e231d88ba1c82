#include "human/skeleton/joint_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "core/error.hpp"
#include "human/files/data.hpp"
#include "human/files/json_file.hpp"
#include "human/files/read_text.hpp"
#include "human/files/units.hpp"

namespace gambeson {
namespace {

using Json = JsonFile::Json;
constexpr std::uintmax_t largest_file = std::uintmax_t{4} << 20;

const std::set<std::string> segments{"thigh_right",   "thigh_left",  "shank_right",     "shank_left",
                                     "foot_right",    "foot_left",   "upper_arm_right", "upper_arm_left",
                                     "forearm_right", "forearm_left"};
const std::array<const char*, 6> leg_bones{"thigh_right", "thigh_left", "shank_right",
                                           "shank_left",  "foot_right", "foot_left"};

struct MapReader {
  JsonFile r;
  const Json& root;
  JointMap m;

  std::vector<std::string> names(const Json& list, const std::string& at, bool may_be_empty = false) const {
    if (!list.is_array() || (list.empty() && !may_be_empty)) r.fail(at, "must be a list of names");
    std::vector<std::string> out;
    for (std::size_t i = 0; i < list.size(); ++i) out.push_back(r.text(list[i], fmt::format("{}[{}]", at, i)));
    return out;
  }
  /// "name" or ["name", ...]
  Points points(const Json& v, const std::string& at) const {
    if (v.is_string()) return {r.text(v, at)};
    return names(v, at);
  }
  std::array<Points, 2> pair(const Json& v, const std::string& at) const {
    if (!v.is_array() || v.size() != 2) r.fail(at, "must be two names, from and to");
    return {points(v[0], at + "[0]"), points(v[1], at + "[1]")};
  }
  Vec3 axis(const Json& v, const std::string& at) const {
    const std::string word = r.text(v, at);
    const Vec3 a = namedAxis(word);
    if (a == Vec3{}) r.fail(at, "'" + word + "' is not allowed: x, y, z, -x, -y or -z");
    return a;
  }
  std::string choice(const Json& v, const std::string& at, const std::vector<std::string>& words) const {
    const std::string word = r.text(v, at);
    if (std::find(words.begin(), words.end(), word) == words.end())
      r.fail(at, fmt::format("'{}' is not allowed: {}", word, fmt::join(words, ", ")));
    return word;
  }

  void readBones(const Json& bones) {
    if (!bones.is_object()) r.fail("bones", "must be an object");
    for (const auto& [segment, ends] : bones.items()) {
      if (!segments.contains(segment))
        r.fail("bones." + segment, fmt::format("is not known here: {}", fmt::join(segments, ", ")));
      m.bones[segment] = pair(ends, "bones." + segment);
    }
  }
  void needLegs() const {
    for (const char* s : leg_bones)
      if (!m.bones.contains(s)) r.fail(std::string("bones.") + s, "is missing");
  }

  void coordinates() {
    r.checkKeys(root, "", {"reads", "has", "forward", "up", "root", "joints"}, {"about", "source", "lacks", "leg_m"});
    const Json& at = root.at("root");
    r.checkKeys(at, "root", {"turns", "position", "hips_m"}, {});
    const Json& turns = at.at("turns");
    if (!turns.is_array() || turns.size() != 3) r.fail("root.turns", "must be three pairs of coordinate and axis");
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string key = fmt::format("root.turns[{}]", i);
      if (!turns[i].is_array() || turns[i].size() != 2) r.fail(key, "must be a coordinate and its axis");
      m.turns.emplace_back(r.text(turns[i][0], key), axis(turns[i][1], key));
    }
    const auto position = names(at.at("position"), "root.position");
    if (position.size() != 3) r.fail("root.position", "must be three coordinates, along x, y and z");
    std::copy(position.begin(), position.end(), m.position.begin());
    m.hips_m = r.triple(at.at("hips_m"), "root.hips_m", -10, 10);
    if (root.contains("leg_m")) m.leg_m = r.number(root.at("leg_m"), "leg_m", 0, 10);
    const Json& joints = root.at("joints");
    if (!joints.is_object() || joints.empty()) r.fail("joints", "must name at least one joint");
    for (const auto& [joint, drive] : joints.items()) {
      const std::string key = "joints." + joint;
      r.checkKeys(drive, key, {"from"}, {"scale", "offset_deg", "optional"});
      JointMap::Drive d{r.text(drive.at("from"), key + ".from"), 1, 0, false};
      if (drive.contains("scale")) d.scale = r.number(drive.at("scale"), key + ".scale", -1000, 1000);
      if (d.scale == 0) r.fail(key + ".scale", "must not be 0");
      if (drive.contains("offset_deg"))
        d.offset_rad = rad_per_deg * r.number(drive.at("offset_deg"), key + ".offset_deg", -360, 360);
      if (drive.contains("optional")) {
        if (!drive.at("optional").is_boolean()) r.fail(key + ".optional", "must be true or false");
        d.optional = drive.at("optional");
      }
      m.joints[joint] = d;
    }
  }

  void bonesOfHierarchy() {
    r.checkKeys(root, "", {"reads", "has", "forward", "up", "unit_m", "root_position", "pelvis", "bones"},
                {"about", "source", "lacks", "torso", "head"});
    m.unit_m = r.number(root.at("unit_m"), "unit_m", 0, 1000);
    m.position_adds = choice(root.at("root_position"), "root_position", {"replaces", "adds"}) == "adds";
    r.checkKeys(root.at("pelvis"), "pelvis", {"joint", "hips"}, {});
    m.pelvis_joint = r.text(root.at("pelvis").at("joint"), "pelvis.joint");
    m.hips = pair(root.at("pelvis").at("hips"), "pelvis.hips");
    if (root.contains("torso")) {
      r.checkKeys(root.at("torso"), "torso", {"joint", "bone"}, {});
      m.torso_joint = r.text(root.at("torso").at("joint"), "torso.joint");
      m.torso_bone = pair(root.at("torso").at("bone"), "torso.bone");
    }
    if (root.contains("head")) {
      r.checkKeys(root.at("head"), "head", {"joint"}, {});
      m.head_joint = r.text(root.at("head").at("joint"), "head.joint");
    }
    readBones(root.at("bones"));
    needLegs();
  }

  void markersOnModel() {
    r.checkKeys(root, "", {"reads", "has", "forward", "up", "bodies"},
                {"about", "source", "lacks", "bones", "knee_scale"});
    const Json& bodies = root.at("bodies");
    std::set<std::string> needed{"pelvis"}, optional{"torso"};
    for (const char* s : {"thigh_right", "shank_right", "ankle_right", "foot_right", "thigh_left", "shank_left",
                          "ankle_left", "foot_left"})
      needed.insert(s);
    r.checkKeys(bodies, "bodies", needed, optional);
    for (const auto& [segment, body] : bodies.items()) m.bodies[segment] = r.text(body, "bodies." + segment);
    if (root.contains("knee_scale")) m.knee_scale = r.number(root.at("knee_scale"), "knee_scale", -2, 2);
    if (root.contains("bones")) readBones(root.at("bones"));
    for (const char* s : leg_bones)
      if (m.bones.contains(s)) r.fail(std::string("bones.") + s, "comes from \"bodies\" here");
  }

  void pointsAtJoints() {
    r.checkKeys(root, "", {"reads", "has", "forward", "up", "pelvis", "bones", "markers"},
                {"about", "source", "lacks", "torso"});
    const Json& pelvis = root.at("pelvis");
    r.checkKeys(pelvis, "pelvis", {"hips", "marker", "side"}, {});
    m.hips = pair(pelvis.at("hips"), "pelvis.hips");
    m.pelvis_marker = points(pelvis.at("marker"), "pelvis.marker");
    m.pelvis_side = choice(pelvis.at("side"), "pelvis.side", {"front", "back", "above"});
    if (root.contains("torso")) {
      r.checkKeys(root.at("torso"), "torso", {"bone"}, {});
      m.torso_bone = pair(root.at("torso").at("bone"), "torso.bone");
    }
    readBones(root.at("bones"));
    needLegs();
    const Json& markers = root.at("markers");
    if (!markers.is_object()) r.fail("markers", "must be an object");
    for (const auto& [segment, v] : markers.items()) {
      const std::string at = "markers." + segment;
      if (!m.bones.contains(segment)) r.fail(at, "has no bone of this name");
      if (!v.is_array() || v.size() != 2) r.fail(at, "must be a marker and the side of the bone that it lies on");
      m.aux[segment] = {points(v[0], at + "[0]"), choice(v[1], at + "[1]", {"front", "back", "left", "right"})};
    }
  }
};

const std::vector<std::pair<std::string, std::string_view>>& shipped() {
  static const std::vector<std::pair<std::string, std::string_view>> all{
      {"gait2392", data::map_gait2392},
      {"rajagopal", data::map_rajagopal},
      {"snu_woody", data::map_snu_woody},
      {"makehuman", data::map_makehuman},
      {"makehuman_default", data::map_makehuman_default},
      {"unreal", data::map_unreal},
      {"mixamo", data::map_mixamo},
      {"gait2392_markers", data::map_gait2392_markers},
      {"joint_centres", data::map_joint_centres}};
  return all;
}

}  // namespace

Vec3 namedAxis(const std::string& word) {
  const bool minus = word.size() == 2 && word[0] == '-';
  const char c = word.empty() ? ' ' : word.back();
  Vec3 a;
  if ((minus || word.size() == 1) && c >= 'x' && c <= 'z') a[c - 'x'] = minus ? -1 : 1;
  return a;
}

Mat3 axesOf(const Vec3& forward, const Vec3& up) { return transpose(Mat3{forward, cross(up, forward), up}); }

JointMap parseJointMap(std::string_view text, const std::string& file) {
  const JsonFile r{file};
  const Json root = r.parse(text);
  if (!root.is_object() || !root.contains("reads")) r.fail("reads", "is missing");
  MapReader reader{r, root, {}};
  const std::string kind = reader.choice(root.at("reads"), "reads", {"coordinates", "bones", "markers", "points"});
  if (kind == "coordinates") reader.m.kind = MapKind::coordinates, reader.coordinates();
  if (kind == "bones") reader.m.kind = MapKind::bones, reader.bonesOfHierarchy();
  if (kind == "markers") reader.m.kind = MapKind::markers, reader.markersOnModel();
  if (kind == "points") reader.m.kind = MapKind::points, reader.pointsAtJoints();
  JointMap& m = reader.m;
  m.name = file;
  m.has = reader.names(root.at("has"), "has", true);
  if (root.contains("lacks")) m.lacks = reader.names(root.at("lacks"), "lacks", true);
  m.forward = reader.axis(root.at("forward"), "forward");
  m.up = reader.axis(root.at("up"), "up");
  if (dot(m.forward, m.up) != 0) r.fail("up", "must be across \"forward\"");
  return m;
}

std::vector<JointMap> shippedMaps() {
  std::vector<JointMap> maps;
  for (const auto& [name, text] : shipped()) {
    maps.push_back(parseJointMap(text, "map " + name));
    maps.back().name = name;
  }
  return maps;
}

JointMap findJointMap(const std::string& name) {
  for (JointMap& m : shippedMaps())
    if (m.name == name) return m;
  if (name.find('.') == std::string::npos && name.find('/') == std::string::npos) {
    std::string all;
    for (const auto& [n, text] : shipped()) all += (all.empty() ? "" : ", ") + n;
    throw InputError({"", 0, "map"}, "there is no map '" + name + "'; there are " + all + ", or the path of a file");
  }
  return parseJointMap(readText(name, largest_file), name);
}

std::vector<JointMap> mapsFor(const std::vector<MapKind>& kinds, const std::vector<std::string>& names) {
  const std::set<std::string> there(names.begin(), names.end());
  const auto known = [&](const std::string& n) { return there.contains(n); };
  std::vector<JointMap> maps;
  for (JointMap& m : shippedMaps())
    if (std::find(kinds.begin(), kinds.end(), m.kind) != kinds.end() &&
        std::all_of(m.has.begin(), m.has.end(), known) && std::none_of(m.lacks.begin(), m.lacks.end(), known))
      maps.push_back(std::move(m));
  return maps;
}

}  // namespace gambeson
