#include "core/cloth/draft/join_garments.hpp"

#include <algorithm>
#include <string>

#include "core/error.hpp"

namespace gambeson {

Garment joinGarments(std::span<const Garment> garments) {
  if (garments.empty()) throw InputError({"", 0, "garments"}, "at least one garment is needed");
  // With one fabric, and no fields that choose among others, nothing varies.
  const bool one = std::all_of(garments.begin(), garments.end(), [&](const Garment& g) {
    return g.fabric == garments[0].fabric && g.other_fabrics.empty();
  });
  const bool plain = std::all_of(garments.begin(), garments.end(), [](const Garment& g) { return g.fields.empty(); });
  const bool trimmed = std::any_of(garments.begin(), garments.end(), [](const Garment& g) { return !g.trims.empty(); });
  const bool placed = std::any_of(garments.begin(), garments.end(), [](const Garment& g) { return !g.placed.empty(); });
  Garment all;
  all.fabric = garments[0].fabric;
  int number = 0;
  for (const Garment& g : garments) {
    validateFields(g);
    all.name += (number == 0 ? "" : ", ") + g.name;
    const int first = static_cast<int>(all.patches.size());
    const auto count = g.patches.size();
    const auto moved = [&](PatchEdge e) {
      e.patch += first;
      return e;
    };
    all.patches.insert(all.patches.end(), g.patches.begin(), g.patches.end());
    all.weft.insert(all.weft.end(), g.weft.begin(), g.weft.end());
    all.garment_of_patch.insert(all.garment_of_patch.end(), count, number);
    for (Seam seam : g.seams) {
      seam.a = moved(seam.a), seam.b = moved(seam.b);
      all.seams.push_back(seam);
    }
    for (WeakSeam seam : g.weak_seams) {
      seam.a = moved(seam.a), seam.b = moved(seam.b);
      all.weak_seams.push_back(seam);
    }
    for (SewnSeam seam : g.sewn_seams) {
      for (SewnEdge* edge : {&seam.a, &seam.b})
        for (SewnPart& part : *edge) part.patch += first;
      all.sewn_seams.push_back(std::move(seam));
    }
    if (placed) {
      all.placed.insert(all.placed.end(), g.placed.begin(), g.placed.end());
      all.placed.resize(all.patches.size());
    }
    if (trimmed) {
      all.trims.insert(all.trims.end(), g.trims.begin(), g.trims.end());
      all.trims.resize(all.patches.size());
    }
    // The fabric's number in the list that starts with all.fabric.
    const double fabric = number == 0 || one ? 0 : static_cast<double>(all.other_fabrics.size()) + 1;
    if (number > 0 && !one) all.other_fabrics.push_back(g.fabric);
    all.other_fabrics.insert(all.other_fabrics.end(), g.other_fabrics.begin(), g.other_fabrics.end());
    if (!one || !plain) {
      std::vector<PatchFields> fields = g.fields;
      fields.resize(count);
      for (PatchFields& f : fields) {
        if (!f.material) {
          if (!one) f.material = PatchField{0, 1, 1, {fabric}};
          continue;
        }
        for (double& value : f.material->values) value += fabric;
      }
      all.fields.insert(all.fields.end(), fields.begin(), fields.end());
    }
    ++number;
  }
  return all;
}

}  // namespace gambeson
