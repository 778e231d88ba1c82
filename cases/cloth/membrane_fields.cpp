#include "cases/cloth/membrane_fields.hpp"

namespace gambeson::schema {
namespace {

bool isOf(const MembraneKey& k, MembraneElements elements) {
  return (elements == MembraneElements::springs && k.springs) ||
         (elements == MembraneElements::baraff_witkin && k.threads);
}

bool damps(const MembraneKey& k) {
  return k.number == &MembraneModel::stretch_damping_Ns_per_m || k.number == &MembraneModel::shear_damping_Ns_per_m;
}

}  // namespace

std::vector<std::pair<std::string, MembraneElements>> membraneElements() {
  return {{"continuum", MembraneElements::continuum},
          {"springs", MembraneElements::springs},
          {"baraff_witkin", MembraneElements::baraff_witkin}};
}

const std::vector<MembraneKey>& membraneKeys() {
  using M = MembraneModel;
  static const std::vector<MembraneKey> keys{
      {"spring_stiffness", &M::spring_N_per_m, true, false, "N/m", "from the fabric (Van Gelder 1998)",
       "of springs: k of an edge between two triangles, half of it at a border; equilateral triangles then have "
       "Young's modulus times thickness 2 k/sqrt(3), whatever their size"},
      {"weft_stiffness", &M::weft_N_per_m, false, true, "N/m", "young_weft times thickness",
       "of baraff_witkin: force per width over the stretch of the weft"},
      {"warp_stiffness", &M::warp_N_per_m, false, true, "N/m", "young_warp times thickness",
       "of baraff_witkin: the same of the warp"},
      {"shear_stiffness", &M::shear_N_per_m, false, true, "N/m", "shear times thickness",
       "of baraff_witkin: shear force per width over the cosine between weft and warp"},
      {"stretch_damping", &M::stretch_damping_Ns_per_m, true, true, "N s/m", "none",
       "damping of the membrane: of springs that of an edge between two triangles, half at a border (Wong 2014, eq. "
       "3.2); of baraff_witkin force per width over the rate of stretch of either thread (eq. 3.8). Explicit steps "
       "become shorter with it"},
      {"shear_damping", &M::shear_damping_Ns_per_m, false, true, "N s/m", "none",
       "of baraff_witkin: shear force per width over the rate of the cosine between weft and warp (eq. 3.8)"}};
  return keys;
}

void checkMembrane(const Entry& entry, const ClothModel& model, const Fabric& fabric, bool moves) {
  const MembraneElements elements = model.membrane.elements;
  if (model.kind != ClothKind::triangles && entry.node.find("membrane_elements"))
    entry.failAt("membrane_elements", "is for \"model\": \"triangles\"");
  for (const MembraneKey& k : membraneKeys()) {
    if (!entry.node.find(k.key)) continue;
    if (!isOf(k, elements))
      entry.failAt(k.key, std::string("is for \"membrane_elements\": ") + (k.springs && k.threads
                                                                               ? "\"springs\" or \"baraff_witkin\""
                                                                           : k.springs ? "\"springs\""
                                                                                       : "\"baraff_witkin\""));
    if (damps(k) && !moves)
      entry.failAt(k.key, "acts on velocities, and a static or modal case has none; allowed: leave it out");
  }
  if (elements == MembraneElements::continuum) return;
  if (fabric.tension_field)
    entry.failAt("membrane_elements",
                 "takes the place of the membrane that the fabric's tension_field relaxes; allowed: \"continuum\", or "
                 "a fabric without tension_field");
  if (fabric.shear_friction != ShearFriction{})
    entry.failAt(
        "membrane_elements",
        "takes the place of the membrane that has the fabric's friction in shear; allowed: \"continuum\", or a "
        "fabric without shear_loop");
}

}  // namespace gambeson::schema
