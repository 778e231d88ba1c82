#include "gpu/step/device_steps.hpp"

#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/motion/forces.hpp"
#include "core/motion/resonance.hpp"
#include "core/motion/step_contact.hpp"
#include "core/motion/velocity_verlet.hpp"
#include "gpu/forces/forces.hpp"
#include "gpu/step/step_ledger.hpp"

namespace gambeson::gpu {
namespace {

using MakeDevice = std::unique_ptr<StepOnDevice> (*)(const Model&, const State&, const StageWork&, double);

/// The control of velocity Verlet, whose steps a device makes. Its own states have no points: these stand on the
/// device, and with the ledger, which may be some steps behind.
class DeviceVerlet final : public DeviceSteps, private VelocityVerlet {
 public:
  DeviceVerlet(const Model& model, const gambeson::Stage& stage, const StepControl& control, Frequency& frequency,
               StepWork& work, MakeDevice make, double room)
      : VelocityVerlet(model, stage, control, frequency, work), make_(make), room_(room), ledger_(model, stage, work) {
    if (const auto missing = stepNotCarried(model, {}, control))
      throw RunError("steps on a device do not carry " + *missing);
  }

  DeviceCounts counts() const override {
    DeviceCounts all = counts_;
    if (device_) all.repeated = device_->repeats();
    return all;
  }

  void advance(double until_s, State& state, const StepObserver& observe) override {
    mode_ = state.mode;
    hung_ = state.anchors;
    State light;
    copyControl(state, light);
    ledger_.begin(state, observe);
    try {
      VelocityVerlet::advance(until_s, light,
                              [&](const State&, const State& after, const StepReport& report, const StepResult&,
                                  const Frequency& frequency) { enter(after, report, frequency); });
      ledger_.state();
    } catch (...) {
      ledger_.settle();
      ledger_.end(state);
      throw;
    }
    ledger_.end(state);
    copyControl(light, state);
    state.mode = light.mode.empty() ? mode_ : light.mode;
    work_.times.stage += times_.stage;
    work_.times.proximity += times_.proximity;
    work_.times.contact += times_.contact;
    work_.times.impact += times_.impact;
    work_.times.force += times_.force;
    times_ = {};
    if (stands(state)) device_->complete(state);
  }

 private:
  StepReport makeStep(const State& in, double dt, State& out) override {
    if (!in.mode.empty()) mode_ = in.mode;
    out.mode.clear();
    if (in.tangled) return makeByCpu(ByCpu::tangled, in, dt, out);
    if (!in.pinched.empty()) return makeByCpu(ByCpu::pinched, in, dt, out);
    StopWatch clock;
    const double end_s = in.time_s + dt;
    placeBodies(in.time_s, end_s);
    makeDevice();
    if (!stands(in)) {
      device_->set(ledger_.state());
      stands_s_ = in.time_s;
    }
    anchors_.clear();
    for (std::size_t k = 0; k < model_.springs.size(); ++k)
      anchors_.push_back(anchors_end_[static_cast<std::size_t>(model_.springs[k].anchor)] * hung_[k]);
    clock.lap(times_.stage);
    done_ = device_->make({dt, in.last_step_s, start_, end_, shapes_, anchors_, stage_.air(end_s)});
    times_.proximity += done_.times.proximity;
    times_.contact += done_.times.contact;
    times_.impact += done_.times.impact;
    times_.force += done_.times.force;
    if (done_.by_cpu != ByCpu::none) return makeByCpu(done_.by_cpu, in, dt, out);
    made_s_ = in.time_s + dt;
    made_dt_s_ = dt;
    by_cpu_ = false;
    copyControl(in, out);
    out.time_s = made_s_;
    out.tangled = false;
    out.pinched.clear();
    out.last_step_s = dt;
    StepReport report;
    report.step_s = dt;
    report.contact = done_.contact;
    report.contacts = done_.contacts;
    report.cloth_contacts = done_.cloth_contacts;
    report.impacts = done_.impacts;
    report.impact_rounds = done_.impact_rounds;
    report.smallest_gap_m = done_.smallest_gap_m;
    report.largest_way = done_.largest_way;
    return report;
  }

  void makeDevice() {
    if (device_) return;
    const State& whole = ledger_.state();
    StageWork ends;
    placeEnds(model_, stage_, whole.time_s, whole.time_s, ends);
    device_ = make_(model_, whole, ends, room_);
  }

  /// Where all bodies are at both ends of a step.
  void placeBodies(double start_s, double end_s) {
    const std::size_t n = model_.obstacles.size();
    for (auto* at : {&start_, &end_}) at->resize(n);
    anchors_end_.resize(static_cast<std::size_t>(model_.anchor_count));
    stage_.placements(start_s, start_, anchors_end_);
    stage_.placements(end_s, end_, anchors_end_);
    std::size_t at = 0;
    for (std::size_t o = 0; o < n; ++o) {
      if (!model_.obstacles[o].deforms) continue;
      if (at == shapes_.size()) shapes_.emplace_back();
      BodyShape& shape = shapes_[at++];
      const int obstacle = shape.obstacle = static_cast<int>(o);
      std::vector<Pose> poses;
      shape.skin = stage_.skin(obstacle, start_s, shape.poses);
      if (shape.skin && stage_.skin(obstacle, end_s, poses) == shape.skin) {
        shape.poses.insert(shape.poses.end(), poses.begin(), poses.end());
        continue;
      }
      shape.skin = nullptr;
      const std::size_t vertices = std::get<TriangleMesh>(model_.obstacles[o].shape).vertices.size();
      for (auto* x : {&shape.start, &shape.end}) x->resize(vertices);
      stage_.vertices(obstacle, start_s, shape.start);
      stage_.vertices(obstacle, end_s, shape.end);
    }
  }

  StepReport makeByCpu(ByCpu why, const State& in, double dt, State& out) {
    why_ = why;
    State& whole = ledger_.state();
    if (stands(in)) device_->complete(whole);
    stands_s_ = made_s_ = std::numeric_limits<double>::quiet_NaN();
    copyControl(in, whole);
    by_cpu_ = true;
    const StepReport report = step(model_, stage_, whole, dt, cpu_out_, work_);
    copyControl(cpu_out_, out);
    return report;
  }

  /// A step is accepted.
  void enter(const State& after, const StepReport& report, const Frequency& frequency) {
    ++counts_.steps;
    if (by_cpu_) ++counts_.by_cpu, ++counts_.reasons[inWords(why_)];
    if (!by_cpu_) return ledger_.add(std::move(done_), made_dt_s_, after, report, frequency);
    copyControl(after, cpu_out_);
    ledger_.addByCpu(cpu_out_, report, frequency);
  }

  /// Whether the device stands at this state; takes over the last step where that is the state at its end.
  bool stands(const State& s) {
    if (!device_) return false;
    if (s.time_s == stands_s_) return true;
    if (!isMade(s)) return false;
    device_->accept();
    stands_s_ = s.time_s;
    made_s_ = std::numeric_limits<double>::quiet_NaN();
    return true;
  }

  /// Whether the last step of the device ends at this state.
  bool isMade(const State& s) const { return std::abs(s.time_s - made_s_) <= 1e-12 * (1 + std::abs(made_s_)); }

  /// Always on the device, also after steps by the CPU: a run that goes on from there starts with an estimate too. No
  /// cloth that a step carries damps, couples its supports or has inner unknowns, which estimates of core allow for.
  Frequency lookAtFrequency(State& s, int iterations) override {
    makeDevice();
    const StandsAt at = s.time_s == stands_s_ ? StandsAt::start : isMade(s) ? StandsAt::end : StandsAt::host;
    if (at == StandsAt::host) bringBack(s);
    s.mode = mode_;
    return device_->frequency(at, s.p, s.mode, iterations);
  }
  void bringBack(State& s) override {
    const State& whole = ledger_.state();
    s.p = s.time_s == whole.time_s ? whole.p : cpu_out_.p;
  }
  double shownFrequency2(const State&, const State&) override {
    return by_cpu_ ? ControlledSteps::shownFrequency2(ledger_.state(), cpu_out_) : done_.shown_frequency2;
  }
  double swingOf(const State&, const State&, double dt, double omega) override {
    return by_cpu_ ? swing(model_, ledger_.state(), cpu_out_, dt, omega, work_)
                   : swingOfJerk(done_.most_jerk_per_s4, dt, omega);
  }

  MakeDevice make_;
  double room_;  ///< of lists at the start, a part of the usual
  std::unique_ptr<StepOnDevice> device_;
  StepLedger ledger_;
  std::vector<Placement> start_, end_, anchors_end_;
  std::vector<BodyShape> shapes_;
  double stands_s_ = std::numeric_limits<double>::quiet_NaN(), made_s_ = stands_s_;  ///< times of the device's states
  double made_dt_s_ = 0;
  bool by_cpu_ = false;  ///< the CPU made the last step
  ByCpu why_ = ByCpu::none;
  StepDone done_;  ///< else what the device left
  State cpu_out_;
  std::vector<Vec3> mode_, hung_;  ///< State::mode and anchors, which the control has no copy of
  std::vector<Vec3> anchors_;
  DeviceCounts counts_;
  PhaseTimes times_;
};

}  // namespace

const char* inWords(ByCpu reason) {
  switch (reason) {
    case ByCpu::tangled:
      return "cloth may be tangled";
    case ByCpu::pinched:
      return "cloth is pinched";
    case ByCpu::inside:
      return "cloth is inside of a body";
    case ByCpu::impacts:
      return "impacts that rounds of solves do not end";
    case ByCpu::unsolved:
      return "contacts that contradict each other";
    case ByCpu::not_finite:
      return "numbers that are not finite";
    case ByCpu::room:
      return "lists without room";
    default:
      return "none";
  }
}

void DeviceCounts::add(const DeviceCounts& more) {
  steps += more.steps;
  by_cpu += more.by_cpu;
  repeated += more.repeated;
  for (const auto& [why, count] : more.reasons) reasons[why] += count;
}

std::optional<std::string> stepNotCarried(const Model& m, const MotionOptions& options, const StepControl&) {
  if (options.scheme != MotionScheme::verlet) return "other schemes than velocity Verlet (time.scheme)";
  if (m.strain_limit.mode != LimitMode::none) return "limits of strain (strain_limit)";
  if (!m.sewing.empty()) return "sewn seams (sewn_seams)";
  if (m.contact.followsMotion()) return "friction that depends on the motion";
  if (m.cloth->losesEnergy()) return "cloth that loses energy";
  return notCarried(m);
}

std::size_t bytesOnDevice(const Model& model) {
  const std::size_t cloth = model.surface.triangles.size(), all = model.collisions.mesh.triangles.size();
  constexpr std::size_t kFixed = 35'000'000, kOfSample = 5'900, kOfBodyTriangle = 950;
  return kFixed + kOfSample * static_cast<std::size_t>(model.surface.size()) +
         kOfBodyTriangle * (all > cloth ? all - cloth : 0);
}

std::unique_ptr<DeviceSteps> stepsOnReference(const Model& model, const gambeson::Stage& stage,
                                              const StepControl& control, Frequency& frequency, StepWork& work,
                                              double room) {
  return std::make_unique<DeviceVerlet>(model, stage, control, frequency, work, stepOnReference, room);
}
std::unique_ptr<DeviceSteps> stepsOnCuda(const Model& model, const gambeson::Stage& stage, const StepControl& control,
                                         Frequency& frequency, StepWork& work, double room) {
  return std::make_unique<DeviceVerlet>(model, stage, control, frequency, work, stepOnCuda, room);
}

}  // namespace gambeson::gpu
