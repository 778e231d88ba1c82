/// The rows of garments, motions, obstacles and supports stand in the order of what they are of: what is written of
/// each stands under the key of its own row, and under no other's.

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <utility>
#include <variant>

#include "cases/contact/fields.hpp"
#include "cases/contact/obstacles/kind.hpp"
#include "cases/wear/case/fields.hpp"
#include "cases/wear/case/garments/kind.hpp"
#include "cases/wear/case/motions/kind.hpp"
#include "cases/wear/case/supports/kind.hpp"

namespace gambeson {
namespace {

/// Calls f once for each alternative, with the variant holding it.
template <class Variant, class F, std::size_t... I>
void forEach(Variant& v, F f, std::index_sequence<I...>) {
  ((v.template emplace<I>(), f()), ...);
}
template <class Variant, class F>
void forEach(Variant& v, F f) {
  forEach(v, f, std::make_index_sequence<std::variant_size_v<Variant>>());
}

template <class Kinds>
void expectOnly(const JsonNode& written, const std::string& word, const Kinds& kinds) {
  for (const auto* kind : kinds) EXPECT_EQ(written.find(kind->word) != nullptr, kind->word == word) << kind->word;
}

TEST(Kinds, OfGarments) {
  const schema::Object table = schema::garmentTable();
  GarmentCase g;
  forEach(g.shape, [&] { expectOnly(schema::writeObject(table, &g), kindOf(g).word, garmentKinds()); });
}

TEST(Kinds, OfMotions) {
  const schema::Object table = schema::humanTable();
  HumanCase h;
  h.manikin = "male_p50";
  forEach(h.motion, [&] {
    const JsonNode written = schema::writeObject(table, &h);
    ASSERT_NE(written.find("motion"), nullptr);
    expectOnly(*written.find("motion"), kindOf(h).word, motionKinds());
  });
}

TEST(Kinds, OfObstacles) {
  const schema::Object table = schema::obstacleTable();
  ObstacleCase o;
  forEach(o.shape, [&] { expectOnly(schema::writeObject(table, &o), kindOf(o).word, obstacleKinds()); });
}

TEST(Kinds, OfSupports) {
  const schema::Object table = schema::supportTable();
  SupportCase s;
  forEach(s, [&] { expectOnly(schema::writeObject(table, &s), kindOf(s).word, supportKinds()); });
}

/// Only what is read from a file, or is triangles already, is different for those who draft.
TEST(Kinds, OfGarmentsSayWhereTheyComeFrom) {
  const std::set<std::string> drafted{"shorts", "trousers", "belt", "shirt", "skirt"};
  for (const GarmentKind* kind : garmentKinds()) {
    const std::string word = kind->word;
    EXPECT_EQ(kind->isRead(), word == "file" || word == "mesh_file" || word == "pattern") << word;
    EXPECT_EQ(kind->sewn, word == "pattern") << word;
    EXPECT_EQ(kind->isMesh(), word == "mesh_file") << word;
    EXPECT_EQ(kind->drafted, drafted.contains(word)) << word;
    EXPECT_NE(kind->make, nullptr) << word;
  }
}

}  // namespace
}  // namespace gambeson
