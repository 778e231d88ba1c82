#include "cases/wear/run/run_steps.hpp"

#include <fmt/format.h>

#include "cases/input/message.hpp"
#include "cases/runs/shell_word.hpp"
#include "cases/wear/case/device_keys.hpp"
#include "core/error.hpp"
#include "core/motion/free_steps.hpp"
#include "gpu/device/gpu.hpp"

namespace gambeson {
namespace {

std::optional<gpu::FaultSwitch> faultOf(DeviceKind device, const std::string& folder) {
  return device == DeviceKind::cpu ? std::nullopt : gpu::faultSwitchFor(folder);
}

[[noreturn]] void refuse(DeviceKind device, const std::string& why) {
  throw InputError({"command line", 0, "--device"}, fmt::format("\"{}\": {}", wordOf(device), why));
}

std::string gigabytes(std::size_t bytes) { return fmt::format("{:.2g} GB", 1e-9 * static_cast<double>(bytes)); }

std::string nameOf(const std::filesystem::path& folder) {
  const std::filesystem::path whole = std::filesystem::absolute(folder).lexically_normal();
  return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

}  // namespace

void requireDevice(DeviceKind device, const std::string& folder) {
  const auto fault = faultOf(device, folder);
  if (fault && fault->before() && fault->fault != gpu::DeviceFault::little_memory)
    refuse(device, gpu::faultText(fault->fault, ""));
  if (device != DeviceKind::cuda) return;
  try {
    gpu::findGpu();
  } catch (const gpu::DeviceError& e) {
    refuse(device, e.what());
  }
}

void nameGpu() {
  if (const std::optional<std::string> name = gpu::gpuName())
    sayNote(
        fmt::format("this machine has a GPU ({}), which --device cuda would use; without it the processor computes, "
                    "so that numbers do not depend on the machine",
                    *name));
}

std::string resumeLine(const Case& c, const RunOptions& o) {
  std::string line = "gambeson run " + shellWord(c.file.string());
  for (const std::string& change : c.overrides) line += " --set " + shellWord(change);
  line += " --out " + shellWord(o.out.string());
  if (o.threads > 0) line += fmt::format(" --threads {}", o.threads);
  return line + fmt::format(" --device {} --resume", wordOf(o.device));
}

void checkDevice(const Case& c, const RunOptions& o) {
  requireCarried(c, o.device);
  requireDevice(o.device, nameOf(o.out));
  if (!o.names_gpu) return;
  try {
    requireCarried(c, DeviceKind::cuda);
  } catch (const InputError&) {
    return;  // it would not help
  }
  nameGpu();
}

Company::Share requireRoom(const Case& c, const RunOptions& o, const Model& model) {
  if (o.device == DeviceKind::cpu) return {};
  if (const auto what = gpu::stepNotCarried(model, c.time.motion, c.time.control()))
    refuse(o.device, fmt::format("{} is not carried; allowed: --device cpu", *what));
  const std::size_t needed = gpu::bytesOnDevice(model);
  const auto fault = faultOf(o.device, nameOf(o.out));
  const bool provoked = fault && fault->fault == gpu::DeviceFault::little_memory;
  if (o.device != DeviceKind::cuda && !provoked) return o.company ? o.company->take(needed) : Company::Share();
  gpu::GpuMemory memory{needed / 2, needed / 2};
  std::string name;
  if (!provoked) {
    try {
      memory = gpu::gpuMemory();
      name = gpu::findGpu().name;
    } catch (const gpu::DeviceError& e) {
      refuse(o.device, e.what());
    }
  }
  if (o.company && o.company->memory() > 0) memory.free_bytes = o.company->memory();
  if (needed > memory.free_bytes)
    refuse(
        o.device,
        gpu::faultText(gpu::DeviceFault::little_memory,
                       fmt::format("{} needed, {} free of {}", gigabytes(needed), gigabytes(memory.free_bytes),
                                   gigabytes(memory.all_bytes))) +
            "; cells 1.4 times as long and as wide halve it; allowed: a case that fits, or less else on the GPU (see "
            "nvidia-smi)");
  sayNote(fmt::format("{}: the steps take about {} of its memory, {} are free", name, gigabytes(needed),
                      gigabytes(memory.free_bytes)));
  return o.company ? o.company->take(needed) : Company::Share();
}

RunSteps::RunSteps(const Case& c, const RunOptions& o, const Scenario& scenario, Frequency& frequency, StepWork& work)
    : case_(c),
      scenario_(scenario),
      frequency_(frequency),
      work_(work),
      kind_(o.device),
      fault_(faultOf(o.device, nameOf(o.out))) {}

void RunSteps::make() {
  const StepControl control = case_.time.control();
  const Model& model = *scenario_.model;
  const Stage& stage = *scenario_.stage;
  if (kind_ == DeviceKind::cpu) {
    cpu_ = makeIntegrator(case_.time.motion, model, stage, control, frequency_, work_);
    return;
  }
  if (device_) before_.add(device_->counts());
  device_.reset();  // its memory is free before the next takes its own
  device_ = kind_ == DeviceKind::cuda ? gpu::stepsOnCuda(model, stage, control, frequency_, work_)
                                      : gpu::stepsOnReference(model, stage, control, frequency_, work_);
}

void RunSteps::advance(double until_s, State& state, const StepObserver& observe) {
  if (kind_ == DeviceKind::cpu) return cpu_->advance(until_s, state, observe);
  if (!fault_) return device_->advance(until_s, state, observe);
  device_->advance(until_s, state,
                   [&](const State& before, const State& after, const StepReport& report, const StepResult& result,
                       const Frequency& frequency) {
                     observe(before, after, report, result, frequency);
                     if (!fault_->before() && ++accepted_ == fault_->step)
                       throw gpu::DeviceError(fault_->fault, "provoked by GAMBESON_FAULT");
                   });
}

DeviceFacts RunSteps::facts() const {
  DeviceFacts facts;
  facts.kind = kind_;
  if (kind_ == DeviceKind::cpu) return facts;
  if (kind_ == DeviceKind::cuda) {
    const gpu::Gpu gpu = gpu::findGpu();
    facts.gpu = gpu.name, facts.driver = gpu.driver, facts.runtime = gpu.runtime;
  }
  facts.kernels = gpu::kernelsVersion();
  gpu::DeviceCounts all = before_;
  if (device_) all.add(device_->counts());
  facts.steps = all.steps, facts.by_cpu = all.by_cpu, facts.repeated = all.repeated, facts.reasons = all.reasons;
  return facts;
}

}  // namespace gambeson
