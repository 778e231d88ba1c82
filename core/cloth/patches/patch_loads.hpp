#pragma once
/// Loads on cloth on patches.

#include <span>
#include <vector>

#include "core/cloth/draft/cells.hpp"
#include "core/cloth/loads.hpp"

namespace gambeson {

/// ∫ N t ds along an edge at rest, t [N/m]; ∫ N b dA over a patch at rest, b [N/m^2]; N F at a point. Control points.
/// Total force and moment about any point are those of the load, as the basis sums to 1 and reproduces the rest shape.
std::vector<Vec3> edgeForce(const Garment& garment, const PatchEdge& edge, const Vec3& force_N_per_m);
std::vector<Vec3> surfaceForce(const Garment& garment, int patch, const Vec3& force_N_per_m2);
std::vector<Vec3> pointForce(const Garment& garment, int patch, Vec2 uv, const Vec3& force_N);
/// surfaceForce on all patches, summed.
std::vector<Vec3> garmentForce(const Garment& garment, const Vec3& force_N_per_m2);
/// Weight: ∫ N rho g dA over all patches, with the local surface density.
std::vector<Vec3> weightForce(const Garment& garment, const Vec3& gravity_m_per_s2);
/// The same pressure on every patch, each along its own normal.
std::vector<PressureLoad> garmentPressure(const Garment& garment, double pressure_Pa, int program = 0);
/// A pressure on a patch along its normal, per current area [Pa]; a moment per rest length of an edge [N m/m]. Throws
/// InputError where there is no such patch or edge.
std::vector<FollowingLoad> pressureOn(const Garment& garment, int patch, double pressure_Pa);
std::vector<FollowingLoad> edgeMomentOn(const Garment& garment, const PatchEdge& edge, double moment_N);

}  // namespace gambeson
