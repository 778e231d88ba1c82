#pragma once
/// A study as its file has it, before it becomes variants.

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
struct StudyInput {
  std::string name, description;
  std::filesystem::path file;
  JsonNode set, baseline;
  std::vector<AxisInput> axes;
  std::vector<ExtraInput> variants;
  std::optional<ElasticityInput> elasticities;
  std::optional<PopulationInput> population;
  Limits limits = publishedLimits();
  std::vector<PictureCase> pictures{
      {PictureTime::peak, 0, PictureField::stress, View::front_right, PictureAround::wearer, 640, 720},
  };
};

}  // namespace gambeson::study
