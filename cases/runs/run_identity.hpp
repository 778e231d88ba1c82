#pragma once
/// What a recording belongs to.

#include <string>

#include "core/device_kind.hpp"

namespace gambeson {

/// A run goes on from a checkpoint of the same identity alone.
struct RunIdentity {
  std::string case_hash;
  std::string kernels;     ///< of the processor's vector instructions, whose width rounding depends on
  bool on_device = false;  ///< steps by `reference` or `cuda`, which have the same bits, not by `cpu`

  RunIdentity(std::string hash, std::string kernels_of, DeviceKind device)
      : case_hash(std::move(hash)), kernels(std::move(kernels_of)), on_device(device != DeviceKind::cpu) {}
  /// Of what `text` gave.
  explicit RunIdentity(const std::string& text);

  /// As recordings keep it: "HASH KERNELS", " device" after it where steps are made on a device.
  std::string text() const;
  bool operator==(const RunIdentity&) const = default;
};

/// Throws InputError naming both devices where a recording in `folder` was made on another kind of device than this
/// run: their bits differ.
void requireSameDevice(const RunIdentity& recorded, DeviceKind device, const std::string& folder);

}  // namespace gambeson
