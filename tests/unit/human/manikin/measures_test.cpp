/// Manikins by measures against the six of published sizes, against their own sections, and what contradicts itself.

#include "human/manikin/measures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "human/manikin/manikin.hpp"
#include "human/manikin/regressions.hpp"

namespace gambeson {
namespace {

ManikinMeasures measuresOf(const std::string& name) {
  const Human h = makeManikin(name);
  ManikinMeasures m;
  m.sex = name.starts_with("female") ? Sex::female : Sex::male;
  m.stature_m = h.stature_m, m.mass_kg = h.mass_kg;
  return m;
}

TEST(Measures, StatureAndMassOfThePublishedSixGiveThemAgain) {
  for (const std::string& name : manikinNames()) {
    const Human published = makeManikin(name), h = makeManikin(measuresOf(name));
    ASSERT_EQ(h.shapes.size(), published.shapes.size());
    for (std::size_t i = 0; i < h.shapes.size(); ++i) {
      const Vec3 a = std::get<Ellipsoid>(h.shapes[i].shape).semi_axes,
                 b = std::get<Ellipsoid>(published.shapes[i].shape).semi_axes;
      EXPECT_LT(norm(a - b), 6e-4) << name << " " << h.shapes[i].name;  // the data are rounded to 0.1 mm
    }
    for (std::size_t j = 0; j < h.skeleton.joints.size(); ++j)
      EXPECT_LT(norm(h.skeleton.joints[j].X_PJ.origin - published.skeleton.joints[j].X_PJ.origin), 3e-4)
          << name << " " << h.skeleton.joints[j].name;
    for (std::size_t l = 0; l < h.skeleton.links.size(); ++l)
      EXPECT_NEAR(h.skeleton.links[l].mass_kg, published.skeleton.links[l].mass_kg, 0.02) << h.skeleton.links[l].name;
  }
}

TEST(Measures, GirthsAskedForAreThoseOfTheBody) {
  ManikinMeasures m = measuresOf("male_p50");
  m.chest_m = 1.0, m.waist_m = 0.9, m.hip_m = 1.02, m.inseam_m = 0.82;
  MeasuresReport report;
  const Human h = makeManikin(m, &report);
  ASSERT_EQ(report.girths.size(), 3u);
  for (const MadeGirth& g : report.girths) EXPECT_NEAR(g.made_m, g.asked_m, 0.01 * g.asked_m) << g.name;
  EXPECT_TRUE(report.notes.empty());
  // The chest's section has arms of none and is an ellipse, whose girth is known in closed form.
  for (const BodyShape& s : h.shapes)
    if (s.name == "chest") {
      const Vec3 e = std::get<Ellipsoid>(s.shape).semi_axes;
      const double a = std::max(e.x, e.y), b = std::min(e.x, e.y);
      EXPECT_NEAR(4 * a * std::comp_ellint_2(std::sqrt(1 - b * b / (a * a))), 1.0, 0.01);
    }
}

TEST(Measures, LongerLegsOfOneStatureShortenTheTrunk) {
  ManikinMeasures m = measuresOf("female_p50");
  const Human usual = makeManikin(m);
  m.inseam_m = 0.82;
  const Human longer = makeManikin(m);
  EXPECT_EQ(longer.stature_m, usual.stature_m);
  const auto offset = [](const Human& h, const char* joint) {
    return norm(h.skeleton.joints[static_cast<std::size_t>(h.skeleton.joint(joint))].X_PJ.origin);
  };
  EXPECT_GT(offset(longer, "knee_flexion_left"), offset(usual, "knee_flexion_left") + 0.01);
  EXPECT_LT(offset(longer, "neck_flexion"), offset(usual, "neck_flexion") - 0.01);
  EXPECT_NEAR(offset(longer, "elbow_flexion_left"), offset(usual, "elbow_flexion_left"), 1e-12);
}

TEST(Measures, ThatContradictEachOtherAreRefusedWithTheirRange) {
  const auto refused = [](auto change, const std::string& key) {
    ManikinMeasures m = measuresOf("male_p50");
    change(m);
    try {
      makeManikin(m);
      ADD_FAILURE() << key;
    } catch (const InputError& e) {
      EXPECT_EQ(e.where().key, key);
      EXPECT_NE(e.reason().find("allowed: "), std::string::npos) << e.reason();
    }
  };
  refused([](auto& m) { m.inseam_m = 1.8; }, "inseam");
  refused([](auto& m) { m.inseam_m = 0.5; }, "inseam");
  refused([](auto& m) { m.chest_m = 0.6; }, "chest");
  refused([](auto& m) { m.waist_m = 1.6; }, "waist");
  refused([](auto& m) { m.hip_m = std::nan(""); }, "hip");
  refused([](auto& m) { m.mass_kg = 30; }, "mass");
  refused([](auto& m) { m.mass_kg = std::nan(""); }, "mass");
}

TEST(Measures, BeyondThePeopleMeasuredANoteTells) {
  ManikinMeasures m = measuresOf("male_p50");
  m.stature_m = 2.05, m.mass_kg = 110;
  MeasuresReport report;
  makeManikin(m, &report);
  ASSERT_EQ(report.notes.size(), 1u);
  EXPECT_NE(report.notes[0].find("extrapolated"), std::string::npos);
}

TEST(Regressions, MeansOfBothSexesScaleWithAStatuette) {
  const double man = regressionsFor(Sex::male, 1.70, 75).m("crotchheight"),
               woman = regressionsFor(Sex::female, 1.70, 75).m("crotchheight");
  EXPECT_NEAR(meanMeasure("crotchheight", 1.70, 75), 0.5 * (man + woman), 1e-12);
  // Half as tall and of the same build as somebody of 1.4825 m, whom the data have: the shares of a stature stay.
  const double tall = meanMeasure("crotchheight", 1.4825, 50);
  EXPECT_NEAR(meanMeasure("crotchheight", 1.4825 / 2, 50.0 / 8), tall / 2, 0.02 * tall);
}

}  // namespace
}  // namespace gambeson
