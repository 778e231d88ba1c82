/// Detail of fields.hpp: the tables of supports and loads.

#include <fmt/format.h>

#include "cases/input/table.hpp"
#include "cases/structure/fields.hpp"
#include "cases/structure/fields_place.hpp"

namespace gambeson::schema {
namespace {

const Range any_amount = between(-1e18, 1e18);
const std::vector<std::string> side_names{"u0", "u1", "v0", "v1"};
const std::vector<std::string> holds{"x", "y", "z", "xy", "xz", "yz", "xyz"};

void readHold(const Entry& p, StructureSupport& s) {
  s.hold.clear();
  if (p.node.type == JsonNode::Type::text) {
    for (const char c : holds[readChoice(p, holds)])
      s.hold.push_back({c == 'x' ? 1. : 0., c == 'y' ? 1. : 0., c == 'z' ? 1. : 0.});
    return;
  }
  if (p.node.type != JsonNode::Type::list || p.node.children.empty() || p.node.children.size() > 3)
    p.fail(fmt::format("expected one of {}, or a list of one to three directions [x, y, z], not {}", joined(holds),
                       describe(p.node)));
  for (std::size_t i = 0; i < p.node.children.size(); ++i) s.hold.push_back(readDirection(p.item(i)));
  // Directions that depend on each other would state the same twice, or contradict.
  for (std::size_t i = 0; i < s.hold.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (!(std::abs(dot(s.hold[i], s.hold[k])) < 1e-6))
        p.item(i).fail(fmt::format("is not at right angles to direction {}; allowed: directions at right angles", k));
}

Field loadField(const std::string& key, Kind kind, const std::string& unit, const std::string& doc) {
  Field f;
  f.key = key;
  f.kind = kind;
  f.unit = unit;
  f.range = any_amount;
  f.doc = doc;
  return f;
}

void addVectorLoad(Table<StructureLoad>& table, const std::string& key, LoadSort sort, const std::string& unit,
                   const std::string& doc) {
  table.custom(
      loadField(key, Kind::vector, unit, doc),
      [sort, unit](const Entry& p, StructureLoad& l) {
        l.sort = sort;
        l.vector = readVector(p, unit, any_amount);
      },
      [sort](const StructureLoad& l) { return l.sort == sort ? std::optional(nodeOf(l.vector)) : std::nullopt; });
  table.in("load");
}

void addNumberLoad(Table<StructureLoad>& table, const std::string& key, LoadSort sort, const std::string& unit,
                   const std::string& doc) {
  table.custom(
      loadField(key, Kind::number, unit, doc),
      [sort, unit](const Entry& p, StructureLoad& l) {
        l.sort = sort;
        l.amount = readNumber(p, unit, any_amount);
      },
      [sort](const StructureLoad& l) { return l.sort == sort ? std::optional(nodeOf(l.amount)) : std::nullopt; });
  table.in("load");
}

const std::string program_doc = "name of the program that multiplies it";
const std::string program_default = "static: the load factor; dynamic and modal: 1";

void checkLoad(const Entry& p, const StructureLoad& l) {
  const bool edge = std::holds_alternative<EdgeAt>(l.where), point = std::holds_alternative<PointAt>(l.where);
  const bool nowhere = !edge && !point;
  switch (l.sort) {
    case LoadSort::force:
      if (nowhere) p.failAt("force", "is the total on a place; give edge, point or corner with it (or force_per_area)");
      break;
    case LoadSort::force_per_length:
    case LoadSort::moment:
    case LoadSort::moment_per_length:
      if (!edge) p.failAt("edge", "is required: moments and forces per length act on an edge");
      break;
    case LoadSort::force_per_area:
    case LoadSort::pressure:
    case LoadSort::gravity:
      if (!nowhere)
        for (const char* key : {"edge", "point", "corner"})
          if (p.node.find(key)) p.failAt(key, "has no meaning for a load on the surface; remove it");
      break;
  }
  if (l.patch && !nowhere)
    p.failAt("patch", "goes with a load on the surface here; edges name their patch, such as 2.u0");
  if (l.patch && l.sort == LoadSort::gravity) p.failAt("patch", "gravity pulls all patches; remove it");
}

}  // namespace

EdgeAt readEdgeAt(const Entry& entry) {
  const std::string& text = readText(entry);
  const std::size_t dot_at = text.find('.');
  const std::string patch = dot_at == std::string::npos ? "" : text.substr(0, dot_at);
  const std::string side = dot_at == std::string::npos ? text : text.substr(dot_at + 1);
  const auto found = std::find(side_names.begin(), side_names.end(), side);
  const bool number = !patch.empty() && patch.size() <= 4 && patch.find_first_not_of("0123456789") == std::string::npos;
  if (found == side_names.end() || (dot_at != std::string::npos && !number))
    entry.fail(describe(entry.node) + " is not an edge; allowed: u0, u1, v0, v1, or patch and side such as 2.u0");
  return {number ? std::stoi(patch) : -1, static_cast<Side>(found - side_names.begin())};
}

JsonNode nodeOf(const EdgeAt& edge) {
  const std::string& side = side_names[static_cast<std::size_t>(edge.side)];
  return nodeOf(edge.patch < 0 ? side : fmt::format("{}.{}", edge.patch, side));
}

Vec2 readCorner(const Entry& entry) {
  static const std::vector<std::string> corners{"u0v0", "u1v0", "u0v1", "u1v1"};
  const std::size_t k = readChoice(entry, corners);
  return {k % 2 ? 1. : 0., k / 2 ? 1. : 0.};
}

Object structureSupportTable() {
  using S = StructureSupport;
  Table<S> table("Support");
  addEdge(table, false);
  table.in("where");
  addPoint(table);
  addPatchOfPoint(table);
  Field hold;
  hold.key = "hold";
  hold.kind = Kind::lists;
  hold.choices = holds;
  hold.default_note = "xyz with move, else nothing";
  hold.doc = "directions that are held: letters of world axes, or a list of directions at right angles";
  return table.oneOf("where", true)
      .custom(hold, readHold,
              [](const S& s) -> std::optional<JsonNode> {
                if (s.hold.empty()) return std::nullopt;
                JsonNode list = emptyList();
                for (const Vec3& d : s.hold) list.children.push_back(nodeOf(d));
                return list;
              })
      .flag("clamp", &S::clamp,
            "the sheet does not turn about the edge (the row of control points beside the edge keeps its height over "
            "it); hold "
            "the edge as well")
      .direction(
          "symmetry", &S::symmetry,
          "normal of a mirror plane: the edge lies in that plane and stays there, and the sheet crosses it at right "
          "angles")
      .defaultsTo("none")
      .direction("tie", &S::tie, "all points of the edge move alike in this direction, as on a rigid bar")
      .defaultsTo("none")
      .vector("move", &S::move_m, "m", between(-1e9, 1e9), "moves what is held, at the program's value 1")
      .defaultsTo("none")
      .text("program", &S::program, program_doc + ", the motion")
      .defaultsTo(program_default)
      .check([](const Entry& p, S& s) {
        const bool point = std::holds_alternative<PointAt>(s.where);
        if (point && (s.clamp || s.symmetry || s.tie))
          p.failAt(s.clamp ? "clamp" : s.symmetry ? "symmetry" : "tie", "goes with an edge, not with a point");
        if (s.move_m && s.hold.empty()) s.hold = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        if (s.hold.empty() && !s.clamp && !s.symmetry && !s.tie)
          p.fail("says nothing about the place; give hold, clamp, symmetry, tie or move");
        if (s.symmetry && (!s.hold.empty() || s.clamp))
          p.failAt("symmetry",
                   "already holds the edge in the plane and its slope; give hold or clamp in a support of "
                   "its own where there is more to hold");
        if (s.move_m) {
          Vec3 rest = *s.move_m;
          for (const Vec3& d : s.hold) rest -= dot(rest, d) * d;
          if (!(norm(rest) <= 1e-9 * norm(*s.move_m)))
            p.failAt("move",
                     "contradicts hold: it moves in a direction that is free; allowed: within the held directions");
        } else if (!s.program.empty()) {
          p.failAt("program", "goes with move");
        }
      })
      .build();
}

Object structureLoadTable() {
  using L = StructureLoad;
  Table<L> table("Load");
  addEdge(table, false);
  table.in("where");
  addPoint(table);
  table.oneOf("where", false);
  Field patch;
  patch.key = "patch";
  patch.kind = Kind::integer;
  patch.range = between(0, 10000);
  patch.default_note = "the whole sheet";
  patch.doc = "which patch a point, a corner or a load on the surface is on, where a sheet has several";
  table.custom(
      patch,
      [](const Entry& p, L& l) {
        const int k = readInteger(p, between(0, 10000));
        if (PointAt* q = pointOf(l.where))
          q->patch = k;
        else
          l.patch = k;
      },
      [](const L& l) -> std::optional<JsonNode> {
        const PointAt* q = pointOf(l.where);
        const int k = q ? q->patch : l.patch.value_or(-1);
        return k >= 0 ? std::optional(schema::nodeOf(static_cast<double>(k))) : std::nullopt;
      });
  addVectorLoad(table, "force", LoadSort::force, "N",
                "dead force: on a point, or the total spread evenly over an edge's rest length");
  addVectorLoad(table, "force_per_length", LoadSort::force_per_length, "N/m", "dead force per rest length of an edge");
  addNumberLoad(table, "moment", LoadSort::moment, "N m",
                "moment spread evenly over an edge's rest length, about its current tangent (right-handed, along "
                "growing u or v); it follows the sheet");
  addNumberLoad(table, "moment_per_length", LoadSort::moment_per_length, "N", "the same per rest length");
  addVectorLoad(table, "force_per_area", LoadSort::force_per_area, "N/m^2", "dead force per rest area of the sheet");
  addNumberLoad(table, "pressure", LoadSort::pressure, "Pa",
                "along the current normal, per current area; it follows the sheet");
  addVectorLoad(table, "gravity", LoadSort::gravity, "m/s^2", "acceleration: the sheet's own weight");
  return table.oneOf("load", true)
      .text("program", &L::program, program_doc)
      .defaultsTo(program_default)
      .check([](const Entry& p, const L& l) { checkLoad(p, l); })
      .build();
}

}  // namespace gambeson::schema
