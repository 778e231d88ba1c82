/// Detail of measure.hpp: how the bodies are touched at the end: what a reader compares with closed forms and between
/// meshes.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/wear/results/measure.hpp"
#include "cases/wear/results/write.hpp"
#include "cases/wear/scene/placed_bodies.hpp"
#include "core/io/csv.hpp"

namespace gambeson {

double TouchMeasure::radius_m() const { return std::sqrt(area_m2 / std::numbers::pi); }

void measureTouch(const Scenario& s, const RecordingReader& recording, Measured& out) {
  if (recording.frameCount() == 0 || s.bodies.empty()) return;
  constexpr int bands = 180 / TouchMeasure::kBandDegrees;
  for (const std::string& name : s.bodies)
    out.touch.push_back({name, 0, 0, 0, std::vector<double>(bands, 0), std::vector<double>(bands, 0)});
  const Model& m = *s.model;
  const Frame frame = recording.frame(recording.frameCount() - 1);
  const Field& pressure = fieldOf(frame, "pressure");
  const std::vector<double> area = sampleAreas(s, frame);
  PlacedBodies placed(s);
  placed.moveTo(frame.time_s);
  const std::vector<Pose> poses = s.bodyPoses(frame.time_s);
  const Vec3 g = m.environment.gravity_m_per_s2;
  const Vec3 up = norm(g) > 0 ? -1 / norm(g) * g : Vec3{0, 0, 1};
  for (int i = 0; i < m.surface.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Vec3 x{frame.positions[3 * k], frame.positions[3 * k + 1], frame.positions[3 * k + 2]};
    const auto [nearest, least] = placed.nearest(x);
    if (nearest < 0) continue;
    const auto body = static_cast<std::size_t>(nearest);
    const double force = pressure.data[k] * area[k];
    const bool near = least < 1.01 * m.layer_m[k];
    if (!near && force == 0) continue;
    TouchMeasure& t = out.touch[body];
    const Vec3 d = x - poses[body].origin;
    const double height = dot(d, up), radius = norm(d - height * up);
    const double degrees = std::atan2(radius, height) * 180 / std::numbers::pi;
    const auto band =
        static_cast<std::size_t>(std::min(bands - 1, static_cast<int>(degrees / TouchMeasure::kBandDegrees)));
    t.normal_N += force;
    t.force_radius_m += force * radius * radius;
    t.band_N[band] += force;
    if (!near) continue;
    t.area_m2 += area[k];
    t.band_m2[band] += area[k];
  }
  for (TouchMeasure& t : out.touch) t.force_radius_m = t.normal_N > 0 ? std::sqrt(t.force_radius_m / t.normal_N) : 0;
}

void writeLatitude(const std::filesystem::path& csv, const std::vector<TouchMeasure>& touch) {
  std::vector<std::string> columns{"angle_deg"};
  for (const TouchMeasure& t : touch)
    columns.insert(columns.end(), {t.body + "_pressure_Pa", t.body + "_area_m2", t.body + "_within_N"});
  std::vector<std::vector<double>> rows;
  std::vector<double> within(touch.size(), 0);
  for (std::size_t b = 0; !touch.empty() && b < touch[0].band_N.size(); ++b) {
    rows.push_back({static_cast<double>((b + 1) * TouchMeasure::kBandDegrees)});
    for (std::size_t t = 0; t < touch.size(); ++t) {
      within[t] += touch[t].band_N[b];
      const double area = touch[t].band_m2[b];
      rows.back().insert(rows.back().end(), {area > 0 ? touch[t].band_N[b] / area : 0, area, within[t]});
    }
  }
  writeCsv(csv, columns, rows);
}

}  // namespace gambeson
