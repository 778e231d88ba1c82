#include "cases/wear/recording/skin_ledger.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <queue>

#include "analysis/torque.hpp"
#include "human/body/skin.hpp"

namespace gambeson {
namespace {

/// What the table holds of a joint, in the order of row().
constexpr std::array<const char*, SkinLedger::kPerJoint> kParts{"", "_segments", "_proximal", "_distal", "_normal"};
constexpr double kDifference = 1e-4;  ///< of a joint's value [rad, m]: errors of 1e-8 of the radius

/// Neighbours along the edges of the skin, with lengths in the bind posture.
struct Net {
  struct End {
    int vertex;
    double length_m;
  };
  std::vector<std::vector<End>> ends;

  explicit Net(const TriangleMesh& mesh) : ends(mesh.vertices.size()) {
    for (const auto& t : mesh.triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        const int a = t[k], b = t[(k + 1) % 3];
        const double l = norm(mesh.vertices[static_cast<std::size_t>(a)] - mesh.vertices[static_cast<std::size_t>(b)]);
        ends[static_cast<std::size_t>(a)].push_back({b, l});
        ends[static_cast<std::size_t>(b)].push_back({a, l});
      }
  }

  /// Whether each vertex is within `reach` along the edges of one that is `in`.
  std::vector<char> within(const std::vector<char>& in, double reach) const {
    std::vector<double> far(ends.size(), std::numeric_limits<double>::infinity());
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (std::size_t v = 0; v < in.size(); ++v)
      if (in[v]) far[v] = 0, queue.push({0, static_cast<int>(v)});
    while (!queue.empty()) {
      const auto [d, v] = queue.top();
      queue.pop();
      if (d > far[static_cast<std::size_t>(v)]) continue;
      for (const End& e : ends[static_cast<std::size_t>(v)]) {
        const double to = d + e.length_m;
        if (to > reach || !(to < far[static_cast<std::size_t>(e.vertex)])) continue;
        far[static_cast<std::size_t>(e.vertex)] = to;
        queue.push({to, e.vertex});
      }
    }
    std::vector<char> near(in.size());
    for (std::size_t v = 0; v < in.size(); ++v) near[v] = far[v] <= reach;
    return near;
  }
};

}  // namespace

SkinLedger::SkinLedger(const Scenario& scenario)
    : scenario_(scenario),
      skin_(*scenario.human->skin),
      received_(skin_.rest.vertices.size()),
      pressing_(skin_.rest.vertices.size()),
      normal_(skin_.rest.vertices.size(), 0) {
  const Human& human = *scenario.human;
  const std::size_t links = human.skeleton.links.size(), vertices = skin_.rest.vertices.size();
  const TorqueCounting counting = scenario.definition.analysis.counting == Counting::all_distal
                                      ? TorqueCounting::all_distal
                                      : TorqueCounting::distal_segment;
  const Net net(skin_.rest);
  for (const int j : movingJoints(human.skeleton)) {
    JointFacts f;
    f.joint = j;
    f.distal.assign(links, 0);
    f.counted.assign(links, 0);
    for (const int l : countedLinks(human, j, TorqueCounting::all_distal)) f.distal[static_cast<std::size_t>(l)] = 1;
    for (const int l : countedLinks(human, j, counting)) f.counted[static_cast<std::size_t>(l)] = 1;
    std::vector<char> in(vertices), out(vertices);
    f.segments.resize(vertices);
    for (std::size_t v = 0; v < vertices; ++v) {
      const auto l = static_cast<std::size_t>(skin_.segment[v]);
      in[v] = f.distal[l];
      out[v] = !f.distal[l];
      f.segments[v] = f.counted[l];
    }
    f.proximal = f.distally = f.segments;
    const std::vector<char> by_in = net.within(in, kBorder_m), by_out = net.within(out, kBorder_m);
    for (std::size_t v = 0; v < vertices; ++v) {
      if (out[v] && by_in[v]) f.proximal[v] = 1;
      if (in[v] && by_out[v]) f.distally[v] = 0;
    }
    joints_.push_back(std::move(f));
  }
}

std::string SkinLedger::column(const Scenario& scenario, int joint, const std::string& what) {
  const Joint& j = scenario.human->skeleton.joints[static_cast<std::size_t>(joint)];
  return j.name + what + (j.type == JointType::prismatic ? "_Ns" : "_Nms");
}

std::vector<std::string> SkinLedger::columns(const Scenario& scenario) {
  std::vector<std::string> names;
  for (const int j : movingJoints(scenario.human->skeleton))
    for (const char* what : kParts) names.push_back(column(scenario, j, what));
  return names;
}

void SkinLedger::add(const MaterialPoint& touched, const Vec3& received, const Vec3& pressing) {
  for (std::size_t k = 0; k < 3 && touched.vertex[k] >= 0; ++k) {
    received_[static_cast<std::size_t>(touched.vertex[k])] += touched.weight[k] * received;
    pressing_[static_cast<std::size_t>(touched.vertex[k])] += touched.weight[k] * pressing;
    normal_[static_cast<std::size_t>(touched.vertex[k])] += touched.weight[k] * norm(pressing);
  }
}

/// A vertex without distal weight that the joint moves all the same lies at its crease.
double SkinLedger::share(const JointFacts& f, int vertex) const {
  double distal = 0, counted = 0;
  for (int i = skin_.first[static_cast<std::size_t>(vertex)]; i < skin_.first[static_cast<std::size_t>(vertex) + 1];
       ++i) {
    const auto k = static_cast<std::size_t>(i), l = static_cast<std::size_t>(skin_.link[k]);
    if (f.distal[l]) distal += skin_.weight[k];
    if (f.counted[l]) counted += skin_.weight[k];
  }
  return distal > 0 ? counted / distal : 1;
}

std::vector<double> SkinLedger::row(double middle_s) const {
  std::vector<double> out;
  std::vector<int> touched;
  for (std::size_t v = 0; v < received_.size(); ++v)
    if (received_[v] != Vec3{}) touched.push_back(static_cast<int>(v));
  if (touched.empty()) return std::vector<double>(kPerJoint * joints_.size(), 0.0);
  const Human& human = *scenario_.human;
  const double at_s = std::max(middle_s, 0.0);
  const Posture posture = scenario_.motion->at(at_s);
  const std::vector<Pose> X_WL = linkPoses(human.skeleton, posture.q, posture.root);
  std::vector<Vec3> x(received_.size()), more(x.size()), less(x.size());
  const auto place = [&](const std::vector<Pose>& poses, std::vector<Vec3>& to) {
    skinPositions(skin_, poses, to);
    bridge(scenario_.stage->bridged, skin_, poses, at_s, to);
  };
  place(X_WL, x);
  for (const JointFacts& f : joints_) {
    const Joint& joint = human.skeleton.joints[static_cast<std::size_t>(f.joint)];
    const auto moved = [&](double by, std::vector<Vec3>& to) {
      std::vector<double> q = posture.q;
      q[static_cast<std::size_t>(f.joint)] += by;
      place(linkPoses(human.skeleton, q, posture.root), to);
    };
    moved(kDifference, more);
    moved(-kDifference, less);
    const Pose X_WJ = X_WL[static_cast<std::size_t>(joint.parent)] * joint.X_PJ;
    const Vec3 axis = X_WJ.rotation * joint.axis;
    double generalised = 0, normal = 0, segments = 0, proximal = 0, distal = 0;
    for (const int vertex : touched) {
      const auto v = static_cast<std::size_t>(vertex);
      const Vec3& J = received_[v];
      const Vec3 way = more[v] - less[v];
      if (way != Vec3{}) {
        const double part = share(f, vertex) / (2 * kDifference);
        generalised += part * dot(J, way);
        normal += part * dot(pressing_[v], way);
      }
      if (!f.segments[v] && !f.proximal[v]) continue;
      const double tau = joint.type == JointType::prismatic ? dot(axis, J) : dot(axis, cross(x[v] - X_WJ.origin, J));
      if (f.segments[v]) segments += tau;
      if (f.proximal[v]) proximal += tau;
      if (f.distally[v]) distal += tau;
    }
    out.insert(out.end(), {generalised, segments, proximal, distal, normal});
  }
  return out;
}

void SkinLedger::clear() {
  std::fill(received_.begin(), received_.end(), Vec3{});
  std::fill(pressing_.begin(), pressing_.end(), Vec3{});
  std::fill(normal_.begin(), normal_.end(), 0.0);
}

}  // namespace gambeson
