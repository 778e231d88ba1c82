#pragma once
/// Which cloth samples are near which obstacle, and which would pass through one during a step.

#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "core/contact/deformed.hpp"
#include "core/contact/obstacle.hpp"

namespace gambeson {

/// What touches what. A contact names its primitives by `sample` and `feature`: a sample of the cloth and the feature
/// of the obstacle or of the cloth's mesh that it touches; the first point of an edge and what it touches on a body;
/// two edges of the cloth; or an edge and the triangle that it passes through. In the order in which rows are solved.
enum class ContactKind : int { sample_on_body, sample_on_cloth, edge_on_edge, restoring, edge_on_body };

/// A sample near an obstacle. `normal` (unit, world) points from the obstacle to the cloth and `gap_m` is the signed
/// distance at the time of the query (negative inside); `local` is the touched material point in the obstacle's frame.
struct Contact {
  int sample = 0;
  int obstacle = 0;  ///< -1: none, of cloth with cloth
  int feature = 0;  ///< which vertex, edge or face of a mesh (0 for an ellipsoid); identifies the contact between steps
  ContactKind kind = ContactKind::sample_on_body;
  Vec3 normal;
  double gap_m = 0;
  Vec3 local;
  MaterialPoint touched;   ///< the same of an obstacle that deforms, whose frame is the world's
  double clearance_m = 0;  ///< what the cloth between the samples asks for (findClearances); 0: nothing

  bool onBody() const { return obstacle >= 0; }
};

/// A sample that would pass into an obstacle during a step, first at `time` of it, in [0, 1].
struct SampleHit : Contact {
  double time = 0;
};

static_assert(std::is_trivially_copyable_v<SampleHit>, "an array of contacts or hits goes to a device as it lies");

/// Triangles of meshes that a sample may touch, by sample: items[first[s], first[s + 1]). Where there are none the
/// sample may still be deep inside of a mesh; it is not as long as it stays in a ball known to be outside. Of a mesh
/// that deforms it is not as long as it has not passed through it, which is for the owner to know (`outside_of`).
struct MeshCandidates {
  struct Item {
    int obstacle = 0, triangle = 0;
  };
  struct Ball {
    Vec3 centre;  ///< in the obstacle's frame
    double radius = 0;
  };
  std::vector<int> first;
  std::vector<Item> items;
  std::vector<Ball> outside;  ///< of obstacle o and sample s at o n + s; kept by `near` from query to query
  /// Known to be outside of a mesh that deforms, by obstacle and sample as above: set by `near`, taken back by its
  /// owner.
  std::vector<char> outside_of;
};

/// Search structures of the obstacles: constant topology, boxes refitted lazily (Zheng 2013, section 3.6).
class ProximityQuery {
 public:
  /// The obstacles outlive the query.
  explicit ProximityQuery(std::span<const Obstacle> obstacles);
  ~ProximityQuery();
  ProximityQuery(ProximityQuery&&) noexcept;

  /// Persistent contact (section 3.2.1): all pairs with signed distance at `start` below reach_m[sample] plus what the
  /// obstacle's surface can move from `start` to `end`. One contact per local minimum of the distance, so none at the
  /// inner edges of a flat or concave mesh. Every sample is tested against every obstacle.
  /// Sorted by sample, obstacle, feature. The same bits for any number of threads.
  /// `candidates`: the triangles of meshes to look at instead of all. `deformed`: the surfaces at `start`, where there
  /// are obstacles that deform; they move no farther than it says.
  void near(std::span<const Placement> start, std::span<const Placement> end, std::span<const Vec3> x,
            std::span<const double> reach_m, std::vector<Contact>& out, MeshCandidates* candidates = nullptr,
            const DeformedSurfaces* deformed = nullptr) const;

  /// Trajectory impact (section 3.3.1): samples whose path x0 -> x1 (straight, against the moving obstacle) enters an
  /// ellipsoid from outside, with the normal and material point at the first time of contact, gap_m the separation at
  /// the start along that normal, and that time. Sorted as above; one per (sample, obstacle). Meshes are not asked:
  /// their triangles take part in the search of core/motion/collisions.hpp.
  void impacts(std::span<const Placement> start, std::span<const Placement> end, std::span<const Vec3> x0,
               std::span<const Vec3> x1, std::vector<SampleHit>& out) const;

  /// Signed distance of one point to one obstacle (for checks and analysis).
  double signedDistance(int obstacle, const Placement& placement, const Vec3& x,
                        const DeformedSurfaces* deformed = nullptr) const;
  /// The nearest point of an obstacle that deforms, as a contact of no sample.
  Contact nearest(int obstacle, const Vec3& x, const DeformedSurfaces& deformed) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gambeson
