/// The smallest gap that steps report is that of the cloth, between its samples too.

#include <gtest/gtest.h>

#include <algorithm>

#include "unit/cases/example.hpp"
#include "unit/cases/wear/scene/scene.hpp"

namespace gambeson {
namespace {

/// The disc of tests/verify/disc_on_ellipsoid.json on 8 cells lies down on an ellipsoid. It bends while it falls onto
/// it, so that samples stand off by up to 21 um more than the layer of 1 mm; the cloth itself never leaves it.
TEST(SmallestGap, CoarseClothThatLiesDownDoesNotRebound) {
  const Folder folder;
  SceneRun scene(readCase(folder.write("disc.json", R"json({
    "name": "disc",
    "garment": {"disc": {"radius": "0.06 m", "cells": 8, "center": [0, 0, "101 mm"]}},
    "fabric": {"thickness": "1 mm", "surface_density": "0.144 kg/m^2", "young": "40 kPa", "poisson": 0.3,
               "bending": {"law": "linear", "rigidity": "5e-5 N m", "twist": "1.75e-5 N m"}},
    "obstacles": [{"name": "ellipsoid", "ellipsoid": {"semi_axes": [0.14, 0.14, 0.1]}}],
    "contact": {"layer": "1 mm", "friction": 0.2},
    "air": {"drag": "10 kg/(m^2 s)"},
    "time": {"duration": "0.2 s", "max_step": "0.03125 ms"}
  })json")));
  double farthest = 0, nearest = 1;
  int touching = 0;
  scene.run(0.022, [&](const State&, const State&, const StepReport& r, const StepResult&, const Frequency&) {
    if (r.contacts == 0) return true;
    ++touching;
    farthest = std::max(farthest, r.smallest_gap_m);
    nearest = std::min(nearest, r.smallest_gap_m);
    return true;
  });
  EXPECT_GT(touching, 600);
  EXPECT_LT(farthest, 1.001e-3);
  EXPECT_GT(nearest, 0.999e-3);
}

}  // namespace
}  // namespace gambeson
