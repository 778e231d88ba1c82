/// Studies: what their files mean, what is wrong with malformed ones, and the scripts that run them.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "cases/study/compare.hpp"
#include "cases/study/files.hpp"
#include "core/error.hpp"
#include "unit/cases/study/example.hpp"

namespace gambeson::study {
namespace {

using namespace tested;

TEST(Study, AxesMakeAGridAndTheRestIsAdded) {
  const Study s = read(good);
  ASSERT_EQ(s.axes.size(), 3u);
  EXPECT_EQ(s.axes[0].name, "thickness");
  EXPECT_EQ(s.axes[0].role, Role::thickness);
  EXPECT_EQ(s.axes[1].role, Role::mesh);
  EXPECT_EQ(s.variants.size(), 12u + 1 + 20);  // the grid, the extra one, five factors twice at two levels of slip
  const Variant& v = variant(s, "thickness_0.75__fine__rough");
  EXPECT_EQ(v.label, "thickness x 0.75, fine, rough");
  const Case& c = std::get<Case>(v.definition);
  EXPECT_EQ(c.factors.thickness, 0.75);
  EXPECT_EQ(std::get<SheetGarment>(c.garments[0].shape).cells_v, 3);
  EXPECT_EQ(c.contact.friction, 0.4);
  // Its own title and not the case's: a variant may do something else than the case.
  EXPECT_EQ(c.name, "thin and thick: thickness x 0.75, fine, rough");
  EXPECT_EQ(c.description, "One run of the study \"thin and thick\".");
  // The baseline is found: thickness 1, everything else its own.
  EXPECT_EQ(s.variants[static_cast<std::size_t>(v.baseline)].folder, "thickness_1__fine__rough");
  const Variant& slow = variant(s, "thickness_1__coarse__rough__slow");
  EXPECT_EQ(std::get<Case>(slow.definition).time.max_step_s, 1e-4);
  EXPECT_EQ(s.variants[static_cast<std::size_t>(slow.baseline)].folder, "thickness_1__coarse__rough");
  const Variant& light = variant(s, "thickness_1__coarse__smooth__inertia_x_0.8");
  EXPECT_EQ(std::get<Case>(light.definition).factors.inertia, 0.8);
  // Variants of factors alone are one family, others are not.
  EXPECT_EQ(light.rest_identity, variant(s, "thickness_0.5__coarse__smooth").rest_identity);
  EXPECT_NE(light.rest_identity, variant(s, "thickness_0.5__coarse__rough").rest_identity);
  EXPECT_NE(light.identity, variant(s, "thickness_1__coarse__smooth").identity);
}

TEST(Study, AQuestionIsATitleOfItsOwn) {
  const Study s = read(replaced(good, "\"thin and thick\",", "\"How thick?\", \"description\": \"Which one?\","));
  const Case& c = std::get<Case>(variant(s, "thickness_1__fine__rough").definition);
  EXPECT_EQ(c.name, "How thick? Thickness x 1, fine, rough");
  EXPECT_EQ(c.description, "One run of the study \"How thick?\". Which one?");
}

TEST(Study, FilesOfValuesAreFoundBesideTheStudy) {
  const Folder folder;
  folder.write("sub.txt", "");
  std::filesystem::create_directories(folder.path() / "cases");
  std::filesystem::create_directories(folder.path() / "studies");
  folder.write("cases/cloth.json", cloth);
  folder.write("studies/ball.obj", "v 1 0 0\nv 2 0 0\nv 1 1 0\nv 1 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  const Study s = readStudy(folder.write("studies/s.json", R"({"name": "s", "case": "../cases/cloth.json", "axes": [
    {"name": "what", "path": "obstacles[0]", "labels": ["ball"], "values": [{"name": "ball", "mesh": {"file": "ball.obj"}}]}]})"));
  EXPECT_EQ(std::get<MeshObstacle>(std::get<Case>(s.variants[0].definition).obstacles[0].shape).file,
            folder.path() / "studies/ball.obj");
}

/// An axis is about what it changes, unless its name or its role says otherwise.
TEST(Study, RolesFollowFromPaths) {
  const Folder folder;
  folder.write("shorts.json", R"({"name": "shorts", "garment": {"shorts": {"cell": "60 mm"}},
    "fabric": {"thickness": "1 mm", "density": "500 kg/m^3", "young": "1 MPa", "poisson": 0.3,
               "bending": {"law": "linear", "rigidity": "1e-4 N m"}},
    "human": {"manikin": "male_p50", "motion": {"stand": {"duration": "1 s"}}}, "contact": {"friction": 0.3}})");
  const auto role = [&](const std::string& axis) {
    return readStudy(folder.write("a.study.json", R"({"name": "a", "case": "shorts.json", "axes": [{)" + axis + "}]}"))
        .axes[0]
        .role;
  };
  EXPECT_EQ(role(R"("path": "human.manikin", "values": ["male_p5", "male_p95"])"), Role::wearer);
  EXPECT_EQ(role(R"("path": "fabric.thickness", "values": ["1 mm", "2 mm"])"), Role::thickness);
  EXPECT_EQ(role(R"("path": "factors.thickness", "values": [1, 2])"), Role::thickness);
  EXPECT_EQ(role(R"("path": "fabric.young", "values": ["1 MPa", "2 MPa"])"), Role::material);
  EXPECT_EQ(role(R"("path": "fabric.bending.rigidity", "values": [1e-4, 2e-4])"), Role::material);
  EXPECT_EQ(role(R"("path": "contact.friction", "values": [0.1, 0.3])"), Role::friction);
  EXPECT_EQ(role(R"("path": "garment.shorts.ease", "values": ["2 %", "6 %"])"), Role::fit);
  EXPECT_EQ(role(R"("path": "garment.shorts.inseam", "values": ["10 cm", "15 cm"])"), Role::fit);
  EXPECT_EQ(role(R"("path": "garment.shorts.cell", "values": ["60 mm", "50 mm"])"), Role::mesh);
  EXPECT_EQ(role(R"("path": "human.motion.stand.duration", "values": [1, 2])"), Role::motion);
  EXPECT_EQ(role(R"("path": "garment.model", "values": ["nurbs", "shell"])"), Role::model);
  EXPECT_EQ(role(R"("path": "contact.tolerance", "values": [1e-3, 1e-4])"), Role::other);
  EXPECT_EQ(role(R"("name": "size", "path": "garment.shorts.ease", "values": ["2 %", "6 %"])"), Role::size);
  EXPECT_EQ(role(R"("path": "garment.shorts.ease", "values": ["2 %", "6 %"], "role": "size")"), Role::size);
  // Where several values go together: those that mean something; a garment that goes with its wearer is no choice.
  EXPECT_EQ(role(R"("name": "who", "labels": ["a", "b"], "sets": [
    {"human.manikin": "male_p5", "time.max_step": 1e-3}, {"human.manikin": "male_p95"}])"),
            Role::wearer);
  EXPECT_EQ(role(R"("name": "who", "labels": ["a", "b"], "sets": [
    {"human.manikin": "male_p5", "garment.shorts.ease": "4 %"}, {"human.manikin": "male_p95"}])"),
            Role::wearer);
  EXPECT_EQ(role(R"("name": "what", "labels": ["a", "b"], "sets": [
    {"fabric.young": "1 MPa", "contact.friction": 0.2}, {"fabric.young": "2 MPa"}])"),
            Role::other);
}

struct Bad {
  const char *from, *to;  ///< what is replaced in the good file
  const char* where;      ///< how the message goes on after the file's name
  const char* reason;
};

TEST(Study, MalformedOnesAreRefusedWithTheirPlace) {
  const Bad bads[]{
      {"factors.thickness", "factors.thicknes", ":5: factors.thicknes: ", "did you mean \"thickness\"?"},
      {"factors.thickness", "factors..thickness", ":5: factors..thickness: ", "not a path"},
      {"[0.5, 0.75, 1]", "[]", ":5: axes[0].values: ", "empty"},
      {"[0.5, 0.75, 1]", "0.5", ":5: axes[0].values: ", "expected a list"},
      {"[0.5, 0.75, 1]", "[0.5, -1]",
       ":5: factors.thickness: ", "allowed: >= 0.01 and <= 100 (variant thickness x -1, coarse, smooth)"},
      {"[0.5, 0.75, 1]", "[0.5, \"thick\"]", ":5: factors.thickness: ", "thick"},
      {"[0.5, 0.75, 1]", "[0.5, 0.5]", ":5: axes[0].values[1]: ", "name two levels alike"},
      {"[0.5, 0.75, 1]", "[{\"a\": 1}]", ":5: axes[0].labels: ", "is required"},
      {"[\"smooth\", \"rough\"]", "[\"smooth\"]", ":8: axes[2].labels: ", "1 labels for 2 values"},
      {"[\"smooth\", \"rough\"]", "[\"a b\", \"a_b\"]", ":8: axes[2].labels[1]: ", "alike"},
      {"\"name\": \"slip\"", "\"name\": \"mesh\"", ":8: axes[2].name: ", "names two axes"},
      {"\"path\": \"contact.friction\", ", "", ":8: axes[2].path: ", "is required"},
      {"cloth.json", "clothes.json", ":3: case: ", "there is no file"},
      {"\"case\": \"cloth.json\",", "", ":1: case: ", "is required"},
      {"\"name\": \"thin and thick\",", "\"name\": 3,", ":2: name: ", "expected a text"},
      {"{\"slip\": \"rough\"}", "{\"slip\": \"wet\"}", ":10: variants[0].at.slip: ", "allowed: smooth or rough"},
      {"{\"slip\": \"rough\"}", "{\"grip\": \"rough\"}", ":10: variants[0].at.grip: ", "there is no axis"},
      {"{\"time.max_step\": \"0.1 ms\"}", "{}", ":10: variants[0].set: ", "is empty"},
      {"\"0.1 ms\"", "\"0.1 mm\"", ":10: time.max_step: ", "variant"},
      {"\"step\": 0.2", "\"step\": 0.9", ":11: elasticities.step: ", "allowed: >= 0.001 and <= 0.5"},
      {"[\"coarse\"]}}", "[\"thin\"]}}", ":11: elasticities.where.mesh[0]: ", "is no level"},
      {"\"where\": {\"mesh\"", "\"where\": {\"thickness\"", ":11: elasticities.where.thickness: ", "axis of factors"},
      {"\"elasticities\"", "\"limits\": {\"green\": 0.2, \"red\": 0.1}, \"elasticities\"",
       ":11: limits.red: ", "allowed: > green"},
      {"\"elasticities\"", "\"baseline\": {\"thickness\": \"2\"}, \"elasticities\"",
       ":11: baseline.thickness: ", "is no level"},
      {"\"label\": \"slow\"", "\"label\": \"slow\", \"finer\": 2", ":10: variants[0].finer: ", "true or false"},
      {"\"axes\"", "\"axis\"", ":4: axis: ", "did you mean \"axes\"?"},
      {"\"garment.sheet.cells_u\": 3", "\"garment.disc.cells\": 3", ":7: garment.disc: ", "excludes"},
      {"[\"smooth\", \"rough\"]", "[\"smooth\", \"a\\u001b[31m\"]", ":8: axes[2].labels[1]: ", "control character"},
      {"\"label\": \"slow\"", "\"label\": \"slow\\n#SBATCH\"", ":10: variants[0].label: ", "control character"},
  };
  EXPECT_NO_THROW(read(good));
  for (const Bad& bad : bads) {
    SCOPED_TRACE(bad.to);
    try {
      read(replaced(good, bad.from, bad.to));
      ADD_FAILURE() << "was taken";
    } catch (const InputError& e) {
      const std::string what = e.what(), file = "a.study.json";
      const std::size_t at = what.find(file);
      ASSERT_NE(at, std::string::npos) << what;
      EXPECT_EQ(what.substr(at + file.size(), std::string(bad.where).size()), bad.where) << what;
      EXPECT_NE(what.find(bad.reason), std::string::npos) << what;
    }
  }
}

TEST(Study, TooManyVariantsAreRefusedBeforeTheyAreBuilt) {
  const auto refused = [](const std::vector<int>& levels, const std::string& more, const std::string& where) {
    std::string axes;
    for (std::size_t a = 0; a < levels.size(); ++a) {
      std::string values;
      for (int l = 0; l < levels[a]; ++l) values += (l ? ", " : "") + std::to_string(0.1 + 0.01 * l);
      axes += std::string(a ? ", " : "") + R"({"name": "a)" + std::to_string(a) +
              R"(", "path": "contact.friction", "values": [)" + values + "]}";
    }
    try {
      read(R"({"name": "many", "case": "cloth.json",)" + more + "\n\"axes\": [" + axes + "]}");
      ADD_FAILURE() << "not refused: " << levels.size() << " axes";
    } catch (const InputError& e) {
      EXPECT_EQ(e.where().key, where);
      EXPECT_NE(e.reason().find("more than 2,000 variants"), std::string::npos) << e.what();
    }
  };
  for (const auto& [axes, levels] : {std::pair{12, 2}, {6, 5}, {8, 3}, {20, 2}, {5, 7}, {64, 2}, {2, 45}})
    refused(std::vector<int>(static_cast<std::size_t>(axes), levels), "", "axes");
  refused({2, 101}, R"("elasticities": {"step": 0.1},)", "elasticities");
}

TEST(Study, ScriptsForSlurmHaveTheVariantsThatAreNotDone) {
  Study s = read(good);
  s.variants.resize(3);
  Options o;
  o.out = "/data/out";
  o.jobs = 2;
  o.threads = 4;
  const std::string script = slurmScript(s, o, {Stand::done, Stand::interrupted, Stand::fresh});
  EXPECT_NE(script.find("--array=0-1%2"), std::string::npos) << script;
  EXPECT_NE(script.find("folders=( thickness_0.5__coarse__rough thickness_0.5__fine__smooth)"), std::string::npos)
      << script;
  // What is fresh goes on too, when the queue starts it again.
  EXPECT_NE(script.find("again=( --resume --resume)"), std::string::npos) << script;
  EXPECT_NE(script.find("#SBATCH --requeue\n"), std::string::npos) << script;
  for (const char* option : {"--time", "--mem", "--partition", "--job-name"})
    EXPECT_EQ(script.find(option), std::string::npos) << script;
}

TEST(Study, StructuresBeginAgainUnderSlurm) {
  Study s = read(good);
  s.variants.resize(2);
  s.variants[1].definition = StructureCase{};
  const std::string script = slurmScript(s, {}, {Stand::fresh, Stand::interrupted});
  EXPECT_NE(script.find("again=( --resume '')"), std::string::npos) << script;
}

/// What each job asks for stands in both scripts, above the first command, where sbatch reads it.
TEST(Study, ScriptsForSlurmAskForWhatIsGiven) {
  Study s = read(good);
  s.variants.resize(1);
  Options o;
  o.out = "/data/out";
  o.queue = {"1-12:30", "8G", "long,short", "armour.1"};
  const std::string runs = slurmScript(s, o, {Stand::fresh}), compares = compareScript(s, o);
  for (const std::string& script : {runs, compares}) {
    const std::string head = script.substr(0, script.find("\ngambeson="));
    for (const char* line : {"\n#SBATCH --time=1-12:30\n", "\n#SBATCH --mem=8G\n", "\n#SBATCH --partition=long,short\n",
                             "\n#SBATCH --requeue\n"})
      EXPECT_NE(head.find(line), std::string::npos) << line << script;
  }
  EXPECT_NE(runs.find("\n#SBATCH --job-name=armour.1\n"), std::string::npos) << runs;
  EXPECT_NE(compares.find("\n#SBATCH --job-name=armour.1_compare\n"), std::string::npos) << compares;
  EXPECT_EQ(compares.find("--array"), std::string::npos) << compares;
}

TEST(Study, WhatSlurmIsAskedForIsChecked) {
  const auto refused = [](const Queue& q, bool slurm, const std::string& option, const std::string& reason) {
    try {
      checkQueue(q, slurm);
      ADD_FAILURE() << option << " was taken";
    } catch (const InputError& e) {
      EXPECT_EQ(e.where().key, option);
      EXPECT_NE(e.reason().find(reason), std::string::npos) << e.what();
    }
  };
  for (const char* time : {"90", "90:00", "36:00:00", "1-12", "1-12:30", "1-12:30:15"})
    EXPECT_NO_THROW(checkQueue({time, {}, {}, {}}, true)) << time;
  for (const char* time : {"", "2h", "-1", "1:2:3:4", "1-", "90 ", "90\n#SBATCH --wrap=x"})
    refused({time, {}, {}, {}}, true, "--time", "HOURS:MINUTES:SECONDS");
  for (const char* memory : {"500", "500M", "8G", "1T"})
    EXPECT_NO_THROW(checkQueue({{}, memory, {}, {}}, true)) << memory;
  for (const char* memory : {"", "8 GB", "8GB", "-8G", "0.5G", "8g"})
    refused({{}, memory, {}, {}}, true, "--mem", "a whole number of MB");
  EXPECT_NO_THROW(checkQueue({{}, {}, "gpu-long,short_1", {}}, true));
  for (const char* partition : {"", "a b", "a,", "-a", "$(x)"})
    refused({{}, {}, partition, {}}, true, "--partition", "with commas between");
  EXPECT_NO_THROW(checkQueue({{}, {}, {}, "armour_2.5-x"}, true));
  for (const char* name : {"", "a b", "%j", "-a", "a/b", "a'"})
    refused({{}, {}, {}, name}, true, "--job-name", "letters, digits");
  refused({"90", {}, {}, {}}, false, "--time", "\"90\" is for Slurm; allowed: with --engine slurm");
  refused({{}, {}, {}, "x"}, false, "--job-name", "allowed: with --engine slurm");
  EXPECT_NO_THROW(checkQueue({}, false));
}

/// What a study or a batch writes itself is no name of a variant: said before anything runs.
TEST(Study, NamesOfItsOwnFilesAreTaken) {
  const std::string one =
      R"({"name": "s", "case": "cloth.json", "variants": [{"label": "NAME", "set": {"contact.friction": 0.2}}]})";
  const Folder folder;
  for (const std::string name : {"report.html",      "study.json", "variants.csv", "curves.csv",    "exponents.csv",
                                 "elasticities.csv", "meshes.csv", "uncertainty.csv", "study.slurm",  "compare.slurm", "compare.log",
                                 "submit.sh",        "cases",      "logs",         "pictures",      "Cases",
                                 "REPORT.html",      ".",          "..",           ".lock",         ".gambeson"}) {
    SCOPED_TRACE(name);
    try {
      read(replaced(one, "NAME", name));
      ADD_FAILURE() << "was taken";
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find("cannot be called \"" + name + "\""), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find("a.study.json:1: variants[0]"), std::string::npos) << e.what();
    }
    if (name[0] != '.') {
      EXPECT_THROW(batchOf({folder.write(name + ".json", cloth)}), InputError);
    }
  }
  EXPECT_NO_THROW(read(replaced(one, "NAME", "case")));
  // What is written is on the list: nothing else is left in the folder.
  const Study s = read(good);
  const Folder tables;
  writeStudyTables(s, compare(s, numbersOf(s)), tables.path());
  for (const auto& entry : std::filesystem::directory_iterator(tables.path())) {
    EXPECT_FALSE(files::unfitFolder(entry.path().filename().string()).empty()) << entry.path();
  }
}

/// bash is given the script of a study whose paths and names mean something to it.
TEST(Study, AScriptHasPathsAsTheyAre) {
  const Folder folder;
  Study s = read(good);
  s.variants.resize(1);
  Options o;
  o.out = folder.path() / "x'$(touch F)'\"`touch G` o'brien";
  std::filesystem::create_directories(o.out / "logs");
  o.binary = folder.write("fake program", "#!/bin/sh\nprintf '%s|' \"$@\" > \"$4.arguments\"\n").string();
  std::filesystem::permissions(o.binary, std::filesystem::perms::owner_all);
  folder.write("script", slurmScript(s, o, {Stand::interrupted}));
  ASSERT_EQ(
      std::system(
          ("cd '" + folder.path().string() + "' && SLURM_ARRAY_TASK_ID=0 SLURM_CPUS_PER_TASK=3 bash script").c_str()),
      0);
  std::ifstream said((o.out / s.variants[0].folder).string() + ".arguments");
  const std::string out = o.out.string(), name = s.variants[0].folder;
  EXPECT_EQ(
      std::string(std::istreambuf_iterator<char>(said), {}),
      "run|" + out + "/cases/" + name + ".json|--out|" + out + "/" + name + "|--threads|3|--device|cpu|--resume|");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "F"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "G"));
  // The same of what compares, by the study's file and of a batch by its cases.
  const auto compared = [&] {
    folder.write("script", compareScript(s, o));
    EXPECT_EQ(std::system(("cd '" + folder.path().string() + "' && SLURM_CPUS_PER_TASK=3 bash script").c_str()), 0);
    std::ifstream words(out + ".arguments");
    return std::string(std::istreambuf_iterator<char>(words), {});
  };
  s.file = folder.path() / "my study.json";
  EXPECT_EQ(compared(), "study|" + s.file.string() + "|--out|" + out + "|--compare|--threads|3|--device|cpu|");
  o.csv = "european";
  EXPECT_NE(compared().find("|--csv|european|"), std::string::npos);
  s.file.clear();
  std::get<Case>(s.variants[0].definition).file = folder.path() / "my case.json";
  EXPECT_NE(compared().find("batch|" + (folder.path() / "my case.json").string() + "|--out|"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "F"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "G"));
  // What the queue itself reads has no text of the user's.
  std::istringstream lines(slurmScript(s, o, {Stand::fresh}) + compareScript(s, o));
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("#SBATCH")) {
      EXPECT_EQ(line.find('\''), std::string::npos) << line;
    }
  }
}

/// The comparison waits for the runs, whatever becomes of them; where it cannot be handed in, neither are the runs.
TEST(Study, BothScriptsAreHandedIn) {
  const Folder folder;
  Options o;
  o.out = folder.path() / "o'brien's out";
  const auto fake = [&](const std::string& name, const std::string& text) {
    std::filesystem::permissions(folder.write(name, "#!/bin/sh\nprintf '%s|' " + name + " \"$@\" >> said\n" + text),
                                 std::filesystem::perms::owner_all);
  };
  folder.write("script", submitScript(o));
  const auto handedIn = [&] {
    std::filesystem::remove(folder.path() / "said");
    const int status =
        std::system(("cd '" + folder.path().string() + "' && PATH=.:$PATH bash script --account=x >/dev/null").c_str());
    std::ifstream said(folder.path() / "said");
    return std::pair(status, std::string(std::istreambuf_iterator<char>(said), {}));
  };
  const std::string out = o.out.string(), runs = "sbatch|--parsable|--account=x|" + out + "/study.slurm|",
                    compares = "sbatch|--parsable|--dependency=afterany:17|--account=x|" + out + "/compare.slurm|";
  fake("scancel", "");
  fake("sbatch", "echo '17;cluster'\n");
  EXPECT_EQ(handedIn(), std::pair(0, runs + compares));
  fake("sbatch", "case $2 in --dep*) exit 1;; esac\necho 17\n");
  const auto [status, said] = handedIn();
  EXPECT_NE(status, 0);
  EXPECT_EQ(said, runs + compares + "scancel|17|");
  fake("sbatch", "exit 1\n");
  EXPECT_EQ(handedIn().second, runs);
}

TEST(Study, BatchesRefuseTwoOfOneName) {
  const Folder folder;
  const auto a = folder.write("cloth.json", cloth);
  std::filesystem::create_directories(folder.path() / "b");
  const auto b = folder.write("b/cloth.json", cloth);
  EXPECT_EQ(batchOf({a}).variants[0].folder, "cloth");
  EXPECT_EQ(std::get<Case>(batchOf({a}).variants[0].definition).name, "cloth");
  EXPECT_THROW(batchOf({a, b}), InputError);
}

}  // namespace
}  // namespace gambeson::study
