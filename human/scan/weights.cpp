#include "human/scan/weights.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "human/scan/geodesic.hpp"

namespace gambeson {
namespace {

/// Shares are averaged over this length along the skin [m]: some (length / edge)² times with the neighbours.
constexpr double kAveraged_m = 0.015;
constexpr int kMostAverages = 40;
/// Half the width of a joint's band over the length of thigh, upper arm or trunk, as in our own skins
/// (human/skin/make_skin.cpp).
constexpr double kFoot = 0.10, kShank = 0.25, kThigh = 0.28, kHand = 0.15, kForearm = 0.25, kUpperArm = 0.25,
                 kHead = 0.12, kTorso = 0.22;
constexpr double kBetween = 0.03;  ///< half the width over which thighs part below the trunk, in statures

double step(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * (3 - 2 * u);
}

/// How far a band reaches from its border, towards the trunk and along the limb.
struct Reach {
  double before_m, beyond_m;
};

struct Band {
  int child, parent;  ///< in scanLinks()
  std::vector<char> beyond;
  std::function<Reach(std::size_t)> reach;  ///< at a vertex
  std::vector<double> most{};               ///< by vertex; empty: 1
};

class Weigher {
 public:
  Weigher(const TriangleMesh& body, const Landmarks& landmarks, const std::map<std::string, Vec3>& joints)
      : body_(body), marks_(landmarks), joints_(joints), beside_(body.vertices.size()) {
    for (const auto& t : body_.triangles)
      for (int k = 0; k < 3; ++k) {
        beside_[static_cast<std::size_t>(t[k])].push_back(t[(k + 1) % 3]);
        beside_[static_cast<std::size_t>(t[k])].push_back(t[(k + 2) % 3]);
      }
    for (auto& list : beside_) {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
    }
    double length = 0;
    for (const auto& t : body_.triangles) length += norm(body_.vertices[t[1]] - body_.vertices[t[0]]);
    const double edges = kAveraged_m * static_cast<double>(body_.triangles.size()) / length;
    averages_ = std::clamp(static_cast<int>(std::lround(edges * edges)), 1, kMostAverages);
    bands();
    shares();
  }
  SkinWeights take() { return std::move(out_); }

 private:
  static int link(const std::string& name) {
    const auto& all = scanLinks();
    return static_cast<int>(std::find(all.begin(), all.end(), name) - all.begin());
  }
  static bool isArm(int l) { return scanLinks()[static_cast<std::size_t>(l)].starts_with("upper_arm"); }
  const Vec3& at(const std::string& name) const { return joints_.at(name); }

  std::vector<char> where(const std::function<bool(std::size_t)>& is) const {
    std::vector<char> out(body_.vertices.size(), 0);
    for (std::size_t v = 0; v < out.size(); ++v) out[v] = is(v);
    return out;
  }

  /// What hangs together with a vertex among those that are marked.
  std::vector<char> flood(int from, const std::vector<char>& marked) const {
    std::vector<char> out(marked.size(), 0);
    std::vector<int> next{from};
    out[static_cast<std::size_t>(from)] = 1;
    while (!next.empty()) {
      const int v = next.back();
      next.pop_back();
      for (const int w : beside_[static_cast<std::size_t>(v)])
        if (marked[static_cast<std::size_t>(w)] && !out[static_cast<std::size_t>(w)])
          out[static_cast<std::size_t>(w)] = 1, next.push_back(w);
    }
    return out;
  }

  int nearest(const Vec3& x) const {
    std::size_t best = 0;
    for (std::size_t v = 0; v < body_.vertices.size(); ++v)
      if (norm2(body_.vertices[v] - x) < norm2(body_.vertices[best] - x)) best = v;
    return static_cast<int>(best);
  }

  void add(const std::string& child, const std::string& parent, std::vector<char> beyond, double half_width) {
    bands_.push_back({link(child), link(parent), std::move(beyond), [half_width](std::size_t) {
                        return Reach{half_width, half_width};
                      }});
  }

  /// Of the upper arm's band: alike on both sides at the height of the joint and above, on the arm alone at the
  /// armpit's, where the trunk's wall stays and the arm's underside gives way to it.
  std::function<Reach(std::size_t)> shoulderReach(const Vec3& shoulder, const Vec3& armpit, double upper_arm) const {
    const Vec3 down = armpit - shoulder;
    return [=, this](std::size_t v) {
      const double under = step(dot(down, body_.vertices[v] - shoulder) / norm2(down));
      return Reach{upper_arm * (1 - under) * kUpperArm, upper_arm * kUpperArm};
    };
  }

  void bands() {
    const Vec3 torso = at("torso"), head = at("head");
    const double trunk = head.z - torso.z;
    std::array<std::vector<char>, 2> arm;
    for (int side = 0; side < 2; ++side) {
      const auto s = static_cast<std::size_t>(side);
      const std::string name = side == 0 ? "_right" : "_left";
      const Vec3 shoulder = at("upper_arm" + name), elbow = at("forearm" + name), wrist = at("hand" + name);
      const double upper_arm = norm(elbow - shoulder);
      const int tip = nearest(marks_.hand_tip[s]);
      // The plane from the armpit up through the shoulder, and ahead: trunk and arm lie on either side of it.
      Vec3 outward = normalized(cross({1, 0, 0}, marks_.armpit[s] - shoulder));
      if (dot(outward, elbow - shoulder) < 0) outward = -outward;
      arm[s] = flood(tip, where([&](std::size_t v) { return dot(outward, body_.vertices[v] - shoulder) > 0; }));
      const auto part = [&](const Vec3& joint, const Vec3& beyond) {
        const Vec3 n = normalized(beyond);
        return flood(tip, where([&](std::size_t v) { return arm[s][v] && dot(n, body_.vertices[v] - joint) > 0; }));
      };
      add("hand" + name, "forearm" + name, part(wrist, wrist - elbow), kHand * upper_arm);
      add("forearm" + name, "upper_arm" + name, part(elbow, wrist - shoulder), kForearm * upper_arm);
      add("upper_arm" + name, "torso", arm[s], 0);
      bands_.back().reach = shoulderReach(shoulder, marks_.armpit[s], upper_arm);
    }
    const std::vector<char> legs = legsBelow(body_, marks_.crotch.z - 1e-3);
    for (int side = 0; side < 2; ++side) {
      const std::string name = side == 0 ? "_right" : "_left";
      const double sign = side == 0 ? -1 : 1;
      const char mine = static_cast<char>(side + 1);
      const Vec3 hip = at("thigh" + name), knee = at("shank" + name), ankle = at("foot" + name);
      const double thigh = norm(knee - hip), half = std::abs(hip.y - marks_.crotch.y);
      const auto below = [&](const Vec3& joint, const Vec3& beyond) {
        const Vec3 n = normalized(beyond);
        return where([&](std::size_t v) { return legs[v] == mine && dot(n, body_.vertices[v] - joint) > 0; });
      };
      add("foot" + name, "shank" + name, below(ankle, {0, 0, -1}), kFoot * thigh);
      add("shank" + name, "thigh" + name, below(knee, ankle - hip), kShank * thigh);
      // The groin runs from the crotch up and outwards.
      const double slope = (hip.z - marks_.crotch.z) / half;
      add("thigh" + name, "pelvis", where([&](std::size_t v) {
            if (arm[0][v] || arm[1][v]) return false;
            if (legs[v]) return legs[v] == mine;
            const double y = sign * (body_.vertices[v].y - marks_.crotch.y);
            return y > 0 && body_.vertices[v].z < marks_.crotch.z + slope * y;
          }),
          kThigh * thigh);
      // Nothing of one leg's turn for the other leg; between them, it passes over on either side of the median plane.
      for (std::size_t v = 0; v < legs.size(); ++v) {
        const double y = sign * (body_.vertices[v].y - marks_.crotch.y);
        bands_.back().most.push_back(legs[v] ? (legs[v] == mine ? 1 : 0)
                                             : step(0.5 + 0.5 * y / (kBetween * marks_.stature_m)));
      }
    }
    add("head", "torso", where([&](std::size_t v) {
          return !arm[0][v] && !arm[1][v] && body_.vertices[v].z > head.z + 0.02 * trunk &&
                 std::abs(body_.vertices[v].y - head.y) < 0.12 * marks_.stature_m;
        }),
        kHead * trunk);
    add("torso", "pelvis",
        where([&](std::size_t v) { return arm[0][v] || arm[1][v] || body_.vertices[v].z > torso.z + 0.09 * trunk; }),
        kTorso * trunk);
  }

  /// 0 to 1 over the band, smooth; half at the border of one that reaches as far on both sides.
  std::vector<double> share(const Band& b) const {
    std::vector<int> in, out;
    for (std::size_t v = 0; v < b.beyond.size(); ++v) (b.beyond[v] ? in : out).push_back(static_cast<int>(v));
    const std::vector<double> to_in = distancesFrom(body_, in), to_out = distancesFrom(body_, out);
    std::vector<double> s(b.beyond.size());
    for (std::size_t v = 0; v < s.size(); ++v) {
      const double signed_m = b.beyond[v] ? to_out[v] : -to_in[v];
      const auto [before_m, beyond_m] = b.reach(v);
      s[v] = step((signed_m + before_m) / (before_m + beyond_m)) * (b.most.empty() ? 1 : b.most[v]);
    }
    std::vector<double> next(s.size());
    for (int k = 0; k < averages_; ++k) {
      for (std::size_t v = 0; v < s.size(); ++v) {
        double sum = 0;
        for (const int w : beside_[v]) sum += s[static_cast<std::size_t>(w)];
        next[v] = 0.5 * s[v] + 0.5 * sum / static_cast<double>(beside_[v].size());
      }
      std::swap(s, next);
    }
    for (double& x : s) x = x < 1e-3 ? 0 : x > 1 - 1e-3 ? 1 : x;
    return s;
  }

  void shares() {
    const std::size_t n = body_.vertices.size(), links = scanLinks().size();
    std::vector<std::vector<double>> own(links);
    std::vector<int> parent(links, -1);
    for (const Band& b : bands_) {
      own[static_cast<std::size_t>(b.child)] = share(b);
      parent[static_cast<std::size_t>(b.child)] = b.parent;
    }
    out_.weights.resize(n), out_.part.resize(n);
    std::vector<double> total(links), weight(links);
    const auto torso = static_cast<std::size_t>(link("torso"));
    for (std::size_t v = 0; v < n; ++v) {
      // The lumbar joint leaves alone what turns with a thigh.
      double lumbar = own[torso][v];
      for (const char* thigh : {"thigh_right", "thigh_left"})
        lumbar *= 1 - own[static_cast<std::size_t>(link(thigh))][v];
      for (std::size_t l = 0; l < links; ++l) {
        const double mine = l == 0 ? 1 : l == torso ? lumbar : own[l][v];
        weight[l] = total[l] = l == 0 ? 1 : mine * total[static_cast<std::size_t>(parent[l])];
      }
      for (std::size_t l = 1; l < links; ++l) weight[static_cast<std::size_t>(parent[l])] -= total[l];
      double sum = 0;
      VertexWeights& list = out_.weights[v];
      for (std::size_t l = 0; l < links; ++l)
        if (weight[l] > 1e-6) list.emplace_back(static_cast<int>(l), weight[l]), sum += weight[l];
      for (auto& [l, w] : list) w /= sum;
      int& part = out_.part[v];
      part = std::max_element(list.begin(), list.end(), [](const auto& a, const auto& b) {
               return a.second < b.second;
             })->first;
      for (const Band& b : bands_)  // the arm begins at the armpit, wherever it turns
        if (part == static_cast<int>(torso) && b.parent == part && b.beyond[v] && isArm(b.child)) part = b.child;
    }
  }

  const TriangleMesh& body_;
  const Landmarks& marks_;
  const std::map<std::string, Vec3>& joints_;
  std::vector<std::vector<int>> beside_;
  std::vector<Band> bands_;
  SkinWeights out_;
  int averages_ = 1;
};

}  // namespace

const std::vector<std::string>& scanLinks() {
  static const std::vector<std::string> links{"pelvis",         "thigh_right",     "shank_right",   "foot_right",
                                              "thigh_left",     "shank_left",      "foot_left",     "torso",
                                              "head",           "upper_arm_right", "forearm_right", "hand_right",
                                              "upper_arm_left", "forearm_left",    "hand_left"};
  return links;
}

SkinWeights weightsOf(const TriangleMesh& body, const Landmarks& landmarks, const std::map<std::string, Vec3>& joints) {
  return Weigher(body, landmarks, joints).take();
}

}  // namespace gambeson
