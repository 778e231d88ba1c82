#pragma once
/// Contact of the cloth's triangles with each other and with those of the obstacles: what is near at the start of a
/// step, and what would pass through what during it.

#include <span>
#include <type_traits>
#include <vector>

#include "core/cloth/surface_charts.hpp"
#include "core/contact/candidate_list.hpp"
#include "core/contact/cloth_contacts.hpp"
#include "core/contact/pairs.hpp"
#include "core/contact/proximity.hpp"
#include "core/contact/untangle.hpp"

namespace gambeson {

/// Constant. The mesh has the cloth's samples first, then the vertices of each obstacle that is a mesh.
struct CollisionModel {
  struct Body {
    int obstacle = 0;
    int first_vertex = 0;
    std::vector<Vec3> local;  ///< vertices in the obstacle's frame; where it deforms, at first
    bool deforms = false;
  };
  ContactMesh mesh;
  ClothFacts cloth;
  int cloth_triangles = 0;         ///< the mesh's first
  std::vector<int> body_triangle;  ///< of the others: their number in their obstacle's mesh
  std::vector<Body> bodies;
  std::vector<int> body_of_vertex;  ///< -1: cloth
  PairCollector collector;
  ContactTree tree;     ///< as built; a step fits a copy
  Bluntness bluntness;  ///< likewise
  double largest_thickness_m = 0;
  /// Half of contactReach of their thickness, rounded up: primitives of cloth have contacts within the sum of theirs.
  /// Of bodies -1.
  std::vector<float> vertex_half_reach_m, edge_half_reach_m, triangle_half_reach_m;
  /// Distance over distance at rest from which parts of the cloth have neither contacts nor impacts with each other.
  double least = 1;
  bool self = true;                            ///< cloth meets cloth
  std::vector<int> garment_of_vertex;          ///< bodies -1; empty where there is one garment and no body
  std::vector<char> is_body;                   ///< of each vertex
  std::vector<char> is_mesh;                   ///< of each obstacle
  std::vector<int> body_of_obstacle;           ///< -1: no mesh
  bool deforms = false;                        ///< some body does
  std::vector<char> sharp_edge, sharp_corner;  ///< of bodies (body_edges.hpp)
  UntangleLaw untangling;
};

/// `rest`: positions of the samples at rest; `garment` and `thickness_m` of each sample.
CollisionModel buildCollisions(const Surface& surface, std::span<const Vec3> rest, std::vector<int> garment,
                               std::vector<double> thickness_m, std::span<const Obstacle> obstacles,
                               std::span<const Placement> placement, bool self);

/// A pair that would come closer than its separation, first at `time` of the step.
struct PairHit {
  bool edges = false;
  int a = 0, b = 0;  ///< vertex and triangle, or two edges
  double time = 0;   ///< in [0, 1], a lower bound
  ContactRow row;  ///< asks for what keeps the pair apart: normal, stencil, gap at the start, body velocity; no target
};

static_assert(std::is_trivially_copyable_v<PairHit>, "an array of hits goes to a device as it lies");

struct CollisionReport {
  int candidates = 0;  ///< pairs on the list
  int capped = 0;      ///< queries that reached their cap, so far
  int touching = 0;    ///< pairs without a gap at the start of a step, so far: nothing tells which side is right
};

/// Scratch, with the candidates of the last search. A list serves as long as no vertex has left the neighbourhood that
/// it was made for, which the positions of each query certify: what a query finds does not depend on the list.
struct CollisionWork {
  CandidateList list;
  double start_s = 0, end_s = 0;
  std::vector<Vec3> x0, x1;                ///< of this step
  CandidatePairs near;                     ///< of the list, what may come within reach of a contact
  MeshCandidates near_bodies;              ///< and triangles of bodies, by sample
  std::vector<PointTriangle> near_points;  ///< both
  std::vector<ClothContactPoint> points;
  std::vector<Tangle> tangle;  ///< of each vertex in this step
  CollisionReport report;
};

/// Where the obstacles are at the ends of a step.
struct ObstacleMotion {
  std::span<const Placement> start, end;
  const DeformedVertices &start_vertices, &end_vertices;  ///< of those that deform
};

/// A new step: positions of the mesh's vertices at its start, and of the obstacles' at its end. Ends of the cloth are
/// to follow.
/// Where the step begins as the last one did, or where that ended without passing through anything, samples that
/// were known to be outside of bodies that deform are so still.
void placeVertices(const CollisionModel& model, double time_s, double dt_s, std::span<const Vec3> x0,
                   const ObstacleMotion& obstacles, CollisionWork& work);
/// The cloth would move to x1.
void moveVertices(std::span<const Vec3> x1, CollisionWork& work);

/// What may come within reach of a contact between work.x0 and x1: work.near and near_bodies.
void listNear(const CollisionModel& model, CollisionWork& work);

/// Notes that a contact is with a body's vertex, where the body deforms.
void touch(const CollisionModel& model, int vertex, double weight, Contact& contact);

/// Where the point of a body that a contact touches goes during the step.
Vec3 wayOfBody(const CollisionModel& model, const ObstacleMotion& obstacles, const Contact& contact);

/// Leaves out contacts with bodies outside of the reach of contacts all the way from x0 to x1.
void dropUnreached(const CollisionModel& model, const ObstacleMotion& obstacles, const CollisionWork& work,
                   std::vector<Contact>& near);

/// The intersections at work.x0 (chapter 4): contours along which the mesh passes through itself. There may be some
/// only where cloth touches cloth or there are bodies of triangles.
bool mayTangle(const CollisionModel& model);
std::vector<Contour> findTangles(const CollisionModel& model, const CollisionWork& work);

/// What frees them: the points of each contour are asked for the restoring speed. Sets work.tangle.
void freeTangles(const CollisionModel& model, std::vector<Contour> contours, double dt_s, CollisionWork& work,
                 std::vector<ContactRow>& restoring);

/// Persistent contacts of cloth with cloth at work.x0 among work.near (cloth_contacts.hpp); samples may move to x1.
/// Those of tangled samples are left out: their side is not the right one.
void nearCloth(const CollisionModel& model, CollisionWork& work);

/// All pairs that would come closer than the smaller of 1 um and a tenth of their distance at the start, on straight
/// paths x0 -> x1 in time dt, but what comes from inside a body (impact_side.hpp). `exempt`: vertices inside of one are
/// not stopped by its skin. Pairs with a tangled vertex are left to the restoring rows. Sorted by kind, then numbers.
void findImpacts(const CollisionModel& model, double dt_s, std::span<const char> exempt, CollisionWork& work,
                 std::vector<PairHit>& hits);

}  // namespace gambeson
