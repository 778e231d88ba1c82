#include "human/recorded/retarget.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "human/files/text_lines.hpp"
#include "human/files/units.hpp"
#include "human/motion/foot_ground.hpp"
#include "human/motion/standing.hpp"

namespace gambeson {
namespace {

constexpr double run_up_s = 0.03;   ///< time constant of the motion continued backwards where the file has nothing
constexpr double run_up_rad = 0.3;  ///< and at most so far
constexpr double jump_rad = 0.6, jump_rad_per_s = 30;  ///< turns beyond both from one frame to the next are no motion
constexpr double lead_step_s = 0.005;
constexpr double settle_s = 0.08;  ///< width of the Gaussian over which the feet's height over the ground is evened out
constexpr double stride_s = 1.2;   ///< headings are means over about a stride
constexpr double alike_m = 0.003;  ///< feet less apart in height than some of these share the weight
constexpr double still_share = 0.3;  ///< hips that make less than this share of the feet's way stay in place
constexpr double closure_rad = 15 * rad_per_deg;
constexpr double farthest_m = 1e5, most_turned_rad = 1e5;  ///< beyond them a body is nowhere

double smootherStep(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * s * (s * (6 * s - 15) + 10);
}
double smootherArea(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * s * s * (s * (s - 3) + 2.5);
}

/// All values of a captured motion over its time: joints, then x, y, z, roll, pitch, yaw; continued backwards to rest.
class Source {
 public:
  Source(const CapturedMotion& r, const std::vector<Vec3>& turn) : t_(r.times), joints_(r.q.front().size()) {
    columns_.resize(joints_ + 6);
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      auto& x = columns_[k].x;
      for (std::size_t i = 0; i < t_.size(); ++i)
        x.push_back(k < joints_       ? r.q[i][k]
                    : k < joints_ + 3 ? r.hips[i][static_cast<int>(k - joints_)]
                                      : turn[i][static_cast<int>(k - joints_ - 3)]);
      columns_[k].slope = splineSlopes(t_, x);
    }
  }
  double first() const { return t_.front(); }
  double last() const { return t_.back(); }
  double at(std::size_t k, double t) const {
    const MotionColumn& c = columns_[k];
    if (t < first()) {
      const double tau = k < joints_ || k >= joints_ + 3 ? runUp(c.slope[0]) : run_up_s;
      return c.x[0] - c.slope[0] * tau * (1 - std::exp((t - first()) / tau));
    }
    const std::size_t i =
        std::clamp<std::size_t>(static_cast<std::size_t>(std::upper_bound(t_.begin(), t_.end(), t) - t_.begin()), 1,
                                t_.size() - 1) -
        1;
    const double h = t_[i + 1] - t_[i], u = std::min((t - t_[i]) / h, 1.0), w = 1 - u;
    return w * w * (1 + 2 * u) * c.x[i] + u * u * (1 + 2 * w) * c.x[i + 1] +
           h * u * w * (w * c.slope[i] - u * c.slope[i + 1]);
  }
  /// Time constant of an angle that is continued backwards: it goes on by no more than run_up_rad. (A file that starts
  /// with a pose apart, a T say, jumps from its first frame to its second.)
  static double runUp(double slope) { return std::min(run_up_s, run_up_rad / std::max(std::abs(slope), 1e-300)); }
  Vec3 hips(double t) const { return {at(joints_, t), at(joints_ + 1, t), at(joints_ + 2, t)}; }
  Vec3 turn(double t) const { return {at(joints_ + 3, t), at(joints_ + 4, t), at(joints_ + 5, t)}; }
  std::vector<double> q(double t) const {
    std::vector<double> q(joints_);
    for (std::size_t k = 0; k < joints_; ++k) q[k] = at(k, t);
    return q;
  }

 private:
  std::vector<double> t_;
  std::size_t joints_;
  std::vector<MotionColumn> columns_;
};

/// Angles of the pelvis without jumps.
std::vector<Vec3> turnsOf(const CapturedMotion& r) {
  std::vector<Vec3> turn;
  for (const Mat3& R : r.pelvis) {
    Vec3 a = anglesOf(R);
    if (!turn.empty())
      for (const int k : {0, 2})
        a[k] += 2 * std::numbers::pi * std::round((turn.back()[k] - a[k]) / (2 * std::numbers::pi));
    turn.push_back(a);
  }
  return turn;
}

/// One row of the table that becomes the motion.
struct Row {
  double time = 0;    ///< of the motion
  double source = 0;  ///< of the captured motion
  double rate = 1;    ///< d source / d time
  double share = 1;   ///< of the captured motion; the rest is standing
  std::vector<double> q;
  Vec3 turn, origin;
};

/// Standing, lead-in and window: when each row is, and which instant of the captured motion it shows.
std::vector<Row> rowsOf(const CapturedMotion& r, const MotionFileOptions& o, double from, double to) {
  std::vector<Row> rows;
  const double begin = o.stand_s + o.lead_in_s;
  if (o.stand_s > 0) rows.push_back({0, from - 0.5 * o.lead_in_s / o.slower, 0, 0, {}, {}, {}});
  if (o.lead_in_s > 0) {
    const int n = std::max(8, static_cast<int>(std::ceil(o.lead_in_s / lead_step_s)));
    for (int i = 0; i < n; ++i) {
      const double u = static_cast<double>(i) / n;
      rows.push_back({o.stand_s + u * o.lead_in_s,
                      from + (smootherArea(u) - 0.5) * o.lead_in_s / o.slower,
                      smootherStep(u) / o.slower,
                      smootherStep(u),
                      {},
                      {},
                      {}});
    }
  }
  const auto add = [&](double t) { rows.push_back({begin + (t - from) * o.slower, t, 1 / o.slower, 1, {}, {}, {}}); };
  const double least = 1e-4 * (to - from);  // rows closer than this would make a spline of noise
  add(from);
  for (const double t : r.times)
    if (t > from + least && t < to - least) add(t);
  add(to);
  return rows;
}

/// Mean of the yaw about an instant, a stride wide, weighted by a half cosine.
double meanYaw(const Source& s, double t) {
  double sum = 0, weight = 0;
  for (int i = -24; i <= 24; ++i) {
    const double u = t + i / 48.0 * stride_s;
    if (u < s.first() || u > s.last()) continue;
    const double w = 1 + std::cos(2 * std::numbers::pi * i / 49.0);
    sum += w * s.turn(u).z, weight += w;
  }
  return sum / weight;
}

/// Horizontal velocity [m/s] of the root that keeps the lower foot at rest, at each row: minus the velocity of the
/// foot's lowest material point relative to the root.
std::vector<Vec3> stanceVelocities(const Human& human, const std::vector<Row>& rows) {
  const auto feet = footShapes(human);
  std::vector<std::vector<Pose>> X;
  for (const Row& r : rows) X.push_back(linkPoses(human.skeleton, r.q, {rotationOf(r.turn), {}}));
  std::vector<Vec3> v(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::size_t a = i > 0 ? i - 1 : 0, b = std::min(i + 1, rows.size() - 1);
    std::array<LowestOfFoot, 2> low{lowestOfFoot(feet[0], X[i]), lowestOfFoot(feet[1], X[i])};
    // Feet within some millimetres of each other's height share the weight.
    const double right = 1 / (1 + std::exp((low[0].z - low[1].z) / alike_m));
    for (int side = 0; side < 2; ++side) {
      const BodyShape& s = *low[side].shape;
      const Vec3 moved = X[b][s.link] * s.X_LS * low[side].point_S - X[a][s.link] * s.X_LS * low[side].point_S;
      v[i] -= (side == 0 ? right : 1 - right) / (rows[b].time - rows[a].time) * moved;
    }
    v[i].z = 0;
  }
  return v;
}

/// Root heights at which the lower foot touches the ground, both together where they are as low (a soft minimum, at
/// most alike_m ln 2 above it).
std::vector<double> heightsOnGround(const Human& human, const std::vector<Row>& rows) {
  const auto feet = footShapes(human);
  std::vector<double> z;
  for (const Row& r : rows) {
    const auto X = linkPoses(human.skeleton, r.q, {rotationOf(r.turn), {}});
    const double a = lowestOfFoot(feet[0], X).z, b = lowestOfFoot(feet[1], X).z;
    z.push_back(-std::min(a, b) + alike_m * std::log1p(std::exp(-std::abs(a - b) / alike_m)));
  }
  return z;
}

/// Gaussian means over settle_s at each row.
std::vector<double> evened(const std::vector<Row>& rows, const std::vector<double>& x) {
  std::vector<double> out;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double sum = 0, weight = 0;
    while (rows[begin].time < rows[i].time - 5 * settle_s) ++begin;
    for (std::size_t k = begin; k < rows.size(); ++k) {
      const double d = (rows[k].time - rows[i].time) / settle_s;
      if (d > 4) break;
      if (d < -4) continue;
      const double width = rows[std::min(k + 1, rows.size() - 1)].time - rows[k > 0 ? k - 1 : 0].time;
      const double w = width * std::exp(-0.5 * d * d);
      sum += w * x[k], weight += w;
    }
    out.push_back(sum / weight);
  }
  return out;
}

double legOf(const Human& human) {
  const Skeleton& s = human.skeleton;
  return norm(s.joints[s.joint("knee_flexion_right")].X_PJ.origin) +
         norm(s.joints[s.joint("ankle_flexion_right")].X_PJ.origin);
}

struct Retargeter {
  const CapturedMotion& r;
  const Human& human;
  const MotionFileOptions& o;
  MotionFileNotes& notes;
  Posture stand = standing(human);
  Source source{r, turnsOf(r)};
  double from = 0, to = 0;

  void window() {
    const auto check = [&](const char* key, double t) {
      if (!(t >= source.first() - 1e-9 && t <= source.last() + 1e-9))
        throw InputError({r.file, 0, key}, fmt::format("{} s is not allowed: the file runs from {} to {} s", t,
                                                       source.first(), source.last()));
    };
    from = o.from_s.value_or(source.first()), to = o.to_s.value_or(source.last());
    check("from", from), check("to", to);
    from = std::max(from, source.first()), to = std::min(to, source.last());
    if (!((to - from) * o.slower <= longest_s))
      throw InputError({r.file, 0, "to"}, fmt::format("the motion takes {:g} s; allowed: at most {:g} s",
                                                      (to - from) * o.slower, longest_s));
    if (!(to - from > 1e-3))
      throw InputError({r.file, 0, "to"}, fmt::format("{} s does not come after \"from\", {} s", to, from));
  }

  double apart(int joint) const {
    const std::string& name = human.skeleton.joints[joint].name;
    return name.starts_with("hip_adduction")        ? -o.hips_apart_rad
           : name.starts_with("shoulder_abduction") ? o.arms_apart_rad
                                                    : 0;
  }

  /// Joints and orientation of each row; returns the heading that was taken off each.
  std::vector<double> postures(std::vector<Row>& rows) {
    double first = 0;
    const double span = std::min(1.0, to - from);
    for (int i = 0; i <= 20; ++i) first += source.turn(from + span * i / 20).z / 21;
    std::vector<double> headings;
    for (Row& row : rows) {
      const double heading = o.heading == Heading::keep ? first : meanYaw(source, std::max(row.source, source.first()));
      headings.push_back(heading);
      row.q = source.q(row.source);
      for (std::size_t j = 0; j < row.q.size(); ++j)
        row.q[j] =
            r.driven[j] ? stand.q[j] + row.share * (row.q[j] + apart(static_cast<int>(j)) - stand.q[j]) : stand.q[j];
      Vec3 turn = source.turn(row.source);
      turn.z -= heading;
      row.turn = row.share * turn;
    }
    return headings;
  }

  /// Numbers without measure, and rates between frames that overflow, are no motion.
  void requirePlaces(const std::vector<Row>& rows) const {
    for (const Row& row : rows) {
      const bool turned =
          std::all_of(row.q.begin(), row.q.end(), [](double q) { return std::abs(q) <= most_turned_rad; });
      if (!turned || !(norm(row.turn) <= most_turned_rad) || !(norm(row.origin) <= farthest_m))
        throw InputError({r.file, 0, ""},
                         fmt::format("near {:g} s of the file the body is nowhere: values are too large, "
                                     "or change too much between rows",
                                     std::clamp(row.source, source.first(), source.last())));
    }
  }

  /// The way that the feet make in the window against that of the hips: where the hips stay behind it is a treadmill;
  /// where the subject's legs are not known it gives the scale.
  void compareTravel(const std::vector<Row>& rows, const std::vector<double>& headings) {
    const auto v = stanceVelocities(human, rows);
    Vec3 feet, hips;
    for (std::size_t i = 1; i < rows.size(); ++i) {
      if (rows[i - 1].share != 1) continue;
      feet += 0.5 * (rows[i].time - rows[i - 1].time) * (v[i - 1] + v[i]);
      const Vec3 d = source.hips(rows[i].source) - source.hips(rows[i - 1].source);
      hips += rotationAbout({0, 0, 1}, -headings[i]) * Vec3{d.x, d.y, 0};
    }
    const bool stays = norm(hips) < still_share * norm(feet);
    if (stays && norm(feet) > 0.3 && o.travel == Travel::file)
      notes.lines.push_back(
          fmt::format("the pelvis stays in place while the feet walk {:.2f} m, as on a treadmill: \"travel\": \"feet\" "
                      "lets it go where they take it",
                      norm(feet)));
    if (o.scale || r.leg_m > 0) return;
    if (!stays && norm(hips) > 0.3) {
      notes.scale = dot(feet, hips) / norm2(hips);
      if (!(std::abs(notes.scale) >= 1e-3))
        throw InputError({r.file, 0, ""}, fmt::format("the body is nowhere: its feet go {:.3g} m and its pelvis {:.3g}",
                                                      norm(feet), norm(hips)));
      notes.lines.push_back(fmt::format("scale {:.3f}, by the way that the feet make", notes.scale));
    } else if (r.model_leg_m > 0) {
      notes.scale = legOf(human) / r.model_leg_m;
      notes.lines.push_back(fmt::format("scale {:.3f}, by the legs of the unscaled model", notes.scale));
    } else {
      notes.lines.push_back("scale 1: neither the subject's legs nor a travel say how large it is");
    }
  }

  /// Without the jolts of feet that take over from each other; at rest at the beginning where it starts from standing.
  std::vector<Vec3> evenedVelocities(const std::vector<Row>& rows, std::vector<Vec3> v) const {
    for (int k = 0; k < 2; ++k) {
      std::vector<double> x;
      for (const Vec3& a : v) x.push_back(a[k]);
      const auto even = evened(rows, x);
      for (std::size_t i = 0; i < v.size(); ++i) v[i][k] = settled(rows[i]) * even[i];
    }
    return v;
  }
  /// 0 at rest, 1 from half the lead-in on.
  double settled(const Row& row) const {
    return o.lead_in_s > 0 ? smootherStep((row.time - o.stand_s) / (0.5 * o.lead_in_s)) : 1;
  }

  /// x and y: the velocity of each row added up by the trapezoidal rule (lead-in) or the path itself (window).
  void path(std::vector<Row>& rows, const std::vector<double>& headings) {
    if (o.travel == Travel::feet) {
      const auto v = evenedVelocities(rows, stanceVelocities(human, rows));
      for (std::size_t i = 1; i < rows.size(); ++i)
        rows[i].origin = rows[i - 1].origin + 0.5 * (rows[i].time - rows[i - 1].time) * (v[i - 1] + v[i]);
      return;
    }
    const double h = 1e-4;
    const auto velocity = [&](const Row& row, double heading) {
      const double a = std::max(row.source - h, source.first() - 1), b = std::min(row.source + h, source.last());
      Vec3 v = (row.share * row.rate * notes.scale / (b - a)) * (source.hips(b) - source.hips(a));
      v.z = 0;
      return rotationAbout({0, 0, 1}, -heading) * v;
    };
    for (std::size_t i = 1; i < rows.size(); ++i) {
      const double dt = rows[i].time - rows[i - 1].time;
      if (rows[i - 1].share == 1) {
        Vec3 d = notes.scale * (source.hips(rows[i].source) - source.hips(rows[i - 1].source));
        d.z = 0;
        const double heading = 0.5 * (headings[i - 1] + headings[i]);
        rows[i].origin = rows[i - 1].origin + rotationAbout({0, 0, 1}, -heading) * d;
      } else {
        rows[i].origin =
            rows[i - 1].origin + 0.5 * dt * (velocity(rows[i - 1], headings[i - 1]) + velocity(rows[i], headings[i]));
      }
    }
  }

  void heights(std::vector<Row>& rows) {
    const auto base = [&](const Row& row, double level) {
      return stand.root.origin.z + row.share * (notes.scale * source.hips(row.source).z + level - stand.root.origin.z);
    };
    if (o.floor_m) {
      for (Row& row : rows) row.origin.z = base(row, -notes.scale * *o.floor_m);
      return;
    }
    const auto need = heightsOnGround(human, rows);
    double level = 0, weight = 0;
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (rows[i].share == 1) level += need[i] - notes.scale * source.hips(rows[i].source).z, weight += 1;
    level /= weight;
    std::vector<double> off;
    for (std::size_t i = 0; i < rows.size(); ++i) off.push_back(need[i] - base(rows[i], level));
    const auto even = evened(rows, off);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      rows[i].origin.z = base(rows[i], level) + settled(rows[i]) * even[i];
    }
  }

  std::unique_ptr<Motion> motion(const std::vector<Row>& rows) {
    std::vector<double> times;
    for (const Row& row : rows) times.push_back(row.time);
    std::vector<MotionColumn> columns;
    const auto add = [&](int joint, int root, auto value) {
      MotionColumn c{joint, root, {}, {}};
      for (const Row& row : rows) c.x.push_back(value(row));
      c.slope = splineSlopes(times, c.x);
      for (std::size_t i = 0; i < rows.size(); ++i)
        if (rows[i].share == 0) c.slope[i] = 0;  // at rest
      columns.push_back(std::move(c));
    };
    for (std::size_t j = 0; j < r.driven.size(); ++j)
      if (r.driven[j]) add(static_cast<int>(j), 0, [j](const Row& row) { return row.q[j]; });
    for (int k = 0; k < 3; ++k) {
      add(-1, k, [k](const Row& row) { return row.origin[k]; });
      add(-1, 3 + k, [k](const Row& row) { return row.turn[k]; });
    }
    return makeSampledMotion(std::move(times), std::move(columns), stand);
  }

  /// A pose apart, at the beginning of a file most often, is not part of the motion.
  void noteJumps() {
    double most = 0, after = 0;
    std::string which;
    for (std::size_t i = 1; i < r.times.size(); ++i) {
      if (r.times[i - 1] < from - 1e-9 || r.times[i] > to + 1e-9) continue;
      for (std::size_t j = 0; j < r.driven.size(); ++j) {
        const double turn = std::abs(r.q[i][j] - r.q[i - 1][j]);
        if (!r.driven[j] || turn < jump_rad || turn < jump_rad_per_s * (r.times[i] - r.times[i - 1]) || turn <= most)
          continue;
        most = turn, after = r.times[i], which = human.skeleton.joints[j].name;
      }
    }
    if (most > 0)
      notes.lines.push_back(fmt::format(
          "{} jumps by {:.0f} degrees from one frame to the next, up to {:g} s: a pose apart from the motion? "
          "\"from\": {:g} begins after it",
          which, most / rad_per_deg, after, after));
  }

  void noteLimits(const std::vector<Row>& rows) {
    for (const Row& row : rows)
      for (std::size_t j = 0; j < row.q.size(); ++j) {
        const Joint& joint = human.skeleton.joints[j];
        const double beyond = std::max(row.q[j] - joint.upper, joint.lower - row.q[j]) / rad_per_deg;
        if (r.driven[j] && beyond > notes.beyond_limits_deg)
          notes.beyond_limits_deg = beyond, notes.beyond_joint = joint.name;
      }
  }
};

}  // namespace

CapturedMotion repeated(const CapturedMotion& r, int times, const Human& human) {
  if (times == 1) return r;
  if (static_cast<double>(r.times.size()) * times > static_cast<double>(most_rows))
    throw InputError({r.file, 0, "repeat"}, fmt::format("{} frames {} times are too many; allowed: at most {} together",
                                                        r.times.size(), times, most_rows));
  CapturedMotion out = r;
  const std::size_t n = r.times.size() - 1;
  const double period = r.times[n] - r.times[0];
  const std::vector<Vec3> turn = turnsOf(r);
  const auto fromMiddle = [&](std::size_t i) { return (r.times[i] - r.times[0]) / period - 0.5; };
  for (std::size_t j = 0; j < r.driven.size(); ++j) {
    const double error = r.q[n][j] - r.q[0][j];
    if (r.driven[j] && !(std::abs(error) <= closure_rad))
      throw InputError({r.file, 0, "repeat"},
                       fmt::format("{} ends {:.1f} degrees from where it starts: the clip is not one whole stride",
                                   human.skeleton.joints[j].name, error / rad_per_deg));
    for (std::size_t i = 0; i <= n; ++i) out.q[i][j] -= error * fromMiddle(i);
  }
  const Vec3 off = turn[n] - turn[0];
  if (!(norm(off) <= closure_rad))
    throw InputError({r.file, 0, "repeat"}, "the pelvis does not come back to its orientation: not one whole stride");
  Vec3 step = r.hips[n] - r.hips[0];
  const double rise = step.z;
  step.z = 0;
  for (std::size_t i = 0; i <= n; ++i) {
    out.pelvis[i] = rotationOf(turn[i] - fromMiddle(i) * off);
    out.hips[i].z -= rise * fromMiddle(i);
  }
  for (int k = 1; k < times; ++k)
    for (std::size_t i = 1; i <= n; ++i) {
      out.times.push_back(r.times[i] + k * period);
      out.q.push_back(out.q[i]);
      out.pelvis.push_back(out.pelvis[i]);
      out.hips.push_back(out.hips[i] + k * step);
    }
  return out;
}

std::unique_ptr<Motion> retarget(const CapturedMotion& captured, const Human& human, const MotionFileOptions& o,
                                 MotionFileNotes& notes) {
  const auto check = [&](const char* key, double value, bool good, const char* allowed) {
    if (!good) throw InputError({o.path.string(), 0, key}, fmt::format("{} is not allowed: {}", value, allowed));
  };
  check("stand", o.stand_s, o.stand_s >= 0 && o.stand_s <= 3600, "0 to 3600 s");
  check("lead_in", o.lead_in_s, o.lead_in_s == 0 || (o.lead_in_s >= 0.1 && o.lead_in_s <= 60), "0, or 0.1 to 60 s");
  check("stand", o.stand_s, o.stand_s == 0 || o.lead_in_s > 0, "0 where lead_in is 0");
  check("repeat", o.repeat, o.repeat >= 1 && o.repeat <= 1000, "1 to 1000");
  check("slower", o.slower, o.slower >= 0.1 && o.slower <= 10, "0.1 to 10");
  check("hips_apart", o.hips_apart_rad, std::abs(o.hips_apart_rad) <= 0.6, "-0.6 to 0.6 rad");
  check("arms_apart", o.arms_apart_rad, std::abs(o.arms_apart_rad) <= 1.6, "-1.6 to 1.6 rad");
  if (o.scale) check("scale", *o.scale, *o.scale > 0 && *o.scale <= 100, "> 0, <= 100");
  const CapturedMotion r = repeated(captured, o.repeat, human);
  limbJoints(human.skeleton);
  notes.scale = o.scale.value_or(r.leg_m > 0 ? legOf(human) / r.leg_m : 1);
  Retargeter x{r, human, o, notes};
  x.window();
  auto rows = rowsOf(r, o, x.from, x.to);
  const auto headings = x.postures(rows);
  x.requirePlaces(rows);
  x.compareTravel(rows, headings);
  x.path(rows, headings);
  x.heights(rows);
  x.requirePlaces(rows);
  x.noteLimits(rows);
  x.noteJumps();
  notes.from_s = x.from, notes.to_s = x.to, notes.window_s = o.stand_s + o.lead_in_s;
  auto motion = x.motion(rows);
  notes.feet = feetOnGround(human, *motion, notes.window_s);
  return motion;
}

}  // namespace gambeson
