/// Detail of kind.hpp: an edge on springs to the human.

#include <functional>
#include <limits>

#include "cases/wear/case/supports/fields_edge.hpp"
#include "cases/wear/case/supports/kind.hpp"
#include "core/contact/triangle.hpp"
#include "core/error.hpp"
#include "human/body/skin.hpp"
#include "human/motion/standing.hpp"

namespace gambeson {
namespace schema {
namespace {

Object springsTable() {
  Table<SpringSupport> table("Springs");
  edgeField(table);
  table
      .number("stiffness", &SpringSupport::stiffness_N_per_m2, "N/m^2", aboveTo(0, 1e8),
              "force per displacement and length of edge")
      .text("link", &SpringSupport::link, "link of the human that the springs are tied to, such as pelvis")
      .required();
  return table.build();
}

}  // namespace
}  // namespace schema

namespace {

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

void holdBySprings(const SupportCase& support, const SupportedCloth& on, ModelOptions& options, SupportGroup& group) {
  const auto& springs = std::get<SpringSupport>(support);
  group.name = on.name + " springs to " + springs.link;
  group.anchor = on.human->skeleton.link(springs.link);
  if (group.anchor < 0) throw InputError({"", 0, "link"}, "the human has no link \"" + springs.link + "\"");
  // Each sample answers for half of the edge to either neighbour.
  std::vector<double> length(on.surface.size(), 0);
  std::vector<Vec3> X(on.surface.size());
  on.surface.W.multiply<Vec3>(on.cloth.rest(), X);
  for (const std::vector<int>& at : on.lines)
    for (std::size_t k = 0; k + 1 < at.size(); ++k) {
      const double half = 0.5 * norm(X[at[k + 1]] - X[at[k]]);
      length[at[k]] += half;
      length[at[k + 1]] += half;
    }
  std::vector<Vec3> skin;
  if (on.human->skin) skin = standingSkin(*on.human);
  for (int s : group.samples) {
    group.springs.push_back(static_cast<int>(options.springs.size()));
    SpringSupportPoint spring{s, group.anchor, springs.stiffness_N_per_m2 * length[s]};
    if (on.human->skin) {
      spring.obstacle = 0;  // the skin, a human's only one
      spring.triangle = nearestTriangle(on.human->skin->rest.triangles, skin, X[s]);
    }
    options.springs.push_back(spring);
  }
}

}  // namespace

extern const SupportKind springs_support;
const SupportKind springs_support{
    .word = "springs",
    .addTo =
        [](schema::Table<SupportCase>& table) {
          table.alternative<SpringSupport>(
              "springs", std::identity{}, schema::springsTable(),
              "an edge tied by elastic springs to a link of the human, so that it hangs where it "
              "was drafted; above a skin they act along it only: contact is what presses; their "
              "reactions are reported apart");
        },
    .link = [](const SupportCase& s) { return &std::get<SpringSupport>(s).link; },
    .hold = holdBySprings,
};

}  // namespace gambeson
