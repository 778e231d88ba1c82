#include "gpu/device/fault_switch.hpp"

#include <array>
#include <charconv>
#include <cstdlib>

namespace gambeson::gpu {
namespace {

/// In the order of DeviceFault.
constexpr std::array<const char*, 9> kWords{"not_built",   "no_driver",     "old_driver",
                                            "no_device",   "old_device",    "little_memory",
                                            "device_lost", "out_of_memory", "kernel_limit"};

}  // namespace

std::optional<FaultSwitch> faultSwitch(const std::string& text) {
  if (text.empty()) return {};
  const std::size_t at = text.find('@');
  const std::string word = text.substr(0, at);
  FaultSwitch fault;
  std::size_t k = 0;
  while (k < kWords.size() && word != kWords[k]) ++k;
  if (k == kWords.size()) throw RunError("GAMBESON_FAULT: there is no fault '" + word + "'");
  fault.fault = static_cast<DeviceFault>(k);
  if (at == std::string::npos) return fault;
  const std::size_t next = text.find('@', at + 1);
  const std::string step = text.substr(at + 1, next == std::string::npos ? next : next - at - 1);
  const auto read = std::from_chars(step.data(), step.data() + step.size(), fault.step);
  if (read.ec != std::errc{} || read.ptr != step.data() + step.size() || fault.step < 1)
    throw RunError("GAMBESON_FAULT: '" + step + "' is no step from 1 on");
  if (next != std::string::npos) fault.folder = text.substr(next + 1);
  return fault;
}

std::optional<FaultSwitch> faultSwitchFor(const std::string& folder) {
  const char* text = std::getenv("GAMBESON_FAULT");
  std::optional<FaultSwitch> fault = faultSwitch(text ? text : "");
  if (fault && !fault->folder.empty() && fault->folder != folder) fault.reset();
  return fault;
}

}  // namespace gambeson::gpu
