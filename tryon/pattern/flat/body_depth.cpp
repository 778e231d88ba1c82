#include "tryon/pattern/flat/body_depth.hpp"

#include <algorithm>
#include <variant>

namespace gambeson {

BodyDepth::BodyDepth(const StandingBody& form) : form_(form), query_(form.shapes()) {
  for (std::size_t o = 0; o < form.shapes().size(); ++o) {
    const Shape& shape = form.shapes()[o].shape;
    double reach = 0;
    if (const auto* e = std::get_if<Ellipsoid>(&shape))
      reach = std::max({e->semi_axes.x, e->semi_axes.y, e->semi_axes.z});
    else
      for (const Vec3& v : std::get<TriangleMesh>(shape).vertices) reach = std::max(reach, norm(v));
    reach_m_.push_back(form.placements()[o].scale * reach);
  }
}

PanelDepth BodyDepth::at(const Vec3& x) const {
  constexpr double kNear_m = 0.01;
  PanelDepth deepest;
  for (std::size_t o = 0; o < form_.shapes().size(); ++o) {
    const Placement& at = form_.placements()[o];
    if (norm(x - at.origin) > reach_m_[o] + kNear_m) continue;
    if (const double d = -query_.signedDistance(static_cast<int>(o), at, x); d > deepest.depth_m)
      deepest = {d, form_.shapes()[o].segment};
  }
  return deepest;
}

}  // namespace gambeson
