#include "cases/cloth/curve_input.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "analysis/ticks.hpp"
#include "cases/input/table.hpp"
#include "core/error.hpp"

namespace gambeson::schema {
namespace {

constexpr std::size_t kMostPoints = 1000;
const Range strains = aboveTo(0, 5), forces = aboveTo(0, 1e7);

double readWithUnit(const Entry& entry, const char* unit, const Range& range, bool with_unit) {
  if (with_unit && *unit && entry.node.type == JsonNode::Type::number)
    entry.fail(fmt::format("{} has no unit; write for example \"20 gf/cm\"; allowed: {}", entry.node.number,
                           range.text(unit)));
  return readNumber(entry, unit, range);
}

template <class Get>
void addPoints(Table<CurveLaw>& table, const std::string& key, Get get, const std::string& doc) {
  table.custom(
      fieldOf(key, Kind::lists, "", any(), doc),
      [=](const Entry& p, CurveLaw& l) { std::invoke(get, l) = readTensilePoints(p); },
      [=](const CurveLaw& l) { return std::optional(nodeOf(std::invoke(get, l))); });
}

}  // namespace

std::vector<TensilePoint> readTensilePoints(const Entry& entry, bool with_units) {
  if (entry.node.type != JsonNode::Type::list || entry.node.children.empty() ||
      entry.node.children.size() > kMostPoints)
    entry.fail(fmt::format("expected a list of 1 to {} pairs [strain, force per width], not {}", kMostPoints,
                           describe(entry.node)));
  std::vector<TensilePoint> points;
  for (std::size_t i = 0; i < entry.node.children.size(); ++i) {
    const Entry pair = entry.item(i);
    if (pair.node.type != JsonNode::Type::list || pair.node.children.size() != 2)
      pair.fail("expected a pair [strain, force per width], not " + describe(pair.node));
    const TensilePoint point{readWithUnit(pair.item(0), "", strains, with_units),
                             readWithUnit(pair.item(1), "N/m", forces, with_units)};
    const TensilePoint before = points.empty() ? TensilePoint{} : points.back();
    for (std::size_t k = 0; k < 2; ++k)
      if (!(point[k] > before[k]))
        pair.item(k).fail(
            fmt::format("{:g}{} is out of range; allowed: > {:g}{}, that of the point before: a curve "
                        "ascends",
                        point[k], k ? " N/m" : "", before[k], k ? " N/m" : ""));
    points.push_back(point);
  }
  return points;
}

JsonNode nodeOf(const std::vector<TensilePoint>& points) {
  JsonNode rows = emptyList();
  for (const auto& [strain, force] : points) rows.children.push_back(nodeOfList({strain, force}));
  return rows;
}

Object curvesTable() {
  using L = CurveLaw;
  Table<L> table("Curves of a law");
  const std::string pairs =
      "a list of pairs [engineering strain, force per width at rest], the points of a tensile test along the ";
  addPoints(
      table, "weft", [](auto& l) -> auto& { return l.tension[0]; },
      pairs + "weft, ascending from above 0; between them a monotone cubic (Fritsch and Carlson 1980)");
  table.required();
  addPoints(
      table, "warp", [](auto& l) -> auto& { return l.tension[1]; }, pairs + "warp");
  table.required();
  const auto rigidity = [&](const char* key, std::size_t i, const std::string& doc) {
    table.number(
        key, [i](auto& l) -> auto& { return l.rigidity_Nm[i]; }, "N m", i < 2 ? aboveTo(0, 1e3) : between(0, 1e3), doc);
  };
  table
      .number("shear", &L::shear_N_per_m, "N/m", aboveTo(0, 1e7),
              "shear stiffness, linear: shear force per width over the tangent of the angle (G of KES-FB1)")
      .required();
  rigidity("rigidity_weft", 0, "rigidity in bending along the weft, linear");
  table.required();
  rigidity("rigidity_warp", 1, "the same along the warp");
  table.required();
  rigidity("twist", 2, "twist rigidity");
  return table.build();
}

std::string inWords(const CurveLaw& law) {
  const auto last = [&](std::size_t i) {
    const auto& [strain, force] = law.tension[i].back();
    return fmt::format("{} % ({} N/m)", formatNumber(100 * strain), formatNumber(force));
  };
  return fmt::format(
      "Its law is curves of tension through measured points, up to {} along the weft and {} along the warp; beyond "
      "these tension goes on with the slope of the last point. Weft and warp do not couple: pulled cloth keeps its "
      "width. "
      "Shear is linear, {} N/m, and so is bending, {} and {} N m along weft and warp, {} N m against twist. It is "
      "elastic.",
      last(0), last(1), formatNumber(law.shear_N_per_m), formatNumber(law.rigidity_Nm[0]),
      formatNumber(law.rigidity_Nm[1]), formatNumber(law.rigidity_Nm[2]));
}

}  // namespace gambeson::schema
