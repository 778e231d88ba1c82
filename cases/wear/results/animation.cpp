#include "cases/wear/results/animation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/render/colormap.hpp"
#include "analysis/render/shapes.hpp"
#include "cases/wear/results/results.hpp"
#include "cases/wear/results/shown.hpp"
#include "core/error.hpp"
#include "human/body/skin.hpp"

namespace gambeson {
namespace {

constexpr double rounding = 1e-9;

Placement inFrame(const Pose& X_WF, const Placement& X_W) {
  return {transpose(X_WF.rotation) * X_W.rotation, transposeTimes(X_WF.rotation, X_W.origin - X_WF.origin), X_W.scale};
}

bool same(const Placement& a, const Placement& b) {
  const Mat3 &R = a.rotation, &S = b.rotation;
  return norm(a.origin - b.origin) < rounding && std::abs(a.scale - b.scale) < rounding &&
         norm(R.a - S.a) + norm(R.b - S.b) + norm(R.c - S.c) < rounding;
}

/// What stays where it is needs one place.
MovedNode node(std::string name, int parent, std::vector<Placement> at) {
  if (std::all_of(at.begin(), at.end(), [&](const Placement& X) { return same(X, at[0]); })) at.resize(1);
  return {std::move(name), parent, std::move(at)};
}

/// The four largest weights of each vertex, scaled to add up to 1.
SkinnedMesh skinnedOf(const Skin& skin, const std::vector<std::array<int, 3>>& triangles) {
  SkinnedMesh out{"skin", skin.rest.vertices, triangles, {}, {}, {}, kBodyColor};
  for (std::size_t l = 0; l < skin.bind.size(); ++l) {
    out.nodes.push_back(static_cast<int>(l));
    out.inverse_bind.push_back(inverse(skin.bind[l]));
  }
  for (std::size_t v = 0; v < skin.rest.vertices.size(); ++v) {
    std::vector<std::pair<double, int>> links;
    for (int k = skin.first[v]; k < skin.first[v + 1]; ++k)
      links.emplace_back(skin.weight[static_cast<std::size_t>(k)], skin.link[static_cast<std::size_t>(k)]);
    std::sort(links.begin(), links.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    if (links.size() > SkinnedMesh::kNodes) links.resize(SkinnedMesh::kNodes);
    double sum = 0;
    for (const auto& [weight, link] : links) sum += weight;
    auto& weights = out.weights.emplace_back();
    for (std::size_t k = 0; k < links.size(); ++k)
      weights[k] = {links[k].second, static_cast<float>(links[k].first / sum)};
  }
  return out;
}

std::vector<float> floatsOf(std::span<const Vec3> x) {
  std::vector<float> out;
  out.reserve(3 * x.size());
  for (const Vec3& v : x)
    for (int c = 0; c < 3; ++c) out.push_back(static_cast<float>(v[c]));
  return out;
}

class Maker {
 public:
  Maker(const Scenario& s, const RecordingReader& recording, const AnimationOptions& o)
      : s_(s), recording_(recording), o_(o), frames_(shownFrames(recording, o.frames)) {
    AnimatedScene& scene = out_.scene;
    scene.title = s.definition.name;
    for (const int f : frames_) scene.time_s.push_back(recording.time(f));
    scene.notes.emplace_back("start_s", fmt::format("{}", scene.time_s[0]));
  }

  Animation make() {
    addLinks();
    for (std::size_t o = 0; o < s_.model->obstacles.size(); ++o)
      s_.model->obstacles[o].deforms ? addDeforming(o) : addRigid(o);
    addGarments();
    return std::move(out_);
  }

 private:
  const std::vector<double>& times() const { return out_.scene.time_s; }

  /// Nodes of the same indices as the links.
  void addLinks() {
    if (!s_.human) return;
    const Skeleton& k = s_.human->skeleton;
    for (const double t : times()) {
      const Posture posture = s_.stage->postureAt(t);
      links_.push_back(linkPoses(k, posture.q, posture.root));
    }
    for (std::size_t l = 0; l < k.links.size(); ++l) {
      const int joint = k.links[l].parent_joint,
                parent = joint < 0 ? -1 : k.joints[static_cast<std::size_t>(joint)].parent;
      std::vector<Placement> at;
      for (const std::vector<Pose>& X_WL : links_) {
        const Placement X{X_WL[l].rotation, X_WL[l].origin, 1};
        at.push_back(parent < 0 ? X : inFrame(X_WL[static_cast<std::size_t>(parent)], X));
      }
      out_.scene.nodes.push_back(node(k.links[l].name, parent, std::move(at)));
    }
  }

  void addRigid(std::size_t o) {
    const int body = s_.body_of_obstacle[o];
    const int link = s_.human && body < static_cast<int>(s_.human->skeleton.links.size()) ? body : -1;
    const std::string name = link >= 0 && o < s_.human->shapes.size() && !s_.human->shapes[o].name.empty()
                                 ? s_.human->shapes[o].name
                                 : s_.bodies[static_cast<std::size_t>(body)];
    std::vector<Placement> at;
    for (std::size_t f = 0; f < times().size(); ++f) {
      Placement X = s_.obstaclePlacements(times()[f])[o];
      if (s_.stage->leavesOut(static_cast<int>(o), times()[f])) X.scale = 0;
      at.push_back(link < 0 ? X : inFrame(links_[f][static_cast<std::size_t>(link)], X));
    }
    out_.scene.fixed.push_back(
        {name, static_cast<int>(out_.scene.nodes.size()), meshOf(s_.model->obstacles[o].shape, {}, kBodyColor)});
    out_.scene.nodes.push_back(node(name, link, std::move(at)));
  }

  void addDeforming(std::size_t o) {
    const auto& triangles = std::get<TriangleMesh>(s_.model->obstacles[o].shape).triangles;
    const int body = s_.body_of_obstacle[o];
    const auto at = [&](double t) {
      const DeformedVertices all = deformedVertices(*s_.model, *s_.stage, t);
      const std::span<const Vec3> x = all[o];
      return std::vector<Vec3>(x.begin(), x.end());
    };
    const bool linear =
        body < 0 && s_.human->skin->bends.empty() && s_.stage->bridged.empty() && times()[0] > -rounding;
    if (linear && o_.skins) {
      const SkinnedMesh skin = skinnedOf(*s_.human->skin, triangles);
      for (std::size_t f = 0; f < times().size(); ++f) {
        const std::vector<Vec3> x = positionsOf(skin, worldOf(out_.scene, f));
        const auto recorded = at(times()[f]);
        for (std::size_t v = 0; v < x.size(); ++v)
          out_.skin_error_m = std::max(out_.skin_error_m, norm(x[v] - recorded[v]));
      }
      out_.scene.skinned.push_back(skin);
      return;
    }
    MovingMesh mesh{body < 0 ? "skin" : s_.bodies[static_cast<std::size_t>(body)], triangles, {}, {}, kBodyColor};
    for (const double t : times()) {
      const auto x = at(t);
      mesh.at.push_back(floatsOf(std::span(x.begin(), x.end())));
    }
    out_.scene.moving.push_back(std::move(mesh));
  }

  void addGarments() {
    const std::vector<WornMesh> garments = wornMeshes(s_);
    const std::vector<Color> colors = colorsOfSamples();
    for (const WornMesh& g : garments) {
      MovingMesh mesh{g.name, g.triangles, {}, {}, g.color};
      if (!colors.empty())
        for (const int sample : g.samples) {
          const Color& c = colors[static_cast<std::size_t>(sample)];
          mesh.colors.push_back(c.r < 0 ? g.color : c);
        }
      out_.scene.moving.push_back(std::move(mesh));
    }
    const std::size_t first = out_.scene.moving.size() - garments.size();
    for (const int f : frames_) {
      const Frame frame = recording_.frame(f);
      for (std::size_t g = 0; g < garments.size(); ++g) {
        std::vector<float>& x = out_.scene.moving[first + g].at.emplace_back();
        x.reserve(3 * garments[g].samples.size());
        for (const int sample : garments[g].samples)
          for (std::size_t c = 0; c < 3; ++c) x.push_back(frame.positions.at(3 * static_cast<std::size_t>(sample) + c));
      }
    }
  }

  /// None for `plain`; negative where a sample has no value.
  std::vector<Color> colorsOfSamples() {
    std::vector<Color> colors;
    if (o_.field == PictureField::plain) return colors;
    const FieldWords words = fieldWords(o_.field);
    const Frame frame = recording_.frame(o_.color_frame);
    const double highest = words.scale * fieldRange(s_, recording_, o_.field), top = highest > 0 ? highest : 1;
    const ColorTable table = makeColorTable();
    for (const double v : shownOf(s_, frame, o_.field))
      colors.push_back(std::isfinite(v) ? colorAt(table, v / top) : Color{-1, -1, -1});
    out_.scene.notes.emplace_back(
        "colors", fmt::format("{} at {:.3f} s, from 0 (dark violet) to {:g} (yellow)", words.title, frame.time_s, top));
    return colors;
  }

  const Scenario& s_;
  const RecordingReader& recording_;
  const AnimationOptions& o_;
  std::vector<int> frames_;
  std::vector<std::vector<Pose>> links_;  ///< at each time
  Animation out_;
};

}  // namespace

std::vector<int> shownFrames(const RecordingReader& recording, int most) {
  std::vector<int> all;
  for (const bool motion : {true, false}) {
    for (int k = 0; k < recording.frameCount(); ++k)
      if (!motion || recording.time(k) > -rounding) all.push_back(k);
    if (!all.empty()) break;
  }
  if (all.empty()) throw RunError("the recording has no frames");
  const std::size_t count = all.size();
  if (most <= 0 || count <= static_cast<std::size_t>(most)) return all;
  if (most == 1) return {all.back()};
  const auto steps = static_cast<std::size_t>(most) - 1;
  std::vector<int> some;
  for (std::size_t k = 0; k <= steps; ++k) some.push_back(all[(k * (count - 1) + steps / 2) / steps]);
  return some;
}

std::size_t animatedFrames(const RecordingReader& recording) { return shownFrames(recording, 0).size(); }

Animation animationOf(const Scenario& s, const RecordingReader& recording, const AnimationOptions& o) {
  return Maker(s, recording, o).make();
}

}  // namespace gambeson
