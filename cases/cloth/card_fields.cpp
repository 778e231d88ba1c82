/// Detail of card.hpp: the table of a card's keys, and the reading.

#include <fmt/format.h>

#include "cases/cloth/card.hpp"
#include "cases/input/table.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace schema {
namespace {

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

void checkDirections(const Entry& p, const std::string& key, const CardNumber& n) {
  if (n.both && (n.weft || n.warp))
    p.failAt(key, fmt::format("excludes {}_weft and {}_warp; give their mean, or these two", key, key));
  if (!n.both && n.any() && !n.apart())
    p.failAt(key + (n.weft ? "_warp" : "_weft"),
             fmt::format("is required beside {}_{}", key, n.weft ? "weft" : "warp"));
}

Object tensileTable() {
  using T = CardTensile;
  Table<T> table("Tension of a card");
  byDirection(table, "EMT", &T::extension, "", "5.5 %", between(1e-5, 0.5),
              "extension at the largest load of KES-FB1, a part or in %", "required, or modulus");
  byDirection(table, "LT", &T::linearity, "", "", {.low = 0.1, .high = 1.9, .low_open = true},
              "linearity, the work over that of a straight line; needed for secant_at alone", "none");
  byDirection(table, "modulus", &T::modulus_N_per_m, "N/m", "8900 N/m", between(1e-2, 1e8),
              "in place of EMT, force per width over strain of a strip that keeps its width", "none");
  labNumber(table, "load", &T::load_N_per_m, "N/m", "500 gf/cm", between(1e-2, 1e5),
            "largest load, at which EMT was read", "500 gf/cm");
  labNumber(table, "secant_at", &T::secant_at_N_per_m, "N/m", "50 gf/cm", between(1e-2, 1e5),
            "load whose secant modulus the fabric gets, from EMT and LT: cloth is softer at small loads",
            "the largest load");
  labNumber(table, "poisson", &T::poisson, "", "", {.low = 0, .high = 1, .high_open = true},
            "contraction along the warp under weft tension, as poisson of a fabric", "0, said as an assumption");
  table.check([](const Entry& p, const T& t) {
    checkDirections(p, "EMT", t.extension);
    checkDirections(p, "LT", t.linearity);
    checkDirections(p, "modulus", t.modulus_N_per_m);
    if (t.extension.any() == t.modulus_N_per_m.any())
      p.failAt(t.extension.any() ? "modulus" : "EMT",
               t.extension.any() ? "excludes \"EMT\"; give one of them" : "is required, or modulus");
    if (t.secant_at_N_per_m && !(t.linearity.any() && t.extension.any()))
      p.failAt("secant_at", "needs EMT and LT, by which the curve of tension bends");
    if (t.secant_at_N_per_m && !(*t.secant_at_N_per_m <= t.load_N_per_m))
      p.failAt("secant_at", fmt::format("{} N/m is out of range; allowed: at most load = {} N/m", *t.secant_at_N_per_m,
                                        t.load_N_per_m));
    const CardNumber& n = t.extension.any() ? t.extension : t.modulus_N_per_m;
    const double ratio = n.of(0) > 0 ? n.of(1) / n.of(0) : 1, limit = std::sqrt(std::min(ratio, 1 / ratio));
    if (t.poisson && !(*t.poisson < limit))
      p.failAt("poisson", fmt::format("{} is out of range; allowed: below sqrt of the ratio of weft and warp, {:.4g}",
                                      *t.poisson, limit));
  });
  return table.build();
}

Object shearTable() {
  using S = CardShear;
  Table<S> table("Shear of a card");
  byDirection(table, "G", &S::rigidity, "N/(m rad)", "1.5 gf/(cm deg)", between(1e-3, 1e6),
              "slope of the shear force between 0.5 and 2.5 degrees, KES-FB1", "required");
  byDirection(table, "2HG", &S::hysteresis, "N/m", "3.5 gf/cm", aboveTo(0, 1e4),
              "width of the loop at 0.5 degrees of one to 8 degrees", "none: shear without friction");
  byDirection(table, "2HG5", &S::hysteresis_5, "N/m", "5.9 gf/cm", aboveTo(0, 1e4),
              "width of the same loop at 5 degrees", "that of 2HG's friction");
  labNumber(table, "friction_angle", &S::friction_rad, "rad", "1 deg", {.low = 0, .high = 0.14, .low_open = true},
            "where all friction is overcome on first shear", "1 degree, said as an assumption");
  table.check([](const Entry& p, const S& s) {
    checkDirections(p, "G", s.rigidity);
    checkDirections(p, "2HG", s.hysteresis);
    checkDirections(p, "2HG5", s.hysteresis_5);
    if (!s.rigidity.any()) p.failAt("G", "is required, or G_weft and G_warp: the shear rigidity");
    if (s.hysteresis_5.any() && !s.hysteresis.any()) p.failAt("2HG5", "needs 2HG beside it");
    if (s.friction_rad && !s.hysteresis.any()) p.failAt("friction_angle", "has no meaning without 2HG; remove it");
    if (s.hysteresis.any()) try {
        sheetOf(s);
      } catch (const InputError& e) {
        p.failAt(e.reason().starts_with("2HG5") ? s.hysteresis_5.both ? "2HG5" : "2HG5_weft" : "2HG", e.reason());
      }
  });
  return table.build();
}

Object bendingTable() {
  using B = CardBending;
  Table<B> table("Bending of a card");
  byDirection(table, "B", &B::rigidity, "N m", "0.172 gf cm^2/cm", aboveTo(0, 1),
              "slope of the moment per width between 0.5 and 1.5/cm, mean of both sides, KES-FB2", "required");
  byDirection(table, "2HB", &B::hysteresis, "N", "0.139 gf cm/cm", aboveTo(0, 100),
              "width of the loop of moment per width over curvature", "none: bending without friction");
  labNumber(table, "2HB_at", &B::hysteresis_at_per_m, "1/m", "1 1/cm",
            {.low = 0, .high = kKesCurvature_per_m, .low_open = true, .high_open = true},
            "curvature at which 2HB was read (most laboratories: 1/cm, some 0.5 or 1.5/cm)", "required with 2HB");
  labNumber(table, "K0", &B::friction_per_m, "1/m", "0.6 1/cm", aboveTo(0, kKesCurvature_per_m),
            "curvature where all friction is overcome on first bending", "0.5/cm, said as an assumption");
  Field stops = fieldOf("stops", Kind::lists, "", between(0, 1),
                        "the friction in at most 8 stops: pairs [part of the rise of the slope, curvature at which it "
                        "slips as a part of K0]");
  stops.default_note = "those of the quadratic curve of Wong 2014, eq. 4.2";
  table.custom(
      stops,
      [](const Entry& p, B& b) {
        if (p.node.type != JsonNode::Type::list || p.node.children.empty() || p.node.children.size() > kStops)
          p.fail(fmt::format("expected a list of 1 to {} pairs, not {}", kStops, describe(p.node)));
        double sum = 0;
        for (std::size_t i = 0; i < p.node.children.size(); ++i) {
          const Vec2 pair = readPair(p.item(i), "", between(0, 1));
          if (!(pair.y > 0)) p.item(i).fail(fmt::format("{} is out of range; allowed: > 0 and <= 1", pair.y));
          b.stops.push_back({pair.x, pair.y});
          sum += pair.x;
        }
        if (!(std::abs(sum - 1) < 1e-9)) p.fail(fmt::format("has parts whose sum is {}; allowed: 1", sum));
      },
      [](const B& b) -> std::optional<JsonNode> {
        if (b.stops.empty()) return std::nullopt;
        JsonNode rows = emptyList();
        for (const auto& [part, reach] : b.stops) rows.children.push_back(nodeOfList({part, reach}));
        return rows;
      });
  table.check([](const Entry& p, const B& b) {
    checkDirections(p, "B", b.rigidity);
    checkDirections(p, "2HB", b.hysteresis);
    if (!b.rigidity.any()) p.failAt("B", "is required, or B_weft and B_warp: the bending rigidity");
    const bool width = b.hysteresis.any();
    if (width && !b.hysteresis_at_per_m)
      p.failAt("2HB_at", fmt::format("is required with 2HB: the curvature at which it was read, \"1 1/cm\" say; "
                                     "allowed: > 0 and < {} 1/m",
                                     kKesCurvature_per_m));
    for (const auto& [key, given] :
         {std::pair("2HB_at", b.hysteresis_at_per_m.has_value()), std::pair("K0", b.friction_per_m.has_value()),
          std::pair("stops", !b.stops.empty())})
      if (given && !width) p.failAt(key, "has no meaning without 2HB; remove it");
    if (!width) return;
    const double span = b.friction_per_m.value_or(kCardFriction_per_m);
    for (int i = 0; i < 2; ++i) {
      const KesBending read{b.rigidity.of(i), b.hysteresis.of(i)};
      const std::string key = b.hysteresis.both ? "2HB" : i == 0 ? "2HB_weft" : "2HB_warp";
      const KesBending unit = readKes(Stops<kStops>{shapeOf(b), 1, 0, span}, *b.hysteresis_at_per_m);
      if (!(unit.hysteresis_N > 0))
        p.failAt(key, fmt::format("cannot be read at {} 1/m: friction that is overcome at K0 = {} 1/m has no width "
                                  "there",
                                  *b.hysteresis_at_per_m, span));
      // B is b2 and what friction adds between 0.5 and 1.5/cm.
      if (const double most = read.rigidity_Nm * unit.hysteresis_N / unit.rigidity_Nm;
          unit.rigidity_Nm > 0 && !(read.hysteresis_N <= most))
        p.failAt(key, fmt::format("{} N is out of range; allowed: at most {:.4g} N with this B and K0 = {} 1/m, or no "
                                  "rigidity is left beyond the friction",
                                  read.hysteresis_N, most, span));
    }
  });
  return table.build();
}

Object makeCardTable() {
  using C = FabricCard;
  Table<C> table("Fabric card",
                 "what laboratories measured of a fabric, in their terms: `gambeson fabric CARD`, or the key card of a "
                 "fabric. Numbers are texts with their units");
  table.text("name", &C::name, "of the fabric")
      .required()
      .text("source", &C::source, "laboratory, date, publication: where the numbers are from")
      .required()
      .text("description", &C::description, "what the fabric is: fibre, weave, use");
  labNumber(table, "thickness", &C::thickness_m, "m", "0.8 mm", between(1e-6, 0.05), "thickness", "required");
  labNumber(table, "thickness_pressure", &C::thickness_pressure_Pa, "Pa", "0.5 gf/cm^2", aboveTo(0, 1e6),
            "pressure of that test; for the record", "not said");
  labNumber(table, "weight", &C::weight_kg_per_m2, "kg/m^2", "320 g/m^2", between(1e-4, 10), "mass per area",
            "400 kg/m^3 times the thickness, said as an assumption");
  table.object("tensile", &C::tensile, tensileTable(), "tension along weft and warp")
      .defaultsTo("EMT 5 %, said as an assumption")
      .object("shear", &C::shear, shearTable(), "shear in the plane")
      .defaultsTo("G 1 gf/(cm deg), said as an assumption")
      .object("bending", &C::bending, bendingTable(), "bending along weft and warp")
      .required();
  labNumber(table, "MIU", &C::friction, "", "", aboveTo(0, 2),
            "coefficient of friction, KES-FB4; a case says its friction itself (contact.friction)", "not said");
  table.check([](const Entry& p, const C& c) {
    if (!(c.thickness_m > 0)) p.failAt("thickness", "is required: \"0.8 mm\" say; allowed: >= 1e-06 and <= 0.05 m");
  });
  return table.build();
}

}  // namespace

const Object& cardTable() {
  static const Object table = makeCardTable();
  return table;
}

}  // namespace schema

FabricCard readCard(const std::filesystem::path& file) {
  const JsonNode root = readJson(file);
  const std::string name = file.string();
  FabricCard card;
  schema::readObject(schema::cardTable(), {root, "", name}, &card);
  return card;
}

}  // namespace gambeson
