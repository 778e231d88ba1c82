/// Joint trajectories from CSV.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>

#include "core/error.hpp"
#include "human/motion.hpp"
#include "human/read_text.hpp"
#include "human/units.hpp"

namespace gambeson {
namespace {

constexpr std::uintmax_t largest_file = std::uintmax_t{256} << 20;
constexpr double largest_distance_m = 1e5, largest_angle_rad = 1e4;  // of what has no limits

/// Slopes of the monotone cubic of Fritsch and Butland (SIAM J. Sci. Stat. Comput. 5, 1984), so that the curve never
/// leaves the range of neighbouring values; one-sided three-point slopes, limited likewise, at the ends.
std::vector<double> monotoneSlopes(const std::vector<double>& t, const std::vector<double>& x) {
  const std::size_t n = t.size();
  std::vector<double> h(n - 1), d(n - 1), m(n);
  for (std::size_t i = 0; i + 1 < n; ++i) h[i] = t[i + 1] - t[i], d[i] = (x[i + 1] - x[i]) / h[i];
  if (n == 2) return {d[0], d[0]};
  for (std::size_t i = 1; i + 1 < n; ++i)
    if (d[i - 1] * d[i] > 0) {
      const double w1 = 2 * h[i] + h[i - 1], w2 = h[i] + 2 * h[i - 1];
      m[i] = (w1 + w2) / (w1 / d[i - 1] + w2 / d[i]);
    }
  const auto end = [](double h0, double h1, double d0, double d1) {
    const double s = ((2 * h0 + h1) * d0 - h0 * d1) / (h0 + h1);
    if (s * d0 <= 0) return 0.0;
    return d0 * d1 < 0 && std::abs(s) > 3 * std::abs(d0) ? 3 * d0 : s;
  };
  m[0] = end(h[0], h[1], d[0], d[1]);
  m[n - 1] = end(h[n - 2], h[n - 3], d[n - 2], d[n - 3]);
  return m;
}

struct Column {
  int joint = -1;  ///< -1: of the root
  int root = 0;    ///< 0, 1, 2: x, y, z; 3, 4, 5: roll, pitch, yaw
  double scale = 1, lower = 0, upper = 0;
  std::string name;
  std::vector<double> x, slope;
};

class Trajectory final : public Motion {
 public:
  Trajectory(std::vector<double> times, std::vector<Column> columns, Posture start)
      : times_(std::move(times)), columns_(std::move(columns)), start_(std::move(start)) {
    for (Column& c : columns_) c.slope = monotoneSlopes(times_, c.x);
  }
  double duration() const override { return times_.back(); }
  Posture at(double time_s) const override {
    const double t = std::clamp(time_s, 0.0, duration());
    const std::size_t i =
        std::clamp<std::size_t>(
            static_cast<std::size_t>(std::upper_bound(times_.begin(), times_.end(), t) - times_.begin()), 1,
            times_.size() - 1) -
        1;
    const double h = times_[i + 1] - times_[i], u = (t - times_[i]) / h, w = 1 - u;
    Posture p = start_;
    Vec3 turn;
    bool turned = false;
    for (const Column& c : columns_) {
      const double x = w * w * (1 + 2 * u) * c.x[i] + u * u * (1 + 2 * w) * c.x[i + 1] +
                       h * u * w * (w * c.slope[i] - u * c.slope[i + 1]);
      if (c.joint >= 0)
        p.q[c.joint] = x;
      else if (c.root < 3)
        p.root.origin[c.root] = x;
      else
        turn[c.root - 3] = x, turned = true;
    }
    if (turned)
      p.root.rotation =
          rotationAbout({0, 0, 1}, turn.z) * rotationAbout({0, 1, 0}, turn.y) * rotationAbout({1, 0, 0}, turn.x);
    return p;
  }

 private:
  std::vector<double> times_;
  std::vector<Column> columns_;
  Posture start_;
};

std::string_view trimmed(std::string_view s) {
  const std::size_t b = s.find_first_not_of(" \t\r"), e = s.find_last_not_of(" \t\r");
  return b == std::string_view::npos ? std::string_view{} : s.substr(b, e - b + 1);
}

std::vector<std::string_view> cells(std::string_view line) {
  std::vector<std::string_view> out;
  for (;;) {
    const std::size_t comma = line.find(',');
    out.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return out;
    line.remove_prefix(comma + 1);
  }
}

/// The column that a header cell names, with its unit and what its values may be.
Column columnOf(const std::string& cell, const Skeleton& skeleton, const InputError::Where& where) {
  const auto fail = [&](const std::string& reason) { throw InputError(where, reason); };
  if (cell.empty()) fail("the column has no name");
  const std::size_t cut = cell.rfind('_');
  const std::string name = cell.substr(0, cut), unit = cut == std::string::npos ? "" : cell.substr(cut + 1);
  const bool angle = unit == "deg" || unit == "rad", length = unit == "m";
  if (!angle && !length) fail("the name must end in a unit: _deg, _rad or _m");
  Column c;
  c.name = cell;
  c.scale = unit == "deg" ? rad_per_deg : 1;
  const double most = angle ? largest_angle_rad : largest_distance_m;
  c.lower = -most, c.upper = most;
  const std::array<const char*, 6> root{"root_x", "root_y", "root_z", "root_roll", "root_pitch", "root_yaw"};
  for (int k = 0; k < 6; ++k)
    if (name == root[k]) {
      if (angle != (k >= 3)) fail(k < 3 ? "is a length: its unit is _m" : "is an angle: its unit is _deg or _rad");
      c.root = k;
      return c;
    }
  c.joint = skeleton.joint(name);
  if (c.joint < 0) fail("the skeleton has no joint '" + name + "'");
  const Joint& j = skeleton.joints[c.joint];
  if (j.type == JointType::fixed) fail("the joint is fixed");
  if (j.mimic_of) fail("the joint follows '" + skeleton.joints[*j.mimic_of].name + "' and has no value of its own");
  if (angle != (j.type == JointType::revolute))
    fail(angle ? "the joint slides: its unit is _m" : "the joint turns: its unit is _deg or _rad");
  c.lower = std::max(c.lower, j.lower), c.upper = std::min(c.upper, j.upper);
  return c;
}

}  // namespace

std::unique_ptr<Motion> loadTrajectory(const std::filesystem::path& csv, const Human& human) {
  const std::string text = readText(csv, largest_file);
  const auto where = [&](int line, const std::string& key) { return InputError::Where{csv.string(), line, key}; };
  if (text.find('\0') != std::string::npos) throw InputError(where(0, ""), "is not text (it holds a zero byte)");

  std::vector<Column> columns;
  std::vector<double> times;
  std::string_view rest = text;
  int line = 0, blank = 0;
  while (!rest.empty()) {
    const std::size_t end = rest.find('\n');
    const std::string_view row = rest.substr(0, end);
    rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
    ++line;
    if (trimmed(row).empty()) {
      if (blank == 0) blank = line;
      continue;
    }
    if (blank > 0) throw InputError(where(blank, ""), "is blank");
    const auto cell = cells(row);
    if (line == 1) {
      if (cell[0] != "time_s") throw InputError(where(1, std::string(cell[0])), "the first column must be time_s");
      if (cell.size() < 2) throw InputError(where(1, ""), "names no joint");
      std::set<std::pair<int, int>> seen;
      for (std::size_t k = 1; k < cell.size(); ++k) {
        const std::string name(cell[k]);
        columns.push_back(columnOf(name, human.skeleton, where(1, fmt::format("column {} '{}'", k + 1, name))));
        if (!seen.insert({columns.back().joint, columns.back().root}).second)
          throw InputError(where(1, name), "stands twice");
      }
      continue;
    }
    if (cell.size() != columns.size() + 1)
      throw InputError(where(line, ""),
                       fmt::format("has {} values; the header names {} columns", cell.size(), columns.size() + 1));
    const auto number = [&](std::size_t k, const std::string& name) {
      double value;
      if (!parseNumber(cell[k], value))
        throw InputError(where(line, fmt::format("column {} '{}'", k + 1, name)),
                         fmt::format("'{}' is not a finite number", cell[k].substr(0, 40)));
      return value;
    };
    const double t = number(0, "time_s");
    if (times.empty() ? t != 0 : !(t > times.back()))
      throw InputError(where(line, "time_s"), times.empty()
                                                  ? fmt::format("starts at {}, not at 0", t)
                                                  : fmt::format("{} does not come after {}", t, times.back()));
    if (t > 1e6) throw InputError(where(line, "time_s"), fmt::format("{} is beyond 1e6", t));
    times.push_back(t);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      Column& c = columns[k];
      const double value = number(k + 1, c.name), x = c.scale * value, slack = 1e-9;
      if (!(x >= c.lower - slack && x <= c.upper + slack))
        throw InputError(where(line, fmt::format("column {} '{}'", k + 2, c.name)),
                         fmt::format("{} lies outside {:.6g} to {:.6g}", value, c.lower / c.scale, c.upper / c.scale));
      c.x.push_back(std::clamp(x, c.lower, c.upper));
    }
  }
  if (columns.empty()) throw InputError(where(1, ""), "has no header");
  if (times.size() < 2) throw InputError(where(line, ""), "needs at least two rows of values");
  return std::make_unique<Trajectory>(std::move(times), std::move(columns), standing(human));
}

}  // namespace gambeson
