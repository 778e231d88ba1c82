#pragma once
/// Cloths of several kinds, and states of them, for the tests of forces.

#include <memory>
#include <random>
#include <string>
#include <vector>

#include "core/cloth/shell/nurbs_shell.hpp"
#include "core/material/hysteresis.hpp"
#include "gpu/forces/forces.hpp"
#include "unit/core/cloth/shell/sheet_cylinder.hpp"
#include "unit/core/nurbs/trim_shapes.hpp"

namespace gambeson::gpu {

struct ForceCloth {
  std::string name;
  std::shared_ptr<const NurbsShell> cloth;
  std::vector<Vec3> p;  ///< free points of a state that is stretched and bent

  std::vector<Vec3> q() const {
    std::vector<Vec3> all(static_cast<std::size_t>(cloth->points()));
    cloth->map().T.multiply<Vec3>(p, all);
    return all;
  }
};

inline ForceCloth forceCloth(const std::string& name, const Garment& garment, double size,
                             const ShellOptions& options = {}) {
  const auto cloth = std::make_shared<const NurbsShell>(garment, options);
  return {name, cloth, shapes::deformedFree(garment, cloth->map(), size)};
}

/// Uneven knots, two of them double; points moved about, so that strains and curvatures of all signs and sizes come up.
inline NurbsPatch unevenPatch(int cells_u, int cells_v, bool rational, bool double_knots = false) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> d(0.7, 1.3);
  const auto knots = [&](int cells) {
    std::vector<double> ends{0};
    for (int i = 0; i < cells; ++i) ends.push_back(ends.back() + d(random) / cells);
    KnotVector k = shapes::knotsAt(2, ends);
    if (double_knots)
      for (const int at : {4, 9}) k.knots.insert(k.knots.begin() + at, k.knots[static_cast<std::size_t>(at)]);
    return k;
  };
  NurbsPatch patch = shapes::patchOf(knots(cells_u), knots(cells_v), [](double a, double b) {
    return Vec3{1.3 * a + 0.05 * b, b - 0.07 * a * b, 0.2 * a * (1 - a) * (1 + 0.4 * b) + 0.1 * b * b};
  });
  if (rational)
    for (double& w : patch.weights) w = d(random);
  return patch;
}

/// A law that remembers; friction is overcome at 2 1/m.
inline BendingLaw rememberingLaw() {
  const Stops<kStops> stops = stopsOf<kStops>(curveOver(0.3, 0.1, 2));
  Recovering<HysteresisBending> law;
  law.weft_Nm = law.warp_Nm = stops.last_Nm;
  law.twist_Nm = 0.5 * stops.last_Nm;
  law.shape = stops.shape;
  law.first_Nm = {stops.first_Nm, stops.first_Nm, 0.5 * stops.first_Nm};
  law.span_per_m = {2, 2, 2};
  law.setting = 0.3;
  law.fatigue = 0.1;
  law.cycle_per_m = 20;
  law.part = 0.5;
  law.time_s = 0.01;
  return law;
}

/// Four patches that meet at a corner, of cells enough that two points see all.
inline Garment seamed(SeamKind kind, const Fabric& fabric) {
  using namespace shapes;
  NurbsPatch whole = curvedPatch(2, 2, true);
  whole = insertKnots(whole, Direction::u, std::vector<double>{0.1, 0.2, 0.4, 0.45, 0.7, 0.8});
  whole = insertKnots(whole, Direction::v, std::vector<double>{0.1, 0.2, 0.6, 0.8});
  const auto [left, right] = cutU(whole, 0.55);
  const auto l = cutV(left, 0.4), r = cutV(right, 0.4);
  return garmentOf({l[0], r[0], l[1], r[1]},
                   {{{0, Side::u1}, {1, Side::u0}, kind, 0.7},
                    {{2, Side::u1}, {3, Side::u0}, kind, 0.7},
                    {{0, Side::v1}, {2, Side::v0}, kind, 0.7},
                    {{1, Side::v1}, {3, Side::v0}, kind, 0.7}},
                   fabric, turnedWeft());
}

/// What the kernels of quadratic cells carry.
inline std::vector<ForceCloth> quadCloths() {
  using namespace shapes;
  std::vector<ForceCloth> all;
  const Fabric linear = plainFabric(Bends::linear), zheng = plainFabric(Bends::zheng);
  all.push_back(forceCloth(
      "flat", garmentOf({flatPatch(uniformKnots(2, 9), uniformKnots(2, 7), 1, 0.8, 0.2)}, {}, zheng, turnedWeft()),
      0.02));
  all.push_back(forceCloth("few cells", garmentOf({curvedPatch(2, 2, true)}, {}, zheng), 0.05));
  all.push_back(forceCloth("uneven", garmentOf({unevenPatch(41, 37, false)}, {}, zheng, turnedWeft()), 0.004));
  all.push_back(forceCloth("rational", garmentOf({unevenPatch(70, 35, true)}, {}, zheng, turnedWeft()), 0.004));
  all.push_back(forceCloth("double knots", garmentOf({unevenPatch(40, 11, true, true)}, {}, linear), 0.005));
  Fabric jams = zheng;
  jams.jam_area = 0.9;
  all.push_back(forceCloth("jams", garmentOf({unevenPatch(10, 8, false)}, {}, jams), 0.03));
  all.push_back(
      forceCloth("two sheets", garmentOf({unevenPatch(20, 6, true), unevenPatch(9, 40, false)}, {}, zheng), 0.01));
  // Sheets of different cloth, which core evaluates point by point.
  Garment worn = garmentOf({unevenPatch(20, 6, true), unevenPatch(9, 10, true)}, {}, zheng);
  worn.other_fabrics.push_back(linear);
  worn.fields = {PatchFields{}, PatchFields{}};
  for (std::size_t k = 0; k < 2; ++k) worn.fields[k].material = PatchField{0, 1, 1, {static_cast<double>(k)}};
  all.push_back(forceCloth("two cloths", worn, 0.01));
  for (const SeamKind kind : {SeamKind::C0, SeamKind::G1})
    all.push_back(forceCloth(kind == SeamKind::C0 ? "C0 seams" : "G1 seams", seamed(kind, zheng), 0.01));
  return all;
}

/// What takes the way of all other cells, whole or in part.
inline std::vector<ForceCloth> otherCloths() {
  using namespace shapes;
  std::vector<ForceCloth> all;
  const Fabric linear = plainFabric(Bends::linear), zheng = plainFabric(Bends::zheng);
  ShellOptions full;
  full.rule = CellRule::full;
  all.push_back(forceCloth("3 x 3 points", garmentOf({curvedPatch(2, 2, true)}, {}, zheng), 0.05, full));
  all.push_back(forceCloth("cubic", garmentOf({curvedPatch(3, 3, true)}, {}, zheng, turnedWeft()), 0.05));
  all.push_back(forceCloth("degrees 2 and 5", garmentOf({curvedPatch(2, 5, false)}, {}, linear), 0.05));
  all.push_back(forceCloth("degree 1", garmentOf({curvedPatch(1, 2, false)}, {}, linear), 0.02));
  Garment trimmed = garmentOf({unitPatch(2, 8)}, {}, zheng);
  trimmed.trims.push_back({std::vector<TrimLoop>{TrimLoop{circle({0.52, 0.5}, 0.35, 0.4, false)}}, 0});
  all.push_back(forceCloth("trimmed", trimmed, 0.01));
  Fabric solid = plainFabric(Bends::consistent);
  all.push_back(forceCloth("solid", garmentOf({curvedPatch(2, 2, true)}, {}, solid, turnedWeft()), 0.05));
  Fabric plies = linear;
  plies.law = Laminate{{{0.004, 210, 90, 40, 0.2, 0.5}, {0.006, 120, 60, 30, 0.3, -0.2}}};
  all.push_back(forceCloth("plies", garmentOf({curvedPatch(3, 2, true)}, {}, plies), 0.05));
  // A patch whose cloth changes from place to place, beside one whose does not.
  Garment mixed = garmentOf({unevenPatch(8, 6, true), unevenPatch(9, 10, true)}, {}, zheng);
  Fabric stiffer = zheng;
  rigidities(stiffer).stiffen(2);
  mixed.other_fabrics.push_back(stiffer);
  mixed.fields = {PatchFields{}, PatchFields{}};
  mixed.fields[0].material = PatchField{0, 1, 1, {1.0}};
  mixed.fields[1].material = PatchField{1, 2, 2, {0, 0.2, 0.5, 1}};
  all.push_back(forceCloth("cloth that changes", mixed, 0.01));
  Fabric wrinkles = zheng;
  wrinkles.tension_field = true;
  all.push_back(forceCloth("wrinkles", garmentOf({unevenPatch(9, 8, true)}, {}, wrinkles, turnedWeft()), 0.02));
  Fabric remembers = linear;
  remembers.law = rememberingLaw();
  all.push_back(forceCloth("patches of few cells", fourPatches(2, 2, true, SeamKind::C0, 0.7, zheng), 0.03));
  all.push_back(forceCloth("remembers", garmentOf({unevenPatch(9, 5, true)}, {}, remembers), 0.02));
  // A patch of each way, and a weak seam between edges that do not match.
  Garment weak = garmentOf(
      {flatPatch(uniformKnots(2, 5), uniformKnots(2, 4), 1, 1), patchOf(uniformKnots(3, 3), uniformKnots(3, 3),
                                                                        [](double a, double b) {
                                                                          return Vec3{1 + a, b, 0.0};
                                                                        })},
      {}, zheng);
  weak.weak_seams = {{{0, Side::u1}, {1, Side::u0}, SeamKind::G1, 0, 100}};
  all.push_back(forceCloth("weak seam", weak, 0.01));
  return all;
}

inline double largest(const std::vector<Vec3>& f) {
  double most = 0;
  for (const Vec3& v : f) most = std::max({most, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return most;
}
inline double farthest(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  if (a.size() != b.size()) return INFINITY;
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec3 d = a[i] - b[i];
    for (int c = 0; c < 3; ++c)
      if (!(std::abs(d[c]) <= most)) most = std::abs(d[c]);
  }
  return most;
}

}  // namespace gambeson::gpu
