#pragma once
/// The population of a study: wearers that are drawn, and the sizes of the garment that each of them tries.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "cases/input/schema.hpp"
#include "human/manikin/measures.hpp"

namespace gambeson::study {

enum class BodyGirth { chest, waist, hip };
inline constexpr std::array<const char*, 3> kGirthNames{"chest", "waist", "hip"};

/// A measure of the garment that a size fixes: its girth is (1 + ease) that of the body which the size is made for.
struct Grade {
  BodyGirth girth = BodyGirth::hip;
  std::string path;  ///< of the ease in the case: what the garment is wider than its wearer
  double ease = 0;   ///< of the design
  double least = 0;  ///< ease below which a size is not tried
};

/// A size, by the body that it is made for.
struct GarmentSize {
  std::string label;
  std::array<std::optional<double>, 3> girth_m;  ///< by BodyGirth
  JsonNode set;                                  ///< what else is its own
};

enum class Survey { ansur2 };

/// As a study's file has it.
struct PopulationInput {
  Survey source = Survey::ansur2;
  int count = 24, seed = 1, tries = 1;
  double women = 0.5;
  std::vector<Grade> grades;
  std::vector<GarmentSize> sizes;
};

struct Wearer {
  std::string label;   ///< "man 3"
  std::string name;    ///< "man 3 (1.78 m, 84 kg)"
  std::string folder;  ///< "man_03"
  ManikinMeasures measures;
  bool extrapolated = false;  ///< beyond the 1st or 99th percentile of the survey's stature or mass
  std::vector<int> sizes;     ///< those tried, the nearest first; none where the garment has no sizes
  std::string no_size;        ///< why none is tried; empty where the garment has none, or one is
};

struct Population {
  PopulationInput input;
  std::vector<Wearer> wearers;  ///< men, then women
  int men = 0, women = 0;
  int contradicting = 0;  ///< draws that no body has, taken again

  bool sized() const { return !input.sizes.empty(); }
};

/// Draws the wearers and finds the sizes that each tries.
Population drawPopulation(const PopulationInput& input);

/// The ease [of the wearer's girth] that a garment of this size has on a wearer, by a grade.
double easeOf(const Grade& grade, const GarmentSize& size, const ManikinMeasures& wearer);

/// The value of human.manikin that is this wearer.
JsonNode manikinNode(const ManikinMeasures& measures);

/// The fields of "population".
schema::Object populationTable();

}  // namespace gambeson::study
