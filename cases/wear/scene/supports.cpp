#include "cases/wear/scene/supports.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cases/input/wrong_entry.hpp"
#include "core/error.hpp"
#include "human/motion/smooth_step.hpp"

namespace gambeson {
namespace {

constexpr const char* kSides[] = {"u0", "u1", "v0", "v1"};

NamedEdge edgeOf(const std::vector<NamedEdge>& known, const EdgeCase& e) {
  if (e.name.empty()) return {"", {{e.patch, e.side, false}}};
  for (const NamedEdge& edge : known)
    if (edge.name == e.name) return edge;
  throw InputError({"", 0, "edge"}, "the garment has no edge \"" + e.name + "\"");
}

}  // namespace

void addSupports(const Case& c, const Cloth& cloth, const std::vector<int>& first,
                 const std::vector<std::vector<NamedEdge>>& known, const Surface& surface, const Human* human,
                 ModelOptions& options, std::vector<SupportGroup>& groups, std::vector<Drive>& drives) {
  const auto add = [&](const SupportCase& support) {
    const SupportKind& kind = kindOf(support);
    SupportGroup group;
    const EdgeCase& edge = edgeOf(support);
    std::size_t worn = 0;
    if (!edge.garment.empty())
      while (c.garments[worn].name != edge.garment) ++worn;
    const std::string of = c.garments.size() == 1 ? "" : edge.garment + " ";
    const std::string name =
        of + (edge.name.empty() ? fmt::format("edge {} of patch {}", kSides[static_cast<int>(edge.side)], edge.patch)
                                : edge.name);
    SupportedCloth on{cloth, surface, human, kind.on_edge ? name : of, first[worn]};
    if (kind.on_edge) on.edge = edgeOf(known[worn], edge);
    for (PatchEdge& e : on.edge.edges) {
      if (e.patch >= first[worn + 1] - first[worn])
        throw InputError({"", 0, "edge"}, "patch " + std::to_string(e.patch) + " does not exist; the garment has " +
                                              std::to_string(first[worn + 1] - first[worn]));
      e.patch += first[worn];
      on.lines.push_back(edgeSamples(surface, e));
    }
    if (!on.edge.lines.empty() && c.garments[worn].cloth.kind == ClothKind::triangles)
      throw InputError({"", 0, "edge"},
                       "edges of panels are held where these are NURBS; allowed with it: \"model\": \"nurbs\"");
    for (std::vector<EdgePlace>& line : on.edge.lines) {
      for (EdgePlace& place : line) place.patch += first[worn];
      on.lines.push_back(lineSamples(surface, line));
    }
    for (const std::vector<int>& line : on.lines)
      for (const int s : line)
        if (std::find(group.samples.begin(), group.samples.end(), s) == group.samples.end()) group.samples.push_back(s);
    kind.hold(support, on, options, group);
    options.held_control_points.insert(options.held_control_points.end(), group.control_points.begin(),
                                       group.control_points.end());
    int motion = -1;
    if (const HeldSupport* held = heldOf(support); held && !held->drive.empty()) {
      motion = static_cast<int>(std::find(drives.begin(), drives.end(), held->drive) - drives.begin());
      if (motion == static_cast<int>(drives.size())) drives.push_back(held->drive);
    }
    options.held_motion.resize(options.held_control_points.size(), motion);
    groups.push_back(std::move(group));
  };
  for (std::size_t i = 0; i < c.supports.size(); ++i)
    underKey("supports[" + std::to_string(i) + "]." + kindOf(c.supports[i]).word, [&] { add(c.supports[i]); });
}

void findHeldPoints(const Model& m, std::vector<SupportGroup>& groups) {
  const SparseRows& T = m.cloth->map().T;
  std::vector<int> holders(m.held_points.size(), 0);
  for (SupportGroup& group : groups) {
    group.held.clear();
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

std::vector<std::size_t> lettingGo(const Case& c, double from_s, double to_s) {
  constexpr double kSame_s = 1e-9;  // bounds of windows are rounded
  std::vector<std::size_t> of;
  for (std::size_t i = 0; i < c.supports.size(); ++i)
    if (const HeldSupport* held = heldOf(c.supports[i]); held && held->release_s)
      if (const double t = *held->release_s - kSame_s; t > from_s && t <= to_s) of.push_back(i);
  return of;
}

void letGo(std::span<const std::size_t> supports, Model& m, std::vector<SupportGroup>& groups) {
  for (const std::size_t i : supports) groups[i].control_points.clear();
  std::vector<int> still;
  for (const SupportGroup& group : groups)
    still.insert(still.end(), group.control_points.begin(), group.control_points.end());
  holdOnly(still, m);
  findHeldPoints(m, groups);
}

bool drawCords(const Case& c, double time_s, const std::vector<SupportGroup>& groups, Model& m) {
  bool changed = false;
  for (std::size_t i = 0; i < c.supports.size(); ++i) {
    const auto* cord = std::get_if<CordSupport>(&c.supports[i]);
    if (!cord) continue;
    const double drawn = cord->from_s ? smootherStep((time_s - *cord->from_s) / cord->draw_s) : 1;
    for (const auto& [k, stiffness] : groups[i].cord) {
      double& now = m.stitches[static_cast<std::size_t>(k)].stiffness_N_per_m;
      changed = changed || now != drawn * stiffness;
      now = drawn * stiffness;
    }
  }
  return changed;
}

}  // namespace gambeson
