#pragma once
/// The facts of human/data, compiled in (see CMakeLists.txt).

#include <string_view>

namespace gambeson::data {

extern const std::string_view manikins, regressions;
extern const std::string_view walk_natural;
extern const std::string_view stairs_ascent;
extern const std::string_view aim_at_ground;
extern const std::string_view kneel;
extern const std::string_view task_moments;
extern const std::string_view effort_limits;
extern const std::string_view garment_measurements;
extern const std::string_view map_gait2392, map_rajagopal, map_snu_woody, map_makehuman, map_makehuman_default,
    map_unreal, map_mixamo, map_gait2392_markers, map_joint_centres;

}  // namespace gambeson::data
