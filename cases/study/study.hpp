#pragma once
/// A study: variants of a case, run and compared. Everything is read and checked before the first of them runs.

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analysis/uncertainty/error_bar.hpp"
#include "analysis/verdict.hpp"
#include "cases/input/schema.hpp"
#include "cases/kinds/any_case.hpp"
#include "cases/study/optimise.hpp"
#include "cases/study/population.hpp"

namespace gambeson::study {

struct Level {
  std::string label;
  std::string name;  ///< as people read it: the label where the study gives one, else with the axis: "thickness x 0.5"
  std::string folder;  ///< what it adds to a variant's folder
  std::vector<Setting> set;
  std::optional<double> number;  ///< where all levels of the axis are numbers, of one unit
};

struct Axis {
  std::string name, unit;
  Role role = Role::other;  ///< what it is about, which decides how its levels are compared
  bool multiple = false;    ///< levels are factors on what the case says
  bool labelled = false;    ///< the study names its levels itself
  std::vector<Level> levels;
};

/// One run.
struct Variant {
  std::string folder;            ///< within the study's
  std::string label;             ///< as people read it: "thickness x 0.5, walking"
  std::vector<int> levels;       ///< of each axis
  bool grid = false;             ///< of the axes alone, nothing else set
  bool finer = false;            ///< as the variant of the axes with its levels, on a finer mesh
  int baseline = -1;             ///< the variant that it is compared with; -1: none
  BarPart part = BarPart::none;  ///< which part of the error bar of `reference` it tells; none: it is compared
  int reference = -1;            ///< the variant that it is as but for that
  std::vector<double> scores;    ///< of a sample of the fabric: how far off each of Study::spreads is
  AnyCase definition;
  std::string identity;       ///< caseIdentity
  std::string rest_identity;  ///< with all factors 1 and the name left out: what variants of factors alone share
};

/// Torque of the garment as a part of the natural moment of the task: green below the one, red above the other, amber
/// between.
struct Limits {
  double green = 0, red = 0;
  std::string source;
};
/// The limits that human/data/effort_limits.json has.
Limits publishedLimits();

/// A number of the fabric that spreads.
struct StudiedSpread {
  std::string name;      ///< of kSpreads
  double deviation = 0;  ///< over the mean
  std::string source;    ///< "the study", or the card
};

/// What error bars are asked for.
struct Uncertainty {
  std::vector<StudiedSpread> spreads;
  std::vector<std::string> unknown;  ///< numbers of kSpreads whose spread nobody gave
  std::string source;                ///< of the spreads that the study gives
  int runs = 0;
  bool step = false, mesh = false;
};

struct Study {
  std::string name, description;
  std::filesystem::path file;  ///< empty: a batch
  std::vector<Axis> axes;
  std::vector<int> compared;  ///< axes that the baseline names: variants are compared along them
  std::vector<int> baseline;  ///< level of each of `compared`
  std::vector<Variant> variants;
  std::optional<Optimise> optimise;  ///< then variants are found by running
  Limits limits;
  std::vector<PictureCase> pictures;
  std::optional<Uncertainty> uncertainty;
  /// Where wearers are drawn: the first axis is theirs, a second one that of the sizes, where there are some.
  std::optional<Population> population;
};

/// Reads and checks a study and all its variants. Throws InputError: file, line, key, what is allowed; of a variant
/// also its label.
Study readStudy(const std::filesystem::path& file);

/// Several cases as variants without axes, named after their files.
Study batchOf(const std::vector<std::filesystem::path>& cases);

/// The fields of a study's file.
const schema::Object& studyTable();

}  // namespace gambeson::study
