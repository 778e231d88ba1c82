#pragma once
/// A recorded mesh of a walk in armour, with the bodies' skin, as a scene for the search for what is near.

#include <filesystem>
#include <fstream>
#include <map>

#include "core/error.hpp"
#include "gpu/scenes/dressed.hpp"

namespace gambeson::gpu {

/// The file has numbers of vertices, faces and edges, positions at the start and the end of a step, and the faces, of
/// which the first `cloth_triangles` are cloth, over the first vertices. It does not tell of rest: cloth three times as
/// large is taken for it, so that what has come near is no neighbour, and pieces without a common triangle for
/// garments.
inline std::unique_ptr<DressedScene> armourScene(const std::filesystem::path& path, int samples, int cloth_triangles,
                                                 double thickness_m) {
  std::ifstream file(path, std::ios::binary);
  std::array<int, 3> count{};
  const auto read = [&](auto* to, std::size_t n) {
    file.read(reinterpret_cast<char*>(to), static_cast<std::streamsize>(n * sizeof *to));
  };
  read(count.data(), 3);
  if (!file || count[0] < samples || count[1] < cloth_triangles)
    throw InputError({path.string(), 0, ""}, "is no recorded mesh of that size");
  const auto vertices = static_cast<std::size_t>(count[0]);
  std::vector<Vec3> x0(vertices), x1(vertices);
  std::vector<std::array<int, 3>> faces(static_cast<std::size_t>(count[1]));
  read(x0.data(), vertices);
  read(x1.data(), vertices);
  read(faces.data(), faces.size());
  if (!file) throw InputError({path.string(), 0, ""}, "ends before its faces do");

  auto scene = std::make_unique<DressedScene>();
  scene->name = "armour";
  const auto cut = x0.begin() + samples;
  scene->x0.assign(x0.begin(), cut);
  scene->x1.assign(x1.begin(), x1.begin() + samples);
  Surface s;
  s.triangles.assign(faces.begin(), faces.begin() + cloth_triangles);
  s.triangle_patch.assign(s.triangles.size(), 0);
  for (int t = 0; t < cloth_triangles; ++t) s.triangle_cell.push_back(t);
  s.patch_grid.resize(1);
  s.patch_grid_size.resize(1);
  s.area_m2.assign(static_cast<std::size_t>(samples), 1);

  TriangleMesh skin;
  skin.vertices.assign(cut, x0.end());
  for (std::size_t t = static_cast<std::size_t>(cloth_triangles); t < faces.size(); ++t)
    skin.triangles.push_back({faces[t][0] - samples, faces[t][1] - samples, faces[t][2] - samples});
  scene->obstacles = {{skin, "skin", true}};
  scene->start.resize(1);
  scene->end.resize(1);
  scene->start_vertices = DeformedVertices(skin.vertices);
  scene->end_vertices = DeformedVertices(std::vector<Vec3>(x1.begin() + samples, x1.end()));

  std::vector<int> garment(static_cast<std::size_t>(samples));
  for (int i = 0; i < samples; ++i) garment[static_cast<std::size_t>(i)] = i;
  const auto root = [&](int i) {
    while (garment[static_cast<std::size_t>(i)] != i) i = garment[static_cast<std::size_t>(i)];
    return i;
  };
  for (const auto& [a, b, c] : s.triangles)
    for (const int other : {b, c}) {
      const int r = root(a), q = root(other);
      garment[static_cast<std::size_t>(std::max(r, q))] = std::min(r, q);
    }
  for (int i = 0; i < samples; ++i) garment[static_cast<std::size_t>(i)] = root(i);

  // Across each edge of two triangles: flat cloth stands out nowhere.
  std::map<std::pair<int, int>, std::vector<int>> opposite;
  for (const auto& t : s.triangles)
    for (std::size_t k = 0; k < 3; ++k) opposite[std::minmax(t[k], t[(k + 1) % 3])].push_back(t[(k + 2) % 3]);
  std::vector<std::vector<int>> of(static_cast<std::size_t>(samples));
  for (const auto& [edge, corners] : opposite) {
    if (corners.size() != 2) continue;
    for (const int end : {edge.first, edge.second}) {
      of[static_cast<std::size_t>(end)].push_back(static_cast<int>(scene->bulges.ends.size()));
      scene->bulges.middle.add(end, 0.125);
    }
    for (const int corner : corners) scene->bulges.middle.add(corner, -0.125);
    scene->bulges.middle.endRow();
    scene->bulges.ends.push_back({edge.first, edge.second});
  }
  for (const auto& rows : of) {
    for (const int row : rows) scene->bulges.of_sample.add(row, 1);
    scene->bulges.of_sample.endRow();
  }
  std::vector<Vec3> rest = scene->x0;
  for (Vec3& x : rest) x *= 3;
  scene->collisions = buildCollisions(s, rest, garment, std::vector<double>(rest.size(), thickness_m), scene->obstacles,
                                      scene->start, true);
  return scene;
}

}  // namespace gambeson::gpu
