#include "analysis/animation/obj.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <set>

namespace gambeson {
namespace {

/// Names of groups end at a space.
std::string wordOf(std::string name) {
  for (char& c : name)
    if (std::isspace(static_cast<unsigned char>(c)) || c == '#') c = '_';
  return name.empty() ? "part" : name;
}

class Writer {
 public:
  void group(const std::string& name, const std::vector<float>& x, const std::vector<std::array<int, 3>>& triangles) {
    std::string word = wordOf(name);
    for (int k = 2; !names_.insert(word).second; ++k) word = fmt::format("{}_{}", wordOf(name), k);
    auto to = std::back_inserter(text);
    fmt::format_to(to, "g {}\n", word);
    for (std::size_t i = 0; i + 2 < x.size(); i += 3) fmt::format_to(to, "v {} {} {}\n", x[i], x[i + 1], x[i + 2]);
    for (const auto& t : triangles) fmt::format_to(to, "f {} {} {}\n", first_ + t[0], first_ + t[1], first_ + t[2]);
    first_ += static_cast<int>(x.size() / 3);
  }
  std::string text;

 private:
  std::set<std::string> names_;
  int first_ = 1;
};

template <class At>
std::vector<float> floatsOf(std::size_t count, At at) {
  std::vector<float> x;
  for (std::size_t v = 0; v < count; ++v) {
    const Vec3 p = at(v);
    for (int c = 0; c < 3; ++c) x.push_back(static_cast<float>(p[c]));
  }
  return x;
}

}  // namespace

std::string encodeObj(const AnimatedScene& scene, std::size_t time) {
  std::string title = scene.title;
  std::replace_if(
      title.begin(), title.end(), [](unsigned char c) { return std::iscntrl(c); }, ' ');
  Writer out;
  out.text = fmt::format("# {}, {} s; metres, z up\n", title, scene.time_s.at(time));
  const std::vector<Placement> X_WN = worldOf(scene, time);
  for (const FixedMesh& m : scene.fixed) {
    const Placement& X = X_WN.at(static_cast<std::size_t>(m.node));
    out.group(m.name, floatsOf(m.mesh.vertices.size(), [&](std::size_t v) { return X * m.mesh.vertices[v]; }),
              m.mesh.triangles);
  }
  for (const SkinnedMesh& m : scene.skinned) {
    const std::vector<Vec3> x = positionsOf(m, X_WN);
    out.group(m.name, floatsOf(x.size(), [&](std::size_t v) { return x[v]; }), m.triangles);
  }
  for (const MovingMesh& m : scene.moving) out.group(m.name, m.at.at(time), m.triangles);
  return out.text;
}

std::string numbered(const std::string& file, std::size_t time) {
  const std::size_t dot = file.find_last_of('.');
  return fmt::format("{}_{:04d}{}", file.substr(0, dot), time + 1, file.substr(dot));
}

}  // namespace gambeson
