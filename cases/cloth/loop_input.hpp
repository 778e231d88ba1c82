#pragma once
/// Detail of fabric_input.hpp: the loop of hysteresis of the laws hysteresis and plastic, as a case file writes it.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cases/input/schema.hpp"
#include "core/material/laws/bending_laws.hpp"

namespace gambeson::schema {

/// A number of both directions, or of weft and warp apart, and of twist.
struct ByDirection {
  std::optional<double> both, weft, warp, twist;
  bool any() const { return both || weft || warp || twist; }
};

enum class LoopAxes { apart, isotropic };
enum class LoopShape { quadratic, sharp, zheng };
enum class SetBy { slip, cycles };

struct LoopInput {
  LoopAxes axes = LoopAxes::apart;
  LoopShape shape = LoopShape::quadratic;
  ByDirection first_Nm, span_per_m, width_N;
  std::optional<double> c1_Nm2;
  double width_at_per_m = 100;
  std::vector<std::pair<double, double>> virgin, stops;
  double set = 0, fatigue = 0, cycle_per_m = 250;
  SetBy set_by = SetBy::slip;
  double recovery = 0;
  std::optional<double> recovery_time_s;
};

Object loopTable();

/// The law; `bending` is its entry in the file, `given` the rigidities there (where a virgin curve is given: its last
/// slope).
BendingLaw resolveLoop(const Entry& bending, const LoopInput& in, const GivenRigidities& given);
/// The input that resolves to a law with a loop; nothing for other laws.
std::optional<LoopInput> restoreLoop(const BendingLaw& law);
/// What reports say of it.
std::string sayLoop(const BendingLaw& law);
/// The rigidity beyond friction of a measured virgin curve, where there is one.
std::optional<double> rigidityOf(const Entry& bending, const LoopInput& in);

}  // namespace gambeson::schema
