/// Detail of fields_sheet.hpp: trimming loops.

#include <fmt/format.h>

#include "cases/structure/fields_sheet.hpp"

namespace gambeson::schema::sheet {
namespace {

const std::string trim_lengths =
    "in lengths from the corner u0v0 (plate), else in fractions of the patch's parameter range";

Object curveTable() {
  using C = NurbsCurve;
  const auto degree = [](auto& c) -> auto& { return c.knots.degree; };
  Field knots = fieldOf("knots", Kind::numbers, "", any(), "knots, not falling; as many as points + degree + 1");
  knots.required = true;
  Field points = fieldOf("points", Kind::lists, "m", world, "control points [s, t], " + trim_lengths);
  points.required = true;
  Field weights = fieldOf("weights", Kind::numbers, "", aboveTo(0, 1e9), "weights of the control points");
  weights.default_note = "all 1";
  return Table<C>("Curve")
      .integer("degree", degree, 1, 7, "degree")
      .required()
      .custom(
          knots, [](const Entry& p, C& c) { c.knots.knots = readNumbers(p, "", any()); },
          [](const C& c) { return std::optional(nodeOfList(c.knots.knots)); })
      .custom(
          points, [](const Entry& p, C& c) { c.points = readPoints<Vec2>(p, readPair); },
          [](const C& c) { return std::optional(nodeOfPoints(c.points)); })
      .custom(
          weights, [](const Entry& p, C& c) { c.weights = readNumbers(p, "", aboveTo(0, 1e9)); },
          [](const C& c) { return std::optional(nodeOfList(c.weights)); })
      .check([](const Entry& p, C& c) {
        if (c.weights.empty()) c.weights.assign(c.points.size(), 1.0);
        if (c.points.size() < static_cast<std::size_t>(c.knots.degree) + 1)
          p.failAt("points", fmt::format("there are {}; allowed: at least degree + 1", c.points.size()));
        if (c.knots.knots.size() != c.points.size() + static_cast<std::size_t>(c.knots.degree) + 1)
          p.failAt("knots", fmt::format("there are {}; allowed: {}, points + degree + 1", c.knots.knots.size(),
                                        c.points.size() + static_cast<std::size_t>(c.knots.degree) + 1));
        for (std::size_t i = 1; i < c.knots.knots.size(); ++i)
          if (!(c.knots.knots[i] >= c.knots.knots[i - 1])) p.failAt("knots", "they fall; allowed: not falling");
        if (!(c.knots.back() > c.knots.front())) p.failAt("knots", "their range is empty");
        if (c.weights.size() != c.points.size())
          p.failAt("weights",
                   fmt::format("there are {}; allowed: {}, one per point", c.weights.size(), c.points.size()));
      })
      .build();
}

}  // namespace

Object trimTable() {
  using T = TrimCase;
  Field center = fieldOf("center", Kind::pair, "m", world, "centre, " + trim_lengths);
  center.required = true;
  const Object circle_table =
      Table<TrimCircle>("Circle")
          .custom(
              center, [](const Entry& p, TrimCircle& c) { c.center = readPair(p, "m", world); },
              [](const TrimCircle& c) { return std::optional(nodeOf(c.center)); })
          .number("radius", &TrimCircle::radius, "m", size, "radius, a length (plate) or a fraction of both ranges")
          .required()
          .build();
  Field points = fieldOf("points", Kind::lists, "m", world, "corners [s, t] in order, " + trim_lengths);
  points.required = true;
  const auto corners = [&](auto kind, const std::string& title) {
    using C = decltype(kind);
    return Table<C>(title)
        .custom(
            points,
            [](const Entry& p, C& c) {
              c.points = readPoints<Vec2>(p, readPair);
              if (c.points.size() < 3) p.fail(fmt::format("there are {} points; allowed: at least 3", c.points.size()));
            },
            [](const C& c) { return std::optional(nodeOfPoints(c.points)); })
        .build();
  };
  const Object curves_table = Table<TrimCurves>("Curves")
                                  .list("curves", &TrimCurves::curves, curveTable(),
                                        "NURBS curves in order, each starting where the one before ends")
                                  .required()
                                  .check([](const Entry& p, const TrimCurves& c) {
                                    if (c.curves.empty()) p.failAt("curves", "there is none; allowed: at least one");
                                  })
                                  .build();
  return Table<T>("Trimming loop")
      .alternative<TrimCircle>("circle", &T::loop, circle_table, "an exact circle")
      .in("loop")
      .alternative<TrimPolygon>("polygon", &T::loop, corners(TrimPolygon{}, "Polygon"), "straight edges")
      .in("loop")
      .alternative<TrimSpline>("spline", &T::loop, corners(TrimSpline{}, "Spline"),
                               "a smooth closed curve through points (plate)")
      .in("loop")
      .alternative<TrimCurves>("loop", &T::loop, curves_table, "a chain of NURBS curves")
      .in("loop")
      .oneOf("loop", true)
      .choice("keep", &T::keep_inside, std::vector<std::pair<std::string, bool>>{{"outside", false}, {"inside", true}},
              "what stays: outside, the loop is a hole; inside, it is the outline")
      .integer("patch", &T::patch, 0, 10000, "which patch")
      .build();
}

}  // namespace gambeson::schema::sheet
