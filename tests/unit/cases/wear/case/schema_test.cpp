/// The field table: what it reads, writes and says about itself is the same thing.

#include "cases/input/schema.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "cases/command/documents.hpp"
#include "cases/wear/case/case.hpp"
#include "cases/wear/case/fields.hpp"
#include "core/error.hpp"
#include "unit/cases/example.hpp"

namespace gambeson {
namespace {

using Json = nlohmann::json;

TEST(Case, FieldsArriveInSi) {
  const Folder folder;
  const Case c = readCase(folder.write("example.json", example));
  EXPECT_EQ(c.name, "example");
  const auto& sheet = std::get<SheetGarment>(c.garments[0].shape);
  EXPECT_DOUBLE_EQ(sheet.width_m, 0.4);
  EXPECT_EQ(sheet.axis_v, (Vec3{0, 1, 0}));  // made unit
  EXPECT_DOUBLE_EQ(c.garments[0].weft_angle_rad, std::numbers::pi / 4);
  EXPECT_DOUBLE_EQ(c.fabric.thickness_m, 1e-3);
  EXPECT_DOUBLE_EQ(c.fabric.young_weft_Pa, 1.2e6);
  EXPECT_DOUBLE_EQ(c.fabric.young_warp_Pa, 1.2e6);
  EXPECT_DOUBLE_EQ(c.fabric.shear_Pa, 1.2e6 / 2.6);  // isotropic: E / (2 (1 + nu))
  EXPECT_DOUBLE_EQ(givenRigidities(c.fabric.law)->weft_Nm, 7e-6);
  EXPECT_DOUBLE_EQ(std::get<ZhengBending>(c.fabric.law).kappa_regular_per_m, 1);
  EXPECT_EQ(c.human->manikin, "male_p50");
  EXPECT_EQ(std::get<WalkOptions>(c.human->motion).strides, 1);
  EXPECT_EQ(std::get<SphereObstacle>(c.obstacles[0].shape).segments, 9);
  EXPECT_DOUBLE_EQ(std::get<PlaneObstacle>(c.obstacles[1].shape).point_m.z, -0.01);
  EXPECT_DOUBLE_EQ(c.obstacles[1].velocity_m_per_s.z, 1e-3);
  EXPECT_EQ(std::get<FixedSupport>(c.supports[0]).edge.name, "u0");
  const EdgeCase& edge = std::get<SpringSupport>(c.supports[1]).edge;
  EXPECT_EQ(edge.name, "");
  EXPECT_EQ(edge.side, Side::v1);
  EXPECT_FALSE(c.contact.layer_m);  // the thickness
  EXPECT_TRUE(c.air.with_pelvis);
  EXPECT_DOUBLE_EQ(c.dressing.projecting->clearance_m, 5e-3);
  EXPECT_EQ(c.output.pictures->at(0).when, PictureTime::peak);
  EXPECT_EQ(c.output.pictures->at(1).when, PictureTime::at);
  EXPECT_EQ(c.output.pictures->at(1).view, View::back);
  EXPECT_EQ(c.analysis.counting, Counting::all_distal);
  EXPECT_FALSE(c.time.duration_s);
}

/// 10 us are 1e-5 s less an ulp.
TEST(Case, ABoundThatIsTypedInAUnitIsInItsRange) {
  const Folder folder;
  const std::string with = replaced(example, "\"frame\": \"20 ms\"", "\"frame\": \"20 ms\", \"window\": \"10 us\"");
  EXPECT_EQ(readCase(folder.write("example.json", with)).output.window_s, 1e-5);
  EXPECT_THROW(readCase(folder.write("a.json", replaced(with, "10 us", "9.999 us"))), InputError);
}

TEST(Case, EitherDensity) {
  const Folder folder;
  const Case c = readCase(folder.write(
      "example.json", replaced(example, "\"density\": \"436 kg/m^3\"", "\"surface_density\": \"144 gsm\"")));
  EXPECT_DOUBLE_EQ(c.fabric.surfaceDensity(), 0.144);
}

TEST(Case, OrthotropicCloth) {
  const Folder folder;
  const std::string text = replaced(example, "\"young\": \"1.2 MPa\"",
                                    "\"young_weft\": \"1 MPa\", \"young_warp\": \"4 MPa\", \"shear\": \"10 kPa\"");
  const Case c = readCase(folder.write("example.json", text));
  EXPECT_EQ(c.fabric.young_warp_Pa, 4e6);
  EXPECT_EQ(c.fabric.shear_Pa, 1e4);
  // d1 d2 - d3^2 > 0 of Zheng 2013, eq. 2.13, needs nu_12^2 E2 < E1: here nu < 1/2.
  EXPECT_NO_THROW(readCase(folder.write("a.json", replaced(text, "\"poisson\": 0.3", "\"poisson\": 0.499"))));
  EXPECT_THROW(readCase(folder.write("b.json", replaced(text, "\"poisson\": 0.3", "\"poisson\": 0.5"))), InputError);
}

TEST(Case, WrittenAndReadAgainIsTheSame) {
  const Folder folder;
  std::vector<std::filesystem::path> files{folder.write("example.json", example)};
  for (const char* name : {"shorts_walk", "sleeve_flex", "inclined_plane", "sphere_drape", "flag", "wong_ball",
                           "wong_funnel", "wong_dancer"})
    files.push_back(std::filesystem::path(GAMBESON_SOURCE_DIR) / "cases/library" / (std::string(name) + ".json"));
  for (const std::filesystem::path& file : files) {
    SCOPED_TRACE(file);
    const std::string written = writeCase(readCase(file));
    EXPECT_EQ(writeCase(readCase(folder.write("again.json", written))), written);
  }
}

TEST(Case, LibraryHoldsTheNumbersOfTheTheses) {
  const std::filesystem::path library = std::filesystem::path(GAMBESON_SOURCE_DIR) / "cases/library";
  const Case plane = readCase(library / "inclined_plane.json");
  // Zheng 2013, section 3.7.1: static pressure 1.2217 Pa on 30 degrees.
  const double cos30 = std::get<PlaneObstacle>(plane.obstacles[0].shape).normal.z;
  EXPECT_NEAR(plane.fabric.surfaceDensity() * 9.8 * cos30, 1.2217, 5e-5);
  // The sheet starts 0.1 m above the slope, parallel to it.
  const auto& sheet = std::get<SheetGarment>(plane.garments[0].shape);
  const Vec3 normal = std::get<PlaneObstacle>(plane.obstacles[0].shape).normal;
  EXPECT_NEAR(dot(sheet.corner, normal), 0.1, 1e-9);
  EXPECT_NEAR(dot(sheet.axis_u, normal), 0, 1e-9);
  EXPECT_NEAR(dot(cross(sheet.axis_u, sheet.axis_v), normal), 1, 1e-9);
  // Section 3.7.2: 1,156 control points, 2,048 triangles, weight 0.226 N.
  const Case drape = readCase(library / "sphere_drape.json");
  const auto& cloth = std::get<SheetGarment>(drape.garments[0].shape);
  EXPECT_EQ((cloth.cells_u + cloth.degree) * (cloth.cells_v + cloth.degree), 1156);
  const auto& sphere = std::get<SphereObstacle>(drape.obstacles[0].shape);
  EXPECT_EQ(2 * sphere.segments * (sphere.rings - 1), 2048);
  EXPECT_NEAR(drape.fabric.surfaceDensity() * cloth.width_m * cloth.height_m * 9.81, 0.226, 5e-4);
  // Man 2006, section 5.3.
  const Case sleeve = readCase(library / "sleeve_flex.json");
  EXPECT_DOUBLE_EQ(std::get<TubeGarment>(sleeve.garments[0].shape).radius_m, 0.06);
  EXPECT_DOUBLE_EQ(sleeve.fabric.shear_Pa, 1e5);
  EXPECT_DOUBLE_EQ(givenRigidities(sleeve.fabric.law)->weft_Nm, 1.2e6 * 1e-9 / 12);
  // Zheng 2013, section 6.2.
  const Case shorts = readCase(library / "shorts_walk.json");
  EXPECT_DOUBLE_EQ(shorts.fabric.surfaceDensity(), 1440 * 0.762e-3);
  EXPECT_DOUBLE_EQ(givenRigidities(shorts.fabric.law)->warp_Nm, 0.00371);
  EXPECT_DOUBLE_EQ(shorts.air.drag_kg_per_m2s, 4);
}

TEST(Case, IdentityFollowsWhatMatters) {
  const Folder folder;
  const std::filesystem::path library = std::filesystem::path(GAMBESON_SOURCE_DIR) / "cases/library";
  for (const char* name : {"arm.urdf", "arm_body.json", "arm_flex.csv", "sleeve_flex.json"})
    std::filesystem::copy_file(library / name, folder.path() / name);
  const std::string here = caseIdentity(readCase(library / "sleeve_flex.json"));
  EXPECT_EQ(here, caseIdentity(readCase(folder.path() / "sleeve_flex.json")));  // moved, the same
  EXPECT_NE(here, caseIdentity(readCase(library / "sleeve_flex.json", {"contact.friction=0.5"})));
  std::ofstream(folder.path() / "arm_flex.csv", std::ios::app) << "1.10,0,0,0,1\n";
  EXPECT_NE(here, caseIdentity(readCase(folder.path() / "sleeve_flex.json")));
}

TEST(Case, MeshesOfAUrdfArePartOfItsIdentity) {
  const Folder folder;
  const std::filesystem::path library = std::filesystem::path(GAMBESON_SOURCE_DIR) / "cases/library";
  for (const char* name : {"arm_body.json", "arm_flex.csv", "sleeve_flex.json"})
    std::filesystem::copy_file(library / name, folder.path() / name);
  std::ifstream in(library / "arm.urdf");
  std::string urdf{std::istreambuf_iterator<char>(in), {}};
  const std::string link = "<link name=\"forearm\"/>";
  const std::size_t at = urdf.find(link);
  ASSERT_NE(at, std::string::npos);
  urdf.replace(at, link.size(),
               "<link name=\"forearm\"><visual><geometry><mesh filename=\"hull.obj\"/></geometry></visual></link>");
  folder.write("arm.urdf", urdf);
  const auto identity = [&](const char* top) {
    folder.write("hull.obj",
                 std::string("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 ") + top + "\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    return caseIdentity(readCase(folder.path() / "sleeve_flex.json"));
  };
  const std::string one = identity("1");
  EXPECT_EQ(identity("1"), one);
  EXPECT_NE(identity("1.1"), one);
}

TEST(Case, LimitsOfStrainAreOfTheFabric) {
  const Folder folder;
  const auto read = [&](const std::string& limits) {
    return readCase(
        folder.write("example.json", replaced(example, "\"poisson\": 0.3,", "\"poisson\": 0.3, " + limits)));
  };
  EXPECT_FALSE(read("").fabric.limit_strain_weft);
  const Case both = read("\"limit_strain\": \"15 %\",");
  EXPECT_DOUBLE_EQ(*both.fabric.limit_strain_weft, 0.15);
  EXPECT_DOUBLE_EQ(*both.fabric.limit_strain_warp, 0.15);
  const Case weft = read("\"limit_strain_weft\": 0.1,");
  EXPECT_DOUBLE_EQ(*weft.fabric.limit_strain_weft, 0.1);
  EXPECT_FALSE(weft.fabric.limit_strain_warp);
  EXPECT_EQ(readCase(folder.write("again.json", writeCase(weft))).fabric, weft.fabric);
  // What is not stated leaves recordings from before as they are.
  EXPECT_EQ(writeCase(read("")).find("limit_strain"), std::string::npos);
  EXPECT_THROW(read("\"limit_strain\": 0.1, \"limit_strain_warp\": 0.2,"), InputError);
  EXPECT_THROW(read("\"limit_strain\": 0,"), InputError);
}

/// Torques of a motion are compared with its own natural moments, unless the case says otherwise.
TEST(Case, TheTaskFollowsFromTheMotion) {
  const std::filesystem::path library = std::filesystem::path(GAMBESON_SOURCE_DIR) / "cases/library";
  const std::string shorts = (library / "shorts_walk.json").string();
  const auto task = [&](const std::string& motion, const std::string& said = "") {
    std::vector<std::string> set{"human.motion=" + motion, "analysis={\"counting\": \"all_distal\"" + said + "}",
                                 "air.velocity=[0, 0, 0]"};
    return readCase(shorts, set).analysis.task;
  };
  EXPECT_EQ(task(R"({"walk": {"strides": 1}})"), Task::natural_walk);
  EXPECT_EQ(task(R"({"stairs": {"strides": 2}})"), Task::natural_stairs);
  EXPECT_EQ(task(R"({"aim": {"duration": "1.5 s", "rifle": "3.5 kg"}})"), Task::aiming);
  EXPECT_EQ(task(R"({"stand": {"duration": "1 s"}})"), Task::none);
  EXPECT_EQ(task(R"({"walk": {"strides": 1}})", ", \"task\": \"none\""), Task::none);
}

/// Calls f(object, path) for an object of the table and all below it.
template <class F>
void forObjects(const schema::Object& object, const std::string& path, F f) {
  f(object, path);
  for (const schema::Field& field : object.fields)
    if (field.object) forObjects(*field.object, path + "." + field.key, f);
}

TEST(Table, EveryFieldIsDocumented) {
  forObjects(schema::caseTable(), "", [](const schema::Object& object, const std::string& path) {
    EXPECT_FALSE(object.title.empty()) << path;
    for (const schema::Field& f : object.fields) {
      SCOPED_TRACE(path + "." + f.key);
      EXPECT_GE(f.doc.size(), 4u);
      EXPECT_EQ(f.doc.find('|'), std::string::npos);  // would break the tables
      EXPECT_EQ(f.key.find_first_not_of("abcdefghijklmnopqrstuvwxyz_0123456789"), std::string::npos);
      const bool numeric = f.kind == schema::Kind::number || f.kind == schema::Kind::integer;
      EXPECT_TRUE(!numeric || f.range.text() != "any");
      if (numeric && f.default_value && f.default_value->type == JsonNode::Type::number) {
        EXPECT_TRUE(f.range.contains(f.default_value->number));
      }
    }
  });
}

/// The default that the documentation shows is the one that a case without the field gets.
TEST(Table, DefaultsDocumentedAreDefaultsUsed) {
  const Folder folder;
  const Case c =
      readCase(folder.write("minimal.json", R"({"name": "minimal", "garment": {"sheet": {"width": 1, "height": 1}},
    "fabric": {"thickness": 0.001, "density": 400, "young": 1e6, "bending": {"rigidity": 1e-5, "kappa0": 30}}, "time": {"duration": 1}})"));
  const Json written = Json::parse(writeCase(c));
  int compared = 0;
  forObjects(schema::caseTable(), "", [&](const schema::Object& object, const std::string& path) {
    std::string pointer = path;
    std::replace(pointer.begin(), pointer.end(), '.', '/');
    if (!written.contains(Json::json_pointer(pointer))) return;
    const Json& values = written.at(Json::json_pointer(pointer));
    if (!values.is_object()) return;  // a list, or a number in place of an object
    for (const schema::Field& f : object.fields) {
      // Without a human a garment does not settle: that default depends on the case and says so.
      if (!f.default_value || path + "." + f.key == ".dressing.settle") continue;
      SCOPED_TRACE(path + "." + f.key);
      ASSERT_TRUE(values.contains(f.key));
      EXPECT_EQ(values.at(f.key), Json::parse(schema::toText(*f.default_value)));
      ++compared;
    }
  });
  EXPECT_GT(compared, 25);
}

TEST(Table, JsonSchemaListsEveryField) {
  const Json s = Json::parse(schema::jsonSchema(schema::caseTable()));
  std::function<void(const schema::Object&, const Json&)> compare = [&](const schema::Object& object,
                                                                        const Json& node) {
    EXPECT_EQ(node.at("additionalProperties"), false);
    EXPECT_EQ(node.at("properties").size(), object.fields.size() + node.at("properties").contains("$schema"));
    const Json required = node.value("required", Json::array());
    for (const schema::Field& f : object.fields) {
      SCOPED_TRACE(f.key);
      const Json& p = node.at("properties").at(f.key);
      EXPECT_NE(p.at("description").get<std::string>().find(f.doc), std::string::npos);
      EXPECT_EQ(std::count(required.begin(), required.end(), f.key), f.required ? 1 : 0);
      if (f.object)
        compare(*f.object, f.kind == schema::Kind::list ? p.at("items")
                           : f.kind == schema::Kind::number_or_object || f.kind == schema::Kind::word_or_object
                               ? p.at("anyOf").at(1)
                               : p);
    }
  };
  compare(schema::caseTable(), s);
}

TEST(Table, DocumentationInTheSourcesIsUpToDate) {
  std::ifstream file(std::filesystem::path(GAMBESON_SOURCE_DIR) / "cases/FIELDS.md");
  ASSERT_TRUE(file);
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_EQ(text.str(), caseFields()) << "write it again: gambeson check --doc > cases/FIELDS.md";
}

TEST(Table, RangesSayWhatTheyAllow) {
  EXPECT_EQ(schema::above(0).text("m"), "> 0 m");
  EXPECT_EQ(schema::aboveTo(0, 0.5).text("s"), "> 0 and <= 0.5 s");
  EXPECT_EQ(schema::between(-1, 1).text(), ">= -1 and <= 1");
  EXPECT_EQ(schema::any().text("m"), "any");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const schema::Range& r : {schema::any(), schema::above(0), schema::between(0, 1)}) EXPECT_FALSE(r.contains(nan));
  EXPECT_FALSE(schema::above(0).contains(0));
  EXPECT_TRUE(schema::atLeast(0).contains(0));
  EXPECT_TRUE(schema::aboveTo(0, 1).contains(1));
}

TEST(Table, SuggestionsAreClose) {
  const std::vector<std::string> words{"thickness", "density", "young", "law"};
  EXPECT_EQ(schema::closest("thickenss", words), "thickness");
  EXPECT_EQ(schema::closest("yuong", words), "young");
  EXPECT_EQ(schema::closest("colour", words), "");
  const std::vector<std::string> fabric{"surface_density", "young", "young_weft", "poisson", "bending"};
  EXPECT_EQ(schema::closest("weight", fabric), "surface_density");
  EXPECT_EQ(schema::closest("young_modulus", fabric), "young");
  EXPECT_EQ(schema::closest("youngs_modulus", fabric), "young");
  EXPECT_EQ(schema::closest("young_weft_modulus", fabric), "young_weft");
  EXPECT_EQ(schema::closest("poisson_ratio", fabric), "poisson");
  EXPECT_EQ(schema::closest("weight", words), "") << "where there is no such key";
  EXPECT_EQ(schema::closest("x", words), "");
  EXPECT_EQ(schema::closest(std::string(1 << 16, 'x'), words), "");
}

}  // namespace
}  // namespace gambeson
