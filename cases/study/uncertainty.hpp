#pragma once
/// How sure the numbers of a study are: error bars from its runs.

#include <optional>
#include <string>
#include <vector>

#include "analysis/uncertainty/error_bar.hpp"
#include "analysis/uncertainty/spread_fit.hpp"
#include "cases/study/numbers.hpp"
#include "cases/study/study.hpp"

namespace gambeson::study {

/// A number that pages show.
struct Headline {
  enum class Quantity { peak, rms, mean_pressure, peak_pressure };
  Quantity quantity = Quantity::peak;
  std::string of;     ///< joint or zone, as files call it
  std::string label;  ///< as people do: "left hip (flexion)"

  bool isTorque() const { return quantity == Quantity::peak || quantity == Quantity::rms; }
  const char* unit() const { return isTorque() ? "Nm" : "Pa"; }
  const char* name() const;  ///< of the quantity: "peak torque"
  /// Its size in a run; nothing where the run has no such number.
  std::optional<double> in(const RunNumbers& run) const;
};

/// A headline number with its error bar.
struct BarredNumber {
  Headline what;
  double value = 0;
  ErrorBar bar;
  std::optional<SpreadFit> fabric;         ///< over Uncertainty::spreads
  std::optional<double> relative() const;  ///< half width of the whole bar, of the value
};

/// The bars of one reference.
struct Budget {
  std::size_t reference = 0;          ///< variant
  std::vector<BarredNumber> numbers;  ///< the joint that decides first
  bool mesh_taken_over = false;       ///< no finer run is beside it: the largest bar of those that have one
  int samples = 0, failed = 0;        ///< of the fabric, those that count and those that do not
  std::string no_step, no_fabric;     ///< why there is no such part where it was asked for; completes a sentence
};

/// How two courses of torque differ, of the first one's peak: the larger of the difference of their peaks and of the
/// root mean square of the difference of the courses, both from `from_s` to `to_s` on. Peaks of two runs may agree by
/// chance; courses do not. Nothing where they have not the same times, or the peak is 0.
struct CourseDifference {
  double peak = 0, rms = 0;
  double larger() const;
};
std::optional<CourseDifference> differenceOf(const RunNumbers& first, const RunNumbers& second,
                                             const std::string& joint, double from_s, double to_s);

/// The half width of the bar of the mesh of a joint's peak about the coarse or the fine run's, of that peak.
std::optional<double> meshPart(const RunNumbers& coarse, const RunNumbers& fine, const std::string& joint, About about);

/// `numbers`: what of the reference is shown.
Budget budgetOf(const Study& study, const std::vector<RunNumbers>& runs, std::size_t reference,
                const std::vector<Headline>& numbers);

/// What the reader should know: what dominates, what to do about it and by how much the bar would shrink.
std::vector<std::string> adviceOf(const Study& study, const BarredNumber& number);

}  // namespace gambeson::study
