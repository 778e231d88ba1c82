/// Detail of fields.hpp: the table of materials.

#include <fmt/format.h>

#include "cases/cloth/fabric_input.hpp"
#include "cases/cloth/fields.hpp"
#include "cases/input/table.hpp"
#include "cases/structure/fields.hpp"

namespace gambeson::schema {
namespace {

const Range modulus = aboveTo(0, 1e18), length = aboveTo(0, 1e9), density = aboveTo(0, 1e12);
const std::string density_doc = "mass per volume; needed for gravity, dynamic and modal cases";
const std::string convention =
    "from the bottom (-normal) to the top. Angles turn the fibre from the weft towards the warp, counter-clockwise "
    "seen "
    "against the normal";

Object isotropicTable() {
  using M = IsotropicMaterial;
  return Table<M>("Isotropic material")
      .number("young", &M::young_Pa, "Pa", modulus, "Young's modulus")
      .required()
      .number("poisson", &M::poisson, "", {.low = -1, .high = 0.5, .low_open = true}, "Poisson's ratio")
      .number("thickness", &M::thickness_m, "m", length, "thickness")
      .required()
      .number("density", &M::density_kg_per_m3, "kg/m^3", density, density_doc)
      .build();
}

/// Positive definite only so: nu12^2 E2 < E1.
void checkPoisson(const Entry& p, double poisson, double e1, double e2, const char* key) {
  if (!(poisson * poisson * e2 < e1))
    p.failAt(key, fmt::format("{} is out of range; allowed: a magnitude below sqrt(E1 / E2) = {:.4g}", poisson,
                              std::sqrt(e1 / e2)));
}

Object orthotropicTable() {
  using M = OrthotropicMaterial;
  return Table<M>("Orthotropic material")
      .number("young_weft", &M::young_weft_Pa, "Pa", modulus, "Young's modulus along the weft")
      .required()
      .number("young_warp", &M::young_warp_Pa, "Pa", modulus, "Young's modulus along the warp")
      .required()
      .number("shear", &M::shear_Pa, "Pa", modulus, "in-plane shear modulus")
      .required()
      .number("poisson", &M::poisson, "", between(-10, 10),
              "contraction along the warp under tension along the weft; poisson^2 young_warp < young_weft")
      .number("thickness", &M::thickness_m, "m", length, "thickness")
      .required()
      .number("density", &M::density_kg_per_m3, "kg/m^3", density, density_doc)
      .check(
          [](const Entry& p, const M& m) { checkPoisson(p, m.poisson, m.young_weft_Pa, m.young_warp_Pa, "poisson"); })
      .build();
}

Object plyTable() {
  using P = Ply;
  return Table<P>("Ply")
      .number("thickness", &P::thickness_m, "m", length, "thickness")
      .required()
      .number("young1", &P::young1_Pa, "Pa", modulus, "Young's modulus along the fibre")
      .required()
      .number("young2", &P::young2_Pa, "Pa", modulus, "Young's modulus across the fibre")
      .required()
      .number("shear", &P::shear_Pa, "Pa", modulus, "in-plane shear modulus")
      .required()
      .number("poisson12", &P::poisson12, "", between(-10, 10), "contraction across the fibre under tension along it")
      .number("angle", &P::angle_rad, "rad", between(-7, 7), "of the fibre, from the weft towards the warp")
      .check([](const Entry& p, const P& m) { checkPoisson(p, m.poisson12, m.young1_Pa, m.young2_Pa, "poisson12"); })
      .build();
}

Object laminateTable() {
  using M = LaminateMaterial;
  return Table<M>("Laminate")
      .list("plies", &M::plies, plyTable(), convention)
      .required()
      .number("density", &M::density_kg_per_m3, "kg/m^3", density, density_doc + "; of all plies")
      .check([](const Entry& p, const M& m) {
        if (m.plies.empty()) p.failAt("plies", "there is none; allowed: at least one");
      })
      .build();
}

}  // namespace

Object materialTable() {
  using M = MaterialCase;
  Field fabric;
  fabric.key = "fabric";
  fabric.kind = Kind::object;
  fabric.doc = "cloth with a bending law of its own";
  fabric.object = std::make_shared<const Object>(fabricTable());
  return Table<M>("Material")
      .alternative<IsotropicMaterial>("isotropic", &M::law, isotropicTable(),
                                      "homogeneous, St. Venant-Kirchhoff, bending stiffness E h^3 / (12 (1 - nu^2))")
      .in("law")
      .alternative<OrthotropicMaterial>("orthotropic", &M::law, orthotropicTable(),
                                        "homogeneous with two stiff directions, bending by h^2 / 12 of the membrane")
      .in("law")
      .alternative<LaminateMaterial>("laminate", &M::law, laminateTable(),
                                     "plies: classical laminate theory, A, B and D")
      .in("law")
      .custom(
          fabric,
          [table = fabric.object](const Entry& p, M& m) {
            FabricInput in;
            readObject(*table, p, &in);
            const FabricCase f = resolveFabric(p, in);
            m.law = static_cast<const Fabric&>(f);
            m.card = f.card;
            m.energy_source = f.energy_source;
            m.thickness_assumed = f.thickness_assumed;
            // The range of a law is no limit that anyone stated: the check of the law's range is about that.
            if (!f.limit_of_law[0]) m.limit_strain_weft = f.limit_strain_weft;
            if (!f.limit_of_law[1]) m.limit_strain_warp = f.limit_strain_warp;
          },
          [table = fabric.object](const M& m) -> std::optional<JsonNode> {
            const Fabric* f = std::get_if<Fabric>(&m.law);
            if (!f) return std::nullopt;
            const FabricInput in = restoreFabric(FabricCase{
                *f, m.limit_strain_weft, m.limit_strain_warp, m.card, m.energy_source, {}, m.thickness_assumed});
            return writeObject(*table, &in);
          })
      .in("law")
      .oneOf("law", true)
      .flag("tension_field", &M::tension_field,
            "no compression: where the sheet would wrinkle, its membrane carries tension only (not for laminates whose "
            "membrane and bending are coupled)")
      .build();
}

}  // namespace gambeson::schema

namespace gambeson {

Fabric fabricOf(const MaterialCase& material) {
  struct Resolve {
    Fabric operator()(const IsotropicMaterial& m) const {
      Fabric f = homogeneous(m.thickness_m, m.density_kg_per_m3);
      f.young_weft_Pa = f.young_warp_Pa = m.young_Pa;
      f.poisson = m.poisson;
      f.shear_Pa = m.young_Pa / (2 * (1 + m.poisson));
      return f;
    }
    Fabric operator()(const OrthotropicMaterial& m) const {
      Fabric f = homogeneous(m.thickness_m, m.density_kg_per_m3);
      f.young_weft_Pa = m.young_weft_Pa;
      f.young_warp_Pa = m.young_warp_Pa;
      f.poisson = m.poisson;
      f.shear_Pa = m.shear_Pa;
      return f;
    }
    Fabric operator()(const LaminateMaterial& m) const {
      const Laminate laminate{m.plies};
      Fabric f = homogeneous(laminate.thickness_m(), m.density_kg_per_m3);
      // What the shell takes is the plies; these stand for reports only.
      f.young_weft_Pa = m.plies[0].young1_Pa;
      f.young_warp_Pa = m.plies[0].young2_Pa;
      f.shear_Pa = m.plies[0].shear_Pa;
      f.poisson = m.plies[0].poisson12;
      f.law = laminate;
      return f;
    }
    Fabric operator()(const Fabric& m) const { return m; }
    static Fabric homogeneous(double thickness_m, const std::optional<double>& density) {
      Fabric f;
      f.thickness_m = thickness_m;
      f.density_kg_per_m3 = density.value_or(0);
      f.law = ConsistentBending{};
      f.rest_curvature_of_shape = true;
      return f;
    }
  };
  Fabric f = std::visit(Resolve{}, material.law);
  f.tension_field = material.tension_field;
  return f;
}

}  // namespace gambeson
