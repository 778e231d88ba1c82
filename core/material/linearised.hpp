#pragma once
/// What a fabric whose law is an energy at a point is in the terms of others.

#include <memory>

#include "core/material/fabric.hpp"
#include "core/material/point_energy.hpp"

namespace gambeson {

/// The fabric with this law, and with the moduli and the rigidities that its slopes at rest have: orthotropic, without
/// what couples stretch with shear or with curvature, and bending along weft and warp. What asks a fabric for moduli
/// (seams, springs, pages) has these; no force of the law does. Yarns that slide resist no shear at rest: a shear
/// modulus counts as at least a millionth of sqrt(A11 A22). Throws InputError (key "law") where stretch at rest is not
/// resisted (A11, A22 > 0, A12² < A11 A22), or the thickness is not > 0.
Fabric withEnergy(Fabric fabric, std::shared_ptr<const PointEnergy> energy);

}  // namespace gambeson
