#include "human/motion/task_moments.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace gambeson {
namespace {

// Bovi et al. 2011, peaks at 75 kg: natural walking hip -55.1, knee 31.3; ascending knee 86.7 N m.
TEST(TaskMoments, PeaksScaleWithMass) {
  EXPECT_DOUBLE_EQ(naturalPeakMoment_Nm("Natural", "hip_flexion_right", 75), 55.1);
  EXPECT_DOUBLE_EQ(naturalPeakMoment_Nm("Natural", "hip_flexion", 150), 110.2);
  EXPECT_DOUBLE_EQ(naturalPeakMoment_Nm("Natural", "knee_flexion_left", 75), 31.3);
  EXPECT_DOUBLE_EQ(naturalPeakMoment_Nm("Natural", "hip_adduction_left", 75), 61.7);
  EXPECT_DOUBLE_EQ(naturalPeakMoment_Nm("Ascending", "knee_flexion", 75), 86.7);
}

TEST(TaskMoments, CurvesHaveTheirPeaks) {
  for (const char* joint : {"hip_flexion", "hip_adduction", "knee_flexion"}) {
    const auto curve = naturalMoment_Nm(joint, 75);
    ASSERT_EQ(curve.size(), 51u);
    double peak = 0;
    for (const double m : curve) peak = std::max(peak, std::abs(m));
    EXPECT_NEAR(peak, naturalPeakMoment_Nm("Natural", joint, 75), 0.1) << joint;
  }
}

TEST(TaskMoments, RefusesWhatTheDataLack) {
  EXPECT_THROW(naturalPeakMoment_Nm("Natural", "hip_rotation_right", 75), InputError);
  EXPECT_THROW(naturalPeakMoment_Nm("Swimming", "hip_flexion_right", 75), InputError);
  EXPECT_THROW(naturalPeakMoment_Nm("Natural", "hip_flexion", std::nan("")), InputError);
  EXPECT_THROW(naturalPeakMoment_Nm("Natural", "hip_flexion", 0), InputError);
  EXPECT_THROW(naturalMoment_Nm("ankle_flexion", 75), InputError);
}

}  // namespace
}  // namespace gambeson
