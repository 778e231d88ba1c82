#include "cases/wear/run/draft.hpp"

#include <fmt/format.h>

#include <ostream>

#include "cases/cloth/make_cloth.hpp"
#include "cases/input/schema.hpp"
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
#include "tryon/pattern/garment_file.hpp"

namespace gambeson {

void draftToFile(const Case& c, const std::string& name, const std::filesystem::path& file, bool as_mesh,
                 std::ostream& out) {
  std::vector<std::string> names;
  for (const GarmentCase& g : c.garments) names.push_back(g.name);
  std::size_t k = 0;
  if (name.empty()) {
    if (names.size() > 1)
      throw InputError({"command line", 0, "--garment"},
                       "is required where there are several garments; allowed: " + schema::joined(names));
  } else {
    while (k < names.size() && names[k] != name) ++k;
    if (k == names.size())
      throw InputError({"command line", 0, "--garment"},
                       fmt::format("there is no garment \"{}\"; allowed: {}", name, schema::joined(names)));
  }
  checkOutput(file, "--output", inputsOf(c));
  std::optional<Human> human;
  if (c.human) human = humanOf(*c.human);
  const Case made = withFactors(c);
  const Garment g = draftGarments(made, human ? &*human : nullptr)[k];
  if (const GarmentKind& kind = kindOf(c.garments[k]); kind.isMesh())
    throw InputError({c.file.string(), 0, fmt::format("garments[{}].{}", k, kind.word)},
                     "is a mesh already; drafts are written");
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
