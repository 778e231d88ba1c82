#pragma once
/// What a test of the virtual laboratory leaves: readings beside the card's, a table, a picture, files.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/render/render.hpp"
#include "cases/cloth/card.hpp"
#include "cases/fabric/lab_test.hpp"
#include "core/material/fit_stops.hpp"

namespace gambeson {

/// What is said of a test on the terminal, and of a card and its fabric.
std::string testTable(const MeasuredTest& test);
std::string fabricTable(const FabricCard& card, const CardFabric& fabric);
std::string fitTable(const LoopFit& fit);

/// The loop as a table and as a picture (SVG); `raw`: the loop that bending was fitted to, shown beside it.
std::string loopCsv(const MeasuredTest& test);
std::string loopPicture(const FabricCard& card, const MeasuredTest& test, const std::vector<LoopSample>& raw,
                        const std::string& specimen);

/// The draped specimen on its support, seen from above its side. Throws RunError where nothing can be drawn.
Image drapePicture(const FabricCard& card, const MeasuredTest& test);

/// The specimen in words.
std::string specimenText(const laboratory::Specimen& specimen);

}  // namespace gambeson
