#pragma once
/// Libraries of our own that lie beside the program and are loaded when they are first asked for: what they bring
/// (OpenCASCADE, libav) would make every start slower.

#include <string>

namespace gambeson {

/// A function of a library beside the program ("gambeson_cad.so"), which stays loaded. `brings` is what messages call
/// it by. Throws RunError where it cannot be loaded or lacks the function.
void* functionBeside(const std::string& library, const std::string& function, const std::string& brings);

}  // namespace gambeson
