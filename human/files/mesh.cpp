/// Mesh files through assimp. Of its formats these five are let in: others (OFF, say) believe any count in a header.

#include "human/files/mesh.hpp"

#include <assimp/postprocess.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>

#include "core/error.hpp"
#include "core/io/apart.hpp"
#include "human/files/json_file.hpp"
#include "human/files/read_text.hpp"
#include "human/files/scene_import.hpp"

namespace gambeson {
namespace {

constexpr double largest_coordinate_m = 1000;

/// Vertices at the same place become one, in the order of their first appearance; triangles that have lost a corner or
/// have no area go, unused vertices too.
TriangleMesh welded(const TriangleMesh& in) {
  const auto less = [](const Vec3& a, const Vec3& b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
  };
  std::map<Vec3, int, decltype(less)> known(less);
  TriangleMesh out;
  for (const auto& t : in.triangles) {
    const Vec3 a = in.vertices[t[0]], b = in.vertices[t[1]], c = in.vertices[t[2]];
    if (!(norm2(cross(b - a, c - a)) > 0)) continue;
    std::array<int, 3> corners{};
    for (int k = 0; k < 3; ++k) {
      const auto [at, fresh] = known.try_emplace(in.vertices[t[k]], static_cast<int>(out.vertices.size()));
      if (fresh) out.vertices.push_back(in.vertices[t[k]]);
      corners[k] = at->second;
    }
    out.triangles.push_back(corners);
  }
  return out;
}

/// Closed and consistently oriented: each directed edge stands once, and once the other way.
bool isClosed(const TriangleMesh& m) {
  std::map<std::pair<int, int>, int> edges;
  for (const auto& t : m.triangles)
    for (int k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  return std::all_of(edges.begin(), edges.end(), [&](const auto& e) {
    const auto back = edges.find({e.first.second, e.first.first});
    return e.second == 1 && back != edges.end() && back->second == 1;
  });
}

double signedVolume(const TriangleMesh& m) {
  double v = 0;
  for (const auto& t : m.triangles) v += dot(m.vertices[t[0]], cross(m.vertices[t[1]], m.vertices[t[2]])) / 6;
  return v;
}

TriangleMeshWithUv importTriangles(const std::filesystem::path& file, double scale, bool with_uv) {
  const auto fail = [&](const std::string& key, const std::string& reason) {
    throw InputError({file.string(), 0, key}, reason);
  };
  Assimp::Importer importer;
  importScene(importer, file);
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS,
                              aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS | aiComponent_COLORS |
                                  (with_uv ? aiComponent_NORMALS : aiComponent_TEXCOORDS) | aiComponent_BONEWEIGHTS |
                                  aiComponent_ANIMATIONS | aiComponent_TEXTURES | aiComponent_LIGHTS |
                                  aiComponent_CAMERAS | aiComponent_MATERIALS);
  const aiScene& scene = processScene(
      importer,
      aiProcess_RemoveComponent | aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_PreTransformVertices, file);
  TriangleMeshWithUv out;
  TriangleMesh& all = out.mesh;
  for (unsigned k = 0; k < scene.mNumMeshes; ++k) with_uv = with_uv && scene.mMeshes[k]->HasTextureCoords(0);
  for (unsigned k = 0; k < scene.mNumMeshes; ++k) {
    const aiMesh& mesh = *scene.mMeshes[k];
    const int first = static_cast<int>(all.vertices.size());
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const aiVector3D& p = mesh.mVertices[i];
      const Vec3 x = scale * Vec3{p.x, p.y, p.z};
      for (int c = 0; c < 3; ++c)
        if (!(std::abs(x[c]) <= largest_coordinate_m))
          fail(fmt::format("vertex {}", all.vertices.size()),
               fmt::format("coordinate {} m is not within {} m", x[c], largest_coordinate_m));
      all.vertices.push_back(x);
      if (!with_uv) continue;
      const aiVector3D& uv = mesh.mTextureCoords[0][i];
      if (!std::isfinite(uv.x + uv.y))
        fail(fmt::format("vertex {}", all.vertices.size() - 1), "has uv that is not finite");
      out.uv.push_back({uv.x, uv.y});
    }
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
      const aiFace& face = mesh.mFaces[i];
      if (face.mNumIndices != 3) continue;  // points and lines
      std::array<int, 3> t{};
      for (int c = 0; c < 3; ++c) {
        if (face.mIndices[c] >= mesh.mNumVertices)
          fail(fmt::format("face {}", all.triangles.size()),
               fmt::format("names vertex {} of {}", face.mIndices[c], mesh.mNumVertices));
        t[c] = first + static_cast<int>(face.mIndices[c]);
      }
      all.triangles.push_back(t);
    }
  }
  return out;
}

TriangleMeshWithUv load(const std::filesystem::path& file, double scale, bool with_uv) {
  const auto fail = [&](const std::string& key, const std::string& reason) {
    throw InputError({file.string(), 0, key}, reason);
  };
  if (!(scale > 0 && std::isfinite(scale))) fail("scale", fmt::format("{} is not allowed: > 0", scale));
  const std::array<const char*, 5> known{".obj", ".ply", ".stl", ".gltf", ".glb"};
  if (std::find(known.begin(), known.end(), extensionOf(file)) == known.end())
    fail("", "meshes are read from .obj, .ply, .stl, .gltf, .glb");
  BytesIn in = readApart(file, limitsFor(file), [&](BytesOut& out) {
    const TriangleMeshWithUv read = importTriangles(file, scale, with_uv);
    out.put(read.mesh.vertices);
    out.put(read.mesh.triangles);
    out.put(read.uv);
  });
  TriangleMeshWithUv out;
  in.get(out.mesh.vertices);
  in.get(out.mesh.triangles);
  in.get(out.uv);
  return out;
}

}  // namespace

TriangleMesh loadTriangles(const std::filesystem::path& file, double scale) { return load(file, scale, false).mesh; }

TriangleMeshWithUv loadTrianglesWithUv(const std::filesystem::path& file, double scale) {
  return load(file, scale, true);
}

TriangleMesh loadMesh(const std::filesystem::path& file, double scale) {
  TriangleMesh mesh = welded(loadTriangles(file, scale));
  if (mesh.triangles.empty()) throw InputError({file.string(), 0, ""}, "holds no triangle with an area");
  if (isClosed(mesh) && signedVolume(mesh) < 0)
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

std::vector<std::filesystem::path> filesBeside(const std::filesystem::path& file) {
  if (extensionOf(file) != ".gltf") return {};
  std::vector<std::string> names;
  readApart(file, limitsFor(file), [&](BytesOut& out) {
    const JsonFile r{file.string()};
    const JsonFile::Json root = r.parse(readText(file, largest_scene_file));
    std::vector<std::string> found;
    if (root.is_object() && root.contains("buffers") && root.at("buffers").is_array())
      for (const auto& buffer : root.at("buffers"))
        if (buffer.is_object() && buffer.contains("uri") && buffer.at("uri").is_string())
          if (const auto uri = buffer.at("uri").get<std::string>(); !uri.starts_with("data:")) found.push_back(uri);
    out.put(found);
  }).get(names);
  std::vector<std::filesystem::path> out;
  for (const std::string& name : names) out.push_back(file.parent_path() / name);
  return out;
}

void writeMesh(const TriangleMesh& mesh, const std::filesystem::path& obj) {
  std::ofstream out(obj, std::ios::binary);
  out << "# metres\n";
  for (const Vec3& x : mesh.vertices) out << fmt::format("v {} {} {}\n", x.x, x.y, x.z);
  for (const auto& t : mesh.triangles) out << fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  out.close();
  if (!out) throw InputError({obj.string(), 0, ""}, "cannot be written");
}

}  // namespace gambeson
