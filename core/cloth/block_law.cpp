#include "core/cloth/block_law.hpp"

namespace gambeson {
namespace {

/// Whether the plain form leaves out anything of the fabric's law.
bool needsGeneral(const Fabric& f) {
  const bool is_solid = std::visit([]<class L>(const L&) { return L::is_solid; }, f.law);
  return is_solid || f.tension_field || lawUse(f).remembers();
}

}  // namespace

BlockLaw blockLaw(const Fabric& f) {
  BlockLaw law;
  law.point = pointLaw(f);
  const Voigt &A = law.point.section.A, &D = law.point.section.D;
  law.plain = {{A[0], A[1], A[3], A[2]}, {D[0], D[1], D[2]}, law.point.numbers, static_cast<int>(law.point.kind)};
  law.use = lawUse(f);
  law.general = needsGeneral(f);
  return law;
}

void takeSteepest(PlainLaw& law) {
  BendingLaws::forEach([&]<class L, int kKind>(std::type_identity<L>, std::integral_constant<int, kKind>) {
    if (law.kind != kKind) return;
    const std::array<double, 3> D = law.rigidity;
    for (int i = 0; i < 3; ++i)
      law.rigidity[static_cast<std::size_t>(i)] = L::steepest(i, D.data(), law.numbers.data());
  });
  law.kind = 0;
}

BlockLaw withTerms(BlockLaw law, const ForceTerms& terms) {
  law.membrane = terms.membrane;
  law.bending = terms.bending;
  law.steepest = terms.steepest;
  law.definite = terms.definite;
  if (!terms.membrane) law.plain.membrane = {};
  if (terms.steepest) takeSteepest(law.plain);
  if (!terms.bending) law.plain.rigidity = {};
  return law;
}

BlockLaw withHistory(BlockLaw law, long history_first, const ClothState& state, const ClothForce& out) {
  law.history_first = history_first;
  law.committed = state.history.empty() ? nullptr : state.history.data();
  law.trial = out.history.empty() ? nullptr : out.history.data();
  law.elapsed_s = state.elapsed_s;
  return law;
}

}  // namespace gambeson
