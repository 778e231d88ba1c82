#pragma once
/// What a test of the virtual laboratory leaves: readings beside the card's, a table, a picture, files.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cases/cloth/card.hpp"
#include "cases/fabric/laboratory.hpp"
#include "core/material/fit_stops.hpp"

namespace gambeson {

/// A number as KES reads it, SI, and its unit there.
struct Reading {
  std::string name, unit;
  double per_unit = 1;         ///< SI of one of the unit
  std::optional<double> card;  ///< absent: the card does not say it of this direction
  double measured = 0;
  double at = 0;  ///< where it was read: curvature [1/m] or angle [rad]; of slopes where they begin
};

struct KesTest {
  bool bending = true;  ///< else shear
  double direction_deg = 0;
  laboratory::Loop loop;
  std::vector<Reading> readings;

  std::string title() const;  ///< "KES-FB2 bending, along the weft"
  std::string stem() const;   ///< of its files: "bending_22.5"
};

/// Readings of a loop beside what the card says of its direction. `width_at_per_m`: where 2HB is read.
std::vector<Reading> bendingReadings(const FabricCard& card, const KesTest& test, double width_at_per_m);
std::vector<Reading> shearReadings(const FabricCard& card, const KesTest& test);

/// What is said of a test on the terminal, and of a card and its fabric.
std::string testTable(const KesTest& test);
std::string fabricTable(const FabricCard& card, const CardFabric& fabric);
std::string fitTable(const LoopFit& fit);

/// The loop as a table and as a picture (SVG); `raw`: the loop that bending was fitted to, shown beside it.
std::string loopCsv(const KesTest& test);
std::string loopPicture(const FabricCard& card, const KesTest& test, const std::vector<LoopSample>& raw,
                        const std::string& specimen);

/// The specimen in words.
std::string specimenText(const laboratory::Specimen& specimen);

}  // namespace gambeson
