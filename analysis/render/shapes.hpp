#pragma once
/// Body shapes as meshes to draw.

#include "analysis/render/render.hpp"
#include "core/contact/obstacle.hpp"

namespace gambeson {

/// The shape where it stands. Ellipsoids get 48 bands of latitude, 96 of longitude (area of the outline within 0.1 %)
/// and exact normals.
RenderMesh meshOf(const Shape& shape, const Placement& X_W, Color color);

}  // namespace gambeson
