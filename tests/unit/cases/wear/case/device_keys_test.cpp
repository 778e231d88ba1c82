/// Every key of a worn case is carried by the steps on a device, or refused by name.

#include "cases/wear/case/device_keys.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <sstream>

#include "cases/input/schema.hpp"
#include "cases/wear/case/fields.hpp"
#include "core/error.hpp"
#include "unit/cases/cloth/small_law.hpp"
#include "unit/cases/example.hpp"

namespace gambeson {
namespace {

/// Keys by the title of their table, with blanks between them.
using Keys = std::map<std::string, std::string>;

// A key that is new stands in none of these lists, and the first test fails until somebody has decided: does the step
// on a device do what the key asks for (gpu/step), or does requireCarried refuse it?

/// What the steps carry, or never see: a device knows the model that is made of these.
const Keys carried{
    {"Case",
     "kind name description gravity garment garments fabric human obstacles supports contact air "
     "factors dressing time output analysis comfort"},
    {"Garment",
     "name sheet disc tube shorts trousers belt shirt skirt file friction position fabric other_fabrics "
     "fields regions noise noise_seed samples_per_cell seam_stiffness weft_angle stitching"},
    {"Sheet", "width height cells_u cells_v degree corner axis_u axis_v"},
    {"Disc", "radius cells degree center axis_u axis_v"},
    {"Tube", "radius length cells_around cells_along degree patches start axis"},
    {"Shorts", "inseam rise crotch_ease ease waist_ease cell degree"},
    {"Trousers", "ease rise crotch_ease hem cell degree"},
    {"Belt", "width tension below_waist cell degree gap"},
    {"Shirt",
     "ease hem_above_waist top_below_shoulder wrap_share front_share strap_width neck_share "
     "neck_depth margin belly_length belly_share cell degree gap sleeve_length sleeve_ease sleeve_hem_ease"},
    {"Skirt", "length ease flare cells_around cells_along degree"},
    {"Garment file", "path"},
    {"Friction", "kinetic"},
    {"Fabric",
     "card name thickness thickness_assumed density surface_density young young_weft young_warp shear poisson "
     "stiffness stiffness_weft stiffness_warp shear_stiffness "
     "jam_area limit_strain limit_strain_weft limit_strain_warp bending"},
    {"Bending",
     "law rigidity rigidity_weft rigidity_warp kappa0 regular_curvature yield_moment loop twist "
     "rest"},
    {"Loop of bending",
     "axes shape initial_rigidity initial_rigidity_weft initial_rigidity_warp "
     "initial_rigidity_twist friction_curvature friction_curvature_weft friction_curvature_warp "
     "friction_curvature_twist c1 hysteresis hysteresis_weft hysteresis_warp hysteresis_at virgin "
     "stops set fatigue cycle set_by recovery recovery_time"},
    {"Fields over a patch", "patch thickness fibre_angle material"},
    {"Region of a garment", "name parts thickness"},
    {"Part of a region", "patch u v"},
    {"Thickness field", "degree values"},
    {"Fibre angle field", "degree values"},
    {"Material field", "degree values"},
    {"Stitching", "offset stiffness damping close within"},
    {"Human", "manikin urdf character scan segments body skin motion"},
    {"Manikin by measures", "sex stature mass chest waist hip inseam"},
    {"Body scan", "file height up facing close_holes like bridge_folds mass"},
    {"Segment between markers", "name upper_joint lower_joint marker semi_axes"},
    {"Character", "file skeleton weights targets map like height bridge_folds mass"},
    {"Morph target", "file share"},
    {"Skin", "cell crease_gap"},
    {"Motion", "stand walk stairs aim trajectory file sit kneel step_over markers"},
    {"Recorded markers", "path forward up from to"},
    {"Standing", "duration"},
    {"Walking", "stand lead_in strides paces stride_time"},
    {"Climbing stairs", "stand lead_in strides lead_in_strides stride_time"},
    {"Taking aim", "stand duration hold rifle"},
    {"Kneeling", "stand duration hold rise"},
    {"Stepping over an obstacle", "stand before after height depth clearance stride_time"},
    {"Trajectory", "file"},
    {"Recorded motion",
     "path model map from to stand lead_in repeat slower scale floor forward up heading travel "
     "hips_apart arms_apart"},
    {"Sitting down", "stand duration seat_height repeats"},
    {"Obstacle", "name ellipsoid sphere plane torus mesh hurdle sequence velocity drive friction"},
    {"Ellipsoid", "semi_axes center"},
    {"Sphere", "radius center rings segments"},
    {"Plane", "point normal size"},
    {"Torus", "radius tube center axis segments rings"},
    {"Mesh", "file scale position"},
    {"Hurdle", "width"},
    {"Sequence of meshes", "folder rate scale begin forward up"},
    {"Drive", "velocity spin axis center"},
    {"Support", "fixed springs pinned patch"},
    {"Fixed edge", "garment edge rows release"},
    {"Springs", "garment edge stiffness link"},
    {"Pinned point", "garment patch s t release"},
    {"Held patch", "garment patch release"},
    {"Contact", "layer friction friction_cloth self relaxation compliance tolerance max_iterations"},
    {"Air", "drag velocity"},
    {"Factors", "thickness bending membrane weight inertia drag friction"},
    {"Dressing", "projecting layer_by_layer from history settle"},
    {"Projecting", "clearance grow"},
    {"Time", "duration step_safety max_step step"},
    {"Output", "window frame checkpoint pictures viewer"},
    {"Picture", "time field view around width height"},
    {"Analysis", "joints counting task"},
    {"Comfort", "shoulder chest waist hips thigh arm other wear sensor effort_amber effort_red"},
    {"Comfort limit", "amber red peak"},
};

/// What says nothing without a key that is refused.
const Keys with_refused{
    {"Garment",
     "mesh bending_elements bending_spring membrane_elements spring_stiffness weft_stiffness "
     "warp_stiffness shear_stiffness stretch_damping shear_damping mesh_file springs shell"},
    {"Springs of cloth", "structural shear bending flexion rigidity"},
    {"Degenerated shell", "rule shear_factor rotary"},
    {"Mesh file", "path rest unit uv_unit"},
    {"Garment of a pattern", "path cell degree close_within seams"},
    {"Edit of a pattern's seam", "seam remove a b use open buttons stiffness rest_angle"},
    {"Feet left out", "back grow"},
    {"Cord", "garment edge tension from draw"},
    {"Friction", "stribeck_speed stribeck_power viscous_power pressure"},
    {"Law of a fabric", "table cell yarns values curves rest"},
    {"Curves of a law", "weft warp shear rigidity_weft rigidity_warp twist"},
    {"Loop of shear", "hysteresis hysteresis_5 friction_angle rise growth"},
    {"Contact", "penalty"},
    {"Strain limit", "mode limit tolerance stiffness max_projections points method"},
    {"Time", "substeps solve_tolerance"},
};

/// A value of a key that is refused, as --set has it.
struct Refused {
  std::string table, key, set;
  std::string where;  ///< the key that is named
};
const std::vector<Refused> refused{
    {"Case", "strain_limit", R"(strain_limit={"mode": "upper_limit", "limit": 0.01})", "strain_limit"},
    {"Human", "feet", R"(human={"manikin": "male_p50", "motion": {"stand": {}}, "feet": {}})", "human.feet"},
    {"Garment", "model", "garment.model=triangles", "garment.model"},
    {"Garment", "pattern",
     R"(garment={"pattern": {"path": ")" GAMBESON_SOURCE_DIR R"(/cases/library/garments/skirt_of_two_panels.json"}})",
     "garment.pattern"},
    {"Fabric", "shear_loop", R"(fabric.shear_loop={"hysteresis": 1})", "fabric.shear_loop"},
    {"Fabric", "law", R"(fabric={"thickness": 0.001, "density": 436, "law": {"values": )" + small_law + "}}",
     "fabric.law"},
    {"Friction", "static", R"(contact.friction={"kinetic": 0.2, "static": 0.3})", "contact.friction"},
    {"Friction", "viscosity", R"(garment.friction={"kinetic": 0.2, "viscosity": 1})", "garment.friction"},
    {"Friction", "pressure_power", R"(contact.friction_cloth={"kinetic": 0.2, "pressure": 100, "pressure_power": 0.8})",
     "contact.friction_cloth"},
    {"Friction", "along_warp", R"(obstacles[0].friction={"kinetic": 0.2, "along_warp": 2})", "obstacles[0].friction"},
    {"Fixed edge", "drive", R"(supports=[{"fixed": {"edge": "u0", "drive": {"velocity": [[0, 0, 0, 1]]}}}])",
     "supports[0].fixed.drive"},
    {"Pinned point", "drive", R"(supports=[{"pinned": {"s": 0, "drive": {"velocity": [[0, 0, 0, 1]]}}}])",
     "supports[0].pinned.drive"},
    {"Held patch", "drive", R"(supports=[{"patch": {"drive": {"velocity": [[0, 0, 0, 1]]}}}])",
     "supports[0].patch.drive"},
    {"Support", "cord", R"(supports=[{"cord": {"edge": "u0"}}])", "supports[0].cord"},
    {"Contact", "method", "contact.method=forward_increment", "contact.method"},
    {"Contact", "newton", "contact.newton=true", "contact.newton"},
    {"Time", "scheme", "time.scheme=rk4", "time.scheme"},
    {"Time", "audit", "time.audit=true", "time.audit"},
};

const char* const plain = R"json({
  "name": "plain",
  "garment": {"sheet": {"width": 0.4, "height": 0.4, "cells_u": 8, "cells_v": 8}},
  "fabric": {"thickness": "1 mm", "density": 436, "young": "1.2 MPa", "poisson": 0.3,
             "bending": {"law": "zheng", "rigidity": "7e-6 N m", "kappa0": "30 1/m"}},
  "obstacles": [{"name": "ball", "sphere": {"radius": "10 cm"}}],
  "contact": {"friction": 0.3},
  "time": {"duration": 1}
})json";

/// Every table below `object` and its keys.
void collect(const schema::Object& object, std::map<std::string, std::set<std::string>>& all) {
  std::set<std::string>& keys = all[object.title];
  for (const schema::Field& field : object.fields) {
    keys.insert(field.key);
    if (field.object) collect(*field.object, all);
  }
}

TEST(DeviceKeys, EveryKeyIsCarriedOrRefused) {
  std::map<std::string, std::set<std::string>> keys;
  collect(schema::caseTable(), keys);
  std::map<std::pair<std::string, std::string>, int> listed;
  for (const Keys* list : {&carried, &with_refused})
    for (const auto& [table, words] : *list) {
      std::istringstream stream(words);
      std::string key;
      while (stream >> key) ++listed[{table, key}];
    }
  for (const Refused& r : refused) ++listed[{r.table, r.key}];
  for (const auto& [table, all] : keys)
    for (const std::string& key : all)
      EXPECT_EQ((listed[{table, key}]), 1)
          << "\"" << key << "\" of the table \"" << table << "\" stands in no list of this test, or in several";
  for (const auto& [place, count] : listed)
    EXPECT_TRUE(keys[place.first].contains(place.second)) << place.first << " has no key " << place.second;
}

TEST(DeviceKeys, WhatIsRefusedIsNamed) {
  const Folder folder;
  const std::filesystem::path file = folder.write("plain.json", plain);
  for (const DeviceKind device : {DeviceKind::cpu, DeviceKind::reference, DeviceKind::cuda})
    EXPECT_NO_THROW(requireCarried(readCase(file), device));
  for (const Refused& r : refused) {
    SCOPED_TRACE(r.set);
    const Case c = readCase(file, {r.set});
    EXPECT_NO_THROW(requireCarried(c, DeviceKind::cpu));
    for (const DeviceKind device : {DeviceKind::reference, DeviceKind::cuda}) try {
        requireCarried(c, device);
        ADD_FAILURE() << "accepted";
      } catch (const InputError& e) {
        EXPECT_EQ(e.where().file, "command line") << e.what();
        EXPECT_EQ(e.where().key, r.where) << e.what();
        EXPECT_NE(e.reason().find("--device " + wordOf(device)), std::string::npos) << e.what();
        EXPECT_NE(e.reason().find("--device cpu"), std::string::npos) << e.what();
      }
  }
}

TEST(DeviceKeys, TheLineOfTheFileIsNamed) {
  const Folder folder;
  const std::filesystem::path file =
      folder.write("plain.json", replaced(plain, "\"time\": {", "\"time\": {\n    \"scheme\": \"rk4\", "));
  try {
    requireCarried(readCase(file), DeviceKind::reference);
    ADD_FAILURE() << "accepted";
  } catch (const InputError& e) {
    EXPECT_EQ(e.where().file, file.string());
    EXPECT_EQ(e.where().line, 9);
    EXPECT_EQ(e.where().key, "time.scheme");
  }
}

/// Cloth with a fabric of its own, in a list of garments.
TEST(DeviceKeys, GarmentsAreLookedAtOneByOne) {
  const Folder folder;
  const std::string sheet = R"({"name": "NAME", "sheet": {"width": 0.4, "height": 0.4, "cells_u": 8, "cells_v": 8}})";
  for (const std::string model : {"triangles", "springs", "shell"}) {
    const std::string both =
        replaced(plain, R"("garment": {"sheet": {"width": 0.4, "height": 0.4, "cells_u": 8, "cells_v": 8}})",
                 "\"garments\": [" + replaced(sheet, "NAME", "a") + ", " +
                     replaced(replaced(sheet, "NAME", "b"), "}}", "}, \"model\": \"" + model + "\"}") + "]");
    try {
      requireCarried(readCase(folder.write("both.json", both)), DeviceKind::cuda);
      ADD_FAILURE() << "accepted " << model;
    } catch (const InputError& e) {
      EXPECT_EQ(e.where().key, "garments[1].model") << e.what();
      EXPECT_NE(e.reason().find(model), std::string::npos) << e.what();
    }
  }
}

}  // namespace
}  // namespace gambeson
