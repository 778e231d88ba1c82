#pragma once
/// The membranes of triangles that are not their fabric's own: springs along edges, and Baraff and Witkin's conditions.
///
/// Three springs along the edges of a triangle know its three strains and no more, so they are a law of strain too:
/// with D_e an edge at rest in the basis of the threads, l_e^2 = D_e . (1 + 2 E) D_e, and per area
///   n = 1/a sum_e k_e (1 - l0_e/l_e) (D_x^2, D_y^2, D_x D_y),
/// the virial of the forces that the triangle's springs exert at its corners. Every triangle has springs of its own
/// along its edges: at an edge between two triangles there are two, whose stiffnesses add, so that cloth has the same
/// moduli up to its border.

#include <array>

#include "core/cloth/draft/membrane_elements.hpp"
#include "core/material/fabric.hpp"
#include "core/material/laws/baraff_witkin.hpp"
#include "core/material/section.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

/// The membrane of the triangles of one fabric, with all its numbers.
struct TriangleMembrane {
  MembraneElements elements = MembraneElements::continuum;
  BaraffWitkinNumbers<double> threads;   ///< of baraff_witkin
  double spring_N_per_m = 0;             ///< of one triangle's spring; 0: from the modulus along its edge
  double spring_damping_Ns_per_m = 0;    ///< of one triangle's spring
  std::array<double, 6> compliance{};    ///< of the fabric's membrane, the inverse of A [m/N], order of Voigt

  bool damps() const {
    return spring_damping_Ns_per_m > 0 || threads.stretch_damping > 0 || threads.shear_damping > 0;
  }
};

/// Numbers that the model leaves open are those of the fabric: with S the inverse of its membrane stiffness A,
///   k_u = 1/S11 (E_weft h),  k_v = 1/S22,  k_shear = 1/S33 (G h).
/// Throws InputError on a fabric with a tension field, and on springs with jamming.
TriangleMembrane triangleMembrane(const MembraneModel& model, const Fabric& fabric, const Section& section);

/// The springs of a triangle, along its edges from corner 0 to 1, 0 to 2 and 1 to 2.
struct TriangleSprings {
  std::array<Vec2, 3> edge;  ///< at rest, in the basis of the threads [m]
  std::array<double, 3> rest_m{}, stiffness_N_per_m{};
  double damping_Ns_per_m = 0;
};

/// Where no stiffness is given, that of Van Gelder (Approximate simulation of elastic membranes by triangulated spring
/// meshes, J. Graphics Tools 3(2), 1998): k = E a/l0^2 for each of the triangle's own springs, E the modulus along the
/// edge [N/m], 1/E = t . S t, t = (cos^2, sin^2, sin cos) of its direction. On equilateral triangles of an isotropic
/// fabric with nu = 1/3 the springs are its membrane: k = sqrt(3)/2 E between two triangles. Springs have no more to
/// say: their nu is 1/3 there whatever the fabric's, shear goes with the moduli of the edges, and on other meshes they
/// are an approximation (right-angled triangles with diagonals that cross: 20 % too stiff along the threads, a third
/// too soft in shear). `g`: as MembraneTriangle has it.
TriangleSprings springsOf(const TriangleMembrane& membrane, const std::array<Vec2, 2>& g, double area_m2);

/// n of the strain e = (E11, E22, 2 E12) with its slope, of springs; of their damping where the strain has this rate.
void springResultants(const TriangleSprings& springs, double area_m2, const double* e, Answer<double, 3>& out);
void springDampingResultants(const TriangleSprings& springs, double area_m2, const double* e, const double* rate,
                             Answer<double, 3>& out);

}  // namespace gambeson
