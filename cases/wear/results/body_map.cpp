#include "cases/wear/results/body_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "cases/wear/results/measure.hpp"
#include "cases/wear/scene/placed_bodies.hpp"
#include "core/error.hpp"
#include "human/body/body_zones.hpp"

namespace gambeson {
namespace {

constexpr std::size_t kMostTriangles = 100000;  ///< of a body: what a picture can use

TriangleMesh ellipsoidMesh(const Vec3& a, double cell_m) {
  constexpr double most_rings = 158;  // 4 rings (rings - 1) triangles
  const double widest = std::max({a.x, a.y, a.z});
  const int rings = static_cast<int>(std::clamp(std::ceil(M_PI * widest / cell_m), 6.0, most_rings));
  const int around = 2 * rings;
  TriangleMesh mesh;
  mesh.vertices.push_back({0, 0, a.z});
  for (int r = 1; r < rings; ++r)
    for (int k = 0; k < around; ++k) {
      const double theta = M_PI * r / rings, phi = 2 * M_PI * k / around;
      mesh.vertices.push_back(
          {a.x * std::sin(theta) * std::cos(phi), a.y * std::sin(theta) * std::sin(phi), a.z * std::cos(theta)});
    }
  mesh.vertices.push_back({0, 0, -a.z});
  const int last = static_cast<int>(mesh.vertices.size()) - 1;
  const auto id = [&](int r, int k) { return 1 + (r - 1) * around + k % around; };
  for (int k = 0; k < around; ++k) {
    mesh.triangles.push_back({0, id(1, k), id(1, k + 1)});
    for (int r = 1; r + 1 < rings; ++r) {
      mesh.triangles.push_back({id(r, k), id(r + 1, k), id(r + 1, k + 1)});
      mesh.triangles.push_back({id(r, k), id(r + 1, k + 1), id(r, k + 1)});
    }
    mesh.triangles.push_back({id(rings - 1, k), last, id(rings - 1, k + 1)});
  }
  return mesh;
}

/// Each triangle in four until no edge is longer than the cell.
TriangleMesh refined(TriangleMesh mesh, double cell_m) {
  const auto longest = [&] {
    double l = 0;
    for (const auto& t : mesh.triangles)
      for (std::size_t k = 0; k < 3; ++k)
        l = std::max(l, norm(mesh.vertices[static_cast<std::size_t>(t[k])] -
                             mesh.vertices[static_cast<std::size_t>(t[(k + 1) % 3])]));
    return l;
  };
  while (longest() > cell_m && 4 * mesh.triangles.size() <= kMostTriangles) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [at, fresh] = middles.try_emplace(std::minmax(a, b), static_cast<int>(mesh.vertices.size()));
      if (fresh)
        mesh.vertices.push_back(
            0.5 * (mesh.vertices[static_cast<std::size_t>(a)] + mesh.vertices[static_cast<std::size_t>(b)]));
      return at->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
  }
  return mesh;
}

using Cube = std::array<int, 3>;
Cube cubeOf(const Vec3& p, double size) {
  const auto c = [&](double v) { return static_cast<int>(std::floor(v / size)); };
  return {c(p.x), c(p.y), c(p.z)};
}

/// A third of each triangle's area to each of its corners.
std::vector<double> areasOf(const TriangleMesh& mesh, std::span<const Vec3> x) {
  std::vector<double> area(x.size(), 0);
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3& o = x[static_cast<std::size_t>(a)];
    const double third = norm(cross(x[static_cast<std::size_t>(b)] - o, x[static_cast<std::size_t>(c)] - o)) / 6;
    for (const int v : {a, b, c}) area[static_cast<std::size_t>(v)] += third;
  }
  return area;
}

}  // namespace

BodyMap::BodyMap(const Scenario& s, double sensor_m) : scenario_(s) {
  const int links = static_cast<int>(s.human->skeleton.links.size());
  const BodyZones zones(*s.human);
  for (std::size_t o = 0; o < s.model->obstacles.size(); ++o) {
    const int body = s.body_of_obstacle[o];
    if (body >= links) continue;
    Part part{static_cast<int>(o), static_cast<int>(zone_.size()), {}, {}};
    if (body < 0) {
      part.mesh = s.human->skin->rest;
      zone_ = zones.ofSkin(*s.human->skin);
    } else {
      const Shape& shape = s.model->obstacles[o].shape;
      const auto* e = std::get_if<Ellipsoid>(&shape);
      part.mesh = e ? ellipsoidMesh(e->semi_axes, kCell_m) : refined(std::get<TriangleMesh>(shape), kCell_m);
      part.surface.emplace(part.mesh);
      // Shapes of a human stand in the order of its obstacles (obstaclesOf).
      const Pose& X_LS = s.human->shapes[o].X_LS;
      for (const Vec3& p : part.mesh.vertices) zone_.push_back(zones.of(body, X_LS * p));
    }
    const std::vector<double> area = areasOf(part.mesh, part.mesh.vertices);
    area_.insert(area_.end(), area.begin(), area.end());
    parts_.push_back(std::move(part));
  }
  // Neighbours, by a grid of cells of half the sensor.
  const double reach = 0.5 * sensor_m;
  first_ = {0};
  for (const Part& part : parts_) {
    const std::vector<Vec3>& x = part.mesh.vertices;
    std::vector<Vec3> normal(x.size());
    for (const auto& [a, b, c] : part.mesh.triangles) {
      const Vec3& o = x[static_cast<std::size_t>(a)];
      const Vec3 n = cross(x[static_cast<std::size_t>(b)] - o, x[static_cast<std::size_t>(c)] - o);
      for (const int v : {a, b, c}) normal[static_cast<std::size_t>(v)] += n;
    }
    std::map<Cube, std::vector<int>> grid;
    for (std::size_t v = 0; v < x.size(); ++v) grid[cubeOf(x[v], reach)].push_back(static_cast<int>(v));
    for (std::size_t v = 0; v < x.size(); ++v) {
      const Cube c = cubeOf(x[v], reach);
      for (int i = -1; i <= 1; ++i)
        for (int j = -1; j <= 1; ++j)
          for (int k = -1; k <= 1; ++k) {
            const auto at = grid.find({c[0] + i, c[1] + j, c[2] + k});
            if (at == grid.end()) continue;
            for (const int w : at->second)
              if (norm(x[static_cast<std::size_t>(w)] - x[v]) <= reach &&
                  (w == static_cast<int>(v) || dot(normal[static_cast<std::size_t>(w)], normal[v]) > 0))
                near_.push_back(part.first + w);
          }
      first_.push_back(static_cast<int>(near_.size()));
    }
  }
}

std::vector<double> BodyMap::pressure(const Frame& frame) const {
  std::vector<double> force(size(), 0), area = area_;
  if (scenario_.hasSkin()) {
    const Field *position = nullptr, *given = nullptr;
    for (const Field& f : frame.body_fields) {
      if (f.name == "position") position = &f;
      if (f.name == "pressure") given = &f;
    }
    if (!position || !given || given->data.size() != size())
      throw RunError("the recording's frames do not hold the pressure on the skin");
    std::vector<Vec3> x;
    for (std::size_t v = 0; v < size(); ++v)
      x.push_back({position->data[3 * v], position->data[3 * v + 1], position->data[3 * v + 2]});
    area = areasOf(parts_[0].mesh, x);
    for (std::size_t v = 0; v < size(); ++v) force[v] = given->data[v] * area[v];
  } else {
    const Field& given = fieldOf(frame, "pressure");
    const std::vector<double> sample_area = sampleAreas(scenario_, frame);
    const Model& m = *scenario_.model;
    const std::vector<Placement> at = scenario_.obstaclePlacements(frame.time_s);
    for (std::size_t i = 0; i < given.data.size(); ++i) {
      if (!(given.data[i] > 0)) continue;
      const Vec3 x{frame.positions[3 * i], frame.positions[3 * i + 1], frame.positions[3 * i + 2]};
      int body = -1;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t o = 0; o < m.obstacles.size(); ++o)
        if (const double d = m.proximity->signedDistance(static_cast<int>(o), at[o], x); d < least)
          least = d, body = static_cast<int>(o);
      for (const Part& part : parts_)
        if (part.obstacle == body) {
          const Placement& X = at[static_cast<std::size_t>(body)];
          const Vec3 local = transpose(X.rotation) * (x - X.origin) / X.scale;
          const auto foot = part.surface->nearest(local, std::numeric_limits<double>::infinity());
          const MaterialPoint at_foot = part.surface->material(foot.value());
          for (std::size_t k = 0; k < 3; ++k)
            if (at_foot.vertex[k] >= 0)
              force[static_cast<std::size_t>(part.first + at_foot.vertex[k])] +=
                  at_foot.weight[k] * given.data[i] * sample_area[i];
        }
    }
  }
  std::vector<double> pressure(size(), 0);
  for (std::size_t v = 0; v < size(); ++v) {
    double F = 0, A = 0;
    for (int k = first_[v]; k < first_[v + 1]; ++k) {
      const auto w = static_cast<std::size_t>(near_[static_cast<std::size_t>(k)]);
      F += force[w], A += area[w];
    }
    pressure[v] = A > 0 ? F / A : 0;
  }
  return pressure;
}

std::vector<BodyMap::Surface> BodyMap::surfaces() const {
  std::vector<Surface> out;
  for (const Part& part : parts_) out.push_back({part.obstacle, part.first, &part.mesh});
  return out;
}

std::vector<TriangleMesh> BodyMap::meshes(double time_s) const {
  PlacedBodies placed(scenario_);
  placed.moveTo(time_s);
  std::vector<TriangleMesh> out;
  for (const Part& part : parts_) {
    if (scenario_.model->obstacles[static_cast<std::size_t>(part.obstacle)].deforms) {
      out.push_back(placed.deformedMesh(part.obstacle));
      continue;
    }
    TriangleMesh mesh = part.mesh;
    for (Vec3& p : mesh.vertices) p = placed.placements()[static_cast<std::size_t>(part.obstacle)] * p;
    out.push_back(std::move(mesh));
  }
  return out;
}

BodyLoads bodyLoads(const BodyMap& map, const RecordingReader& recording, double from_s) {
  BodyLoads loads{std::vector<double>(map.size(), 0),
                  std::vector<double>(map.size(), 0),
                  std::vector<double>(map.size(), 0),
                  {},
                  {},
                  {}};
  const std::size_t zones =
      map.size() == 0 ? 0 : 1 + static_cast<std::size_t>(*std::max_element(map.zone().begin(), map.zone().end()));
  for (int k = 0; k < recording.frameCount(); ++k) {
    const double t = recording.time(k);
    if (!(t > 1e-9) || t < from_s - 1e-9) continue;
    const std::vector<double> p = map.pressure(recording.frame(k));
    loads.time_s.push_back(t);
    const double counted = static_cast<double>(loads.time_s.size());
    std::vector<double>& largest = loads.largest_Pa.emplace_back(zones, 0.0);
    std::vector<double>& mean = loads.mean_so_far_Pa.emplace_back(zones, 0.0);
    for (std::size_t v = 0; v < p.size(); ++v) {
      const auto z = static_cast<std::size_t>(map.zone()[v]);
      loads.mean_Pa[v] += p[v];  // the sum, until all are in
      if (p[v] > loads.peak_Pa[v]) loads.peak_Pa[v] = p[v], loads.peak_time_s[v] = t;
      largest[z] = std::max(largest[z], p[v]);
      mean[z] = std::max(mean[z], loads.mean_Pa[v] / counted);
    }
  }
  for (double& p : loads.mean_Pa) p /= std::max<double>(1, static_cast<double>(loads.time_s.size()));
  return loads;
}

}  // namespace gambeson
