#pragma once
/// A repeat of a woven cloth whose yarns are solids: meshes, what joins its faces, and what touches.

#include <vector>

#include "core/solid/solid_contact.hpp"
#include "core/solid/solid_system.hpp"
#include "core/yarn/cell_faces.hpp"
#include "core/yarn/rod_cell.hpp"
#include "core/yarn/solid_yarns.hpp"

namespace gambeson {

struct SolidCellDesign {
  WovenYarns yarns;
  std::array<BonetBurton, 2> law;  ///< by YarnDirection
  YarnMeshing meshing;
  /// A weft and a warp over one spacing, of a plain weave alone (Man 2006, fig. 19c): a quarter of the repeat, which a
  /// step to the next crossing and a reflection in the middle of the cloth take to the next quarter.
  bool quarter = false;
  FaceSupport faces = FaceSupport::glide;
  bool contact = true;       ///< false: yarns pass through each other
  int pressed = along_weft;  ///< the direction whose surface nodes must not pass the facets of the other
  double friction = 0;       ///< mu >= 0
  FrictionBound bound = FrictionBound::symmetrised;
  /// Stiffness of contact, normal and tangential [transverse Young's modulus by half thickness, the softer of both].
  double penalty = 50;
};

/// What joins the ends of yarns, and where yarns stand: linear in the steps of the faces (CellFaces) of flat cloth.
///
/// Ends of a yarn: x_far = x_near + step, and of a quarter x_far = M x_near + step/2, M = diag(1, 1, -1). Held ends
/// keep their height (Man 2006, section 4.3.5.3). A yarn may slide along itself, and where nothing touches it anywhere.
/// Where half a turn takes the weave to itself about a place on the yarn (WovenYarns::halfTurn), that place is the
/// cloth's for every load of the plane, and the yarn is held there in the plane; that takes no force.
///
/// Contact is asked for inside of the cell: yarns of neighbouring cells do not touch those of this one (as Man's).
/// Yarns of one direction do not touch each other.
class SolidCell {
 public:
  /// Throws InputError as solidYarns, where a law is refused (keys "weft.law...", "warp.law..."), or with the key
  /// "friction" or "penalty" where these are out of range.
  explicit SolidCell(const SolidCellDesign& design);

  const SolidCellDesign& design() const { return design_; }
  const WovenYarns& yarns() const { return design_.yarns; }
  const SolidYarns& solids() const { return solids_; }
  const SolidBody& body() const { return body_; }
  const SolidContact& contact() const { return contact_; }
  /// With programs at rest.
  const SolidSupports& supports() const { return supports_; }
  /// Of the quarter, where it is one [m²].
  double area_m2() const { return share_ * share_ * yarns().area_m2(); }
  /// From the lowest to the highest point of the cloth at rest [m]: what divides resultants into stresses. 4 b where
  /// both directions are alike and touch.
  double height_m() const;
  /// Of the yarns in area times height.
  double volumeFraction() const;

  /// The supports' programs from one load at 0 to another at 1; between them the steps of the faces go straight.
  std::vector<Program> programs(const CellLoad& from, const CellLoad& to) const;
  /// How the programs' values move while the steps of the faces move so.
  std::vector<double> programRates(const std::array<Vec3, 2>& step_m) const;
  /// The load at t on that way.
  CellLoad between(const CellLoad& from, const CellLoad& to, double t) const;
  /// What steps of the faces 1 and 2 carry of forces on all nodes [N], their derivative of the energy.
  std::array<Vec3, 2> faceForces(std::span<const Vec3> force) const;

 private:
  void joinEnds(const YarnBody& body);
  void holdYarn(const YarnBody& body, int halves);
  void addSupports();
  SolidContact makeContact() const;

  SolidCellDesign design_;
  double share_ = 1;  ///< of a repeat's steps
  SolidYarns solids_;
  SolidBody body_;
  SolidContact contact_;
  SolidSupports supports_;
  std::vector<Vec3> held_;  ///< places of yarns, at rest
};

}  // namespace gambeson
