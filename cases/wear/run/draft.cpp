#include "cases/wear/run/draft.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>

#include "cases/cloth/make_cloth.hpp"
#include "cases/input/schema.hpp"
#include "cases/input/wrong_entry.hpp"
#include "cases/runs/results_folder.hpp"
#include "cases/wear/case/factors.hpp"
#include "cases/wear/case/garments/kind.hpp"
#include "cases/wear/case/human.hpp"
#include "cases/wear/scene/garments.hpp"
#include "core/cloth/draft/areas.hpp"
#include "core/cloth/draft/obj_mesh.hpp"
#include "core/cloth/draft/seams.hpp"
#include "core/error.hpp"
#include "core/io/own_file.hpp"
#include "tryon/pattern/flat/flatten_draft.hpp"
#include "tryon/pattern/garment_file.hpp"

namespace gambeson {

std::size_t garmentCalled(const Case& c, const std::string& name) {
  std::vector<std::string> names;
  for (const GarmentCase& g : c.garments) names.push_back(g.name);
  if (name.empty()) {
    if (names.size() > 1)
      throw InputError({"command line", 0, "--garment"},
                       "is required where there are several garments; allowed: " + schema::joined(names));
    return 0;
  }
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw InputError({"command line", 0, "--garment"},
                     fmt::format("there is no garment \"{}\"; allowed: {}", name, schema::joined(names)));
  return static_cast<std::size_t>(found - names.begin());
}

Garment draftOf(const Case& c, std::size_t k) {
  std::optional<Human> human;
  if (c.human) human = humanOf(*c.human);
  try {
    std::vector<Garment> drafts = draftGarments(withFactors(c), human ? &*human : nullptr);
    if (const GarmentKind& kind = kindOf(c.garments[k]); kind.isMesh())
      throw InputError({"", 0, fmt::format("garments[{}].{}", k, kind.word)}, "is a mesh already; drafts are written");
    return std::move(drafts[k]);
  } catch (const InputError& e) {
    sayInCase(c.file, c.overrides, e);
  }
}

std::vector<std::string> uncutText(const Case& c, const std::vector<Garment>& drafts) {
  std::vector<std::string> notes;
  for (std::size_t k = 0; k < drafts.size(); ++k) {
    const GarmentCase& worn = c.garments[k];
    if (!kindOf(worn).drafted) continue;
    const FabricCase& f = fabricOf(c, worn);
    const double stands = standsOf(f);
    try {
      if (const std::string beyond = beyondText(flattenDraft(drafts[k]), stands); !beyond.empty())
        notes.push_back(fmt::format(
            "{}no flat cloth makes this draft: to lie flat it is stretched at {}; the fabric stands {:.3g} % "
            "({}). The run takes it as if woven in that shape; sewn, it needs darts or more panels there",
            worn.name.empty() ? "" : worn.name + ": ", beyond, 100 * stands,
            (f.limit_strain_weft && !f.limit_of_law[0]) || (f.limit_strain_warp && !f.limit_of_law[1])
                ? "limit_strain"
                : "the range of its law"));
    } catch (const InputError& e) {
      notes.push_back(
          fmt::format("{}no flat cloth makes this draft: {}", worn.name.empty() ? "" : worn.name + ": ", e.reason()));
    }
  }
  return notes;
}

void draftToFile(const Case& c, const std::string& name, const std::filesystem::path& file, bool as_mesh,
                 std::ostream& out) {
  const std::size_t k = garmentCalled(c, name);
  checkOutput(file, "--output", inputsOf(c));
  const Garment g = draftOf(c, k);
  if (as_mesh) {
    const MeshDraft t = meshOf(g, c.garments[k].cloth);
    writeOwnFile(file, objText(t.mesh, g.name));
    out << fmt::format("{}: {} patches, {} vertices, {} triangles\n", g.name, t.mesh.patch_names.size(),
                       t.mesh.vertices.size(), t.mesh.triangles.size());
    return;
  }
  writeGarment(g, file);
  double area = 0, mass = 0;
  for (const double a : controlAreas(g)) area += a;
  for (const double m : controlMasses(g)) mass += m;
  out << fmt::format("{}: {} patches, {} control points, {:.4f} m^2, {:.3f} kg\n", g.name, g.patches.size(),
                     controlOffsets(g).back(), area, mass);
}

}  // namespace gambeson
