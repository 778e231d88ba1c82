#pragma once
/// A skin that bends, made by code.

#include "core/contact/skin.hpp"

namespace gambeson::gpu {

/// A tube around three links in a row, its vertices around and along, with both joints, shares and creases.
Skin tubeSkin(int around, int along);
/// Without bends: links blended linearly.
Skin blendedTube(int around, int along);
/// Poses of its links at so many times: joints bend by up to 100 degrees, about axes that turn, and the root moves.
std::vector<Pose> tubePoses(const Skin& skin, int times);

}  // namespace gambeson::gpu
