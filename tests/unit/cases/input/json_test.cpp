#include "cases/input/json.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace gambeson {
namespace {

TEST(Json, EveryValueKnowsItsLine) {
  const JsonNode root =
      parseJson("{\n  \"a\": 1.5\n,\n \"b\":\n [\n1,\n\"x\"\n]\r\n, \"c\": {\"d\": true,\n\"e\": null}\n}\n", "f");
  EXPECT_EQ(root.line, 1);
  EXPECT_EQ(root.find("a")->line, 2);  // the lexer reads past the number into line 3
  EXPECT_EQ(root.find("a")->number, 1.5);
  EXPECT_EQ(root.find("b")->line, 4);
  EXPECT_EQ(root.find("b")->children[0].line, 6);
  EXPECT_EQ(root.find("b")->children[1].line, 7);
  EXPECT_EQ(root.find("c")->line, 9);
  EXPECT_EQ(root.find("c")->find("d")->line, 9);
  EXPECT_EQ(root.find("c")->find("e")->line, 10);
  EXPECT_EQ(root.find("z"), nullptr);
}

TEST(Json, WholeNumbersAreKept) {
  const JsonNode root = parseJson("[1, -2, 1.0, 18446744073709551615]", "f");
  EXPECT_TRUE(root.children[0].is_integer);
  EXPECT_EQ(root.children[1].number, -2);
  EXPECT_FALSE(root.children[2].is_integer);
  EXPECT_EQ(root.children[3].number, 18446744073709551615.0);
}

struct Bad {
  std::string text;
  int line;
  std::string key;
  std::string reason;
};

TEST(Json, MistakesAreNamed) {
  const std::string deep(40, '[');
  const Bad cases[] = {
      {"", 0, "", "empty"},
      {" \n \n", 0, "", "empty"},
      {"{", 1, "", "unexpected end of input"},
      {"{\"a\": 1,\n\"b\": [1, 2", 2, "b", "unexpected end of input"},
      {"{\"a\": 1\n\"b\": 2}", 2, "", "unexpected string literal"},
      {"{\"a\": 1,\n}", 2, "", "unexpected '}'"},
      {"{\"a\": NaN}", 1, "a", "invalid literal"},
      {"{\n\"a\": Infinity}", 2, "a", "invalid literal"},
      {"{\"a\": -Infinity}", 1, "a", "invalid number"},
      {"{\"a\": 1e999}", 1, "a", "too large"},
      {"{\"a\": 01}", 1, "", "unexpected number literal"},
      {"{\"a\": 'x'}", 1, "a", "invalid literal"},
      {"{\"a\": \"x\n\"}", 1, "a", "control character"},
      {"{\"a\": \"\xff\"}", 1, "a", "UTF-8"},
      {"{} {}", 1, "", "expected end of input"},
      {std::string("{\"a\"\0: 1}", 10), 1, "a", "not a text file"},
      {"{\"a\": 1,\n\"b\": 2,\n\"a\": 3}", 3, "a", "written twice, first in line 1"},
      {"{\"o\": [{\"a\": 1},\n{\"a\": 1, \"a\": 3}]}", 2, "o[1].a", "written twice"},
      {deep, 1, "", "nested deeper than 32"},
      {std::string(2 << 20, ' ') + "{}", 0, "", "at most"},
  };
  for (const Bad& c : cases) {
    SCOPED_TRACE(c.text.substr(0, 60));
    try {
      parseJson(c.text, "f.json");
      FAIL() << "accepted";
    } catch (const InputError& e) {
      EXPECT_EQ(e.where().file, "f.json");
      EXPECT_EQ(e.where().line, c.line) << e.what();
      EXPECT_EQ(e.where().key, c.key) << e.what();
      EXPECT_NE(e.reason().find(c.reason), std::string::npos) << e.what();
      EXPECT_EQ(e.reason().find("json.exception"), std::string::npos) << e.what();
    }
  }
}

TEST(Json, ValuesAreCountedAsTheyAreRead) {
  const JsonLimits few{.values = 6};  // the object, a, its three numbers, b
  EXPECT_EQ(parseJson("{\"a\": [1, 2, 3],\n\"b\": 4}", "f.json", few).children.size(), 2u);
  try {
    parseJson("{\"a\": [1, 2, 3],\n\"b\": [4]}", "f.json", few);
    FAIL() << "accepted";
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "f.json:2: more than 6 values; at most so many are read");
  }
}

TEST(Json, OverridesReplaceAndAdd) {
  JsonNode root = parseJson(R"({"a": {"b": 1}, "l": [1, {"x": 2}]})", "f");
  overrideValue(root, "a.b", "7");
  overrideValue(root, "a.c.d", "0.4 mm");
  overrideValue(root, "l[1].x", "[1, 2]");
  overrideValue(root, "l[2]", "true");
  EXPECT_EQ(root.find("a")->find("b")->number, 7);
  EXPECT_EQ(root.find("a")->find("b")->line, 0);
  EXPECT_EQ(root.find("a")->find("c")->find("d")->text, "0.4 mm");
  EXPECT_EQ(root.find("l")->children[1].find("x")->children.size(), 2u);
  EXPECT_EQ(root.find("l")->children[1].find("x")->children[1].line, 0);
  EXPECT_TRUE(root.find("l")->children[2].boolean);
}

TEST(Json, BadOverridePaths) {
  JsonNode root = parseJson(R"({"a": 1, "l": [1]})", "f");
  for (const char* path : {"", ".", "a.", ".a", "a..b", "l[", "l[]", "l[x]", "l[-1]", "l[9999999]", "[0]", "l[3]",
                           "a.b", "l.b", "a[0]", "l[0]x"}) {
    try {
      overrideValue(root, path, "1");
      ADD_FAILURE() << path << " accepted";
    } catch (const InputError& e) {
      EXPECT_EQ(e.where().file, "command line");
      EXPECT_EQ(e.where().key, path);
    }
  }
}

}  // namespace
}  // namespace gambeson
