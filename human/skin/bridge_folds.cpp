#include "human/skin/bridge_folds.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/contact/contact_mesh.hpp"
#include "human/body/skin.hpp"
#include "human/skin/overlap.hpp"

namespace gambeson {
namespace {

constexpr int kRounds = 4;  ///< in which what still lacks its room after it was bridged grows by its neighbours
constexpr double kShortest_m = 1e-6;  ///< of a spring

class Net {
 public:
  explicit Net(const TriangleMesh& rest)
      : mesh_(contactMesh(static_cast<int>(rest.vertices.size()), rest.triangles)), number_(rest.vertices.size(), -1) {
    for (const auto& [a, b] : mesh_.edges) {
      const double length = norm(rest.vertices[a] - rest.vertices[b]);
      stiffness_.push_back(1 / std::max(length, kShortest_m));
    }
    findParts();
  }

  /// Vertices of some triangles, but for those of parts that have no others: such a part has no rim.
  std::vector<int> verticesOf(const std::vector<char>& triangles) const {
    std::vector<char> is(part_.size(), 0), all(part_.size(), 1);
    for (std::size_t t = 0; t < triangles.size(); ++t)
      if (triangles[t])
        for (const int v : mesh_.triangles[t]) is[static_cast<std::size_t>(v)] = 1;
    for (std::size_t v = 0; v < is.size(); ++v)
      if (!is[v]) all[static_cast<std::size_t>(part_[v])] = 0;
    std::vector<int> out;
    for (std::size_t v = 0; v < is.size(); ++v)
      if (is[v] && !all[static_cast<std::size_t>(part_[v])]) out.push_back(static_cast<int>(v));
    return out;
  }

  /// Draws the vertices `in` over those beside them.
  void draw(const std::vector<int>& in, std::span<Vec3> x) {
    const int n = static_cast<int>(in.size());
    for (int k = 0; k < n; ++k) number_[in[k]] = k;
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(n, 3);
    for (int k = 0; k < n; ++k)
      for (const int e : mesh_.vertex_edges[in[k]]) {
        const auto [a, b] = mesh_.edges[e];
        const int other = a == in[k] ? b : a;
        entries.emplace_back(k, k, stiffness_[e]);
        if (number_[other] >= 0)
          entries.emplace_back(k, number_[other], -stiffness_[e]);
        else
          for (int c = 0; c < 3; ++c) right(k, c) += stiffness_[e] * x[other][c];
      }
    Eigen::SparseMatrix<double> A(n, n);
    A.setFromTriplets(entries.begin(), entries.end());
    const Eigen::MatrixXd at = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(A).solve(right);
    for (int k = 0; k < n; ++k) x[in[k]] = {at(k, 0), at(k, 1), at(k, 2)};
    for (const int v : in) number_[v] = -1;
  }

  /// The part of the mesh, as far as it hangs together, that each vertex belongs to.
  const std::vector<int>& parts() const { return part_; }

  /// Adds the neighbours of `more` to `tight`.
  void grow(const std::vector<char>& more, std::vector<char>& tight) const {
    for (std::size_t t = 0; t < more.size(); ++t)
      if (more[t])
        for (const int v : mesh_.triangles[t])
          for (const int other : mesh_.vertex_faces[v]) tight[other] = 1;
  }

 private:
  void findParts() {
    part_.assign(number_.size(), -1);
    std::vector<int> ask;
    int count = 0;
    for (std::size_t first = 0; first < part_.size(); ++first) {
      if (part_[first] >= 0) continue;
      ask.assign(1, static_cast<int>(first));
      part_[first] = count;
      while (!ask.empty()) {
        const int v = ask.back();
        ask.pop_back();
        for (const int e : mesh_.vertex_edges[v])
          for (const int w : mesh_.edges[e])
            if (int& part = part_[static_cast<std::size_t>(w)]; part < 0) part = count, ask.push_back(w);
      }
      ++count;
    }
  }

  ContactMesh mesh_;
  std::vector<int> part_;          ///< of the vertices
  std::vector<double> stiffness_;  ///< of the edges
  std::vector<int> number_;        ///< of a vertex among those that are drawn
};

/// Leaves those out that are switched off.
void takeOff(const std::vector<char>& off, std::vector<char>& tight) {
  for (std::size_t t = 0; t < off.size(); ++t)
    if (off[t]) tight[t] = 0;
}

/// What a skin is like at an instant.
struct Instant {
  double time_s = 0;
  std::vector<Pose> poses;
  std::vector<Vec3> bare;
  std::vector<char> tight;
};

/// Triangles whose box comes within `reach_m` of that of some vertices.
std::vector<char> near(const std::vector<std::array<int, 3>>& triangles, const std::vector<int>& vertices,
                       std::span<const Vec3> x, double reach_m) {
  // Boxes of some centimetres, since folds lie far from each other.
  constexpr double side_m = 0.05;
  std::map<std::array<int, 3>, Box> boxes;
  for (const int v : vertices) {
    const Vec3& p = x[v];
    const auto at = [&](double c) { return static_cast<int>(std::floor(c / side_m)); };
    boxes[{at(p.x), at(p.y), at(p.z)}].add(p);
  }
  std::vector<char> out(triangles.size(), 0);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    Box box;
    for (const int v : triangles[t]) box.add(x[v]);
    box = box.grown(reach_m);
    out[t] = std::any_of(boxes.begin(), boxes.end(), [&](const auto& b) { return overlap(b.second, box); });
  }
  return out;
}

/// Bridges one skin, instant after instant: three of them are in hand at a time.
class Bridging {
 public:
  Bridging(const Human& human, double room_m)
      : human_(human),
        skin_(*human.skin),
        triangles_(skin_.rest.triangles),
        room_m_(room_m),
        net_(skin_.rest),
        search_(triangles_, static_cast<int>(skin_.rest.vertices.size())) {}

  /// The skin in a posture; `before`: one whose answer stands where nothing has moved.
  Instant look(const Posture& p, double time_s, const Instant* before) {
    Instant now{.time_s = time_s,
                .poses = linkPoses(human_.skeleton, p.q, p.root),
                .bare = std::vector<Vec3>(skin_.rest.vertices.size()),
                .tight = {}};
    skinPositions(skin_, now.poses, now.bare);
    now.tight = before && now.bare == before->bare ? before->tight : tightAt(now.bare, room_m_, {});
    return now;
  }

  /// Adds the ways of an instant whose skin lacks room where `lacks`.
  void add(const Instant& now, const std::vector<char>& lacks, BridgedFolds& out, BridgingReport& report) {
    if (lacks != lacks_ || now.bare != bare_) {
      lacks_ = lacks;
      bare_ = now.bare;
      draw(now, report);
    }
    out.first.push_back(static_cast<int>(out.vertex.size()));
    for (std::size_t v = 0; v < bare_.size(); ++v) {
      const Vec3 d = bridged_[v] - bare_[v];
      if (d == Vec3{}) continue;
      report.farthest_m = std::max(report.farthest_m, norm(d));
      const Mat3& R = now.poses[static_cast<std::size_t>(skin_.segment[v])].rotation;
      out.vertex.push_back(static_cast<int>(v));
      out.way.push_back({dot(R.a, d), dot(R.b, d), dot(R.c, d)});
    }
  }

 private:
  std::vector<char> tightAt(std::span<const Vec3> x, double room_m, std::span<const char> among) {
    std::vector<char> tight = search_.at(x, room_m, among).triangles;
    takeOff(skin_.off, tight);
    return tight;
  }

  void draw(const Instant& now, BridgingReport& report) {
    bridged_ = bare_;
    std::vector<char> lacks = lacks_, around;
    for (int round = 0; round < kRounds; ++round) {
      const std::vector<int> in = net_.verticesOf(lacks);
      if (in.empty()) break;
      bridged_ = bare_;
      net_.draw(in, bridged_);
      around = near(triangles_, in, bridged_, 4 * room_m_);
      const std::vector<char> still = tightAt(bridged_, room_m_, around);
      if (std::find(still.begin(), still.end(), 1) == still.end()) break;
      net_.grow(still, lacks);
    }
    if (around.empty()) return;
    const double left_m2 = areaOf(tightAt(bridged_, 0, around), triangles_, bridged_);
    if (left_m2 > report.left_m2) report.left_m2 = left_m2, report.left_time_s = now.time_s;
  }

  const Human& human_;
  const Skin& skin_;
  const std::vector<std::array<int, 3>>& triangles_;
  double room_m_;
  Net net_;
  OverlapSearch search_;
  std::vector<Vec3> bare_, bridged_;  ///< of the last instant that was drawn
  std::vector<char> lacks_;
};

}  // namespace

std::vector<char> wholeParts(const TriangleMesh& mesh, const std::vector<char>& triangles) {
  const Net net(mesh);
  const auto partOf = [&](std::size_t t) { return static_cast<std::size_t>(net.parts()[mesh.triangles[t][0]]); };
  std::vector<char> whole(mesh.vertices.size(), 1), out(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (!triangles[t]) whole[partOf(t)] = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) out[t] = whole[partOf(t)];
  return out;
}

BridgedFolds bridgeFolds(const Human& human, const std::function<Posture(double)>& posture, double begin_s,
                         double end_s, double every_s, double room_m, BridgingReport& report) {
  const std::vector<std::array<int, 3>>& triangles = human.skin->rest.triangles;
  BridgedFolds out;
  out.begin_s = begin_s;
  const int count = static_cast<int>(std::ceil((end_s - begin_s) / every_s - 1e-9)) + 1;
  out.every_s = count > 1 ? (end_s - begin_s) / (count - 1) : every_s;
  report = {};
  report.instants = count;
  Bridging bridging(human, room_m);
  std::vector<char> ever(triangles.size(), 0);
  const auto look = [&](int i, const Instant* before) {
    const double t = begin_s + i * out.every_s;
    Instant now = bridging.look(posture(t), t, before);
    const double area = areaOf(now.tight, triangles, now.bare);
    report.tight += area > 0;
    if (area > report.largest_m2) report.largest_m2 = area, report.largest_time_s = t;
    for (std::size_t k = 0; k < ever.size(); ++k) ever[k] |= now.tight[k];
    return now;
  };
  Instant before, now = look(0, nullptr), after;
  for (int i = 0; i < count; ++i) {
    if (i + 1 < count) after = look(i + 1, &now);
    std::vector<char> lacks = now.tight;
    for (std::size_t k = 0; k < lacks.size(); ++k)
      lacks[k] |= (i > 0 && before.tight[k]) || (i + 1 < count && after.tight[k]);
    bridging.add(now, lacks, out, report);
    before = std::move(now);
    now = std::move(after);
  }
  out.first.push_back(static_cast<int>(out.vertex.size()));
  report.links = linksOf(ever, human);
  return out;
}

}  // namespace gambeson
