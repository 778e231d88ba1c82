#include <gtest/gtest.h>

#include "human/body/body_file.hpp"
#include "unit/human/files/files.hpp"

namespace gambeson {
namespace {

using test::expectRefused;
using test::Folder;
using test::replaced;

const std::string urdf = "<robot name=\"r\"><link name=\"a\"/></robot>";
const std::string body = R"({
  "mass_kg": 80, "stature_m": 1.8,
  "shapes": [
    {"link": "a", "name": "s", "semi_axes_m": [0.1, 0.2, 0.3], "origin_m": [0, 0, 1], "rpy_rad": [0, 0, 1.5707963267948966]}
  ]
})";

TEST(BodyFile, GivesTheLinksTheirShapes) {
  const Folder folder;
  const Human h = loadHuman(folder.write("r.urdf", urdf), folder.write("b.json", body));
  ASSERT_EQ(h.shapes.size(), 1u);
  EXPECT_EQ(h.mass_kg, 80);
  EXPECT_EQ(h.stature_m, 1.8);
  EXPECT_EQ(std::get<Ellipsoid>(h.shapes[0].shape).semi_axes, (Vec3{0.1, 0.2, 0.3}));
  EXPECT_LT(norm(h.shapes[0].X_LS.rotation * Vec3{1, 0, 0} - Vec3{0, 1, 0}), 1e-15);
}

TEST(BodyFile, RefusesWhatIsMalformed) {
  const Folder folder;
  const auto u = folder.write("r.urdf", urdf);
  const auto refused = [&](const std::string& text, int line, const char* words) {
    expectRefused([&](const auto& f) { loadHuman(u, f); }, folder.write("b.json", text), line, words);
  };
  refused("", 0, "empty");
  refused("{", 1, "not JSON");
  refused(replaced(body, "80,", "80"), 2, "not JSON");
  refused(body.substr(0, 60), 4, "not JSON");
  refused(replaced(body, "80", "NaN"), 2, "not JSON");
  refused(replaced(body, "80", "1e999"), 0, "number overflow parsing '1e999'");
  refused(replaced(body, "80", "\"80 kg\""), 0, "mass_kg: must be a number");
  refused(replaced(body, "80", "-80"), 0, "mass_kg");
  refused(replaced(body, "80", "1e9"), 0, "mass_kg");
  refused(replaced(body, "\"mass_kg\": 80,", ""), 0, "mass_kg: is missing");
  refused(replaced(body, "\"mass_kg\"", "\"mass\""), 0, "mass: is not known");
  refused(replaced(body, "\"mass_kg\": 80,", "\"mass_kg\": 80, \"mass_kg\": 81,"), 0, "twice");
  refused(replaced(body, "\"link\": \"a\"", "\"link\": \"b\""), 0, "shapes[0].link: the skeleton has no link 'b'");
  refused(replaced(body, "0.1, 0.2, 0.3", "0.1, 0, 0.3"), 0, "shapes[0].semi_axes_m[1]");
  refused(replaced(body, "0.1, 0.2, 0.3", "0.1, 0.2"), 0, "three numbers");
  refused(replaced(body, "[0, 0, 1]", "[0, 0, 1e7]"), 0, "origin_m[2]");
  refused(replaced(body, "\"semi_axes_m\"", "\"semi_axes_mm\""), 0, "semi_axes_mm");
  refused("[]", 0, "object");
  refused("{\"mass_kg\": 1, \"stature_m\": 1, \"shapes\": []}", 0, "at least one");
  refused(std::string(200000, '['), 0, "not JSON");
  expectRefused([&](const auto& f) { loadHuman(u, f); }, folder.path / "none.json", 0, "no such file");
}

}  // namespace
}  // namespace gambeson
