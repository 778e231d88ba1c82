#pragma once
/// Parts of the table of a structure's sheet.

#include "cases/input/table.hpp"
#include "cases/structure/fields.hpp"

namespace gambeson::schema::sheet {

// Shapes.
Object plateTable();      ///< PlateShape
Object cylinderTable();   ///< CylinderShape
Object sphereTable();     ///< SphereShape
Object annulusTable();    ///< AnnulusShape
Object nurbsTable();      ///< NurbsShape
Object sheetFileTable();  ///< SheetFile

Object trimTable();  ///< TrimCase

inline const Range world = between(-1e9, 1e9);
inline const Range size = aboveTo(0, 1e9);

/// A list of points [m]; `one` reads each.
template <class Point>
std::vector<Point> readPoints(const Entry& p, Point (*one)(const Entry&, const std::string&, const Range&)) {
  if (p.node.type != JsonNode::Type::list) p.fail("expected a list of points, not " + describe(p.node));
  std::vector<Point> points;
  for (std::size_t i = 0; i < p.node.children.size(); ++i) points.push_back(one(p.item(i), "m", world));
  return points;
}

template <class Point>
JsonNode nodeOfPoints(const std::vector<Point>& points) {
  JsonNode list = emptyList();
  for (const Point& x : points) list.children.push_back(nodeOf(x));
  return list;
}

}  // namespace gambeson::schema::sheet
