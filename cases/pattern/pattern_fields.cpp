/// Detail of pattern_file.hpp: the fields of a pattern's file.

#include "cases/pattern/pattern_fields.hpp"

#include <numbers>
#include <type_traits>

#include "cases/input/message.hpp"
#include "cases/input/table.hpp"
#include "cases/pattern/pattern_file.hpp"
#include "cases/pattern/seam_edits.hpp"
#include "tryon/pattern/flat/regions.hpp"

namespace gambeson::schema {
namespace {

std::vector<Vec2> readPoints(const Entry& p) {
  if (p.node.type != JsonNode::Type::list) p.fail("expected a list [ ] of points, not " + describe(p.node));
  std::vector<Vec2> out;
  for (std::size_t k = 0; k < p.node.children.size(); ++k) out.push_back(readPair(p.item(k), "m", any()));
  return out;
}
JsonNode nodeOfPoints(const std::vector<Vec2>& points) {
  JsonNode n = emptyList();
  for (const Vec2& x : points) n.children.push_back(nodeOf(x));
  return n;
}

template <class T, class Get>
Table<T>& point(Table<T>& table, const std::string& key, Get get, const std::string& doc) {
  return table.custom(
      fieldOf(key, Kind::pair, "m", any(), doc),
      [=](const Entry& p, T& t) { std::invoke(get, t) = readPair(p, "m", any()); },
      [=](const T& t) -> std::optional<JsonNode> { return nodeOf(std::invoke(get, t)); });
}
template <class T, class Get>
Table<T>& points(Table<T>& table, const std::string& key, Get get, const std::string& doc) {
  return table.custom(
      fieldOf(key, Kind::lists, "m", any(), doc), [=](const Entry& p, T& t) { std::invoke(get, t) = readPoints(p); },
      [=](const T& t) -> std::optional<JsonNode> { return nodeOfPoints(std::invoke(get, t)); });
}

Object splineTable() {
  using S = SplineEdge;
  Table<S> table("Spline of an edge");
  table.integer("degree", &S::degree, 1, 20, "degree").required();
  table
      .custom(
          fieldOf("knots", Kind::numbers, "", any(), "ascending; the first and the last stand degree + 1 times"),
          [](const Entry& p, S& s) { s.knots = readNumbers(p, "", any()); },
          [](const S& s) -> std::optional<JsonNode> { return nodeOfList(s.knots); })
      .required();
  points(table, "points", &S::controls_m, "control points without the first and the last, which are the edge's ends")
      .required();
  table
      .custom(
          fieldOf("weights", Kind::numbers, "", above(0), "of all control points, both ends among them"),
          [](const Entry& p, S& s) { s.weights = readNumbers(p, "", above(0)); },
          [](const S& s) { return s.weights.empty() ? std::nullopt : std::optional(nodeOfList(s.weights)); })
      .defaultsTo("all 1");
  return table.build();
}

Object edgeTable() {
  using E = PanelEdge;
  Table<E> table("Edge of a panel");
  table.text("name", &E::name, "what the edge is called, as hem");
  point(table, "start", &E::start_m, "where it starts; it ends where the next one starts").required();
  table
      .custom(
          fieldOf("bezier", Kind::lists, "m", any(),
                  "inner control points of a Bezier curve: one (quadratic) or two (cubic)"),
          [](const Entry& p, E& e) { e.curve = BezierEdge{readPoints(p)}; },
          [](const E& e) -> std::optional<JsonNode> {
            const auto* b = std::get_if<BezierEdge>(&e.curve);
            return b ? std::optional(nodeOfPoints(b->controls_m)) : std::nullopt;
          })
      .in("curve")
      .custom(
          fieldOf("arc", Kind::number, "rad", any(),
                  "angle by which a circular arc turns on its way, to the left where it is positive"),
          [](const Entry& p, E& e) { e.curve = ArcEdge{readNumber(p, "rad", any())}; },
          [](const E& e) -> std::optional<JsonNode> {
            const auto* a = std::get_if<ArcEdge>(&e.curve);
            return a ? std::optional(nodeOf(a->turn_rad)) : std::nullopt;
          })
      .in("curve")
      .alternative<SplineEdge>(
          "spline", [](auto& e) -> auto& { return e.curve; }, splineTable(), "a NURBS curve")
      .in("curve")
      .custom(
          fieldOf("polyline", Kind::lists, "m", any(), "points of a polyline between its ends"),
          [](const Entry& p, E& e) { e.curve = PolylineEdge{readPoints(p)}; },
          [](const E& e) -> std::optional<JsonNode> {
            const auto* l = std::get_if<PolylineEdge>(&e.curve);
            return l ? std::optional(nodeOfPoints(l->points_m)) : std::nullopt;
          })
      .in("curve")
      .oneOf("curve", false);
  return table.build();
}

Object grainTable() {
  Table<GrainLine> table("Grain line of a panel");
  point(table, "from", &GrainLine::from_m, "one end").required();
  point(table, "to", &GrainLine::to_m, "other end: the warp runs along the line").required();
  return table.build();
}

Object notchTable() {
  Table<Notch> table("Notch of a panel");
  table.integer("edge", &Notch::edge, 0, 1000000, "number of the edge, from 0").required();
  table.number("at", &Notch::at, "", between(0, 1), "fraction of the edge's length").required();
  table.choice("kind", &Notch::kind,
               std::vector<std::pair<std::string, NotchKind>>{{"slit", NotchKind::slit},
                                                              {"v", NotchKind::v},
                                                              {"t", NotchKind::t},
                                                              {"castle", NotchKind::castle},
                                                              {"check", NotchKind::check},
                                                              {"u", NotchKind::u}},
               "how it is cut");
  table.number("depth", &Notch::depth_m, "m", between(0, 0.1), "how deep; 0: not said").unwritten();
  return table.build();
}

Object lineTable() {
  Table<InternalLine> table("Internal line of a panel");
  table
      .choice("kind", &InternalLine::kind,
              std::vector<std::pair<std::string, LineKind>>{{"internal", LineKind::internal},
                                                            {"sew", LineKind::sew},
                                                            {"fold", LineKind::fold},
                                                            {"stripe", LineKind::stripe},
                                                            {"plaid", LineKind::plaid},
                                                            {"grade", LineKind::grade},
                                                            {"drill", LineKind::drill}},
              "what it is for; drill: a hole, at one point")
      .required();
  points(table, "points", &InternalLine::points_m, "points of a polyline").required();
  table.flag("closed", &InternalLine::closed, "whether it ends where it starts").unwritten();
  return table.build();
}

Object annotationTable() {
  Table<Annotation> table("Annotation of a panel");
  table.text("text", &Annotation::text, "what is written").required();
  point(table, "at", &Annotation::at_m, "where").required();
  return table.build();
}

Object placementTable() {
  using P = PanelPlace;
  Table<P> table("Placement of a panel");
  table.vector("origin", &P::origin_m, "m", any(), "where the panel's point (0, 0) stands").required();
  table.vector("along_x", &P::along_x, "", between(-1, 1), "unit vector along the panel's x").required();
  table.vector("along_y", &P::along_y, "", between(-1, 1), "unit vector along its y; x cross y points off the wearer")
      .required();
  return table.build();
}

Object panelTable() {
  using P = Panel;
  Table<P> table("Panel");
  table.text("name", &P::name, "no other panel has it").required();
  table
      .list("outline", &P::outline, edgeTable(),
            "edges, counter-clockwise as seen from the right side of the cloth; numbered from 0")
      .required();
  table.custom(
      [] {
        Field f = fieldOf("cutouts", Kind::any, "", any(),
                          "holes: a list of loops, each a list of edges as of the outline, clockwise; their edges are "
                          "numbered on from the outline's");
        f.default_note = "none";
        return f;
      }(),
      [](const Entry& p, P& panel) {
        static const Object edge = edgeTable();
        if (p.node.type != JsonNode::Type::list) p.fail("expected a list [ ] of loops, not " + describe(p.node));
        for (std::size_t k = 0; k < p.node.children.size(); ++k) {
          const Entry loop = p.item(k);
          if (loop.node.type != JsonNode::Type::list)
            loop.fail("expected a list [ ] of edges, not " + describe(loop.node));
          PanelLoop& edges = panel.cutouts.emplace_back();
          for (std::size_t i = 0; i < loop.node.children.size(); ++i)
            readObject(edge, loop.item(i), &edges.emplace_back());
        }
      },
      [](const P& panel) -> std::optional<JsonNode> {
        static const Object edge = edgeTable();
        if (panel.cutouts.empty()) return std::nullopt;
        JsonNode loops = emptyList();
        for (const PanelLoop& loop : panel.cutouts) {
          JsonNode& edges = loops.children.emplace_back(emptyList());
          for (const PanelEdge& e : loop) edges.children.push_back(writeObject(edge, &e));
        }
        return loops;
      });
  table.list("cut_line", &P::cut_line, edgeTable(), "where it is cut: the outline with its seam allowance");
  table.object("grain", &P::grain, grainTable(), "along the warp").defaultsTo("the warp runs along y");
  table.list("notches", &P::notches, notchTable(), "marks at edges");
  table.list("lines", &P::lines, lineTable(), "what is drawn on the cloth");
  table.list("annotations", &P::annotations, annotationTable(), "what is written on the cloth");
  table.object("placement", &P::placement, placementTable(), "where it stands around its wearer before it is sewn")
      .defaultsTo("not said");
  std::string regions;
  for (const std::string& name : regionNames()) regions += (regions.empty() ? "" : ", ") + name;
  table.text("region", &P::region,
             "part of the body that it covers, by which it is placed around a wearer where it has no placement: " +
                 regions + " (left and right are the wearer's); another word is what its source calls it");
  table.text("material", &P::material, "what it is cut of, in the words of its source");
  table.text("size", &P::size, "in the words of its source");
  table.integer("quantity", &P::quantity, 1, 1000, "how often it is cut").unwritten();
  return table.build();
}

/// What a seam of a file says, or an edit of one: that has values where it says something.
template <class S>
void addSeamFields(Table<S>& table) {
  constexpr bool edits = std::is_same_v<S, SeamEdit>;
  const auto otherwise = [&] {
    if constexpr (edits)
      table.defaultsTo("as it is in the pattern's file");
    else
      table.unwritten();
  };
  table.choice("use", &S::use,
               std::vector<std::pair<std::string, SeamUse>>{
                   {"sewn", SeamUse::sewn}, {"dart", SeamUse::dart}, {"opening", SeamUse::opening}},
               "dart: of one panel; opening: it may be open (zip, buttons, lacing)");
  otherwise();
  const char* const open = "of an opening: it is worn open, and nothing holds it but its buttons";
  if constexpr (edits)
    table.custom(
        fieldOf("open", Kind::boolean, "", any(), open), [](const Entry& p, S& s) { s.open = readBoolean(p); },
        [](const S& s) { return s.open ? std::optional(nodeOf(*s.open)) : std::nullopt; });
  else
    table.flag("open", &S::open, open);
  otherwise();
  table.integer("buttons", &S::buttons, 0, 100,
                "that hold an open seam, each 1 cm of it (a cell, where that is longer): evenly spaced, the first and "
                "the last half a space from its ends");
  otherwise();
  table.number("stiffness", &S::stiffness_N, "N", between(0, 1e3),
               "rotational spring along it [N m/(m rad)]: pressed open, topstitched");
  otherwise();
  table.number("rest_angle", &S::rest_angle_rad, "rad", between(-std::numbers::pi, std::numbers::pi),
               "of that spring; 0: both sides side by side in one plane");
  otherwise();
}

Object seamTable() {
  using S = SeamInput;
  Table<S> table("Seam of a pattern");
  table.text("name", &S::name, "what pages call it");
  table
      .texts("a", &S::a,
             "one side: edges, one after the other, as \"front.3\", \"front.hem\", \"front.3 reversed\" or \"front.3 "
             "from 0.25 to 1\" (panel, number of the edge or its name, fractions of its length)")
      .required();
  table.texts("b", &S::b, "the other side: points at equal fractions of the length of both come together").required();
  addSeamFields(table);
  table.flag("proposed", &S::proposed, "guessed from lengths and notches; take this away where it is right")
      .unwritten();
  return table.build();
}

Object makeSeamEditTable() {
  using E = SeamEdit;
  Table<E> table("Edit of a pattern's seam");
  table
      .text("seam", &E::seam,
            "of the pattern's seams the one that is changed, by its name or by an edge that is sewn in it "
            "(\"front.3\", \"front.hem\"); with a and b the name of a new one")
      .required();
  table.flag("remove", &E::remove, "it is not sewn at all").unwritten();
  table
      .texts(
          "a", &E::a,
          "one side of a new seam, as in a pattern's file: \"front.3\", \"front.3 reversed\", \"front.3 from 0.25 to "
          "1\"")
      .defaultsTo("none: the seam is one of the pattern's file");
  table.texts("b", &E::b, "its other side").defaultsTo("none");
  addSeamFields(table);
  table.check([](const Entry& p, const E& e) {
    if (e.a.empty() != e.b.empty())
      p.failAt(e.a.empty() ? "b" : "a", "is one side of a new seam; allowed: both a and b, or neither");
    bool says = e.remove;
    for (const auto& [key, given] :
         std::initializer_list<std::pair<const char*, bool>>{{"a", !e.a.empty()},
                                                             {"use", e.use.has_value()},
                                                             {"open", e.open.has_value()},
                                                             {"buttons", e.buttons.has_value()},
                                                             {"stiffness", e.stiffness_N.has_value()},
                                                             {"rest_angle", e.rest_angle_rad.has_value()}}) {
      if (e.remove && given) p.failAt(key, "has no meaning for a seam that is taken away; allowed: without \"remove\"");
      says = says || given;
    }
    if (!says)
      p.fail(
          "changes nothing; allowed: \"remove\": true, use, open, buttons, stiffness, rest_angle, or a and b of a new "
          "seam");
  });
  return table.build();
}

Object sourceTable() {
  using S = PatternSource;
  Table<S> table("Source of a pattern");
  table.text("file", &S::file, "the file that it was imported from");
  table.text("format", &S::format, "of that file");
  table.text("unit", &S::unit, "of that file; here all is in m");
  return table.build();
}

Object makePatternTable() {
  using F = PatternInput;
  Table<F> table("Pattern", "a flat pattern: panels as they are cut, and what is sewn to what");
  table
      .choice("format", &F::version, std::vector<std::pair<std::string, int>>{{"gambeson pattern 1", 1}},
              "says that this is a pattern")
      .required();
  table
      .text(
          "name", [](auto& f) -> auto& { return f.pattern.name; }, "of the garment")
      .required();
  table
      .choice(
          "placing", [](auto& f) -> auto& { return f.pattern.placing; },
          std::vector<std::pair<std::string, PanelPlacing>>{{"given", PanelPlacing::given},
                                                            {"regions", PanelPlacing::regions}},
          "where panels start around a wearer: given: at their placements, or by their regions where some have no "
          "placement; regions: by their regions, as on another body than they were placed for")
      .unwritten();
  table.object(
      "source", [](auto& f) -> auto& { return f.pattern.source; }, sourceTable(), "where it comes from");
  table
      .list(
          "panels", [](auto& f) -> auto& { return f.pattern.panels; }, panelTable(), "what is cut")
      .required();
  table.list("seams", &F::seams, seamTable(), "what is sewn");
  return table.build();
}

}  // namespace

const Object& seamEditTable() {
  static const Object table = makeSeamEditTable();
  return table;
}

const Object& patternTable() {
  static const Object table = makePatternTable();
  return table;
}

}  // namespace gambeson::schema
