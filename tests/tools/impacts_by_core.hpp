#pragma once
/// What core finds of impacts in a step, with its rows: the truth for the search on a device. And steps that have many.

#include <cmath>

#include "gpu/finding/hash.hpp"
#include "gpu/scenes/random.hpp"
#include "gpu/step/impact_step.hpp"
#include "tools/near_by_core.hpp"

namespace gambeson::gpu {

/// A step whose persistent rows are there, and then its impacts, round by round, as core/motion has them
/// (resolveContacts), without its solves: where samples would end is given.
class CoreImpacts {
 public:
  explicit CoreImpacts(const DressedScene& scene) : step_(scene, {}) {}

  const Model& model() const { return step_.m; }
  const std::vector<Vec3>& x0() const { return step_.w.collisions.x0; }
  const std::vector<char>& exempt() const { return step_.w.inside; }
  ImpactMotion motion() const {
    return {x0(), step_.w.collisions.x1, exempt(), step_.w.stage.start.obstacles, step_.w.stage.end.obstacles};
  }

  /// The cloth would move there.
  void moveTo(std::span<const Vec3> x1) {
    StepWork& w = step_.w;
    w.x1.assign(x1.begin(), x1.end());
    moveVertices(w.x1, w.collisions);
  }
  void find(std::span<const Vec3> x1) {
    StepWork& w = step_.w;
    moveTo(x1);
    step_.m.proximity->impacts(w.stage.start.obstacles, w.stage.end.obstacles, w.x0, w.x1, w.hits);
    w.collisions.report = {};
    findImpacts(step_.m.collisions, step_.dt_s, w.inside, w.collisions, w.pair_hits);
  }
  ImpactCounts counts() const {
    const StepWork& w = step_.w;
    ImpactCounts counts;
    counts.samples = w.hits.size();
    for (const PairHit& hit : w.pair_hits) ++(hit.edges ? counts.edges : counts.points);
    counts.touching = static_cast<unsigned long long>(w.collisions.report.touching);
    counts.capped = static_cast<unsigned long long>(w.collisions.report.capped);
    return counts;
  }
  /// Without u and v.
  std::vector<StepHit> hits() const {
    std::vector<StepHit> all;
    for (const SampleHit& hit : step_.w.hits) all.push_back({kSampleHit, hit.sample, hit.obstacle, hit.time, 0, 0});
    for (const PairHit& hit : step_.w.pair_hits)
      all.push_back({hit.edges ? kEdgeHit : kPointHit, hit.a, hit.b, hit.time, 0, 0});
    return all;
  }

  ImpactRowTerms terms(int round) const {
    return {step_.dt_s, -std::expm1(-step_.dt_s / step_.m.contact.relaxation_s), round};
  }
  void addRows(int round) { addImpacts(step_.m, {}, step_.dt_s, round, step_.w); }
  /// Some tractions as a solve might leave them, to see which rows keep theirs.
  void bearSome() {
    for (std::size_t k = 0; k < step_.w.warm.size(); ++k)
      step_.w.warm[k] = static_cast<double>(1 + k % 7) * step_.w.rows[k].contact.normal;
  }
  HostRows rows() const {
    const StepWork& w = step_.w;
    NearContacts contacts = contactsOf(step_.m, w.rows);
    HostRows rows{std::move(contacts.facts), std::move(contacts.stencil), std::move(contacts.touch), {}, {}, {}};
    for (const ContactRow& row : w.rows) {
      RowTerms terms;
      terms.target_m_per_s = row.target_m_per_s;
      terms.compliance = row.compliance;
      terms.mean_Pa = row.mean_Pa;
      terms.impact = row.impact;
      // Those of what is near have none on a device.
      for (int k = 0; k < 3 && row.impact; ++k) terms.pair[k] = row.pair[static_cast<std::size_t>(k)];
      rows.terms.push_back(terms);
    }
    rows.traction = w.warm;
    rows.impulse.resize(w.rows.size());
    return rows;
  }

 private:
  CoreStep step_;
};

/// Of rows in their order, all numbers but impulses.
inline std::uint64_t hashOf(const HostRows& rows) {
  std::uint64_t hash = hashOf(NearContacts{rows.facts, rows.stencil, rows.touch});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::uint64_t one = mixed(i);
    const auto number = [&](double x) { one = mixed(one ^ std::bit_cast<std::uint64_t>(x)); };
    const RowTerms& t = rows.terms[i];
    for (const double x : {t.target_m_per_s, t.compliance, t.mean_Pa, static_cast<double>(t.impact)}) number(x);
    for (const int p : t.pair) number(p);
    for (int k = 0; k < 3; ++k) number(rows.traction[i][k]);
    hash += one;
  }
  return hash;
}
inline bool sameRow(const HostRows& a, const HostRows& b, std::size_t i) {
  const auto one = [i](const HostRows& r) {
    return hashOf(HostRows{{r.facts[i]}, {r.stencil[i]}, {r.touch[i]}, {r.terms[i]}, {r.traction[i]}, {}});
  };
  return one(a) == one(b);
}

/// Where samples would end in each round of a step in which cloth moves by `way_m` at random and some of it by `shift`:
/// rounds ask for some of the pairs of those before, and for others.
inline std::vector<std::vector<Vec3>> hurriedEnds(const DressedScene& scene, double way_m, const Vec3& shift,
                                                  int rounds) {
  Random random(31);
  std::vector<Vec3> way;
  for (std::size_t s = 0; s < scene.x0.size(); ++s)
    way.push_back(way_m * random.evenVec() + (s % 97 < 60 ? shift : Vec3{}));
  std::vector<std::vector<Vec3>> ends;
  for (int round = 0; round < rounds; ++round) {
    ends.emplace_back();
    for (std::size_t s = 0; s < way.size(); ++s)
      ends.back().push_back(scene.x0[s] + (1 - 0.15 * round) * way[s] + 0.2 * way_m * random.evenVec());
  }
  return ends;
}

/// Samples of the second half put beside triangles of the first, from as near as on them to what is no longer near.
inline void bringTogether(DressedScene& scene) {
  const auto& mesh = scene.collisions.mesh;
  const double apart_m[] = {0, 3e-10, 1e-8, 2e-7, 9e-7, 1.2e-6, 4e-6, 9e-6, 1.1e-5, 5e-5};
  const std::size_t n = scene.x0.size() / 2;
  for (std::size_t k = 0; k < 120; ++k) {
    const auto& [a, b, c] = mesh.triangles[3 * k + 40];
    const Vec3 normal =
        normalized(cross(scene.x0[static_cast<std::size_t>(b)] - scene.x0[static_cast<std::size_t>(a)],
                         scene.x0[static_cast<std::size_t>(c)] - scene.x0[static_cast<std::size_t>(a)]));
    const double share = k % 3 == 0 ? 0.0 : 0.3;  // at a corner, or within
    Vec3& x = scene.x0[n + 2 * k];
    x = scene.x0[static_cast<std::size_t>(a)] +
        share * (scene.x0[static_cast<std::size_t>(b)] - scene.x0[static_cast<std::size_t>(a)]) +
        share * (scene.x0[static_cast<std::size_t>(c)] - scene.x0[static_cast<std::size_t>(a)]) +
        apart_m[k % 10] * normal;
  }
}

/// Two sheets between ellipsoids and balls, rigid and soft, that move and turn: hits of all sorts in one step.
inline std::unique_ptr<DressedScene> sheetsAmongAll(int n) {
  Random random(32);
  const double cell_m = 6e-3;
  std::vector<SheetPart> sheets(2);
  for (int p = 0; p < 2; ++p) {
    SheetPart& part = sheets[static_cast<std::size_t>(p)];
    part.nu = part.nv = n, part.garment = p, part.thickness_m = 1.2e-3 + 4e-4 * p;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        part.rest.push_back({cell_m * (i - 0.5 * n), cell_m * (j - 0.5 * n), 0});
        part.x0.push_back(part.rest.back() + Vec3{0, 0, 1.9e-3 * p} + 2e-4 * random.evenVec());
        part.x1.push_back(part.x0.back() + 1e-4 * random.evenVec());
      }
  }
  const TriangleMesh ball = std::get<TriangleMesh>(sheetOnSolids(4, false)->obstacles[1].shape);
  TriangleMesh soft = ball;
  for (Vec3& x : soft.vertices) x += Vec3{0.03, 0.03, -0.0308};
  std::vector<Obstacle> obstacles{{Ellipsoid{{0.05, 0.04, 0.02}}, "ellipsoid"},
                                  {ball, "ball"},
                                  {Ellipsoid{{0.03, 0.03, 0.03}}, "sphere"},
                                  {soft, "soft ball", true}};
  std::vector<Placement> at(4);
  at[0] = {rotationAbout({0, 0, 1}, 0.4), {-0.03, 0.02, -0.0212}, 1};
  at[1] = {rotationAbout({0, 1, 0}, 0.3), {0.03, -0.03, -0.0302}, 0.98};
  at[2] = {rotationAbout({1, 0, 0}, 0.2), {0.0, -0.01, 0.0351}, 1.05};
  auto scene = dressed("two sheets among ellipsoids and balls", sheets, obstacles, at);
  for (std::size_t o = 0; o < 3; ++o)
    scene->end[o] = {rotationAbout({0, 0, 1}, 2e-3) * at[o].rotation, at[o].origin + 2e-4 * random.evenVec(),
                     at[o].scale};
  for (Vec3& x : scene->end_vertices[3]) x += 1e-4 * random.evenVec();
  return scene;
}

constexpr int kHurriedRounds = 4;

/// A step in which much meets.
struct Hurried {
  std::unique_ptr<DressedScene> scene;
  std::vector<std::vector<Vec3>> ends;  ///< of each round
};

/// Cloth on itself, on ellipsoids, on solids that are rigid or not, on skin.
inline std::vector<Hurried> hurriedSteps() {
  std::vector<Hurried> all;
  const auto add = [&](std::unique_ptr<DressedScene> scene, double way_m, const Vec3& shift) {
    auto ends = hurriedEnds(*scene, way_m, shift, kHurriedRounds);
    all.push_back({std::move(scene), std::move(ends)});
  };
  add(foldedSheet(24, 6e-3), 2e-3, {});
  add(foldedSheet(24, 1.3e-3), 1e-3, {});
  add(twoLayers(24), 1e-3, {0, 0, 2e-3});
  auto together = twoLayers(24);
  bringTogether(*together);
  add(std::move(together), 5e-4, {});
  add(sheetOnEllipsoids(24), 1.5e-3, {0, 0, -3e-3});
  add(sheetOnSolids(24, false), 1e-3, {0, 0, -1e-3});
  add(sheetOnSolids(24, true), 1e-3, {0, 0, -1e-3});
  add(sheetOnSkin(24), 1.5e-3, {});
  add(sheetsAmongAll(24), 1.5e-3, {0, 0, -2e-3});
  return all;
}

}  // namespace gambeson::gpu
