/// The largest frequency on the reference device: that of core, the same bits for any width of a group, and nothing of
/// a step changed by it.
#include "gpu/step/device_frequency.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "core/motion/velocity_verlet.hpp"
#include "force_cloths.hpp"
#include "gpu/device/reference.hpp"
#include "gpu/step/device_steps.hpp"
#include "gpu/step/step_on_device.hpp"
#include "unit/core/motion/motion_shapes.hpp"

namespace gambeson::gpu {
namespace {

using namespace shapes;

struct Case {
  std::string name;
  std::unique_ptr<Model> model;
  std::vector<Vec3> p;
  const char* governing;
};

Case of(const ForceCloth& c, const char* governing, ModelOptions options = {}) {
  options.self_contact = false;
  options.samples_per_cell = 4;
  return {c.name, buildModel(c.cloth, options, {}, {}, {}), c.p, governing};
}

/// Springs of supports and stitches, stiff enough to count, at a cloth that is held at two points.
ModelOptions sprung() {
  ModelOptions options;
  options.held_control_points = {0, 1};
  options.anchor_count = 1;
  options.springs = {{5, 0, 2e3, -1, {}}, {9, 0, 500, -1, {}}};
  options.stitches = {{12, 40, 3e3, 0.3}, {13, 12, 200, 0.1}};
  return options;
}

std::vector<Case> cases() {
  std::vector<Case> all;
  Fabric bends = sheetFabric();
  bends.law = ZhengBending{{0.02, 0.02}, 30, 3};
  all.push_back(of(forceCloth("a sheet", squareSheet(8, 0.2, 0), 1e-3), "membrane"));
  all.push_back(of(forceCloth("steepest bending", squareSheet(8, 0.2, 0, bends), 1e-3), "bending"));
  all.push_back(of(forceCloth("springs and stitches", squareSheet(8, 0.2, 0), 1e-3), "spring", sprung()));
  const Fabric plain = plainFabric();
  all.push_back(of(forceCloth("C0 seams", fourPatches(2, 2, false, SeamKind::C0, 300, plain), 1e-3), "seam"));
  for (ForceCloth& c : quadCloths()) {
    if (c.name == "uneven" || c.name == "double knots") continue;
    all.push_back(of(c, nullptr));
  }
  for (ForceCloth& c : otherCloths()) all.push_back(of(c, nullptr));
  return all;
}

struct Found {
  Frequency f;
  std::vector<Vec3> mode;
  bool operator==(const Found& o) const {
    return f.largest_rad_per_s == o.f.largest_rad_per_s && f.membrane_share == o.f.membrane_share &&
           f.bending_share == o.f.bending_share && f.seam_share == o.f.seam_share &&
           f.spring_share == o.f.spring_share && mode == o.mode;
  }
};

Found byCore(const Case& c, std::vector<Vec3> mode, int iterations) {
  const UniformStage stage;
  StepWork work;
  State state;
  state.p = c.p;
  state.mode = std::move(mode);
  const Frequency f = largestFrequency(*c.model, stage, state, iterations, work);
  return {f, state.mode};
}

template <class Device>
class Estimates {
 public:
  explicit Estimates(const Case& c) : c_(c), forces_(dynamic_cast<const NurbsShell&>(*c.model->cloth), {}) {
    forces_.setLoads(pointLoads(*c.model));
    frequency_.emplace(queue_, *c.model, forces_);
  }
  Found of(std::vector<Vec3> mode, int iterations) {
    const Frequency f = frequency_->at(queue_, nullptr, c_.p, mode, iterations);
    return {f, std::move(mode)};
  }

 private:
  const Case& c_;
  typename Device::Queue queue_;
  ShellForces<Device> forces_;
  std::optional<DeviceFrequency<Device>> frequency_;
};

double alongEachOther(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) ab += dot(a[i], b[i]), aa += norm2(a[i]), bb += norm2(b[i]);
  return std::abs(ab) / std::sqrt(aa * bb);
}

void expectCores(const Found& device, const Found& core, const std::string& where) {
  const double w = core.f.largest_rad_per_s;
  EXPECT_GT(w, 0) << where;
  EXPECT_NEAR(device.f.largest_rad_per_s, w, 1e-6 * w) << where;
  EXPECT_NEAR(device.f.membrane_share, core.f.membrane_share, 1e-4) << where;
  EXPECT_NEAR(device.f.bending_share, core.f.bending_share, 1e-4) << where;
  EXPECT_NEAR(device.f.seam_share, core.f.seam_share, 1e-4) << where;
  EXPECT_NEAR(device.f.spring_share, core.f.spring_share, 1e-4) << where;
  ASSERT_EQ(device.mode.size(), core.mode.size()) << where;
  EXPECT_GT(alongEachOther(device.mode, core.mode), 1 - 1e-3) << where;
  for (std::size_t i = 0; i < core.mode.size(); ++i)
    if (core.mode[i] == Vec3{}) {
      EXPECT_EQ(device.mode[i], Vec3{}) << where << ", held point " << i;
    }
}

TEST(DeviceFrequency, IsThatOfCoreAndItsSharesAndMode) {
  for (const Case& c : cases()) {
    Estimates<Reference> device(c);
    const Found cold = byCore(c, {}, 40);
    expectCores(device.of({}, 40), cold, c.name + ", cold");
    if (c.governing) {
      EXPECT_STREQ(cold.f.governing(), c.governing) << c.name;
    }
    expectCores(device.of(cold.mode, 8), byCore(c, cold.mode, 8), c.name + ", warm");
    std::printf("[ measured ] %s: %.6g rad/s, shares %.3f %.3f %.3f %.3f; the device's %.2g off\n", c.name.c_str(),
                cold.f.largest_rad_per_s, cold.f.membrane_share, cold.f.bending_share, cold.f.seam_share,
                cold.f.spring_share, device.of({}, 40).f.largest_rad_per_s / cold.f.largest_rad_per_s - 1);
  }
}

TEST(DeviceFrequency, AnyWidthOfAGroupGivesTheSameBits) {
  for (const Case& c : cases()) {
    Estimates<Reference> one(c);
    Estimates<ReferenceOf<32>> wide(c);
    const Found cold = one.of({}, 40);
    EXPECT_TRUE(wide.of({}, 40) == cold) << c.name;
    EXPECT_TRUE(wide.of(cold.mode, 8) == one.of(cold.mode, 8)) << c.name;
  }
}

/// The end of all directions: a single point on a spring has three, all of one frequency.
TEST(DeviceFrequency, EndsWhereAllDirectionsAreFound) {
  ModelOptions options;
  const Garment sheet = squareSheet(2, 0.2, 0);
  for (int i = 1; i < sheet.patches[0].u.count() * sheet.patches[0].v.count(); ++i)
    options.held_control_points.push_back(i);
  Case c = of(forceCloth("a point", sheet, 1e-3), nullptr, options);
  Estimates<Reference> device(c);
  expectCores(device.of({}, 40), byCore(c, {}, 40), c.name);
  options.held_control_points.push_back(0);
  Case held = of(forceCloth("nothing", sheet, 1e-3), nullptr, options);
  EXPECT_EQ(Estimates<Reference>(held).of({}, 40).f.largest_rad_per_s, 0);
}

/// Steps with an estimate before, between and after them, and steps without.
TEST(DeviceFrequency, LeavesTheStepsAsTheyAre) {
  Fabric remembers = sheetFabric();
  remembers.law = rememberingLaw();
  ModelOptions options;
  options.held_control_points = {0, 1};
  const Garment sheet = squareSheet(8, 0.2, 0, remembers);
  std::vector<State> ends[2];
  for (const bool looks : {false, true}) {
    Motion m(sheet, {{0, 0, -9.81}, 0.1}, {}, options);
    for (Vec3& x : m.state.p) x.z += 5 * x.x * x.x;
    m.restart();
    StageWork work;
    placeEnds(*m.model, m.stage, 0, 0, work);
    const auto device = stepOnReference(*m.model, m.state, work, 1);
    std::vector<Vec3> mode;
    const auto look = [&](StandsAt at) {
      if (looks) {
        EXPECT_GT(device->frequency(at, m.state.p, mode, 8).largest_rad_per_s, 0);
      }
    };
    device->set(m.state);
    look(StandsAt::start);
    double at_s = 0;
    for (int k = 0; k < 6; ++k) {
      const double dt = 2e-5;
      const std::vector<Placement> none;
      StepDone done = device->make({dt, k == 0 ? 0 : dt, none, none, {}, {}, {}});
      ASSERT_EQ(done.by_cpu, ByCpu::none);
      look(StandsAt::start);
      look(StandsAt::end);
      look(StandsAt::host);
      if (k == 3) {  // not accepted
        done.unpack();
        continue;
      }
      device->accept();
      look(StandsAt::start);
      done.unpack();
      at_s += dt;
      State end;
      end.v = done.velocity, end.a = done.acceleration;
      device->complete(end);
      ends[looks].push_back(end);
    }
    EXPECT_FALSE(ends[looks].back().history.empty());
  }
  ASSERT_EQ(ends[0].size(), ends[1].size());
  for (std::size_t k = 0; k < ends[0].size(); ++k) {
    EXPECT_TRUE(ends[0][k].v == ends[1][k].v) << k;
    EXPECT_TRUE(ends[0][k].a == ends[1][k].a) << k;
    EXPECT_TRUE(ends[0][k].history == ends[1][k].history) << k;
  }
}

/// What makes the steps of a sheet that swings at an edge.
using Makes = std::unique_ptr<Integrator> (*)(const Motion&, const StepControl&, Frequency&, StepWork&);
std::unique_ptr<Integrator> onReference(const Motion& m, const StepControl& c, Frequency& f, StepWork& w) {
  return stepsOnReference(*m.model, m.stage, c, f, w);
}
std::unique_ptr<Integrator> onCpu(const Motion& m, const StepControl& c, Frequency& f, StepWork& w) {
  return std::make_unique<VelocityVerlet>(*m.model, m.stage, c, f, w);
}

struct Swung {
  State state;
  std::vector<double> frequencies;  ///< by which each step was made
};
/// In pieces: by steps that go on, or (`anew`) as if from a checkpoint after each piece.
Swung swung(Makes makes, bool anew) {
  Motion m = vibration();
  StepControl control;
  control.estimate_every = 5;
  Frequency frequency;
  Swung out;
  std::unique_ptr<Integrator> steps;
  for (int k = 0; k < 30; ++k) {
    if (anew || !steps) steps = makes(m, control, frequency, m.work);
    steps->advance(3.3e-3 * (k + 1), m.state,
                   [&](const State&, const State& after, const StepReport&, const StepResult&, const Frequency&) {
                     out.frequencies.push_back(after.frequency_rad_per_s);
                   });
  }
  out.state = m.state;
  return out;
}

TEST(DeviceFrequency, StepsGoOnFromAnywhereToTheSameBits) {
  const Swung one = swung(onReference, false), other = swung(onReference, true);
  EXPECT_EQ(one.frequencies, other.frequencies);
  EXPECT_TRUE(one.state.p == other.state.p);
  EXPECT_TRUE(one.state.mode == other.state.mode);
}

TEST(DeviceFrequency, StepsAreMadeByThoseOfCore) {
  const Swung device = swung(onReference, false), cpu = swung(onCpu, false);
  ASSERT_EQ(device.frequencies.size(), cpu.frequencies.size());
  EXPECT_GT(device.frequencies.size(), 60u);
  for (std::size_t k = 0; k < cpu.frequencies.size(); ++k)
    EXPECT_NEAR(device.frequencies[k], cpu.frequencies[k], 1e-6 * cpu.frequencies[k])
        << "step " << k << " of " << cpu.frequencies.size();
  ASSERT_EQ(device.state.mode.size(), cpu.state.mode.size());
  EXPECT_GT(alongEachOther(device.state.mode, cpu.state.mode), 1 - 1e-3);
}

}  // namespace
}  // namespace gambeson::gpu
