#pragma once
/// Contacts of a step as arrays: what the rows of its solve start from, in the order of core's rows.

#include <array>
#include <type_traits>

#include "core/math/vec.hpp"

namespace gambeson::gpu {

/// core's ContactKind, of those that are found here.
enum TouchKind : int { kSampleOnBody = 0, kSampleOnCloth = 1, kEdgeOnEdge = 2, kEdgeOnBody = 4 };

/// Named as core's Contact: a sample of the cloth and the feature that it touches, two edges, or the first sample of
/// what touches a body's sharp edge or corner, whose feature is negative (core/motion/body_edges.hpp).
struct alignas(16) ContactFacts {
  Vec3 normal;  ///< unit, to the cloth, or to the side of positive weights
  double gap_m = 0;
  Vec3 body_velocity;      ///< of the touched point of a body, mean over the step [m/s]; 0 of cloth
  double layer_m = 0;      ///< the distance that it restores
  double clearance_m = 0;  ///< of samples on bodies, what the cloth between them asks for
  int kind = 0, sample = 0, obstacle = -1, feature = 0;
  int partner = -1;  ///< the other one of two samples that are nearest to each other
  int pair = -1;     ///< of edges on bodies: the triangle or edge of the cloth
};
static_assert(sizeof(ContactFacts) == 96);

/// Samples with their weights: one side positive, the other negative.
struct ContactStencil {
  int count = 0;
  int sample[5] = {};
  double weight[5] = {};

  GAMBESON_HD void add(int s, double w) {
    sample[count] = s;
    weight[count++] = w;
  }
};
static_assert(sizeof(ContactStencil) == 64);

/// Where a body is touched: in its frame, and of a body that deforms, of which vertices.
struct BodyTouch {
  Vec3 local;
  int vertex[3] = {-1, -1, -1};
  double weight[3] = {};
};

struct FoundContact {
  ContactFacts facts;
  ContactStencil stencil;
  BodyTouch touch;
  int place = 0;  ///< among those of its slot, as they came
};
static_assert(std::is_trivially_copyable_v<FoundContact>);

/// The order of rows.
GAMBESON_HD inline bool comesBefore(const ContactFacts& a, const ContactFacts& b) {
  if (a.kind != b.kind) return a.kind < b.kind;
  if (a.sample != b.sample) return a.sample < b.sample;
  if (a.obstacle != b.obstacle) return a.obstacle < b.obstacle;
  if (a.feature != b.feature) return a.feature < b.feature;
  return a.pair < b.pair;
}

}  // namespace gambeson::gpu
