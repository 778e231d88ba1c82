#pragma once
/// What kinds of motion differ in: a row for each, a file for each row. Who adds a kind adds its options to
/// HumanCase::motion (cases/wear/case/case.hpp), a file beside this one, and its row to the list in kind.cpp.

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cases/wear/case/case.hpp"
#include "cases/wear/case/strides.hpp"
#include "human/body/body.hpp"
#include "human/body/ground.hpp"
#include "human/motion/motion.hpp"

namespace gambeson {

namespace schema {
template <class T>
class Table;
}

struct MadeMotion {
  std::unique_ptr<Motion> motion;
  Vec3 mean_velocity_m_per_s{};      ///< of the pelvis; 0 where it does not travel
  double air_ramp_s = 0;             ///< in which air that goes along comes up to speed
  std::vector<std::string> notes{};  ///< what a user should know of it: what bears on the result,
  std::vector<std::string> facts{};  ///< and what was found in its file
  std::optional<Hurdle> hurdle{};    ///< what it steps over
};

/// All functions are of options of this kind, or of a human who moves by them.
struct MotionKind {
  using Options = decltype(HumanCase::motion);
  using Take = std::function<void(std::filesystem::path&)>;

  const char* word = "";  ///< its key in a case file
  /// Adds its key, with the table of what stands below it.
  void (*addTo)(schema::Table<Options>& table) = nullptr;
  Task task = Task::none;    ///< whose natural moments it is compared with
  bool ours = true;          ///< of our own making and tested with our own skins: they do not fold in it
  bool tells_feet = false;   ///< its notes say how its feet stand
  bool holds_apart = false;  ///< has the keys hips_apart and arms_apart
  MadeMotion (*make)(const HumanCase& moved, const Human& human) = nullptr;
  /// Time that it takes [s]. Null: that of the motion that is made.
  double (*duration)(const Options& options) = nullptr;
  /// Those that count; none where it is no walk.
  std::optional<Strides> (*strides)(const Options& options) = [](const Options&) { return std::optional<Strides>(); };
  /// What the hands carry whose weight is part of the task [kg]; none where moments are not those of holding still.
  std::optional<double> (*carried_kg)(const Options& options) = [](const Options&) { return std::optional<double>(); };
  /// What the report says is assumed of it.
  std::string (*assumption)(const Motion& motion) = [](const Motion&) -> std::string {
    return "The motion is prescribed: the wearer does not change it because of the garment.";
  };
  /// Calls `take` with each file that it is read from, and with the name of its joint map, if it may name one; `take`
  /// may put others in their place.
  void (*files)(Options& options, const Take& take, const std::function<void(std::string&)>& take_map) =
      [](Options&, const Take&, const std::function<void(std::string&)>&) {};
};

/// In the order of the documentation.
std::span<const MotionKind* const> motionKinds();
const MotionKind& kindOf(const HumanCase& human);

/// Time that the human's motion takes by itself [s].
double motionDuration(const HumanCase& h, const Human& human);
/// The strides that count of the case's human; none without one, or without a walk.
std::optional<Strides> stridesOf(const Case& c);

}  // namespace gambeson
