/// All that is wrong with a file is said at once, in its order, and nothing that follows from another mistake; keys
/// that belong elsewhere say where; numbers that textiles do not have are warned of.

#include "cases/input/mistakes.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "cases/cloth/card.hpp"
#include "cases/cloth/usual.hpp"
#include "cases/input/overrides.hpp"
#include "cases/input/unit_symbols.hpp"
#include "cases/input/units.hpp"
#include "cases/kinds/any_case.hpp"
#include "cases/wear/case/fields.hpp"
#include "unit/cases/example.hpp"

namespace gambeson {
namespace {

std::vector<InputError> mistakesIn(const std::string& text) {
  const Folder folder;
  try {
    readAnyCase(folder.write("example.json", text));
  } catch (const InputError& e) {
    return mistakesOf(e);
  }
  return {};
}

std::vector<std::string> keysOf(const std::vector<InputError>& mistakes) {
  std::vector<std::string> keys;
  for (const InputError& e : mistakes) keys.push_back(std::to_string(e.where().line) + " " + e.where().key);
  return keys;
}

using Keys = std::vector<std::string>;

TEST(Mistakes, AllOfAFileAreSaidInItsOrder) {
  std::string text = replaced(example, "\"1 mm\"", "\"12 m\"");
  text = replaced(text, "\"rings\": 8", "\"rings\": \"many\"");
  text = replaced(text, "[0, 0, \"1 mm/s\"]", "[\"1 mm\", 0, \"1 kg\"]");
  text = replaced(text, "\"cells_u\": 8", "\"cells_u\": 0");
  text = replaced(text, "\"friction\": 0.2", "\"fricton\": 0.2");
  EXPECT_EQ(keysOf(mistakesIn(text)),
            (Keys{"4 garment.sheet.cells_u", "9 fabric.thickness", "20 obstacles[0].sphere.rings",
                  "21 obstacles[1].velocity[0]", "21 obstacles[1].velocity[2]", "27 contact.fricton"}));
}

/// Rules between keys are tried where the keys hold, each by itself.
TEST(Mistakes, RulesThatAreBrokenAreSaidTogether) {
  std::string text = replaced(example, "natural_walk", "aiming");
  text = replaced(text, "\"floor\"", "\"ball\"");
  text = replaced(text, "\"edge\": \"0.v1\"", "\"edge\": \"1.v1\"");
  EXPECT_EQ(keysOf(mistakesIn(text)),
            (Keys{"21 obstacles[1].name", "25 supports[1].springs.edge", "33 analysis.task"}));
  text = replaced(example, "hip_flexion_left", "hip");
  text = replaced(text, "\"link\": \"pelvis\"", "\"link\": \"tail\"");
  text = replaced(text, "\"0.5 s\"", "\"5 s\"");
  EXPECT_EQ(keysOf(mistakesIn(text)),
            (Keys{"25 supports[1].springs.link", "32 output.pictures[1].time", "33 analysis.joints[0]"}));
}

TEST(Mistakes, WhatFollowsFromAnotherIsNotListed) {
  // Not also: thickness is required.
  EXPECT_EQ(keysOf(mistakesIn(replaced(example, "\"thickness\"", "\"thicknes\""))), Keys{"9 fabric.thicknes"});
  // Not also: one of sheet, disc, ... is required.
  EXPECT_EQ(keysOf(mistakesIn(replaced(example, "\"sheet\"", "\"shet\""))), Keys{"4 garment.shet"});
  // Not also: its rules, nor those of the whole file.
  EXPECT_EQ(keysOf(mistakesIn(replaced(replaced(example, "\"rigidity\": \"7e-6 N m\"", "\"rigidity\": true"),
                                       "natural_walk", "aiming"))),
            Keys{"13 fabric.bending.rigidity"});
}

TEST(Mistakes, KeysThatBelongElsewhereSayWhere) {
  const auto reasonOf = [](const std::string& from, const std::string& to) {
    const std::vector<InputError> all = mistakesIn(replaced(example, from, to));
    return all.empty() ? std::string("accepted") : all.front().reason();
  };
  EXPECT_NE(reasonOf("\"poisson\": 0.3,", "\"poisson\": 0.3, \"drag\": 1,").find("\"drag\" belongs under air"),
            std::string::npos);
  EXPECT_NE(reasonOf("\"name\": \"example\",", "\"name\": \"example\", \"friction\": 0.2,")
                .find("\"friction\" belongs under contact"),
            std::string::npos);
  EXPECT_NE(reasonOf("\"friction\": 0.2", "\"friction\": 0.2, \"gravity\": [0, 0, 0]")
                .find("\"gravity\" belongs at the top of the file"),
            std::string::npos);
  EXPECT_NE(reasonOf("\"weft_angle\"", "\"inseam\": 1, \"weft_angle\"").find("\"inseam\" belongs under garment."),
            std::string::npos);
  EXPECT_NE(reasonOf("\"name\": \"example\",", "\"name\": \"example\", \"material\": {},")
                .find("cases of \"kind\" static, dynamic or modal have it"),
            std::string::npos);
}

TEST(Mistakes, AFileMayNameItsSchema) {
  const std::string schema = "\"$schema\": \"case.schema.json\", ";
  EXPECT_TRUE(mistakesIn(replaced(example, "\"name\": \"example\"", schema + "\"name\": \"example\"")).empty());
  EXPECT_EQ(keysOf(mistakesIn(replaced(example, "\"name\": \"example\"", "\"$schema\": 3, \"name\": \"example\""))),
            Keys{"2 $schema"});
  EXPECT_EQ(keysOf(mistakesIn(replaced(example, "\"poisson\"", schema + "\"poisson\""))), Keys{"12 fabric.$schema"});
}

/// Ranges are said in the unit that was typed.
TEST(Mistakes, AnswersAreInTheUnitThatWasTyped) {
  const auto reasonOf = [](const std::string& thickness) {
    return mistakesIn(replaced(example, "\"1 mm\"", thickness)).front().reason();
  };
  EXPECT_EQ(reasonOf("\"3000 mil\""), "3000 mil is out of range; allowed: > 0 and <= 1968.5 mil");
  EXPECT_EQ(reasonOf("\"6 cm\""), "6 cm is out of range; allowed: > 0 and <= 5 cm");
  EXPECT_EQ(mistakesIn(replaced(example, "\"frame\": \"20 ms\"", "\"frame\": \"25 ms\"")).front().reason(),
            "25 ms is not a multiple of window = 10 ms; allowed: a multiple");
  EXPECT_EQ(reasonOf("0.06"), "0.06 m is out of range; allowed: > 0 and <= 0.05 m");
}

void expectNamed(const schema::Object& object) {
  for (const schema::Field& f : object.fields) {
    EXPECT_FALSE(measureOf(f.unit).starts_with("one like")) << object.title << ": " << f.key;
    if (f.object) expectNamed(*f.object);
  }
}

/// Whatever a key measures has a name and three units, which measure the same.
TEST(Mistakes, EveryDimensionOfAKeyHasAName) {
  for (const schema::KindOfFile& k : kindsOfCase()) expectNamed(*k.root);
  expectNamed(schema::cardTable());
  const Measure* density = measureWith(parseUnit("kg/m^3").dimension);
  ASSERT_NE(density, nullptr);
  for (const std::string_view unit : density->units)
    EXPECT_EQ(parseUnit(unit).dimension, parseUnit("kg/m^3").dimension) << unit;
}

std::vector<InputError> unusualIn(const std::string& text) {
  const Folder folder;
  const std::filesystem::path file = folder.write("example.json", text);
  const JsonNode root = readCaseNode(file, {});
  const std::string name = file.string();
  return unusualNumbers(schema::caseTable(), schema::Entry{root, "", name});
}

TEST(Mistakes, NumbersThatTextilesDoNotHaveAreWarnedOf) {
  EXPECT_TRUE(unusualIn(example).empty());
  const auto warned = [](const std::string& from, const std::string& to) {
    const std::vector<InputError> all = unusualIn(replaced(example, from, to));
    return all.size() == 1 ? all[0].where().key + ": " + all[0].reason() : std::string("no single warning");
  };
  EXPECT_EQ(warned("\"1 mm\"", "\"40 mm\""),
            "fabric.thickness: 40 mm is unusual: fabrics have >= 0.02 and <= 20 mm; check its unit");
  EXPECT_EQ(warned("\"436 kg/m^3\"", "0.32"),
            "fabric.density: 0.32 kg/m^3 is unusual: fabrics have >= 20 and <= 3000 kg/m^3; check its unit");
  EXPECT_EQ(warned("\"1.2 MPa\"", "\"210 GPa\""),
            "fabric.young: 210 GPa is unusual: fabrics have >= 1e-06 and <= 100 GPa; check its unit");
}

/// What ships has none: its recordings and pages are as before.
TEST(Mistakes, TheLibraryIsUsual) {
  int read = 0;
  for (const auto& entry : std::filesystem::directory_iterator(GAMBESON_SOURCE_DIR "/cases/library")) {
    const std::filesystem::path& file = entry.path();
    if (file.extension() != ".json" || file.string().ends_with(".study.json")) continue;
    const JsonNode root = readCaseNode(file, {});
    const std::string name = file.string();
    const JsonNode* kind = root.find("kind");
    for (const schema::KindOfFile& k : kindsOfCase())
      if (k.kind == (kind ? kind->text : "wear"))
        for (const InputError& w : unusualNumbers(*k.root, schema::Entry{root, "", name})) ADD_FAILURE() << w.what();
    ++read;
  }
  EXPECT_GT(read, 40);
}

}  // namespace
}  // namespace gambeson
