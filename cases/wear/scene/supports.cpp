#include "cases/wear/scene/supports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "cases/input/places.hpp"
#include "core/contact/triangle.hpp"
#include "core/error.hpp"
#include "human/body/skin.hpp"
#include "human/motion/motion.hpp"
#include "human/motion/standing.hpp"

namespace gambeson {
namespace {

constexpr const char* kSides[] = {"u0", "u1", "v0", "v1"};

std::vector<PatchEdge> edgesOf(const std::vector<NamedEdge>& known, const EdgeCase& e) {
  if (e.name.empty()) return {{e.patch, e.side, false}};
  for (const NamedEdge& edge : known)
    if (edge.name == e.name) return edge.edges;
  throw InputError({"", 0, "edge"}, "the garment has no edge \"" + e.name + "\"");
}

std::array<int, 3> nearestTriangle(const std::vector<std::array<int, 3>>& triangles, std::span<const Vec3> x,
                                   const Vec3& p) {
  double best2 = std::numeric_limits<double>::infinity();
  std::array<int, 3> best{};
  for (const auto& t : triangles) {
    if (!(norm2(cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]])) > 0)) continue;  // has no normal
    const double dist2 = closestOnTriangle({x[t[0]], x[t[1]], x[t[2]]}, p).dist2_m2;
    if (dist2 < best2) {
      best2 = dist2;
      best = t;
    }
  }
  return best;
}

/// The human's skin as he stands, which garments are drafted for.
std::vector<Vec3> standingSkin(const Human& human) {
  const Posture p = standing(human);
  std::vector<Vec3> x(human.skin->rest.vertices.size());
  skinPositions(*human.skin, linkPoses(human.skeleton, p.q, p.root), x);
  return x;
}

}  // namespace

void addSupports(const Case& c, const Cloth& cloth, const std::vector<int>& first,
                 const std::vector<std::vector<NamedEdge>>& known, const Surface& surface, const Human* human,
                 ModelOptions& options, std::vector<SupportGroup>& groups) {
  const auto add = [&](const SupportCase& support) {
    SupportGroup group;
    const EdgeCase& edge = std::visit([](const auto& s) -> const EdgeCase& { return s.edge; }, support);
    std::size_t worn = 0;
    if (!edge.garment.empty())
      while (c.garments[worn].name != edge.garment) ++worn;
    const std::string of = c.garments.size() == 1 ? "" : edge.garment + " ";
    const std::string name =
        of + (edge.name.empty() ? fmt::format("edge {} of patch {}", kSides[static_cast<int>(edge.side)], edge.patch)
                                : edge.name);
    std::vector<PatchEdge> edges;
    if (!std::holds_alternative<PinnedSupport>(support)) edges = edgesOf(known[worn], edge);
    for (PatchEdge& e : edges) {
      if (e.patch >= first[worn + 1] - first[worn])
        throw InputError({"", 0, "edge"}, "patch " + std::to_string(e.patch) + " does not exist; the garment has " +
                                              std::to_string(first[worn + 1] - first[worn]));
      e.patch += first[worn];
      for (int s : edgeSamples(surface, e))
        if (std::find(group.samples.begin(), group.samples.end(), s) == group.samples.end()) group.samples.push_back(s);
    }
    if (const auto* pinned = std::get_if<PinnedSupport>(&support)) {
      const int p = edge.patch + first[worn];
      const ClothPatch& patch = cloth.patches()[static_cast<std::size_t>(p)];
      const auto at = [](double from, double to, double part) { return from + part * (to - from); };
      const PlaceRow row = cloth.mounting().place(
          p, {at(patch.low.x, patch.high.x, pinned->s), at(patch.low.y, patch.high.y, pinned->t)});
      group.name = of + fmt::format("point ({:.3g}, {:.3g}) held", pinned->s, pinned->t);
      for (std::size_t k = 0; k < row.columns.size(); ++k)
        if (row.value[k] > 1e-12) group.control_points.push_back(row.columns[k]);
    } else if (const auto* fixed = std::get_if<FixedSupport>(&support)) {
      group.name = name + " held";
      for (const PatchEdge& e : edges) {
        const std::vector<int> points = cloth.mounting().edgePoints(e, fixed->rows);
        group.control_points.insert(group.control_points.end(), points.begin(), points.end());
      }
    } else {
      const auto& springs = std::get<SpringSupport>(support);
      group.name = name + " springs to " + springs.link;
      group.anchor = human->skeleton.link(springs.link);
      if (group.anchor < 0) throw InputError({"", 0, "link"}, "the human has no link \"" + springs.link + "\"");
      // Each sample answers for half of the edge to either neighbour.
      std::vector<double> length(surface.size(), 0);
      std::vector<Vec3> X(surface.size());
      surface.W.multiply<Vec3>(cloth.rest(), X);
      for (const PatchEdge& e : edges) {
        const std::vector<int> at = edgeSamples(surface, e);
        for (std::size_t k = 0; k + 1 < at.size(); ++k) {
          const double half = 0.5 * norm(X[at[k + 1]] - X[at[k]]);
          length[at[k]] += half;
          length[at[k + 1]] += half;
        }
      }
      std::vector<Vec3> skin;
      if (human->skin) skin = standingSkin(*human);
      for (int s : group.samples) {
        group.springs.push_back(static_cast<int>(options.springs.size()));
        SpringSupportPoint spring{s, group.anchor, springs.stiffness_N_per_m2 * length[s]};
        if (human->skin) {
          spring.obstacle = 0;  // the skin, a human's only one
          spring.triangle = nearestTriangle(human->skin->rest.triangles, skin, X[s]);
        }
        options.springs.push_back(spring);
      }
    }
    options.held_control_points.insert(options.held_control_points.end(), group.control_points.begin(),
                                       group.control_points.end());
    groups.push_back(std::move(group));
  };
  const char* const kinds[] = {"fixed", "springs", "pinned"};
  for (std::size_t i = 0; i < c.supports.size(); ++i)
    underKey("supports[" + std::to_string(i) + "]." + kinds[c.supports[i].index()], [&] { add(c.supports[i]); });
}

void findHeldPoints(const Model& m, std::vector<SupportGroup>& groups) {
  const SparseRows& T = m.cloth->map().T;
  std::vector<int> holders(m.held_points.size(), 0);
  for (SupportGroup& group : groups) {
    std::vector<int> points;
    for (int c : group.control_points)
      points.insert(points.end(), T.columns.begin() + T.offsets[c], T.columns.begin() + T.offsets[c + 1]);
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    for (int p : points) {
      const auto at = std::lower_bound(m.held_points.begin(), m.held_points.end(), p) - m.held_points.begin();
      ++holders[static_cast<std::size_t>(at)];
      group.held.emplace_back(static_cast<int>(at), 0);
    }
  }
  for (SupportGroup& group : groups)
    for (auto& [point, part] : group.held) part = 1.0 / holders[static_cast<std::size_t>(point)];
}

}  // namespace gambeson
