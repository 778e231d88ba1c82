/// Which edges of cloth are sharp enough to meet edges, and which samples are one contact.
#include "core/contact/cloth_contacts.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace gambeson {
namespace {

/// How many contacts two ridges have that cross at right angles, each with faces that fall away from the other by an
/// angle of this sine. The one below may be a border, with one face.
std::size_t contactsOfRidges(double below, double above, bool both_faces = true) {
  const auto fall = [](double sine) { return sine / std::sqrt(1 - sine * sine); };
  const double gap = 0.01;
  const std::vector<Vec3> x{{-1, 0, 0},   {1, 0, 0},   {0, 1, -fall(below)},      {0, -1, -fall(below)},
                            {0, -1, gap}, {0, 1, gap}, {1, 0, gap + fall(above)}, {-1, 0, gap + fall(above)}};
  std::vector<std::array<int, 3>> triangles{{0, 1, 2}, {4, 5, 6}, {5, 4, 7}};
  if (both_faces) triangles.push_back({1, 0, 3});
  const ContactMesh mesh = contactMesh(8, triangles);
  const auto edge = [&](int v, int w) {
    return static_cast<int>(std::ranges::find(mesh.edges, std::array{v, w}) - mesh.edges.begin());
  };
  CandidatePairs pairs;
  pairs.edges.push_back({edge(0, 1), edge(4, 5)});
  const ClothFacts facts{8, x, {0, 0, 0, 0, 1, 1, 1, 1}, std::vector<double>(8, gap)};
  std::vector<ClothContactPoint> out;
  clothContacts(mesh, facts, pairs, x, x, out);
  return out.size();
}

TEST(ClothContacts, RidgesMeetWhereBothAreSharp) {
  // Faces bend away by more than a sine of 0.05.
  for (const double sharp : {0.0501, 0.06, 0.3, 0.9})
    for (const double blunt : {0.0499, 0.0495, 0.04, 0.0, -0.3}) {
      EXPECT_EQ(contactsOfRidges(sharp, sharp), 1u) << sharp;
      EXPECT_EQ(contactsOfRidges(sharp, blunt), 0u) << sharp << " and " << blunt;
      EXPECT_EQ(contactsOfRidges(blunt, sharp), 0u) << sharp << " and " << blunt;
    }
}

TEST(ClothContacts, ABorderIsSharpWhereItsOneFaceFallsAway) {
  EXPECT_EQ(contactsOfRidges(0.0501, 0.1, false), 1u);
  EXPECT_EQ(contactsOfRidges(0.0499, 0.1, false), 0u);
}

/// Contacts of the middles, 0 and 5, of two flat squares one above the other, the upper one shifted.
std::vector<ClothContactPoint> contactsOfMiddles(double shift, double gap) {
  std::vector<Vec3> x;
  for (const Vec3& from : {Vec3{}, Vec3{shift, 0.3 * shift, gap}})
    for (const Vec3& corner : {Vec3{}, Vec3{-1, -1, 0}, Vec3{1, -1, 0}, Vec3{1, 1, 0}, Vec3{-1, 1, 0}})
      x.push_back(from + corner);
  std::vector<std::array<int, 3>> triangles;
  for (const int first : {0, 5})
    for (int k = 0; k < 4; ++k) triangles.push_back({first, first + 1 + k, first + 1 + (k + 1) % 4});
  const ContactMesh mesh = contactMesh(10, triangles);
  CandidatePairs pairs;
  for (int t = 0; t < 4; ++t) {
    pairs.points.push_back({5, t});
    pairs.points.push_back({0, 4 + t});
  }
  const ClothFacts facts{10, x, {0, 0, 0, 0, 0, 1, 1, 1, 1, 1}, std::vector<double>(10, gap)};
  std::vector<ClothContactPoint> out;
  clothContacts(mesh, facts, pairs, x, x, out);
  return out;
}

TEST(ClothContacts, SamplesThatLieOnEachOtherAreOneContact) {
  const double gap = 0.01;
  for (const double shift : {0.0, 1e-9, 1e-5, 0.047 * gap}) {  // times 1.044 for both directions
    const std::vector<ClothContactPoint> one = contactsOfMiddles(shift, gap);
    ASSERT_EQ(one.size(), 1u) << shift;
    EXPECT_EQ(one[0].contact.sample, 0);
    EXPECT_EQ(one[0].partner, 5);
    EXPECT_NEAR(one[0].contact.normal.z, -1, 1e-9);
  }
  const std::vector<ClothContactPoint> two = contactsOfMiddles(0.049 * gap, gap);
  ASSERT_EQ(two.size(), 2u);
  EXPECT_EQ(two[0].partner, -1);
  EXPECT_EQ(two[1].partner, -1);
}

}  // namespace
}  // namespace gambeson
