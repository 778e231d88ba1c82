#include "core/contact/certified_impact.hpp"

#include "core/contact/impact_query.hpp"

namespace gambeson {

std::optional<ImpactTime> pointTriangleImpact(const FourPoints& x0, const FourPoints& x1, double separation_m,
                                              double tolerance_m) {
  return certified::findImpact<3>(x0, x1, separation_m, tolerance_m);
}

std::optional<ImpactTime> edgeEdgeImpact(const FourPoints& x0, const FourPoints& x1, double separation_m,
                                         double tolerance_m) {
  return certified::findImpact<4>(x0, x1, separation_m, tolerance_m);
}

double pointTriangleGap(const FourPoints& x) { return certified::gapAtRest<3>(x); }
double edgeEdgeGap(const FourPoints& x) { return certified::gapAtRest<4>(x); }

}  // namespace gambeson
