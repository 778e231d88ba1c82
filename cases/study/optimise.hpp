#pragma once
/// What a study optimises: how thick its garments are, region by region; and what was found.

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cases/study/map_search.hpp"
#include "cases/study/setting.hpp"

namespace gambeson::study {

/// A named region of a garment of the case.
struct MapRegion {
  std::string name;
  std::size_t garment = 0, region = 0;  ///< where the case has it
  std::string path;                     ///< of its factor: "garments[1].regions[0].thickness"
  double factor = 1;                    ///< that the case has
  double thickness_m = 0;               ///< where the factor is 1
  bool kept = false;                    ///< protected: it stays as the case has it
};

/// A run of a map. Factors are those of the regions that are free.
struct MapRun {
  std::string folder;
  std::vector<double> map;
  double torque_Nm = 0;  ///< largest added torque of the joints that count; infinite where the run failed
  std::string joint;     ///< where, as people read it
  double mass_kg = 0;    ///< of all garments, as the run has it
  int failing = 0;       ///< of its checks
  std::string why;       ///< where it failed
};

/// The map of the case and the best one, run alike.
struct MapPair {
  std::string what;  ///< what is otherwise than in the search: "time.step_safety 0.8"
  MapRun start, best;
};

struct FoundMap {
  std::vector<MapRun> runs;  ///< of the search, in its order; the first is the start
  std::size_t best = 0;
  std::vector<double> mass_kg;  ///< of the free regions where their factor is 1
  std::vector<MapPair> repeats;
  std::optional<MapPair> finer;

  const MapRun& start() const { return runs[0]; }
  const MapRun& found() const { return runs[best]; }
};

struct Optimise {
  Aim aim = Aim::torque;
  std::vector<MapRegion> regions;   ///< free and kept, as the case has them
  std::vector<std::string> joints;  ///< names; empty: all that turn
  std::optional<double> mass_kg;    ///< of all garments; absent: that of the case
  double limit_Nm = 0;
  double least = 0.5, most = 1.5, step = 0.25;
  int runs = 20;
  int line = 0;                                                       ///< in the study's file
  std::vector<std::pair<std::string, std::vector<Setting>>> repeats;  ///< numerics alone, with what they are called
  std::vector<Setting> finer;                                         ///< empty: none
  JsonNode base;                                                      ///< the case's file
  std::filesystem::path case_file;
  std::vector<Setting> common;  ///< set in every run
  FoundMap found;

  std::vector<const MapRegion*> free() const;
};

/// What the map that was found is worth. Both maps are run on one mesh with one step, so that what mesh and step do to
/// both drops out: how far the gain itself moves is the error bar.
struct MapGain {
  double gain = 0;             ///< Aim::torque: 1 - torque of the best / torque of the start; Aim::mass: of the masses
  bool scattered = false;      ///< a repeat changed a torque at all: else nothing is known of the noise
  double noise = 0;            ///< the largest |gain in a repeat - gain|; Aim::mass: of the best map's torque, relative
  std::optional<double> mesh;  ///< the same of the finer mesh
  std::optional<double> finer;  ///< the gain there; Aim::mass: the torque there
  bool sure =
      false;  ///< the gain is above the bar and the finer mesh has it too; Aim::mass: torque and bar below limit
  std::size_t helps_until = 0;  ///< run of the search after which none gained more than the noise

  double bar() const { return noise + mesh.value_or(0); }
};
MapGain gainOf(const Optimise& o);

}  // namespace gambeson::study
