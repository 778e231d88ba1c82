#include <fmt/format.h>

#include "cases/structure_fields.hpp"
#include "cases/table.hpp"
#include "core/error.hpp"

namespace gambeson::schema {
namespace {

const Range world = between(-1e9, 1e9);
const Range size = aboveTo(0, 1e9);
constexpr double pi = std::numbers::pi;

void checkRightAngle(const Place& p, const Vec3& a, const Vec3& b, const char* key, const char* other) {
  if (!(std::abs(dot(a, b)) < 1e-6)) p.failAt(key, fmt::format("is not at right angles to {}; allowed: 90 deg", other));
}

void checkTurn(const Place& p, double start, double end, const char* key) {
  const double turn = end - start;
  if (!(turn > 1e-6 && turn <= 2 * pi * (1 + 1e-9)))
    p.failAt(key, fmt::format("{} rad beyond the start is out of range; allowed: > 0 and <= 2 pi", turn));
}

Object plateTable() {
  using S = PlateShape;
  return Table<S>("Plate")
      .number("width", &S::width_m, "m", size, "length along axis_u")
      .required()
      .number("height", &S::height_m, "m", size, "length along axis_v")
      .required()
      .vector("corner", &S::corner, "m", world, "the corner u0v0 in the world")
      .direction("axis_u", &S::axis_u, "direction of u")
      .direction("axis_v", &S::axis_v, "direction of v; at right angles to axis_u")
      .check([](const Place& p, const S& s) { checkRightAngle(p, s.axis_v, s.axis_u, "axis_v", "axis_u"); })
      .build();
}

Object cylinderTable() {
  using S = CylinderShape;
  return Table<S>("Cylinder")
      .number("radius", &S::radius_m, "m", size, "radius")
      .required()
      .number("length", &S::length_m, "m", size, "length along the axis, the direction of v")
      .required()
      .number("start_angle", &S::start_angle_rad, "rad", between(-7, 7),
              "angle at the edge u0, right-handed about axis from zero")
      .number("end_angle", &S::end_angle_rad, "rad", between(-7, 14),
              "angle at the edge u1; a full turn closes the tube, which then has no edges u0 and u1")
      .vector("start", &S::start, "m", world, "centre of the circle v0")
      .direction("axis", &S::axis, "direction of the axis, from v0 to v1")
      .direction("zero", &S::zero, "from the axis to the line of angle 0; at right angles to axis")
      .check([](const Place& p, const S& s) {
        checkTurn(p, s.start_angle_rad, s.end_angle_rad, "end_angle");
        checkRightAngle(p, s.zero, s.axis, "zero", "axis");
      })
      .build();
}

Object sphereTable() {
  using S = SphereShape;
  return Table<S>("Sphere")
      .number("radius", &S::radius_m, "m", size, "radius")
      .required()
      .number("longitude_start", &S::longitude_start_rad, "rad", between(-7, 7),
              "longitude at the edge u0, right-handed about axis from zero")
      .number("longitude_end", &S::longitude_end_rad, "rad", between(-7, 14),
              "longitude at the edge u1; a full turn closes the zone, which then has no edges u0 and u1")
      .number("latitude_start", &S::latitude_start_rad, "rad", between(-1.57, 1.57),
              "latitude at the edge v0; 0 is the equator")
      .number(
          "latitude_end", &S::latitude_end_rad, "rad", between(-1.57, 1.57),
          "latitude at the edge v1; a pole itself cannot be part of the sheet (1.57 rad leave a hole of 0.0008 radius)")
      .required()
      .vector("center", &S::center, "m", world, "centre")
      .direction("axis", &S::axis, "from the south pole to the north pole")
      .direction("zero", &S::zero, "from the axis to longitude 0; at right angles to axis")
      .check([](const Place& p, const S& s) {
        checkTurn(p, s.longitude_start_rad, s.longitude_end_rad, "longitude_end");
        if (!(s.latitude_end_rad - s.latitude_start_rad > 1e-6))
          p.failAt("latitude_end", fmt::format("{} rad is out of range; allowed: above latitude_start = {} rad",
                                               s.latitude_end_rad, s.latitude_start_rad));
        checkRightAngle(p, s.zero, s.axis, "zero", "axis");
      })
      .build();
}

Object annulusTable() {
  using S = AnnulusShape;
  return Table<S>("Annulus")
      .number("inner_radius", &S::inner_radius_m, "m", size, "radius of the edge u0")
      .required()
      .number("outer_radius", &S::outer_radius_m, "m", size, "radius of the edge u1")
      .required()
      .number("start_angle", &S::start_angle_rad, "rad", between(-7, 7),
              "angle at the edge v0, right-handed about normal from zero")
      .number("end_angle", &S::end_angle_rad, "rad", between(-7, 14),
              "angle at the edge v1; a full turn closes the ring, which then has no edges v0 and v1")
      .vector("center", &S::center, "m", world, "centre")
      .direction("normal", &S::normal, "normal of the ring")
      .direction("zero", &S::zero, "direction of angle 0; at right angles to normal")
      .check([](const Place& p, const S& s) {
        if (!(s.outer_radius_m > s.inner_radius_m * (1 + 1e-9)))
          p.failAt("outer_radius", fmt::format("{} m is out of range; allowed: above inner_radius = {} m",
                                               s.outer_radius_m, s.inner_radius_m));
        checkTurn(p, s.start_angle_rad, s.end_angle_rad, "end_angle");
        checkRightAngle(p, s.zero, s.normal, "zero", "normal");
      })
      .build();
}

Field fieldOf(const std::string& key, Kind kind, const std::string& unit, const Range& range, const std::string& doc) {
  Field f;
  f.key = key;
  f.kind = kind;
  f.unit = unit;
  f.range = range;
  f.doc = doc;
  return f;
}

const std::vector<std::pair<std::string, SeamKind>> seam_kinds{{"G1", SeamKind::G1}, {"C0", SeamKind::C0}};

Object patchTable() {
  using P = NurbsPatch;
  Field degree = fieldOf("degree", Kind::numbers, "", between(1, 5), "degree of u and of v, such as [2, 2]");
  degree.required = true;
  Field points = fieldOf("points", Kind::rows, "m", world, "control points [x, y, z], u fastest");
  points.required = true;
  const auto knots = [](const char* key, const char* along) {
    Field f = fieldOf(key, Kind::numbers, "", any(),
                      fmt::format("knots along {}, not falling; as many as control points + degree + 1", along));
    f.required = true;
    return f;
  };
  return Table<P>("Patch")
      .custom(
          degree,
          [](const Place& p, P& patch) {
            if (p.node.type != JsonNode::Type::list || p.node.children.size() != 2)
              p.fail("expected two whole numbers [of u, of v], not " + describe(p.node));
            patch.u.degree = readInteger(p.item(0), between(1, 5));
            patch.v.degree = readInteger(p.item(1), between(1, 5));
          },
          [](const P& patch) {
            return std::optional(nodeOfList({double(patch.u.degree), double(patch.v.degree)}));
          })
      .custom(
          knots("knots_u", "u"), [](const Place& p, P& patch) { patch.u.knots = readNumbers(p, "", any()); },
          [](const P& patch) { return std::optional(nodeOfList(patch.u.knots)); })
      .custom(
          knots("knots_v", "v"), [](const Place& p, P& patch) { patch.v.knots = readNumbers(p, "", any()); },
          [](const P& patch) { return std::optional(nodeOfList(patch.v.knots)); })
      .custom(
          points,
          [](const Place& p, P& patch) {
            if (p.node.type != JsonNode::Type::list) p.fail("expected a list of points, not " + describe(p.node));
            for (std::size_t i = 0; i < p.node.children.size(); ++i)
              patch.points.push_back(readVector(p.item(i), "m", world));
          },
          [](const P& patch) {
            JsonNode list = emptyList();
            for (const Vec3& x : patch.points) list.children.push_back(nodeOf(x));
            return std::optional(list);
          })
      .custom(
          [] {
            Field f = fieldOf("weights", Kind::numbers, "", aboveTo(0, 1e9), "weights of the control points");
            f.default_note = "all 1";
            return f;
          }(),
          [](const Place& p, P& patch) { patch.weights = readNumbers(p, "", aboveTo(0, 1e9)); },
          [](const P& patch) { return std::optional(nodeOfList(patch.weights)); })
      .check([](const Place& p, P& patch) {
        if (patch.weights.empty()) patch.weights.assign(patch.points.size(), 1.0);
        try {
          validate(patch);
        } catch (const InputError& e) {
          p.fail((e.where().key.empty() ? "" : e.where().key + ": ") + e.reason());
        }
      })
      .build();
}

Object seamTable() {
  using S = SeamCase;
  const auto edge = [](const char* key, PatchEdge Seam::*member) {
    Field f = fieldOf(key, Kind::text, "", any(), "a patch and its side, such as 0.u1");
    f.required = true;
    return std::tuple(
        f,
        [member](const Place& p, S& s) {
          const EdgeAt e = readEdgeAt(p);
          if (e.patch < 0) p.fail("a seam names the patch as well; allowed: such as 0.u1");
          (s.seam.*member).patch = e.patch;
          (s.seam.*member).side = e.side;
        },
        [member](const S& s) {
          return std::optional(nodeOf(EdgeAt{(s.seam.*member).patch, (s.seam.*member).side}));
        });
  };
  const auto [fa, ra, wa] = edge("a", &Seam::a);
  const auto [fb, rb, wb] = edge("b", &Seam::b);
  return Table<S>("Seam")
      .custom(fa, ra, wa)
      .custom(fb, rb, wb)
      .flag(
          "reversed", [](auto& s) -> auto& { return s.seam.b.reversed; }, "b runs against a")
      .choice(
          "kind", [](auto& x) -> auto& { return x.seam.kind; }, seam_kinds,
          "G1: tangents joined as well, for smooth shapes with a constant ratio of the tangents' lengths; C0: joined "
          "by position, a hinge with the given stiffness")
      .number(
          "stiffness", [](auto& x) -> auto& { return x.seam.stiffness_N; }, "N/rad", between(0, 1e12),
          "rotational spring: moment per length and angle")
      .flag(
          "weak", &S::weak,
          "for edges whose knots, degrees or weights differ, or of which one lies on a part of the other: joined by a "
          "penalty; G1 then keeps the angle between the patches")
      .build();
}

Object nurbsTable() {
  using S = NurbsShape;
  return Table<S>("Patches")
      .list("patches", &S::patches, patchTable(), "the patches")
      .required()
      .list("seams", &S::seams, seamTable(),
            "how they are joined: edges with the same degree, knots and weights (others: weak)")
      .check([](const Place& p, const S& s) {
        if (s.patches.empty()) p.failAt("patches", "there is none; allowed: at least one");
        for (std::size_t i = 0; i < s.seams.size(); ++i)
          for (const int patch : {s.seams[i].seam.a.patch, s.seams[i].seam.b.patch})
            if (patch >= static_cast<int>(s.patches.size()))
              p.member(*p.node.find("seams"))
                  .item(i)
                  .fail(fmt::format("there is no patch {}; allowed: 0 to {}", patch, s.patches.size() - 1));
      })
      .build();
}

Object sheetFileTable() {
  return Table<SheetFile>("Sheet file")
      .path("path", &SheetFile::path, "garment file with patches and seams, relative to the case's folder")
      .required()
      .build();
}

const std::string trim_lengths =
    "in lengths from the corner u0v0 (plate), else in fractions of the patch's parameter range";

Object curveTable() {
  using C = NurbsCurve;
  const auto degree = [](auto& c) -> auto& { return c.knots.degree; };
  Field knots = fieldOf("knots", Kind::numbers, "", any(), "knots, not falling; as many as points + degree + 1");
  knots.required = true;
  Field points = fieldOf("points", Kind::rows, "m", world, "control points [s, t], " + trim_lengths);
  points.required = true;
  Field weights = fieldOf("weights", Kind::numbers, "", aboveTo(0, 1e9), "weights of the control points");
  weights.default_note = "all 1";
  return Table<C>("Curve")
      .integer("degree", degree, 1, 7, "degree")
      .required()
      .custom(
          knots, [](const Place& p, C& c) { c.knots.knots = readNumbers(p, "", any()); },
          [](const C& c) { return std::optional(nodeOfList(c.knots.knots)); })
      .custom(
          points,
          [](const Place& p, C& c) {
            if (p.node.type != JsonNode::Type::list) p.fail("expected a list of points, not " + describe(p.node));
            for (std::size_t i = 0; i < p.node.children.size(); ++i)
              c.points.push_back(readPair(p.item(i), "m", world));
          },
          [](const C& c) {
            JsonNode list = emptyList();
            for (const Vec2& x : c.points) list.children.push_back(nodeOf(x));
            return std::optional(list);
          })
      .custom(
          weights, [](const Place& p, C& c) { c.weights = readNumbers(p, "", aboveTo(0, 1e9)); },
          [](const C& c) { return std::optional(nodeOfList(c.weights)); })
      .check([](const Place& p, C& c) {
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

Object trimTable() {
  using T = TrimCase;
  Field center = fieldOf("center", Kind::pair, "m", world, "centre, " + trim_lengths);
  center.required = true;
  const Object circle_table =
      Table<TrimCircle>("Circle")
          .custom(
              center, [](const Place& p, TrimCircle& c) { c.center = readPair(p, "m", world); },
              [](const TrimCircle& c) { return std::optional(nodeOf(c.center)); })
          .number("radius", &TrimCircle::radius, "m", size, "radius, a length (plate) or a fraction of both ranges")
          .required()
          .build();
  Field points = fieldOf("points", Kind::rows, "m", world, "corners [s, t] in order, " + trim_lengths);
  points.required = true;
  const auto corners = [&](auto kind, const std::string& title) {
    using C = decltype(kind);
    return Table<C>(title)
        .custom(
            points,
            [](const Place& p, C& c) {
              if (p.node.type != JsonNode::Type::list) p.fail("expected a list of points, not " + describe(p.node));
              for (std::size_t i = 0; i < p.node.children.size(); ++i)
                c.points.push_back(readPair(p.item(i), "m", world));
              if (c.points.size() < 3) p.fail(fmt::format("there are {} points; allowed: at least 3", c.points.size()));
            },
            [](const C& c) {
              JsonNode list = emptyList();
              for (const Vec2& x : c.points) list.children.push_back(nodeOf(x));
              return std::optional(list);
            })
        .build();
  };
  const Object curves_table = Table<TrimCurves>("Curves")
                                  .list("curves", &TrimCurves::curves, curveTable(),
                                        "NURBS curves in order, each starting where the one before ends")
                                  .required()
                                  .check([](const Place& p, const TrimCurves& c) {
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

Object patchFieldTable(const std::string& unit, const Range& range, const std::string& title) {
  using F = PatchField;
  Field values =
      fieldOf("values", Kind::rows, unit, range, "rows along v of values along u; each count at least degree + 1");
  values.required = true;
  return Table<F>(title)
      .integer("degree", &F::degree, 0, 3,
               "between the values: 0 constant by rectangle, 1 bilinear, 2 and 3 smooth (B-spline coefficients)")
      .custom(
          values,
          [unit, range](const Place& p, F& f) {
            if (p.node.type != JsonNode::Type::list || p.node.children.empty())
              p.fail("expected a list of rows of numbers, not " + describe(p.node));
            f.values.clear();
            f.count_v = static_cast<int>(p.node.children.size());
            for (std::size_t i = 0; i < p.node.children.size(); ++i) {
              const std::vector<double> row = readNumbers(p.item(i), unit, range);
              if (i == 0) f.count_u = static_cast<int>(row.size());
              if (static_cast<int>(row.size()) != f.count_u)
                p.item(i).fail(
                    fmt::format("has {} values, the first row {}; allowed: the same", row.size(), f.count_u));
              f.values.insert(f.values.end(), row.begin(), row.end());
            }
          },
          [](const F& f) {
            JsonNode list = emptyList();
            const std::size_t n = static_cast<std::size_t>(f.count_u);
            for (std::size_t j = 0; j * n + n <= f.values.size(); ++j)
              list.children.push_back(nodeOfList(
                  {f.values.begin() + static_cast<long>(j * n), f.values.begin() + static_cast<long>(j * n + n)}));
            return std::optional(list);
          })
      .check([](const Place& p, const F& f) {
        if (f.count_u < f.degree + 1 || f.count_v < f.degree + 1)
          p.failAt("values", fmt::format("{} x {} values are too few for degree {}; allowed: at least {} x {}",
                                         f.count_u, f.count_v, f.degree, f.degree + 1, f.degree + 1));
      })
      .build();
}

Object fieldsTable() {
  using F = FieldsCase;
  const auto thickness = [](auto& f) -> auto& { return f.fields.thickness; };
  const auto angle = [](auto& f) -> auto& { return f.fields.fibre_angle; };
  const auto material = [](auto& f) -> auto& { return f.fields.material; };
  return Table<F>("Fields over a patch")
      .integer("patch", &F::patch, 0, 10000, "which patch; pieces of a built shape are counted along u, then along v")
      .object("thickness", thickness, patchFieldTable("", aboveTo(0, 100), "Thickness field"),
              "thickness as a multiple of the material's")
      .defaultsTo("the material's")
      .object("fibre_angle", angle, patchFieldTable("rad", between(-7, 7), "Fibre angle field"),
              "turns the weft about the normal")
      .defaultsTo("none")
      .object("material", material, patchFieldTable("", between(0, 1000), "Material field"),
              "0: the material, k: other_materials[k - 1]; between whole numbers the two are mixed")
      .defaultsTo("the material everywhere")
      .build();
}

template <class Get>
void addKnots(Table<SheetCase>& table, const std::string& key, Get get, const std::string& along) {
  Field f = fieldOf(key, Kind::numbers, "", between(0, 1),
                    fmt::format("further knots along {}, fractions of each patch's range (strictly between 0 and 1); "
                                "repeat a knot to lower the smoothness there",
                                along));
  table.custom(
      f,
      [get](const Place& p, SheetCase& s) {
        s.*get = readNumbers(p, "", {.low = 0, .high = 1, .low_open = true, .high_open = true});
      },
      [get](const SheetCase& s) { return std::optional(nodeOfList(s.*get)); });
}

}  // namespace

Object noiseTable() {
  using N = NoiseCase;
  return Table<N>("Noise")
      .number("amplitude", &N::amplitude_m, "m", aboveTo(0, 1e9), "largest displacement along the normal")
      .required()
      .integer("seed", &N::seed, 0, 1000000000, "another seed gives another pattern, the same on every machine")
      .integer("from", &N::from, 0, 1000,
               "lowest number of waves over the sheet; 0: no waves, each control point moves by itself")
      .integer("to", &N::to, 0, 1000, "highest number of waves")
      .choice("along", &N::along_v, std::vector<std::pair<std::string, bool>>{{"u", false}, {"v", true}},
              "the direction of the waves")
      .check([](const Place& p, const N& n) {
        if (n.to < n.from) p.failAt("to", fmt::format("{} is out of range; allowed: >= from = {}", n.to, n.from));
        if (n.from == 0 && n.to > 0) p.failAt("from", "is required with \"to\": the lowest number of waves, >= 1");
      })
      .build();
}

Object structureSheetTable() {
  using S = SheetCase;
  Table<S> table("Sheet");
  table.alternative<PlateShape>("plate", &S::shape, plateTable(), "a flat rectangle")
      .in("shape")
      .alternative<CylinderShape>("cylinder", &S::shape, cylinderTable(), "a circular cylinder or a part of one, exact")
      .in("shape")
      .alternative<SphereShape>("sphere", &S::shape, sphereTable(), "a zone of a sphere or a part of one, exact")
      .in("shape")
      .alternative<AnnulusShape>("annulus", &S::shape, annulusTable(), "a flat ring or a part of one, exact")
      .in("shape")
      .alternative<NurbsShape>("nurbs", &S::shape, nurbsTable(), "NURBS patches, written out")
      .in("shape")
      .alternative<SheetFile>("file", &S::shape, sheetFileTable(), "patches and seams from a garment file")
      .in("shape")
      .oneOf("shape", true)
      .integer("degree", &S::degree, 2, 5,
               "polynomial degree of both directions; the geometry stays exact (k-refinement: first the degree, then "
               "the knots). Patches of your own are raised to it where they are lower")
      .integer("cells_u", &S::cells_u, 1, 2000,
               "cells along u of a built shape. Arcs are joined of pieces of at most 90 deg, each with the same number "
               "of cells, by seams with common tangents: cells must be at least as many as quarters")
      .defaultsTo("16 for built shapes")
      .integer("cells_v", &S::cells_v, 1, 2000, "cells along v of a built shape")
      .defaultsTo("16 for built shapes")
      .integer("split", &S::split, 1, 1000, "nurbs and file: into how many parts each of their cells is split each way")
      .defaultsTo("1 for nurbs and file");
  addKnots(table, "refine_u", &S::refine_u, "u");
  addKnots(table, "refine_v", &S::refine_v, "v");
  return table.direction("weft", &S::weft, "direction 1 of the material, projected on the surface")
      .defaultsTo(
          "axis_u of a plate, axis of a cylinder or sphere, zero of an annulus, along u in the middle of a patch of "
          "your own")
      .number("weft_angle", &S::weft_angle_rad, "rad", between(-7, 7),
              "turns the weft about the normal, counter-clockwise seen against it")
      .list("trim", &S::trim, trimTable(), "closed loops that cut the sheet")
      .integer("trim_points", &S::trim_points, 0, 20,
               "integration points each way on the pieces of cut cells; 0: degree + 1")
      .number("trim_unused", &S::trim_unused, "", between(0, 0.5),
              "control points with less than this part of their area inside follow their neighbours")
      .list("fields", &S::fields, fieldsTable(), "thickness, fibre angle and material that vary over a patch")
      .object("imperfection", &S::imperfection, noiseTable(), "deviation of the stress-free shape along its normal")
      .defaultsTo("none")
      .choice("cell_rule", &S::rule,
              std::vector<std::pair<std::string, CellRule>>{
                  {"automatic", CellRule::automatic}, {"full", CellRule::full}, {"assumed", CellRule::assumed}},
              "integration of quadratic cells, which lock in bending under full, 3 x 3 Gauss points; automatic: 2 x 2, "
              "but 3 x 3 on trimmed patches and on those with fewer than three cells along u or v; assumed: strains "
              "taken at the knots, free of locking but less accurate for wrinkles. Other degrees: "
              "degree + 1")
      .integer("gauss_extra", &S::gauss_extra, 0, 5, "more integration points each way than the rule takes")
      .build();
}

}  // namespace gambeson::schema
