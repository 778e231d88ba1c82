/// `gambeson fabric`, through the binary: what it says and leaves, and what it refuses.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <nlohmann/json.hpp>

#include "cases/kinds/any_case.hpp"
#include "unit/cases/content.hpp"
#include "unit/cases/example.hpp"

namespace gambeson {
namespace {

const char* const denim = GAMBESON_SOURCE_DIR "/cases/library/cards/denim_a.card.json";

struct Outcome {
  int status = -1;
  std::string out, err;
};

Outcome fabric(const Folder& folder, const std::string& arguments) {
  const std::filesystem::path out = folder.path() / "stdout", err = folder.path() / "stderr";
  const std::string command = "cd '" + folder.path().string() + "' && '" GAMBESON_BINARY "' fabric " + arguments +
                              " >'" + out.string() + "' 2>'" + err.string() + "' </dev/null";
  const int raw = std::system(command.c_str());
  return {WIFEXITED(raw) ? WEXITSTATUS(raw) : -1, content(out), content(err)};
}

TEST(FabricCommand, MeasuresWhatTheCardSays) {
  const Folder folder;
  const Outcome o = fabric(folder, std::string(denim) + " --out lab --cells 8");
  ASSERT_EQ(o.status, 0) << o.err;
  for (const char* said :
       {"KES-FB2 bending, along the weft", "KES-FB1 shear", "assumed: weight", "2HB at 1/cm", "2HG5"})
    EXPECT_NE(o.out.find(said), std::string::npos) << said << "\n" << o.out;
  const auto all = nlohmann::json::parse(content(folder.path() / "lab/laboratory.json"));
  ASSERT_EQ(all.at("tests").size(), 3u);
  for (const auto& test : all.at("tests"))
    for (const auto& reading : test.at("readings"))
      EXPECT_LT(std::abs(reading.at("difference").get<double>()), 0.005) << reading;
  for (const char* stem : {"bending_0", "shear_0", "tension_0"}) {
    EXPECT_NE(content(folder.path() / "lab" / (std::string(stem) + ".svg")).find("<svg xmlns"), std::string::npos);
    EXPECT_NE(content(folder.path() / "lab" / (std::string(stem) + ".csv")).find(","), std::string::npos);
  }
  // Its own files are replaced, those of others are not.
  EXPECT_EQ(fabric(folder, std::string(denim) + " --out lab --cells 8 --test bending").status, 0);
  folder.write("lab/bending_0.csv", "mine");
  const Outcome refused = fabric(folder, std::string(denim) + " --out lab --cells 8 --test bending");
  EXPECT_EQ(refused.status, 2);
  EXPECT_EQ(content(folder.path() / "lab/bending_0.csv"), "mine");
}

TEST(FabricCommand, BendsTrianglesAsItIsTold) {
  const Folder folder;
  const auto slope = [&](const std::string& elements) {
    const Outcome o = fabric(folder, std::string(denim) + " --out lab --cells 8 --test bending --model triangles --mesh equilateral" +
                                         (elements.empty() ? "" : " --bending-elements " + elements));
    EXPECT_EQ(o.status, 0) << o.err;
    const std::string word = elements.empty() ? "midedge" : elements;
    EXPECT_NE(content(folder.path() / "lab/bending_0.svg").find("bent as " + word), std::string::npos) << word;
    const auto all = nlohmann::json::parse(content(folder.path() / "lab/laboratory.json"));
    return all.at("tests").at(0).at("readings").at(0).at("measured").get<double>();
  };
  const double of_edges = slope("midedge");
  EXPECT_EQ(slope(""), of_edges);
  EXPECT_LT(slope("hinge"), 0.9 * of_edges) << "hinges on such a mesh: 0.85";
  const Outcome refused = fabric(folder, std::string(denim) + " --bending-elements plate");
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("--bending-elements"), std::string::npos) << refused.err;
}

/// A loop that the laboratory drew gives stops whose loop is the same.
TEST(FabricCommand, FitsALoop) {
  const Folder folder;
  ASSERT_EQ(fabric(folder, std::string(denim) + " --out lab --cells 8 --test bending").status, 0);
  const Outcome o = fabric(folder, std::string(denim) + " --fit lab/bending_0.csv -o fitted.json --out again "
                                                        "--cells 8 --test bending");
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_NE(o.out.find("what the stops miss"), std::string::npos);
  const auto again = nlohmann::json::parse(content(folder.path() / "again/laboratory.json"));
  for (const auto& reading : again.at("tests")[0].at("readings"))
    EXPECT_LT(std::abs(reading.at("difference").get<double>()), 0.01) << reading;
  // What it wrote is the fabric of a case.
  const auto fitted = nlohmann::json::parse(content(folder.path() / "fitted.json"));
  EXPECT_EQ(fitted.at("provenance").at("name"), "Denim A");
  auto whole = nlohmann::json::parse(example);
  whole["fabric"] = fitted.at("fabric");
  EXPECT_NO_THROW(readAnyCase(folder.write("case.json", whole.dump(2))));
}

TEST(FabricCommand, RefusesBadLoops) {
  const Folder folder;
  const auto refused = [&](const std::string& text, const std::string& why) {
    folder.write("loop.csv", text);
    const Outcome o = fabric(folder, std::string(denim) + " --fit loop.csv -o f.json");
    EXPECT_EQ(o.status, 2) << text;
    EXPECT_NE(o.err.find(why), std::string::npos) << o.err;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "f.json"));
  };
  refused("", "is empty");
  refused("k,m\n1,2\n", "loop.csv:1");
  refused("curvature_per_cm,moment_N\n1,x\n", "loop.csv:2: moment_N: \"x\" is no number");
  refused("curvature_per_cm,moment_N\n1\n", "loop.csv:2: moment_N: is missing");
  refused("curvature_per_cm,moment_N\n1e9,1\n", "out of range");
  refused("curvature_per_cm,moment_N\n0,0\n1,1\n2,2\n", "too few");
}

}  // namespace
}  // namespace gambeson
