#pragma once
/// The obstacles that deform at the two ends of a step.

#include <limits>

#include "core/contact/deformed.hpp"

namespace gambeson {

struct Model;
class Stage;

/// Scratch: positions at both ends, each asked of the stage once (a step starts where the last one ended), and the
/// surfaces at the start.
struct DeformingWork {
  DeformedVertices start, end;
  DeformedSurfaces surfaces;
  // What they are of.
  const Model* model = nullptr;
  const Stage* stage = nullptr;
  double start_s = std::numeric_limits<double>::quiet_NaN(), end_s = start_s;
  double surfaces_start_s = start_s, surfaces_end_s = start_s;
};

/// Positions at both times, and surfaces at the first.
void placeDeforming(const Model& model, const Stage& stage, double start_s, double end_s, DeformingWork& work);

/// Positions of the vertices of all obstacles that deform. Throws RunError where one is not finite.
DeformedVertices deformedVertices(const Model& model, const Stage& stage, double time_s);

}  // namespace gambeson
