#include "cases/wear/scene/worn.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "tryon/stitching.hpp"

namespace gambeson {

void wear(Scenario& s, const Dressed& dressed) {
  const Case& c = s.definition;
  const auto fail = [&](const std::string& reason) { throw InputError({c.dressing.from.string(), 0, ""}, reason); };
  if (!c.human || dressed.body != bodyFingerprint(*c.human))
    fail("was dressed on another body than that of " + c.file.string());
  if (dressed.posture.q.size() != s.human->skeleton.joints.size()) fail("has a posture of another skeleton");
  if (dressed.garments.size() != c.garments.size())
    fail(fmt::format("holds {} garments, the case {}", dressed.garments.size(), c.garments.size()));
  const std::vector<ClothPatch>& patches = s.model->cloth->patches();
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
  }
  s.start_m = sew(s.model->cloth->map(), q);
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
  for (const GarmentCase& g : c.garments) dressed.garments.push_back({g.name, {}});
  for (const ClothPatch& p : s.model->cloth->patches()) {
    std::vector<Vec3>& points = dressed.garments[static_cast<std::size_t>(p.garment)].points_m;
    points.insert(points.end(), q.begin() + p.first_point, q.begin() + p.end_point);
  }
  return dressed;
}

}  // namespace gambeson
