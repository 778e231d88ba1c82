/// The command, through the binary: exit status 0 done, 2 bad input, and messages that name the place.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <nlohmann/json.hpp>

#include "unit/cases/content.hpp"
#include "unit/cases/example.hpp"

namespace gambeson {
namespace {

struct Outcome {
  int status = -1;
  std::string out, err;
};

Outcome gambeson(const Folder& folder, const std::string& arguments) {
  const std::filesystem::path out = folder.path() / "stdout", err = folder.path() / "stderr";
  const std::string command = "cd '" + folder.path().string() + "' && '" GAMBESON_BINARY "' " + arguments + " >'" +
                              out.string() + "' 2>'" + err.string() + "' </dev/null";
  const int raw = std::system(command.c_str());
  return {WIFEXITED(raw) ? WEXITSTATUS(raw) : -1, content(out), content(err)};
}

TEST(Command, HelpForNewcomers) {
  const Folder folder;
  for (const char* subcommand :
       {"", "new ", "run ", "check ", "render ", "report ", "verify ", "study ", "batch ", "gallery ", "fabric "}) {
    const Outcome o = gambeson(folder, std::string(subcommand) + "--help");
    SCOPED_TRACE(subcommand);
    EXPECT_EQ(o.status, 0);
    EXPECT_NE(o.out.find("Usage"), std::string::npos);
    EXPECT_NE(o.out.find("  gambeson "), std::string::npos);  // an example
  }
  EXPECT_NE(gambeson(folder, "--version").out.find("gambeson 0."), std::string::npos);
}

/// 0 for help, 2 for what is wrong in the input, which is said; whatever the command.
TEST(Command, StatusesAreAlike) {
  const Folder folder;
  for (const char* subcommand : {"run", "dress", "check", "draft", "render", "report", "export", "verify", "study",
                                 "batch", "gallery", "fabric"}) {
    SCOPED_TRACE(subcommand);
    EXPECT_EQ(gambeson(folder, std::string(subcommand) + " --help").status, 0);
    for (const char* wrong : {"--nonsense", "absent.json", ""}) {
      const Outcome o = gambeson(folder, std::string(subcommand) + " " + wrong);
      EXPECT_EQ(o.status, 2) << wrong;
      EXPECT_FALSE(o.err.empty()) << wrong;
    }
  }
  EXPECT_EQ(gambeson(folder, "nonsense").status, 2);
}

/// Drafted legs end at the ankle: `check` says what `run` would.
TEST(Command, ShortsThatReachTooFarAreRefusedByCheck) {
  const Folder folder;
  for (const char* inseam : {"7.9 cm", "90 cm"}) {
    const Outcome o = gambeson(folder, "check '" GAMBESON_SOURCE_DIR
                                       "/cases/library/shorts_walk.json' --set 'garment.shorts.inseam=" +
                                           std::string(inseam) + "'");
    EXPECT_EQ(o.status, 2) << inseam;
    EXPECT_NE(o.err.find("garment.shorts.inseam"), std::string::npos) << o.err;
  }
}

TEST(Command, CheckAcceptsTheLibrary) {
  const Folder folder;
  for (const char* name :
       {"shorts_walk", "shorts_stairs", "sleeve_flex", "inclined_plane", "sphere_drape", "flag", "cantilever",
        "roll_up", "hinged_roof", "plate_modes", "flag_dynamic", "wong_ball", "wong_funnel", "wong_dancer",
        "wong_reef_knot", "wong_bowline", "man_plate", "man_roll_up"}) {
    const Outcome o = gambeson(folder, "check '" GAMBESON_SOURCE_DIR "/cases/library/" + std::string(name) + ".json'");
    EXPECT_EQ(o.status, 0) << o.err;
    EXPECT_NE(o.out.find("valid"), std::string::npos);
  }
}

/// Meshes with holes, fins and triangles that face the wrong way: what is taken is said, what is refused names the
/// place.
TEST(Command, MoreThreadsThanCanStartAreRefused) {
  const Folder folder;
  folder.write("example.json", example);
  for (const char* asked : {"100000", "99999999999999999999", "5000,2"}) {
    setenv("OMP_NUM_THREADS", asked, 1);
    const Outcome o = gambeson(folder, "check example.json");
    unsetenv("OMP_NUM_THREADS");
    EXPECT_EQ(o.status, 2) << asked;
    EXPECT_NE(o.err.find("environment: OMP_NUM_THREADS: \"" + std::string(asked)), std::string::npos) << o.err;
    EXPECT_NE(o.err.find("allowed: 1 to 4096"), std::string::npos) << o.err;
  }
}

TEST(Command, RunSaysWhatIsWrongWithAMesh) {
  const Folder folder;
  // A tetrahedron about the origin, its lid left out, a fin added, or a face turned.
  const std::string corners = "v 0.05 0 -0.04\nv -0.03 0.05 -0.04\nv -0.03 -0.05 -0.04\nv 0 0 0.04\nv 0.2 0.2 0.2\n";
  const std::string closed = "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  const auto run = [&](const std::string& faces) {
    folder.write("body.obj", corners + faces);
    folder.write("mesh.json", R"({"name": "mesh", "gravity": [0, 0, 0], "contact": {"friction": 0.2},
      "garment": {"sheet": {"width": "0.1 m", "height": "0.1 m", "cells_u": 4, "cells_v": 4, "corner": [0, 0, 1]}},
      "fabric": {"thickness": "1 mm", "surface_density": "0.1 kg/m^2", "young": "30 kPa", "poisson": 0.3,
                 "bending": {"law": "zheng", "rigidity": "3e-6 N m", "kappa0": "30 1/m"}},
      "obstacles": [{"name": "body", "mesh": {"file": "body.obj"}}], "time": {"duration": "1 ms"}})");
    return gambeson(folder, "run mesh.json --out out");
  };
  const Outcome good = run(closed);
  EXPECT_EQ(good.status, 0) << good.err;
  EXPECT_EQ(good.err.find("note:"), std::string::npos) << good.err;
  const Outcome open = run("f 1 2 4\nf 2 3 4\nf 3 1 4\n");
  EXPECT_EQ(open.status, 0) << open.err;
  EXPECT_NE(open.err.find("note: obstacle body (body.obj) is open: 1 border of 3 edges"), std::string::npos)
      << open.err;
  EXPECT_NE(content(folder.path() / "out/report.html").find("is open: 1 border of 3 edges"), std::string::npos);
  const Outcome fin = run(closed + "f 1 2 5\n");
  EXPECT_EQ(fin.status, 0) << fin.err;
  EXPECT_NE(fin.err.find("1 edge of more than two triangles"), std::string::npos) << fin.err;
  const Outcome turned = run("f 1 3 2\nf 1 2 4\nf 3 2 4\nf 3 1 4\n");
  EXPECT_EQ(turned.status, 2);
  for (const char* word : {"body.obj", "obstacle body", "disagree on which side is outside", "(-0.03, 0.05, -0.04) m"})
    EXPECT_NE(turned.err.find(word), std::string::npos) << turned.err;
}

TEST(Command, CheckSaysWhatACaseIs) {
  const Folder folder;
  folder.write("example.json", example);
  const Outcome full =
      gambeson(folder, "check example.json --full --set fabric.thickness='0.4 mm' --set gravity=[0,0,-1.62]");
  ASSERT_EQ(full.status, 0) << full.err;
  const auto j = nlohmann::json::parse(full.out);
  EXPECT_DOUBLE_EQ(j.at("fabric").at("thickness").get<double>(), 0.4e-3);
  EXPECT_DOUBLE_EQ(j.at("gravity").at(2).get<double>(), -1.62);
  EXPECT_TRUE(nlohmann::json::accept(gambeson(folder, "check --schema").out));
  EXPECT_NE(gambeson(folder, "check --doc").out.find("| `thickness` | number | required |"), std::string::npos);
}

TEST(Command, BadInputExitsWithTwo) {
  const Folder folder;
  folder.write("example.json", example);
  folder.write("typo.json", replaced(example, "\"thickness\"", "\"thicknes\""));
  folder.write("unit.json", replaced(example, "\"1 mm\"", "\"1 kg\""));
  folder.write("empty.json", "");
  folder.write("truncated.json", example.substr(0, 300));
  const std::array<std::pair<std::string, std::string>, 22> cases{{
      {"", "gambeson run cases/library/shorts_walk.json"},
      {"dance",
       "there is no command \"dance\"; there are new, run, dress, check, draft, render, report, export, verify, study, "
       "batch, gallery, fabric, import and homogenise"},
      {"run", "CASE"},
      {"run example.json --fast", "--fast"},
      {"run example.json --threads -1", "--threads"},
      {"run example.json --threads many", "--threads"},
      {"run example.json --device gpu", "--device"},
      {"run example.json --device cuda --set time.audit=true",
       "command line: time.audit: the account of the scheme's own energy is not kept by --device cuda"},
      {"run example.json --set contact.friction=-1",
       "command line: contact.friction: -1 is out of range; allowed: >= 0 and <= 5"},
      {"run typo.json", "typo.json:9: fabric.thicknes: unknown key; did you mean \"thickness\"?"},
      {"check unit.json", "unit.json:9: fabric.thickness: \"1 kg\" has the wrong unit"},
      {"check empty.json", "empty.json: the file is empty"},
      {"check truncated.json", "truncated.json:"},
      {"check missing.json", "missing.json: there is no such file"},
      {"check", "CASE"},
      {"render results -o x.png --time soon", "time: \"soon\""},
      {"render results -o x.png --size 12", "--size"},
      {"report results", "--output"},
      {"batch example.json --out B --time 60", "--time: \"60\" is for Slurm; allowed: with --engine slurm"},
      {"batch example.json --out B --engine slurm --mem 8GB", "--mem: \"8GB\" cannot be passed on; allowed: "},
      {"batch example.json --out B --compare --resume", "--resume excludes --compare"},
      {"batch example.json --out B --compare", "--compare: "},
  }};
  for (const auto& [arguments, message] : cases) {
    SCOPED_TRACE(arguments);
    const Outcome o = gambeson(folder, arguments);
    EXPECT_EQ(o.status, 2) << o.err;
    EXPECT_NE((o.out + o.err).find(message), std::string::npos) << o.out << o.err;
  }
}

}  // namespace
}  // namespace gambeson
