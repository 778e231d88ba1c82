#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "human/files/mesh.hpp"
#include "unit/human/files/files.hpp"

namespace gambeson {
namespace {

using test::expectRefused;
using test::Folder;
using test::replaced;

const std::string tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
const std::string ply =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 4\n"
    "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 "
    "3\n";

/// The tetrahedron as an STL, whose corners stand once per triangle.
std::string stl(bool binary) {
  const double v[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const int f[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  std::string text = binary ? std::string(80, ' ') : "solid t\n";
  const auto put = [&](const void* p, std::size_t n) { text.append(static_cast<const char*>(p), n); };
  const std::uint32_t count = 4;
  const std::uint16_t zero = 0;
  if (binary) put(&count, 4);
  for (const auto& t : f) {
    const float normal[3] = {0, 0, 0};
    if (binary)
      put(normal, 12);
    else
      text += " facet normal 0 0 0\n  outer loop\n";
    for (const int k : t) {
      const float x[3] = {static_cast<float>(v[k][0]), static_cast<float>(v[k][1]), static_cast<float>(v[k][2])};
      if (binary)
        put(x, 12);
      else
        text += "   vertex " + std::to_string(x[0]) + " " + std::to_string(x[1]) + " " + std::to_string(x[2]) + "\n";
    }
    if (binary)
      put(&zero, 2);
    else
      text += "  endloop\n endfacet\n";
  }
  return binary ? text : text + "endsolid t\n";
}

double volume(const TriangleMesh& m) {
  double v = 0;
  for (const auto& t : m.triangles) v += dot(m.vertices[t[0]], cross(m.vertices[t[1]], m.vertices[t[2]])) / 6;
  return v;
}

TEST(Mesh, EveryFormatGivesTheSameWeldedSolid) {
  const Folder folder;
  const std::pair<const char*, std::string> files[] = {
      {"a.obj", tetrahedron}, {"a.ply", ply}, {"a.stl", stl(false)}, {"b.stl", stl(true)}};
  for (const auto& [name, text] : files) {
    const TriangleMesh m = loadMesh(folder.write(name, text), 0.5);
    EXPECT_EQ(m.vertices.size(), 4u) << name;
    EXPECT_EQ(m.triangles.size(), 4u) << name;
    EXPECT_NEAR(volume(m), 0.125 / 6, 1e-9) << name;
  }
}

TEST(Mesh, ClosedSurfaceTurnedInsideOutIsTurnedBack) {
  const Folder folder;
  const std::string inside = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n";
  EXPECT_NEAR(volume(loadMesh(folder.write("a.obj", inside))), 1.0 / 6, 1e-9);
}

TEST(Mesh, QuadsAreSplitAndTrianglesWithoutAreaDropped) {
  const Folder folder;
  const TriangleMesh m =
      loadMesh(folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nf 1 2 3 4\nf 1 2 5\nf 1 1 2\n"));
  EXPECT_EQ(m.triangles.size(), 2u);
  EXPECT_EQ(m.vertices.size(), 4u);
}

TEST(Mesh, RefusesWhatIsMalformed) {
  const Folder folder;
  const auto refused = [&](const char* name, const std::string& text, const char* words) {
    expectRefused([](const auto& f) { loadMesh(f); }, folder.write(name, text), 0, words);
  };
  // empty, unknown, unreadable
  refused("a.obj", "", "empty");
  refused("a.obj", "# nothing\n", "");
  refused("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "");
  refused("a.stl", "solid nothing\nendsolid nothing\n", "");
  refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "meshes are read from");
  refused("a.xyz", tetrahedron, "meshes are read from");
  refused("a", tetrahedron, "meshes are read from");
  expectRefused([](const auto& f) { loadMesh(f); }, folder.path / "none.obj", 0, "no such file");
  std::filesystem::create_directory(folder.path / "folder.obj");
  expectRefused([](const auto& f) { loadMesh(f); }, folder.path / "folder.obj", 0, "folder");
  // syntax
  refused("a.ply", "plx\n", "");
  refused("a.ply", replaced(ply, "end_header\n", ""), "");
  refused("a.gltf", "{ \"asset\": ", "");
  refused("a.glb", "glTF but not really, twenty bytes", "");
  refused("a.obj", std::string(1000, '\xff'), "");
  // missing and out of range
  refused("a.obj", replaced(tetrahedron, "f 2 3 4", "f 2 3 9"), "");
  refused("a.obj", replaced(tetrahedron, "f 2 3 4", "f 2 3 -9"), "");
  refused("a.ply", replaced(ply, "3 1 2 3", "3 1 2 77"), "");
  refused("a.ply", replaced(ply, "3 1 2 3", "3 1 2 -1"), "");
  refused("a.ply", replaced(ply, "3 1 2 3", "0"), "has no corner");
  // NaN
  refused("a.obj", replaced(tetrahedron, "v 1 0 0", "v nan 0 0"), "");
  refused("a.obj", replaced(tetrahedron, "v 1 0 0", "v inf 0 0"), "");
  std::string nan = stl(true);
  const float bad = std::nanf("");
  std::memcpy(nan.data() + 84 + 12, &bad, 4);
  refused("a.stl", nan, "");
  refused("a.ply", replaced(ply, "1 0 0", "nan 0 0"), "");
  // truncated
  refused("a.stl", stl(true).substr(0, 200), "");
  refused("a.ply", ply.substr(0, 120), "");
  refused("a.ply", ply.substr(0, ply.size() - 30), "");
  refused("a.stl", stl(true).substr(0, 82), "");
  // enormous
  refused("a.obj", replaced(tetrahedron, "v 1 0 0", "v 1e20 0 0"), "not within");
  refused("a.ply", replaced(ply, "element vertex 4", "element vertex 4000000000"), "announces");
  refused("a.ply", replaced(ply, "element face 4", "element face 1e15"), "announces");
  std::string many = stl(true);
  const std::uint32_t count = 4000000000u;
  std::memcpy(many.data() + 80, &count, 4);
  refused("a.stl", many, "");
  // scale
  for (const double s : {0.0, -1.0, std::nan(""), double{INFINITY}})
    EXPECT_THROW(loadMesh(folder.write("a.obj", tetrahedron), s), InputError);
}

/// A glTF whose one triangle lies in `buffer`; `more` stands before its end.
std::string gltf(const std::string& buffer, const std::string& nodes, const std::string& more = "") {
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [)" + nodes +
         R"(], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"uri": ")" +
         buffer + R"(", "byteLength": 36}])" + more + "}";
}
const std::string node = R"({"mesh": 0})";

/// A binary glTF of one chunk.
std::string glb(const std::string& json) {
  std::string text = "glTF";
  const std::string padded = json + std::string((4 - json.size() % 4) % 4, ' ');
  for (const std::size_t n : {std::size_t{2}, padded.size() + 20, padded.size(), std::size_t{0x4E4F534A}}) {
    const auto word = static_cast<std::uint32_t>(n);
    text.append(reinterpret_cast<const char*>(&word), 4);
  }
  return text + padded;
}

TEST(Mesh, TrianglesOfGltfAreInBuffersBesideIt) {
  const Folder folder;
  const float x[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  folder.write("a.bin", std::string(reinterpret_cast<const char*>(x), sizeof x));
  EXPECT_EQ(loadMesh(folder.write("a.gltf", gltf("a.bin", node))).triangles.size(), 1u);
}

/// The parser and the walk over nodes call themselves for each level: 200,000 of them ended the program.
TEST(Mesh, DeepGltfIsRefused) {
  const Folder folder;
  const auto refused = [](const std::filesystem::path& file, const char* words) {
    expectRefused([](const auto& f) { loadMesh(f); }, file, 0, words);
  };
  const int deep = 200000;
  const std::string nested = R"(, "extras": )" + std::string(deep, '[') + std::string(deep, ']');
  const float x[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  folder.write("a.bin", std::string(reinterpret_cast<const char*>(x), sizeof x));
  refused(folder.write("a.gltf", gltf("a.bin", node, nested)), "nested deeper than 64 levels");
  refused(folder.write("a.glb", glb(gltf("a.bin", node, nested))), "nested deeper than 64 levels");
  std::string chain;
  for (int k = 1; k < deep; ++k) chain += "{\"children\": [" + std::to_string(k) + "]},";
  refused(folder.write("a.gltf", gltf("a.bin", chain + node)), "cannot be read");
}

/// A FIFO as a buffer waited for its other end for ever.
TEST(Mesh, OnlyRegularFilesOfASizeAreRead) {
  const Folder folder;
  const auto refused = [&](const std::string& buffer, const char* named, const char* words) {
    try {
      loadMesh(folder.write("a.gltf", gltf(buffer, node)));
      ADD_FAILURE() << buffer;
    } catch (const InputError& e) {
      EXPECT_NE(e.where().file.find(named), std::string::npos) << e.what();
      EXPECT_NE(e.reason().find(words), std::string::npos) << e.what();
    }
  };
  ASSERT_EQ(mkfifo((folder.path / "pipe.bin").c_str(), 0600), 0);
  refused("pipe.bin", "pipe.bin", "not a regular file");
  const auto sparse = [&](const char* name) {
    const std::filesystem::path file = folder.write(name, "x");
    std::filesystem::resize_file(file, std::uintmax_t{1} << 30);
    return file;
  };
  sparse("sparse.bin");
  refused("sparse.bin", "sparse.bin", "at most 268435456 are read");
  for (const char* name : {"sparse.obj", "sparse.stl", "sparse.ply", "sparse.gltf", "sparse.glb"})
    expectRefused([](const auto& f) { loadMesh(f); }, sparse(name), 0, "at most 268435456 are read");
}

/// Counts that only a header claims.
TEST(Mesh, AnEnormousAccessorIsRefused) {
  const Folder folder;
  const std::string huge =
      replaced(replaced(gltf("a.bin", node), "\"bufferView\": 0, ", ""), "\"count\": 3", "\"count\": 400000000");
  expectRefused([](const auto& f) { loadMesh(f); }, folder.write("a.gltf", huge), 0, "");
}

TEST(Mesh, AnObjThatNamesAVertexThatIsNotThereSaysItsLine) {
  const Folder folder;
  expectRefused([](const auto& f) { loadMesh(f); },
                folder.write("out.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\n"), 5,
                "names vertex '4' of the 3 before it");
}

TEST(Mesh, AnObjWithoutASurfaceIsToldInWords) {
  const Folder folder;
  expectRefused([](const auto& f) { loadMesh(f); }, folder.write("points.obj", "v 0 0 0\nv 1 0 0\n"), 0, "no surface");
}

}  // namespace
}  // namespace gambeson
