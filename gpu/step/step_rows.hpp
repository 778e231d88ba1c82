#pragma once
/// Rows of the solve of a step, as arrays on a device: contacts that were found by distance, in the order of core's
/// rows (gpu/near), then impacts, in the order in which core adds them (core/motion/step_rows.hpp).

#include "gpu/device/list.hpp"
#include "gpu/near/contact.hpp"

namespace gambeson::gpu {

/// What a solve asks of a row beside its facts (ContactRow, core/contact/response.hpp).
struct RowTerms {
  double target_m_per_s = 0;   ///< least normal velocity relative to the body
  double compliance = 0;       ///< of its layer in this step [m/s per N s/m^2]
  double mean_Pa = 0;          ///< pressure that has lasted, at the start of the step
  int impact = 0;              ///< 1: found by trajectory
  int pair[3] = {-1, -1, -1};  ///< of an impact of triangles: 0 or 1 for edges, and the two primitives
};

struct StepRows {
  ContactFacts* facts;
  ContactStencil* stencil;
  BodyTouch* touch;
  RowTerms* terms;
  Vec3* traction;  ///< impulse per area: where a solve starts from, then what it found [N s/m^2]
  Vec3* impulse;   ///< what it found, on the cloth [N s]
  Count* count;    ///< on the device; above the room where rows had none
  Count room;

  GAMBESON_HD Count size() const { return *count < room ? *count : room; }
  bool operator==(const StepRows&) const = default;
};

}  // namespace gambeson::gpu
