#include "bench_sheet.hpp"

#include <cmath>

namespace gambeson::bench {

Garment wavySheet(int degree, int cells, bool solid, Knots knots) {
  KnotVector k{degree, std::vector<double>(degree + 1, 0.0)};
  for (int i = 1; i < cells; ++i) k.knots.push_back((i + 0.3 * std::sin(2.0 * i)) / cells);
  k.knots.insert(k.knots.end(), degree + 1, 1.0);
  NurbsPatch s{k, k, {}, {}};
  const std::vector<double> t = grevillePoints(k);
  for (std::size_t j = 0; j < t.size(); ++j)
    for (std::size_t i = 0; i < t.size(); ++i) {
      s.points.push_back({t[i], t[j], 0.02 * std::sin(20 * t[i]) * std::cos(15 * t[j])});
      s.weights.push_back(knots == Knots::uneven_polynomial
                              ? 1
                              : 1 + 0.2 * std::sin(3.0 * static_cast<double>(i) + 5.0 * static_cast<double>(j)));
    }
  Garment g;
  g.patches = {s};
  g.weft = {{1, 0, 0}};
  g.fabric.thickness_m = 0.762e-3;
  g.fabric.density_kg_per_m3 = 1440;
  g.fabric.young_weft_Pa = g.fabric.young_warp_Pa = 1.44e6;
  g.fabric.poisson = 0.3;
  g.fabric.shear_Pa = 1.44e6 / 2.6;
  if (solid)
    g.fabric.law = ConsistentBending{};
  else
    g.fabric.law = ZhengBending{{0.00371, 0.00371, 0.00371 * 0.7}, 30, 3};
  return g;
}

std::vector<Vec3> displaced(const Garment& sheet) {
  std::vector<Vec3> q = sheet.patches[0].points;
  for (std::size_t i = 0; i < q.size(); ++i)
    q[i] += Vec3{1e-4 * std::sin(7.0 * static_cast<double>(i)), 1e-4 * std::cos(11.0 * static_cast<double>(i)),
                 1e-4 * std::sin(13.0 * static_cast<double>(i))};
  return q;
}

}  // namespace gambeson::bench
