#include "human/scan/landmarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "core/error.hpp"
#include "human/scan/geodesic.hpp"

namespace gambeson {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

// Where landmarks are looked for, in statures.
constexpr double kLegsFrom = 0.15;  ///< here only legs are cut
constexpr double kLeastCrotch = 0.38,
                 kMostCrotch = 0.56;  ///< crotch height 0.44 to 0.52 (ANSUR II, 1st to 99th percentile)
constexpr double kLegStep = 0.01, kArmStep = 0.008;
constexpr double kFirstSection = 0.20;               ///< from the finger tip: the forearm
constexpr double kLeastArm = 0.25, kMostArm = 0.55;  ///< finger tip to armpit
constexpr double kArmpit = 0.122;                    ///< nearer to the median plane arms are part of the trunk
constexpr double kThinnest = 1.04;
constexpr double kLeastFoot = 0.105, kMostFoot = 0.23;  ///< foot length 0.14 to 0.165 (ANSUR II); shoes are longer
constexpr double kLeastHead =
    0.10;                           ///< from where the neck is thinnest to the top: 0.12 to 0.16 of our skins and scans
constexpr double kMostNeck = 0.34;  ///< girth of the neck: 0.19 to 0.27 (ANSUR II); hair is around it
constexpr double kJump = 1.35;      ///< growth of a section's area over a step where limbs join

class Finder {
 public:
  Finder(const TriangleMesh& body, const std::string& file) : body_(body), file_(file) {
    for (const Vec3& x : body_.vertices) out_.stature_m = std::max(out_.stature_m, x.z);
    H_ = out_.stature_m;
    legs();
    feet();
    for (int side = 0; side < 2; ++side) arm(side);
    neck();
  }
  Landmarks take() { return std::move(out_); }

 private:
  [[noreturn]] void fail(const std::string& landmark, const std::string& reason) const {
    throw InputError({file_, 0, landmark}, reason);
  }
  static const char* name(int side) { return side == 0 ? "right" : "left"; }

  /// The two largest loops of a level.
  std::optional<std::array<CutLoop, 2>> pair(double z) const {
    std::vector<CutLoop> loops = cutLoops(body_, CutPlane::level(z));
    std::sort(loops.begin(), loops.end(), [](const CutLoop& a, const CutLoop& b) { return a.area_m2 > b.area_m2; });
    if (loops.size() < 2 || !(loops[1].area_m2 > 0.3 * loops[0].area_m2)) return std::nullopt;
    if (loops[0].centre.y > loops[1].centre.y) std::swap(loops[0], loops[1]);
    return std::array{std::move(loops[0]), std::move(loops[1])};
  }

  void add(LimbLine& line, const Vec3& centre, const Vec3& direction, double girth) const {
    line.along.push_back(line.centre.empty() ? 0 : line.along.back() + norm(centre - line.centre.back()));
    line.centre.push_back(centre);
    line.direction.push_back(direction);
    line.girth.push_back(girth);
  }

  void legs() {
    const auto first = pair(kLegsFrom * H_);
    if (!first)
      fail("legs",
           fmt::format("there are no two legs {:.2f} m above the ground: legs must stand apart, without a skirt",
                       kLegsFrom * H_));
    median_ = 0.5 * ((*first)[0].centre.y + (*first)[1].centre.y);
    // Upwards each leg is the loop nearest to where it was; where both are one, the crotch lies below.
    std::array<Vec2, 2> at{(*first)[0].centre, (*first)[1].centre};
    std::array<double, 2> area{(*first)[0].area_m2, (*first)[1].area_m2};
    const auto follow = [&](double z, bool keep) {
      const std::vector<CutLoop> loops = cutLoops(body_, CutPlane::level(z));
      const CutLoop* mine[2] = {nearestLoop(loops, at[0]), nearestLoop(loops, at[1])};
      if (!mine[0] || mine[0] == mine[1]) return false;
      // A leg's loop that crosses the median plane has joined the other leg's.
      for (int s = 0; s < 2; ++s)
        if (mine[s]->area_m2 > 1.6 * area[static_cast<std::size_t>(s)]) return false;
      if (!keep) return true;
      for (std::size_t s = 0; s < 2; ++s) {
        at[s] = mine[s]->centre, area[s] = mine[s]->area_m2;
        add(out_.leg[s], {at[s].x, at[s].y, z}, {0, 0, 1}, mine[s]->girth());
      }
      return true;
    };
    const double step = kLegStep * H_;
    std::vector<double> down;
    double z = kLegsFrom * H_;
    while (z > 0.03 * H_) z -= 0.5 * step, down.push_back(z);
    // Downwards first, to have the lines start at the foot.
    std::array<Vec2, 2> kept = at;
    std::array<double, 2> kept_area = area;
    std::array<LimbLine, 2> below;
    for (const double level : down) {
      area = {1, 1};
      if (!follow(level, true)) break;
    }
    std::swap(below, out_.leg);
    for (std::size_t s = 0; s < 2; ++s)
      for (std::size_t i = below[s].size(); i-- > 0;)
        add(out_.leg[s], below[s].centre[i], {0, 0, 1}, below[s].girth[i]);
    at = kept, area = kept_area;
    z = kLegsFrom * H_;
    while (z < kMostCrotch * H_ && follow(z, true)) z += step;
    if (z >= kMostCrotch * H_)
      fail("crotch", fmt::format("the legs do not meet below {:.2f} m: is the body open between them?", z));
    double lo = z - step, hi = z;
    while (hi - lo > 2e-4) {
      const double mid = 0.5 * (lo + hi);
      (follow(mid, false) ? lo : hi) = mid;
    }
    if (!(hi > kLeastCrotch * H_))
      fail("crotch",
           fmt::format("the legs are one from {:.2f} m on, {:.2f} of the body's height: thighs or clothes touch (or a "
                       "hand touches a leg); crotches lie at {:.2f} to {:.2f} of it. Scan with the legs apart, or cut "
                       "the mesh where they touch",
                       hi, hi / H_, kLeastCrotch, kMostCrotch));
    median_ = 0.5 * (at[0].y + at[1].y);
    out_.crotch = {0.5 * (at[0].x + at[1].x), median_, hi};
  }

  void feet() {
    const std::vector<char> leg = legsBelow(body_, 0.5 * out_.crotch.z);
    for (std::size_t s = 0; s < 2; ++s) {
      Vec3 toe{-inf, 0, 0}, heel{inf, 0, 0};
      for (std::size_t v = 0; v < body_.vertices.size(); ++v) {
        if (leg[v] != static_cast<char>(s + 1) || !(body_.vertices[v].z < 0.06 * H_)) continue;
        if (body_.vertices[v].x > toe.x) toe = body_.vertices[v];
        if (body_.vertices[v].x < heel.x) heel = body_.vertices[v];
      }
      if (!std::isfinite(toe.x))
        fail("feet", fmt::format("there is no {} foot on the ground", name(static_cast<int>(s))));
      if (const double length = toe.x - heel.x; !(length > kLeastFoot * H_ && length < kMostFoot * H_))
        fail("feet",
             fmt::format("the {} foot is {:.3f} m long, {:.3f} of the body's height; feet and shoes are {:.2f} to "
                         "{:.2f} of it: is the body cut off above its feet, or does it face another way (say "
                         "\"facing\")?",
                         name(static_cast<int>(s)), length, length / H_, kLeastFoot, kMostFoot));
      out_.toe_tip[s] = toe, out_.heel[s] = heel;
      Vec3 sum;
      double n = 0;
      for (std::size_t v = 0; v < body_.vertices.size(); ++v)
        if (const Vec3& x = body_.vertices[v];
            leg[v] == static_cast<char>(s + 1) && x.z < 0.06 * H_ && x.x > heel.x + 0.75 * (toe.x - heel.x))
          sum += x, n += 1;
      out_.ball[s] = sum / n;
    }
  }

  void arm(int side) {
    const auto s = static_cast<std::size_t>(side);
    const double sign = side == 0 ? -1 : 1;
    if (from_crotch_.empty()) {
      std::size_t start = 0;
      for (std::size_t v = 0; v < body_.vertices.size(); ++v)
        if (norm2(body_.vertices[v] - out_.crotch) < norm2(body_.vertices[start] - out_.crotch)) start = v;
      from_crotch_ = distancesFrom(body_, {static_cast<int>(start)});
      legs_ = legsBelow(body_, out_.crotch.z);
    }
    int tip = -1;
    for (std::size_t v = 0; v < body_.vertices.size(); ++v)
      if (!legs_[v] && sign * (body_.vertices[v].y - median_) > 0 && std::isfinite(from_crotch_[v]) &&
          (tip < 0 || from_crotch_[v] > from_crotch_[static_cast<std::size_t>(tip)]))
        tip = static_cast<int>(v);
    const std::string key = fmt::format("arm_{}", name(side));
    const Vec3 hand = tip < 0 ? Vec3{} : body_.vertices[static_cast<std::size_t>(tip)];
    if (tip < 0 || std::abs(hand.y - median_) < 0.1 * H_)
      fail(key, fmt::format("there is no {} arm that ends in a hand beside the body: an A- or T-pose is needed, arms "
                            "clear of trunk, hips and head",
                            name(side)));
    out_.hand_tip[s] = hand;
    // Rough centres: means of the vertices at one distance from the tip.
    const std::vector<double> from_tip = distancesFrom(body_, {tip});
    const auto band = [&](double at) {
      Vec3 sum;
      double n = 0;
      for (std::size_t v = 0; v < from_tip.size(); ++v)
        if (std::abs(from_tip[v] - at) < 0.012 * H_) sum += body_.vertices[v], n += 1;
      return n > 0 ? sum / n : hand;
    };
    const Vec3 near = band(0.17 * H_), start = band(kFirstSection * H_), far = band(0.24 * H_);
    if (!(norm(far - near) > 0.02 * H_)) fail(key, fmt::format("the {} arm does not run on from its hand", name(side)));
    const Vec3 towards_trunk = normalized(far - near);
    LimbLine out_to_hand = walk(start, -towards_trunk, false), in = walk(start, towards_trunk, true);
    LimbLine& line = out_.arm[s];
    for (std::size_t i = out_to_hand.size(); i-- > 1;)
      add(line, out_to_hand.centre[i], -out_to_hand.direction[i], out_to_hand.girth[i]);
    for (std::size_t i = 0; i < in.size(); ++i) add(line, in.centre[i], in.direction[i], in.girth[i]);
    if (line.size() < 8) fail(key, fmt::format("the {} arm has no sections of its own near its forearm", name(side)));
    const double reach = norm(line.centre.front() - hand) + line.along.back();
    if (!(reach > kLeastArm * H_ && reach < kMostArm * H_))
      fail(key,
           fmt::format("the {} arm is one with the body from {:.2f} m on, counted from its finger tip at ({:.2f}, "
                       "{:.2f}, {:.2f}) m; arms are free over {:.2f} to {:.2f} m: arms must be clear of trunk, hips "
                       "and head",
                       name(side), reach, hand.x, hand.y, hand.z, kLeastArm * H_, kMostArm * H_));
    // The armpit: down and in from the arm's last section.
    const Vec3 last = line.centre.back(), in_arm = line.direction.back();
    const CutPlane plane = CutPlane::across(last, in_arm);
    const std::vector<CutLoop> loops = cutLoops(body_, plane);
    const Vec3 down_in = cross(Vec3{sign, 0, 0}, in_arm);
    out_.armpit[s] = last;
    if (const CutLoop* mine = nearestLoop(loops, {0, 0}))
      for (const Vec2& p : mine->points)
        if (const Vec3 x = last + p.x * plane.e1 + p.y * plane.e2;
            dot(down_in, x - last) > dot(down_in, out_.armpit[s] - last))
          out_.armpit[s] = x;
    // The wrist: the first section from the hand on that is about as thin as the thinnest between hand and forearm.
    double least = inf;
    const auto near_wrist = [&](std::size_t i) {
      const double d = norm(line.centre[i] - hand);
      return d > 0.085 * H_ && d < 0.155 * H_;
    };
    for (std::size_t i = 0; i < line.size(); ++i)
      if (near_wrist(i)) least = std::min(least, line.girth[i]);
    for (std::size_t i = line.size(); i-- > 0;)
      if (near_wrist(i) && line.girth[i] <= kThinnest * least) out_.wrist[s] = line.along[i];
    if (!std::isfinite(least)) fail(key, fmt::format("the {} arm shows no wrist", name(side)));
  }

  /// Sections across a limb, step by step, until it ends or grows into something else.
  LimbLine walk(Vec3 at, Vec3 direction, bool inward) const {
    LimbLine line;
    const double step = kArmStep * H_;
    double area = 0;
    for (int k = 0; k < 90; ++k) {
      std::optional<CutLoop> loop;
      Vec3 centre;
      for (int again = 0; again < 2; ++again) {
        const CutPlane plane = CutPlane::across(at, direction);
        const std::vector<CutLoop> loops = cutLoops(body_, plane);
        const CutLoop* mine = nearestLoop(loops, {0, 0});
        if (!mine || std::hypot(mine->centre.x, mine->centre.y) > 0.06 * H_) return line;
        loop = *mine;
        centre = at + loop->centre.x * plane.e1 + loop->centre.y * plane.e2;
        if (area > 0 && inward && (loop->area_m2 > kJump * area || std::abs(centre.y - median_) < kArmpit * H_))
          return line;
        if (line.size() >= 3) {
          const std::size_t back = std::min<std::size_t>(line.size(), 6);
          direction = normalized(centre - line.centre[line.size() - back]);
        }
        at = centre;
      }
      if (!inward && area > 0 && loop->area_m2 < 0.25 * area) return line;
      area = loop->area_m2;
      add(line, centre, direction, loop->girth());
      at = centre + step * direction;
    }
    return line;
  }

  void neck() {
    double least = inf;
    for (double z = 0.80 * H_; z < 0.92 * H_; z += 0.0025 * H_) {
      const std::vector<CutLoop> loops = cutLoops(body_, CutPlane::level(z));
      const CutLoop* mine = nearestLoop(loops, {out_.crotch.x, median_});
      if (mine && mine->area_m2 > 1e-3 && mine->girth() < least)
        least = mine->girth(), out_.neck = *mine, out_.neck_height_m = z;
    }
    if (!(least < kMostNeck * H_))
      fail("neck",
           fmt::format(
               "there is no neck between {:.2f} and {:.2f} m{}: is the head cut off, or hidden by hair or a hood? "
               "Scans need their head, which tells how tall the body is",
               0.8 * H_, 0.92 * H_,
               std::isfinite(least)
                   ? fmt::format(", where the trunk is at least {:.2f} m around, {:.2f} of the body's height; "
                                 "necks are at most {:.2f} of it",
                                 least, least / H_, kMostNeck)
                   : ""));
    if (const double above = H_ - out_.neck_height_m; !(above > kLeastHead * H_))
      fail("neck", fmt::format("it is thinnest at {:.2f} m, {:.2f} m below its top; heads reach at least {:.2f} m "
                               "above it: is the head cut off? Scans need their head, which tells how tall "
                               "the body is",
                               out_.neck_height_m, above, kLeastHead * H_));
  }

  const TriangleMesh& body_;
  const std::string& file_;
  Landmarks out_;
  double H_ = 0, median_ = 0;
  std::vector<double> from_crotch_;
  std::vector<char> legs_;
};

}  // namespace

Vec3 LimbLine::at(double s) const {
  if (s <= along.front()) return centre.front() + (s - along.front()) * direction.front();
  if (s >= along.back()) return centre.back() + (s - along.back()) * direction.back();
  const std::size_t k = static_cast<std::size_t>(std::upper_bound(along.begin(), along.end(), s) - along.begin());
  const double t = (s - along[k - 1]) / (along[k] - along[k - 1]);
  return centre[k - 1] + t * (centre[k] - centre[k - 1]);
}

Landmarks landmarksOf(const TriangleMesh& body, const std::string& file) { return Finder(body, file).take(); }

std::vector<char> legsBelow(const TriangleMesh& body, double height_m) {
  const std::size_t n = body.vertices.size();
  std::vector<int> root(n);
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int v) {
    while (root[static_cast<std::size_t>(v)] != v)
      v = root[static_cast<std::size_t>(v)] = root[static_cast<std::size_t>(root[static_cast<std::size_t>(v)])];
    return v;
  };
  const auto below = [&](int v) { return body.vertices[static_cast<std::size_t>(v)].z < height_m; };
  for (const auto& t : body.triangles)
    for (int k = 0; k < 3; ++k)
      if (below(t[k]) && below(t[(k + 1) % 3])) root[static_cast<std::size_t>(find(t[k]))] = find(t[(k + 1) % 3]);
  // A leg reaches down into the lowest fifth; its side is that of its mean.
  std::vector<double> low(n, inf), y(n, 0), count(n, 0);
  for (std::size_t v = 0; v < n; ++v) {
    const auto r = static_cast<std::size_t>(find(static_cast<int>(v)));
    low[r] = std::min(low[r], body.vertices[v].z), y[r] += body.vertices[v].y, count[r] += 1;
  }
  double middle = 0, legs = 0;
  for (std::size_t r = 0; r < n; ++r)
    if (count[r] > 0 && low[r] < 0.2 * height_m) middle += y[r] / count[r], legs += 1;
  if (legs > 0) middle /= legs;
  std::vector<char> out(n, 0);
  for (std::size_t v = 0; v < n; ++v) {
    const auto r = static_cast<std::size_t>(find(static_cast<int>(v)));
    if (below(static_cast<int>(v)) && low[r] < 0.2 * height_m) out[v] = y[r] / count[r] > middle ? 2 : 1;
  }
  return out;
}

}  // namespace gambeson
