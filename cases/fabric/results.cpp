#include "cases/fabric/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/report/xy_chart.hpp"
#include "analysis/ticks.hpp"
#include "cases/cloth/kind_fields.hpp"
#include "core/io/csv.hpp"

namespace gambeson {
namespace {

/// The word of a choice as a case has it.
template <class E>
std::string wordOf(const std::vector<std::pair<std::string, E>>& choices, E value) {
  return std::find_if(choices.begin(), choices.end(), [&](const auto& c) { return c.second == value; })->first;
}

constexpr double kGf_N = 9.80665e-3, kDegree = 0.017453292519943295;
constexpr double kMomentUnit_N = kGf_N;             // gf cm/cm
constexpr double kRigidityUnit_Nm = 0.01 * kGf_N;   // gf cm^2/cm
constexpr double kForceUnit_N_per_m = 100 * kGf_N;  // gf/cm
constexpr double kShearFrom = 0.5 * kDegree, kShearTo = 2.5 * kDegree, kShearWide = 5 * kDegree;

/// What the card says of a direction: along weft or warp, or of any where it does not tell them apart.
std::optional<double> cardOf(const CardNumber& n, double direction_deg, bool isotropic) {
  if (!n.any()) return std::nullopt;
  const double turned = std::fmod(std::abs(direction_deg), 180);
  if (turned == 0) return n.of(0);
  if (turned == 90) return n.of(1);
  return isotropic ? std::optional(n.mean()) : std::nullopt;
}

std::string fixed(double x) {
  if (x != 0 && (std::abs(x) < 1e-3 || std::abs(x) >= 1e5)) return fmt::format("{:.3e}", x);
  const int digits = x == 0 ? 3 : std::clamp(3 - static_cast<int>(std::floor(std::log10(std::abs(x)))), 0, 6);
  return fmt::format("{:.{}f}", x, digits);
}

/// Of a reading with a card; what rounds to nothing has no sign.
std::string difference(const Reading& r) {
  const double percent = 100 * (r.measured / *r.card - 1);
  return std::abs(percent) < 0.005 ? "0.00 %" : fmt::format("{:+.2f} %", percent);
}

}  // namespace

std::string KesTest::title() const {
  const double turned = std::fmod(std::abs(direction_deg), 180);
  const std::string where = turned == 0    ? "along the weft"
                            : turned == 90 ? "along the warp"
                                           : fmt::format("at {} degrees from the weft", direction_deg);
  return (bending ? "KES-FB2 bending, " : "KES-FB1 shear, ") + where;
}

std::string KesTest::stem() const { return fmt::format("{}_{}", bending ? "bending" : "shear", direction_deg); }

std::vector<Reading> bendingReadings(const FabricCard& card, const KesTest& test, double width_at_per_m) {
  const CardBending& b = card.bending;
  const bool isotropic = !b.rigidity.apart() && !b.hysteresis.apart();
  return {{"B", "gf cm^2/cm", kRigidityUnit_Nm, cardOf(b.rigidity, test.direction_deg, isotropic),
           laboratory::slopeBetween(test.loop, kKesFrom_per_m, kKesTo_per_m), kKesFrom_per_m},
          {fmt::format("2HB at {}/cm", width_at_per_m / 100), "gf cm/cm", kMomentUnit_N,
           cardOf(b.hysteresis, test.direction_deg, isotropic), laboratory::widthAt(test.loop, width_at_per_m),
           width_at_per_m}};
}

std::vector<Reading> shearReadings(const FabricCard& card, const KesTest& test) {
  const CardShear s = card.shear.value_or(CardShear{});
  // Shear along weft and warp is one and the same of a sheet: the fabric has the mean.
  const auto of = [&](const CardNumber& n) {
    const bool along = std::fmod(std::abs(test.direction_deg), 90) == 0;
    return n.any() && along ? std::optional(n.mean()) : std::nullopt;
  };
  return {{"G", "gf/(cm deg)", kForceUnit_N_per_m / kDegree, of(s.rigidity),
           laboratory::slopeBetween(test.loop, kShearFrom, kShearTo), kShearFrom},
          {"2HG at 0.5 deg", "gf/cm", kForceUnit_N_per_m, of(s.hysteresis), laboratory::widthAt(test.loop, kShearFrom),
           kShearFrom},
          {"2HG5 at 5 deg", "gf/cm", kForceUnit_N_per_m, of(s.hysteresis_5), laboratory::widthAt(test.loop, kShearWide),
           kShearWide}};
}

std::string testTable(const KesTest& test) {
  std::string text =
      fmt::format("{}\n  {:<16}{:>12}{:>12}{:>12}  unit\n", test.title(), "", "card", "measured", "difference");
  for (const Reading& r : test.readings)
    text += fmt::format("  {:<16}{:>12}{:>12}{:>12}  {}\n", r.name, r.card ? fixed(*r.card / r.per_unit) : "-",
                        fixed(r.measured / r.per_unit), r.card ? difference(r) : "-", r.unit);
  return text;
}

std::string fabricTable(const FabricCard& card, const CardFabric& c) {
  const FabricCase& f = c.fabric;
  std::string text = fmt::format("{}\n  source: {}\n", card.name, card.source);
  text += fmt::format("  thickness {:.4g} mm, weight {:.4g} g/m^2{}\n", 1000 * f.thickness_m, 1000 * f.surfaceDensity(),
                      card.friction ? fmt::format(", friction MIU {:.3g}", *card.friction) : "");
  text += fmt::format("  stiffness along weft {:.4g} N/m, along warp {:.4g} N/m, in shear {:.4g} N/m\n",
                      f.young_weft_Pa * f.thickness_m, f.young_warp_Pa * f.thickness_m, f.shear_Pa * f.thickness_m);
  for (const std::string& line : c.derived) text += "  from the card: " + line + "\n";
  for (const std::string& line : c.assumed) text += "  assumed: " + line + "\n";
  return text;
}

std::string fitTable(const LoopFit& fit) {
  std::string text = fmt::format(
      "Stops of the raw loop\n  {} points on {} ways; what the stops miss: {:.4f} gf cm/cm (RMS), {:.4f} at most, "
      "{:.2f} % of the moment's amplitude\n  {:.4f} gf cm^2/cm when new, {:.4f} beyond a friction of {:.4f} gf cm/cm, "
      "overcome at {:.3g}/cm\n",
      fit.points, fit.branches, fit.rms_N / kMomentUnit_N, fit.largest_N / kMomentUnit_N,
      100 * fit.rms_N / fit.amplitude_N, fit.stops.first_Nm / kRigidityUnit_Nm, fit.stops.last_Nm / kRigidityUnit_Nm,
      fit.stops.frictionMoment() / kMomentUnit_N, fit.stops.span_per_m / 100);
  for (std::size_t j = 0; j < kStops; ++j)
    if (fit.stops.shape.drop[j] > 0)
      text += fmt::format("  stop {}: {:5.1f} % of the rise slips at {:.3f}/cm\n", j + 1, 100 * fit.stops.shape.drop[j],
                          fit.stops.shape.reach[j] * fit.stops.span_per_m / 100);
  return text;
}

std::string loopCsv(const KesTest& test) {
  std::vector<std::vector<double>> rows;
  for (const laboratory::LoopPoint& p : test.loop)
    if (test.bending)
      rows.push_back({p.at / 100, p.load / kMomentUnit_N, p.at, p.load, p.lost_J_per_m2});
    else
      rows.push_back({p.at / kDegree, p.load / kForceUnit_N_per_m, p.at, p.load, p.lost_J_per_m2});
  if (test.bending)
    return formatCsv({"curvature_per_cm", "moment_gf_cm_per_cm", "curvature_per_m", "moment_N", "lost_J_per_m2"}, rows);
  return formatCsv({"angle_deg", "force_gf_per_cm", "angle_rad", "force_N_per_m", "lost_J_per_m2"}, rows);
}

namespace {

/// The card's numbers where they are read: its slope from the loop on, its widths about the loop's middle.
void addCard(const KesTest& test, double x_unit, double y_unit, XyPlot& plot) {
  constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
  const auto on = [&](int way, double at) { return laboratory::loadAt(test.loop, way, at); };
  for (const Reading& r : test.readings) {
    if (!r.card) continue;
    XySeries series;
    series.name = "card: " + r.name;
    const auto add = [&](double at, double load) {
      series.x.push_back(at / x_unit);
      series.y.push_back(load / y_unit);
    };
    for (const double side : {1., -1.}) {
      const double at = side * r.at;
      if (&r == &test.readings.front()) {
        const double to = side * (test.bending ? kKesTo_per_m : kShearTo), from = on(side > 0 ? 2 : 1, at);
        add(at, from);
        add(to, from + *r.card * (to - at));
      } else {
        const double middle = 0.5 * (on(1, at) + on(2, at));
        add(at, middle - 0.5 * *r.card);
        add(at, middle + 0.5 * *r.card);
      }
      add(kGap, kGap);
    }
    plot.series.push_back(std::move(series));
  }
}

}  // namespace

std::string loopPicture(const FabricCard& card, const KesTest& test, const std::vector<LoopSample>& raw,
                        const std::string& specimen) {
  const double x_unit = test.bending ? 100 : kDegree, y_unit = test.bending ? kMomentUnit_N : kForceUnit_N_per_m;
  XyPlot plot{card.name + ": " + test.title(),
              "",
              test.bending ? "curvature [1/cm]" : "shear angle [degrees]",
              test.bending ? "moment per width [gf cm/cm]" : "shear force per width [gf/cm]",
              {},
              false};
  XySeries loop{"simulated", {}, {}, false};
  for (const laboratory::LoopPoint& p : test.loop) {
    loop.x.push_back(p.at / x_unit);
    loop.y.push_back(p.load / y_unit);
  }
  plot.series.push_back(std::move(loop));
  if (test.bending && !raw.empty()) {
    XySeries points{"raw loop", {}, {}, true};
    for (const LoopSample& s : raw) {
      points.x.push_back(s.curvature_per_m / x_unit);
      points.y.push_back(s.moment_N / y_unit);
    }
    plot.series.push_back(std::move(points));
  }
  addCard(test, x_unit, y_unit, plot);
  std::vector<std::string> notes;
  for (const Reading& r : test.readings)
    notes.push_back(
        fmt::format("{}: measured {} {}{}", r.name, fixed(r.measured / r.per_unit), r.unit,
                    r.card ? fmt::format(", card {} ({})", fixed(*r.card / r.per_unit), difference(r)) : ""));
  notes.push_back(specimen);
  return xyPicture(plot, notes);
}

std::string specimenText(const laboratory::Specimen& s) {
  if (s.cloth.kind == ClothKind::triangles) {
    return fmt::format("Specimen of triangles, {} mesh, bent as {}, {} cells between the clamps; sides left out",
                       wordOf(schema::meshKinds(), s.cloth.mesh), wordOf(schema::bendingElements(), s.cloth.bending),
                       s.cells);
  }
  return fmt::format("Specimen of a NURBS shell, degree {}, {} cells between the clamps; sides left out", s.degree,
                     s.cells);
}

}  // namespace gambeson
