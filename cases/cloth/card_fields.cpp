/// Detail of card.hpp: the table of a card's keys, and the reading.

#include <fmt/format.h>

#include "cases/cloth/card.hpp"
#include "cases/cloth/card_fields.hpp"
#include "cases/cloth/card_library.hpp"
#include "cases/cloth/card_terms.hpp"
#include "cases/cloth/curve_input.hpp"
#include "cases/input/table.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace schema {
namespace {

constexpr double kAgree = 0.03;  ///< part by which two ways of saying the same may differ: sheets are rounded

void addCurve(Table<CardTensile>& table, const std::string& key, std::vector<TensilePoint> CardCurves::*points,
              const std::string& doc, const std::string& note) {
  table.custom(
      fieldOf(key, Kind::lists, "", any(), doc),
      [=](const Entry& p, CardTensile& t) { t.curves.*points = readTensilePoints(p, true); },
      [=](const CardTensile& t) -> std::optional<JsonNode> {
        if ((t.curves.*points).empty()) return std::nullopt;
        JsonNode rows = emptyList();
        for (const auto& [strain, force] : t.curves.*points) {
          JsonNode row = emptyList();
          row.children.push_back(nodeOf(strain));
          row.children.push_back(nodeOf(fmt::format("{} N/m", force)));
          rows.children.push_back(std::move(row));
        }
        return rows;
      });
  table.defaultsTo(note);
}

/// LT follows from WT, or agrees with it.
void takeWork(const Entry& p, CardTensile& t) {
  if (!t.work_J_per_m2.any()) return;
  if (!t.extension.any()) p.failAt(t.work_J_per_m2.both ? "WT" : "WT_weft", "needs EMT beside it");
  const bool apart = t.work_J_per_m2.apart() || t.extension.apart();
  CardNumber found;
  for (int i = 0; i < 2; ++i) {
    const double lt = lab::linearity(t.work_J_per_m2.of(i), t.extension.of(i), t.load_N_per_m);
    const std::string key = t.work_J_per_m2.both ? "WT" : i == 0 ? "WT_weft" : "WT_warp";
    if (t.linearity.any() && !(std::abs(lt / t.linearity.of(i) - 1) <= kAgree))
      p.failAt(key, fmt::format("contradicts LT {:.4g}: with EMT {:.4g} % at {:.4g} N/m it means LT {:.4g} "
                                "(WT = LT EMT F/2); leave out what is wrong",
                                t.linearity.of(i), 100 * t.extension.of(i), t.load_N_per_m, lt));
    if (!(lt > 0.1 && lt <= 1.9))
      p.failAt(key,
               fmt::format("means LT {:.4g} with EMT {:.4g} % at {:.4g} N/m, which is out of range; allowed: > 0.1 "
                           "and <= 1.9",
                           lt, 100 * t.extension.of(i), t.load_N_per_m));
    (!apart ? found.both : i == 0 ? found.weft : found.warp) = lt;
  }
  if (!t.linearity.any()) t.linearity = found;
}

void checkTensileLaw(const Entry& p, const CardTensile& t) {
  if (t.law == TensileLaw::secant) return;
  if (t.modulus_N_per_m.any()) p.failAt("law", "curve needs points, or EMT with LT or WT, in place of modulus");
  if (t.extension.any() && !t.linearity.any()) p.failAt("law", "curve needs LT or WT beside EMT");
  if (t.secant_at_N_per_m) p.failAt("secant_at", "is for the law secant");
  if (t.poisson.value_or(0) > 0) p.failAt("poisson", "is for the law secant: curves of weft and warp do not couple");
  for (int i = 0; i < 2 && t.linearity.any(); ++i)
    if (!(t.linearity.of(i) <= 1.5))
      p.failAt("law", fmt::format("curve does not reach LT {:.4g}; allowed: at most 1.5", t.linearity.of(i)));
}

Object tensileTable() {
  using T = CardTensile;
  Table<T> table("Tension of a card");
  byDirection(table, "EMT", &T::extension, "", "5.5 %", between(1e-5, 0.5),
              "extension at the largest load of KES-FB1, a part or in %", "required, or modulus");
  byDirection(table, "LT", &T::linearity, "", "", {.low = 0.1, .high = 1.9, .low_open = true},
              "linearity, the work over that of a straight line; needed for secant_at alone", "none");
  byDirection(table, "WT", &T::work_J_per_m2, "N/m", "9.4 gf cm/cm^2", between(1e-6, 1e5),
              "work up to there per area, in place of LT: WT = LT EMT F/2", "none");
  addCurve(
      table, "curve", &CardCurves::both,
      "in place of EMT, the test's points: a list of pairs [strain, force per width], as [[\"1 %\", \"20 gf/cm\"], "
      "...], ascending from above 0",
      "none");
  addCurve(table, "curve_weft", &CardCurves::weft, "the same along the weft", "curve");
  addCurve(table, "curve_warp", &CardCurves::warp, "the same along the warp", "curve");
  table.choice(
      "law", &T::law,
      std::vector<std::pair<std::string, TensileLaw>>{{"secant", TensileLaw::secant}, {"curve", TensileLaw::curve}},
      "secant: the fabric is linear, by the secant at the last point or at secant_at. curve: it follows the "
      "points, or a curve that stiffens in proportion to its tension (Fung 1967) and has this EMT and this LT "
      "or WT; with linear shear and bending, without hysteresis, with nurbs cloth, on the CPU");
  byDirection(table, "modulus", &T::modulus_N_per_m, "N/m", "8900 N/m", between(1e-2, 1e8),
              "in place of EMT, force per width over strain of a strip that keeps its width", "none");
  labNumber(table, "load", &T::load_N_per_m, "N/m", "500 gf/cm", between(1e-2, 1e5),
            "largest load, at which EMT was read", "500 gf/cm");
  labNumber(table, "secant_at", &T::secant_at_N_per_m, "N/m", "50 gf/cm", between(1e-2, 1e5),
            "load whose secant modulus the fabric gets, from EMT and LT or from points: cloth is softer at small loads",
            "the largest load");
  labNumber(table, "poisson", &T::poisson, "", "", {.low = 0, .high = 1, .high_open = true},
            "contraction along the warp under weft tension, as poisson of a fabric", "0, said as an assumption");
  table.check([](const Entry& p, T& t) {
    checkDirections(p, "EMT", t.extension);
    checkDirections(p, "LT", t.linearity);
    checkDirections(p, "WT", t.work_J_per_m2);
    checkDirections(p, "modulus", t.modulus_N_per_m);
    const CardCurves& c = t.curves;
    if (!c.both.empty() && (!c.weft.empty() || !c.warp.empty()))
      p.failAt("curve", "excludes curve_weft and curve_warp");
    if (c.both.empty() && c.any() && !c.apart())
      p.failAt(c.weft.empty() ? "curve_weft" : "curve_warp", "is required beside the other");
    const char* const which = t.extension.any() ? "EMT" : c.any() ? "curve" : "modulus";
    if (const int given = t.extension.any() + c.any() + t.modulus_N_per_m.any(); given != 1)
      p.failAt(
          given == 0                ? "EMT"
          : t.modulus_N_per_m.any() ? "modulus"
                                    : "curve",
          given == 0 ? "is required, or modulus, or curve" : fmt::format("excludes \"{}\"; give one of them", which));
    takeWork(p, t);
    if (t.secant_at_N_per_m && !(t.linearity.any() && t.extension.any()) && !c.any())
      p.failAt("secant_at", "needs EMT and LT, by which the curve of tension bends, or points");
    if (t.secant_at_N_per_m && !(*t.secant_at_N_per_m <= t.load_N_per_m) && !c.any())
      p.failAt("secant_at", fmt::format("{} N/m is out of range; allowed: at most load = {} N/m", *t.secant_at_N_per_m,
                                        t.load_N_per_m));
    for (int i = 0; i < 2 && t.secant_at_N_per_m && c.any(); ++i)
      if (!(*t.secant_at_N_per_m <= c.of(i).back()[1]))
        p.failAt("secant_at", fmt::format("{} N/m is out of range; allowed: at most the last point's, {} N/m",
                                          *t.secant_at_N_per_m, c.of(i).back()[1]));
    checkTensileLaw(p, t);
    if (c.any()) return;
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
              "slope of the moment per width between 0.5 and 1.5/cm, mean of both sides, KES-FB2", "required, or c");
  byDirection(
      table, "c", &B::length_m, "m", "2.1 cm", between(1e-4, 1),
      "in place of B, the bending length of ASTM D1388 (half the overhang): B = W g c^3, with the card's weight",
      "none");
  byDirection(table, "2HB", &B::hysteresis, "N", "0.139 gf cm/cm", aboveTo(0, 100),
              "width of the loop of moment per width over curvature", "none: bending without friction");
  labNumber(table, "2HB_at", &B::hysteresis_at_per_m, "1/m", "1 1/cm",
            {.low = 0, .high = kKesCurvature_per_m, .low_open = true, .high_open = true},
            "curvature at which 2HB was read (most laboratories: 1/cm, some 0.5 or 1.5/cm)",
            "1/cm, said as an assumption");
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
    checkDirections(p, "c", b.length_m);
    if (b.rigidity.any() == b.length_m.any())
      p.failAt(b.rigidity.any() ? "c" : "B", b.rigidity.any()
                                                 ? "excludes \"B\": both are the rigidity; give one of them"
                                                 : "is required, or B_weft and B_warp: the bending rigidity; or c");
    if (b.length_m.any() && b.hysteresis.any()) p.failAt("c", "knows no hysteresis; give B, of the same test as 2HB");
    const bool width = b.hysteresis.any();
    for (const auto& [key, given] :
         {std::pair("2HB_at", b.hysteresis_at_per_m.has_value()), std::pair("K0", b.friction_per_m.has_value()),
          std::pair("stops", !b.stops.empty())})
      if (given && !width) p.failAt(key, "has no meaning without 2HB; remove it");
    if (!width) return;
    const double span = b.friction_per_m.value_or(kCardFriction_per_m),
                 read_at = b.hysteresis_at_per_m.value_or(kKesWidthAt_per_m);
    for (int i = 0; i < 2; ++i) {
      const KesBending read{b.rigidity.of(i), b.hysteresis.of(i)};
      const std::string key = b.hysteresis.both ? "2HB" : i == 0 ? "2HB_weft" : "2HB_warp";
      const KesBending unit = readKes(Stops<kStops>{shapeOf(b), 1, 0, span}, read_at);
      if (!(unit.hysteresis_N > 0))
        p.failAt(key, fmt::format("cannot be read at {} 1/m: friction that is overcome at K0 = {} 1/m has no width "
                                  "there",
                                  read_at, span));
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

Object drapeTable() {
  using D = CardDrape;
  Table<D> table("Drape of a card");
  labNumber(table, "coefficient", &D::coefficient, "", "", between(0, 1),
            "drape coefficient, the share of the free ring that its shadow covers: a part, or \"55 %\"", "required");
  labNumber(table, "specimen", &D::specimen_m, "m", "30 cm", between(0.2, 0.5),
            "diameter of the specimen: 24, 30 or 36 cm (BS 5058), 25.4 cm (JIS L 1096)", "30 cm");
  labNumber(table, "support", &D::support_m, "m", "18 cm", between(0.05, 0.4),
            "diameter of the discs that hold it: 18 cm (BS 5058), 12.7 cm (JIS L 1096)", "18 cm");
  labNumber(table, "nodes", &D::nodes, "", "", between(0, 100), "how many folds it has, the mean of specimens",
            "not said");
  table.text("source", &D::source, "where this is from, if not with the card's other numbers").defaultsTo("the card's");
  table.check([](const Entry& p, const D& d) {
    if (!(d.support_m < d.specimen_m))
      p.failAt("support",
               fmt::format("{} m is out of range; allowed: less than the specimen's {} m", d.support_m, d.specimen_m));
    if (!p.node.find("coefficient")) p.failAt("coefficient", "is required: the drape coefficient, \"55 %\" say");
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
  table.text("spread", &C::spread, "how far specimens, or laboratories, differ")
      .object("spread_of", &C::spread_of, spreadTable(),
              "the same in numbers: from them a study's uncertainty takes its samples of the fabric")
      .defaultsTo("not known")
      .text("range", &C::range, "of what the numbers are fitted to, where it is not the instruments' own");
  labNumber(table, "thickness", &C::thickness_m, "m", "0.8 mm", between(1e-6, 0.05), "thickness",
            "T0, or the weight over 400 kg/m^3, said as an assumption: forces and moments per width need none");
  labNumber(table, "T0", &C::T0_m, "m", "1.07 mm", between(1e-6, 0.05), "thickness under 0.5 gf/cm^2, KES-FB3", "none");
  labNumber(table, "Tm", &C::Tm_m, "m", "0.8 mm", between(1e-6, 0.05), "thickness under 50 gf/cm^2; for the record",
            "none");
  labNumber(table, "thickness_pressure", &C::thickness_pressure_Pa, "Pa", "0.5 gf/cm^2", aboveTo(0, 1e6),
            "pressure of that test; for the record", "not said");
  for (const char* key : {"weight", "W"})
    labNumber(table, key, &C::weight_kg_per_m2, "kg/m^2", *key == 'W' ? "32 mg/cm^2" : "320 g/m^2", between(1e-4, 10),
              *key == 'W' ? "weight, by the name that KES has for it" : "mass per area",
              *key == 'W' ? "weight" : "400 kg/m^3 times the thickness, said as an assumption");
  byDirection(
      table, "elongation", &C::elongation, "", "12 %", between(1e-4, 3.5),
      "engineering strain that the fabric may reach, where it tears or stays stretched: a run beyond it fails a "
      "check that names the card",
      "none");
  byDirection(table, "strength", &C::strength_N_per_m, "N/m", "16000 N/m", between(1e-2, 1e8),
              "force per width that it may reach: the limit is the strain that the fabric's law has there", "none");
  table.object("tensile", &C::tensile, tensileTable(), "tension along weft and warp")
      .defaultsTo("EMT 5 %, said as an assumption")
      .object("shear", &C::shear, shearTable(), "shear in the plane")
      .defaultsTo("G 1 gf/(cm deg), said as an assumption")
      .object("FAST", &C::fast, fastTable(), "a sheet of FAST, in place of tensile, shear and bending")
      .defaultsTo("none")
      .object("bending", &C::bending, bendingTable(), "bending along weft and warp")
      .defaultsTo("required, or C or B of FAST")
      .object("drape", &C::drape, drapeTable(), "Cusick's drape test: the laboratory is compared with it")
      .defaultsTo("none");
  labNumber(table, "MIU", &C::friction, "", "", aboveTo(0, 2),
            "coefficient of friction, KES-FB4; a case says its friction itself (contact.friction)", "not said");
  table.check([](const Entry& p, C& c) {
    if (p.node.find("weight") && p.node.find("W")) p.failAt("W", "excludes \"weight\"; give one of them");
    checkDirections(p, "elongation", c.elongation);
    checkDirections(p, "strength", c.strength_N_per_m);
    if (c.T0_m && c.Tm_m && !(*c.Tm_m <= *c.T0_m))
      p.failAt("Tm",
               fmt::format("contradicts T0: {} m under 50 gf/cm^2 is more than {} m under 0.5", *c.Tm_m, *c.T0_m));
    if (c.fast) takeFast(p, c);
    if (!c.bending.rigidity.any() && !c.bending.length_m.any())
      p.failAt("bending", "is required: bending along weft and warp; or C or B of FAST");
    if (c.bending.length_m.any() && !c.bending.rigidity.any()) {
      if (!c.weight_kg_per_m2) p.failAt("weight", "is required where bending has c: B = W g c^3");
      for (const auto which : {&CardNumber::both, &CardNumber::weft, &CardNumber::warp})
        if (const auto& length = c.bending.length_m.*which)
          c.bending.rigidity.*which = lab::rigidityOfLength(*length, *c.weight_kg_per_m2);
    }
    if (c.thickness_m > 0) return;
    if (!c.T0_m && !c.weight_kg_per_m2)
      p.failAt("thickness", "is required, or weight: \"0.8 mm\" say; allowed: >= 1e-06 and <= 0.05 m");
    c.thickness_assumed = !c.T0_m;
    c.thickness_m = c.T0_m ? *c.T0_m : *c.weight_kg_per_m2 / kCardDensity_kg_per_m3;
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
  const std::string name = file.string();
  const JsonNode root = isLibraryName(name) ? parseJson(libraryCard(name), name + " (library)") : readJson(file);
  FabricCard card;
  schema::readObject(schema::cardTable(), {root, "", name}, &card);
  return card;
}

}  // namespace gambeson
