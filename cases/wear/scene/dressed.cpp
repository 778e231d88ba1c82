#include "cases/wear/scene/dressed.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "cases/input/fingerprint.hpp"
#include "cases/input/message.hpp"
#include "core/error.hpp"
#include "core/io/own_file.hpp"
#include "human/files/read_text.hpp"

namespace gambeson {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* format_name = "gambeson dressed 1";
constexpr double largest_coordinate_m = 1000;
constexpr std::uintmax_t largest_file = std::uintmax_t{32} << 20;
constexpr int deepest = 16;

Json parsed(const std::string& text) {
  return Json::parse(text, [&](int depth, Json::parse_event_t, Json&) {
    if (depth > deepest) throw InputError({"", 0, ""}, "is nested deeper than " + std::to_string(deepest) + " levels");
    return true;
  });
}

Json listOf(const Vec3& v) { return {v.x, v.y, v.z}; }

double anyNumberOf(const Json& j, const std::string& key) {
  if (!j.is_number()) throw InputError({"", 0, key}, "must be a number");
  return j.get<double>();
}

double numberOf(const Json& j, const std::string& key) {
  const double x = anyNumberOf(j, key);
  if (!(std::abs(x) <= largest_coordinate_m)) throw InputError({"", 0, key}, "must be between -1000 and 1000");
  return x;
}

Vec3 vecOf(const Json& j, const std::string& key) {
  if (!j.is_array() || j.size() != 3) throw InputError({"", 0, key}, "must be three numbers");
  return {numberOf(j[0], key), numberOf(j[1], key), numberOf(j[2], key)};
}

const Json& member(const Json& j, const char* name, const std::string& at) {
  if (!j.is_object() || !j.contains(name)) throw InputError({"", 0, at + name}, "is missing");
  return j.at(name);
}

const Json& listIn(const Json& j, const char* name, const std::string& at) {
  const Json& list = member(j, name, at);
  if (!list.is_array()) throw InputError({"", 0, at + name}, "must be a list");
  return list;
}

std::string textIn(const Json& j, const char* name, const std::string& at) {
  const Json& text = member(j, name, at);
  if (!text.is_string()) throw InputError({"", 0, at + name}, "must be a text");
  return text.get<std::string>();
}

Dressed dressedOf(const Json& j) {
  if (const std::string format = textIn(j, "format", ""); format != format_name)
    throw InputError({"", 0, "format"}, "\"" + format + "\" is not known; allowed: \"" + format_name + "\"");
  Dressed d;
  d.body = textIn(j, "body", "");
  const Json& posture = member(j, "posture", "");
  for (const Json& q : listIn(posture, "joints", "posture.")) d.posture.q.push_back(numberOf(q, "posture.joints"));
  d.posture.root.origin = vecOf(member(posture, "origin_m", "posture."), "posture.origin_m");
  const Json& rotation = listIn(posture, "rotation", "posture.");
  if (rotation.size() != 9) throw InputError({"", 0, "posture.rotation"}, "must be nine numbers");
  Vec3* columns[] = {&d.posture.root.rotation.a, &d.posture.root.rotation.b, &d.posture.root.rotation.c};
  for (std::size_t c = 0; c < 3; ++c)
    *columns[c] = {numberOf(rotation[c], "posture.rotation"), numberOf(rotation[3 + c], "posture.rotation"),
                   numberOf(rotation[6 + c], "posture.rotation")};
  const Mat3& R = d.posture.root.rotation;
  const Mat3 unit = transpose(R) * R;
  for (const double error : {norm(unit.a - Vec3{1, 0, 0}), norm(unit.b - Vec3{0, 1, 0}), norm(unit.c - Vec3{0, 0, 1}),
                             std::abs(dot(R.a, cross(R.b, R.c)) - 1)})
    if (!(error < 1e-6)) throw InputError({"", 0, "posture.rotation"}, "must turn: three unit vectors at right angles");
  const Json& garments = listIn(j, "garments", "");
  for (std::size_t g = 0; g < garments.size(); ++g) {
    const std::string at = "garments[" + std::to_string(g) + "].";
    DressedGarment garment{textIn(garments[g], "name", at), {}};
    const Json& points = listIn(garments[g], "points_m", at);
    for (std::size_t i = 0; i < points.size(); ++i)
      garment.points_m.push_back(vecOf(points[i], at + "points_m[" + std::to_string(i) + "]"));
    if (garments[g].contains("history")) garment.law = textIn(garments[g], "law", at);
    if (garments[g].contains("history"))
      for (const Json& number : listIn(garments[g], "history", at))
        garment.history.push_back(anyNumberOf(number, at + "history"));
    d.garments.push_back(std::move(garment));
  }
  return d;
}

}  // namespace

std::string bodyFingerprint(const HumanCase& human) {
  Fingerprint hash;
  Case only;
  only.garments.resize(1);
  only.human = human;
  only.human->motion = StandMotion{};
  hash.addFile(only.human->urdf);
  hash.addFile(only.human->body);
  hash.add(writeCase(only));
  return hash.text();
}

void writeDressed(const Dressed& d, const std::filesystem::path& file) {
  const Mat3& R = d.posture.root.rotation;
  const Json rotation{R.a.x, R.b.x, R.c.x, R.a.y, R.b.y, R.c.y, R.a.z, R.b.z, R.c.z};
  Json garments = Json::array();
  for (const DressedGarment& g : d.garments) {
    Json points = Json::array();
    for (const Vec3& x : g.points_m) points.push_back(listOf(x));
    garments.push_back({{"name", g.name}, {"points_m", std::move(points)}});
    if (g.history.empty()) continue;
    garments.back()["law"] = g.law;
    garments.back()["history"] = g.history;
  }
  const Json j{
      {"format", format_name},
      {"body", d.body},
      {"posture", {{"joints", d.posture.q}, {"origin_m", listOf(d.posture.root.origin)}, {"rotation", rotation}}},
      {"garments", std::move(garments)}};
  writeOwnFile(file, j.dump() + "\n");
}

Dressed readDressed(const std::filesystem::path& file) {
  const std::string text = readText(file, largest_file);
  try {
    return dressedOf(parsed(text));
  } catch (const nlohmann::json::exception& e) {
    throw InputError({file.string(), 0, ""}, jsonReason(e.what()));
  } catch (const InputError& e) {
    throw InputError({file.string(), 0, e.where().key}, e.reason());
  }
}

}  // namespace gambeson
