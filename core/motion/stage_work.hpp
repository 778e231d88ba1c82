#pragma once
/// The stage at the two ends of a step: what is prescribed, asked for once at each time.

#include <limits>
#include <vector>

#include "core/contact/deformed.hpp"

namespace gambeson {

struct Model;
class Stage;

/// The stage at one time.
struct StageInstant {
  double time_s = std::numeric_limits<double>::quiet_NaN();
  std::vector<Placement> obstacles, anchors;
  DeformedVertices vertices;  ///< of the obstacles that deform
};

/// Scratch: both ends (a step starts where the last one ended), and the surfaces of what deforms at the start. A stage
/// says the same of a time whenever it is asked.
struct StageWork {
  StageInstant start, end;
  DeformedSurfaces surfaces;
  // What they are of.
  const Model* model = nullptr;
  const Stage* stage = nullptr;
  double surfaces_start_s = std::numeric_limits<double>::quiet_NaN(), surfaces_end_s = surfaces_start_s;
};

/// Sets both ends alone.
void placeEnds(const Model& model, const Stage& stage, double start_s, double end_s, StageWork& work);
/// Sets both ends, and surfaces at the first.
void placeStage(const Model& model, const Stage& stage, double start_s, double end_s, StageWork& work);

/// Positions of the vertices of all obstacles that deform. Throws RunError where one is not finite.
DeformedVertices deformedVertices(const Model& model, const Stage& stage, double time_s);

}  // namespace gambeson
