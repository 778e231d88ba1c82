/// Detail of results.hpp: pictures of a recorded frame.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "analysis/ticks.hpp"
#include "cases/wear/results/body_map.hpp"
#include "cases/wear/results/force_clusters.hpp"
#include "cases/wear/results/frame_scenes.hpp"
#include "cases/wear/results/write.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

double percentile99(const std::vector<double>& values, const std::vector<double>& areas, double unit) {
  return values.empty() ? 0 : roundedUp(unit * weightedPercentile(values, areas, 0.99)) / unit;
}

/// A small thick part is what a picture of the thickness is for, so the colours reach the largest.
double largestShown(const std::vector<double>& values, double unit) {
  return values.empty() ? 0 : roundedUp(unit * *std::max_element(values.begin(), values.end())) / unit;
}

/// "the front right", "above".
std::string wordsOf(View view) {
  std::string words = viewNames()[static_cast<std::size_t>(view)];
  std::replace(words.begin(), words.end(), '_', ' ');
  return view == View::above ? words : "the " + words;
}

/// "30\u00b0 to the left of the front, 10\u00b0 up".
std::string wordsOf(const Viewpoint& from) {
  std::string words = "the front";
  if (from.azimuth_deg != 0)
    words = fmt::format("{:g}\u00b0 to the {} of the front", std::abs(from.azimuth_deg),
                        from.azimuth_deg > 0 ? "left" : "right");
  if (from.elevation_deg != 0)
    words += fmt::format(", {:g}\u00b0 {}", std::abs(from.elevation_deg), from.elevation_deg > 0 ? "up" : "down");
  return words;
}

}  // namespace

std::vector<PictureCase> picturesOf(const Case& c) {
  PictureCase usual;
  usual.field = PictureField::plain;
  usual.when = c.human ? PictureTime::peak : PictureTime::end;
  return c.output.pictures.value_or(std::vector{usual});
}

PictureSize sizeOf(const Scenario& s, const PictureCase& picture) {
  return sizeOf(picture, s.human ? kUpright : PictureSize{});
}

double fieldRange(const Scenario& s, const RecordingReader& recording, PictureField field) {
  if (field == PictureField::plain) return 0;
  if (field == PictureField::body_pressure) {
    if (!s.human) throw RunError("there is no human whose body bears pressure");
    const BodyMap map(s, s.definition.comfort.sensor_m);
    const BodyLoads loads = bodyLoads(map, recording, countedFrom(s, recording));
    return 1e3 * roundedUp(1e-3 * *std::max_element(loads.peak_Pa.begin(), loads.peak_Pa.end()));
  }
  const FieldWords words = fieldWords(field);
  if (field == PictureField::thickness) return largestShown(thicknessOf(s), words.scale);
  std::vector<double> values, weights;
  for (const bool motion : {true, false}) {
    for (int k = 0; k < recording.frameCount(); ++k) {
      if (motion && !(recording.time(k) > 1e-9)) continue;
      for (const float v : recording.sampleField(k, words.field).data) values.push_back(v);
      weights.insert(weights.end(), s.model->surface.area_m2.begin(), s.model->surface.area_m2.end());
    }
    if (!values.empty()) break;
  }
  return percentile99(values, weights, words.scale);
}

void PictureScale::include(const PictureScale& other) {
  high = std::max(high, other.high);
  most_N = std::max(most_N, other.most_N);
  size_m = std::max(size_m, other.size_m);
  for (int c = 0; c < 3; ++c) box_m[c] = std::max(box_m[c], other.box_m[c]);
}

PictureScale scaleOf(const Scenario& s, const RecordingReader& recording, int index, const PictureCase& picture) {
  const PictureField field = picture.field;
  PictureScale scale;
  if (field == PictureField::body_pressure) return scale;  // of the whole motion: fieldRange
  const Frame frame = recording.frame(index);
  const std::vector<Vec3> x = positionsOf(frame);
  PlacedBodies placed(s);
  placed.moveTo(frame.time_s);
  const std::array<Vec3, 2> shown = shownBox(s, placed, x, picture.around);
  scale.size_m = norm(shown[1] - shown[0]);
  const double margin_m = pictureMargin(x);
  scale.box_m = shown[1] - shown[0] + 2 * Vec3{margin_m, margin_m, margin_m};
  scale.most_N = largestForce(forceClusters(placed, frame, x));
  if (field == PictureField::plain) return scale;
  const FieldWords words = fieldWords(field);
  if (field == PictureField::thickness) {
    scale.high = largestShown(thicknessOf(s), words.scale);
    return scale;
  }
  std::vector<double> values;
  for (const float v : fieldOf(frame, words.field).data) values.push_back(v);
  scale.high = percentile99(values, s.model->surface.area_m2, words.scale);
  return scale;
}

std::string captionOf(const PictureCase& picture, double time_s, double sensor_m,
                      const std::optional<Viewpoint>& from) {
  const std::string view = from ? wordsOf(*from) : wordsOf(picture.view);
  std::string what = fieldWords(picture.field).word;
  what[0] = static_cast<char>(what[0] - 'a' + 'A');
  if (picture.field == PictureField::body_pressure)
    return fmt::format("{} (the mean over {:g} mm), at each place over the motion, seen from {}; posture at {:.2f} s",
                       what, 1e3 * sensor_m, view, time_s);
  if (picture.field == PictureField::pressure)
    what += fmt::format(" (comfort goes by the mean over {:g} mm)", 1e3 * sensor_m);
  return fmt::format("{} at {:.2f} s{}, seen from {}", what, time_s,
                     picture.when == PictureTime::peak ? " (the peak)" : "", view);
}

int frameOf(const RecordingReader& recording, const Measured& m, const PictureCase& picture) {
  const int count = recording.frameCount();
  if (count == 0) throw RunError("the recording has no frames");
  const double wanted = picture.when == PictureTime::at ? picture.time_s : m.peak_time_s;
  if (picture.when == PictureTime::end) return count - 1;
  int best = 0;
  for (int k = 1; k < count; ++k)
    if (std::abs(recording.time(k) - wanted) < std::abs(recording.time(best) - wanted)) best = k;
  return best;
}

void renderBody(const Scenario& s, const BodyMap& map, const BodyLoads& loads, double time_s,
                const PictureCase& picture, double high_Pa, const std::filesystem::path& png) {
  Scene scene;
  std::size_t v = 0;
  std::vector<Vec3> touched;
  for (TriangleMesh& mesh : map.meshes(time_s)) {
    RenderMesh body{std::move(mesh.vertices), std::move(mesh.triangles), {}, kBodyColor, false, {}};
    for (const Vec3& x : body.vertices) {
      const double p = loads.peak_Pa[v++];
      body.scalars.push_back(p > 0 ? 1e-3 * p : std::numeric_limits<double>::quiet_NaN());
      if (p > 0) touched.push_back(x);
    }
    scene.meshes.push_back(std::move(body));
  }
  const FieldWords words = fieldWords(PictureField::body_pressure);
  scene.bar = ColorBar{fmt::format(fmt::runtime(words.title), 1e3 * s.definition.comfort.sensor_m), 0, 1e-3 * high_Pa};
  if (!touched.empty()) {
    const std::array<Vec3, 2> box = boxOf(touched, 0);
    scene.focus = boxOf(touched, 0.06 * norm(box[1] - box[0]));
  }
  scene.title = s.definition.name;
  scene.subtitle = captionOf(picture, time_s, s.definition.comfort.sensor_m);
  scene.view = picture.view;
  scene.up = upOf(s);
  const PictureSize size = sizeOf(s, picture);
  writePng(render(scene, size.width, size.height), png);
}

void renderFrame(const Scenario& s, const RecordingReader& recording, int index, const PictureCase& picture,
                 const PictureScale& scale, const std::filesystem::path& png) {
  if (picture.field == PictureField::body_pressure) {
    if (!s.human) throw RunError("there is no human whose body bears pressure");
    const BodyMap map(s, s.definition.comfort.sensor_m);
    renderBody(s, map, bodyLoads(map, recording, countedFrom(s, recording)), recording.time(index), picture, scale.high,
               png);
    return;
  }
  const DrawnFrame drawn = FrameScenes(s, recording).at(index, picture, picture.view, scale);
  const PictureSize size = sizeOf(s, picture);
  const Camera camera = fitted(drawn.scene, drawn.shot, size.width, size.height);
  writePng(render(drawn.scene, drawn.shot, camera, size.width, size.height), png);
}

}  // namespace gambeson
