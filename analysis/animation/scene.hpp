#pragma once
/// What moves, for programs that play it: nodes (links of a body), meshes fixed to nodes, skins over nodes, and meshes
/// whose vertices move one by one. World axes as ours: x forward, y to the left, z up [m].

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "analysis/render/render.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

/// A frame that moves, in its parent's (one that stands before it; -1: the world).
struct MovedNode {
  std::string name;
  int parent = -1;
  std::vector<Placement> at;  ///< at each time; a single one: it stays there
};

/// A mesh in a node's frame.
struct FixedMesh {
  std::string name;
  int node = 0;
  RenderMesh mesh;
};

/// x = sum over k of weight[k] X_W(node[k]) inverse_bind[node[k]] rest, over the nodes of each vertex.
struct SkinnedMesh {
  static constexpr int kNodes = 4;  ///< of a vertex, at most: what all players show
  std::string name;
  std::vector<Vec3> rest;
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> nodes;          ///< that it hangs on
  std::vector<Pose> inverse_bind;  ///< of these: from the rest mesh's world into the node
  std::vector<std::array<std::pair<int, float>, kNodes>> weights;  ///< of each vertex: (index in `nodes`, weight)
  Color color;
};

/// A mesh with positions at each time, three numbers a vertex.
struct MovingMesh {
  std::string name;
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::vector<float>> at;
  std::vector<Color> colors;  ///< of the vertices, sRGB; empty: `color`
  Color color;
};

struct AnimatedScene {
  std::string title;
  std::vector<double> time_s;  ///< ascending, at least one
  std::vector<MovedNode> nodes;
  std::vector<FixedMesh> fixed;
  std::vector<SkinnedMesh> skinned;
  std::vector<MovingMesh> moving;
  std::vector<std::pair<std::string, std::string>> notes;  ///< what a reader of the file should know, by a word
};

/// Where the nodes are at a time, in the world.
std::vector<Placement> worldOf(const AnimatedScene& scene, std::size_t time);

/// Where the vertices of a skin are at nodes that stand there.
std::vector<Vec3> positionsOf(const SkinnedMesh& skin, const std::vector<Placement>& X_WN);

}  // namespace gambeson
