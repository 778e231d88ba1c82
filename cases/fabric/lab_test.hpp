#pragma once
/// The tests that the virtual laboratory has, what each measures, and in which units it is shown.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "cases/cloth/card.hpp"
#include "cases/fabric/drape_series.hpp"
#include "cases/fabric/laboratory.hpp"

namespace gambeson {

enum class LabTest { bending, shear, tension, bias, cantilever, drape };

/// How a test is called and shown: what its loop has across and upwards, with SI of one of the units.
struct LabTestKind {
  LabTest test;
  const char *word, *title, *x_label, *y_label;
  double x_unit, y_unit;
  std::vector<std::string> columns;  ///< of its table: in these units, in SI, and the loss
};
const std::vector<LabTestKind>& labTests();
const LabTestKind& kindOf(LabTest test);

/// A number as the laboratory reads it, SI, and its unit there.
struct Reading {
  std::string name, unit;
  double per_unit = 1;         ///< SI of one of the unit
  std::optional<double> card;  ///< absent: the card does not say it of this direction
  double measured = 0;
  double at = 0;  ///< where it was read: curvature [1/m], angle [rad] or strain; of slopes where they begin
  std::optional<double> load;  ///< of a strain, the force per width at which it was read [N/m]
  /// Of shares, whose difference from the card's is said in points of a hundred; else it is relative.
  bool share = false;
};

struct MeasuredTest {
  LabTest test = LabTest::bending;
  double direction_deg = 0;
  laboratory::Loop loop;  ///< of cantilevers the overhang: how far it reaches, and how deep it hangs [m]
  std::vector<Reading> readings;
  std::optional<laboratory::DrapeSeries> drapes = {};  ///< of that test
  std::vector<std::string> notes = {};                 ///< said below the readings

  /// Of a drape, the middle start, whose outline is the loop: x and y [m].
  const laboratory::Draped& drawn() const { return drapes->starts[drapes->starts.size() / 2]; }
  std::string title() const;  ///< "KES-FB2 bending, along the weft"
  std::string stem() const;   ///< of its files: "bending_22.5"
};

/// Which tests a card asks for: those whose numbers it has.
std::vector<LabTest> testsOf(const FabricCard& card);
/// In which directions, unless the user says: weft, and warp where the card tells it apart; the bias of that test.
std::vector<double> directionsOf(LabTest test, const FabricCard& card);

/// Makes the test of a fabric, and reads it beside the card. Throws RunError where a specimen finds no equilibrium.
MeasuredTest measureTest(LabTest test, double direction_deg, const FabricCard& card, const CardFabric& fabric,
                         laboratory::Specimen specimen);

}  // namespace gambeson
