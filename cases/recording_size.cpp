#include "cases/recording_size.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "cases/windows.hpp"

namespace gambeson {
namespace {

constexpr double much_bytes = 10e9;
// Numbers of each sample, control point and vertex of a body in a frame (cases/recorder.cpp).
constexpr double per_sample = 14, per_point = 3, per_vertex = 7;
/// Numbers of a control point in a checkpoint: position, velocity and what the solvers start from.
constexpr double per_point_checkpoint = 12;

std::string sizeText(double bytes) {
  return bytes < 1e9    ? fmt::format("{:.0f} MB", bytes / 1e6)
         : bytes < 1e12 ? fmt::format("{:.3g} GB", bytes / 1e9)
                        : fmt::format("{:.3g} TB", bytes / 1e12);
}

}  // namespace

RecordingSize recordingSize(const Scenario& s, const RecordingLayout& layout) {
  const OutputCase& o = s.definition.output;
  const double duration_s = s.end_s - s.start_s;
  RecordingSize size;
  size.windows = static_cast<double>(Windows(s.start_s, s.end_s, o.window_s).count());
  size.frames = std::floor(duration_s / o.frame_s) + 1;
  size.checkpoints = std::floor(duration_s / o.checkpoint_s) + 1;
  double columns = 0, vertices = 0;
  for (const auto& [table, names] : layout.tables) columns += static_cast<double>(names.size());
  if (!layout.body_triangles.empty()) vertices = 0.5 * static_cast<double>(layout.body_triangles.size());  // Euler
  const double points = s.model->cloth->points(), samples = static_cast<double>(s.model->surface.area_m2.size());
  size.bytes = 8 * columns * size.windows +
               4 * (per_sample * samples + per_point * points + per_vertex * vertices) * size.frames +
               8 * per_point_checkpoint * points * size.checkpoints;
  return size;
}

std::string sizeNote(double bytes, double free_bytes) {
  if (!(bytes > much_bytes) && !(bytes > 0.5 * free_bytes)) return "";
  return fmt::format(
      "the recording is going to take about {}{}; longer output.frame, output.window and "
      "output.checkpoint (of a structure: output.interval, output.shapes) make it smaller",
      sizeText(bytes), std::isfinite(free_bytes) ? fmt::format(", and {} are free there", sizeText(free_bytes)) : "");
}

double freeBytes(const std::filesystem::path& folder) {
  std::error_code error;
  const std::filesystem::space_info space = std::filesystem::space(folder, error);
  return error ? std::numeric_limits<double>::quiet_NaN() : static_cast<double>(space.available);
}

}  // namespace gambeson
