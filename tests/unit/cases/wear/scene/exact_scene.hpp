#pragma once
/// Scenes followed by the exact checker: does anything intersect, at every recorded frame or after every step?

#include <cstdio>

#include "exact/scene_intersections.hpp"
#include "unit/cases/wear/scene/scene.hpp"

namespace gambeson {

enum class Looks { every_frame, every_step };

struct ExactRun {
  int looks = 0, intersecting = 0;
  std::size_t most_pairs = 0;
  std::string first;  ///< what intersects first: when, how many, and one of them
  int steps = 0, steps_with_cloth_contact = 0, most_cloth_contacts = 0, impacts = 0, impact_zones = 0;
};

/// From the start of the case until until_s. Without `self` cloth does not meet itself: shows that the check would see
/// it.
inline ExactRun runExactly(const Case& c, double until_s, Looks looks, bool self = true) {
  SceneRun scene(c);
  if (!self) scene.scenario->model->collisions.self = false;
  const exact::SceneIntersections check(scene.model, scene.stage);
  ExactRun run;
  const auto look = [&](const State& state) {
    const exact::Intersections found = check.at(state);
    ++run.looks;
    if (found.none()) return;
    if (++run.intersecting == 1)
      run.first = "at " + std::to_string(state.time_s) + " s, step " + std::to_string(run.steps) + ": " +
                  std::to_string(found.pairs.size()) + " pairs, " + std::to_string(found.collapsed.size()) +
                  " collapsed; " + (found.pairs.empty() ? check.name(found.collapsed[0]) : check.name(found.pairs[0]));
    run.most_pairs = std::max(run.most_pairs, found.pairs.size());
  };
  const auto watch = [&](const State&, const State& after, const StepReport& r, const StepResult&, const Frequency&) {
    ++run.steps;
    run.steps_with_cloth_contact += r.cloth_contacts > 0;
    run.most_cloth_contacts = std::max(run.most_cloth_contacts, r.cloth_contacts);
    run.impacts += r.impacts;
    run.impact_zones += r.impact_zones;
    if (looks == Looks::every_step) look(after);
  };
  look(scene.state);
  const double start = scene.state.time_s, frame = c.output.frame_s;
  for (int k = 1; scene.state.time_s < until_s; ++k) {
    scene.run(std::min(until_s, start + k * frame), watch);
    if (looks == Looks::every_frame) look(scene.state);
  }
  std::printf(
      "[ measured ] %d looks, %d with intersections (%zu pairs at most); %d steps, %d with contact of cloth with cloth "
      "(%d at most), %d impacts, %d impact zones\n",
      run.looks, run.intersecting, run.most_pairs, run.steps, run.steps_with_cloth_contact, run.most_cloth_contacts,
      run.impacts, run.impact_zones);
  return run;
}

}  // namespace gambeson
