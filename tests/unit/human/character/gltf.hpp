#pragma once
/// Small skinned characters written as glTF: y up, facing z, metres, as most of them are.

#include <fmt/format.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "core/contact/obstacle.hpp"

namespace gambeson::test {

struct GltfBone {
  std::string name;
  int parent;  ///< -1: the root
  Vec3 at;     ///< ours: x forward, y left, z up
};
struct GltfPart {
  std::string name;
  TriangleMesh mesh;                                         ///< ours
  std::vector<std::vector<std::pair<int, double>>> weights;  ///< at most four bones of each vertex; empty: no skin
};

/// Writes FOLDER/name and its buffer beside it. Each triangle gets vertices of its own where `split`.
inline std::filesystem::path writeGltf(const std::filesystem::path& file, const std::vector<GltfBone>& bones,
                                       const std::vector<GltfPart>& parts, bool split = false) {
  std::string bytes, views, accessors, meshes, nodes;
  int count = 0;
  const auto put = [&](const auto& value) {
    char raw[sizeof(value)];
    std::memcpy(raw, &value, sizeof(value));
    bytes.append(raw, sizeof(value));
  };
  const auto axes = [](const Vec3& x) { return Vec3{x.y, x.z, x.x}; };
  const auto accessor = [&](std::size_t begin, std::size_t n, int component, const char* type,
                            const std::string& more) {
    views += fmt::format("{}{{\"buffer\":0,\"byteOffset\":{},\"byteLength\":{}}}", count ? "," : "", begin,
                         bytes.size() - begin);
    accessors += fmt::format("{}{{\"bufferView\":{},\"componentType\":{},\"count\":{},\"type\":\"{}\"{}}}",
                             count ? "," : "", count, component, n, type, more);
    while (bytes.size() % 4) bytes.push_back(0);
    return count++;
  };
  for (std::size_t p = 0; p < parts.size(); ++p) {
    std::vector<Vec3> x = parts[p].mesh.vertices;
    auto weights = parts[p].weights;
    auto triangles = parts[p].mesh.triangles;
    if (split) {
      std::vector<Vec3> all;
      auto w = weights;
      w.clear();
      for (auto& t : triangles)
        for (int& v : t) {
          all.push_back(x[static_cast<std::size_t>(v)]);
          if (!weights.empty()) w.push_back(weights[static_cast<std::size_t>(v)]);
          v = static_cast<int>(all.size()) - 1;
        }
      x = all, weights = w;
    }
    Vec3 low = axes(x[0]), high = low;
    std::size_t begin = bytes.size();
    for (const Vec3& v : x) {
      const Vec3 g = axes(v);
      for (int k = 0; k < 3; ++k) {
        put(static_cast<float>(g[k]));
        low[k] = std::min(low[k], g[k]), high[k] = std::max(high[k], g[k]);
      }
    }
    const int position =
        accessor(begin, x.size(), 5126, "VEC3",
                 fmt::format(",\"min\":[{},{},{}],\"max\":[{},{},{}]", low.x, low.y, low.z, high.x, high.y, high.z));
    std::string attributes = fmt::format("\"POSITION\":{}", position);
    if (!weights.empty()) {
      begin = bytes.size();
      for (const auto& list : weights)
        for (std::size_t k = 0; k < 4; ++k) put(static_cast<std::uint16_t>(k < list.size() ? list[k].first : 0));
      const int joints = accessor(begin, x.size(), 5123, "VEC4", "");
      begin = bytes.size();
      for (const auto& list : weights)
        for (std::size_t k = 0; k < 4; ++k) put(static_cast<float>(k < list.size() ? list[k].second : 0));
      attributes +=
          fmt::format(",\"JOINTS_0\":{},\"WEIGHTS_0\":{}", joints, accessor(begin, x.size(), 5126, "VEC4", ""));
    }
    begin = bytes.size();
    for (const auto& t : triangles)
      for (const int v : t) put(static_cast<std::uint32_t>(v));
    const int indices = accessor(begin, 3 * triangles.size(), 5125, "SCALAR", "");
    meshes += fmt::format("{}{{\"name\":\"{}\",\"primitives\":[{{\"attributes\":{{{}}},\"indices\":{}}}]}}",
                          p ? "," : "", parts[p].name, attributes, indices);
    nodes += fmt::format(",{{\"name\":\"{}\",\"mesh\":{}{}}}", parts[p].name, p, weights.empty() ? "" : ",\"skin\":0");
  }
  std::string skins;
  if (!bones.empty()) {
    const std::size_t begin = bytes.size();
    for (const GltfBone& b : bones) {
      const Vec3 at = axes(b.at);
      for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) put(static_cast<float>(c == 3 && r < 3 ? -at[r] : c == r ? 1 : 0));
    }
    const int inverse = accessor(begin, bones.size(), 5126, "MAT4", "");
    std::string list;
    for (std::size_t b = 0; b < bones.size(); ++b) list += fmt::format("{}{}", b ? "," : "", b);
    skins = fmt::format(",\"skins\":[{{\"inverseBindMatrices\":{},\"joints\":[{}]}}]", inverse, list);
  }
  std::string skeleton, roots;
  for (std::size_t b = 0; b < bones.size(); ++b) {
    const Vec3 at =
        axes(bones[b].parent < 0 ? bones[b].at : bones[b].at - bones[static_cast<std::size_t>(bones[b].parent)].at);
    std::string children;
    for (std::size_t c = 0; c < bones.size(); ++c)
      if (bones[c].parent == static_cast<int>(b)) children += fmt::format("{}{}", children.empty() ? "" : ",", c);
    skeleton += fmt::format("{}{{\"name\":\"{}\",\"translation\":[{},{},{}]{}}}", b ? "," : "", bones[b].name, at.x,
                            at.y, at.z, children.empty() ? "" : ",\"children\":[" + children + "]");
    if (bones[b].parent < 0) roots += fmt::format("{}{}", roots.empty() ? "" : ",", b);
  }
  for (std::size_t p = 0; p < parts.size(); ++p)
    roots += fmt::format("{}{}", roots.empty() ? "" : ",", bones.size() + p);
  if (bones.empty()) nodes.erase(0, 1);
  std::filesystem::path bin = file;
  bin.replace_extension(".bin");
  std::ofstream(bin, std::ios::binary) << bytes;
  std::ofstream(file) << fmt::format(
      "{{\"asset\":{{\"version\":\"2.0\"}},\"scene\":0,\"scenes\":[{{\"nodes\":[{}]}}],\"nodes\":[{}{}],\"meshes\":[{}]"
      ","
      "\"buffers\":[{{\"uri\":\"{}\",\"byteLength\":{}}}],\"bufferViews\":[{}],\"accessors\":[{}]{}}}",
      roots, skeleton, nodes, meshes, bin.filename().string(), bytes.size(), views, accessors, skins);
  return file;
}

}  // namespace gambeson::test
