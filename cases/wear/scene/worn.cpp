#include "cases/wear/scene/worn.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "cases/cloth/fabric_input.hpp"
#include "core/error.hpp"
#include "core/material/fabric_law.hpp"
#include "tryon/stitching.hpp"

namespace gambeson {
namespace {

/// The points of a garment that remember, patch by patch, by place.
std::vector<HistoryPlace> pointsOf(const Cloth& cloth, int garment) {
  std::vector<HistoryPlace> points;
  for (const HistoryPlace& p : cloth.historyPlaces())
    if (cloth.patches()[static_cast<std::size_t>(p.patch)].garment == garment) points.push_back(p);
  std::stable_sort(points.begin(), points.end(), [](const HistoryPlace& a, const HistoryPlace& b) {
    return std::tuple(a.patch, a.place.y, a.place.x) < std::tuple(b.patch, b.place.y, b.place.x);
  });
  return points;
}

/// The laws of a garment that remember, by their names in case files.
std::string lawsThatRemember(const Case& c, const GarmentCase& worn) {
  std::set<std::string> names;
  std::vector<Fabric> fabrics = otherFabrics(worn);
  fabrics.push_back(fabricOf(c, worn));
  for (const Fabric& f : fabrics) {
    const LawUse use = lawUse(f);
    if (use.shears) names.insert("shear_loop");
    if (use.kinds & BendingLaws::remembering) names.insert(schema::bendingName(f.law));
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

std::vector<double> historyOf(const Cloth& cloth, std::span<const double> history, int garment) {
  std::vector<double> of_garment;
  for (const HistoryPlace& p : pointsOf(cloth, garment))
    for (std::size_t i = 0; i < p.count; ++i) of_garment.push_back(history[p.first + i * p.stride]);
  return of_garment;
}

std::size_t setHistoryOf(const Cloth& cloth, int garment, std::span<const double> of_garment,
                         std::span<double> history) {
  const std::vector<HistoryPlace> points = pointsOf(cloth, garment);
  std::size_t count = 0;
  for (const HistoryPlace& p : points) count += p.count;
  if (of_garment.size() != count) return count;
  auto at = of_garment.begin();
  for (const HistoryPlace& p : points)
    for (std::size_t i = 0; i < p.count; ++i) history[p.first + i * p.stride] = *at++;
  return count;
}

std::vector<double> carriedHistory(const Cloth& from, std::span<const double> history, const Cloth& to) {
  const auto key = [](const HistoryPlace& p) { return std::tuple(p.patch, p.place.x, p.place.y, p.count); };
  const auto before = from.historyPlaces();
  std::map<decltype(key(before[0])), const HistoryPlace*> known;
  for (const HistoryPlace& p : before) known[key(p)] = &p;
  std::vector<double> carried(to.historySize());
  to.startHistory(carried);
  for (const HistoryPlace& p : to.historyPlaces())
    if (const auto at = known.find(key(p)); at != known.end())
      for (std::size_t i = 0; i < p.count; ++i)
        carried[p.first + i * p.stride] = history[at->second->first + i * at->second->stride];
  return carried;
}

void wear(Scenario& s, const Dressed& dressed) {
  const Case& c = s.definition;
  const auto fail = [&](const std::string& reason) { throw InputError({c.dressing.from.string(), 0, ""}, reason); };
  if (!c.human || dressed.body != bodyFingerprint(*c.human))
    fail("was dressed on another body than that of " + c.file.string());
  if (dressed.posture.q.size() != s.human->skeleton.joints.size()) fail("has a posture of another skeleton");
  if (dressed.garments.size() != c.garments.size())
    fail(fmt::format("holds {} garments, the case {}", dressed.garments.size(), c.garments.size()));
  const Cloth& cloth = *s.model->cloth;
  const std::vector<ClothPatch>& patches = cloth.patches();
  std::vector<double> history(cloth.historySize());
  cloth.startHistory(history);
  std::vector<Vec3> q;
  std::size_t patch = 0;
  for (std::size_t g = 0; g < c.garments.size(); ++g) {
    const DressedGarment& worn = dressed.garments[g];
    if (worn.name != c.garments[g].name)
      fail(fmt::format("garment {} is \"{}\", in the case \"{}\"", g + 1, worn.name, c.garments[g].name));
    std::size_t points = 0;
    for (; patch < patches.size() && patches[patch].garment == static_cast<int>(g); ++patch)
      points += static_cast<std::size_t>(patches[patch].end_point - patches[patch].first_point);
    if (points != worn.points_m.size())
      fail(fmt::format("the garment \"{}\" has {} control points, in the case {}", worn.name, worn.points_m.size(),
                       points));
    q.insert(q.end(), worn.points_m.begin(), worn.points_m.end());
    if (c.dressing.history == DressedHistory::wiped) continue;
    if (const std::string laws = lawsThatRemember(c, c.garments[g]); laws != worn.law)
      fail(
          fmt::format("the garment \"{}\" remembers what the law \"{}\" does, in the case \"{}\": dress it again with "
                      "this fabric, or let \"dressing.history\" be \"wiped\"",
                      worn.name, worn.law, laws));
    if (const std::size_t count = setHistoryOf(cloth, static_cast<int>(g), worn.history, history);
        count != worn.history.size())
      fail(fmt::format(
          "the garment \"{}\" remembers {} numbers, in the case {}: dress it again with this fabric, or let "
          "\"dressing.history\" be \"wiped\"",
          worn.name, worn.history.size(), count));
  }
  s.start_m = sew(cloth.map(), q);
  s.start_history = std::move(history);
}

std::vector<Vec3> controlPoints(const Scenario& s, const State& state) {
  std::vector<Vec3> q(s.model->cloth->map().T.rows());
  s.model->cloth->map().T.multiply<Vec3>(state.p, q);
  return q;
}

Dressed dressedOf(const Scenario& s, const State& state) {
  const Case& c = s.definition;
  Dressed dressed;
  dressed.body = bodyFingerprint(*c.human);
  dressed.posture = s.motion->at(0);
  const std::vector<Vec3> q = controlPoints(s, state);
  for (std::size_t g = 0; g < c.garments.size(); ++g)
    dressed.garments.push_back({c.garments[g].name,
                                {},
                                lawsThatRemember(c, c.garments[g]),
                                historyOf(*s.model->cloth, state.history, static_cast<int>(g))});
  for (const ClothPatch& p : s.model->cloth->patches()) {
    std::vector<Vec3>& points = dressed.garments[static_cast<std::size_t>(p.garment)].points_m;
    points.insert(points.end(), q.begin() + p.first_point, q.begin() + p.end_point);
  }
  return dressed;
}

}  // namespace gambeson
