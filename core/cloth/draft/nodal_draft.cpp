#include "core/cloth/draft/nodal_draft.hpp"

#include <utility>

#include "core/cloth/draft/cells.hpp"
#include "core/cloth/draft/seams.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

/// Knots of degree 1 at the ends of the cells.
KnotVector nodalKnots(const KnotVector& knots) {
  const std::vector<double> ends = breakpoints(knots);
  KnotVector out{1, {ends.front()}};
  out.knots.insert(out.knots.end(), ends.begin(), ends.end());
  out.knots.push_back(ends.back());
  return out;
}

/// Appends the nodes of a patch as rows on its control points, from column `first` on.
void addNodes(const NurbsPatch& patch, const KnotVector& u, const KnotVector& v, int first, SparseRows& rows) {
  for (const double at_v : breakpoints(v))
    for (const double at_u : breakpoints(u)) {
      const SurfaceBasis basis = surfaceBasis(patch, at_u, at_v);
      for (std::size_t c = 0; c < basis.columns.size(); ++c)
        if (basis.values[0][c] != 0) rows.add(first + basis.columns[c], basis.values[0][c]);
      rows.endRow();
    }
}

}  // namespace

NodalDraft nodalDraft(const Garment& draft) {
  const auto refuse = [](const char* why) { throw InputError({"", 0, "model"}, why); };
  if (!draft.weak_seams.empty())
    refuse("cloth of nodes has no weak seams, which join edges of unequal cells; allowed with them: \"nurbs\"");
  if (!draft.sewn_seams.empty())
    refuse("cloth of nodes is not sewn of flat panels; allowed with sewn seams: \"nurbs\"");
  const std::vector<int> offsets = controlOffsets(draft);
  NodalDraft out{draft, {}};
  out.of_control.column_count = offsets.back();
  for (std::size_t p = 0; p < draft.patches.size(); ++p) {
    if (isTrimmed(draft, static_cast<int>(p)))
      refuse("cloth of nodes cannot be trimmed; allowed with trims: \"nurbs\", \"triangles\"");
    const NurbsPatch& from = draft.patches[p];
    NurbsPatch patch{nodalKnots(from.u), nodalKnots(from.v), {}, {}};
    addNodes(from, patch.u, patch.v, offsets[p], out.of_control);
    patch.points.resize(static_cast<std::size_t>(patch.size()));
    patch.weights.assign(patch.points.size(), 1.0);
    out.garment.patches[p] = std::move(patch);
  }
  std::vector<Vec3> control, nodes(static_cast<std::size_t>(out.of_control.rows()));
  for (const NurbsPatch& p : draft.patches) control.insert(control.end(), p.points.begin(), p.points.end());
  out.of_control.multiply<Vec3>(control, nodes);
  std::size_t next = 0;
  for (NurbsPatch& p : out.garment.patches)
    for (Vec3& x : p.points) x = nodes[next++];
  out.garment.placed.clear();  // a start is a displacement of control points (Cloth::fromDraft)
  return out;
}

Garment heldAtNodes(Garment garment) {
  for (Seam& seam : garment.seams) seam.kind = SeamKind::C0;
  return garment;
}

}  // namespace gambeson
