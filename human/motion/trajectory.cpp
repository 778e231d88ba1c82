/// Joint trajectories from CSV.

#include "human/motion/trajectory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>

#include "core/error.hpp"
#include "human/files/read_text.hpp"
#include "human/files/text_lines.hpp"
#include "human/files/units.hpp"
#include "human/motion/curve.hpp"
#include "human/motion/standing.hpp"

namespace gambeson {
namespace {

constexpr std::uintmax_t largest_file = std::uintmax_t{128} << 20;
constexpr double largest_distance_m = 1e5, largest_angle_rad = 1e4;  // of what has no limits

struct Column : MotionColumn {
  double scale = 1, lower = 0, upper = 0;
  std::string name;
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
      // What stands there is not repeated: any file may have been named.
      if (cell[0] != "time_s") throw InputError(where(1, "column 1"), "the first column must be time_s");
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
    const std::string why = !times.empty() ? notAfter(t, times.back())
                            : t != 0       ? fmt::format("starts at {}, not at 0", t)
                                           : "";
    if (!why.empty()) throw InputError(where(line, "time_s"), why);
    if (t > longest_s) throw InputError(where(line, "time_s"), fmt::format("{} is beyond {} s", t, longest_s));
    if (times.size() >= most_rows)
      throw InputError(where(line, ""), fmt::format("is one row too many: at most {} are read", most_rows));
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
  std::vector<MotionColumn> values;
  for (Column& c : columns) {
    c.slope = monotoneSlopes(times, c.x);
    values.push_back(std::move(c));
  }
  return makeSampledMotion(std::move(times), std::move(values), standing(human));
}

}  // namespace gambeson
