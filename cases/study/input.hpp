#pragma once
/// A study as its file has it, before it becomes variants.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "cases/cloth/fabric_spread.hpp"
#include "cases/study/study.hpp"

namespace gambeson::study {

/// What variants are compared along: a design (0), where one varies; else who or what it must do for, wearers before
/// motions and kinds of cloth; a mesh (3) is none of these.
inline int rankOf(Role role) {
  return isChosen(role) ? 0 : role == Role::mesh ? 3 : role == Role::motion || role == Role::model ? 2 : 1;
}

/// What roles are called in a study's file.
const std::vector<std::pair<std::string, Role>>& roleNames();

struct AxisInput {
  std::string name, path, unit;
  std::optional<Role> role;
  JsonNode values, sets;
  std::vector<std::string> labels;
  int line = 0;
};
struct ExtraInput {
  std::string label;
  JsonNode at, set;
  bool finer = false;
};
struct ElasticityInput {
  double step = 0.1;
  JsonNode where;
};
struct UncertaintyInput {
  int runs = 12, seed = 1;
  FabricSpread spread;
  std::string source;
  bool step = true;
  std::optional<double> step_duration_s;  ///< absent: half of the motion
  std::optional<double> finer;            ///< absent: 1.5 where the study has no finer meshes of its own; 1: none
  JsonNode where;
};
struct OptimiseInput {
  Aim aim = Aim::torque;
  std::vector<std::string> regions, keep, joints;
  std::optional<double> mass_kg, limit_Nm, step;
  std::array<double, 2> between{0.5, 1.5};
  int runs = 20;
  JsonNode repeats, finer;
};
struct StudyInput {
  std::string name, description;
  std::filesystem::path file;
  JsonNode set, baseline;
  std::vector<AxisInput> axes;
  std::vector<ExtraInput> variants;
  std::optional<ElasticityInput> elasticities;
  std::optional<UncertaintyInput> uncertainty;
  std::optional<OptimiseInput> optimise;
  std::optional<PopulationInput> population;
  Limits limits = publishedLimits();
  std::optional<std::vector<PictureCase>> pictures;
};

}  // namespace gambeson::study
