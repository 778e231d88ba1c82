#pragma once
/// The keys by which a table speaks of a place on the sheet. Internal to the tables of structures.

#include <type_traits>

#include "cases/input/table.hpp"
#include "cases/structure/fields.hpp"

namespace gambeson::schema {

/// Of what has a place: a variant, or a PointAt alone.
template <class Where>
PointAt* pointOf(Where& where) {
  if constexpr (std::is_same_v<Where, PointAt>)
    return &where;
  else
    return std::get_if<PointAt>(&where);
}
template <class Where>
const PointAt* pointOf(const Where& where) {
  if constexpr (std::is_same_v<Where, PointAt>)
    return &where;
  else
    return std::get_if<PointAt>(&where);
}

/// The key "edge" of T::where.
template <class T>
void addEdge(Table<T>& table, bool required) {
  Field f;
  f.key = "edge";
  f.kind = Kind::text;
  f.required = required;
  f.doc =
      "an edge of the sheet: u0, u1, v0 or v1, where u or v is smallest or largest; of one patch among several: such "
      "as "
      "2.u0";
  table.custom(
      f, [](const Entry& p, T& t) { t.where = readEdgeAt(p); },
      [](const T& t) -> std::optional<JsonNode> {
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(t.where)>, EdgeAt>) {
          return nodeOf(t.where);
        } else {
          const EdgeAt* e = std::get_if<EdgeAt>(&t.where);
          return e ? std::optional(nodeOf(*e)) : std::nullopt;
        }
      });
}

/// The keys "point" and "corner" of T::where, alternatives called "where".
template <class T>
void addPoint(Table<T>& table) {
  Field point;
  point.key = "point";
  point.kind = Kind::pair;
  point.range = between(0, 1);
  point.doc = "a point: fractions of the sheet's lengths or angles along u and v; with patch, of its parameter range";
  Field corner;
  corner.key = "corner";
  corner.kind = Kind::choice;
  corner.choices = {"u0v0", "u1v0", "u0v1", "u1v1"};
  corner.doc = "a corner";
  table.custom(
      point,
      [](const Entry& p, T& t) {
        t.where = PointAt{-1, readPair(p, "", between(0, 1))};
      },
      [](const T& t) -> std::optional<JsonNode> {
        const PointAt* q = pointOf(t.where);
        return q ? std::optional(nodeOf(q->at)) : std::nullopt;
      });
  table.in("where");
  table.custom(
      corner,
      [](const Entry& p, T& t) {
        t.where = PointAt{-1, readCorner(p)};
      },
      [](const T&) { return std::optional<JsonNode>(); });
  table.in("where");
}

/// Adds the key "patch", which says on which patch the point lies; call after addPoint.
template <class T>
void addPatchOfPoint(Table<T>& table) {
  Field f;
  f.key = "patch";
  f.kind = Kind::integer;
  f.range = between(0, 10000);
  f.default_note = "the whole sheet";
  f.doc = "which patch a point or corner lies on, where a sheet has several";
  table.custom(
      f,
      [](const Entry& p, T& t) {
        PointAt* q = pointOf(t.where);
        if (!q) p.fail("goes with point or corner; an edge names its patch itself, such as 2.u0");
        q->patch = readInteger(p, between(0, 10000));
      },
      [](const T& t) -> std::optional<JsonNode> {
        const PointAt* q = pointOf(t.where);
        return q && q->patch >= 0 ? std::optional(schema::nodeOf(static_cast<double>(q->patch))) : std::nullopt;
      });
}

}  // namespace gambeson::schema
