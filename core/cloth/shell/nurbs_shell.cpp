#include "core/cloth/shell/nurbs_shell.hpp"

#include <algorithm>
#include <cmath>

#include "core/cloth/draft/cells.hpp"
#include "core/cloth/shell/stress_field.hpp"
#include "core/cloth/shell/tangent.hpp"

namespace gambeson {
namespace {

class ShellTangent : public ClothTangent {
 public:
  ShellTangent(const Shell& shell, const FreeMap& map) : shell_(shell), tangent_(shell, map) {}
  const BlockMatrix& sparsity() const override { return tangent_.sparsity(); }
  void assemble(const ClothState& state, ClothWork& work, BlockMatrix& K, const ForceTerms& terms) const override {
    tangent_.assemble(shell_, state, work, K, terms);
  }

 private:
  const Shell& shell_;
  Tangent tangent_;
};

}  // namespace

NurbsShell::NurbsShell(const Garment& garment, const ShellOptions& o)
    : PatchCloth(garment), shell_(this->garment(), o.kernels ? *o.kernels : widestKernels(), o.gauss_extra, o.rule) {}

void NurbsShell::force(const ClothState& state, const ClothForce& out, ClothWork& work, const ForceTerms& terms) const {
  shell_.force(state, out, work, terms);
}

std::unique_ptr<ClothTangent> NurbsShell::tangent() const { return std::make_unique<ShellTangent>(shell_, map()); }

std::unique_ptr<StressView> NurbsShell::stress() const { return std::make_unique<StressField>(shell_); }

PointState NurbsShell::stateAt(const ClothState& state, int patch, Vec2 uv) const {
  return shell_.stateAt(patch, uv, state);
}

double NurbsShell::bendAt(const ClothState& state, int patch, Vec2 uv) const {
  return shell_.bendAt(patch, uv, state.q);
}

std::vector<std::pair<int, Vec2>> NurbsShell::lawPlaces() const {
  std::vector<std::pair<int, Vec2>> places;
  for (const SheetCell& cell : sheetCells(garment())) {
    const NurbsPatch& patch = garment().patches[static_cast<std::size_t>(cell.patch)];
    for (const CellPoint& point : cellRule(cell, patch.u.degree, patch.v.degree))
      places.emplace_back(cell.patch, Vec2{point.u, point.v});
  }
  return places;
}

bool NurbsShell::springsAtRest(double length_m) const {
  const Garment& g = garment();
  if (hasRestCurvature(g.fabric)) return false;
  for (int p = 0; p < static_cast<int>(g.patches.size()); ++p)
    for (double u : grevillePoints(g.patches[static_cast<std::size_t>(p)].u))
      for (double v : grevillePoints(g.patches[static_cast<std::size_t>(p)].v)) {
        const Vec3 k = shell_.curvatureAt(p, {u, v}, rest());
        if (std::max({std::abs(k.x), std::abs(k.y), std::abs(k.z)}) * length_m > 1e-6) return true;
      }
  return false;
}

}  // namespace gambeson
