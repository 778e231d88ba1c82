#pragma once
/// Plots as inline SVG with axes, units, grid, legend and marks, made to be read at 350 and at 560 pixels of width.

#include <string>

#include "analysis/report/report.hpp"

namespace gambeson {

/// A figure with the plot and, below it, its caption and what was left out. Series without finite values are named in
/// a notice instead of being drawn. Throws InputError where a series has not one time per value.
std::string lineChart(const Plot& plot);

/// A figure with horizontal bars, values written beside them; negative and not finite values show as text only.
std::string barChart(const BarChart& chart);

}  // namespace gambeson
