#pragma once
/// How supports and loads take hold of cloth on patches: patch_supports.hpp and patch_loads.hpp behind one interface.

#include <memory>

#include "core/cloth/draft/garment.hpp"
#include "core/cloth/mounting.hpp"

namespace gambeson {

/// Lives no longer than the garment.
std::unique_ptr<const Mounting> patchMounting(const Garment& garment);

}  // namespace gambeson
