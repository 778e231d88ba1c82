#pragma once
/// Which variant of a garment to take, whether it is good enough, and how sure that is: in sentences. Pure functions of
/// numbers.

#include <optional>
#include <string>
#include <vector>

#include "analysis/trust.hpp"
#include "analysis/uncertainty/error_bar.hpp"

namespace gambeson {

/// What the levels of an axis of a study are.
enum class Role { other, thickness, mesh, motion, wearer, size, material, friction, fit, model };
/// Whether one of the levels is taken. Wearers, sizes, motions and frictions all occur: of them the worst counts. Models,
/// kinds of cloth, are ways to compute one garment.
bool isChosen(Role role);

/// One level of what is compared.
struct Option {
  std::string name;            ///< "thickness x 0.75", "male_p95"
  std::optional<double> size;  ///< thickness, where it is one
  struct Garment {
    std::string name;
    double thickness_m = 0;
  };
  std::vector<Garment> garments;
  struct Cost {
    std::string motion;           ///< empty where there is one only
    std::string joint;            ///< "left hip (flexion)"
    double peak_Nm = 0;           ///< size of the largest added torque
    std::optional<double> part;   ///< of the natural moment
    std::optional<double> ratio;  ///< of the peak of the baseline, same motion and joint
    /// Of a natural moment of holding still: how far from the joint the ground's force on the foot passes.
    std::optional<double> lever_m = {};
    double end_part = 0;  ///< of the peak: what is left of it when the run ends
  };
  std::vector<Cost> costs;  ///< of each motion and joint that matters
  /// Pressure on the part of the body that is furthest from comfortable in a motion.
  struct Comfort {
    std::string motion, part;
    Light light = Light::unknown;
    double mean_Pa = 0, limit_Pa = 0;       ///< over time, where it presses most
    double peak_Pa = 0, peak_limit_Pa = 0;  ///< at any time
    std::optional<double> peak_time_s = {};
    std::string peak_during = {};  ///< "swing (80 % of the stride)", empty where there are no strides
    /// Of the limit that is nearest or furthest surpassed.
    double part_of_limit() const;
  };
  std::vector<Comfort> comforts;  ///< of each motion
  bool missing = false;           ///< a run of it failed
  bool untouched = false;         ///< in a run of it the garment touches nothing that a joint moves
  Trust trust = {};               ///< of its runs together
};

/// Runs in which something is wrong.
struct WrongRuns {
  std::vector<std::string> names;
  std::vector<int> options;  ///< of each run; -1: none that is compared
};

struct VerdictInput {
  std::string what;             ///< "thickness"
  Role role = Role::other;      ///< of what is compared
  Role setting = Role::motion;  ///< what Option::Cost::motion names; other: several things together
  bool multiple = false;        ///< its sizes are factors on the design: "thickness x 0.5"
  bool sized = false;           ///< options are sizes of which more protects more: the thickest that is green is wanted
  std::vector<Option> options;  ///< with sizes: rising
  int baseline = -1;
  double green = 0, red = 0;
  /// Half widths of the error bars of peaks, of the largest torque, the largest of all runs that tell one
  /// (analysis/uncertainty/error_bar.hpp): of the mesh, the step, and the spread of the fabric; nothing: not asked.
  std::optional<double> mesh_error, step_error, fabric_error;
  /// All of them together; nothing where none was asked.
  std::optional<double> error() const { return ErrorBar{mesh_error, step_error, fabric_error}.combined(); }
  std::string mesh_where;  ///< the runs that tell it: "thickness x 1, walking"
  struct Exponent {
    std::string motion, joint;
    PowerLaw peak, rms;
  };
  std::vector<Exponent> exponents;  ///< of the sizes, for motions and joints as in the costs
  /// A check that fails in some of the runs.
  struct Doubt {
    std::string text;    ///< completes a sentence: "energy is not kept within 5.9 %"
    bool order = false;  ///< may turn the order of the options; else it touches the sizes of the torques alone
    std::string check = {};
    WrongRuns runs = {};
  };
  std::vector<Doubt> doubts;
  std::optional<Stretch> stretch;          ///< the worst of all runs
  WrongRuns stretched;                     ///< beyond what the fabric is meant for
  double law_strain = 0;                   ///< below it the source of the fabric's law takes that law; 0: not known
  int failing_runs = 0, checked_runs = 0;  ///< with checks that fail, of how many
  double sensor_m = 0;                     ///< width over which comfort takes the mean of the pressure; 0: not known
};

/// Of all its runs together.
Trust trustOf(const VerdictInput& input);

/// "in all 3 runs", "in the run thickness x 0.75", "in 2 of 6 runs"; empty where the runs are not known.
std::string placeOf(const WrongRuns& runs, const VerdictInput& input);

/// "5 %", with as many digits as tell on which side of the limits it is: "5.04 %".
std::string percentBeside(double part, double green, double red);

/// The cost that decides: the largest part of a natural moment, or without one the largest peak; in one motion or in
/// all. Null without costs.
const Option::Cost* worstCost(const Option& option, const std::string* motion = nullptr);

/// A size at which the option taken would cost a limit, by the exponents: never beyond three times the studied range.
struct SizeFor {
  double size = 0, low = 0, high = 0;  ///< with its exponent, and with those of its joint in all motions
  std::string motion, joint;           ///< what decides
};
enum class NoSize { none, no_exponent, too_far };
/// The largest size whose every cost is below `limit`; `why` says why there is none.
std::optional<SizeFor> sizeFor(const VerdictInput& input, int option, double limit, NoSize& why);

enum class Surety { no, fairly, yes };

struct Verdict {
  int take = -1;                 ///< option: the one taken, or where none is chosen the worst; -1: none can be named
  bool chosen = true;            ///< isChosen
  Light light = Light::unknown;  ///< of the torque, by its number alone
  Light cover = Light::unknown;  ///< what the page may show
  std::string doubt;             ///< why a green number is no green page; completes a sentence
  std::string sentence;          ///< which one to take, or how the worst fares
  std::string garments;  ///< how thick its garments are, where sizes are compared: "shirt 1.56 mm, belt 1.15 mm"
  std::string enough;    ///< whether that is good enough, against the limits
  std::string estimate;  ///< which size would be; empty where the question does not arise
  std::string why;       ///< empty, as choice and estimate are, where no number can be relied on
  std::string comfort;   ///< empty where no pressure is judged
  Light comfort_light = Light::unknown;
  Surety surety = Surety::no;         ///< of the choice
  std::string choice, numbers;        ///< how sure the choice is, and how exact the numbers are
  std::optional<double> order;        ///< the next costs that many times as much, where each is worst
  std::optional<double> holds_up_to;  ///< relative error of all torques up to which choice and light stay
};
Verdict verdictOf(const VerdictInput& input);

}  // namespace gambeson
