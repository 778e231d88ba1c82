/// Keys of the membrane of triangles: each without a meaning is refused where it stands, and none is written unasked.

#include "cases/kinds/any_case.hpp"
#include "cases/wear/case/case.hpp"
#include "unit/cases/malformed.hpp"

namespace gambeson {
namespace {

/// The example as cloth of triangles, with these keys in the line of its weft.
std::string worn(const std::string& keys) {
  return replaced(example, "\"weft_angle\": \"45 deg\"", "\"weft_angle\": \"45 deg\", \"model\": \"triangles\"" + keys);
}

TEST(MembraneKeys, WornCasesRefuseWhatHasNoMeaning) {
  const std::string springs =
      R"(, "membrane_elements": "springs", "spring_stiffness": "500 N/m", "stretch_damping": 0.1)";
  expectRefused(
      worn(springs),
      {{"\"springs\", \"spring", "\"spring\", \"spring", 6, "garment.membrane_elements",
        "allowed: continuum, springs or baraff_witkin"},
       {"\"model\": \"triangles\"", "\"model\": \"nurbs\"", 6, "garment.membrane_elements", "is for \"model\""},
       {"\"springs\", \"spring", "\"continuum\", \"spring", 6, "garment.spring_stiffness", "\"springs\""},
       {"\"springs\", \"spring", "\"baraff_witkin\", \"spring", 6, "garment.spring_stiffness", "\"springs\""},
       {"\"spring_stiffness\"", "\"weft_stiffness\"", 6, "garment.weft_stiffness", "\"baraff_witkin\""},
       {"\"spring_stiffness\"", "\"shear_damping\"", 6, "garment.shear_damping", ""},
       {"\"500 N/m\"", "0", 6, "garment.spring_stiffness", "> 0"},
       {"\"500 N/m\"", "\"500 N/m^2\"", 6, "garment.spring_stiffness", ""},
       {"\"500 N/m\"", "1e9", 6, "garment.spring_stiffness", "<= 10000000"},
       {"\"stretch_damping\": 0.1", "\"stretch_damping\": -0.1", 6, "garment.stretch_damping", "> 0"}});
}

TEST(MembraneKeys, ACaseSaysThemAgain) {
  const Folder folder;
  const Case plain = readCase(folder.write("plain.json", worn("")));
  EXPECT_EQ(plain.garments[0].cloth.membrane, MembraneModel{});
  const std::string keys =
      R"(, "membrane_elements": "baraff_witkin", "weft_stiffness": "1 kN/m", "shear_damping": 0.2)";
  const Case threads = readCase(folder.write("threads.json", worn(keys)));
  const MembraneModel& m = threads.garments[0].cloth.membrane;
  EXPECT_EQ(m.elements, MembraneElements::baraff_witkin);
  EXPECT_EQ(m.weft_N_per_m, 1000);
  EXPECT_EQ(m.warp_N_per_m, 0);
  EXPECT_EQ(m.shear_damping_Ns_per_m, 0.2);
  const Case again = readRecordedCase(folder.write("again.json", writeCase(threads)));
  EXPECT_EQ(again.garments[0].cloth.membrane, m);
  for (const char* key : {"membrane_elements", "spring_stiffness", "weft_stiffness", "stretch_damping"})
    EXPECT_EQ(writeCase(plain).find(key), std::string::npos) << key;
}

constexpr const char* sheet = R"json({
  "kind": "dynamic", "name": "flag",
  "sheet": {
    "plate": {"width": 1, "height": 1}, "cells_u": 2, "cells_v": 2, "model": "triangles",
    "membrane_elements": "baraff_witkin",
    "stretch_damping": 0.1
  },
  "material": {"isotropic": {"young": 1e6, "poisson": 0, "thickness": 1e-3, "density": 300}},
  "supports": [{"edge": "u0", "hold": "xyz"}],
  "loads": [{"gravity": [0, 0, -9.81]}],
  "solver": {"end": 0.1, "step": 1e-3}
}
)json";

TEST(MembraneKeys, NothingDampsWhatDoesNotMove) {
  const std::string still = replaced(replaced(sheet, "\"kind\": \"dynamic\"", "\"kind\": \"static\""),
                                     "{\"end\": 0.1, \"step\": 1e-3}", "{}");
  expectRefused(replaced(still, "baraff_witkin\",\n    \"stretch_damping\": 0.1", "baraff_witkin\""), {});
  expectRefused(sheet, {{"baraff_witkin", "continuum", 6, "sheet.stretch_damping", "baraff_witkin"},
                        {"\"material\": {", "\"material\": {\"tension_field\": true, ", 5, "sheet.membrane_elements",
                         "tension_field"}});
  const Folder folder;
  for (const char* kind : {"static", "modal"}) {
    const std::filesystem::path file =
        folder.write("still.json", replaced(still, "\"static\"", std::string("\"") + kind + "\""));
    try {
      readAnyCase(file);
      ADD_FAILURE() << kind;
    } catch (const InputError& e) {
      EXPECT_EQ(e.where().line, 6) << e.what();
      EXPECT_EQ(e.where().key, "sheet.stretch_damping") << e.what();
      EXPECT_NE(e.reason().find("velocities"), std::string::npos) << e.what();
    }
  }
}

}  // namespace
}  // namespace gambeson
