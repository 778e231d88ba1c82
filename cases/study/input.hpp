#pragma once
/// A study as its file has it, before it becomes variants.

#include "cases/study/study.hpp"

namespace gambeson::study {

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
  Limits limits = publishedLimits();
  std::vector<PictureCase> pictures{
      {PictureTime::peak, 0, PictureField::stress, View::front_right, 640, 720},
  };
};

}  // namespace gambeson::study
