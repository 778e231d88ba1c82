#pragma once
/// How files call parts of the edges of panels: "front.3", "front.hem", "front.3 reversed", "front.3 from 0.25 to 1".

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tryon/pattern/flat/panel.hpp"

namespace gambeson {

/// The part of an edge that a text names: its panel, a dot, and the edge's number, or its name where no other edge of
/// the panel has it. Throws InputError (no key) with the panels or edges that there are.
SeamPart partOf(std::string_view text, std::span<const Panel> panels);

/// "front.3", "front.3 reversed", "front.3 from 0.25 to 1".
std::string partText(const FlatPattern& pattern, const SeamPart& part);

/// The edges that a panel has, for messages: "0 to 5, hem, waist".
std::string edgesText(const Panel& panel);

}  // namespace gambeson
