#pragma once
/// A fabric card: what laboratories measure of a fabric, in their terms and units, and the fabric that follows from it.
/// Keys are Kawabata's (S. Kawabata, The standardization and analysis of hand evaluation, 2nd ed., Osaka 1980), those
/// of FAST (CSIRO, FAST instruction manual, 1989) and of ASTM D1388; cases/cloth/card_terms.hpp converts them.

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cases/cloth/fabric.hpp"
#include "cases/cloth/fabric_spread.hpp"
#include "cases/cloth/loop_input.hpp"
#include "core/material/hysteresis.hpp"
#include "core/material/kes_shear.hpp"
#include "core/material/table/tension_curve.hpp"

namespace gambeson {

/// A number of both directions (their mean), or of weft and warp apart.
struct CardNumber {
  std::optional<double> both, weft, warp;
  bool any() const { return both || weft || warp; }
  bool apart() const { return weft && warp; }
  double of(int direction) const { return both ? *both : direction == 0 ? *weft : *warp; }
  double mean() const { return both ? *both : 0.5 * (*weft + *warp); }
};

/// Points of tensile tests, as CardNumber has numbers.
struct CardCurves {
  std::vector<TensilePoint> both, weft, warp;
  bool any() const { return !both.empty() || !weft.empty() || !warp.empty(); }
  bool apart() const { return !weft.empty() && !warp.empty(); }
  const std::vector<TensilePoint>& of(int direction) const {
    return !both.empty() ? both : direction == 0 ? weft : warp;
  }
};

/// What a fabric makes of a card's tension: the straight law n = A E through one point, or the whole curve.
enum class TensileLaw { secant, curve };

/// KES-FB1, tension of a strip that is wide against its length: `extension` (EMT) at the largest load, linearity LT or
/// the work WT [J/m^2]; or points; or moduli [N/m], force per width over strain.
struct CardTensile {
  CardNumber extension, linearity, work_J_per_m2, modulus_N_per_m;
  CardCurves curves;
  TensileLaw law = TensileLaw::secant;
  double load_N_per_m = 490.3325;           ///< at which EMT was read: 500 gf/cm
  std::optional<double> secant_at_N_per_m;  ///< load whose secant modulus the fabric gets; absent: that of EMT
  std::optional<double> poisson;
};
/// KES-FB1, shear: slope G between 0.5 and 2.5 degrees [N/(m rad)], widths of the loop at 0.5 and 5 degrees [N/m].
struct CardShear {
  CardNumber rigidity, hysteresis, hysteresis_5;
  std::optional<double> friction_rad;  ///< angle where all friction is overcome
};
/// KES-FB2: B [N m], or ASTM D1388's bending length c [m] in its place; 2HB [N] and the curvature where it was read
/// [1/m]; K0, where all friction is overcome [1/m]; stops as loop.stops of a fabric.
struct CardBending {
  CardNumber rigidity, length_m, hysteresis;
  std::optional<double> hysteresis_at_per_m, friction_per_m;
  std::vector<std::pair<double, double>> stops;
};

/// FAST: extensions under 5, 20 and 100 gf/cm, and along the bias under 5; bending length [m] and rigidity [N m] of
/// FAST-2, shear rigidity [N/m], surface thickness [m].
struct CardFast {
  std::array<CardNumber, 3> extension;
  CardNumber length_m, rigidity;
  std::optional<double> bias, shear_N_per_m, surface_thickness_m;
};

/// Cusick's drape test (BS 5058, ISO 9073-9): what no fabric is made of, but what the laboratory is compared with.
struct CardDrape {
  double coefficient = 0;    ///< a part of 1
  double specimen_m = 0.30;  ///< diameter
  double support_m = 0.18;   ///< of the discs that hold it
  std::optional<double> nodes;
  std::string source;  ///< where it is from, if not with the card's other numbers
};

struct FabricCard {
  std::string name, source, description;
  std::string spread, range;  ///< in words: how far specimens differ; in which the numbers are fitted
  FabricSpread spread_of;     ///< the same in numbers, as far as somebody measured it
  double thickness_m = 0;
  bool thickness_assumed = false;  ///< the card has none
  std::optional<double> thickness_pressure_Pa, weight_kg_per_m2;
  std::optional<double> T0_m, Tm_m;         ///< thickness of KES-FB3 under 0.5 and 50 gf/cm^2
  CardNumber elongation, strength_N_per_m;  ///< engineering strain and force per width that the fabric may reach
  std::optional<CardFast> fast;             ///< as written; what it says is in the three below too
  std::optional<CardTensile> tensile;
  std::optional<CardShear> shear;
  CardBending bending;
  std::optional<CardDrape> drape;
  std::optional<double> friction;  ///< MIU of KES-FB4
};

/// The fabric of a card, and which numbers it has from where.
struct CardFabric {
  FabricCase fabric;
  std::vector<std::string> derived;  ///< formulas, with their numbers
  std::vector<std::string> assumed;  ///< what stands in for numbers that the card lacks
};

/// What cards leave open, and what stands in for it.
constexpr double kCardDensity_kg_per_m3 = 400;   ///< weight over thickness, where one of them is there
constexpr double kCardExtension = 0.05;          ///< EMT
constexpr double kCardShear_N_per_m = 56.18796;  ///< G: 1 gf/(cm deg)
constexpr double kCardFriction_per_m = 50;       ///< K0: where KES begins to read B
constexpr double kCardFriction_rad = 0.0174532925199432958;

/// Reads and checks a card: a file, or the name of one of the library (card_library.hpp). Throws InputError with file,
/// line and key.
FabricCard readCard(const std::filesystem::path& file);

/// The stops of a card, or those of Wong 2014, eq. 4.2.
StopShape<kStops> shapeOf(const CardBending& bending);
/// The point of a direction by whose secant a fabric is linear: engineering strain, force per width. Not of moduli.
TensilePoint secantPoint(const CardTensile& t, int direction);
/// Of a card's shear with 2HG. Throws InputError (reason only) where no friction has these widths.
ShearedSheet sheetOf(const CardShear& shear);

/// Never throws on a card that was read.
///   membrane: a strip that is wide against its length keeps its width, so that the force per width at an engineering
///     strain e is A (1 + e)(e + e^2/2) for the law n = A E (core/material/laws/membrane.hpp). A11 and A22 are those of
///     EMT at 500 gf/cm, or with `secant_at` F of e = EMT (F/F_max)^(LT/(2 - LT)), the power law whose work is
///     LT EMT F_max/2. E1 h = A11 s, s = 1 - poisson^2 A22/A11. Of points with `secant_at` F e is where their curve
///     has F, else their last. With TensileLaw::curve the fabric's law is a CurveEnergy of the points, or of those of
///     tensilePointsOfKes, with G and B in it, and elastic.
///   shear: A33 = G, in simple shear by the angle phi the shear strain is tan(phi); with 2HG sheetOfKesShear.
///   bending: stopsOfKes (core/material/hysteresis.hpp); one number for both directions makes an isotropic loop, weft
///     and warp apart make loops of their own, with a twist of half their geometric mean (Huber's assumption for
///     plates).
///   limits of strain: of `elongation` e + e^2/2, of `strength` where the fabric's law reaches it; the lesser.
/// `fitted`: bends by this in place of the card's B and 2HB. Valid for EMT below 50 % and 0.1 < LT <= 1.9.
CardFabric fabricOf(const FabricCard& card, const IsotropicHysteresisBending* fitted = nullptr);

namespace schema {
struct Object;
/// Of a card, for the documentation.
const Object& cardTable();
}  // namespace schema

}  // namespace gambeson
