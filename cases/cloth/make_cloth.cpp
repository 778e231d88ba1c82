#include "cases/cloth/make_cloth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "cases/input/wrong_entry.hpp"
#include "core/cloth/degenerated/degenerated_shell.hpp"
#include "core/cloth/draft/join_garments.hpp"
#include "core/cloth/joined_cloth.hpp"
#include "core/cloth/shell/nurbs_shell.hpp"
#include "core/cloth/springs/spring_cloth.hpp"
#include "core/cloth/triangles/draft_mesh.hpp"
#include "core/cloth/triangles/triangle_cloth.hpp"

namespace gambeson {
namespace {

std::string membraneInWords(MembraneElements membrane) {
  switch (membrane) {
    case MembraneElements::continuum:
      return "Triangles of constant Green-Lagrange strain; ";
    case MembraneElements::springs:
      return "Triangles with springs along their edges; ";
    case MembraneElements::baraff_witkin:
      return "Triangles with threads along weft and warp (Baraff and Witkin); ";
  }
  return {};
}

std::string bendingInWords(BendingElements bending) {
  switch (bending) {
    case BendingElements::midedge:
      return "each bends by its tensor of curvature, edges turn by unknowns of their own.";
    case BendingElements::triangle:
      return "each bends by its tensor of curvature, from half of the folds at its edges.";
    case BendingElements::hinge:
      return "they bend at their edges.";
    case BendingElements::springs:
      return "crossed springs resist bending.";
    case BendingElements::quadratic:
      return "they bend at their edges, by an energy that is quadratic in the positions.";
  }
  return {};
}

std::unique_ptr<const Cloth> shellOf(std::span<const ClothSource> sources) {
  const ShellOptions options{sources[0].model.gauss_extra, sources[0].model.rule, nullptr};
  if (sources.size() == 1) return std::make_unique<NurbsShell>(sources[0].draft, options);
  std::vector<Garment> drafts;
  for (const ClothSource& s : sources) drafts.push_back(s.draft);
  return std::make_unique<NurbsShell>(joinGarments(drafts), options);
}

std::unique_ptr<const Cloth> trianglesOf(std::span<const ClothSource> sources) {
  std::vector<MeshDraft> garments;
  for (const ClothSource& s : sources) {
    garments.push_back(underKey(s.key, [&] { return s.mesh ? *s.mesh : meshDraft(s.draft, s.model.mesh); }));
    garments.back().closed = s.closed;
    if (!s.closed) garments.back().springs.clear();  // panels that do not meet have no angle between them
    garments.back().membrane = s.model.membrane;
    garments.back().bending = s.model.bending;
    garments.back().bending_spring_N_per_m = s.model.bending_spring_N_per_m;
  }
  return std::make_unique<TriangleCloth>(std::move(garments));
}

/// Whether neighbouring garments of a kind are made into one cloth: those of nodes have numbers of their own.
bool joins(ClothKind kind) { return kind == ClothKind::nurbs || kind == ClothKind::triangles; }

std::unique_ptr<const Cloth> degeneratedOf(const ClothSource& source) {
  return underKey(source.key, [&] {
    return std::make_unique<DegeneratedShell>(source.draft, source.model.shell.value_or(DegeneratedOptions{}));
  });
}

std::unique_ptr<const Cloth> springsOf(const ClothSource& source) {
  return underKey(source.key, [&] {
    return std::make_unique<SpringCloth>(source.draft, source.model.springs.value_or(SpringNumbers{}));
  });
}

std::unique_ptr<const Cloth> clothOfOneKind(std::span<const ClothSource> sources) {
  switch (sources[0].model.kind) {
    case ClothKind::nurbs:
      return shellOf(sources);
    case ClothKind::triangles:
      return trianglesOf(sources);
    case ClothKind::springs:
      return springsOf(sources[0]);
    case ClothKind::shell:
      return degeneratedOf(sources[0]);
  }
  return nullptr;
}

}  // namespace

std::unique_ptr<const Cloth> makeCloth(std::span<const ClothSource> sources) {
  std::vector<std::unique_ptr<const Cloth>> kinds;
  for (std::size_t from = 0; from < sources.size();) {
    std::size_t end = from + 1;
    const ClothKind kind = sources[from].model.kind;
    while (joins(kind) && end < sources.size() && sources[end].model.kind == kind) ++end;
    kinds.push_back(clothOfOneKind(sources.subspan(from, end - from)));
    from = end;
  }
  return kinds.size() == 1 ? std::move(kinds[0]) : std::make_unique<JoinedCloth>(std::move(kinds));
}

MeshDraft meshOf(const Garment& draft, const ClothModel& model) { return meshDraft(draft, model.mesh); }

int samplesPerCell(const ClothModel& model, int asked) {
  switch (model.kind) {
    case ClothKind::nurbs:
      return asked;
    case ClothKind::triangles:
      return 1;
    case ClothKind::springs:
    case ClothKind::shell:
      return std::max(1, asked);
  }
  return asked;
}

std::string inWords(const ClothModel& model) {
  switch (model.kind) {
    case ClothKind::nurbs:
      return "Kirchhoff-Love sheet: thin, normals stay normal; strains of the reference surface are Green-Lagrange's.";
    case ClothKind::triangles:
      return membraneInWords(model.membrane.elements) + bendingInWords(model.bending);
    case ClothKind::springs:
      return "Points at the corners of the cells, joined by springs.";
    case ClothKind::shell:
      return "Bilinear degenerated shell (Man 2006, 2.3): directors through the thickness turn by themselves and "
             "shear; strains are Green-Lagrange's, the shape at rest has none in the plane and across; it does not jam.";
  }
  return {};
}

namespace {

std::string springsInWords(const SpringNumbers& n) {
  const auto given = [](double number, const char* otherwise) {
    return number > 0 ? fmt::format("{:g} N/m", number) : std::string(otherwise);
  };
  const bool strips = n.flexion == Flexion::buckling;
  return fmt::format(
      "In place of the fabric's membrane and bending springs join neighbours ({}) and the diagonals of cells ({}), as "
      "Provot's do (Man 2006, 2.2): their Poisson's ratio follows from them. {}. They do not jam. Seams with springs "
      "of "
      "their own bend as the cloth beside them.",
      given(n.structural_N_per_m, "as stiff as the fabric asks for"), given(n.shear_N_per_m, "the fabric's shear"),
      strips ? fmt::format("Every second point is joined by a strip that buckles (eq. 2.10), of {}",
                           n.rigidity_Nm > 0 ? fmt::format("{:g} N m", n.rigidity_Nm) : "the fabric's rigidity")
             : fmt::format("Every second point is joined likewise ({}), which is limp where flat",
                           given(n.flexion_N_per_m, "as stores what the fabric's rigidity does at 1/cm")));
}

}  // namespace

std::string ownLawsInWords(const ClothModel& model) {
  if (model.kind == ClothKind::springs) return springsInWords(model.springs.value_or(SpringNumbers{}));
  const MembraneModel& m = model.membrane;
  const auto given = [](double number, const char* otherwise) {
    return number > 0 ? fmt::format("{:g} N/m", number) : std::string(otherwise);
  };
  const bool damped = m.stretch_damping_Ns_per_m > 0 || m.shear_damping_Ns_per_m > 0;
  switch (m.elements) {
    case MembraneElements::continuum:
      return {};
    case MembraneElements::springs:
      return fmt::format(
          "In place of the fabric's membrane springs lie along the edges of the triangles (Wong 2014, eq. 3.1), of "
          "{}{}. Their Poisson's ratio is 1/3, and shear follows from them.",
          given(m.spring_N_per_m, "the fabric's modulus along them (Van Gelder 1998)"), damped ? ", damped" : "");
    case MembraneElements::baraff_witkin:
      return fmt::format(
          "In place of the fabric's membrane threads along weft ({}) and warp ({}) are stretched, and the cosine "
          "between them is resisted ({}){} (Wong 2014, eq. 3.3 to 3.8). Their Poisson's ratio is 0.",
          given(m.weft_N_per_m, "the fabric's"), given(m.warp_N_per_m, "the fabric's"),
          given(m.shear_N_per_m, "the fabric's"), damped ? ", with damping" : "");
  }
  return {};
}

}  // namespace gambeson
