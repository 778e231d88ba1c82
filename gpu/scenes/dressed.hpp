#pragma once
/// Dressed bodies to compare and measure the search for what is near with: made by code, the same numbers on every
/// machine.

#include <memory>
#include <string>
#include <vector>

#include "gpu/near/near_search.hpp"

namespace gambeson::gpu {

/// Cloth and bodies, and a step of theirs.
struct DressedScene {
  std::string name;
  CollisionModel collisions;
  std::vector<Obstacle> obstacles;
  Bulges bulges;
  std::vector<Vec3> x0, x1;  ///< of the samples
  std::vector<Placement> start, end;
  DeformedVertices start_vertices, end_vertices;
  double dt_s = 1e-4;

  NearModel model() const { return {collisions, obstacles, bulges}; }
  NearStep step() const { return {x0, x1, dt_s, {start, end, start_vertices, end_vertices}}; }
};

/// A sheet of cloth: a grid of samples in which `x0`, the positions at rest and the ends of the step are given.
struct SheetPart {
  int nu = 0, nv = 0;
  std::vector<Vec3> rest, x0, x1;
  int garment = 0;
  double thickness_m = 0;
};

/// Joins sheets and obstacles; the ends of placements and of deforming vertices are where they start, and for the
/// caller to move.
std::unique_ptr<DressedScene> dressed(const std::string& name, const std::vector<SheetPart>& sheets,
                                      std::vector<Obstacle> obstacles, std::vector<Placement> start);

/// Cloth alone: a sheet of a thickness of 2 mm folded on itself twice, so that it lies on itself a layer apart, and
/// creased by noise. With cells smaller than the layer most of what is near is so at rest.
std::unique_ptr<DressedScene> foldedSheet(int n, double cell_m);
/// Two garments of different thickness on each other, wavy, with edges sharp enough to meet edges.
std::unique_ptr<DressedScene> twoLayers(int n);
/// Two sheets whose samples stick out towards each other: pairs of them are one contact.
std::unique_ptr<DressedScene> facingPeaks(int n);
/// A sheet on three ellipsoids, one of them scaled, that move and turn.
std::unique_ptr<DressedScene> sheetOnEllipsoids(int n);
/// A sheet over a box and a ball and through another one, many samples deep inside of it; rigid, or vertex by vertex.
std::unique_ptr<DressedScene> sheetOnSolids(int n, bool deform);
/// Two layers over a ball of triangles that deforms, and a second one apart.
std::unique_ptr<DressedScene> sheetOnSkin(int n);

/// All of these, small.
std::vector<std::unique_ptr<DressedScene>> dressedScenes();

/// What was found, in numbers that do not depend on any order.
struct NearFacts {
  NearSizes sizes{};
  std::uint64_t contacts_hash = 0;
  bool operator==(const NearFacts&) const = default;
};
NearFacts factsOf(NearSearch& search);
std::uint64_t hashOf(const NearContacts& contacts);

}  // namespace gambeson::gpu
