#include "cases/wear/case/motions/kind.hpp"

#include <array>
#include <variant>

namespace gambeson {

extern const MotionKind stand_motion, walk_motion, stairs_motion, aim_motion, trajectory_motion, file_motion,
    sit_motion, kneel_motion, step_over_motion, markers_motion;

std::span<const MotionKind* const> motionKinds() {
  static constexpr std::array kinds{&stand_motion, &walk_motion, &stairs_motion, &aim_motion,       &trajectory_motion,
                                    &file_motion,  &sit_motion,  &kneel_motion,  &step_over_motion, &markers_motion};
  static_assert(kinds.size() == std::variant_size_v<MotionKind::Options>);
  return kinds;
}

const MotionKind& kindOf(const HumanCase& human) { return *motionKinds()[human.motion.index()]; }

double motionDuration(const HumanCase& h, const Human& human) {
  const MotionKind& kind = kindOf(h);
  return kind.duration ? kind.duration(h.motion) : kind.make(h, human).motion->duration();
}

std::optional<Strides> stridesOf(const Case& c) {
  return c.human ? kindOf(*c.human).strides(c.human->motion) : std::nullopt;
}

}  // namespace gambeson
