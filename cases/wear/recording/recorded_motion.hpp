#pragma once
/// A motion by the postures that results ask for.

#include <vector>

#include "cases/wear/scene/scenario.hpp"

namespace gambeson {

/// Half the time over which results take the rate of a joint [s].
inline constexpr double kRate_s = 1e-3;

/// A motion at chosen times.
struct Postures {
  double duration_s = 0;
  std::optional<Stairs> stairs;
  std::vector<double> time_s;  ///< ascending
  std::vector<Posture> at;
};

/// At all times at which results look at the scenario's motion: the bounds of its windows, where its frames are too;
/// their middles, and kRate_s before and after these; the thousandths of the first stride; the hundredths of the whole.
Postures posturesOf(const Scenario& scenario);

/// Stands for the motion that the postures are of, at their times alone: at others it throws RunError.
class RecordedMotion final : public Motion {
 public:
  explicit RecordedMotion(Postures postures) : postures_(std::move(postures)) {}
  double duration() const override { return postures_.duration_s; }
  Posture at(double time_s) const override;
  std::optional<Stairs> stairs() const override { return postures_.stairs; }

 private:
  Postures postures_;
};

}  // namespace gambeson
