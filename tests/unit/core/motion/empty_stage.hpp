#pragma once
/// A stage without obstacles and anchors.

#include "core/motion/model.hpp"

namespace gambeson::shapes {

class EmptyStage : public Stage {
 public:
  void placements(double, std::span<Placement>, std::span<Placement>) const override {}
};

}  // namespace gambeson::shapes
