/// Detail of fields.hpp: the table of garments.

#include "cases/cloth/fabric_input.hpp"
#include "cases/cloth/fields.hpp"
#include "cases/cloth/kind_fields.hpp"
#include "cases/input/table.hpp"
#include "cases/wear/case/case.hpp"
#include "cases/wear/case/fields.hpp"

namespace gambeson::schema {
namespace {

Object sheetTable() {
  using S = SheetGarment;
  return Table<S>("Sheet")
      .number("width", &S::width_m, "m", aboveTo(0, 100), "length along axis_u")
      .required()
      .number("height", &S::height_m, "m", aboveTo(0, 100), "length along axis_v")
      .required()
      .integer("cells_u", &S::cells_u, 1, 1000, "cells along u; there are cells + degree control points")
      .integer("cells_v", &S::cells_v, 1, 1000, "cells along v")
      .integer("degree", &S::degree, 1, 5, "polynomial degree; 1 does not feel bending")
      .vector("corner", &S::corner, "m", between(-1e3, 1e3), "the corner u = v = 0 in the world")
      .direction("axis_u", &S::axis_u, "direction of u, the weft where weft_angle is 0")
      .direction("axis_v", &S::axis_v, "direction of v; at right angles to axis_u")
      .check([](const Place& p, const S& s) {
        if (!(std::abs(dot(s.axis_u, s.axis_v)) < 1e-6))
          p.failAt("axis_v", "is not at right angles to axis_u; allowed: 90 deg");
      })
      .build();
}

Object discTable() {
  using D = DiscGarment;
  return Table<D>("Disc")
      .number("radius", &D::radius_m, "m", aboveTo(0, 100), "radius")
      .required()
      .integer("cells", &D::cells, 2, 1000, "cells across the diameter; the rim cuts through the outer ones")
      .integer("degree", &D::degree, 2, 5, "polynomial degree")
      .vector("center", &D::center, "m", between(-1e3, 1e3), "centre in the world")
      .direction("axis_u", &D::axis_u, "direction of u through the centre, the weft where weft_angle is 0")
      .direction("axis_v", &D::axis_v, "direction of v through the centre; at right angles to axis_u")
      .check([](const Place& p, const D& d) {
        if (!(std::abs(dot(d.axis_u, d.axis_v)) < 1e-6))
          p.failAt("axis_v", "is not at right angles to axis_u; allowed: 90 deg");
      })
      .build();
}

Object tubeTable() {
  using T = TubeGarment;
  return Table<T>("Tube")
      .number("radius", &T::radius_m, "m", aboveTo(0, 10), "radius at rest")
      .required()
      .number("length", &T::length_m, "m", aboveTo(0, 100), "length")
      .required()
      .integer("cells_around", &T::cells_around, 3, 1000, "cells around, all patches together")
      .integer("cells_along", &T::cells_along, 1, 1000, "cells along")
      .integer("degree", &T::degree, 2, 5, "polynomial degree")
      .integer("patches", &T::patches, 1, 12, "equal patches around, joined lengthwise by seams")
      .vector("start", &T::start, "m", between(-1e3, 1e3), "centre of the first ring, the edge \"start\"")
      .direction("axis", &T::axis, "direction from the edge \"start\" to the edge \"end\"")
      .check([](const Place& p, const T& t) {
        if (t.cells_around % t.patches != 0)
          p.failAt("cells_around", "is not a multiple of patches; allowed: a multiple");
      })
      .build();
}

Object shortsTable() {
  using S = ShortsGarment;
  return Table<S>("Shorts")
      .number("inseam", &S::inseam_m, "m", between(0.08, 0.6), "length of the inner leg, crotch to hem, above the knee")
      .number("rise", &S::rise_m, "m", between(0.1, 0.5), "height of the waist edge above the crotch of the shorts")
      .number(
          "crotch_ease", &S::crotch_ease_m, "m", between(0, 0.08),
          "how far the crotch of the shorts lies under the body's: room for the thighs to rise without pulling at the "
          "waist; a longer rise keeps the waist edge where it was")
      .number("ease", &S::ease, "", between(0, 0.5), "how much wider than the body: girth = (1 + ease) body girth")
      .number("waist_ease", &S::waist_ease, "", between(0, 0.5),
              "ease of the waist edge, which goes over into the other within 12 cm below it; small under a belt")
      .defaultsTo("ease")
      .number("cell", &S::cell_m, "m", between(0.002, 0.1), "wanted size of a cell; smaller is finer and slower")
      .integer("degree", &S::degree, 2, 5, "polynomial degree")
      .build();
}

Object beltTable() {
  using B = BeltGarment;
  return Table<B>("Belt")
      .number("width", &B::width_m, "m", between(0.01, 0.2), "height of the band")
      .number("tension", &B::tension_N, "N", between(0, 100),
              "of the belt on the waist, over the garments before it: the whole belt presses 2 pi times as much. It is "
              "made shorter by the stretch at which it carries this")
      .number("below_waist", &B::below_waist_m, "m", between(-0.2, 0.2),
              "its upper edge below the edge \"waist\" of the garment under it")
      .number("cell", &B::cell_m, "m", between(0.002, 0.1), "wanted size of a cell; smaller is finer and slower")
      .integer("degree", &B::degree, 2, 5, "polynomial degree")
      .number("gap", &B::gap_m, "m", between(0, 0.02), "that it starts farther out than the layers under it ask for")
      .build();
}

Object shirtTable() {
  using S = ShirtGarment;
  return Table<S>("Shirt")
      .number("ease", &S::ease, "", between(0, 0.5), "how much wider than the body: girth = (1 + ease) body girth")
      .number("hem_above_waist", &S::hem_above_waist_m, "m", between(-0.1, 0.2),
              "lower edge above the edge \"waist\" of a garment under it")
      .number("top_below_shoulder", &S::top_below_shoulder_m, "m", between(-0.1, 0.2),
              "upper edges of front and back below the shoulder joints")
      .number("wrap_share", &S::wrap_share, "", between(0.1, 0.9), "height of the side wrap over that of the front")
      .number("front_share", &S::front_share, "", between(0.1, 0.9), "part of the girth that the front covers below")
      .number("strap_width", &S::strap_width_m, "m", between(0.01, 0.2), "width of a strap; there are four legs of it")
      .number("neck_share", &S::neck_share, "", between(0.1, 0.9),
              "distance between the straps over that of the shoulder joints, to whole cells")
      .number("neck_depth", &S::neck_depth_m, "m", between(0.01, 0.3), "of the neckline below the front's upper edge")
      .number("margin", &S::margin_m, "m", between(0, 0.1), "of the panels beside the straps, to whole cells")
      .number("belly_length", &S::belly_length_m, "m", between(0.02, 0.5), "of the belly protector")
      .number("belly_share", &S::belly_share, "", between(0.1, 0.9), "its width over that of the front")
      .number("cell", &S::cell_m, "m", between(0.002, 0.1), "wanted size of a cell; smaller is finer and slower")
      .integer("degree", &S::degree, 2, 5, "polynomial degree")
      .number("gap", &S::gap_m, "m", between(0, 0.02), "farther out than the layers under it ask for")
      .build();
}

Object skirtTable() {
  using S = SkirtGarment;
  return Table<S>("Skirt")
      .number("length", &S::length_m, "m", between(0.1, 1.2), "from the waist down")
      .number("ease", &S::ease, "", between(-0.3, 0.5),
              "how much wider than the body at the waist, and wider at least below; below 0: narrower, for cloth that "
              "stretches")
      .number("flare", &S::flare_rad, "rad", between(0, 1.2), "angle of its sides with the vertical")
      .integer("cells_around", &S::cells_around, 16, 1000, "of all eight panels; a multiple of 8")
      .integer("cells_along", &S::cells_along, 2, 1000, "from hem to waist")
      .integer("degree", &S::degree, 2, 5, "polynomial degree")
      .check([](const Place& p, const S& s) {
        if (s.cells_around % 8 != 0) p.failAt("cells_around", "is not a multiple of 8; allowed: a multiple");
      })
      .build();
}

Object meshFileTable() {
  using M = MeshGarment;
  return Table<M>("Mesh file")
      .path("path", &M::path,
            "an OBJ file, relative to the case's folder: groups are patches, lines of a group \"edge NAME PATCH\" are "
            "edges "
            "that supports may name; vertices at one place are one")
      .required()
      .choice("rest", &M::rest,
              std::vector<std::pair<std::string, MeshRest>>{
                  {"fabric", MeshRest::fabric}, {"shape", MeshRest::shape}, {"uv", MeshRest::flat}},
              "how the cloth lies without stress. fabric: as the mesh stands, its hinges flat unless the fabric's "
              "bending.rest is "
              "\"shape\", as a draft does; shape: as the mesh stands, its hinges with the mesh's angles (collars, "
              "pleats). In both "
              "uv turns the threads alone, weft where u grows. uv: flat, as the mesh's uv says")
      .number("unit", &M::unit_m, "m", between(1e-6, 1e3), "length of a unit of the file")
      .number("uv_unit", &M::uv_unit_m, "m", between(1e-6, 1e3),
              "length of a unit of uv, where the cloth lies as uv says")
      .build();
}

Object fileTable() {
  return Table<FileGarment>("Garment file")
      .path("path", &FileGarment::path, "file with patches and seams, relative to the case's folder")
      .required()
      .build();
}

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

}  // namespace

Object garmentTable() {
  using G = GarmentCase;
  return Table<G>("Garment")
      .text("name", &G::name, "what supports and tables call it; required where there are several garments")
      .alternative<SheetGarment>("sheet", &G::shape, sheetTable(), "a flat rectangle")
      .in("shape")
      .alternative<DiscGarment>("disc", &G::shape, discTable(), "a flat disc")
      .in("shape")
      .alternative<TubeGarment>("tube", &G::shape, tubeTable(), "a circular tube, a sleeve say")
      .in("shape")
      .alternative<ShortsGarment>("shorts", &G::shape, shortsTable(),
                                  "shorts of six patches drafted on the human of the case")
      .in("shape")
      .alternative<BeltGarment>("belt", &G::shape, beltTable(),
                                "a belt drafted on the human, over the garments before it")
      .in("shape")
      .alternative<ShirtGarment>("shirt", &G::shape, shirtTable(),
                                 "a shirt without sleeves of six patches (front, back, strap_left, strap_right, "
                                 "side_wrap, belly), drafted on the human over the garments before it")
      .in("shape")
      .alternative<SkirtGarment>("skirt", &G::shape, skirtTable(),
                                 "a flared skirt of eight panels drafted on the human")
      .in("shape")
      .alternative<FileGarment>("file", &G::shape, fileTable(), "a garment from a file")
      .in("shape")
      .alternative<MeshGarment>("mesh_file", &G::shape, meshFileTable(), "a garment of triangles from a mesh")
      .in("shape")
      .oneOf("shape", true)
      .choice(
          "model", [](auto& g) -> auto& { return g.cloth.kind; }, clothKinds(), clothKindDoc())
      .unwritten()
      .choice(
          "mesh", [](auto& g) -> auto& { return g.cloth.mesh; }, meshKinds(), meshKindDoc())
      .unwritten()
      .vector("position", &G::position_m, "m", between(-1e3, 1e3), "moves the shape from where it was made")
      .converted<FabricInput>("fabric", &G::fabric, fabricTable(), resolveFabric, restoreFabric,
                              "what this garment is made of")
      .defaultsTo("the case's fabric")
      .custom(
          listOf("other_fabrics", fabricTable(), "what a material field chooses from"),
          [table = fabricTable()](const Place& p, G& g) {
            if (p.node.type != JsonNode::Type::list) p.fail("expected a list [ ] of objects, not " + describe(p.node));
            for (std::size_t i = 0; i < p.node.children.size(); ++i) {
              FabricInput in;
              const Place item = p.item(i);
              readObject(table, item, &in);
              g.other_fabrics.push_back(resolveFabric(item, in));
            }
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
          [table = fieldsTable(FieldsOf::garment)](const Place& p, G& g) {
            if (p.node.type != JsonNode::Type::list) p.fail("expected a list [ ] of objects, not " + describe(p.node));
            for (std::size_t i = 0; i < p.node.children.size(); ++i)
              readObject(table, p.item(i), &g.fields.emplace_back());
          },
          [table = fieldsTable(FieldsOf::garment)](const G& g) -> std::optional<JsonNode> {
            if (g.fields.empty()) return std::nullopt;
            JsonNode list = emptyList();
            for (const FieldsCase& f : g.fields) list.children.push_back(writeObject(table, &f));
            return list;
          })
      .defaultsTo("none")
      .number("noise", &G::noise_m, "m", between(0, 0.1),
              "largest displacement along the normal, control point by control point, that the motion starts from; the "
              "rest shape has none")
      .integer("noise_seed", &G::noise_seed, 0, 1000000000,
               "another seed gives another pattern, the same on every machine")
      .integer(
          "samples_per_cell", &G::samples_per_cell, 0, 8,
          "contact samples along the edge of a cell; 0: one per control point (Greville points). All garments together "
          "have at most 40,000 cells and 160,000 samples")
      .number("seam_stiffness", &G::seam_stiffness_N, "N/rad", between(0, 1e4),
              "rotational spring of seams that meet at an angle: moment per length and angle")
      .number("weft_angle", &G::weft_angle_rad, "rad", between(-3.2, 3.2),
              "turns the weft about the outward normal; at 0 it lies along u in a sheet or disc, lengthwise in a tube "
              "and in "
              "shorts")
      .object("stitching", &G::stitching, stitchingTable(),
              "virtual stitching: the panels start apart and springs along the seams close them; needs "
              "dressing.layer_by_layer")
      .defaultsTo("none: drafted sewn, put on by projecting")
      .check([](const Place& p, G& g) {
        if (std::holds_alternative<MeshGarment>(g.shape) && !p.node.find("model")) g.cloth.kind = ClothKind::triangles;
      })
      .build();
}

}  // namespace gambeson::schema
