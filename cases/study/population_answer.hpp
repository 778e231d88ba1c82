#pragma once
/// Whom a garment fits and whom it burdens: from the runs of a population. Pure functions of their numbers.

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/share.hpp"
#include "cases/study/numbers.hpp"
#include "cases/study/study.hpp"

namespace gambeson::study {

inline constexpr std::array<const char*, 3> kBurdened{"hip", "knee", "elbow"};

/// Both sides and all movements of a joint together.
struct JointBurden {
  bool looked = false;         ///< the run has such a joint
  bool touched = false;        ///< the garment touches something beyond it
  std::optional<double> part;  ///< the largest, of the natural moment
  std::string label;           ///< of that: "left hip (flexion)"
  Light light = Light::unknown;
};

/// Whether it went on: whole (dressing ends without crossings, and no fabric is stretched beyond what its card states).
enum class Dressed { yes, failed, crossed, stretched };

/// How a wearer fares in one size.
struct Fitting {
  std::size_t variant = 0;
  int size = -1;
  Dressed dressed = Dressed::failed;
  std::string why;              ///< where it did not go on
  bool judged_stretch = false;  ///< the fabric states what it stands
  std::array<JointBurden, kBurdened.size()> burdens;
  std::optional<double> worst_part;  ///< of all joints
  std::string worst_joint;
  std::string presses;  ///< the part of the body that is furthest from comfortable; empty where none is pressed on
  Light comfort = Light::unknown;
  double part_of_limit = 0;  ///< of its pressure

  bool on() const { return dressed == Dressed::yes; }
};

struct WearerAnswer {
  std::vector<Fitting> fittings;  ///< of the sizes tried
  int best = -1;                  ///< of these the one to take; -1: none is tried
  const Fitting* taken() const { return best < 0 ? nullptr : &fittings[static_cast<std::size_t>(best)]; }
};

/// Of the wearers so many.
struct PopulationShare {
  std::string what;
  int yes = 0;       ///< by the number
  int doubtful = 0;  ///< of them those whose run has a check that fails
  int no = 0, unknown = 0;
  bool touched = true;  ///< of a joint: the garment touches something beyond it, on someone
  int of() const { return yes + no; }
  ShareInterval interval() const { return wilsonInterval(yes, of()); }
};

struct PopulationAnswer {
  std::vector<WearerAnswer> wearers;
  std::vector<PopulationShare> shares;  ///< put on, then the joints that were looked at, then comfort
  std::vector<std::size_t> worst;       ///< up to three wearers whom it burdens most, those it does not go on first
  std::string sentence;
  bool judged_stretch = false;
};

/// population.csv: a row for each size that a wearer tries, and for each wearer who tries none.
std::string populationCsv(const Study& study, const PopulationAnswer& answer);
nlohmann::ordered_json populationJson(const Study& study, const PopulationAnswer& answer);

PopulationAnswer answerOf(const Study& study, const std::vector<RunNumbers>& runs);

}  // namespace gambeson::study
