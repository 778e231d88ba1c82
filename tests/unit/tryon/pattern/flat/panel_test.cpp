/// Flat panels: lengths and areas against closed forms, exact crossings, what is refused.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "core/error.hpp"
#include "tryon/pattern/flat/crossings.hpp"
#include "tryon/pattern/flat/panel_check.hpp"
#include "tryon/pattern/flat/panel_geometry.hpp"
#include "tryon/pattern/flat/propose_seams.hpp"
#include "tryon/pattern/flat/turn_panel.hpp"

namespace gambeson {
namespace {

constexpr double pi = std::numbers::pi;

Panel polygonPanel(const std::string& name, const std::vector<Vec2>& corners) {
  Panel p;
  p.name = name;
  for (const Vec2& c : corners) p.outline.push_back({"", c, StraightEdge{}});
  return p;
}
Panel square(const std::string& name, double side = 0.2) {
  return polygonPanel(name, {{0, 0}, {side, 0}, {side, side}, {0, side}});
}
FlatPattern patternOf(std::vector<Panel> panels) {
  FlatPattern p;
  p.name = "test";
  p.panels = std::move(panels);
  return p;
}

TEST(FlatPanel, ArcsHaveTheLengthAndAreaOfCircles) {
  // A circle of two arcs, and one of a short and a long one; 1 m^2 pi r^2 and 2 pi r.
  for (const double turn : {pi, 0.3, 4.0}) {
    const double r = 0.35, half = 0.5 * turn;
    Panel p;
    p.outline = {{"", {r * std::sin(half), -r * std::cos(half)}, ArcEdge{2 * pi - turn}},
                 {"", {-r * std::sin(half), -r * std::cos(half)}, ArcEdge{turn}}};
    EXPECT_NEAR(areaOf(p), pi * r * r, 1e-13);
    EXPECT_NEAR(lengthOf(p, 0), r * (2 * pi - turn), 1e-12);
    EXPECT_NEAR(lengthOf(p, 1), r * turn, 1e-12);
    const Vec2 m = MeasuredCurve(curveOf(p, 1)).at(0.25).point;
    EXPECT_NEAR(std::hypot(m.x, m.y), r, 1e-14);
    EXPECT_NEAR(std::atan2(m.x, -m.y), -half + 0.25 * turn, 1e-12);
  }
}

/// y = x^2 from (0, 0) to (1, 1): length sqrt(5)/2 + asinh(2)/4, area below 1/3; the same as cubic and as spline.
TEST(FlatPanel, BeziersAndSplinesHaveTheLengthAndAreaOfAParabola) {
  const double length = std::sqrt(5) / 2 + std::asinh(2) / 4;
  const EdgeCurve same[] = {BezierEdge{{{0.5, 0}}}, BezierEdge{{{1.0 / 3, 0}, {2.0 / 3, 1.0 / 3}}},
                            SplineEdge{2, {0, 0, 0, 0.5, 1, 1, 1}, {{0.25, 0}, {0.75, 0.5}}, {}}};
  for (const EdgeCurve& curve : same) {
    Panel p;
    p.outline = {{"", {0, 0}, curve}, {"", {1, 1}, StraightEdge{}}};
    EXPECT_NEAR(lengthOf(p, 0), length, 1e-12);
    EXPECT_NEAR(areaOf(p), 0.5 - 1.0 / 3, 1e-14);
    const MeasuredCurve c(curveOf(p, 0));
    for (const double s : {0.0, 0.1, 0.6, 1.0}) {
      const CurvePoint at = c.at(s);
      EXPECT_NEAR(at.point.y, at.point.x * at.point.x, 1e-13);
      const double x = at.point.x, along = 0.5 * x * std::sqrt(1 + 4 * x * x) + std::asinh(2 * x) / 4;
      EXPECT_NEAR(along, s * length, 1e-11);
      EXPECT_NEAR(at.tangent.y, 2 * x * at.tangent.x, 1e-12);
      EXPECT_NEAR(c.nearest(at.point).fraction, s, 1e-7);
      EXPECT_NEAR(curvePoint(curveOf(p, 0), c.parameterAt(s)).point.x, x, 1e-12);
    }
    // Lines within the tolerance: their area misses the segment's by less than tolerance times length.
    double area = 0;
    std::vector<Vec2> points = flattened(p.outline, 1e-5);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Vec2 a = points[k], b = points[(k + 1) % points.size()];
      area += 0.5 * (a.x * b.y - a.y * b.x);
    }
    EXPECT_NEAR(area, areaOf(p), 1e-5 * length);
    EXPECT_GT(points.size(), 20u);
  }
}

TEST(FlatPanel, TurnedPanelsKeepLengthsAreasAndPlaces) {
  Panel p;
  p.name = "p";
  p.outline = {{"a", {0, 0}, BezierEdge{{{0.1, -0.05}, {0.2, 0.05}}}},
               {"b", {0.3, 0}, ArcEdge{1.1}},
               {"c", {0.3, 0.4}, PolylineEdge{{{0.2, 0.42}, {0.1, 0.38}}}},
               {"d", {0, 0.4}, SplineEdge{2, {0, 0, 0, 0.4, 1, 1, 1}, {{-0.05, 0.3}, {0.04, 0.1}}, {1, 2, 1, 1}}}};
  p.placement = PanelPlace{{0.2, 0, 1}, {0, 1, 0}, {0, 0, 1}};
  const double area = areaOf(p);
  Panel back = p;
  back.outline = reversed(p.outline);
  EXPECT_NEAR(areaOf(back), -area, 1e-15);
  for (int e = 0; e < 4; ++e) EXPECT_NEAR(lengthOf(back, 3 - e), lengthOf(p, e), 1e-14);
  Panel mirrored = p;
  mirror(mirrored);
  EXPECT_NEAR(areaOf(mirrored), -area, 1e-15);
  for (int e = 0; e < 4; ++e) {
    EXPECT_NEAR(lengthOf(mirrored, e), lengthOf(p, e), 1e-14);
    const Vec2 a = MeasuredCurve(curveOf(p, e)).at(0.3).point, b = MeasuredCurve(curveOf(mirrored, e)).at(0.3).point;
    const auto place = [](const Panel& q, Vec2 x) {
      return q.placement->origin_m + x.x * q.placement->along_x + x.y * q.placement->along_y;
    };
    EXPECT_LT(norm(place(p, a) - place(mirrored, b)), 1e-14);
  }
}

/// Points on and beside a line by less than what doubles can tell from the coordinates' differences.
TEST(FlatPanel, TurnsAreExact) {
  const double u = std::nextafter(0.5, 1) - 0.5;
  const Vec2 a{12, 12}, b{24, 24};
  for (int i = 0; i < 64; ++i)
    for (int j = 0; j < 64; ++j)
      EXPECT_EQ(turnSign({0.5 + i * u, 0.5 + j * u}, a, b), i < j ? 1 : i > j ? -1 : 0) << i << " " << j;
}

TEST(FlatPanel, CrossingsAreToldFromTouches) {
  const auto meet = [](const std::vector<std::vector<Vec2>>& p) {
    const Meetings m = meetingsOf(p);
    return !m.crossing.empty() ? 'x' : !m.touch.empty() ? 't' : '-';
  };
  const std::vector<Vec2> unit{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  EXPECT_EQ(meet({unit}), '-');
  EXPECT_EQ(meet({{{0, 0}, {1, 1}, {1, 0}, {0, 1}}}), 'x');                                  // a bow
  EXPECT_EQ(meet({{{0, 0}, {2, 0}, {1, 1}, {2, 2}, {0, 2}, {1, 1}}}), 't');                  // an hourglass
  EXPECT_EQ(meet({{{0, 0}, {1, 1}, {2, 0}, {2, 2}, {1, 1}, {0, 2}}}), 't');                  // from inside
  EXPECT_EQ(meet({{{0, 0}, {1, 1}, {2, 2}, {2, 0}, {1, 1}, {0, 2}}}), 'x');                  // through a corner
  EXPECT_EQ(meet({{{0, 0}, {3, 0}, {3, 1}, {2, 0}, {1, 1}, {0, 1}}}), 't');                  // a corner on an edge
  EXPECT_EQ(meet({{{0, 0}, {3, 0}, {3, 1}, {2, -0.1}, {1, 1}, {0, 1}}}), 'x');               // through it
  EXPECT_EQ(meet({{{0, 0}, {1, 0}, {1, 1}, {0.5, 1}, {0.5, 0.5}, {0.5, 1}, {0, 1}}}), 't');  // a slit
  EXPECT_EQ(meet({unit, {{0.2, 0.2}, {0.2, 0.8}, {0.8, 0.8}, {0.8, 0.2}}}), '-');            // a hole
  EXPECT_EQ(meet({unit, {{0.2, 0.2}, {0.2, 0.8}, {1.8, 0.8}, {0.8, 0.2}}}), 'x');
}

std::string refusal(const FlatPattern& p) {
  try {
    checkPattern(p);
  } catch (const InputError& e) {
    return e.where().key + ": " + e.reason();
  }
  return "accepted";
}

TEST(FlatPanel, NamesWhatIsWrong) {
  const auto broken = [](const std::function<void(FlatPattern&)>& damage) {
    FlatPattern p = patternOf({square("front"), square("back")});
    p.seams.push_back({"side", {{0, 1, 0, 1}}, {{1, 3, 1, 0}}});
    damage(p);
    return refusal(p);
  };
  const auto says = [](const std::string& answer, const std::string& start, const std::string& word) {
    EXPECT_TRUE(answer.starts_with(start) && answer.find(word) != std::string::npos) << answer;
  };
  EXPECT_EQ(broken([](FlatPattern&) {}), "accepted");
  says(broken([](FlatPattern& p) { p.panels.clear(); }), "panels:", "at least one");
  says(broken([](FlatPattern& p) { p.panels[1].name = "front"; }), "panels[1].name:", "names two panels");
  says(broken([](FlatPattern& p) { p.panels[1].outline.clear(); }), "panels[1].outline:", "no edges");
  says(broken([](FlatPattern& p) { p.panels[0].outline[2].start_m.x = NAN; }), "panels[0].outline[2].start:", "10 m");
  says(broken([](FlatPattern& p) { p.panels[0].outline[2].start_m.x = 200; }), "panels[0].outline[2].start:", "unit");
  says(broken([](FlatPattern& p) { std::swap(p.panels[0].outline[1], p.panels[0].outline[2]); }),
       "panels[0]:", "crosses itself at (10.00, 10.00) cm: edges 0 and 2");
  says(broken([](FlatPattern& p) { p.panels[0].outline = reversed(p.panels[0].outline); }),
       "panels[0].outline:", "clockwise");
  says(broken([](FlatPattern& p) { p.panels[0].outline[2].start_m = p.panels[0].outline[1].start_m; }),
       "panels[0].outline[1]:", "without length");
  says(broken([](FlatPattern& p) { p.panels[0].outline.resize(2); }), "panels[0].outline:", "encloses");
  says(broken([](FlatPattern& p) { p.panels[0].outline[1].curve = ArcEdge{7}; }), "panels[0].outline[1].arc:", "2 pi");
  says(broken([](FlatPattern& p) { p.panels[0].outline[1].curve = BezierEdge{}; }),
       "panels[0].outline[1].bezier:", "two (cubic)");
  says(broken([](FlatPattern& p) {
         p.panels[0].outline[1].curve = SplineEdge{3, {0, 1}, {}, {}};
       }),
       "panels[0].outline[1].spline.knots:", "needed");
  says(broken([](FlatPattern& p) { p.panels[0].cutouts = {square("", 0.1).outline}; }),
       "panels[0].cutouts[0]:", "clockwise");
  says(broken([](FlatPattern& p) {
         PanelLoop hole = reversed(square("", 0.05).outline);
         for (PanelEdge& e : hole) e.start_m.x += 0.5;
         p.panels[0].cutouts = {hole};
       }),
       "panels[0].cutouts[0]:", "does not lie inside");
  says(broken([](FlatPattern& p) { p.panels[1].notches.push_back({4, 0.5}); }), "panels[1].notches[0].edge:", "0 to 3");
  says(broken([](FlatPattern& p) { p.seams[0].b[0].edge = 4; }), "seams[0].b[0]:", "no edge 4 of panel \"back\"");
  says(broken([](FlatPattern& p) { p.seams[0].b[0].panel = 2; }), "seams[0].b[0]:", "no panel 2");
  says(broken([](FlatPattern& p) { p.seams[0].b[0].to = 1.5; }), "seams[0].b[0]:", "no part");
  says(broken([](FlatPattern& p) {
         p.seams.push_back({"x", {{0, 1, 0.5, 1}}, {{1, 0, 0, 1}}});
       }),
       "seams[1].a[0]:", "sewn already, by seam \"side\"");
  says(broken([](FlatPattern& p) { p.seams[0].use = SeamUse::dart; }), "seams[0].b[0]:", "another panel");
  EXPECT_EQ(broken([](FlatPattern& p) {
              p.seams[0].a[0].to = 0.5;
              p.seams.push_back({"x", {{0, 1, 0.5, 1}}, {{1, 0, 0, 1}}});
            }),
            "accepted");
}

TEST(FlatPanel, DoubtsAreSaid) {
  FlatPattern p = patternOf({square("a"), square("b", 0.3), square("c")});
  p.seams.push_back({"s1", {{0, 1, 0, 1}}, {{1, 3, 1, 0}}});
  const std::vector<std::string> doubts = doubtsAbout(p);
  ASSERT_EQ(doubts.size(), 2u);
  EXPECT_NE(doubts[0].find("gathered by 50 %"), std::string::npos) << doubts[0];
  EXPECT_NE(doubts[1].find("\"c\" is in no seam"), std::string::npos) << doubts[1];
}

/// Front and back of a skirt, the side seams 50 cm and 52 cm long, of which one has a notch.
TEST(FlatPanel, SeamsAreProposedByLengthAndNotch) {
  const auto half = [](const std::string& name, double shift, bool notch) {
    // waist 30 cm, hem 40 + shift cm, sides 50 and 52 cm: none but its partner is as long
    Panel p = polygonPanel(name, {{0, 0}, {0.40 + shift, 0}, {0.37, 0.52}, {0.02, 0.50}});
    if (notch) p.notches.push_back({name == "front" ? 1 : 3, name == "front" ? 0.25 : 0.75, NotchKind::slit, 0});
    return p;
  };
  Panel front = half("front", 0, true), back = front;
  mirror(back);
  back.outline = reversed(back.outline);
  back.name = "back";
  for (PanelEdge& e : back.outline) e.start_m.y *= 1.0005;  // a mirror image it is not
  back.outline[0].start_m.x -= 0.03;
  back.notches = {{2, 0.75, NotchKind::slit, 0}};  // edge 1 is edge 2 there, run the other way
  const FlatPattern p = patternOf({front, back});
  ASSERT_EQ(refusal(p), "accepted");
  const ProposedSeams s = proposeSeams(p);
  ASSERT_GE(s.seams.size(), 2u);
  // The notched sides come first.
  EXPECT_EQ(s.seams[0].a[0].edge, 1);
  EXPECT_EQ(s.seams[0].b[0].edge, 2);
  for (const PanelSeam& seam : s.seams) {
    EXPECT_TRUE(seam.proposed);
    EXPECT_EQ(seam.b[0].from, 1);
    EXPECT_NEAR(lengthOf(p, seam.a), lengthOf(p, seam.b), 0.035 * lengthOf(p, seam.a));
  }
}

/// A notch that the other side lacks is worse than any fit without notches: here the worst, 3.3 % longer, to the same
/// side, 110 degrees off a smooth line at both ends, against one that fits in all but the notch.
TEST(FlatPanel, ANotchThatIsMissingIsWorseThanABadFit) {
  const auto triangle = [](const std::string& name, double side, double corner_deg) {
    const double out = 0.5 * side * std::tan(corner_deg * pi / 180);
    Panel p = polygonPanel(name, {{out, 0}, {out, side}, {0, 0.5 * side}});
    p.grain = GrainLine{{0.9 * out, 0.4 * side}, {0.9 * out, 0.6 * side}};
    return p;
  };
  const double down = 0.5 * std::sqrt(0.75);
  Panel notched = polygonPanel("notched", {{0, 0}, {0.25, -down}, {0.25, 0.3 + down}, {0, 0.3}});
  notched.grain = GrainLine{{0.1, 0.1}, {0.1, 0.2}};
  notched.notches = {{3, 0.5, NotchKind::slit, 0}};
  const FlatPattern p = patternOf({triangle("a", 0.3, 30), triangle("b", 0.31, 40), notched});
  ASSERT_EQ(refusal(p), "accepted");
  const ProposedSeams s = proposeSeams(p);
  ASSERT_EQ(s.seams.size(), 1u);
  EXPECT_EQ(s.seams[0].a[0].panel, 0);
  EXPECT_EQ(s.seams[0].b[0].panel, 1);
}

/// Two tubes, a front and a back each: hems are as long as each other, necks too, and all sides are alike.
TEST(FlatPanel, HemsAndNecksAreNotProposed) {
  const auto half = [](const std::string& name, double shift) {
    Panel p = polygonPanel(name, {{0, 0}, {0.4, 0}, {0.4 + shift, 0.5}, {0.3, 0.55}, {0.1, 0.55}, {-shift, 0.5}});
    p.outline[3].curve = BezierEdge{{{0.2, 0.42}}};  // the neck
    p.grain = GrainLine{{0.2, 0.1}, {0.2, 0.4}};
    return p;
  };
  FlatPattern p = patternOf({half("front", 0.01), half("back", 0.012)});
  ASSERT_EQ(refusal(p), "accepted");
  const auto count = [&](int edge) {
    int found = 0;
    for (const PanelSeam& s : proposeSeams(p).seams) found += s.a[0].edge == edge || s.b[0].edge == edge;
    return found;
  };
  EXPECT_EQ(count(0), 0) << "hems";
  EXPECT_EQ(count(3), 0) << "necks";
  EXPECT_EQ(count(2), 2) << "both shoulders";
  for (const PanelSeam& s : proposeSeams(p).seams)
    EXPECT_EQ(s.a[0].edge + s.b[0].edge, 6) << "right goes with left: " << s.a[0].edge << ", " << s.b[0].edge;
  EXPECT_EQ(proposeSeams(p).seams.size(), 4u);
  // Lying pieces hang as their grain line runs; without one nobody knows what is a hem.
  for (Panel& panel : p.panels) {
    for (PanelEdge& e : panel.outline) {
      e.start_m = {e.start_m.y, -e.start_m.x};
      if (auto* b = std::get_if<BezierEdge>(&e.curve)) b->controls_m[0] = {b->controls_m[0].y, -b->controls_m[0].x};
    }
    panel.grain = GrainLine{{0.1, -0.2}, {0.4, -0.2}};
  }
  EXPECT_EQ(count(0), 0);
  for (Panel& panel : p.panels) panel.grain.reset();
  EXPECT_EQ(count(0), 1);
}

}  // namespace
}  // namespace gambeson
