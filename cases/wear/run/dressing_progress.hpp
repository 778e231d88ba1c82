#pragma once
/// How far garments are that are put on one by one: kept in a file while it goes on, so that a run that is stopped
/// while it dresses goes on from there, to the same bits.

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "cases/runs/progress.hpp"
#include "cases/wear/scene/dressed.hpp"
#include "cases/wear/scene/scenario.hpp"
#include "core/io/recording.hpp"
#include "core/motion/step.hpp"

namespace gambeson {

/// What a garment that is put on goes through, in this order.
enum class Donning {
  stitching,  ///< its panels are drawn together by springs, beside the body
  wearing,    ///< it settles on the body, or its seams close around it
  following,  ///< it goes along to where the motion starts
};

class DressingProgress {
 public:
  /// Keeps nothing.
  DressingProgress() = default;
  /// In that file, for a run of that identity. `resume`: goes on from what the file has, where it is of this run; else
  /// what is there is removed. Throws InputError where the file is damaged or not our own.
  DressingProgress(std::filesystem::path file, std::string identity, bool resume);

  /// Whether there was something to go on from.
  bool resumes() const { return resumes_; }
  /// Garments that are on.
  const Dressed& worn() const { return worn_; }

  /// What is shown on a terminal from now on: the garment that is put on, in a time from start_s to 0.
  void show(const std::string& garment, double start_s);
  /// Whether the garment in hand was further than that when the run was stopped.
  bool isPast(Donning donning) const { return state_ && donning < donning_; }
  /// Its state, where it was stopped in just that; once.
  std::optional<State> take(Donning donning, Frequency& frequency);
  /// From time to time: a state from which the same steps follow.
  void keep(Donning donning, const State& state, const Frequency& frequency);
  /// The garment in hand is on.
  void add(const Dressed& one);
  /// All are on, and what the run goes on from stands elsewhere.
  void finish();

  std::chrono::duration<double> every{10};  ///< that a state is kept
  std::function<void()> kept;               ///< called each time; may be empty

 private:
  void write(const std::map<std::string, Values>& of_state);

  std::unique_ptr<Progress> shown_;
  std::string garment_;
  double start_s_ = 0;
  std::filesystem::path file_;  ///< empty: nothing is kept
  std::string identity_;
  bool resumes_ = false;
  Dressed worn_;
  Donning donning_ = Donning::stitching;
  std::optional<Checkpoint> state_;  ///< that was read, until it is taken
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Where the garment in hand was stopped, or the start of the scenario.
State stateAt(Donning donning, const Scenario& scenario, StepWork& work, Frequency& frequency,
              DressingProgress& progress);

}  // namespace gambeson
