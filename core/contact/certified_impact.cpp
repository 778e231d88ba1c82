#include "core/contact/certified_impact.hpp"

#include "core/contact/impact_query.hpp"

namespace gambeson {

namespace {

/// Of the pair at rest.
template <std::size_t N>
double gap(const FourPoints& x) {
  const certified::Relative<N> r = certified::relative<N>(x);
  double extent = 0;
  for (const Vec3& a : r) extent = std::max(extent, certified::largest(a));
  const certified::Query<N> q{r, r, certified::kDirectionBound * extent + certified::kTiny, 0, true};
  const double below = (certified::know(q, r, 0).gap_m - q.error_m) / certified::kRoundUp;
  return extent < certified::kLargest && below > 0 ? below : 0;
}

}  // namespace

std::optional<ImpactTime> pointTriangleImpact(const FourPoints& x0, const FourPoints& x1, double separation_m,
                                              double tolerance_m) {
  return certified::findImpact<3>(x0, x1, separation_m, tolerance_m);
}

std::optional<ImpactTime> edgeEdgeImpact(const FourPoints& x0, const FourPoints& x1, double separation_m,
                                         double tolerance_m) {
  return certified::findImpact<4>(x0, x1, separation_m, tolerance_m);
}

double pointTriangleGap(const FourPoints& x) { return gap<3>(x); }
double edgeEdgeGap(const FourPoints& x) { return gap<4>(x); }

}  // namespace gambeson
