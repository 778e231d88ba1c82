#pragma once
/// A garment of flat panels is closed around its wearer by its own seams (core/motion/sewing.hpp).

#include <memory>

#include "cases/wear/run/dressing_progress.hpp"
#include "cases/wear/scene/scenario.hpp"

namespace gambeson {

/// Between looks at how far seams are closed [s].
constexpr double seams_look_s = 0.01;

/// A garment of flat panels by itself, without supports: first with the time that its seams have to close around the
/// body in the posture that they are placed for (puttingOnPosture: arms aside, or as it was scanned), and then, from
/// settle_start_s of the stage on, on its way to where the motion starts, if that is elsewhere. Without weight and
/// friction, by which edges that close over a shoulder, say, jam, and with a resistance to all motion. That is no
/// physics of a wearer who dresses, but a way to a first state whose seams are closed.
std::unique_ptr<Scenario> standingPanels(const Case& one, const Case& whole, std::size_t garment);

/// Throws RunError where the garment as a whole, its seams closed, is more than 15 cm higher or lower than its panels
/// stood: beside its wearer, if it has one. Panels go inwards, and up or down by some centimetres, while seams close.
void requireWorn(const Scenario& panels, const State& closed);

/// Its seams close around the body; then it goes along to where the motion starts. Throws RunError where they do not
/// close in that time, and where the garment has left its wearer.
State sewnAround(const Scenario& panels, DressingProgress& progress);

}  // namespace gambeson
