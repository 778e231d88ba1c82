#pragma once
/// How supports and loads take hold of the degenerated shell: points as on all patches, and directors.
///
/// A clamp holds the directors of an edge, for points of the edge that are held or shift as a whole. Mirror symmetry
/// holds the spins in its plane: what is left turns directors within it. A moment acts on the directors, about the
/// tangent that the edge has at rest (other cloth: that it has now), which is the same where the edge keeps its
/// direction.

#include <memory>

#include "core/cloth/mounting.hpp"

namespace gambeson {

class DegeneratedShell;

/// Lives no longer than the cloth.
std::unique_ptr<const Mounting> directorMounting(const DegeneratedShell& cloth);

}  // namespace gambeson
