#include "core/contact/cloth_contacts.hpp"

#include <algorithm>
#include <tuple>

#include "core/contact/cloth_pair.hpp"
#include "core/math/parallel.hpp"

namespace gambeson {
namespace {

void keep(ContactKind kind, const ClothTouch& found, std::vector<ClothContactPoint>& out) {
  ClothContactPoint p;
  p.contact.sample = found.sample;
  p.contact.obstacle = -1;
  p.contact.kind = kind;
  p.contact.feature = found.feature;
  p.contact.gap_m = found.gap_m;
  p.contact.normal = found.normal;
  p.layer_m = found.layer_m;
  p.partner = found.partner;
  for (int k = 0; k < found.count; ++k) p.stencil.add(found.stencil[k], found.weight[k]);
  out.push_back(p);
}

}  // namespace

void clothContacts(const ContactMesh& mesh, const ClothFacts& facts, const CandidatePairs& pairs,
                   std::span<const Vec3> x0, std::span<const Vec3> x1, std::vector<ClothContactPoint>& out) {
  out.clear();
  const ClothPairs search(viewOf(mesh),
                          {facts.cloth_vertices, facts.rest.data(), facts.garment.data(), facts.thickness_m.data()},
                          x0.data(), x1.data());
  appendInOrder(static_cast<int>(pairs.points.size()), Each::sum, out, [&](int first, int end, auto& list) {
    ClothTouch found;
    for (int k = first; k < end; ++k)
      if (search.sampleOn(pairs.points[k].vertex, pairs.points[k].triangle, found))
        keep(ContactKind::sample_on_cloth, found, list);
  });
  appendInOrder(static_cast<int>(pairs.edges.size()), Each::sum, out, [&](int first, int end, auto& list) {
    ClothTouch found;
    for (int k = first; k < end; ++k)
      if (search.edgeOn(pairs.edges[k].a, pairs.edges[k].b, found)) keep(ContactKind::edge_on_edge, found, list);
  });
  const auto key = [](const ClothContactPoint& p) {
    return std::tuple(p.contact.kind, p.contact.sample, p.contact.feature);
  };
  std::sort(out.begin(), out.end(),
            [&](const ClothContactPoint& a, const ClothContactPoint& b) { return key(a) < key(b); });
}

}  // namespace gambeson
