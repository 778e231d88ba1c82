#pragma once
/// Reads .glb back for tests: nodes in the world and vertices of meshes at a time, as a player would show them.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/math/vec.hpp"

namespace gambeson {

class GlbReader {
 public:
  using Json = nlohmann::json;
  explicit GlbReader(const std::string& bytes) {
    const auto word = [&](std::size_t at) {
      std::uint32_t v = 0;
      std::memcpy(&v, bytes.data() + at, 4);
      return static_cast<std::size_t>(v);
    };
    if (bytes.substr(0, 4) != "glTF" || word(4) != 2 || word(8) != bytes.size()) throw std::runtime_error("no glb");
    const std::size_t text = word(12);
    json = Json::parse(bytes.substr(20, text));
    if (word(20 + text) + 28 + text != bytes.size()) throw std::runtime_error("length of the buffer");
    data_ = bytes.substr(28 + text);
    parent_.assign(json["nodes"].size(), -1);
    for (std::size_t n = 0; n < parent_.size(); ++n)
      for (const int child : json["nodes"][n].value("children", std::vector<int>{}))
        parent_[static_cast<std::size_t>(child)] = static_cast<int>(n);
  }

  /// All numbers of an accessor, element by element.
  std::vector<double> numbers(int accessor) const {
    const Json& a = json["accessors"][static_cast<std::size_t>(accessor)];
    const Json& v = json["bufferViews"][a["bufferView"].get<std::size_t>()];
    const std::string type = a["type"];
    const std::size_t per = type == "SCALAR" ? 1 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 16;
    const int component = a["componentType"];
    const std::size_t size = component == 5126 || component == 5125 ? 4 : 2;
    const std::size_t stride = v.value("byteStride", per * size);
    const std::size_t begin = v.value("byteOffset", std::size_t{0}) + a.value("byteOffset", std::size_t{0});
    std::vector<double> out;
    for (std::size_t i = 0; i < a["count"].get<std::size_t>(); ++i)
      for (std::size_t k = 0; k < per; ++k) {
        const char* at = data_.data() + begin + i * stride + k * size;
        if (component == 5126) out.push_back(as<float>(at));
        if (component == 5125) out.push_back(as<std::uint32_t>(at));
        if (component == 5122) out.push_back(as<std::int16_t>(at));
        if (component == 5123) out.push_back(as<std::uint16_t>(at) / (a.value("normalized", false) ? 65535.0 : 1.0));
      }
    return out;
  }

  int node(const std::string& name, bool with_mesh = false) const {
    for (std::size_t n = 0; n < parent_.size(); ++n)
      if (json["nodes"][n]["name"] == name && (!with_mesh || json["nodes"][n].contains("mesh")))
        return static_cast<int>(n);
    throw std::runtime_error("no node " + name);
  }

  std::vector<double> times() const { return numbers(json["animations"][0]["samplers"][0]["input"].get<int>()); }

  /// A property of a node at key k.
  std::vector<double> property(int node, const std::string& path, std::size_t k, std::vector<double> otherwise) const {
    if (json.contains("animations"))
      for (const Json& c : json["animations"][0]["channels"]) {
        if (c["target"]["node"] != node || c["target"]["path"] != path) continue;
        const Json& sampler = json["animations"][0]["samplers"][c["sampler"].get<std::size_t>()];
        const std::vector<double> all = numbers(sampler["output"].get<int>());
        const std::size_t per = all.size() / times().size();
        return {all.begin() + static_cast<std::ptrdiff_t>(k * per),
                all.begin() + static_cast<std::ptrdiff_t>((k + 1) * per)};
      }
    const Json& n = json["nodes"][static_cast<std::size_t>(node)];
    return n.contains(path) ? n[path].get<std::vector<double>>() : otherwise;
  }

  /// A point of a node's frame in glTF's world at key k.
  Vec3 inWorld(int node, std::size_t k, Vec3 p) const {
    for (; node >= 0; node = parent_[static_cast<std::size_t>(node)]) {
      const auto s = property(node, "scale", k, {1, 1, 1}), t = property(node, "translation", k, {0, 0, 0}),
                 r = property(node, "rotation", k, {0, 0, 0, 1});
      const Vec3 scaled{s[0] * p.x, s[1] * p.y, s[2] * p.z}, u{r[0], r[1], r[2]};
      p = scaled + 2 * r[3] * cross(u, scaled) + 2 * cross(u, cross(u, scaled)) + Vec3{t[0], t[1], t[2]};
    }
    return p;
  }

  /// In our axes: x forward, y left, z up.
  Vec3 inOurs(int node, std::size_t k, const Vec3& p) const {
    const Vec3 x = inWorld(node, k, p);
    return {x.z, x.x, x.y};
  }

  /// The vertices of a node's mesh, morphed, in our axes.
  std::vector<Vec3> vertices(int node, std::size_t k) const {
    const Json& mesh = json["meshes"][json["nodes"][static_cast<std::size_t>(node)]["mesh"].get<std::size_t>()];
    const Json& primitive = mesh["primitives"][0];
    std::vector<double> x = numbers(primitive["attributes"]["POSITION"].get<int>());
    const std::vector<double> weights = property(node, "weights", k, {});
    for (std::size_t t = 0; t < weights.size(); ++t) {
      if (weights[t] == 0) continue;
      const std::vector<double> d = numbers(primitive["targets"][t]["POSITION"].get<int>());
      for (std::size_t i = 0; i < x.size(); ++i) x[i] += weights[t] * d[i];
    }
    std::vector<Vec3> out;
    for (std::size_t i = 0; i + 2 < x.size(); i += 3) out.push_back(inOurs(node, k, {x[i], x[i + 1], x[i + 2]}));
    return out;
  }

  Json json;

 private:
  template <class T>
  static double as(const char* at) {
    T v{};
    std::memcpy(&v, at, sizeof v);
    return static_cast<double>(v);
  }
  std::string data_;
  std::vector<int> parent_;
};

}  // namespace gambeson
