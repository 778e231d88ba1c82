#pragma once
/// Cloth of constant-strain triangles, which bend by tensors of curvature, dihedral hinges, crossed springs or
/// quadratic hinges (BendingElements), each garment as it says.
///
/// Membrane: St. Venant-Kirchhoff triangles of linear displacement. With D_weft, D_warp the physical directions of a
/// triangle at rest, F D linear in its corners, E = (Fᵀ F - 1)/2 in the basis of the threads is constant in it; its law
/// is the fabric's membrane (Zheng 2013, eq. 2.13), or its tension field, with jamming. Or springs along the edges, or
/// Baraff and Witkin's conditions, both with damping (triangle_membrane.hpp).
///
/// Bending by tensors: bending_triangles.hpp. By springs: crossed_springs.hpp. By quadratic hinges:
/// quadratic_hinges.hpp. Across seams of flat panels: seam_springs.hpp.
///
/// By hinges: one along every edge between two triangles. theta is the angle between their normals, theta0 at rest;
/// with l the length of the edge and A the area of both triangles at rest the curvature across the edge is
///   kappa = (theta - theta0) l/A,   E = A W(kappa d),   d = (n1^2, n2^2, 2 n1 n2),
/// n the direction across the edge in the basis of the threads, W the fabric's own bending energy per area. For the
/// linear law of an isotropic sheet E = B/2 l^2/A (theta - theta0)^2 (Grinspun, Hirani, Desbrun and Schroeder, Symp.
/// Computer Animation 2003, with the area of Bridson, Marino and Fedkiw, ibid.): on equilateral triangles a cylinder
/// has the energy of the plate whatever its direction (Seung and Nelson, Phys. Rev. A 38, 1988); on others it depends
/// on the mesh. Between samples of one patch the cloth is flat, W is the identity.

#include <array>
#include <memory>
#include <span>

#include "core/cloth/cloth.hpp"
#include "core/cloth/triangles/triangle_build.hpp"
#include "core/cloth/triangles/triangle_elements.hpp"

namespace gambeson {

class TriangleCloth : public Cloth {
 public:
  /// Garments worn over each other, the first innermost. Throws InputError on bad meshes or fabrics: a fabric with
  /// coupling of membrane and bending is none of triangles.
  explicit TriangleCloth(std::vector<MeshDraft> garments);
  TriangleCloth(const TriangleCloth&) = delete;
  TriangleCloth& operator=(const TriangleCloth&) = delete;
  ~TriangleCloth() override;

  const TriangleElements& elements() const { return elements_; }

  const std::vector<Vec3>& rest() const override { return parts_.rest; }
  const FreeMap& map() const override { return map_; }
  const std::vector<ClothPatch>& patches() const override { return parts_.patches; }
  std::string pointName() const override { return "vertices"; }
  std::string kernels() const override;
  std::string describePoint(int point) const override;
  Vec2 placeOfDraft(int patch, Vec2 uv) const override;
  int draftPoints() const override;
  std::vector<Vec3> fromDraft(std::span<const Vec3> control) const override;

  /// Places are triangles of the patch: (2 t + b, c) is the point with the barycentric coordinates b and c of the
  /// second and third corner of its triangle t.
  Surface surface(std::span<const int> per_cell) const override;
  Bulges bulges(const Surface& surface, std::span<const int> per_cell) const override;
  SparseRows finer(int fineness, std::span<const int> per_cell) const override;
  PlaceMesh placeMesh(int per_cell) const override;
  Fabric fabricAt(int patch, Vec2 uv) const override;
  double cellAt(int patch, Vec2 uv) const override;
  std::vector<NetEdge> net() const override;

  std::vector<double> areas() const override;
  /// Of panels that are sewn each vertex bears 0.3 of what one inside of its patch does, or more: slivers at the ends
  /// of seams would shorten all steps.
  std::vector<double> masses() const override;
  SparseRows consistentMass() const override;

  using Cloth::force;
  void force(const ClothState& state, const ClothForce& out, ClothWork& work, const ForceTerms& terms) const override;
  std::unique_ptr<ClothTangent> tangent() const override;
  bool damps() const override { return elements_.damps(); }
  void dampingForce(const ClothState& state, const ClothForce& out, ClothWork& work) const override;
  std::size_t historySize() const override { return elements_.historySize(); }
  std::vector<HistoryPlace> historyPlaces() const override;
  std::size_t innerValues() const override { return elements_.bending().innerMasses().size(); }
  std::size_t innerRates() const override { return innerValues(); }
  void innerMasses(std::span<double> mass) const override;

  std::unique_ptr<StressView> stress() const override;
  PointState stateAt(const ClothState& state, int patch, Vec2 uv) const override;
  double bendAt(const ClothState& state, int patch, Vec2 uv) const override;
  std::vector<std::pair<int, Vec2>> lawPlaces() const override;
  bool springsAtRest(double length_m) const override;

  StrainRows strainRows(Mobility mobility, LimitPoints points) const override;
  Vec2 limitStressAt(const StrainRows& rows, std::span<const Vec2> field, int patch, Vec2 uv) const override;

  /// Of panels that are sewn: a row for each two vertices that a seam joins (sewn_mesh.hpp).
  SewnRows sewnRows() const override;

  const Mounting& mounting() const override { return *mounting_; }

  /// A place's triangle among all, and its barycentric coordinates.
  struct Located {
    int triangle = 0;
    std::array<double, 3> weight{};
  };
  Located locate(int patch, Vec2 place) const;
  /// The points of a side of a patch, in its sense.
  const std::vector<int>& sidePoints(const PatchEdge& edge) const;
  /// Of each point, the free point that it is.
  int freePoint(int point) const { return map_.T.columns[static_cast<std::size_t>(point)]; }
  /// All triangles, by points; those of a patch are [first, first of the next).
  const std::vector<std::array<int, 3>>& triangles() const { return parts_.triangles; }
  int firstTriangle(int patch) const { return parts_.first_triangle[static_cast<std::size_t>(patch)]; }

 private:
  /// Pairs of free points that seams hold at one place, directly or through others.
  std::vector<std::array<int, 2>> twins() const;

  std::vector<MeshDraft> garments_;
  TriangleParts parts_;  ///< its elements have gone to elements_
  FreeMap map_;
  TriangleElements elements_;
  std::unique_ptr<const Mounting> mounting_;
};

}  // namespace gambeson
