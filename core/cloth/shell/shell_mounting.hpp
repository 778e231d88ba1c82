#pragma once
/// How supports and loads take hold of a NURBS sheet: shell_supports.hpp and shell_loads.hpp behind one interface.

#include <memory>

#include "core/cloth/draft/garment.hpp"
#include "core/cloth/mounting.hpp"

namespace gambeson {

/// Lives no longer than the garment.
std::unique_ptr<const Mounting> shellMounting(const Garment& garment);

}  // namespace gambeson
