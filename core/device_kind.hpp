#pragma once
/// Where the steps of worn cloth are made.

#include <array>
#include <string>

namespace gambeson {

/// `reference`: the kernels of a device, run by the processor; the same bits as `cuda`. `cpu`: core's own steps, whose
/// numbers differ from those in their last digits.
enum class DeviceKind { cpu, reference, cuda };

/// As --device has them.
constexpr std::array<const char*, 3> kDeviceWords{"cpu", "reference", "cuda"};

inline std::string wordOf(DeviceKind kind) { return kDeviceWords[static_cast<std::size_t>(kind)]; }

/// Whether a checkpoint of the one goes on under the other, to the same bits.
inline bool sameBits(DeviceKind a, DeviceKind b) { return (a == DeviceKind::cpu) == (b == DeviceKind::cpu); }

}  // namespace gambeson
