#pragma once
/// `gambeson fabric CARD`: the fabric of a card, what the virtual laboratory measures of it, and stops from a raw loop.

#include <filesystem>
#include <iosfwd>
#include <vector>

#include "cases/fabric/lab_test.hpp"

namespace gambeson {

struct FabricOptions {
  std::filesystem::path card;
  std::filesystem::path fabric;        ///< file that the fabric is written to; empty: none
  std::filesystem::path out;           ///< folder for what the laboratory measures; empty: it stays closed
  std::filesystem::path loop;          ///< raw loop that bending is fitted to; empty: none
  std::vector<double> directions_deg;  ///< empty: weft, and warp where the card tells it apart
  std::vector<LabTest> tests;          ///< empty: those whose numbers the card has
  laboratory::Specimen specimen;
};

/// Throws InputError, and RunError where a test fails.
int runFabric(const FabricOptions& options, std::ostream& out);

}  // namespace gambeson
