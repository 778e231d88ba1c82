#include "cases/wear/scene/cloth.hpp"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "cases/input/places.hpp"
#include "cases/wear/case/factors.hpp"
#include "cases/wear/scene/garments.hpp"
#include "core/cloth/joined_cloth.hpp"
#include "core/cloth/shell/layers.hpp"
#include "core/cloth/shell/nurbs_shell.hpp"
#include "core/cloth/triangles/triangle_cloth.hpp"
#include "core/error.hpp"
#include "tryon/stitching.hpp"

namespace gambeson {
namespace {

/// Garments [from, end) of one kind.
std::unique_ptr<const Cloth> clothOfKind(const Case& c, const std::vector<Garment>& drafts,
                                         const std::vector<std::optional<TriangleGarment>>& meshes, std::size_t from,
                                         std::size_t end) {
  const std::span<const Garment> own = std::span(drafts).subspan(from, end - from);
  if (c.garments[from].cloth.kind == ClothKind::nurbs)
    return std::make_unique<NurbsShell>(own.size() == 1 ? own[0] : joinLayers(own));
  std::vector<TriangleGarment> garments;
  for (std::size_t k = from; k < end; ++k)
    garments.push_back(underKey(fmt::format("garments[{}]", k), [&] {
      return meshes[k] ? *meshes[k] : triangleGarment(drafts[k], c.garments[k].cloth.mesh);
    }));
  return std::make_unique<TriangleCloth>(std::move(garments));
}

}  // namespace

ClothDraft clothOf(const Case& c, const FactorsCase& written, const Wardrobe& wardrobe, bool panels) {
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
  std::vector<std::unique_ptr<const Cloth>> kinds;
  for (std::size_t from = 0; from < drafts.size();) {
    std::size_t end = from + 1;
    while (end < drafts.size() && c.garments[end].cloth.kind == c.garments[from].cloth.kind) ++end;
    kinds.push_back(clothOfKind(c, drafts, wardrobe.meshes, from, end));
    from = end;
  }
  out.cloth = kinds.size() == 1 ? std::move(kinds[0]) : std::make_unique<JoinedCloth>(std::move(kinds));
  out.start_m = out.cloth->fromDraft(start);
  for (const Garment& g : drafts) out.edges.push_back(g.edges);
  for (const ClothPatch& p : out.cloth->patches()) {
    const GarmentCase& worn = c.garments[static_cast<std::size_t>(p.garment)];
    out.samples_per_cell.push_back(worn.cloth.kind == ClothKind::nurbs ? worn.samples_per_cell : 1);
  }
  if (panels) {
    const Stitching& law = *c.garments[0].stitching;
    out.stitches = stitchesOf(sewn, *out.cloth, out.cloth->surface(out.samples_per_cell),
                              {law.stiffness_N_per_m2, law.damping_kg_per_m_s});
  }
  return out;
}

}  // namespace gambeson
