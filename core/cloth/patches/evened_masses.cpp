#include "core/cloth/patches/evened_masses.hpp"
#include "core/cloth/draft/areas.hpp"

#include <algorithm>

#include "core/cloth/patches/surface.hpp"

namespace gambeson {

std::vector<double> evenedMasses(const Garment& garment, double share) {
  std::vector<double> mass = controlMasses(garment);
  if (garment.trims.empty()) return mass;
  Garment whole = garment;
  whole.trims.clear();
  const std::vector<double> untrimmed = controlMasses(whole);
  std::size_t first = 0;
  for (const NurbsPatch& patch : garment.patches) {
    const std::size_t end = first + patch.points.size();
    double before = 0, after = 0;
    for (std::size_t c = first; c < end; ++c) {
      before += mass[c];
      if (mass[c] > 0) mass[c] = std::max(mass[c], share * untrimmed[c]);
      after += mass[c];
    }
    if (after > before)
      for (std::size_t c = first; c < end; ++c) mass[c] *= before / after;
    first = end;
  }
  return mass;
}

}  // namespace gambeson
