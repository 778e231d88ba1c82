#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "files.hpp"
#include "human/load.hpp"

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

}  // namespace
}  // namespace gambeson
