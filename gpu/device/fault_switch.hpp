#pragma once
/// Faults of a device that tests provoke.

#include <optional>
#include <string>

#include "gpu/device/device_error.hpp"

namespace gambeson::gpu {

/// GAMBESON_FAULT=FAULT[@STEP[@FOLDER]]: a run whose steps are made on a device, and whose results folder has this name
/// (any, where none is given), meets this fault (a word of DeviceFault), on its way after so many accepted steps.
struct FaultSwitch {
  DeviceFault fault = DeviceFault::device_lost;
  long step = 1;
  std::string folder;
  /// Whether it comes before anything runs.
  bool before() const { return fault < DeviceFault::device_lost; }
};

/// Throws RunError where the words make no sense.
std::optional<FaultSwitch> faultSwitch(const std::string& text);
/// The same of the environment, for a run into this folder.
std::optional<FaultSwitch> faultSwitchFor(const std::string& folder);

}  // namespace gambeson::gpu
