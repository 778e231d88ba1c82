#include "core/cloth/degenerated/shell_resultants.hpp"

#include <algorithm>

namespace gambeson {

void Resultants::remember(const ShellLaw& law, const ForceTerms& terms, const History<double>& history) {
  const auto [membrane, bending, both] = answerOf(law, strain, curvature, history);
  const auto take = [&](const Answer<double, 3>& of, Vec3& resultant) {
    resultant = {of.resultant[0], of.resultant[1], of.resultant[2]};
    in_plane.stored += of.energy;
    in_plane.lost += of.lost;
  };
  if (terms.membrane) take(membrane, n);
  if (terms.bending) take(bending, m);
}

ShellLaw linearAt(const ShellLaw& law, const ShellPoint& p, const Covariant& c, const ForceTerms& terms,
                  const History<double>& history) {
  ShellLaw slopes;
  slopes.shear_N_per_m = law.shear_N_per_m;
  slopes.section = law.steepest;
  if (terms.steepest) return slopes;
  const PointAnswer<double> answer = answerOf(law, strainOf(p, c), curvatureOf(p, c), history);
  std::copy_n(answer.membrane.slope, 6, slopes.section.A.begin());
  std::copy_n(answer.bending.slope, 6, slopes.section.D.begin());
  return slopes;
}

}  // namespace gambeson
