#pragma once
/// The search for a thickness map: which factors to try next. It knows no case and no run.

#include <functional>
#include <vector>

namespace gambeson::study {

/// Least torque at a given mass, or least mass below a given torque.
enum class Aim { torque, mass };

/// Factors of regions, each between `least` and `most`; the mass of all is sum(mass_kg[i] map[i]).
struct MapProblem {
  Aim aim = Aim::torque;
  std::vector<double> start;    ///< what is tried first; with Aim::torque its mass is the given one
  std::vector<double> mass_kg;  ///< of each region where its factor is 1
  double least = 0.5, most = 1.5;
  double step = 0.25;     ///< of the factors, at first
  double limit_Nm = 0;    ///< of the torque, with Aim::mass
  std::size_t runs = 20;  ///< maps that are tried, at most

  double massOf(const std::vector<double>& map) const;
};

/// Factors are multiples of a millionth, so that a name of a few digits tells a map. Masses are equal as far as that.
double roundedFactor(double factor);

/// The map of the given mass that has these factors in all regions but the heaviest, which takes what is left; where
/// that would leave the bounds, all regions move together by the same amount, as far as their bounds let them. Requires
/// a mass between those of all at `least` and all at `most`.
std::vector<double> mapOfMass(const MapProblem& problem, const std::vector<double>& map, double mass_kg);

struct TriedMap {
  std::vector<double> map;
  double torque_Nm = 0;
};

/// Asks `torque` for one map after the other, `start` first, none twice. COBYLA (Powell 1994; NLopt's), which takes the
/// torque as linear between maps that it has tried: no derivatives, no random numbers, the same answers lead to the
/// same questions. With Aim::torque the heaviest region follows from the others; with Aim::mass the torque is a
/// constraint, which keeps 1 % off its limit. It ends where a step is shorter than a hundredth of a factor, or with `runs`.
std::vector<TriedMap> searchMap(const MapProblem& problem,
                                const std::function<double(const std::vector<double>&)>& torque);

/// Which of the maps that were tried is the best: of least torque, or of least mass among those below the limit
/// (without one: of least torque). The first of equals.
std::size_t bestOf(const MapProblem& problem, const std::vector<TriedMap>& tried);

}  // namespace gambeson::study
