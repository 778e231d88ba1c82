/// Detail of rigged_mesh.hpp: MakeHuman's base mesh with its rig. The base mesh also holds helper surfaces and a small
/// cube at each joint, in groups of their own; morphs move all vertices, so joints follow the body.

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "core/error.hpp"
#include "human/character/rigged_mesh.hpp"
#include "human/files/json_file.hpp"
#include "human/files/read_text.hpp"
#include "human/files/text_lines.hpp"

namespace gambeson {
namespace {

using Json = JsonFile::Json;
constexpr std::uintmax_t largest_json = std::uintmax_t{64} << 20;
constexpr double largest_amount = 10, largest_coordinate = 1e4;

void readBase(const MakeHumanFiles& files, RiggedMesh& out) {
  TextLines lines(files.mesh);
  std::string group;
  while (lines.nextFull()) {
    const auto words = lines.words();
    if (words[0] == "v") {
      if (words.size() < 4) lines.fail("a vertex needs three coordinates");
      Vec3 x;
      for (std::size_t k = 0; k < 3; ++k) x[static_cast<int>(k)] = lines.number(words[k + 1], k + 2, "v");
      if (!(norm(x) < largest_coordinate)) lines.fail("a vertex lies too far away");
      out.mesh.vertices.push_back(x);
    } else if (words[0] == "g" || words[0] == "o") {
      group = words.size() > 1 ? std::string(words[1]) : "";
    } else if (words[0] == "f" && group == files.group) {
      std::vector<int> corners;
      for (std::size_t k = 1; k < words.size(); ++k) {
        const std::string_view name = words[k].substr(0, words[k].find('/'));
        const double v = lines.number(name, k + 1, "f");
        if (!(v >= 1 && v <= static_cast<double>(out.mesh.vertices.size()) && v == std::floor(v)))
          lines.fail(fmt::format("names vertex {} of {}", name.substr(0, 40), out.mesh.vertices.size()));
        corners.push_back(static_cast<int>(v) - 1);
      }
      if (corners.size() < 3) lines.fail("a face needs three corners");
      // A quad is cut along its shorter diagonal.
      const auto& x = out.mesh.vertices;
      if (corners.size() == 4 && norm2(x[corners[1]] - x[corners[3]]) < norm2(x[corners[0]] - x[corners[2]]))
        corners = {corners[1], corners[2], corners[3], corners[0]};
      for (std::size_t k = 1; k + 1 < corners.size(); ++k)
        out.mesh.triangles.push_back({corners[0], corners[k], corners[k + 1]});
    }
  }
  if (out.mesh.triangles.empty())
    throw InputError({out.file, 0, "group"}, "has no faces in the group '" + files.group + "'");
}

void morph(const MorphTarget& target, std::vector<Vec3>& x) {
  if (!(std::abs(target.amount) <= largest_amount))
    throw InputError({target.file.string(), 0, "share"}, fmt::format("{} is not within 10", target.amount));
  TextLines lines(target.file);
  while (lines.nextFull()) {
    const auto words = lines.words();
    if (words[0].starts_with('#')) continue;
    if (words.size() != 4) lines.fail("a line of a target is a vertex and three lengths");
    const double v = lines.number(words[0], 1, "vertex");
    if (!(v >= 0 && v < static_cast<double>(x.size()) && v == std::floor(v)))
      lines.fail(fmt::format("names vertex {} of {}", words[0], x.size()));
    for (std::size_t k = 0; k < 3; ++k)
      x[static_cast<std::size_t>(v)][static_cast<int>(k)] += target.amount * lines.number(words[k + 1], k + 2, "d");
  }
}

void readBones(const MakeHumanFiles& files, RiggedMesh& out) {
  const JsonFile r{files.skeleton.string()};
  const Json root = r.parse(readText(files.skeleton, largest_json));
  for (const char* key : {"bones", "joints"})
    if (!root.is_object() || !root.contains(key) || !root.at(key).is_object() || root.at(key).empty())
      r.fail(key, "is missing: a skeleton of MakeHuman has \"bones\" and \"joints\"");
  std::map<std::string, Vec3> heads;
  const auto headOf = [&](const std::string& bone, const std::string& joint) {
    if (const auto known = heads.find(joint); known != heads.end()) return known->second;
    const std::string at = "joints." + joint;
    if (!root.at("joints").contains(joint)) r.fail("bones." + bone + ".head", "there is no joint '" + joint + "'");
    const Json& ids = root.at("joints").at(joint);
    if (!ids.is_array() || ids.empty()) r.fail(at, "must be a list of vertices");
    Vec3 sum;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      if (!ids[i].is_number_integer() || ids[i] < 0 || ids[i] >= static_cast<int>(out.mesh.vertices.size()))
        r.fail(fmt::format("{}[{}]", at, i), fmt::format("is no vertex of {}", out.file));
      sum += out.mesh.vertices[ids[i].get<std::size_t>()];
    }
    return heads[joint] = sum / static_cast<double>(ids.size());
  };
  struct Bone {
    std::string parent, head;  ///< no parent: the root
    int round = -1;
    bool open = false;
  };
  std::map<std::string, Bone> bones;
  for (const auto& [name, bone] : root.at("bones").items()) {
    const std::string at = "bones." + name;
    if (!bone.is_object() || !bone.contains("head") || !bone.contains("parent"))
      r.fail(at, "needs \"head\" and \"parent\"");
    Bone& b = bones[name];
    b.head = r.text(bone.at("head"), at + ".head");
    if (bone.at("parent").is_null()) continue;
    b.parent = r.text(bone.at("parent"), at + ".parent");
    if (!root.at("bones").contains(b.parent)) r.fail(at + ".parent", "there is no bone '" + b.parent + "'");
  }
  // Parents first: rounds through the bones by name, each of which takes those whose parent it or one before it has.
  std::map<int, std::vector<std::string>> rounds;
  for (auto& [name, bone] : bones) {
    std::vector<std::pair<const std::string, Bone>*> chain;
    for (auto at = bones.find(name); at->second.round < 0; at = bones.find(at->second.parent)) {
      if (at->second.open) r.fail("bones", "some hang from each other in a circle");
      at->second.open = true;
      chain.push_back(&*at);
      if (at->second.parent.empty()) break;
    }
    for (auto at = chain.rbegin(); at != chain.rend(); ++at) {
      auto& [own, b] = **at;
      b.round = b.parent.empty() ? 0 : bones.at(b.parent).round + (own < b.parent ? 1 : 0);
    }
    rounds[bone.round].push_back(name);
  }
  std::map<std::string, int> number;
  for (const auto& [round, names] : rounds)
    for (const std::string& name : names) {
      const Bone& b = bones.at(name);
      number[name] = static_cast<int>(out.bones.size());
      out.bones.push_back({name, b.parent.empty() ? -1 : number.at(b.parent), headOf(name, b.head)});
    }
}

void readWeights(const MakeHumanFiles& files, RiggedMesh& out) {
  const JsonFile r{files.weights.string()};
  const Json root = r.parse(readText(files.weights, largest_json));
  if (!root.is_object() || !root.contains("weights") || !root.at("weights").is_object())
    r.fail("weights", "is missing");
  std::map<std::string, int> number;
  for (std::size_t b = 0; b < out.bones.size(); ++b) number.emplace(out.bones[b].name, static_cast<int>(b));
  std::vector<std::vector<std::pair<int, double>>> of(out.mesh.vertices.size());
  for (const auto& [name, list] : root.at("weights").items()) {
    const std::string at = "weights." + name;
    const auto found = number.find(name);
    if (found == number.end()) r.fail(at, "there is no such bone in " + files.skeleton.string());
    const int b = found->second;
    if (!list.is_array()) r.fail(at, "must be a list of pairs of vertex and weight");
    for (std::size_t i = 0; i < list.size(); ++i) {
      const Json& p = list[i];
      const std::string here = fmt::format("{}[{}]", at, i);
      if (!p.is_array() || p.size() != 2 || !p[0].is_number_integer() || p[0] < 0 ||
          p[0] >= static_cast<int>(of.size()))
        r.fail(here, "must be a vertex of the mesh and a weight");
      const double w = r.number(p[1], here, -1e-12, 10);
      if (w > 0) of[p[0].get<std::size_t>()].emplace_back(b, w);
    }
  }
  out.first = {0};
  for (const auto& list : of) {
    for (const auto& [b, w] : list) out.bone.push_back(b), out.weight.push_back(w);
    out.first.push_back(static_cast<int>(out.bone.size()));
  }
}

}  // namespace

RiggedMesh readMakeHuman(const MakeHumanFiles& files) {
  RiggedMesh out;
  out.file = files.mesh.string();
  out.unit_m = 0.1;  // decimetres
  readBase(files, out);
  for (const MorphTarget& t : files.targets) morph(t, out.mesh.vertices);
  readBones(files, out);
  readWeights(files, out);
  return out;
}

}  // namespace gambeson
