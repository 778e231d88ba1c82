#pragma once
/// How much of each vertex of a body belongs to each link, by distances along the skin from where joints bend it.

#include <map>
#include <string>
#include <vector>

#include "human/scan/landmarks.hpp"

namespace gambeson {

/// Weights of one vertex: links (by their place in `links`) and shares that sum to 1.
using VertexWeights = std::vector<std::pair<int, double>>;

struct SkinWeights {
  std::vector<VertexWeights> weights;
  std::vector<int> part;  ///< of each vertex, the link that it is counted to: that of the largest weight, and an arm's
                          ///< from the armpit on
};

/// The links that a body without a skeleton gets, parents first.
const std::vector<std::string>& scanLinks();

/// Each joint has the part of the skin beyond it: across a plane through the joint, along the limb. A vertex takes part
/// in the joint's turn by a share that grows from 0 to 1 over a band about that part's border, by its distance from the
/// border along the skin (on edges, then averaged over neighbours a few times). At the armpit the band lies on the arm,
/// so that its underside does not fold into the trunk as it comes down. Shares multiply along the chain; a
/// link's weight is its chain's share less those of the links beyond. The same bits for any number of threads.
SkinWeights weightsOf(const TriangleMesh& body, const Landmarks& landmarks, const std::map<std::string, Vec3>& joints);

}  // namespace gambeson
