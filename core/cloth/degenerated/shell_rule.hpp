#pragma once
/// Where the degenerated shell integrates, and where it takes its transverse shear.

#include <array>
#include <cmath>
#include <vector>

namespace gambeson {

/// Rules of the bilinear degenerated shell (Man 2006, section 2.3; Hughes 1987, chapter 6).
enum class ShellRule {
  mitc4,      ///< 2 x 2 points; transverse shear from the middles of the sides (Dvorkin and Bathe 1984): does not lock
  one_point,  ///< 1 point for all, the thesis's: does not lock in regular meshes, and leaves hourglass motions without
              ///< stiffness
  selective,  ///< 2 x 2 points, transverse shear at the middle alone: does not lock in regular meshes
  full        ///< 2 x 2 points for all: locks where cells are much longer than the sheet is thick
};

/// A place of a cell in natural coordinates, -1 to 1.
struct Natural {
  double xi = 0, eta = 0;
};

/// A point of the rule: its place, its weight, whether it counts in-plane strains and transverse shear, and how it
/// makes its shear from that of the stations (of at most 4).
struct RulePoint {
  Natural at;
  double weight = 1;
  bool plane = true, shear = true;
  std::array<double, 4> on13{}, on23{};
};

struct RuleTable {
  std::vector<RulePoint> points;
  std::vector<Natural> stations;  ///< where transverse shear is taken
};

inline RuleTable tableOf(ShellRule rule) {
  const double g = 1 / std::sqrt(3.0);
  const std::array<Natural, 4> gauss{{{-g, -g}, {g, -g}, {-g, g}, {g, g}}};
  RuleTable table;
  switch (rule) {
    case ShellRule::mitc4:
      table.stations = {{0, -1}, {0, 1}, {-1, 0}, {1, 0}};
      for (const Natural& p : gauss)
        table.points.push_back({p,
                                1,
                                true,
                                true,
                                {0.5 * (1 - p.eta), 0.5 * (1 + p.eta), 0, 0},
                                {0, 0, 0.5 * (1 - p.xi), 0.5 * (1 + p.xi)}});
      break;
    case ShellRule::one_point:
      table.stations = {{0, 0}};
      table.points = {{{0, 0}, 4, true, true, {1}, {1}}};
      break;
    case ShellRule::selective:
      table.stations = {{0, 0}};
      for (const Natural& p : gauss) table.points.push_back({p, 1, true, false, {}, {}});
      table.points.push_back({{0, 0}, 4, false, true, {1}, {1}});
      break;
    case ShellRule::full:
      table.stations.assign(gauss.begin(), gauss.end());
      for (std::size_t k = 0; k < 4; ++k) {
        table.points.push_back({gauss[k], 1, true, true, {}, {}});
        table.points.back().on13[k] = table.points.back().on23[k] = 1;
      }
      break;
  }
  return table;
}

}  // namespace gambeson
