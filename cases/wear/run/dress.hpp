#pragma once
/// Dressing (Zheng 2013, sections 6.3 and 4.5.3): each garment is put on the bare body by itself, then all are worn
/// together, tangled as they may be, and freed of each other in their order, from the innermost out.

#include "cases/wear/run/dressing_progress.hpp"
#include "cases/wear/scene/dressed.hpp"
#include "cases/wear/scene/scenario.hpp"

namespace gambeson {

/// Puts on each garment of the case alone: by virtual stitching where it says so, otherwise by virtual projecting (or
/// as drafted, where the case has none), and lets it settle there, without weight and held by friction. In the posture
/// in which the motion starts. Throws RunError naming the garment that cannot be put on.
Dressed putOnApart(const Case& c);
/// The same, from where it was stopped; kept on the way.
Dressed putOnApart(const Case& c, DressingProgress& progress);
/// Builds what putOnApart starts from, with the same errors, and lets it go.
void buildApart(const Case& c);

/// Garments that are put on one by one (dressing.layer_by_layer) are, and the scenario starts with them; others start
/// as the scenario was built.
void putOn(Scenario& scenario);
void putOn(Scenario& scenario, DressingProgress& progress);

/// Settles what is worn together up to time 0, from `apart`. Throws as wear and dress.
Dressed wearTogether(const Case& c, const Dressed& apart);

/// The whole of dressing up to time 0, without recording: putOnApart or projecting, then settling together. Throws
/// RunError where cloth still passes through cloth or the body then.
Dressed dress(const Case& c);

}  // namespace gambeson
