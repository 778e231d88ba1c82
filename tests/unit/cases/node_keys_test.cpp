/// Keys of cloth of springs and of the degenerated shell: what has no meaning is refused where it stands, and cases say
/// them again.

#include "cases/cloth/make_cloth.hpp"
#include "cases/kinds/any_case.hpp"
#include "cases/structure/build.hpp"
#include "cases/wear/case/case.hpp"
#include "core/cloth/springs/spring_cloth.hpp"
#include "unit/cases/malformed.hpp"

namespace gambeson {
namespace {

/// The example as cloth of springs, with these keys in the line of its weft.
std::string worn(const std::string& keys) {
  return replaced(example, "\"weft_angle\": \"45 deg\"", "\"weft_angle\": \"45 deg\", \"model\": \"springs\"" + keys);
}

TEST(SpringKeys, WornCasesRefuseWhatHasNoMeaning) {
  expectRefused(worn(R"(, "springs": {"structural": "500 N/m", "bending": "strips", "rigidity": "1e-6 N m"})"),
                {{"\"model\": \"springs\"", "\"model\": \"nurbs\"", 6, "garment.springs", "is for \"model\""},
                 {"\"model\": \"springs\"", "\"model\": \"triangles\"", 6, "garment.springs", "is for \"model\""},
                 {"\"model\": \"springs\"", "\"model\": \"spring\"", 6, "garment.model",
                  "allowed: nurbs, triangles, springs or shell"},
                 {"\"strips\"", "\"flexion\"", 6, "garment.springs.rigidity", "\"strips\""},
                 {"\"strips\"", "\"strip\"", 6, "garment.springs.bending", "allowed: flexion or strips"},
                 {"\"500 N/m\"", "0", 6, "garment.springs.structural", "> 0"},
                 {"\"500 N/m\"", "\"500 Pa\"", 6, "garment.springs.structural", ""},
                 {"\"500 N/m\"", "1e9", 6, "garment.springs.structural", "<= 10000000"},
                 {"\"1e-6 N m\"", "-1", 6, "garment.springs.rigidity", "> 0"}});
  for (const char* key : {"\"mesh\": \"single\"", "\"bending_elements\": \"hinge\"", "\"bending_spring\": 1",
                          "\"membrane_elements\": \"springs\"", "\"spring_stiffness\": 1"})
    expectRefused(worn(""),
                  {{"\"model\": \"springs\"", std::string("\"model\": \"springs\", ") + key, 6, "", "is for"}});
}

/// Man's springs remember nothing: the fabric's own laws are refused by the garment that cannot have them.
TEST(SpringKeys, FabricsThatAreMoreThanSpringsAreRefused) {
  expectRefused(worn(""), {{"\"young\": \"1.2 MPa\",", "\"young\": \"1.2 MPa\", \"shear_loop\": {\"hysteresis\": 1},",
                            6, "garment.model", "friction in shear"}});
}

TEST(SpringKeys, ACaseSaysThemAgain) {
  const Folder folder;
  const Case plain = readCase(folder.write("plain.json", worn("")));
  EXPECT_EQ(plain.garments[0].cloth.kind, ClothKind::springs);
  EXPECT_FALSE(plain.garments[0].cloth.springs);
  EXPECT_EQ(writeCase(plain).find("\"structural\""), std::string::npos);
  const Case given = readCase(folder.write(
      "given.json", worn(R"(, "springs": {"structural": "1 kN/m", "bending": "strips", "rigidity": 2e-6})")));
  const SpringNumbers expected{1000, 0, 0, Flexion::buckling, 2e-6};
  ASSERT_TRUE(given.garments[0].cloth.springs);
  EXPECT_EQ(*given.garments[0].cloth.springs, expected);
  const Case again = readRecordedCase(folder.write("again.json", writeCase(given)));
  EXPECT_EQ(*again.garments[0].cloth.springs, expected);
}

TEST(ShellKeys, WornCasesRefuseWhatHasNoMeaning) {
  const std::string linear =
      replaced(replaced(example, "\"law\": \"zheng\", ", "\"law\": \"linear\", \"rest\": \"shape\", "),
               ", \"kappa0\": \"30 1/m\"", "");
  const std::string shell =
      replaced(linear, "\"weft_angle\": \"45 deg\"",
               "\"weft_angle\": \"45 deg\", \"model\": \"shell\", \"shell\": {\"rule\": \"one_point\", "
               "\"shear_factor\": 1, \"rotary\": \"cell\"}");
  expectRefused(shell, {{"\"model\": \"shell\"", "\"model\": \"springs\"", 6, "garment.shell", "is for \"model\""},
                        {"one_point", "two_points", 6, "garment.shell.rule", "allowed: mitc4, one_point"},
                        {"\"shear_factor\": 1", "\"shear_factor\": 0", 6, "garment.shell.shear_factor", "> 0"},
                        {"\"cell\"", "true", 6, "garment.shell.rotary", "expected one of"}});
  const Folder folder;
  const Case given = readCase(folder.write("given.json", shell));
  const DegeneratedOptions expected{ShellRule::one_point, 1, RotaryInertia::cell};
  EXPECT_EQ(*given.garments[0].cloth.shell, expected);
  EXPECT_EQ(*readRecordedCase(folder.write("again.json", writeCase(given))).garments[0].cloth.shell, expected);
  // Cloth that remembers, in bending and in shear, and that is flat by itself.
  const std::string remembers =
      replaced(replaced(shell, "\"law\": \"linear\", \"rest\": \"shape\"", "\"law\": \"stop\", \"yield_moment\": 1e-5"),
               "\"young\": \"1.2 MPa\",", "\"young\": \"1.2 MPa\", \"shear_loop\": {\"rise\": 10},");
  EXPECT_EQ(readCase(folder.write("remembers.json", remembers)).garments[0].cloth.kind, ClothKind::shell);
}

constexpr const char* sheet = R"json({
  "kind": "dynamic", "name": "flag",
  "sheet": {
    "plate": {"width": 1, "height": 1}, "cells_u": 6, "cells_v": 6, "model": "springs",
    "springs": {"structural": 70, "shear": 30, "flexion": 5}
  },
  "material": {"isotropic": {"young": 1e6, "poisson": 0, "thickness": 1e-3, "density": 300}},
  "supports": [{"edge": "u0", "hold": "xyz"}],
  "loads": [{"gravity": [0, 0, -9.81]}],
  "solver": {"end": 0.1, "step": 1e-3}
}
)json";

TEST(SpringKeys, ASheetIsOfTheSpringsThatItsCaseGives) {
  const Folder folder;
  const auto c = std::get<StructureCase>(readAnyCase(folder.write("flag.json", sheet)));
  const std::unique_ptr<const Cloth> cloth = clothOf(c, sheetOf(c));
  const auto* springs = dynamic_cast<const SpringCloth*>(cloth.get());
  ASSERT_NE(springs, nullptr);
  EXPECT_EQ(springs->points(), 49);
  double most = 0;
  for (const PointSpring& s : springs->springs().springs) most = std::max(most, s.stiffness_N_per_m);
  EXPECT_EQ(most, 70);
  expectRefused(
      sheet,
      {{"\"cells_v\": 6,", "\"cells_v\": 6, \"trim\": [{\"circle\": {\"center\": [0.5, 0.5], \"radius\": 0.2}}],", 4,
        "sheet.model", "cannot be trimmed"},
       {"\"material\": {", "\"material\": {\"tension_field\": true, ", 4, "sheet.model", "tension field"}});
}

/// Of laws that other cloth has a degenerated shell lacks one.
TEST(ShellKeys, ASheetCarriesPressure) {
  const std::string shell =
      replaced(sheet, "\"model\": \"springs\",\n    \"springs\": {\"structural\": 70, \"shear\": 30, \"flexion\": 5}",
               "\"model\": \"shell\"");
  expectRefused(shell,
                {{"\"material\": {", "\"material\": {\"tension_field\": true, ", 4, "sheet.model", "tension field"}});
}

}  // namespace
}  // namespace gambeson
