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

/// Where the history of a garment stands in that of the cloth, point by point.
std::vector<std::size_t> pointsOf(const Cloth& cloth, int garment) {
  const auto places = cloth.historyPlaces();
  std::vector<std::size_t> points;
  for (std::size_t k = 0; k < places.size(); ++k)
    if (cloth.patches()[static_cast<std::size_t>(places[k].first)].garment == garment) points.push_back(k);
  std::stable_sort(points.begin(), points.end(), [&](std::size_t a, std::size_t b) {
    const auto key = [&](std::size_t k) { return std::tuple(places[k].first, places[k].second.y, places[k].second.x); };
    return key(a) < key(b);
  });
  return points;
}

/// The laws of a garment that remember, by their names in case files.
std::string lawsThatRemember(const Case& c, const GarmentCase& worn) {
  std::set<std::string> names;
  std::vector<Fabric> fabrics = otherFabrics(worn);
  fabrics.push_back(fabricOf(c, worn));
  for (const Fabric& f : fabrics)
    if (lawUse(f).remembers()) names.insert(schema::bendingName(f.law));
  return fmt::format("{}", fmt::join(names, ", "));
}

std::size_t perPoint(const Cloth& cloth) {
  const std::size_t points = cloth.historyPlaces().size();
  return points > 0 ? cloth.historySize() / points : 0;
}

}  // namespace

std::vector<double> historyOf(const Cloth& cloth, std::span<const double> history, int garment) {
  const std::size_t n = perPoint(cloth);
  std::vector<double> of_garment;
  for (std::size_t k : pointsOf(cloth, garment))
    of_garment.insert(of_garment.end(), history.begin() + static_cast<long>(k * n),
                      history.begin() + static_cast<long>((k + 1) * n));
  return of_garment;
}

std::size_t setHistoryOf(const Cloth& cloth, int garment, std::span<const double> of_garment,
                         std::span<double> history) {
  const std::size_t n = perPoint(cloth);
  const std::vector<std::size_t> points = pointsOf(cloth, garment);
  if (of_garment.size() == points.size() * n)
    for (std::size_t i = 0; i < points.size(); ++i)
      std::copy_n(of_garment.begin() + static_cast<long>(i * n), n, history.begin() + static_cast<long>(points[i] * n));
  return points.size() * n;
}

std::vector<double> carriedHistory(const Cloth& from, std::span<const double> history, const Cloth& to) {
  using Key = std::tuple<int, double, double>;
  const std::size_t n = perPoint(from);
  std::map<Key, std::size_t> known;
  const auto before = from.historyPlaces(), now = to.historyPlaces();
  for (std::size_t k = 0; k < before.size(); ++k) known[{before[k].first, before[k].second.x, before[k].second.y}] = k;
  std::vector<double> carried(to.historySize());
  to.startHistory(carried);
  for (std::size_t k = 0; k < now.size(); ++k) {
    const auto at = known.find({now[k].first, now[k].second.x, now[k].second.y});
    if (at != known.end())
      std::copy_n(history.begin() + static_cast<long>(at->second * n), n, carried.begin() + static_cast<long>(k * n));
  }
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
