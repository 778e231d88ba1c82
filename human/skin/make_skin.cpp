#include "human/skin/make_skin.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "human/body/skin.hpp"
#include "human/motion/motion.hpp"
#include "human/motion/standing.hpp"
#include "human/skin/field.hpp"
#include "human/skin/mesh.hpp"

namespace gambeson {
namespace {

/// Height of the iliac crest above the hip, in lengths of the thigh: iliocristale at 1.061 m (ANSUR II, men, median),
/// hip of male_p50 at 0.898 m, thigh 0.409 m.
constexpr double kIliacCrest = 0.4;

/// 0 to 1 over [-1, 1], linear between quadratic ends: slope 1/1.6 in the middle, continuous. Little steeper than a
/// straight line, since a fold's inside must not overtake itself (skin_bend.cpp).
double shareProfile(double s) {
  constexpr double e = 0.4, slope = 1 / (2 - e);
  s = std::clamp(s, -1.0, 1.0);
  if (s < -1 + e) return slope / (2 * e) * (s + 1) * (s + 1);
  if (s > 1 - e) return 1 - slope / (2 * e) * (1 - s) * (1 - s);
  return 0.5 + slope * s;
}

double smoothStep(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * (3 - 2 * u);
}

/// One joint of the skeleton with the band over which it bends.
struct BendBand {
  int child;
  int side;  ///< +1 left, -1 right, 0 both
  Vec3 centre, normal;
  double offset_m, half_width_m;
  bool bends, crease;
};

class Maker {
 public:
  Maker(const Human& human, const SkinOptions& options) : human_(human), s_(human.skeleton) {
    const Posture p = standing(human);
    skin_.bind = linkPoses(s_, p.q, p.root);
    skin_.crease_gap_m = options.crease_gap_m;
    const BodyField field(human, skin_.bind);
    ImplicitSurface surface;
    surface.value = [&](const Vec3& x) { return field(x); };
    surface.gradient = [&](const Vec3& x) { return field.gradient(x); };
    surface.edge = [&](const Vec3& x) { return 0.965 * options.cell_m * (1 + 0.6 * field.coarseness(x)); };
    surface.low = field.low();
    surface.high = field.high();
    skin_.rest = meshOf(surface, options.cell_m);
    findBands();
    for (const Vec3& x : skin_.rest.vertices) {
      towards_arm_.push_back(field.towardsArm(x));
      towards_left_.push_back(field.towardsLeftLeg(x));
    }
    shares();
    creases();
  }
  Skin take() { return std::move(skin_); }

 private:
  int link(const std::string& name) const {
    const int l = s_.link(name);
    if (l < 0) throw InputError({"", 0, "skin"}, "needs a skeleton with a link '" + name + "', as our manikins have");
    return l;
  }
  Vec3 semiAxes(const std::string& shape) const {
    for (const BodyShape& s : human_.shapes)
      if (s.name == shape) return std::get<Ellipsoid>(s.shape).semi_axes;  // the field has seen that there is one
    throw InputError({"", 0, "skin"}, "needs an ellipsoid '" + shape + "'");
  }
  Vec3 at(const std::string& name) const { return skin_.bind[link(name)].origin; }

  /// Where the body bends: the plane through each joint and half the width of the band that takes part.
  void findBands() {
    const Vec3 pelvis = skin_.bind[0].origin;
    const double hip_depth = semiAxes("pelvis").x, chest_half = semiAxes("chest").y,
                 arm_radius = semiAxes("upper_arm_left").x;
    const auto add = [&](const std::string& child, int side, const Vec3& normal, double offset, double half_width,
                         bool bends, bool crease) {
      bands_.push_back({link(child), side, at(child), normalized(normal), offset, half_width, bends, crease});
    };
    for (const int side : {1, -1}) {
      const std::string name = side > 0 ? "_left" : "_right";
      const Vec3 hip = at("thigh" + name), knee = at("shank" + name), ankle = at("foot" + name),
                 shoulder = at("upper_arm" + name), elbow = at("forearm" + name), wrist = at("hand" + name);
      const double thigh = norm(knee - hip), upper_arm = norm(elbow - shoulder);
      add("foot" + name, side, ankle - knee, 0, 0.10 * thigh, true, false);
      add("shank" + name, side, (ankle - hip), 0, 0.25 * thigh, true, true);
      // The groin runs from the crotch up and outwards: where the plane meets the median plane it lies below the
      // crotch.
      const double half = std::abs(hip.y - pelvis.y), drop = 0.95 * half;
      add("thigh" + name, side, {0, side * drop, -half}, 0, std::max(0.28 * thigh, 1.05 * hip_depth), true, true);
      add("hand" + name, side, wrist - elbow, 0, 0.10 * upper_arm, false, false);
      add("forearm" + name, side, wrist - shoulder, 0, 0.25 * upper_arm, true, true);
      // Midway between chest and arm a hand's breadth below the joint, leaning outwards by half the held abduction.
      const Vec3 arm = normalized(elbow - shoulder), down = normalized(arm + Vec3{0, 0, -1});
      const double depth = 0.35 * upper_arm, inner = depth * std::abs(arm.y / arm.z) - arm_radius / std::abs(arm.z);
      const Vec3 middle{shoulder.x, side * 0.5 * (std::abs(shoulder.y) + inner + chest_half), shoulder.z - depth};
      const Vec3 normal = cross({1, 0, 0}, side * down);
      add("upper_arm" + name, side, normal, dot(normal, middle - shoulder), 0.25 * upper_arm, true, true);
    }
    const double trunk = at("head").z - at("torso").z;
    add("head", 0, {0, 0, 1}, 0.02 * trunk, 0.12 * trunk, true, false);
    add("torso", 0, {0, 0, 1}, 0.09 * trunk, 0.22 * trunk, true, false);
    torso_ = static_cast<int>(bands_.size()) - 1;
    for (const BendBand& r : bands_)
      if (r.bends) skin_.bends.push_back({parentSegment(r.child), r.child, r.centre, r.normal, r.offset_m, r.crease});
  }

  /// The nearest link up the tree that has a band, or the root.
  int parentSegment(int l) const {
    while (l != 0) {
      l = s_.joints[s_.links[l].parent_joint].parent;
      if (std::any_of(bands_.begin(), bands_.end(), [&](const BendBand& r) { return r.child == l; })) return l;
    }
    return 0;
  }

  void shares() {
    const std::size_t n = skin_.rest.vertices.size();
    bend_of_.assign(bands_.size(), -1);
    above_.assign(bands_.size(), -1);
    for (std::size_t r = 0, b = 0; r < bands_.size(); ++r) {
      if (bands_[r].bends) bend_of_[r] = static_cast<int>(b++);
      const int p = parentSegment(bands_[r].child);
      for (std::size_t q = 0; q < bands_.size(); ++q)
        if (bands_[q].child == p) above_[r] = static_cast<int>(q);
    }
    std::vector<Shares> own(n);
    for (std::size_t v = 0; v < n; ++v) own[v] = sharesAt(v);
    makeRuns(own);
    skin_.first = {0};
    for (const Shares& s : own) weigh(s);
  }

  /// What a vertex has of each band's joint, and of all joints from the root to it.
  struct Shares {
    std::vector<double> own, total;
  };

  Shares sharesAt(std::size_t v) const {
    Shares s;
    for (const BendBand& r : bands_) s.own.push_back(ownShare(r, v, skin_.bind[0].origin));
    // The lumbar joint leaves alone what turns with a thigh.
    for (std::size_t r = 0; r < bands_.size(); ++r)
      if (s_.links[bands_[r].child].name.starts_with("thigh")) s.own[torso_] *= 1 - s.own[r];
    s.total = s.own;
    for (int r = static_cast<int>(bands_.size()) - 1; r >= 0; --r)
      if (above_[r] >= 0) s.total[r] *= s.total[above_[r]];
    return s;
  }

  /// Sorts the vertices by the bends that move them, so that each run is one loop.
  void makeRuns(std::vector<Shares>& own) {
    using Key = std::vector<std::pair<int, bool>>;  // bend, whether in part
    std::vector<Key> key(own.size());
    for (std::size_t v = 0; v < own.size(); ++v)
      for (std::size_t r = 0; r < bands_.size(); ++r)
        if (bend_of_[r] >= 0 && own[v].total[r] > 0) key[v].emplace_back(bend_of_[r], own[v].own[r] < 1);
    std::vector<int> order(own.size()), number(own.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return key[a] < key[b]; });
    const auto sorted = [&](auto& list) {
      auto old = list;
      for (std::size_t i = 0; i < order.size(); ++i) list[i] = std::move(old[order[i]]);
    };
    sorted(key);
    sorted(own);
    sorted(skin_.rest.vertices);
    sorted(towards_arm_);
    sorted(towards_left_);
    for (std::size_t i = 0; i < order.size(); ++i) number[order[i]] = static_cast<int>(i);
    for (auto& t : skin_.rest.triangles)
      for (int& v : t) v = number[v];

    for (std::size_t begin = 0, end = 0; begin < key.size(); begin = end) {
      while (end < key.size() && key[end] == key[begin]) ++end;
      SkinRun run{static_cast<int>(begin), static_cast<int>(end), {}, {}, {}};
      for (const auto& [bend, partial] : key[begin]) {
        run.bends.push_back(bend);
        run.partial.push_back(partial);
        if (!partial) continue;
        const auto r = std::find(bend_of_.begin(), bend_of_.end(), bend) - bend_of_.begin();
        for (std::size_t v = begin; v < end; ++v) run.share.push_back(own[v].own[r]);
      }
      skin_.runs.push_back(std::move(run));
    }
  }

  /// Weights of the next vertex: of a chain only what no joint further on takes.
  void weigh(const Shares& s) {
    std::vector<std::pair<int, double>> parts;
    double root = 1;
    for (std::size_t r = 0; r < bands_.size(); ++r) {
      double w = s.total[r];
      for (std::size_t q = 0; q < bands_.size(); ++q)
        if (above_[q] == static_cast<int>(r)) w -= s.total[q];
      if (above_[r] < 0) root -= s.total[r];
      if (w > 0) parts.emplace_back(bands_[r].child, w);
    }
    if (root > 0) parts.emplace_back(0, root);
    std::sort(parts.begin(), parts.end());
    double sum = 0;
    for (const auto& [l, w] : parts) sum += w;
    int best = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      skin_.link.push_back(parts[i].first);
      skin_.weight.push_back(parts[i].second / sum);
      if (parts[i].second > parts[best].second) best = static_cast<int>(i);
    }
    skin_.segment.push_back(parts[best].first);
    skin_.first.push_back(static_cast<int>(skin_.link.size()));
  }

  /// The share of a point of the skin in one joint. Legs end at the median plane; arms are told from the trunk by what
  /// is nearer, where a plane through the joint no longer can.
  double ownShare(const BendBand& r, std::size_t v, const Vec3& pelvis) const {
    const Vec3& x = skin_.rest.vertices[v];
    const double towards_arm = towards_arm_[v];
    const std::string& name = s_.links[r.child].name;
    const bool shoulder = name.starts_with("upper_arm");
    // Above the shoulder the boundary between arm and trunk is upright.
    const Vec3 level{x.x, x.y, shoulder ? std::min(x.z, r.centre.z) : x.z};
    const double s = dot(r.normal, level - r.centre) - r.offset_m;
    if (name.starts_with("thigh")) {
      if (towards_arm > 0) return 0;
      // Narrow between the legs, where pelvis and thigh meet within a hand's breadth; elsewhere as wide as the fold's
      // inside needs.
      const double away = std::hypot(x.x - r.centre.x, x.y - pelvis.y);
      const double width = std::min(0.03 + 1.0 * away, r.half_width_m);
      // The skin over the iliac crest and above does not turn with the thigh: on the trunk's side of the plane the
      // band ends below it, u = -1, also at the sides, where the plane has risen towards it.
      const double crest_m = kIliacCrest * norm(at("thigh_left") - at("shank_left"));
      const double room = std::clamp((crest_m - (x.z - r.centre.z)) * -r.normal.z - s, 0.3 * width, width);
      const double t = std::max(0.0, -s), u = s > 0 ? s / width : -t / width - (1 / room - 1 / width) * t * t / room;
      // Both thighs pull at the skin between them, less and less down the legs.
      const double below = (r.centre.z - x.z) / r.half_width_m,
                   between_m = 0.07 - 0.055 * smoothStep((below - 0.4) / 0.8);
      return shareProfile(u) * smoothStep(0.5 + 0.5 * r.side * towards_left_[v] / between_m);
    }
    if (r.side != 0 && r.side * (x.y - pelvis.y) <= 0) return 0;
    const double u = s / r.half_width_m;
    if (name == "torso") return shareProfile(u + 40 * std::max(0.0, towards_arm) / r.half_width_m);
    if (shoulder) {
      // Narrower below the armpit, until the arm is free.
      const double down = (r.centre.z - x.z) / r.half_width_m, free = smoothStep((down - 1.0) / 2.2);
      return shareProfile(u / (1 - 0.9 * free));
    }
    return shareProfile(u);
  }

  /// Which vertices a joint keeps apart: those of its segments; at the hips those in front that a thigh can reach, of
  /// the trunk too; at the shoulders those near the armpit, since an arm may pass in front of the chest.
  void creases() {
    const int torso = link("torso");
    for (std::size_t b = 0; b < skin_.bends.size(); ++b) {
      const SkinBend& bend = skin_.bends[b];
      if (!bend.crease) continue;
      const std::string& child = s_.links[bend.child].name;
      const bool hip = child.starts_with("thigh"), shoulder = child.starts_with("upper_arm");
      const double upper_arm = norm(at("upper_arm_left") - at("forearm_left")),
                   hip_half = 0.5 * norm(at("thigh_left") - at("thigh_right"));
      SkinCrease c;
      c.bend = static_cast<int>(b);
      for (std::size_t v = 0; v < skin_.segment.size(); ++v) {
        const Vec3& x = skin_.rest.vertices[v];
        const double s = dot(bend.normal, x - bend.centre) - bend.offset_m;
        const int segment = skin_.segment[v];
        const bool of_child = s_.isDistal(segment, bend.child);
        const bool of_parent = segment == bend.parent || (hip && segment == torso);
        if (s > 0 ? !of_child : s == 0 || !of_parent) continue;
        double strength = 1;
        if (shoulder) strength = 1 - smoothStep(norm(x - bend.centre) / (0.3 * upper_arm) - 1);
        if (hip)
          strength = (1 - smoothStep(norm(x - bend.centre) / (1.6 * hip_half) - 1)) *
                     smoothStep((x.x - bend.centre.x) / (0.6 * hip_half)) *
                     (of_child ? smoothStep(std::abs(towards_left_[v]) / 0.04) : 1);
        if (!(strength > 0)) continue;
        c.vertex.push_back(static_cast<int>(v));
        c.side.push_back(s > 0 ? 1 : -1);
        c.strength.push_back(strength);
      }
      skin_.creases.push_back(std::move(c));
    }
  }

  const Human& human_;
  const Skeleton& s_;
  Skin skin_;
  std::vector<BendBand> bands_;
  int torso_ = 0;                     ///< its band
  std::vector<int> bend_of_, above_;  ///< of each band: its bend, and the next band towards the root (or -1)
  std::vector<double> towards_arm_, towards_left_;
};

void check(const char* key, double value, bool good, const char* allowed) {
  if (!good) throw InputError({"", 0, key}, std::to_string(value) + " is not allowed: " + allowed);
}

}  // namespace

Skin makeSkin(const Human& human, const SkinOptions& o) {
  check("cell_m", o.cell_m, o.cell_m >= 0.006 && o.cell_m <= 0.05, "0.006 to 0.05");
  check("crease_gap_m", o.crease_gap_m, o.crease_gap_m >= 0 && o.crease_gap_m <= 0.02, "0 to 0.02");
  return Maker(human, o).take();
}

}  // namespace gambeson
