#include "cases/cloth/fabric_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "analysis/ticks.hpp"
#include "cases/cloth/card.hpp"
#include "cases/cloth/card_library.hpp"
#include "cases/cloth/fields.hpp"
#include "cases/cloth/law_input.hpp"
#include "cases/input/table.hpp"
#include "core/material/kes_shear.hpp"
#include "core/material/linearised.hpp"

namespace gambeson::schema {
namespace {

/// How case files write a bending law of core/material/laws, and how reports say it. A new law has its row in `rows`
/// and its own keys in bendingTable.
struct LawRow {
  const char *name, *doc;
  std::vector<std::string> keys;  ///< beside those that all laws have
  /// `at` is the bending's entry in the file.
  BendingLaw (*resolve)(const Entry& at, const BendingInput& in, const GivenRigidities& given);
  /// Writes the law's own keys; false: another row's law.
  bool (*restore)(const BendingLaw& law, BendingInput& in);
  std::string (*say)(const BendingLaw& law);
};

BendingLaw resolveZheng(const Entry& at, const BendingInput& in, const GivenRigidities& given) {
  if (!in.kappa0_per_m) at.failAt("kappa0", "is required for the law zheng: the curvature where it turns linear");
  const ZhengBending law{given, *in.kappa0_per_m,
                         in.regular_curvature_per_m.value_or(BendingInput::default_regular_curvature_per_m)};
  if (!(law.kappa_regular_per_m <= law.kappa0_per_m))
    at.failAt("regular_curvature", fmt::format("{} 1/m is out of range; allowed: <= kappa0 = {} 1/m",
                                               law.kappa_regular_per_m, law.kappa0_per_m));
  return law;
}

bool restoreZheng(const BendingLaw& law, BendingInput& in) {
  const auto* zheng = std::get_if<ZhengBending>(&law);
  if (!zheng) return false;
  in.kappa0_per_m = zheng->kappa0_per_m;
  in.regular_curvature_per_m = zheng->kappa_regular_per_m;
  return true;
}

std::string sayZheng(const BendingLaw& law) {
  const auto& zheng = std::get<ZhengBending>(law);
  return fmt::format(
      "Bending follows Zheng 2013, eq. 2.14. Its root is replaced by a smooth cubic below a curvature of {} 1/m; the "
      "steepest slope is then {} N m (weft).",
      formatNumber(zheng.kappa_regular_per_m), formatNumber(steepestSlope(zheng, zheng.weft_Nm)));
}

BendingLaw resolveStop(const Entry& at, const BendingInput& in, const GivenRigidities& given) {
  if (!in.yield_N)
    at.failAt("yield_moment", "is required for the law stop: the moment per width that it never surpasses");
  return StopBending{given, *in.yield_N};
}

bool restoreStop(const BendingLaw& law, BendingInput& in) {
  const auto* stop = std::get_if<StopBending>(&law);
  if (stop) in.yield_N = stop->yield_N;
  return stop;
}

std::string sayStop(const BendingLaw& law) {
  const auto& stop = std::get<StopBending>(law);
  return fmt::format(
      "Bending is linear, {} N m (weft), up to a moment of {} N; what is bent farther keeps a part of its fold.",
      formatNumber(stop.weft_Nm), formatNumber(stop.yield_N));
}

BendingLaw resolveHysteresis(const Entry& at, const BendingInput& in, const GivenRigidities& given) {
  if (!in.loop) at.failAt("loop", "is required for the law hysteresis: the loop of moment over curvature");
  return resolveLoop(at, *in.loop, given);
}

bool restoreHysteresis(const BendingLaw& law, BendingInput& in) {
  std::optional<LoopInput> loop = restoreLoop(law);
  if (loop) in.loop = std::move(loop);
  return in.loop.has_value();
}

BendingLaw resolveLinear(const Entry&, const BendingInput&, const GivenRigidities& given) {
  return LinearBending{given};
}

bool restoreLinear(const BendingLaw& law, BendingInput&) { return std::holds_alternative<LinearBending>(law); }

std::string sayLinear(const BendingLaw& law) {
  return fmt::format("Bending is linear, {} N m (weft).", formatNumber(std::get<LinearBending>(law).weft_Nm));
}

const std::vector<LawRow>& rows() {
  static const std::vector<LawRow> all{
      {"zheng",
       "moment with an initial friction-like part, Zheng 2013, eq. 2.14",
       {"kappa0", "regular_curvature"},
       resolveZheng,
       restoreZheng,
       sayZheng},
      {"linear", "moment = rigidity x curvature", {}, resolveLinear, restoreLinear, sayLinear},
      {"stop",
       "linear up to a yield moment, which it never surpasses: what is bent farther keeps a part of its fold",
       {"yield_moment"},
       resolveStop,
       restoreStop,
       sayStop},
      {"hysteresis",
       "a measured loop with its inner loops, set and fatigue, Wong 2014, chapter 4: see loop",
       {"loop"},
       resolveHysteresis,
       restoreHysteresis,
       sayLoop}};
  return all;
}

/// The row of a law. Solids have none: they are laws of structures.
const LawRow& rowOf(const BendingLaw& law) {
  BendingInput unused;
  return *std::find_if(rows().begin(), rows().end(), [&](const LawRow& r) { return r.restore(law, unused); });
}

Object bendingTable() {
  using B = BendingInput;
  std::vector<std::pair<std::string, std::string>> names;
  std::string docs;
  for (const LawRow& r : rows()) {
    names.push_back({r.name, r.name});
    docs += fmt::format("{}{}: {}", docs.empty() ? "" : "; ", r.name, r.doc);
  }
  return Table<B>("Bending")
      .choice("law", &B::law, names, docs)
      .number("rigidity", &B::rigidity_Nm, "N m", between(0, 1e3),
              "B0 of eq. 2.14, or the linear rigidity, per width of cloth, the same along weft and warp")
      .defaultsTo("required, or rigidity_weft and rigidity_warp")
      .number("rigidity_weft", &B::rigidity_weft_Nm, "N m", between(0, 1e3), "the same, bending along the weft")
      .defaultsTo("rigidity")
      .number("rigidity_warp", &B::rigidity_warp_Nm, "N m", between(0, 1e3), "the same, bending along the warp")
      .defaultsTo("rigidity")
      .number("kappa0", &B::kappa0_per_m, "1/m", aboveTo(0, 1e5), "kappa_0 of eq. 2.14, where the law turns linear")
      .defaultsTo("required for the law zheng; for no other")
      .number("regular_curvature", &B::regular_curvature_per_m, "1/m", aboveTo(0, 1e4),
              "curvature below which the root of eq. 2.14, whose slope is infinite at 0, is smoothed")
      .defaultsTo(fmt::format("{} 1/m for the law zheng; for no other", B::default_regular_curvature_per_m))
      .number("yield_moment", &B::yield_N, "N", aboveTo(0, 1e3),
              "moment per width up to which the law stop is linear, along weft, along warp and of twist")
      .defaultsTo("required for the law stop; for no other")
      .object("loop", &B::loop, loopTable(), "the loop of moment over curvature of the law hysteresis")
      .defaultsTo("required for the law hysteresis; for no other")
      .number("twist", &B::twist_Nm, "N m", between(0, 1e3), "twist rigidity; the law of eq. 2.14 has none")
      .choice("rest", &B::rest,
              std::vector<std::pair<std::string, RestCurvature>>{{"zero", RestCurvature::zero},
                                                                 {"shape", RestCurvature::shape}},
              "curvature without moment: zero (flat cloth, sewn), or that of the garment's rest shape")
      .build();
}

Object shearLoopTable() {
  using L = ShearLoopInput;
  return Table<L>("Loop of shear")
      .number("hysteresis", &L::hysteresis_N_per_m, "N/m", aboveTo(0, 1e5),
              "2HG of KES-FB1, the width of the loop at 0.5 degrees; shear times thickness is then G of the same test")
      .defaultsTo("required, or rise")
      .number("hysteresis_5", &L::hysteresis_5_N_per_m, "N/m", aboveTo(0, 1e5),
              "2HG5, the width at 5 degrees: more than 2HG where threads press on each other the more they are turned")
      .defaultsTo("that of 2HG's friction")
      .number("friction_angle", &L::friction_angle_rad, "rad", {.low = 0, .high = 0.14, .low_open = true},
              "shear strain, as an angle, where all friction is overcome on first shear")
      .number("rise", &L::rise_N_per_m, "N/m", between(0, 1e8),
              "in place of hysteresis: slope of the friction in cloth that was never sheared, beside shear")
      .defaultsTo("none")
      .number("growth", &L::growth_N_per_m, "N/m", between(0, 1e8),
              "with rise: the same of the friction that grows with the shear, at 5 degrees")
      .build();
}

}  // namespace

Object fabricTable() {
  using F = FabricInput;
  const Field card = fieldOf("card", Kind::path, "", any(),
                             "file of a fabric card, or the name of one of the library (denim_a), from which all "
                             "follows that is not given here (see Fabric cards, and gambeson fabric --help)");
  Object table =
      Table<F>("Fabric")
          .custom(
              card,
              [](const Entry& p, F& f) {
                if (p.node.type != JsonNode::Type::text || !isLibraryName(p.node.text)) {
                  f.card = readPath(p);
                  return;
                }
                f.card = p.node.text;
                try {
                  libraryCard(p.node.text);
                } catch (const InputError& e) {
                  p.fail(e.reason());
                }
              },
              [](const F& f) { return f.card.empty() ? std::nullopt : std::optional(nodeOf(f.card.string())); })
          .text("name", &F::name, "what the reports call it")
          .number("thickness", &F::thickness_m, "m", aboveTo(0, 0.05), "thickness")
          .defaultsTo(
              "required, or card; beside surface_density and stiffness, surface_density over 400 kg/m^3: no force "
              "per width depends on it")
          .flag("thickness_assumed", &F::thickness_assumed,
                "nobody measured the thickness: finished runs say so of what was taken from the weight, and the "
                "reports note it")
          .unwritten()
          .number("density", &F::density_kg_per_m3, "kg/m^3", aboveTo(0, 3e4), "mass per volume")
          .in("density")
          .defaultsTo("required, or surface_density, or card")
          .number("surface_density", &F::surface_density_kg_per_m2, "kg/m^2", aboveTo(0, 100),
                  "mass per area (also in gsm)")
          .in("density")
          .defaultsTo("required, or density, or card")
          .oneOf("density", false)
          .number("young", &F::young_Pa, "Pa", aboveTo(0, 1e12), "Young's modulus of isotropic cloth")
          .defaultsTo("required, or young_weft, young_warp and shear, or card")
          .number("young_weft", &F::young_weft_Pa, "Pa", aboveTo(0, 1e12), "Young's modulus along the weft")
          .defaultsTo("young")
          .number("young_warp", &F::young_warp_Pa, "Pa", aboveTo(0, 1e12), "Young's modulus along the warp")
          .defaultsTo("young")
          .number("shear", &F::shear_Pa, "Pa", aboveTo(0, 1e12), "in-plane shear modulus")
          .defaultsTo("young / (2 (1 + poisson)); required where young is not given")
          .number("stiffness", &F::stiffness_N_per_m, "N/m", aboveTo(0, 1e10),
                  "in place of young, Young's modulus times thickness, as sheets of laboratories have it: force per "
                  "width over strain of a strip, the same along weft and warp")
          .defaultsTo("none")
          .number("stiffness_weft", &F::stiffness_weft_N_per_m, "N/m", aboveTo(0, 1e10),
                  "in place of young_weft, the same along the weft")
          .defaultsTo("stiffness")
          .number("stiffness_warp", &F::stiffness_warp_N_per_m, "N/m", aboveTo(0, 1e10),
                  "in place of young_warp, the same along the warp")
          .defaultsTo("stiffness")
          .number("shear_stiffness", &F::shear_stiffness_N_per_m, "N/(m rad)", aboveTo(0, 1e10),
                  "in place of shear, shear modulus times thickness: G of KES-FB1, per radian")
          .defaultsTo("stiffness / (2 (1 + poisson)); required where stiffness is not given")
          .object("shear_loop", &F::shear_loop, shearLoopTable(),
                  "friction between threads that turn against each other")
          .defaultsTo("none: shear is elastic")
          .number("poisson", &F::poisson, "", {.low = 0, .high = 1, .high_open = true},
                  "contraction along the warp under tension along the weft; poisson^2 young_warp < young_weft")
          .number("jam_area", &F::jam_area, "", {.low = 0, .high = 1, .high_open = true},
                  "area ratio below which cloth pressed together in its plane jams instead of giving way "
                  "(core/material/laws/jamming.hpp); 0: never")
          .number(
              "limit_strain", &F::limit_strain, "", aboveTo(0, 10),
              "Green-Lagrange strain (as the reports give stretch) up to which the fabric may be stretched along weft "
              "and warp, say where it stiffens, stays stretched or tears: beyond it no verdict is green")
          .defaultsTo("none: the range of the law, 2 % (Zheng 2013, eq. 2.13)")
          .number("limit_strain_weft", &F::limit_strain_weft, "", aboveTo(0, 10), "the same, along the weft alone")
          .defaultsTo("limit_strain")
          .number("limit_strain_warp", &F::limit_strain_warp, "", aboveTo(0, 10), "the same, along the warp alone")
          .defaultsTo("limit_strain")
          .object("bending", &F::bending, bendingTable(), "resistance to bending")
          .defaultsTo("required, or card, or law")
          .object("law", &F::law, lawTable(),
                  "in place of young and its like, poisson, jam_area, shear_loop and bending, also where a card gives "
                  "them: "
                  "a law that is a table, a cell of yarns, or curves of tension (with nurbs cloth, on the CPU)")
          .defaultsTo("none")
          .build();
  // What such a law leaves no meaning to is not written beside it.
  for (Field& f : table.fields)
    if (f.key == "poisson" || f.key == "jam_area" || f.key == "bending")
      f.write = [write = f.write](const void* in) { return static_cast<const F*>(in)->law ? std::nullopt : write(in); };
  return table;
}

namespace {

/// What is given in N/m becomes moduli of the thickness; a sheet that has none gets one from its weight.
FabricInput inModuli(const Entry& entry, FabricInput in) {
  struct Pair {
    const char *per_width, *modulus;
    std::optional<double> FabricInput::*from;
    std::optional<double> FabricInput::*to;
  };
  const Pair pairs[] = {
      {"stiffness", "young", &FabricInput::stiffness_N_per_m, &FabricInput::young_Pa},
      {"stiffness_weft", "young_weft", &FabricInput::stiffness_weft_N_per_m, &FabricInput::young_weft_Pa},
      {"stiffness_warp", "young_warp", &FabricInput::stiffness_warp_N_per_m, &FabricInput::young_warp_Pa},
      {"shear_stiffness", "shear", &FabricInput::shear_stiffness_N_per_m, &FabricInput::shear_Pa}};
  const char* modulus = nullptr;
  bool any = false;
  for (const Pair& p : pairs) {
    if (in.*p.to) modulus = p.modulus;
    any = any || in.*p.from;
  }
  if (!any) return in;
  for (const Pair& p : pairs)
    if (in.*p.from && modulus)
      entry.failAt(p.per_width, fmt::format("excludes \"{}\": give moduli in Pa, or stiffnesses in N/m", modulus));
  if (in.stiffness_N_per_m)
    for (const Pair* p : {&pairs[1], &pairs[2]})
      if (in.*p->from)
        entry.failAt(p->per_width,
                     "excludes \"stiffness\"; give stiffness for isotropic cloth, or stiffness_weft, "
                     "stiffness_warp and shear_stiffness");
  const bool of_card = !in.card.empty();
  if (!in.stiffness_N_per_m && !of_card)
    for (const Pair& p : std::span(pairs).subspan(1))
      if (!(in.*p.from)) entry.failAt(p.per_width, "is required where \"stiffness\" is not given");
  if (!entry.node.find("thickness") && !of_card) {
    if (!in.surface_density_kg_per_m2)
      entry.failAt("thickness", "is required, or surface_density, from which it is taken where no modulus needs it");
    in.thickness_m = *in.surface_density_kg_per_m2 / kCardDensity_kg_per_m3;
    in.thickness_assumed = true;
  }
  return in;
}

/// After the thickness is known.
void toModuli(FabricInput& in, double thickness_m) {
  const auto to = [&](const std::optional<double>& from, std::optional<double>& modulus) {
    if (from) modulus = *from / thickness_m;
  };
  to(in.stiffness_N_per_m, in.young_Pa);
  to(in.stiffness_weft_N_per_m, in.young_weft_Pa);
  to(in.stiffness_warp_N_per_m, in.young_warp_Pa);
  to(in.shear_stiffness_N_per_m, in.shear_Pa);
}

void resolveDensity(const Entry& entry, const FabricInput& in, FabricCase& f) {
  if (in.surface_density_kg_per_m2)
    f.density_kg_per_m3 = *in.surface_density_kg_per_m2 / f.thickness_m;
  else if (in.density_kg_per_m3)
    f.density_kg_per_m3 = *in.density_kg_per_m3;
  else if (f.card.empty())
    entry.fail("one of density or surface_density is required");
}

void resolveMembrane(const Entry& entry, const FabricInput& in, FabricCase& f) {
  if (f.card.empty() || entry.node.find("poisson")) f.poisson = in.poisson;
  if (in.young_Pa) {
    for (const auto& [key, given] :
         {std::pair("young_weft", in.young_weft_Pa), std::pair("young_warp", in.young_warp_Pa)})
      if (given)
        entry.failAt(key, "excludes \"young\"; give young for isotropic cloth, or young_weft, young_warp and shear");
    f.young_weft_Pa = f.young_warp_Pa = *in.young_Pa;
    f.shear_Pa = in.shear_Pa.value_or(*in.young_Pa / (2 * (1 + f.poisson)));
  } else {
    if (f.card.empty() && !in.young_weft_Pa && !in.young_warp_Pa)
      entry.failAt("young", "is required: Young's modulus, or young_weft, young_warp and shear");
    for (const auto& [key, given, to] : {std::tuple("young_weft", in.young_weft_Pa, &f.young_weft_Pa),
                                         std::tuple("young_warp", in.young_warp_Pa, &f.young_warp_Pa),
                                         std::tuple("shear", in.shear_Pa, &f.shear_Pa)}) {
      if (!given && f.card.empty()) entry.failAt(key, "is required where \"young\" is not given");
      if (given) *to = *given;
    }
  }
  // The elasticity matrix of eq. 2.13 is positive definite only so.
  if (!(f.poisson * f.poisson * f.young_warp_Pa < f.young_weft_Pa))
    entry.failAt("poisson", fmt::format("{} is out of range; allowed: below sqrt(young_weft / young_warp) = {:.4g}",
                                        f.poisson, std::sqrt(f.young_weft_Pa / f.young_warp_Pa)));
}

/// After the membrane: what was given as shear may have a part of friction in it.
void resolveShear(const Entry& entry, const FabricInput& in, FabricCase& f) {
  if (!in.shear_loop) {
    if (in.shear_Pa || in.young_Pa) f.shear_friction = {};
    return;
  }
  const ShearLoopInput& loop = *in.shear_loop;
  const Entry at = entry.member(*entry.node.find("shear_loop"));
  if (loop.hysteresis_N_per_m.has_value() == loop.rise_N_per_m.has_value())
    at.failAt(loop.rise_N_per_m ? "rise" : "hysteresis",
              loop.rise_N_per_m ? "excludes \"hysteresis\", which gives it" : "is required, or rise");
  const double span = loop.friction_angle_rad;
  if (loop.rise_N_per_m) {
    if (loop.hysteresis_5_N_per_m) at.failAt("hysteresis_5", "goes with hysteresis; give growth");
    f.shear_friction = {*loop.rise_N_per_m, span, loop.growth_N_per_m};
    return;
  }
  if (!f.card.empty() && !in.shear_Pa && !in.young_Pa)
    at.failAt("hysteresis", "needs shear beside it, of the same test");
  if (at.node.find("growth")) at.failAt("growth", "goes with rise; give hysteresis_5");
  try {
    const ShearedSheet sheet = sheetOfKesShear(
        {f.shear_Pa * f.thickness_m, *loop.hysteresis_N_per_m, loop.hysteresis_5_N_per_m.value_or(0)}, span);
    f.shear_Pa = sheet.elastic_N_per_m / f.thickness_m;
    f.shear_friction = sheet.friction;
  } catch (const InputError& e) {
    at.failAt(loop.hysteresis_5_N_per_m && e.reason().starts_with("2HG5") ? "hysteresis_5" : "hysteresis", e.reason());
  }
}

void resolveLimits(const Entry& entry, const FabricInput& in, FabricCase& f) {
  for (const auto& [key, given] :
       {std::pair("limit_strain_weft", in.limit_strain_weft), std::pair("limit_strain_warp", in.limit_strain_warp)})
    if (given && in.limit_strain)
      entry.failAt(key, "excludes \"limit_strain\"; give limit_strain, or limit_strain_weft and limit_strain_warp");
  // Else those of the card, if it has any.
  if (in.limit_strain) f.limit_strain_weft = f.limit_strain_warp = in.limit_strain;
  if (in.limit_strain_weft) f.limit_strain_weft = in.limit_strain_weft;
  if (in.limit_strain_warp) f.limit_strain_warp = in.limit_strain_warp;
}

void resolveBending(const Entry& bending, const BendingInput& b, FabricCase& f) {
  GivenRigidities rigidities;
  rigidities.twist_Nm = b.twist_Nm;
  const std::optional<double> of_curve = b.loop ? rigidityOf(bending, *b.loop) : std::nullopt;
  if (of_curve) {
    rigidities.weft_Nm = rigidities.warp_Nm = *of_curve;
  } else if (b.rigidity_Nm) {
    for (const auto& [key, given] :
         {std::pair("rigidity_weft", b.rigidity_weft_Nm), std::pair("rigidity_warp", b.rigidity_warp_Nm)})
      if (given) bending.failAt(key, "excludes \"rigidity\"; give rigidity, or rigidity_weft and rigidity_warp");
    rigidities.weft_Nm = rigidities.warp_Nm = *b.rigidity_Nm;
  } else {
    if (!b.rigidity_weft_Nm && !b.rigidity_warp_Nm)
      bending.failAt("rigidity", "is required: the bending rigidity, or rigidity_weft and rigidity_warp");
    if (!b.rigidity_weft_Nm) bending.failAt("rigidity_weft", "is required where \"rigidity\" is not given");
    if (!b.rigidity_warp_Nm) bending.failAt("rigidity_warp", "is required where \"rigidity\" is not given");
    rigidities.weft_Nm = *b.rigidity_weft_Nm;
    rigidities.warp_Nm = *b.rigidity_warp_Nm;
  }
  const LawRow& row = *std::find_if(rows().begin(), rows().end(), [&](const LawRow& r) { return r.name == b.law; });
  f.law = row.resolve(bending, b, rigidities);
  for (const LawRow& other : rows())
    for (const std::string& key : other.keys)
      if (bending.node.find(key) && std::find(row.keys.begin(), row.keys.end(), key) == row.keys.end())
        bending.failAt(key, fmt::format("has no meaning for the law {}; remove it", row.name));
  f.rest_curvature_of_shape = b.rest == RestCurvature::shape;
}

/// The fabric of the card that the input names; where there is none, or of a finished run, one without numbers.
FabricCase cardOf(const Entry& entry, const FabricInput& in) {
  FabricCase f;
  if (!in.card.empty() && !entry.recorded) f = fabricOf(readCard(in.card)).fabric;
  f.card = in.card;
  return f;
}

}  // namespace

FabricCase resolveFabric(const Entry& entry, const FabricInput& given) {
  FabricInput in = inModuli(entry, given);
  FabricCase f = cardOf(entry, in);
  const bool of_card = !f.card.empty();
  if (!in.name.empty()) f.name = in.name;
  if (in.thickness_m > 0) {
    f.thickness_m = in.thickness_m;
    f.thickness_assumed = in.thickness_assumed;
  } else if (!of_card) {
    entry.failAt("thickness", "is required: thickness");
  }
  toModuli(in, f.thickness_m);
  resolveDensity(entry, in, f);
  if (in.law) {
    resolveLimits(entry, in, f);
    resolveLaw(entry, *in.law, f);
    return f;
  }
  if (f.energy) {  // a card's curves
    refuseReplaced(entry, "the card's tension has the law curve");
    resolveLimits(entry, in, f);
    static_cast<Fabric&>(f) = withEnergy(f, f.energy);  // moduli of this thickness
    return f;
  }
  if (!of_card || entry.node.find("jam_area")) f.jam_area = in.jam_area;
  resolveMembrane(entry, in, f);
  resolveShear(entry, in, f);
  resolveLimits(entry, in, f);
  if (const JsonNode* bending = entry.node.find("bending"))
    resolveBending(entry.member(*bending), in.bending, f);
  else if (!of_card)
    entry.failAt("bending", "is required: resistance to bending");
  return f;
}

std::string bendingName(const BendingLaw& law) { return givenRigidities(law) ? rowOf(law).name : ""; }

std::string bendingInWords(const BendingLaw& law) { return rowOf(law).say(law); }

FabricInput restoreFabric(const FabricCase& f) {
  FabricInput in;
  in.card = f.card;
  in.name = f.name;
  in.thickness_m = f.thickness_m;
  in.density_kg_per_m3 = f.density_kg_per_m3;
  in.thickness_assumed = f.thickness_assumed;
  if (f.energy_source) {
    if (!f.limit_of_law[0]) in.limit_strain_weft = f.limit_strain_weft;
    if (!f.limit_of_law[1]) in.limit_strain_warp = f.limit_strain_warp;
    in.law = restoreLaw(f);
    return in;
  }
  in.young_weft_Pa = f.young_weft_Pa;
  in.young_warp_Pa = f.young_warp_Pa;
  in.shear_Pa = f.shear_Pa;
  if (const ShearFriction& s = f.shear_friction; s != ShearFriction{}) {
    in.shear_loop.emplace();
    in.shear_loop->rise_N_per_m = s.rise_N_per_m;
    in.shear_loop->growth_N_per_m = s.growth_N_per_m;
    in.shear_loop->friction_angle_rad = s.span;
  }
  in.poisson = f.poisson;
  in.jam_area = f.jam_area;
  in.limit_strain_weft = f.limit_strain_weft;
  in.limit_strain_warp = f.limit_strain_warp;
  const LawRow& row = rowOf(f.law);
  const GivenRigidities& given = *givenRigidities(f.law);
  in.bending.law = row.name;
  in.bending.rigidity_weft_Nm = given.weft_Nm;
  in.bending.rigidity_warp_Nm = given.warp_Nm;
  in.bending.twist_Nm = given.twist_Nm;
  row.restore(f.law, in.bending);
  in.bending.rest = f.rest_curvature_of_shape ? RestCurvature::shape : RestCurvature::zero;
  return in;
}

}  // namespace gambeson::schema
