/// Detail of fields.hpp: the table of garments.

#include "cases/cloth/fabric_input.hpp"
#include "cases/cloth/fields.hpp"
#include "cases/cloth/kind_fields.hpp"
#include "cases/cloth/membrane_fields.hpp"
#include "cases/cloth/node_fields.hpp"
#include "cases/contact/fields.hpp"
#include "cases/input/table.hpp"
#include "cases/wear/case/case.hpp"
#include "cases/wear/case/fields.hpp"
#include "cases/wear/case/garments/kind.hpp"

namespace gambeson::schema {
namespace {

Object stitchingTable() {
  using S = Stitching;
  return Table<S>("Stitching")
      .number("offset", &S::offset_m, "m", between(0, 0.5),
              "how far panels that face one way stand off from where they are drafted; others start there")
      .number("stiffness", &S::stiffness_N_per_m2, "N/m^2", aboveTo(0, 1e6),
              "springs along the seams: force per distance and length of seam, k of Zheng 2013, eq. 6.2")
      .number("damping", &S::damping_kg_per_m_s, "kg/(m s)", between(0, 1e4),
              "their damping per length of seam, eta of eq. 6.2")
      .number("close", &S::close_m, "m", aboveTo(0, 0.05),
              "the panels are sewn once no pair of points is further apart; contact keeps them the layer apart")
      .number("within", &S::within_s, "s", aboveTo(0, 60), "time by which they must be that close")
      .build();
}

/// A list that is not written where it is empty, so that the case of a plain garment says nothing of it.
Field listOf(const std::string& key, Object item, const std::string& doc) {
  Field f;
  f.key = key;
  f.kind = Kind::list;
  f.doc = doc;
  f.object = std::make_shared<const Object>(std::move(item));
  return f;
}

/// A number of garments that `has` one; the case of others does not say it, as reading it would be refused.
template <class Number, class Has>
void numberOfSome(Table<GarmentCase>& table, const Field& field, Number GarmentCase::*number, Has has) {
  table.custom(
      field,
      [=](const Entry& p, GarmentCase& g) {
        if constexpr (std::is_same_v<Number, int>)
          g.*number = readInteger(p, field.range);
        else
          g.*number = readNumber(p, field.unit, field.range);
      },
      [=](const GarmentCase& g) -> std::optional<JsonNode> {
        return has(g) ? std::optional(nodeOf(static_cast<double>(g.*number))) : std::nullopt;
      });
}

/// What a garment's samples and seams are.
void addSamplesAndSeams(Table<GarmentCase>& table) {
  using G = GarmentCase;
  numberOfSome(
      table,
      fieldOf("samples_per_cell", Kind::integer, "", between(0, 8),
              "contact samples along the edge of a cell; 0: one per control point (Greville points). All garments "
              "together have at most 1,100,000 cells and 1,100,000 samples"),
      &G::samples_per_cell, [](const G& g) { return g.cloth.kind != ClothKind::triangles; });
  numberOfSome(table,
               fieldOf("seam_stiffness", Kind::number, "N/rad", between(0, 1e4),
                       "rotational spring of seams that meet at an angle: moment per length and angle"),
               &G::seam_stiffness_N, [](const G& g) { return !kindOf(g).isMesh() && !kindOf(g).sewn; });
}

}  // namespace

Object garmentTable() {
  using G = GarmentCase;
  Table<G> table("Garment");
  table.text("name", &G::name, "what supports and tables call it; required where there are several garments");
  for (const GarmentKind* kind : garmentKinds()) {
    kind->addTo(table);
    table.in("shape");
  }
  ownFriction(table, "friction", &G::friction, "with bodies; an obstacle's own is before it");
  table.oneOf("shape", true)
      .choice(
          "model", [](auto& g) -> auto& { return g.cloth.kind; }, clothKinds(), clothKindDoc())
      .unwritten()
      .choice(
          "mesh", [](auto& g) -> auto& { return g.cloth.mesh; }, meshKinds(), meshKindDoc())
      .unwritten()
      .choice(
          "bending_elements", [](auto& g) -> auto& { return g.cloth.bending; }, bendingElements(), bendingElementsDoc())
      .unwritten()
      .number(
          "bending_spring", [](auto& g) -> auto& { return g.cloth.bending_spring_N_per_m; }, "N/m", between(0, 1e6),
          bendingSpringDoc())
      .unwritten();
  addMembraneFields(table);
  addNodeFields(table);
  table.vector("position", &G::position_m, "m", between(-1e3, 1e3), "moves the shape from where it was made")
      .converted<FabricInput>("fabric", &G::fabric, fabricTable(), resolveFabric, restoreFabric,
                              "what this garment is made of")
      .defaultsTo("the case's fabric")
      .custom(
          listOf("other_fabrics", fabricTable(), "what a material field chooses from"),
          [table = fabricTable()](const Entry& p, G& g) {
            readItems(p, "objects", [&](const Entry& item) {
              FabricInput in;
              readObject(table, item, &in);
              g.other_fabrics.push_back(resolveFabric(item, in));
            });
          },
          [table = fabricTable()](const G& g) -> std::optional<JsonNode> {
            if (g.other_fabrics.empty()) return std::nullopt;
            JsonNode list = emptyList();
            for (const FabricCase& f : g.other_fabrics) {
              const FabricInput in = restoreFabric(f);
              list.children.push_back(writeObject(table, &in));
            }
            return list;
          })
      .defaultsTo("none")
      .custom(
          listOf("fields", fieldsTable(FieldsOf::garment),
                 "thickness, fibre angle and material that vary over its patches; seams keep their springs"),
          [table = fieldsTable(FieldsOf::garment)](const Entry& p, G& g) {
            readItems(p, "objects", [&](const Entry& item) { readObject(table, item, &g.fields.emplace_back()); });
          },
          [table = fieldsTable(FieldsOf::garment)](const G& g) -> std::optional<JsonNode> {
            if (g.fields.empty()) return std::nullopt;
            JsonNode list = emptyList();
            for (const FieldsCase& f : g.fields) list.children.push_back(writeObject(table, &f));
            return list;
          })
      .defaultsTo("none")
      .custom(
          listOf("regions", regionsTable(),
                 "named parts of the garment, each with a factor on its thickness, which a study varies or optimises; "
                 "no two share cloth, and what is in none keeps its thickness"),
          [table = regionsTable()](const Entry& p, G& g) {
            readItems(p, "objects", [&](const Entry& item) { readObject(table, item, &g.regions.emplace_back()); });
          },
          [table = regionsTable()](const G& g) -> std::optional<JsonNode> {
            if (g.regions.empty()) return std::nullopt;
            JsonNode list = emptyList();
            for (const RegionCase& r : g.regions) list.children.push_back(writeObject(table, &r));
            return list;
          })
      .defaultsTo("none")
      .number("noise", &G::noise_m, "m", between(0, 0.1),
              "largest displacement along the normal, control point by control point (of a mesh: vertex by vertex), "
              "that the motion starts from; what is held stays, and the rest shape has none")
      .integer("noise_seed", &G::noise_seed, 0, 1000000000,
               "another seed gives other noise, the same on every machine");
  addSamplesAndSeams(table);
  return table
      .number("weft_angle", &G::weft_angle_rad, "rad", between(-3.2, 3.2),
              "turns the weft about the outward normal; at 0 it lies along u in a sheet or disc, lengthwise in a tube "
              "and in "
              "shorts")
      .object("stitching", &G::stitching, stitchingTable(),
              "virtual stitching: the panels start apart and springs along the seams close them; needs "
              "dressing.layer_by_layer")
      .defaultsTo("none: drafted sewn, put on by projecting")
      .check([](const Entry& p, G& g) {
        if (kindOf(g).isMesh() && !p.node.find("model")) g.cloth.kind = ClothKind::triangles;
      })
      .build();
}

}  // namespace gambeson::schema
