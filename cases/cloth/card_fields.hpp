#pragma once
/// Rows that tables of cards share.

#include <fmt/format.h>

#include <functional>
#include <optional>
#include <string>

#include "cases/cloth/card.hpp"
#include "cases/input/table.hpp"

namespace gambeson::schema {

/// A number that says its unit, as laboratories have several: a bare 0.172 would be taken for SI and is refused.
template <class T, class Get>
void labNumber(Table<T>& table, const std::string& key, Get get, const std::string& unit, const std::string& example,
               const Range& range, const std::string& doc, const std::string& note) {
  Field f = fieldOf(key, Kind::number, unit, range,
                    unit.empty() ? doc : fmt::format("{}; with its unit, such as \"{}\"", doc, example));
  f.default_note = note;
  table.custom(
      f,
      [=](const Entry& p, T& t) {
        if (p.node.type == JsonNode::Type::number && !unit.empty())
          p.fail(fmt::format("{} has no unit; write for example \"{}\"; allowed: {}", p.node.number, example,
                             range.text(unit)));
        std::invoke(get, t) = readNumber(p, unit, range);
      },
      [=](const T& t) -> std::optional<JsonNode> {
        const std::optional<double> x = std::invoke(get, t);
        return x ? std::optional(nodeOf(fmt::format("{} {}", *x, unit))) : std::nullopt;
      });
}

/// NAME, NAME_weft and NAME_warp.
template <class T>
void byDirection(Table<T>& table, const std::string& name, CardNumber T::*what, const std::string& unit,
                 const std::string& example, const Range& range, const std::string& doc, const std::string& note) {
  const auto of = [=](std::optional<double> CardNumber::*which) {
    return [=](auto& t) -> auto& { return (t.*what).*which; };
  };
  labNumber(table, name, of(&CardNumber::both), unit, example, range, doc, note);
  labNumber(table, name + "_weft", of(&CardNumber::weft), unit, example, range, "the same along the weft", name);
  labNumber(table, name + "_warp", of(&CardNumber::warp), unit, example, range, "the same along the warp", name);
}

inline void checkDirections(const Entry& p, const std::string& key, const CardNumber& n) {
  if (n.both && (n.weft || n.warp))
    p.failAt(key, fmt::format("excludes {}_weft and {}_warp; give their mean, or these two", key, key));
  if (!n.both && n.any() && !n.apart())
    p.failAt(key + (n.weft ? "_warp" : "_weft"),
             fmt::format("is required beside {}_{}", key, n.weft ? "weft" : "warp"));
}

Object fastTable();
/// What the sheet says goes into the card's tension, shear and bending. `card` is the whole card's entry, for messages.
void takeFast(const Entry& card, FabricCard& c);

}  // namespace gambeson::schema
