// The armour of the library: counts and mass of its two meshes, and the same results from its files.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "cases/command/cli.hpp"
#include "cases/wear/case/human.hpp"
#include "cases/wear/scene/garments.hpp"
#include "cases/wear/scene/scenario.hpp"
#include "core/cloth/draft/areas.hpp"
#include "core/cloth/draft/seams.hpp"
#include "core/cloth/patches/surface.hpp"
#include "core/error.hpp"
#include "core/motion/stage_work.hpp"
#include "exact/scene_intersections.hpp"
#include "tools/data_folder.hpp"
#include "unit/human/files/files.hpp"
#include "unit/shell_of.hpp"

namespace gambeson {
namespace {

const std::filesystem::path file =
    std::filesystem::path(GAMBESON_SOURCE_DIR) / "cases" / "library" / "armour_stand.json";
const std::vector<std::string> fine{"garments[0].shorts.cell=12.7 mm", "garments[1].belt.cell=12.9 mm",
                                    "garments[2].shirt.cell=12.9 mm"};

struct Drafts {
  Human human;
  std::vector<Garment> garments;
  explicit Drafts(const Case& c) : human(humanOf(*c.human)), garments(draftGarments(c, &human)) {}
  int points() const {
    int n = 0;
    for (const Garment& g : garments) n += controlOffsets(g).back();
    return n;
  }
};

TEST(ArmourCase, HasTheThesisCountsAndMass) {
  // Zheng 2013, sections 6.2 and 6.4: 6,308 and 1,932 control points, 13 patches, 1.43 kg of upper body armour.
  const Drafts coarse(readCase(file)), many(readCase(file, fine));
  EXPECT_NEAR(coarse.points(), 1932, 0.02 * 1932);
  EXPECT_NEAR(many.points(), 6308, 0.02 * 6308);
  for (const Drafts* d : {&coarse, &many}) {
    EXPECT_EQ(d->garments[0].patches.size(), 6u);
    EXPECT_EQ(d->garments[1].patches.size(), 1u);
    EXPECT_EQ(d->garments[2].patches.size(), 6u);
    double mass = 0;
    for (const double m : controlMasses(d->garments[2])) mass += m;
    EXPECT_NEAR(mass, 1.43, 0.05 * 1.43);
    for (const Garment& g : d->garments)
      for (const NurbsPatch& p : g.patches) EXPECT_TRUE(p.u.degree == 2 && p.v.degree == 2);
  }
}

TEST(ArmourCase, StartsClearOfPublicCharacters) {
  const std::filesystem::path folder = test::dataFolder() / "real" / "body";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
  CharacterOptions male, makehuman;
  male.file = folder / "quaternius_Superhero_Male_FullBody.gltf";
  makehuman.file = folder / "makehuman_base.obj";
  makehuman.skeleton = folder / "makehuman_default.mhskel";
  makehuman.weights = folder / "makehuman_default_weights.mhw";
  makehuman.targets = {{folder / "makehuman_caucasian_male_young.target"},
                       {folder / "makehuman_male_maxmuscle_averageweight.target"}};
  for (const CharacterOptions& character : {male, makehuman}) {
    Case c = readCase(file);
    c.human->manikin.clear();
    c.human->skin.reset();
    c.human->character = character;
    const auto s = buildScenario(c);
    StepWork work;
    const State start = startOf(*s, work);
    EXPECT_TRUE(exact::SceneIntersections(*s->model, *s->stage).at(start).none()) << character.file;
    std::vector<Vec3> x(static_cast<std::size_t>(s->model->surface.size()));
    s->model->surface.WT.multiply<Vec3>(start.p, x);
    const DeformedVertices skin = deformedVertices(*s->model, *s->stage, start.time_s);
    DeformedSurfaces surfaces(s->model->obstacles);
    surfaces.move(skin);
    double least = HUGE_VAL;
    for (const Vec3& y : x) least = std::min(least, s->model->proximity->nearest(0, y, surfaces).gap_m);
    EXPECT_GT(least, 0) << character.file;
  }
}

/// Zheng 2013, table 5.2: 1,616 control points, rho = 0.1177 kg/m^2, k / rho = 5000 m^2/s^2, k = 2.5 k_shear; cases (a)
/// and (c) of its description: 50.
TEST(ArmourDrape, HasTheSizesOfTheThesis) {
  const auto s = buildScenario(readCase(file.parent_path() / "armour_drape.json"));
  EXPECT_NEAR(s->model->cloth->points(), 1616, 0.005 * 1616);
  EXPECT_EQ(shellOf(*s->model).garment().patches.size(), 13u);
  const Fabric& f = s->definition.fabric;
  for (const double rho : s->model->density_kg_per_m2) ASSERT_NEAR(rho, 0.1177, 1e-6);
  EXPECT_NEAR(f.young_weft_Pa * f.thickness() / 0.1177, 5000, 1e-6 * 5000);
  EXPECT_NEAR(f.young_warp_Pa / f.shear_Pa, 2.5, 1e-12);
  EXPECT_NEAR(5000 * f.thickness() / 0.1177, 50, 1e-6 * 50);
}

TEST(ArmourCase, FilesOfItsGarmentsAreTheSameArmour) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "armour_files";
  std::filesystem::create_directories(folder);
  const Case c = readCase(file);
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  std::string worn = text.str();
  for (const std::string name : {"shorts", "belt", "shirt"}) {
    const std::string out = (folder / (name + ".json")).string(), in_case = file.string();
    const char* command[]{"gambeson", "draft", in_case.c_str(), "--garment", name.c_str(), "-o", out.c_str()};
    std::ostringstream said, wrong;
    ASSERT_EQ(runCommand(7, command, said, wrong), 0) << wrong.str();
    EXPECT_NE(said.str().find("control points"), std::string::npos);
    const std::size_t at = worn.find("\"" + name + "\": {"), end = worn.find('}', at);
    worn.replace(at, end + 1 - at, "\"file\": {\"path\": \"" + name + ".json\"}");
  }
  std::ofstream(folder / "worn.json") << worn;
  const auto a = buildScenario(c), b = buildScenario(readCase(folder / "worn.json"));
  EXPECT_EQ(a->patch_names, b->patch_names);
  EXPECT_EQ(a->model->mass_kg, b->model->mass_kg);
  EXPECT_EQ(a->model->area_m2, b->model->area_m2);
  ASSERT_EQ(a->start_m.size(), b->start_m.size());
  StepWork wa, wb;
  const State sa = startOf(*a, wa), sb = startOf(*b, wb);
  EXPECT_TRUE(sa.p == sb.p);
  EXPECT_TRUE(sa.a == sb.a);
  EXPECT_TRUE(sa.anchors == sb.anchors);
  std::filesystem::remove_all(folder);
}

TEST(ArmourCase, DraftNamesWhatIsWrong) {
  const auto said = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"gambeson", "draft", file.string(), "-o", "/nonexistent/x.json"});
    std::vector<const char*> command;
    for (const std::string& s : more) command.push_back(s.c_str());
    std::ostringstream out, err;
    EXPECT_NE(runCommand(static_cast<int>(command.size()), command.data(), out, err), 0);
    return err.str();
  };
  EXPECT_NE(said({}).find("--garment"), std::string::npos);
  EXPECT_NE(said({"--garment", "hat"}).find("shorts, belt"), std::string::npos);
  EXPECT_NE(said({"--garment", "shirt", "--set", "garments[2].shirt.ease=-1"}).find("ease"), std::string::npos);
  EXPECT_NE(said({"--garment", "belt", "--set", "garments[1].belt.tension=1 km"}).find("tension"), std::string::npos);
}

}  // namespace
}  // namespace gambeson
