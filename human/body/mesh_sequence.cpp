#include "human/body/mesh_sequence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <tuple>

#include "core/error.hpp"
#include "human/files/mesh.hpp"
#include "human/skeleton/joint_map.hpp"

namespace gambeson {
namespace {

bool isDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// Numbers in names by their value, the rest by its letters.
bool before(const std::string& a, const std::string& b) {
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (!isDigit(a[i]) || !isDigit(b[j])) {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i, ++j;
      continue;
    }
    const auto number = [](const std::string& s, std::size_t& at) {
      while (at < s.size() && s[at] == '0') ++at;
      const std::size_t begin = at;
      while (at < s.size() && isDigit(s[at])) ++at;
      return s.substr(begin, at - begin);
    };
    const std::string m = number(a, i), n = number(b, j);
    if (m.size() != n.size()) return m.size() < n.size();
    if (m != n) return m < n;
  }
  return a.size() - i < b.size() - j;
}

/// Each edge stands once either way; triangles that have lost a corner do not count.
bool isClosed(const std::vector<std::array<int, 3>>& triangles) {
  std::map<std::pair<int, int>, int> edges;
  for (const auto& t : triangles)
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0])
      for (std::size_t k = 0; k < 3; ++k) {
        const int a = t[k], b = t[(k + 1) % 3];
        edges[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : 1024;
      }
  return std::all_of(edges.begin(), edges.end(), [](const auto& e) { return e.second == 1025; });
}

Mat3 turnOf(const SequenceOptions& o) {
  const std::string folder = o.folder.string();
  if (o.forward.empty() != o.up.empty())
    throw InputError({folder, 0, o.up.empty() ? "up" : "forward"}, "is missing: \"up\" and \"forward\" go together");
  if (o.up.empty()) return {};
  const Vec3 forward = namedAxis(o.forward), up = namedAxis(o.up);
  for (const auto& [axis, word, key] : {std::tuple{forward, o.forward, "forward"}, {up, o.up, "up"}})
    if (axis == Vec3{}) throw InputError({folder, 0, key}, fmt::format("'{}' is not allowed: x, -x, y, ...", word));
  if (dot(forward, up) != 0) throw InputError({folder, 0, "up"}, "must be across \"forward\"");
  return axesOf(forward, up);
}

}  // namespace

std::vector<std::filesystem::path> framesIn(const std::filesystem::path& folder) {
  std::error_code error;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    std::string extension = entry.path().extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (extension == ".obj" || extension == ".ply" || extension == ".stl" || extension == ".gltf" ||
        extension == ".glb")
      files.push_back(entry.path());
  }
  if (error) throw InputError({folder.string(), 0, "folder"}, "cannot be opened: " + error.message());
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) {
    const std::string m = a.filename().string(), n = b.filename().string();
    return before(m, n) || (!before(n, m) && m < n);
  });
  return files;
}

MeshSequence::MeshSequence(const SequenceOptions& o) {
  snapshots_.rate_Hz = o.rate_Hz;
  snapshots_.begin_s = o.begin_s;
  if (!(o.rate_Hz > 0 && std::isfinite(o.rate_Hz)))
    throw InputError({o.folder.string(), 0, "rate"}, fmt::format("{} is not allowed: > 0", o.rate_Hz));
  const Mat3 R = turnOf(o);
  const auto files = framesIn(o.folder);
  if (files.size() < 2)
    throw InputError(
        {o.folder.string(), 0, "folder"},
        fmt::format("holds {} meshes (.obj, .ply, .stl, .gltf, .glb); a sequence needs at least two frames",
                    files.size()));
  std::vector<std::array<int, 3>> all;
  for (const auto& file : files) {
    TriangleMesh m = loadTriangles(file, o.scale);
    if (snapshots_.frames.empty()) all = m.triangles;
    if (m.vertices.size() != (snapshots_.frames.empty() ? m.vertices.size() : snapshots_.frames[0].size()) ||
        m.triangles != all)
      throw InputError({file.string(), 0, ""},
                       fmt::format("has {} vertices and {} triangles, the first frame ({}) {} and {}: all frames must "
                                   "be one mesh that moves",
                                   m.vertices.size(), m.triangles.size(), files[0].filename().string(),
                                   snapshots_.frames[0].size(), all.size()));
    for (Vec3& x : m.vertices) x = R * x;
    snapshots_.frames.push_back(std::move(m.vertices));
  }
  // One vertex are those that are at one place in all frames.
  std::vector<int> of(snapshots_.frames[0].size(), 0), first;
  const auto joined = [&] {
    std::vector<std::array<int, 3>> triangles;
    for (const auto& t : all) triangles.push_back({of[t[0]], of[t[1]], of[t[2]]});
    return triangles;
  };
  bool closed = false;
  for (std::size_t i = 0; i < snapshots_.frames.size(); ++i) {
    const auto& x = snapshots_.frames[i];
    std::map<std::tuple<int, double, double, double>, int> known;
    first.clear();
    for (std::size_t v = 0; v < of.size(); ++v) {
      const auto [at, fresh] = known.try_emplace({of[v], x[v].x, x[v].y, x[v].z}, static_cast<int>(first.size()));
      if (fresh) first.push_back(static_cast<int>(v));
      of[v] = at->second;
    }
    if (i == 0) closed = isClosed(joined());
    if (closed && !isClosed(joined()))
      throw InputError({files[i].string(), 0, ""},
                       "its faces hang together in another way than those of the first frame: all frames must be one "
                       "mesh that moves");
  }
  std::vector<int> number(first.size(), -1), source;
  for (const auto& t : all) {
    std::array<int, 3> mine{of[t[0]], of[t[1]], of[t[2]]};
    if (mine[0] == mine[1] || mine[1] == mine[2] || mine[2] == mine[0]) continue;
    for (int& v : mine) {
      if (number[v] < 0) number[v] = static_cast<int>(source.size()), source.push_back(first[v]);
      v = number[v];
    }
    snapshots_.triangles.push_back(mine);
  }
  if (snapshots_.triangles.empty()) throw InputError({files[0].string(), 0, ""}, "holds no triangle with an area");
  for (auto& x : snapshots_.frames) {
    std::vector<Vec3> kept;
    for (const int v : source) kept.push_back(x[v]);
    x = std::move(kept);
  }
  double volume = 0;
  const auto& x = snapshots_.frames[0];
  for (const auto& t : snapshots_.triangles) volume += dot(x[t[0]] - x[0], cross(x[t[1]] - x[0], x[t[2]] - x[0]));
  if (volume < 0 && isClosed(snapshots_.triangles))
    for (auto& t : snapshots_.triangles) std::swap(t[1], t[2]);
}

void MeshSequence::at(double time_s, std::span<Vec3> x) const {
  const double s =
      std::clamp((time_s - snapshots_.begin_s) * snapshots_.rate_Hz, 0.0, static_cast<double>(frames() - 1));
  const int i = std::min(static_cast<int>(s), frames() - 2);
  const double u = s - i;
  // Cubic Hermite, h = 1: velocities (x_{i+1} - x_{i-1})/2, 0 at either end of the sequence.
  const double h00 = (1 + 2 * u) * (1 - u) * (1 - u), h10 = u * (1 - u) * (1 - u), h01 = u * u * (3 - 2 * u),
               h11 = u * u * (u - 1);
  const auto &a = snapshots_.frames[static_cast<std::size_t>(i)],
             &b = snapshots_.frames[static_cast<std::size_t>(i) + 1];
  const std::vector<Vec3>*before_a = i > 0 ? &snapshots_.frames[static_cast<std::size_t>(i) - 1] : nullptr,
        *after_b = i + 2 < frames() ? &snapshots_.frames[static_cast<std::size_t>(i) + 2] : nullptr;
  for (std::size_t v = 0; v < x.size(); ++v) {
    const Vec3 va = before_a ? 0.5 * (b[v] - (*before_a)[v]) : Vec3{},
               vb = after_b ? 0.5 * ((*after_b)[v] - a[v]) : Vec3{};
    x[v] = h00 * a[v] + h10 * va + h01 * b[v] + h11 * vb;
  }
}

}  // namespace gambeson
