#pragma once
/// Contacts of cloth with cloth, and with what is sharp on bodies, from pairs whose boxes meet.

#include "gpu/finding/pair.hpp"
#include "gpu/near/contact_order.hpp"
#include "gpu/near/dressed_mesh.hpp"
#include "gpu/near/placing.hpp"

namespace gambeson::gpu {

/// Which edges of cloth meet no edges.
struct MarkBlunt {
  ClothPairs pairs;
  char* blunt;
  GAMBESON_HD void operator()(int e) const { blunt[e] = pairs.blunt(e); }
};

struct KeepPoints {
  ClothPairs pairs;
  GAMBESON_HD bool operator()(const Pair& p) const { return !pairs.neighboursAtRest(p.first, p.second); }
};
struct KeepEdges {
  ClothPairs pairs;
  const char* blunt;
  GAMBESON_HD bool operator()(const Pair& p) const {
    return !blunt[p.first] && !blunt[p.second] && !pairs.neighbourEdgesAtRest(p.first, p.second);
  }
};

/// Half the sum of both sides' thicknesses at a contact, as core's layerOf has it.
GAMBESON_HD inline double clothLayer(const ContactStencil& stencil, const double* thickness_m) {
  double sum = 0;
  for (int k = 0; k < stencil.count; ++k) sum += std::abs(stencil.weight[k]) * thickness_m[stencil.sample[k]];
  return sum;
}

template <bool kEdges>
struct TouchCloth {
  ClothPairs pairs;
  const double* thickness_m;
  FoundList out;

  GAMBESON_HD void operator()(const Pair& p, Count) const {
    ClothTouch touch;
    if (!(kEdges ? pairs.edgeOn(p.first, p.second, touch) : pairs.sampleOn(p.first, p.second, touch))) return;
    FoundContact found;
    found.facts.kind = kEdges ? kEdgeOnEdge : kSampleOnCloth;
    found.facts.sample = touch.sample;
    found.facts.feature = touch.feature;
    found.facts.partner = touch.partner;
    found.facts.normal = touch.normal;
    found.facts.gap_m = touch.gap_m;
    for (int k = 0; k < touch.count; ++k) found.stencil.add(touch.stencil[k], touch.weight[k]);
    found.facts.layer_m = 0.5 * clothLayer(found.stencil, thickness_m);
    out.add(found);
  }
};

/// Samples that are not inside of a body.
struct OutsideCounts {
  const char* inside;
  GAMBESON_HD bool operator()(int v) const { return !inside[v]; }
};

template <bool kEdges>
struct TouchSharp {
  BodyEdgeView view;   ///< its time step is to be set
  const double* dt_s;  ///< on the device
  OutsideCounts counts;
  const BodySurface* body;
  FoundList out;

  GAMBESON_HD void operator()(const Pair& p, Count) const {
    BodyEdgeTouch touch;
    BodyEdgeView now = view;
    now.dt_s = *dt_s;
    const BodyEdgePairs<OutsideCounts> pairs(now, counts);
    if (!(kEdges ? pairs.edgeOn(p.first, p.second, touch) : pairs.cornerOn(p.first, p.second, touch))) return;
    FoundContact found;
    found.facts.kind = kEdgeOnBody;
    found.facts.sample = touch.stencil[0];
    found.facts.feature = touch.feature;
    found.facts.pair = kEdges ? touch.pair[1] : touch.pair[2];
    found.facts.normal = touch.normal;
    found.facts.gap_m = touch.gap_m;
    found.facts.body_velocity = touch.body_velocity;
    for (int k = 0; k < touch.count; ++k) found.stencil.add(touch.stencil[k], touch.weight[k]);
    found.facts.layer_m = std::max(clothLayer(found.stencil, view.thickness_m), 0.0);
    const BodySurface& of = body[view.body_of_vertex[touch.body[0]]];
    found.facts.obstacle = of.obstacle;
    int touched = 0;
    for (int k = 0; k < touch.body_count; ++k) {
      const int v = touch.body[k] - of.first_vertex;
      found.touch.local += touch.body_weight[k] * (of.deforms ? view.x0[touch.body[k]] : of.at[v]);
      if (!of.deforms || touch.body_weight[k] == 0) continue;
      found.touch.vertex[touched] = v;
      found.touch.weight[touched++] = touch.body_weight[k];
    }
    out.add(found);
  }
};

}  // namespace gambeson::gpu
