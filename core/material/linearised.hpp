#pragma once
/// What a fabric whose law is an energy at a point is in the terms of others.

#include <memory>

#include "core/material/fabric.hpp"
#include "core/material/point_energy.hpp"

namespace gambeson {

/// The fabric with this law, and with the moduli and the rigidities that its slopes at rest have: orthotropic, without
/// what couples stretch with shear or with curvature, and bending along weft and warp. What asks a fabric for moduli
/// (seams, springs, pages) has these. Throws InputError (key "law") where the membrane at rest is not positive
/// definite, or the thickness is not > 0.
Fabric withEnergy(Fabric fabric, std::shared_ptr<const PointEnergy> energy);

}  // namespace gambeson
