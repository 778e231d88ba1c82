#include "core/cloth/degenerated/shell_law.hpp"

namespace gambeson {

ShellLaw shellLaw(const Fabric& fabric, double shear_factor) {
  ShellLaw law;
  law.point = pointLaw(fabric);
  law.point.jam_N_per_m = law.point.jam_s = 0;
  law.use = lawUse(law.point);
  law.section = law.steepest = law.point.section;
  law.shear_N_per_m = shear_factor * law.section.A[2];
  law.z2_m2 = fabric.thickness() * fabric.thickness() / 12;
  law.from_flat = !hasRestCurvature(fabric);
  PointNumbers<double> numbers = numbersOf(law.point);
  takeSteepest(BendingLaws{}, law.use, numbers);
  std::copy_n(numbers.A, 6, law.steepest.A.begin());
  std::copy_n(numbers.D, 6, law.steepest.D.begin());
  return law;
}

PointAnswer<double> answerOf(const ShellLaw& law, const Vec3& strain, const Vec3& curvature, History<double> history) {
  const double e[3] = {strain.x, strain.y, strain.z}, k[3] = {curvature.x, curvature.y, curvature.z};
  PointAnswer<double> out;
  evaluateLaws<all_parts>(law.use, numbersOf(law.point), e, k, history, out);
  return out;
}

}  // namespace gambeson
