#pragma once
/// The sidecar by which ParaView (5.11 and later) opens a recording. Internal to core/io.

#include "core/io/segment.hpp"

namespace gambeson {

/// XDMF 3: one temporal collection; each frame a surface of triangles, and beside it, where the control fields hold one
/// named "position" (3 components), the control points as vertices, and a body that deforms as a second surface. Frames
/// from `infos` in order of time, the first `segment_ends[0]` in segment 0 and so on; paths are relative to the
/// sidecar.
std::string xdmfSidecar(std::size_t triangles, std::size_t body_triangles, const std::vector<FrameInfo>& infos,
                        const std::vector<int>& segment_ends);

}  // namespace gambeson
