/// Every way to get a case wrong says where and why.

#include "unit/cases/malformed.hpp"

namespace gambeson {
namespace {

TEST(MalformedCase, EachSaysFileLineKeyAndReason) {
  expectRefused(
      example,
      {
          // Unknown keys, with a suggestion where one is close.
          {"\"thickness\"", "\"thicknes\"", 9, "fabric.thicknes", "did you mean \"thickness\"?"},
          {"\"friction\"", "\"mu\"", 27, "contact.mu", "unknown key; allowed: layer, friction"},
          {"\"strides\"", "\"stride\"", 17, "human.motion.walk.stride", "did you mean \"strides\"?"},
          {"\"view\"", "\"wiew\"", 32, "output.pictures[1].wiew", "did you mean \"view\"?"},
          // Missing fields.
          {"\"name\": \"example\",", "", 1, "name", "is required"},
          {"\"thickness\": \"1 mm\",", "", 8, "fabric.thickness", "is required"},
          {"\"density\": \"436 kg/m^3\",", "", 8, "fabric", "one of density or surface_density is required"},
          {"\"young\": \"1.2 MPa\",", "", 8, "fabric.young", "is required"},
          {"\"young\": \"1.2 MPa\",", "\"young_weft\": 1e6, \"young_warp\": 1e6,", 8, "fabric.shear", "is required"},
          {", \"kappa0\": \"30 1/m\"", "", 13, "fabric.bending.kappa0", "is required for the law zheng"},
          {"\"contact\": {\"friction\": 0.2},", "", 1, "contact", "is required"},
          {", \"link\": \"pelvis\"", "", 25, "supports[1].springs.link", "is required"},
          {"\"manikin\": \"male_p50\",", "", 15, "human",
           "one of manikin, urdf, character, scan or segments is required"},
          {"{\"walk\": {\"strides\": 1}}", "{}", 17, "human.motion",
           "one of stand, walk, stairs, aim, trajectory, file, sit, kneel, step_over or markers is required"},
          // Fields that exclude each other.
          {"\"weft_angle\"", "\"tube\": {\"radius\": 1, \"length\": 1}, \"weft_angle\"", 6, "garment.tube",
           "excludes \"sheet\""},
          {"\"density\"", "\"surface_density\": 1, \"density\"", 10, "fabric.density", "excludes \"surface_density\""},
          {"\"young\"", "\"young_weft\": 1e6, \"young\"", 11, "fabric.young_weft", "excludes \"young\""},
          {"\"law\": \"zheng\"", "\"law\": \"linear\"", 13, "fabric.bending.kappa0", "no meaning for the law linear"},
          {"\"manikin\": \"male_p50\",", "\"manikin\": \"male_p50\", \"body\": \"example.json\",", 16, "human.body",
           "goes with \"urdf\""},
          {"\"contact\": {\"friction\": 0.2},",
           "\"contact\": {\"friction\": 0.2}, \"strain_limit\": {\"mode\": \"equality\", \"limit\": 0.01},", 27,
           "strain_limit.limit", "has no meaning for equality"},
          {"\"contact\": {\"friction\": 0.2},",
           "\"contact\": {\"friction\": 0.2}, \"strain_limit\": {\"mode\": \"upper_limit\"},", 27, "strain_limit.limit",
           "is required for upper_limit"},
          {"\"contact\": {\"friction\": 0.2},",
           "\"contact\": {\"friction\": 0.2}, \"strain_limit\": {\"mode\": \"lower_limit\"},", 27, "strain_limit.mode",
           "upper_limit"},
          {"\"manikin\": \"male_p50\",",
           "\"segments\": [{\"name\": \"arm\", \"upper_joint\": [\"a\"], \"lower_joint\": [\"b\"], \"marker\": "
           "[\"m\"], \"semi_axes\": [0.2, 0.1, "
           "0.1]}],",
           16, "human.segments", "moved by markers alone"},
          {"\"manikin\": \"male_p50\",", "\"segments\": [],", 16, "human.segments", "one segment or more"},
          {"{\"walk\": {\"strides\": 1}}", "{\"markers\": {\"path\": \"example.json\"}}", 17, "human.motion",
           "other bodies take markers by \"file\""},
          // Ranges, with the value.
          {"\"1 mm\"", "\"-1 mm\"", 9, "fabric.thickness", "-1 mm is out of range; allowed: > 0 and <= 50 mm"},
          {"\"1 mm\"", "0", 9, "fabric.thickness", "allowed: > 0"},
          {"\"poisson\": 0.3", "\"poisson\": 1", 12, "fabric.poisson", "1 is out of range; allowed: >= 0 and < 1"},
          {"\"friction\": 0.2", "\"friction\": -0.2", 27, "contact.friction", "-0.2 is out of range"},
          {"\"cells_u\": 8", "\"cells_u\": 0", 4, "garment.sheet.cells_u", "0 is out of range; allowed: >= 1"},
          {"\"cells_u\": 8", "\"cells_u\": 1e30", 4, "garment.sheet.cells_u", "out of range"},
          {"\"rings\": 8", "\"rings\": 1", 20, "obstacles[0].sphere.rings", "1 is out of range; allowed: 0 or >= 2"},
          {"\"strides\": 1", "\"strides\": 1000000", 17, "human.motion.walk.strides", "out of range"},
          {"\"width\": 640", "\"width\": 1000000", 32, "output.pictures[1].width", "out of range"},
          {"\"frame\": \"20 ms\"", "\"frame\": \"25 ms\"", 30, "output.frame", "not a multiple of window"},
          {"\"checkpoint\": \"40 ms\"", "\"checkpoint\": \"10 ms\"", 30, "output.checkpoint",
           "not a multiple of frame"},
          {"\"frame\"", "\"window\": 0.02, \"frame\"", 30, "output.window", "allowed: >= 1e-05 and <= 0.01 s"},
          {"\"0.5 s\"", "\"5 s\"", 32, "output.pictures[1].time", "5 s is out of range; allowed: 0 to 1.6 s"},
          // Units.
          {"\"1 mm\"", "\"1 kg\"", 9, "fabric.thickness",
           "wrong unit (a mass); expected a length, such as mm, cm or in"},
          {"\"1 mm\"", "\"1\"", 9, "fabric.thickness", "has no unit"},
          {"\"1 mm\"", "\"one mm\"", 9, "fabric.thickness", "does not start with a number"},
          {"\"45 deg\"", "\"45 gradians\"", 6, "garment.weft_angle", "\"gradians\" is unknown"},
          {"\"4 kg/(m^2 s)\"", "\"4 kg/(m^2 s\"", 28, "air.drag", "\")\" is missing"},
          {"\"-1 cm\"", "\"-1 s\"", 21, "obstacles[1].plane.point[2]", "wrong unit"},
          // NaN and infinity.
          {"\"1 mm\"", "\"nan m\"", 9, "fabric.thickness", "not a finite number"},
          {"\"1 mm\"", "\"inf m\"", 9, "fabric.thickness", "not a finite number"},
          {"\"poisson\": 0.3", "\"poisson\": NaN", 12, "fabric.poisson", "invalid literal"},
          {"\"poisson\": 0.3", "\"poisson\": 1e400", 12, "fabric.poisson", "too large"},
          // Types.
          {"\"1 mm\"", "[1]", 9, "fabric.thickness", "expected a number in m or a text with a unit, not a list of 1"},
          {"\"1 mm\"", "null", 9, "fabric.thickness", "not null"},
          {"\"cells_u\": 8", "\"cells_u\": 8.5", 4, "garment.sheet.cells_u",
           "expected a whole number, not the number 8.5"},
          {"\"cells_u\": 8", "\"cells_u\": \"8\"", 4, "garment.sheet.cells_u", "expected a whole number, not \"8\""},
          {"\"name\": \"example\"", "\"name\": 3", 2, "name", "expected a text"},
          {"\"name\": \"example\"", "\"name\": \"\"", 2, "name", "the text is empty"},
          {"[1, 0, 0]", "[1, 0]", 5, "garment.sheet.axis_u", "expected a list of three numbers"},
          {"[1, 0, 0]", "[0, 0, 0]", 5, "garment.sheet.axis_u", "cannot have the length 0"},
          {"[1, 0, 0]", "[1, 1, 0]", 5, "garment.sheet.axis_v", "not at right angles"},
          {"{\"friction\": 0.2}", "0.2", 27, "contact", "expected an object { } with layer, friction"},
          {"[\"hip_flexion_left\"]", "\"hip_flexion_left\"", 33, "analysis.joints", "expected a list [ ] of texts"},
          {"[\"hip_flexion_left\"]", "[\"hip_flexion_left\", 3]", 33, "analysis.joints[1]", "expected a text"},
          // Words.
          {"\"law\": \"zheng\"", "\"law\": \"quadratic\"", 13, "fabric.bending.law",
           "allowed: zheng, linear, stop or hysteresis"},
          {"\"male_p50\"", "\"bob\"", 16, "human.manikin", "allowed: male_p5, male_p50"},
          {"\"male_p50\"", "{\"sex\": \"male\", \"stature\": \"1.8 m\", \"mass\": \"80 kg\", \"inseam\": \"1.4 m\"}",
           16, "human.manikin.inseam", "goes with no body of 1.8 m and 80 kg; allowed: "},
          {"\"male_p50\"", "{\"sex\": \"male\", \"stature\": \"5.9 ft\", \"mass\": \"176 lb\", \"chest\": \"70 in\"}",
           16, "human.manikin.chest", "70 in goes with no body of 5.9 ft and 176 lb; allowed: 3"},
          {"\"male_p50\"", "{\"sex\": \"male\", \"stature\": \"180 cm\", \"mass\": \"70 lb\"}", 16,
           "human.manikin.mass", "70 lb goes with no body of 180 cm; allowed: 100.09 lb to 357.149 lb"},
          {"\"male_p50\"", "{\"sex\": \"male\", \"stature\": \"1.8 m\"}", 16, "human.manikin.mass", "required"},
          {"\"peak\"", "\"noon\"", 31, "output.pictures[0].time", "allowed: peak or end"},
          {"\"pelvis_mean\"", "\"head_mean\"", 28, "air.velocity", "allowed: pelvis_mean"},
          {"\"back\"", "\"below\"", 32, "output.pictures[1].view", "allowed: front, back"},
          // Things that do not fit each other.
          {"\"edge\": \"u0\"", "\"edge\": \"waist\"", 24, "supports[0].fixed.edge", "allowed: u0, u1, v0 or v1"},
          {"\"edge\": \"0.v1\"", "\"edge\": \"1.v1\"", 25, "supports[1].springs.edge", "there is no patch 1"},
          {"\"edge\": \"0.v1\"", "\"edge\": \"0.w1\"", 25, "supports[1].springs.edge", "is not an edge"},
          {"\"floor\"", "\"ball\"", 21, "obstacles[1].name", "names two obstacles"},
          {", \"segments\": 9", "", 20, "obstacles[0].sphere.segments", "go together"},
          {"{\"walk\": {\"strides\": 1}}", "{\"stand\": {}}", 33, "analysis.task", "does not walk"},
          {"natural_walk", "natural_stairs", 33, "analysis.task", "climbs none"},
          {"natural_walk", "aiming", 33, "analysis.task", "takes none"},
          {"\"walk\": {\"strides\": 1}", "\"aim\": {\"rifle\": -1}", 17, "human.motion.aim.rifle", "out of range"},
          {"\"walk\": {\"strides\": 1}", "\"aim\": {\"duration\": 0}", 17, "human.motion.aim.duration", "out of range"},
          {"\"walk\": {\"strides\": 1}", "\"stairs\": {\"strides\": 1}", 17, "human.motion.stairs.lead_in_strides",
           "must be fewer than strides"},
          {"\"walk\": {\"strides\": 1}", "\"stairs\": {\"lead_in\": 1.5}", 17, "human.motion.stairs.lead_in",
           "must be 0.4 to 0.7"},
          {"\"walk\": {\"strides\": 1}", "\"stairs\": {\"stride_time\": -1}", 17, "human.motion.stairs.stride_time",
           "out of range"},
          {"\"strides\": 1", "\"paces\": -3", 17, "human.motion.walk.paces", "out of range"},
          {"\"kappa0\": \"30 1/m\"", "\"kappa0\": \"0.1 1/m\"", 13, "fabric.bending.regular_curvature",
           "allowed: <= kappa0"},
          // Files.
          {"\"manikin\": \"male_p50\",", "\"urdf\": \"nobody.urdf\",", 16, "human.urdf", "there is no file"},
          {"\"manikin\": \"male_p50\",", "\"urdf\": \".\",", 16, "human.urdf", "is not a file"},
          {"\"walk\": {\"strides\": 1}", "\"trajectory\": {}", 17, "human.motion.trajectory.file", "is required"},
          {"\"walk\": {\"strides\": 1}", "\"file\": {}", 17, "human.motion.file.path", "is required"},
          {"\"walk\": {\"strides\": 1}", "\"file\": {\"path\": \"nowhere.mot\"}", 17, "human.motion.file.path",
           "there is no file"},
          {"\"walk\": {\"strides\": 1}", "\"trajectory\": {\"file\": \"nowhere.csv\"}", 17,
           "human.motion.trajectory.file", "there is no file"},
          // Names that the human does not have.
          {"\"analysis\":", "\"comfort\": {\"waist\": {\"amber\": \"5 kPa\"}}, \"analysis\":", 33, "comfort.waist.red",
           "below amber"},
          {"\"analysis\":", "\"comfort\": {\"hips\": {\"peak\": \"1 kPa\"}}, \"analysis\":", 33, "comfort.hips.peak",
           "below red"},
          {"\"analysis\":", "\"comfort\": {\"hips\": {\"peak\": \"1 N\"}}, \"analysis\":", 33, "comfort.hips.peak",
           "Pa"},
          {"\"analysis\":", "\"comfort\": {\"neck\": {}}, \"analysis\":", 33, "comfort.neck", "unknown key"},
          {"\"analysis\":", "\"comfort\": {\"effort_red\": 0.01}, \"analysis\":", 33, "comfort.effort_red",
           "effort_amber"},
          {"hip_flexion_left", "hip_flexon_left", 33, "analysis.joints[0]", "did you mean \"hip_flexion_left\"?"},
          {"\"hip_flexion_left\"", "\"hip_flexion_left\", \"hip_flexion_left\"", 33, "analysis.joints[1]",
           "listed twice"},
          {"\"link\": \"pelvis\"", "\"link\": \"pelvic\"", 25, "supports[1].springs.link", "did you mean \"pelvis\"?"},
          {"\"floor\"", "\"pelvis\"", 21, "obstacles[1].name", "also a link of the human"},
          // Syntax, duplicates.
          {"\"poisson\": 0.3,", "\"poisson\": 0.3", 13, "", "unexpected string literal"},
          {"\"poisson\": 0.3,", "\"poisson\": 0.3, \"poisson\": 0.4,", 12, "fabric.poisson",
           "written twice, first in line 12"},
      });
}

TEST(MalformedCase, WithoutHumanWhatNeedsOneIsRefused) {
  const std::string alone = replaced(example, R"("human": {
    "manikin": "male_p50",
    "motion": {"walk": {"strides": 1}}
  },)",
                                     "");
  const std::string hanging =
      replaced(replaced(replaced(replaced(alone, ", \"velocity\": \"pelvis_mean\"", ""),
                                 "\"dressing\": {\"projecting\": {\"clearance\": \"5 mm\"}, \"settle\": \"0.2 s\"}",
                                 "\"time\": {\"duration\": \"2 s\"}"),
                        "\"springs\": {\"edge\": \"0.v1\", \"stiffness\": 100, \"link\": \"pelvis\"}",
                        "\"fixed\": {\"edge\": \"v1\"}"),
               "\"joints\": [\"hip_flexion_left\"], \"counting\": \"all_distal\", \"task\": \"natural_walk\"", "");
  const Folder folder;
  EXPECT_EQ(readCase(folder.write("hanging.json", hanging)).dressing.settle_s, 0);
  const std::pair<std::string, std::string> cases[] = {
      {replaced(hanging, "\"duration\": \"2 s\"", ""), "time.duration"},
      {replaced(hanging, "\"drag\"", "\"velocity\": \"pelvis_mean\", \"drag\""), "air.velocity"},
      {replaced(hanging, "\"air\"", "\"dressing\": {\"settle\": 1}, \"air\""), "dressing.settle"},
      {replaced(hanging, "\"air\"", "\"dressing\": {\"projecting\": {}}, \"air\""), "dressing.projecting"},
      {replaced(hanging, "\"fixed\": {\"edge\": \"v1\"}", "\"springs\": {\"edge\": \"v1\", \"link\": \"pelvis\"}"),
       "supports[1].springs.link"},
      {replaced(hanging, "\"analysis\": {}", "\"analysis\": {\"joints\": [\"knee\"]}"), "analysis.joints"},
      {replaced(hanging, "\"analysis\": {}", "\"analysis\": {\"task\": \"natural_walk\"}"), "analysis.task"},
  };
  for (const auto& [text, key] : cases) {
    SCOPED_TRACE(key);
    try {
      readCase(folder.write("case.json", text));
      ADD_FAILURE() << "accepted";
    } catch (const InputError& e) {
      EXPECT_EQ(e.where().key, key) << e.what();
      EXPECT_GT(e.where().line, 0) << e.what();
    }
  }
}

TEST(MalformedCase, FilesThatAreNone) {
  const Folder folder;
  const std::pair<std::filesystem::path, std::string> cases[] = {
      {folder.path() / "missing.json", "there is no such file"},
      {folder.path(), "this is a folder"},
      {folder.path() / "missing" / "case.json", "there is no such file"},
      {"/dev/zero", "not a regular file"},
      {folder.write("empty.json", ""), "the file is empty"},
      {folder.write("truncated.json", example.substr(0, example.size() / 2)), "unexpected end of input"},
      {folder.write("enormous.json", "{\"name\": \"" + std::string(2 << 20, 'x') + "\"}"), "at most 1048576 are read"},
      {folder.write("deep.json", std::string(100000, '[')), "nested deeper than 32"},
      {folder.write("binary.json", std::string("\x89PNG\r\n\x1a\n\0\0", 10)), ""},
      {folder.write("list.json", "[]"), "expected an object"},
      {folder.write("number.json", "3"), "expected an object"},
  };
  for (const auto& [file, reason] : cases) {
    SCOPED_TRACE(file);
    try {
      readCase(file);
      ADD_FAILURE() << "accepted";
    } catch (const InputError& e) {
      EXPECT_EQ(e.where().file, file.string());
      EXPECT_NE(e.reason().find(reason), std::string::npos) << e.what();
    }
  }
}

/// What is wrong in a file that the case names is said with that file's own name.
TEST(MalformedCase, FilesThatItNames) {
  const std::filesystem::path library = std::filesystem::path(GAMBESON_SOURCE_DIR) / "cases/library";
  for (const char* broken : {"arm.urdf", "arm_body.json", "arm_flex.csv"}) {
    const Folder folder;
    for (const char* name : {"arm.urdf", "arm_body.json", "arm_flex.csv", "sleeve_flex.json"})
      std::filesystem::copy_file(library / name, folder.path() / name);
    EXPECT_NO_THROW(readCase(folder.path() / "sleeve_flex.json"));
    folder.write(broken, "{broken");
    SCOPED_TRACE(broken);
    try {
      readCase(folder.path() / "sleeve_flex.json");
      ADD_FAILURE() << "accepted";
    } catch (const InputError& e) {
      EXPECT_EQ(e.where().file, (folder.path() / broken).string()) << e.what();
    }
  }
  const Folder folder;
  const std::filesystem::path mesh = folder.write("ball.obj", "v 0 0 zero\nf 1 2 3\n");
  const std::string sphere = "\"sphere\": {\"radius\": \"10 cm\", \"rings\": 8, \"segments\": 9}";
  const std::filesystem::path file =
      folder.write("example.json", replaced(example, sphere, "\"mesh\": {\"file\": \"ball.obj\"}"));
  try {
    readCase(file);
    ADD_FAILURE() << "accepted";
  } catch (const InputError& e) {
    EXPECT_EQ(e.where().file, mesh.string()) << e.what();
  }
}

/// Root reads every file: it steps back to nobody for the test.
TEST(MalformedCase, UnreadableFile) {
  constexpr uid_t nobody = 65534;
  const Folder folder;
  const std::filesystem::path closed_file = folder.write("case.json", example);
  std::filesystem::create_directory(folder.path() / "closed");
  const std::filesystem::path in_closed_folder = folder.write("closed/case.json", example);
  using std::filesystem::perms;
  std::filesystem::permissions(folder.path(), static_cast<perms>(0755));
  std::filesystem::permissions(closed_file, perms::none);
  std::filesystem::permissions(folder.path() / "closed", perms::none);
  const bool root = geteuid() == 0;
  if (root && seteuid(nobody) != 0) GTEST_SKIP() << "cannot step back from root";
  std::vector<std::string> reasons;
  for (const std::filesystem::path& file : {closed_file, in_closed_folder}) {
    try {
      readCase(file);
      reasons.push_back("accepted");
    } catch (const InputError& e) {
      reasons.push_back(e.reason());
    }
  }
  if (root) {
    ASSERT_EQ(seteuid(0), 0);
  }
  std::filesystem::permissions(folder.path() / "closed", perms::owner_all);
  EXPECT_EQ(reasons[0], "cannot be opened; check its permissions");
  EXPECT_EQ(reasons[1], "cannot be read: Permission denied");
}

TEST(MalformedCase, OverridesGoThroughTheSameTable) {
  const Folder folder;
  const std::filesystem::path file = folder.write("example.json", example);
  EXPECT_EQ(readCase(file, {"contact.friction=0.7"}).contact.friction, 0.7);
  EXPECT_EQ(readCase(file, {"fabric.thickness=0.4 mm"}).fabric.thickness_m, 0.4e-3);
  EXPECT_EQ(readCase(file, {"time.duration=1 s"}).time.duration_s, 1.0);
  const std::pair<std::string, std::string> cases[] = {
      {"fabric.thicknes=1", "fabric.thicknes"},
      {"fabric.thickness=1 s", "fabric.thickness"},
      {"fabric.thickness=nan", "fabric.thickness"},
      {"supports[0].fixed.rows=3", "supports[0].fixed.rows"},
      {"supports[7].fixed.rows=3", "supports[7].fixed.rows"},
      {"output.frame=0.013", "output.frame"},
      {"friction", "friction"},
      {"=3", "=3"},
  };
  for (const auto& [text, key] : cases) {
    SCOPED_TRACE(text);
    try {
      readCase(file, {text});
      ADD_FAILURE() << "accepted";
    } catch (const InputError& e) {
      EXPECT_EQ(e.where().file, "command line") << e.what();
      EXPECT_EQ(e.where().key, key);
    }
  }
}

/// The schemes of worn cloth and what goes with each.
TEST(MalformedCase, Schemes) {
  const auto time = [](const std::string& keys, const std::string& more = "") {
    return "\"contact\": {\"friction\": 0.2}, \"time\": {" + keys + "}," + more;
  };
  const std::string from = "\"contact\": {\"friction\": 0.2},";
  const std::string limit = " \"strain_limit\": {\"mode\": \"upper_limit\", \"limit\": 0.01},";
  expectRefused(example, {{from, time("\"scheme\": \"rk3\""), 27, "time.scheme",
                           "allowed: verlet, euler, symplectic_euler, rk2, rk4, implicit_euler or semi_implicit"},
                          {from, time("\"scheme\": \"semi_implicit\", \"substeps\": 0"), 27, "time.substeps",
                           "0 is out of range; allowed: >= 1"},
                          {from, time("\"substeps\": 2"), 27, "time.substeps", "it goes with semi_implicit"},
                          {from, time("\"scheme\": \"implicit_euler\", \"substeps\": 2"), 27, "time.substeps",
                           "it goes with semi_implicit"},
                          {from, time("\"scheme\": \"implicit_euler\", \"solve_tolerance\": 0"), 27,
                           "time.solve_tolerance", "0 is out of range; allowed: >= 1e-14"},
                          {from, time("\"scheme\": \"rk4\", \"solve_tolerance\": 1e-3"), 27, "time.solve_tolerance",
                           "it goes with implicit_euler and semi_implicit"},
                          {from, time("\"scheme\": \"rk4\", \"audit\": true"), 27, "time.audit", "it goes with verlet"},
                          {from, time("\"step\": \"-1 ms\""), 27, "time.step", "-1 ms is out of range"},
                          {from, time("\"scheme\": \"rk4\"", limit), 27, "time.scheme", "goes without strain_limit"}});
  expectRefused(replaced(example, "\"rows\": 2", "\"rows\": 2, \"release\": 1"),
                {{from, time("\"scheme\": \"rk4\""), 27, "time.scheme", "goes without supports that move or let go"}});
  const std::string drag = "\"4 kg/(m^2 s)\"", still = replaced(example, drag, "0");
  expectRefused(still, {{from, time("\"scheme\": \"euler\""), 27, "time.scheme",
                         "allowed: with air.drag > 0, or with time.step > 0"},
                        {from, time("\"scheme\": \"rk2\""), 27, "time.scheme", "where nothing damps it"}});
}

}  // namespace
}  // namespace gambeson
