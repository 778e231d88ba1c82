#pragma once
/// What a cloth does on the large scale, as the two motions that take a cell of it to its neighbours.

#include <array>
#include <span>
#include <vector>

#include "core/math/vec.hpp"
#include "core/yarn/woven_yarns.hpp"

namespace gambeson {

/// Strain of the middle of the cloth, Green-Lagrange in the axes of the yarns, and a bend about one axis, wherever it
/// points. Axis 1 is along the weft. Two motions that commute, as those of a lattice must, are translations or belong
/// to one cylinder: exact at any curvature, and no cell can have two curvatures at once.
struct CellLoad {
  double e11 = 0, e22 = 0;     ///< E11, E22 > -1/2
  double g12 = 0;              ///< 2 E12; (2 E12)² < (1 + 2 E11)(1 + 2 E22)
  double curvature_per_m = 0;  ///< k, positive where the centre lies on the upper side
  double direction_rad = 0;    ///< of the arcs, from axis 1 to axis 2, in the strained plane
  bool operator==(const CellLoad&) const = default;
};

/// Throws InputError, keys "load.e11", "load.e22", "load.g12", "load.curvature", "load.direction", where the strain is
/// of no plane or a number is not finite.
void checkLoad(const CellLoad& load);

/// (E11, E22, 2 E12) of a deformation gradient by rows (Phi11, Phi12, Phi21, Phi22), Man 2006, eq. 4.59.
CellLoad loadOf(const std::array<double, 4>& gradient);
/// As printed (Man 2006, section 4.3.5): Phi = [s, e; e, s], which stretches as it shears.
CellLoad shearAsPrinted(double e, double stretch = 1);
/// Yarns turn by the angle gamma towards each other and keep their spacing along themselves, times the stretch.
CellLoad trellis(double gamma_rad, double stretch = 1);

/// What takes a cell to the next along axes 1 and 2 (the columns of Phi times the periods when flat).
struct CellFaces {
  std::array<Pose, 2> step;
};
/// Of Phi = [sqrt(C11), C12/sqrt(C11); 0, sqrt(C22 - C12²/C11)], C = 1 + 2 E: what is beyond it is a turn of the whole.
/// A step of s along the arcs and m across them goes over to
///   p -> R(-k s) p + (sin(k s)/k, m, (1 - cos(k s))/k) in the axes (along, across, up).
CellFaces facesOf(const WovenYarns& yarns, const CellLoad& load);

/// How the steps move with one number of the load: translations dt and spins w (dR = w x R).
struct FaceMotion {
  std::array<Vec3, 2> dt_m, spin_rad;
};
/// With e11, e22, g12 and curvature.
std::array<FaceMotion, 4> faceMotions(const WovenYarns& yarns, const CellLoad& load);
/// The six second derivatives of the translations in (e11, e22, g12), order 11, 22, 33, 12, 13, 23; of a flat cell.
std::array<std::array<Vec3, 2>, 6> faceCurvature(const WovenYarns& yarns, const CellLoad& load);

/// Sections carried from a cell under one load to another as if they were fixed to the cloth: turned with it, their
/// height kept.
std::vector<Pose> carried(std::span<const Pose> sections, const CellLoad& from, const CellLoad& to);

}  // namespace gambeson
