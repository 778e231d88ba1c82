#include "core/cloth/bulge.hpp"

#include "core/cloth/bulge_view.hpp"

namespace gambeson {

double Bulges::beside(int sample, const Vec3& direction, std::span<const Vec3> x, bool across) const {
  return viewOf(*this).beside(sample, direction, x.data(), across);
}

}  // namespace gambeson
