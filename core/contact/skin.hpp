#pragma once
/// A closed skin around links that turn about joints: one triangle mesh that bends with them.

#include <array>
#include <span>
#include <vector>

#include "core/contact/obstacle.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

/// A joint about which the skin bends. A vertex of share w turns by the w-th part of the joint's rotation since the
/// bind posture about `centre`: the points of share 1/2, which lie on the plane normal . (x - centre) = offset in the
/// bind posture, then always lie on the plane that bisects the two segments. Both in the world frame of the bind
/// posture; `normal` points to the child's side.
struct SkinBend {
  int parent = 0, child = 0;  ///< links
  Vec3 centre, normal{0, 0, -1};
  double offset_m = 0;
  bool crease = false;  ///< whether it folds the skin: then either side stays half the gap off the bisecting plane
};

/// Vertices that stay on their side of the bisecting plane of a bend: side +1 the child's, -1 the parent's. `strength`,
/// in (0, 1], scales how far a vertex is moved: 1 but where the crease runs out.
struct SkinCrease {
  int bend = 0;
  std::vector<int> vertex;
  std::vector<double> side, strength;
};

/// Consecutive vertices that turn about the same bends, distal first: `partial` tells about which with shares below 1,
/// which follow by vertex for each such bend in turn (share[k * (end - begin) + v - begin] for the k-th).
struct SkinRun {
  int begin = 0, end = 0;
  std::vector<int> bends;
  std::vector<char> partial;
  std::vector<double> share;
};

/// `weight` sums to 1 at each vertex. With bends (skins that we make) the shares move the skin and the weights say how
/// much of a vertex belongs to each link; without (skins from files) the weights blend the links' motions linearly.
struct Skin {
  TriangleMesh rest;             ///< closed, outward, in the world frame of the bind posture
  std::vector<Pose> bind;        ///< X_WL of each link of the skeleton in the bind posture
  std::vector<int> first, link;  ///< links of vertex v: link[first[v]] .. link[first[v + 1] - 1], ascending
  std::vector<double> weight;    ///< as `link`
  std::vector<int> segment;      ///< of each vertex: the link of largest weight
  std::vector<char> off;         ///< triangles of `rest` that cloth does not touch; empty: none
  std::vector<SkinBend> bends;   ///< a child's bend stands before its parent's
  std::vector<SkinRun> runs;     ///< all vertices, in order
  std::vector<SkinCrease> creases;
  double crease_gap_m = 0;
};

/// Where the vertices are for given link poses, a smooth function of these alone; the same bits for any number of
/// threads. Sizes of `link_poses` and `x` must be those of `bind` and `rest`.
void skinPositions(const Skin& skin, std::span<const Pose> link_poses, std::span<Vec3> x);

}  // namespace gambeson
