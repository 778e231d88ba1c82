#include "cases/fabric/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/report/xy_chart.hpp"
#include "analysis/ticks.hpp"
#include "cases/cloth/kind_fields.hpp"
#include "cases/fabric/shadow.hpp"
#include "cases/fabric/strips.hpp"
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

std::string fixed(double x) {
  if (x != 0 && (std::abs(x) < 1e-3 || std::abs(x) >= 1e5)) return fmt::format("{:.3e}", x);
  const int digits = x == 0 ? 3 : std::clamp(3 - static_cast<int>(std::floor(std::log10(std::abs(x)))), 0, 6);
  return fmt::format("{:.{}f}", x, digits);
}

/// Of a reading with a card; what rounds to nothing has no sign.
std::string difference(const Reading& r) {
  if (r.share) return fmt::format("{:+.1f} points", 100 * (r.measured - *r.card));
  if (*r.card == 0) return fmt::format("{:+.4g}", r.measured);
  const double percent = 100 * (r.measured / *r.card - 1);
  return std::abs(percent) < 0.005 ? "0.00 %" : fmt::format("{:+.2f} %", percent);
}

}  // namespace

std::string testTable(const MeasuredTest& test) {
  std::string text =
      fmt::format("{}\n  {:<18}{:>12}{:>12}{:>14}  unit\n", test.title(), "", "card", "measured", "difference");
  for (const Reading& r : test.readings)
    text += fmt::format("  {:<18}{:>12}{:>12}{:>14}  {}\n", r.name, r.card ? fixed(*r.card / r.per_unit) : "-",
                        fixed(r.measured / r.per_unit), r.card ? difference(r) : "-", r.unit);
  for (const std::string& note : test.notes) text += "  " + note + "\n";
  return text;
}

std::string fabricTable(const FabricCard& card, const CardFabric& c) {
  const FabricCase& f = c.fabric;
  std::string text = fmt::format("{}\n  source: {}\n", card.name, card.source);
  if (!card.spread.empty()) text += "  spread: " + card.spread + "\n";
  if (!card.range.empty()) text += "  range: " + card.range + "\n";
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

std::string loopCsv(const MeasuredTest& test) {
  const LabTestKind& kind = kindOf(test.test);
  std::vector<std::vector<double>> rows;
  for (const laboratory::LoopPoint& p : test.loop)
    rows.push_back({p.at / kind.x_unit, p.load / kind.y_unit, p.at, p.load, p.lost_J_per_m2});
  return formatCsv(kind.columns, rows);
}

namespace {

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();

/// The card's numbers of a loop where they are read: its slope from the loop on, its widths about the loop's middle.
void addOfLoop(const MeasuredTest& test, const Reading& r, XySeries& series) {
  const LabTestKind& kind = kindOf(test.test);
  const auto on = [&](int way, double at) { return laboratory::loadAt(test.loop, way, at); };
  const auto add = [&](double at, double load) {
    series.x.push_back(at / kind.x_unit);
    series.y.push_back(load / kind.y_unit);
  };
  for (const double side : {1., -1.}) {
    const double at = side * r.at;
    if (&r == &test.readings.front()) {
      const double to = side * (test.test == LabTest::bending ? kKesTo_per_m : kShearTo);
      const double from = on(side > 0 ? 2 : 1, at);
      add(at, from);
      add(to, from + *r.card * (to - at));
    } else {
      const double middle = 0.5 * (on(1, at) + on(2, at));
      add(at, middle - 0.5 * *r.card);
      add(at, middle + 0.5 * *r.card);
    }
    add(kGap, kGap);
  }
}

/// The card's numbers: of loops as above, of strains the point, of cantilevers the line at 41.5 degrees.
void addCard(const MeasuredTest& test, XyPlot& plot) {
  const LabTestKind& kind = kindOf(test.test);
  const bool loop = test.test == LabTest::bending || test.test == LabTest::shear;
  for (const Reading& r : test.readings) {
    if (!r.card) continue;
    XySeries series;
    series.name = "card: " + r.name;
    if (loop) {
      addOfLoop(test, r, series);
    } else if (test.test == LabTest::cantilever) {
      series.x = {0, 1.5 * *r.card / kind.x_unit};
      series.y = {0, 1.5 * *r.card * std::tan(laboratory::kDroop_rad) / kind.y_unit};
      series.name = "chord at 41.5 degrees";
    } else if (r.load) {
      series.x = {*r.card / kind.x_unit};
      series.y = {*r.load / kind.y_unit};
      series.circles = true;
    } else {
      continue;
    }
    plot.series.push_back(std::move(series));
  }
}

/// The specimen before it sank, and the discs that hold it.
void addCircles(const FabricCard& card, XyPlot& plot) {
  constexpr int kPoints = 180;
  const CardDrape said = card.drape.value_or(CardDrape{});
  for (const auto& [name, diameter] :
       {std::pair("specimen, flat", said.specimen_m), std::pair("support", said.support_m)}) {
    XySeries circle{name, {}, {}, false};
    for (int k = 0; k <= kPoints; ++k) {
      const Vec2 ray = laboratory::rayAt(k, kPoints);
      circle.x.push_back(50 * diameter * ray.x);
      circle.y.push_back(50 * diameter * ray.y);
    }
    plot.series.push_back(std::move(circle));
  }
}

}  // namespace

Image drapePicture(const FabricCard& card, const MeasuredTest& test) {
  constexpr Color kCloth{0.42f, 0.50f, 0.62f}, kDisc{0.74f, 0.73f, 0.72f};
  constexpr int kPoints = 120;
  RenderMesh cloth{test.drawn().points, test.drawn().triangles, {}, kCloth, false, {}};
  RenderMesh disc{{{0, 0, 0}}, {}, {}, kDisc, true, {}};
  const double support_m = 0.5 * card.drape.value_or(CardDrape{}).support_m;
  for (int k = 0; k < kPoints; ++k) {
    const Vec2 ray = laboratory::rayAt(k, kPoints);
    disc.vertices.push_back({support_m * ray.x, support_m * ray.y, 0});
    disc.triangles.push_back({0, k + 1, (k + 1) % kPoints + 1});
  }
  Scene scene;
  scene.meshes = {std::move(cloth), std::move(disc)};
  scene.title = card.name + ": " + test.title();
  scene.subtitle =
      fmt::format("Drape coefficient {:.1f} %, {} nodes", 100 * test.drawn().coefficient, test.drawn().nodes);
  scene.view = View::above;
  return render(scene, 1100, 850);
}

std::string loopPicture(const FabricCard& card, const MeasuredTest& test, const std::vector<LoopSample>& raw,
                        const std::string& specimen) {
  const LabTestKind& kind = kindOf(test.test);
  XyPlot plot{card.name + ": " + test.title(), "", kind.x_label, kind.y_label, {}, false, test.drapes.has_value()};
  XySeries loop{"simulated", {}, {}, false};
  for (const laboratory::LoopPoint& p : test.loop) {
    loop.x.push_back(p.at / kind.x_unit);
    loop.y.push_back(p.load / kind.y_unit);
  }
  plot.series.push_back(std::move(loop));
  if (test.test == LabTest::bending && !raw.empty()) {
    XySeries points{"raw loop", {}, {}, true};
    for (const LoopSample& s : raw) {
      points.x.push_back(s.curvature_per_m / kind.x_unit);
      points.y.push_back(s.moment_N / kind.y_unit);
    }
    plot.series.push_back(std::move(points));
  }
  if (test.drapes)
    addCircles(card, plot);
  else
    addCard(test, plot);
  std::vector<std::string> notes;
  for (const Reading& r : test.readings)
    notes.push_back(
        fmt::format("{}: measured {} {}{}", r.name, fixed(r.measured / r.per_unit), r.unit,
                    r.card ? fmt::format(", card {} ({})", fixed(*r.card / r.per_unit), difference(r)) : ""));
  notes.insert(notes.end(), test.notes.begin(), test.notes.end());
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
