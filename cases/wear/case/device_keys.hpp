#pragma once
/// What of a case the steps on a device do not carry.

#include "cases/wear/case/case.hpp"
#include "core/device_kind.hpp"

namespace gambeson {

/// Throws InputError, at the key where it stands in the case's file, for the first that steps on this device do not
/// carry; nothing is refused on the processor. Every key of a case is listed as carried or refused in
/// tests/unit/cases/wear/case/device_keys_test.cpp.
void requireCarried(const Case& c, DeviceKind device);

}  // namespace gambeson
