#pragma once
/// A plot of y over x as inline SVG: lines for what was measured, open circles for published points.

#include <string>
#include <vector>

namespace gambeson {

/// What points are drawn as: open circles, or filled signs in the colour of a light.
enum class PointMark { open, green, doubtful, amber, red, unknown };

struct XySeries {
  std::string name;
  std::vector<double> x, y;  ///< points that are not finite interrupt the line
  bool circles = false;      ///< points instead of a line
  PointMark mark = PointMark::open;
};

struct XyPlot {
  std::string title, caption, x_name, y_name;
  std::vector<XySeries> series;
  bool logarithmic = false;  ///< both axes; points <= 0 are left out
  bool equal = false;        ///< a unit is as long on both axes: of shapes
};

/// A figure with the plot, its legend and its caption. Throws InputError where a series has not one y per x.
std::string xyChart(const XyPlot& plot);

/// The same as a picture of its own, an SVG file with its title, legend and `notes` in it.
std::string xyPicture(const XyPlot& plot, const std::vector<std::string>& notes);

}  // namespace gambeson
