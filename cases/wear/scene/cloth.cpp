#include "cases/wear/scene/cloth.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cases/cloth/make_cloth.hpp"
#include "cases/cloth/noise.hpp"
#include "cases/wear/case/factors.hpp"
#include "cases/wear/scene/garments.hpp"
#include "core/cloth/draft/seams.hpp"
#include "tryon/stitching.hpp"

namespace gambeson {
namespace {

Case withoutNoise(Case c) {
  for (GarmentCase& g : c.garments) g.noise_m = 0;
  return c;
}

/// Noise of the garments that are meshes from the start; that of drafts is their control points'.
void addMeshNoise(const Case& c, const Wardrobe& wardrobe, ClothDraft& out) {
  for (std::size_t k = 0; k < c.garments.size(); ++k) {
    const GarmentCase& worn = c.garments[k];
    if (!wardrobe.meshes[k] || !(worn.noise_m > 0)) continue;
    int first = out.cloth->points(), end = 0;
    for (const ClothPatch& p : out.cloth->patches())
      if (p.garment == static_cast<int>(k)) first = std::min(first, p.first_point), end = std::max(end, p.end_point);
    const std::vector<Vec3> noise = noiseOf(*out.cloth, out.cloth->surface(out.samples_per_cell), first, end,
                                            {worn.noise_m, worn.noise_seed, 0, 0, false});
    for (std::size_t i = 0; i < noise.size(); ++i) out.start_m[static_cast<std::size_t>(first) + i] += noise[i];
  }
}

}  // namespace

ClothDraft clothOf(const Case& c, const FactorsCase& written, const Wardrobe& wardrobe, bool panels, bool closing) {
  ClothDraft out;
  std::vector<Garment> drafts = wardrobe.drafts;
  std::vector<Vec3> start = startDisplacements(c, drafts);
  for (Garment& g : drafts) scaleSeams(g, written);
  const Garment sewn = drafts[0];
  if (panels) {
    const std::vector<Vec3> offsets = panelOffsets(sewn, c.garments[0].stitching->offset_m);
    const std::vector<int> first = controlOffsets(sewn);
    for (std::size_t p = 0; p < offsets.size(); ++p)
      for (int i = first[p]; i < first[p + 1]; ++i) start[static_cast<std::size_t>(i)] += offsets[p];
    drafts[0] = unsewn(sewn);
  }
  std::vector<ClothSource> sources;
  for (std::size_t k = 0; k < drafts.size(); ++k) {
    const auto& mesh = wardrobe.meshes[k];
    sources.push_back(
        {drafts[k], c.garments[k].cloth, mesh ? &*mesh : nullptr, fmt::format("garments[{}]", k), !closing});
  }
  out.cloth = makeCloth(sources);
  out.start_m = out.cloth->fromDraft(start);
  out.placed_m = out.cloth->fromDraft(startDisplacements(withoutNoise(c), drafts));
  for (const Garment& g : drafts) out.edges.push_back(g.edges);
  for (const ClothPatch& p : out.cloth->patches()) {
    const GarmentCase& worn = c.garments[static_cast<std::size_t>(p.garment)];
    out.samples_per_cell.push_back(samplesPerCell(worn.cloth, worn.samples_per_cell));
  }
  addMeshNoise(c, wardrobe, out);
  if (panels) {
    const Stitching& law = *c.garments[0].stitching;
    out.stitches = stitchesOf(sewn, *out.cloth, out.cloth->surface(out.samples_per_cell),
                              {law.stiffness_N_per_m2, law.damping_kg_per_m_s});
  }
  return out;
}

}  // namespace gambeson
