/// Detail of fit_card.hpp: the file of measurements.

#include <fmt/format.h>

#include "cases/cloth/curve_input.hpp"
#include "cases/fabric/fit_card.hpp"
#include "cases/input/table.hpp"

namespace gambeson {
namespace schema {
namespace {

using Pairs = std::vector<std::array<double, 2>>;

double withUnit(const Entry& entry, const std::string& unit, const Range& range) {
  if (entry.node.type == JsonNode::Type::number && !unit.empty())
    entry.fail(fmt::format("{} has no unit; allowed: a text with one, such as \"{} {}\"", entry.node.number,
                           entry.node.number, unit));
  return readNumber(entry, unit, range);
}

Pairs readPairs(const Entry& entry, const std::string& x_unit, double x_most, const std::string& y_unit,
                double y_most) {
  constexpr std::size_t kMost = 100'000;
  if (entry.node.type != JsonNode::Type::list || entry.node.children.size() > kMost)
    entry.fail(fmt::format("expected a list of at most {} pairs, not {}", kMost, describe(entry.node)));
  Pairs out;
  for (std::size_t i = 0; i < entry.node.children.size(); ++i) {
    const Entry pair = entry.item(i);
    if (pair.node.type != JsonNode::Type::list || pair.node.children.size() != 2)
      pair.fail("expected a pair of numbers with their units, not " + describe(pair.node));
    out.push_back({withUnit(pair.item(0), x_unit, between(-x_most, x_most)),
                   withUnit(pair.item(1), y_unit, between(-y_most, y_most))});
  }
  return out;
}

template <class Read>
void add(Table<Measurements>& table, const std::string& key, Kind kind, Read read, const std::string& doc) {
  table.custom(fieldOf(key, kind, "", any(), doc), read,
               [](const Measurements&) -> std::optional<JsonNode> { return std::nullopt; });
  table.defaultsTo("not measured");
}

Object makeTable() {
  using M = Measurements;
  Table<M> table("Measurements of a fabric",
                 "points that a laboratory measured: `gambeson fabric CARD --fit MEASUREMENTS.json` finds the card's "
                 "numbers from them. Numbers are texts with their units");
  table.text("source", &M::source, "laboratory, date").required();
  for (int i = 0; i < 2; ++i) {
    const std::string thread = i == 0 ? "weft" : "warp";
    add(
        table, "tension_" + thread, Kind::lists,
        [i](const Entry& p, M& m) {
          for (const auto& [e, F] : readPairs(p, "", 5, "N/m", 1e7)) {
            if (!(e > 0)) p.fail(fmt::format("has a strain of {:g}; allowed: > 0", e));
            m.tension[i].push_back({e, F});
          }
        },
        "pairs [strain, force per width] along the " + thread + ", of one specimen or of several");
    add(
        table, "bending_" + thread, Kind::lists,
        [i](const Entry& p, M& m) { m.bending[i] = readPairs(p, "1/m", 1e4, "N", 1e3); },
        "pairs [curvature, moment per width] along the " + thread + ", in the order of the loop");
    add(
        table, "overhang_" + thread, Kind::numbers,
        [i](const Entry& p, M& m) {
          if (p.node.type != JsonNode::Type::list) p.fail("expected a list of lengths, not " + describe(p.node));
          for (std::size_t k = 0; k < p.node.children.size(); ++k)
            m.overhang[i].push_back(withUnit(p.item(k), "m", {.low = 0, .high = 2, .low_open = true}));
        },
        "overhangs at 41.5 degrees along the " + thread + " (ASTM D1388), one for each specimen");
  }
  add(
      table, "shear", Kind::lists, [](const Entry& p, M& m) { m.shear = readPairs(p, "rad", 0.8, "N/m", 1e6); },
      "pairs [angle, force per width], in the order of the loop");
  return table.build();
}

}  // namespace

const Object& measurementsTable() {
  static const Object table = makeTable();
  return table;
}

}  // namespace schema

Measurements readMeasurements(const std::filesystem::path& file) {
  const JsonNode root = readJson(file);
  const std::string name = file.string();
  Measurements m;
  schema::readObject(schema::measurementsTable(), {root, "", name}, &m);
  return m;
}

}  // namespace gambeson
