#include "cases/wear/results/frame_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/render/geometry.hpp"
#include "analysis/render/shapes.hpp"
#include "analysis/ticks.hpp"
#include "cases/wear/results/force_clusters.hpp"
#include "cases/wear/results/write.hpp"

namespace gambeson {
namespace {

constexpr Color arrow_color{0.80f, 0.08f, 0.10f};
constexpr Color inside_color{1.0f, 0.0f, 0.58f};
/// Forces that point this much at the viewer press on the far side: the picture would show them through the body.
constexpr double far_side = 0.3;
/// Cloth that is seen edge on would have to come nearer without end.
constexpr double least_slope = 0.25;
/// Marks stand that much before their cloth.
constexpr double mark_m = 0.2e-3;

/// Arrows end where the body is pushed, so that they stay outside of it; one of `most_N` is `longest_m` long. They
/// have a legend where there are any, which says what they push `on`.
void addArrows(Scene& scene, const std::vector<ForceCluster>& clusters, const Vec3& towards, double most_N,
               double longest_m, const char* on) {
  if (!(most_N > 0)) return;
  const double m_per_N = longest_m / most_N;
  for (const ForceCluster& c : clusters) {
    if (norm(c.force) < kLeastArrow * most_N || dot(c.force, towards) > far_side * norm(c.force)) continue;
    const Vec3 tip = c.middle();
    scene.arrows.push_back({tip - m_per_N * c.force, tip, arrow_color});
  }
  if (scene.arrows.empty()) return;
  const double legend_N = roundedUp(0.5 * most_N);
  scene.arrow_legend = fmt::format("{0:g} N on {1:g} x {1:g} cm of {2}", legend_N, 100 * kArrowCell_m, on);
  scene.arrow_legend_length_m = legend_N * m_per_N;
}

/// Moves vertices towards the viewer, so that each gets `lift_m` before where it is across its surface. The picture
/// of the vertices stays in its place.
void lift(RenderMesh& mesh, const std::vector<double>& lift_m, const Vec3& towards) {
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    mesh.vertices[v] += lift_m[v] / std::max(std::abs(dot(mesh.normals[v], towards)), least_slope) * towards;
}

/// The triangles of which a vertex is marked, in their own colour; none where there are none.
std::optional<RenderMesh> markedPart(const RenderMesh& mesh, const std::vector<char>& marked, const Vec3& towards) {
  RenderMesh part{{}, {}, {}, inside_color, false, {}};
  for (const auto& t : mesh.triangles)
    if (std::any_of(t.begin(), t.end(), [&](int v) { return marked[static_cast<std::size_t>(v)] != 0; }))
      part.triangles.push_back(t);
  if (part.triangles.empty()) return std::nullopt;
  part.vertices = mesh.vertices, part.normals = mesh.normals;
  lift(part, std::vector<double>(part.vertices.size(), mark_m), towards);
  return part;
}

RenderMesh meshOfObstacle(const Scenario& s, const PlacedBodies& placed, std::size_t o) {
  const auto& obstacle = s.model->obstacles[o];
  return meshOf(obstacle.deforms ? Shape(placed.deformedMesh(static_cast<int>(o))) : obstacle.shape,
                placed.placements()[o], kBodyColor);
}

}  // namespace

std::array<Vec3, 2> shownBox(const Scenario& s, const PlacedBodies& placed, std::span<const Vec3> x,
                             PictureAround around) {
  std::array<Vec3, 2> box = boxOf(x, 0);
  if (around == PictureAround::garment || !s.human) return box;
  const int links = static_cast<int>(s.human->skeleton.links.size());
  for (std::size_t o = 0; o < s.model->obstacles.size(); ++o) {
    if (s.body_of_obstacle[o] >= links) continue;
    const std::array<Vec3, 2> own = boxOf(meshOfObstacle(s, placed, o).vertices, 0);
    for (int c = 0; c < 3; ++c) {
      box[0][c] = std::min(box[0][c], own[0][c]);
      box[1][c] = std::max(box[1][c], own[1][c]);
    }
  }
  return box;
}

double pictureMargin(std::span<const Vec3> x) {
  const std::array<Vec3, 2> garments = boxOf(x, 0);
  return 0.06 * norm(garments[1] - garments[0]);
}

std::vector<Vec3> positionsOf(const Frame& frame) {
  std::vector<Vec3> x(frame.positions.size() / 3);
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = {frame.positions[3 * i], frame.positions[3 * i + 1], frame.positions[3 * i + 2]};
  return x;
}

Vec3 upOf(const Scenario& s) {
  const Vec3 g = s.model->environment.gravity_m_per_s2;
  return norm(g) > 0 ? -1.0 / norm(g) * g : Vec3{0, 0, 1};
}

FrameScenes::FrameScenes(const Scenario& s, const RecordingReader& recording)
    : s_(s), recording_(recording), placed_(s), worn_(wornMeshes(s)) {
  for (const double layer : s.model->layer_m) touching_m_ = std::max(touching_m_, layer);
}

std::vector<double> FrameScenes::depths(const std::vector<Vec3>& x) const {
  std::vector<double> depth(x.size(), 0);
  std::vector<Contact> inside;
  MeshCandidates none;  // whether a point is inside is asked of whole meshes
  none.first.assign(x.size() + 1, 0);
  s_.model->proximity->near(placed_.placements(), placed_.placements(), x, std::vector<double>(x.size(), 0), inside,
                            &none, placed_.surfaces());
  for (const Contact& c : inside) {
    double& d = depth[static_cast<std::size_t>(c.sample)];
    d = std::max(d, -c.gap_m);
  }
  return depth;
}

void FrameScenes::addBodies(Scene& scene, double time_s) const {
  for (std::size_t o = 0; o < s_.model->obstacles.size(); ++o) {
    if (s_.stage->leavesOut(static_cast<int>(o), time_s)) continue;
    scene.meshes.push_back(meshOfObstacle(s_, placed_, o));
  }
}

ColorNote FrameScenes::note() const {
  return {inside_color,
          fmt::format("inside {} by more than {:g} mm", s_.human ? "the body" : "an obstacle", 1e3 * kPenetration_m)};
}

std::optional<ColorNote> FrameScenes::noteOf(int index) {
  const Frame frame = recording_.frame(index);
  placed_.moveTo(frame.time_s);
  const std::vector<double> depth = depths(positionsOf(frame));
  if (!(*std::max_element(depth.begin(), depth.end()) > kPenetration_m)) return std::nullopt;
  return note();
}

DrawnFrame FrameScenes::at(int index, const PictureCase& picture, const Viewpoint& from, const PictureScale& scale,
                           double low) {
  const Frame frame = recording_.frame(index);
  const std::vector<Vec3> x = positionsOf(frame);
  const FieldWords words = fieldWords(picture.field);
  DrawnFrame drawn{{}, {from}};
  Scene& scene = drawn.scene;
  scene.up = upOf(s_);
  scene.view = picture.view;
  const Vec3 towards = axesOf(from, scene.up).towards;
  placed_.moveTo(frame.time_s);
  addBodies(scene, frame.time_s);
  const std::vector<double> scalars = shownOf(s_, frame, picture.field);
  if (!scalars.empty()) {
    // Friction falls from 100 % of new cloth: its least is what tells.
    const bool falls = picture.field == PictureField::friction;
    const auto [least, most] = std::minmax_element(scalars.begin(), scalars.end());
    scene.bar = ColorBar{
        fmt::format("{}; here {} {}", words.title, falls ? "down to" : "up to", formatBrief(falls ? *least : *most, 2)),
        low, words.scale * scale.high};
  }
  const std::vector<double> depth = depths(x);
  for (const WornMesh& worn : worn_) {
    RenderMesh cloth{{}, worn.triangles, {}, worn.color, true, {}};
    std::vector<double> lift_m;
    std::vector<char> inside;
    for (const int sample : worn.samples) {
      const auto i = static_cast<std::size_t>(sample);
      cloth.vertices.push_back(x[i]);
      if (!scalars.empty()) cloth.scalars.push_back(scalars[i]);
      lift_m.push_back(touching_m_ + depth[i]);
      inside.push_back(depth[i] > kPenetration_m);
    }
    cloth.normals = smoothNormals(cloth);
    lift(cloth, lift_m, towards);
    std::optional<RenderMesh> marked = markedPart(cloth, inside, towards);
    scene.meshes.push_back(std::move(cloth));
    if (!marked) continue;
    scene.meshes.push_back(std::move(*marked));
    drawn.shot.note = note();
  }
  const std::array<Vec3, 2> shown = shownBox(s_, placed_, x, picture.around);
  const Vec3 middle = 0.5 * (shown[0] + shown[1]);
  addArrows(scene, forceClusters(placed_, frame, x), towards, scale.most_N, 0.14 * scale.size_m,
            s_.human ? "body" : "obstacle");
  scene.focus = {middle - 0.5 * scale.box_m, middle + 0.5 * scale.box_m};
  scene.title = s_.definition.name;
  scene.subtitle = captionOf(picture, frame.time_s, s_.definition.comfort.sensor_m);
  return drawn;
}

}  // namespace gambeson
