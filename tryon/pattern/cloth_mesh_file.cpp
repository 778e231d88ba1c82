#include "tryon/pattern/cloth_mesh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "core/cloth/draft/obj_mesh.hpp"
#include "core/error.hpp"
#include "human/files/json_file.hpp"
#include "human/files/mesh.hpp"
#include "human/files/read_text.hpp"

namespace gambeson {
namespace {

using Json = JsonFile::Json;

constexpr std::uintmax_t kMostBytes = 64u << 20;
constexpr double kLargest_m = 1000;
constexpr const char* kFormat = "gambeson mesh 1";

std::string item(const std::string& list, std::size_t k) { return fmt::format("{}[{}]", list, k); }

class Reader {
 public:
  explicit Reader(const std::filesystem::path& file) : r_{file.string()} {}

  ClothMeshFile read() {
    const Json root = r_.parse(readText(r_.file, kMostBytes));
    r_.checkKeys(root, "", {"format", "name", "vertices_m", "patches"}, {"source", "edges"});
    if (r_.text(root.at("format"), "format") != kFormat) r_.fail("format", fmt::format("must be \"{}\"", kFormat));
    out_.name = r_.text(root.at("name"), "name");
    if (root.contains("source")) source(root.at("source"));
    const Json& vertices = list(root.at("vertices_m"), "vertices_m", 3 * kMostClothTriangles);
    for (std::size_t k = 0; k < vertices.size(); ++k)
      out_.mesh.vertices.push_back(r_.triple(vertices[k], item("vertices_m", k), -kLargest_m, kLargest_m));
    const Json& patches = list(root.at("patches"), "patches", 10000);
    for (std::size_t k = 0; k < patches.size(); ++k) patch(patches[k], item("patches", k));
    if (!out_.mesh.uv.empty() && out_.mesh.uv.size() != out_.mesh.triangles.size())
      r_.fail("patches", "some have uv_m and others none; allowed: all or none");
    if (root.contains("edges")) {
      const Json& edges = list(root.at("edges"), "edges", 10000);
      for (std::size_t k = 0; k < edges.size(); ++k) edge(edges[k], item("edges", k));
    }
    return std::move(out_);
  }

 private:
  const Json& list(const Json& value, const std::string& key, std::size_t most) const {
    if (!value.is_array()) r_.fail(key, "must be a list [ ]");
    if (value.size() > most) r_.fail(key, fmt::format("has {} items; allowed: {}", value.size(), most));
    return value;
  }
  int vertex(const Json& value, const std::string& key) const {
    const std::size_t count = out_.mesh.vertices.size();
    if (!value.is_number_integer()) r_.fail(key, "must be the number of a vertex, from 0");
    const double x = value;
    if (!(x >= 0 && x < static_cast<double>(count)))
      r_.fail(key, fmt::format("{} is not allowed: the number of one of the {} vertices, from 0", x, count));
    return static_cast<int>(x);
  }
  void source(const Json& value) {
    r_.checkKeys(value, "source", {}, {"file", "format", "unit"});
    for (const auto& [key, text] :
         {std::pair("file", &out_.source.file), {"format", &out_.source.format}, {"unit", &out_.source.unit}})
      if (value.contains(key)) *text = r_.text(value.at(key), std::string("source.") + key);
  }
  void patch(const Json& value, const std::string& key) {
    r_.checkKeys(value, key, {"name", "triangles"}, {"uv_m"});
    ClothMesh& m = out_.mesh;
    m.patch_names.push_back(r_.text(value.at("name"), key + ".name"));
    if (std::find(m.patch_names.begin(), m.patch_names.end() - 1, m.patch_names.back()) != m.patch_names.end() - 1)
      r_.fail(key + ".name", "names two patches");
    const std::string of = key + ".triangles";
    const Json& triangles = list(value.at("triangles"), of, kMostClothTriangles - m.triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      if (!triangles[t].is_array() || triangles[t].size() != 3)
        r_.fail(item(of, t), "must be three numbers of vertices");
      std::array<int, 3> corners{};
      for (std::size_t k = 0; k < 3; ++k) corners[k] = vertex(triangles[t][k], item(item(of, t), k));
      m.triangles.push_back(corners);
      m.patch.push_back(static_cast<int>(m.patch_names.size()) - 1);
    }
    if (!value.contains("uv_m")) return;
    const Json& uv = list(value.at("uv_m"), key + ".uv_m", 6 * kMostClothTriangles);
    if (uv.size() != 6 * triangles.size())
      r_.fail(key + ".uv_m", fmt::format("has {} numbers; allowed: {}, u and v of each corner of each triangle",
                                         uv.size(), 6 * triangles.size()));
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      auto& corners = m.uv.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = 6 * t + 2 * k;
        corners[k] = {r_.number(uv[i], item(key + ".uv_m", i), -kLargest_m, kLargest_m),
                      r_.number(uv[i + 1], item(key + ".uv_m", i + 1), -kLargest_m, kLargest_m)};
      }
    }
  }
  void edge(const Json& value, const std::string& key) {
    r_.checkKeys(value, key, {"name", "patch", "vertices"}, {});
    const std::vector<std::string>& names = out_.mesh.patch_names;
    MeshLine line{r_.text(value.at("name"), key + ".name"), 0, {}};
    const auto patch = std::find(names.begin(), names.end(), r_.text(value.at("patch"), key + ".patch"));
    if (patch == names.end()) r_.fail(key + ".patch", "names no patch of this file");
    line.patch = static_cast<int>(patch - names.begin());
    const Json& vertices = list(value.at("vertices"), key + ".vertices", 3 * kMostClothTriangles);
    for (std::size_t k = 0; k < vertices.size(); ++k)
      line.vertices.push_back(vertex(vertices[k], item(key + ".vertices", k)));
    out_.mesh.lines.push_back(std::move(line));
  }

  JsonFile r_;
  ClothMeshFile out_;
};

/// A PLY file is one patch, "cloth", without uv and named edges.
ClothMesh readPly(const std::filesystem::path& file) {
  const TriangleMesh triangles = loadMesh(file);
  ClothMesh mesh;
  mesh.vertices = triangles.vertices;
  mesh.patch_names = {"cloth"};
  mesh.triangles = triangles.triangles;
  mesh.patch.assign(mesh.triangles.size(), 0);
  try {
    checkMesh(mesh);
  } catch (const InputError& e) {
    throw InputError({file.string(), 0, e.where().key}, e.reason());
  }
  return mesh;
}

std::string quoted(const std::string& text) { return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace); }

/// Items side by side, so many in a line.
template <class Items, class Word>
std::string lines(const Items& items, std::size_t in_line, const Word& word) {
  std::string out = "[";
  std::size_t k = 0;
  for (const auto& x : items) {
    out += k == 0 ? "" : k % in_line == 0 ? ",\n    " : ", ";
    out += word(x);
    ++k;
  }
  return out + "]";
}

}  // namespace

ClothMeshFile loadClothMesh(const std::filesystem::path& file) {
  ClothMeshFile out = Reader(file).read();
  try {
    checkMesh(out.mesh);
  } catch (const InputError& e) {
    throw InputError({file.string(), 0, e.where().key}, e.reason());
  }
  return out;
}

std::string clothMeshText(const ClothMeshFile& f) {
  const ClothMesh& m = f.mesh;
  std::string out = fmt::format("{{\"format\": \"{}\", \"name\": {},\n", kFormat, quoted(f.name));
  std::string source;
  for (const auto& [key, text] :
       {std::pair("file", &f.source.file), {"format", &f.source.format}, {"unit", &f.source.unit}})
    if (!text->empty()) source += fmt::format("{}\"{}\": {}", source.empty() ? "" : ", ", key, quoted(*text));
  if (!source.empty()) out += fmt::format(" \"source\": {{{}}},\n", source);
  out += " \"vertices_m\": " +
         lines(m.vertices, 3, [](const Vec3& x) { return fmt::format("[{}, {}, {}]", x.x, x.y, x.z); });
  out += ",\n \"patches\": [";
  for (std::size_t p = 0, t = 0; p < m.patch_names.size(); ++p) {
    const std::size_t first = t;
    while (t < m.triangles.size() && m.patch[t] == static_cast<int>(p)) ++t;
    const auto from = static_cast<std::ptrdiff_t>(first), to = static_cast<std::ptrdiff_t>(t);
    out += fmt::format("{}{{\"name\": {},\n   \"triangles\": ", p ? ",\n  " : "\n  ", quoted(m.patch_names[p]));
    out += lines(std::vector(m.triangles.begin() + from, m.triangles.begin() + to), 8,
                 [](const auto& c) { return fmt::format("[{}, {}, {}]", c[0], c[1], c[2]); });
    if (!m.uv.empty())
      out += ",\n   \"uv_m\": " + lines(std::vector(m.uv.begin() + from, m.uv.begin() + to), 2, [](const auto& c) {
               return fmt::format("{}, {}, {}, {}, {}, {}", c[0].x, c[0].y, c[1].x, c[1].y, c[2].x, c[2].y);
             });
    out += "}";
  }
  out += "]";
  for (std::size_t k = 0; k < m.lines.size(); ++k) {
    const MeshLine& line = m.lines[k];
    out += fmt::format("{}{{\"name\": {}, \"patch\": {},\n   \"vertices\": {}}}", k ? ",\n  " : ",\n \"edges\": [\n  ",
                       quoted(line.name), quoted(m.patch_names[static_cast<std::size_t>(line.patch)]),
                       lines(line.vertices, 20, [](int v) { return fmt::format("{}", v); }));
  }
  return out + (m.lines.empty() ? "}\n" : "]}\n");
}

ClothMesh readClothMesh(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  if (ending == ".ply") return readPly(file);
  if (ending == ".obj") return readObj(file);
  if (ending == ".json") return loadClothMesh(file).mesh;
  throw InputError(
      {file.string(), 0, "path"},
      "is no mesh of cloth; allowed: files that end in .obj or .ply, and those of gambeson import (.json)");
}

}  // namespace gambeson
