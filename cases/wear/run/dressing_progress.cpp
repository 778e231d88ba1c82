#include "cases/wear/run/dressing_progress.hpp"

#include "cases/runs/results_folder.hpp"
#include "cases/wear/recording/scene_fields.hpp"
#include "cases/wear/recording/state_checkpoint.hpp"
#include "core/io/own_file.hpp"
#include "core/io/values_file.hpp"

namespace gambeson {

template <class A, Of<DressedGarment> T>
void fields(A& a, T& g) {
  auto& [name, points, law, history] = g;
  a("name", name)("points", points)("law", law)("history", history);
}
template <class A, Of<Dressed> T>
void fields(A& a, T& d) {
  auto& [body, posture, garments] = d;
  a("body", body)("posture", posture)("garments", garments);
}

namespace {

/// Before the names of a state's numbers and whole numbers.
constexpr std::string_view kReals = "state reals ", kIntegers = "state integers ";

std::map<std::string, Values> valuesOf(Donning donning, const Checkpoint& c) {
  std::map<std::string, Values> values;
  values["donning"].integers = {static_cast<int>(donning)};
  values["time"].reals = {c.time_s};
  for (const auto& [name, numbers] : c.reals) values[std::string(kReals) + name].reals = numbers;
  for (const auto& [name, numbers] : c.integers) values[std::string(kIntegers) + name].integers = numbers;
  return values;
}

}  // namespace

DressingProgress::DressingProgress(std::filesystem::path file, std::string identity, bool resume)
    : file_(std::move(file)), identity_(std::move(identity)) {
  const auto values = resume ? readValues(file_, identity_) : std::nullopt;
  if (!values) {
    removeOwnFile(file_);
    return;
  }
  resumes_ = true;
  ArchiveReader(*values, file_.string())("worn", worn_);
  const auto donning = values->find("donning"), time = values->find("time");
  if (donning == values->end() || time == values->end()) return;  // between two garments
  donning_ = static_cast<Donning>(donning->second.integers.at(0));
  state_.emplace();
  state_->time_s = time->second.reals.at(0);
  for (const auto& [name, v] : *values) {
    if (name.starts_with(kReals)) state_->reals[name.substr(kReals.size())] = v.reals;
    if (name.starts_with(kIntegers)) state_->integers[name.substr(kIntegers.size())] = v.integers;
  }
}

void DressingProgress::show(const std::string& garment, double start_s) {
  // Of a garment that was stopped on the way, what is done already took no time here.
  shown_ = std::make_unique<Progress>(-start_s, state_ ? state_->time_s - start_s : 0, stderr, " s",
                                      file_.empty() ? file_ : file_.parent_path() / kProgressFile);
  garment_ = garment, start_s_ = start_s;
}

std::optional<State> DressingProgress::take(Donning donning, Frequency& frequency) {
  if (!state_ || donning != donning_) return {};
  State state = stateOf(*state_, frequency);
  state_.reset();
  return state;
}

void DressingProgress::keep(Donning donning, const State& state, const Frequency& frequency) {
  const char* const words[]{"stitching", "putting on", "moving"};
  if (shown_) shown_->update(state.time_s - start_s_, words[static_cast<int>(donning)] + (" " + garment_));
  if (file_.empty() || std::chrono::steady_clock::now() - last_ < every) return;
  write(valuesOf(donning, checkpointOf(state, frequency)));
}

void DressingProgress::add(const Dressed& one) {
  shown_.reset();
  worn_.body = one.body;
  worn_.posture = one.posture;
  worn_.garments.push_back(one.garments.at(0));
  if (!file_.empty()) write({});
}

void DressingProgress::finish() {
  if (!file_.empty()) removeOwnFile(file_);
}

void DressingProgress::write(const std::map<std::string, Values>& of_state) {
  ArchiveWriter archive;
  archive("worn", worn_);
  std::map<std::string, Values> values = archive.values();
  values.insert(of_state.begin(), of_state.end());
  writeValues(file_, identity_, values);
  last_ = std::chrono::steady_clock::now();
  if (kept) kept();
}

State stateAt(Donning donning, const Scenario& s, StepWork& work, Frequency& frequency, DressingProgress& progress) {
  if (std::optional<State> kept = progress.take(donning, frequency)) return std::move(*kept);
  return startOf(s, work);
}

}  // namespace gambeson
