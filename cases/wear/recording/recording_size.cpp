#include "cases/wear/recording/recording_size.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "cases/runs/disk_space.hpp"
#include "cases/wear/recording/windows.hpp"

namespace gambeson {
namespace {

// Numbers of each sample, control point and vertex of a body in a frame (cases/wear/recording/recorder.cpp).
constexpr double per_sample = 14, per_point = 3, per_vertex = 7;
/// Numbers of a control point in a checkpoint: position, velocity and what the solvers start from.
constexpr double per_point_checkpoint = 12;

}  // namespace

RecordingSize recordingSize(const Scenario& s, const RecordingLayout& layout) {
  const OutputCase& o = s.definition.output;
  const double duration_s = s.end_s - s.start_s;
  RecordingSize size;
  size.windows = static_cast<double>(Windows(s.start_s, s.end_s, o.window_s).count());
  size.frames = std::floor(duration_s / o.frame_s) + 1;
  size.checkpoints = std::floor(duration_s / o.checkpoint_s) + 1;
  double columns = 0, vertices = 0, scene = 0;
  for (const auto& [table, names] : layout.tables) columns += static_cast<double>(names.size());
  for (const auto& [name, values] : layout.scene)
    scene += static_cast<double>(values.reals.size() + values.integers.size());
  if (!layout.body_triangles.empty()) vertices = 0.5 * static_cast<double>(layout.body_triangles.size());  // Euler
  const double points = s.model->cloth->points(), samples = static_cast<double>(s.model->surface.area_m2.size());
  size.bytes = 8 * columns * size.windows +
               4 * (per_sample * samples + per_point * points + per_vertex * vertices) * size.frames +
               8 * per_point_checkpoint * points * size.checkpoints + 8 * scene;
  return size;
}

}  // namespace gambeson
