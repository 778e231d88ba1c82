#include "tryon/strap_cut.hpp"

#include <algorithm>

namespace gambeson {
namespace {

constexpr int kRows = 2;  ///< of points beyond a cut

}  // namespace

std::vector<StrapCut> strapCuts(const Cloth& cloth, std::span<const std::string> names) {
  std::vector<StrapCut> cuts;
  for (std::size_t p = 0; p < cloth.patches().size(); ++p) {
    if (!names[p].substr(names[p].rfind(' ') + 1).starts_with("strap")) continue;
    const ClothPatch& patch = cloth.patches()[p];
    const bool along_u = patch.sewn[0] && patch.sewn[1], along_v = patch.sewn[2] && patch.sewn[3];
    const bool at_third = (patch.sewn[0] != patch.sewn[1]) || (patch.sewn[2] != patch.sewn[3]);  // a sleeve's, say
    if (along_u == along_v || at_third) continue;
    const int index = static_cast<int>(p);
    const PatchEdge edges[] = {{index, along_v ? Side::v0 : Side::u0}, {index, along_v ? Side::v1 : Side::u1}};
    std::vector<int> beyond[] = {cloth.mounting().edgePoints(edges[0], kRows),
                                 cloth.mounting().edgePoints(edges[1], kRows)};
    if (static_cast<int>(beyond[0].size() + beyond[1].size()) >= patch.end_point - patch.first_point) continue;
    for (const bool end : {false, true})
      cuts.push_back({index, end, cloth.mounting().edgeLength(edges[end]), std::move(beyond[end])});
  }
  return cuts;
}

std::vector<double> weightsBelow(const Cloth& cloth, std::span<const StrapCut> cuts, bool own) {
  std::vector<double> w(static_cast<std::size_t>(cloth.points()), 0);
  const auto patch = [&](const StrapCut& cut) { return cloth.patches()[static_cast<std::size_t>(cut.patch)]; };
  const auto fill = [&](const ClothPatch& p, double value) {
    std::fill(w.begin() + p.first_point, w.begin() + p.end_point, value);
  };
  for (const StrapCut& cut : cuts)
    for (const ClothPatch& p : cloth.patches())
      if (!own || p.garment == patch(cut).garment) fill(p, 1);
  for (const StrapCut& cut : cuts) fill(patch(cut), 0);
  for (const StrapCut& cut : cuts)
    for (const int i : cut.beyond) w[static_cast<std::size_t>(i)] = 1;
  return w;
}

std::vector<Vec3> strapPulls(const Cloth& cloth, const ClothState& state, std::span<const StrapCut> cuts,
                             ClothWork& work) {
  std::vector<Vec3> f(state.q.size()), pulls;
  cloth.force(state, {f, {}, {}, nullptr}, work, {.membrane = true, .bending = true, .seams = false});
  for (const StrapCut& cut : cuts) {
    Vec3 sum{};
    for (const int i : cut.beyond) sum += f[static_cast<std::size_t>(i)];
    pulls.push_back(sum);
  }
  return pulls;
}

}  // namespace gambeson
