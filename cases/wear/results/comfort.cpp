/// Detail of measure.hpp: pressure on the body against what a wearer accepts.

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "analysis/ticks.hpp"
#include "cases/wear/recording/zone_ledger.hpp"
#include "cases/wear/results/write.hpp"

namespace gambeson {
namespace {

const ComfortLimit& limitOf(const ComfortCase& c, const std::string& zone) {
  if (zone.starts_with("shoulder")) return c.shoulder;
  if (zone.starts_with("thigh")) return c.thigh;
  if (zone.starts_with("upper_arm") || zone.starts_with("forearm")) return c.arm;
  return zone == "chest" ? c.chest : zone == "waist" ? c.waist : zone == "hips" ? c.hips : c.other;
}

}  // namespace

void measureComfort(const Scenario& s, const RecordingReader& recording, Measured& out) {
  out.body = std::make_shared<const BodyMap>(s, s.definition.comfort.sensor_m);
  out.body_loads = bodyLoads(*out.body, recording, out.counted_from_s);
  const std::vector<std::string> names = zoneNames(s);
  for (std::size_t z = 0; z < names.size(); ++z) {
    ComfortMeasure m{names[z], limitOf(s.definition.comfort, names[z]), 0, 0, 0, 0, 0};
    for (std::size_t v = 0; v < out.body->size(); ++v) {
      if (out.body->zone()[v] != static_cast<int>(z)) continue;
      m.mean_Pa = std::max(m.mean_Pa, out.body_loads.mean_Pa[v]);
      if (out.body_loads.peak_Pa[v] > m.peak_Pa)
        m.peak_Pa = out.body_loads.peak_Pa[v], m.peak_time_s = out.body_loads.peak_time_s[v];
      if (out.body_loads.mean_Pa[v] > m.limit.amber_Pa) m.amber_m2 += out.body->area_m2()[v];
    }
    if (!(m.peak_Pa > 0)) continue;
    if (out.strides) {
      const bool left = m.zone.ends_with("_left"), right = m.zone.ends_with("_right");
      const bool strides = m.peak_time_s >= out.strides->start_s;
      m.peak_during =
          phaseWords(*out.strides, strides ? std::optional(out.strides->phase(m.peak_time_s, right ? "right" : "left"))
                                           : std::nullopt);
      if (strides && !left && !right) m.peak_during += " of the left leg";
    }
    m.dose_kPa_min = 1e-3 * m.mean_Pa * s.definition.comfort.wear_s / 60;
    out.comfort.push_back(m);
  }
}

void writePressures(const std::filesystem::path& csv, const Scenario& s, const Measured& m) {
  const std::vector<std::string> names = zoneNames(s);
  std::vector<std::string> columns{"time_s"};
  std::vector<std::vector<double>> rows;
  for (const double t : m.body_loads.time_s) rows.push_back({t});
  for (const ComfortMeasure& c : m.comfort) {
    const auto z = static_cast<std::size_t>(std::find(names.begin(), names.end(), c.zone) - names.begin());
    columns.insert(columns.end(), {c.zone + "_largest_Pa", c.zone + "_mean_so_far_Pa"});
    for (std::size_t k = 0; k < rows.size(); ++k)
      rows[k].insert(rows[k].end(), {m.body_loads.largest_Pa[k][z], m.body_loads.mean_so_far_Pa[k][z]});
  }
  writeCsv(csv, columns, rows);
}

void addComfort(const Scenario& s, const Measured& m, ReportInput& in) {
  if (m.comfort.empty()) return;
  const ComfortCase& c = s.definition.comfort;
  const Trust trust = trustOf(in);
  Table table{"Pressure on the body against comfort limits",
              fmt::format("Pressure: force by the area as it is, over {:g} mm, about what a sensor shows; single "
                          "contact points press harder. "
                          "Mean: over time, where it is largest; the dose "
                          "is that over {:g} min, as if the motion went on. Green: the mean is at most the comfortable "
                          "pressure; red: it is above the limit, or the peak above the limit of peaks. The limits are "
                          "suggestions; a case sets its own under \"comfort\".",
                          1e3 * c.sensor_m, c.wear_s / 60),
              {"part", "verdict", "mean [kPa]", "comfortable [kPa]", "limit [kPa]", "peak [kPa]", "at [s]",
               "limit of peaks [kPa]", "dose [kPa min]", "above comfortable [cm\u00b2]"},
              {}};
  std::vector<const ComfortMeasure*> order;
  for (const ComfortMeasure& z : m.comfort) order.push_back(&z);
  std::stable_sort(order.begin(), order.end(), [](auto* a, auto* b) {
    if (a->light() != b->light()) return a->light() > b->light();
    return a->mean_Pa / a->limit.red_Pa > b->mean_Pa / b->limit.red_Pa;
  });
  for (const ComfortMeasure* z : order) {
    table.rows.push_back({spokenZone(z->zone), TableCell::signal(nameOf(shownLight(z->light(), trust))),
                          1e-3 * z->mean_Pa, 1e-3 * z->limit.amber_Pa, 1e-3 * z->limit.red_Pa, 1e-3 * z->peak_Pa,
                          TableCell(fmt::format("{:.2f}", z->peak_time_s)), 1e-3 * z->limit.peak_Pa, z->dose_kPa_min,
                          1e4 * z->amber_m2});
    table.rows.back()[6].number = true;
  }
  const ComfortMeasure& worst = *order.front();
  const auto kPa = [](double Pa) { return formatNumber(1e-3 * Pa) + " kPa"; };
  in.comfort =
      worst.light() == Light::green
          ? fmt::format("{}: closest to its limit is the {} ({} in the mean, {} allowed).",
                        trust.whole() ? "Comfortable everywhere" : "Comfortable by numbers that are in doubt",
                        spokenZone(worst.zone), kPa(worst.mean_Pa), kPa(worst.limit.amber_Pa))
      : worst.peak_Pa > worst.limit.peak_Pa
          ? fmt::format("The {} is red: {} at {:.2f} s, more than the limit of peaks, {}.", spokenZone(worst.zone),
                        kPa(worst.peak_Pa), worst.peak_time_s, kPa(worst.limit.peak_Pa))
          : fmt::format(
                "The {} is {}: {} in the mean over time where it bears most; comfortable is {}, the "
                "limit {}.",
                spokenZone(worst.zone), nameOf(worst.light()), kPa(worst.mean_Pa), kPa(worst.limit.amber_Pa),
                kPa(worst.limit.red_Pa));
  in.comfort_tables.push_back(std::move(table));
}

std::vector<Picture> takeBodyPictures(const Scenario& s, const Measured& m, const std::filesystem::path& folder) {
  std::vector<Picture> pictures;
  if (m.comfort.empty()) return pictures;
  double high = 0;
  for (const ComfortMeasure& z : m.comfort) high = std::max(high, z.peak_Pa);
  high = 1e3 * roundedUp(1e-3 * high);
  for (const View view : {View::front_right, View::back_left}) {
    const PictureCase picture{
        PictureTime::peak, m.peak_time_s, PictureField::body_pressure, view, PictureAround::wearer, 800, 800};
    const std::filesystem::path png =
        folder / fmt::format("body_pressure_{}.png", viewNames()[static_cast<std::size_t>(view)]);
    renderBody(s, *m.body, m.body_loads, m.peak_time_s, picture, high, png);
    pictures.push_back({png, captionOf(picture, m.peak_time_s, s.definition.comfort.sensor_m), ""});
  }
  return pictures;
}

}  // namespace gambeson
