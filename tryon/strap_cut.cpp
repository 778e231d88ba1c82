#include "tryon/strap_cut.hpp"

namespace gambeson {
namespace {

constexpr int kRows = 2;  ///< of control points beyond a cut

struct Grid {
  int first = 0, nu = 0, nv = 0;
  int at(int i, int j) const { return first + i + nu * j; }
};

std::vector<Grid> gridsOf(const Garment& g) {
  std::vector<Grid> grids;
  int first = 0;
  for (const NurbsPatch& p : g.patches) {
    grids.push_back({first, p.u.count(), p.v.count()});
    first += grids.back().nu * grids.back().nv;
  }
  return grids;
}

/// Calls f(control point) for each point of the strap beyond the cut.
template <class F>
void forBeyond(const Grid& grid, const StrapCut& cut, F f) {
  const int along = cut.along_v ? grid.nv : grid.nu, across = cut.along_v ? grid.nu : grid.nv;
  for (int r = 0; r < kRows; ++r)
    for (int i = 0; i < across; ++i) {
      const int row = cut.at_end ? along - 1 - r : r;
      f(cut.along_v ? grid.at(i, row) : grid.at(row, i));
    }
}

double lengthOf(const NurbsPatch& p, const StrapCut& cut) {
  constexpr int kPieces = 64;
  double length = 0;
  Vec3 last{};
  for (int k = 0; k <= kPieces; ++k) {
    const double s = static_cast<double>(k) / kPieces;
    const auto on = [&](const KnotVector& n) { return (1 - s) * n.front() + s * n.back(); };
    const Vec3 x = cut.along_v ? surfaceDerivatives(p, on(p.u), cut.at_end ? p.v.back() : p.v.front())[0]
                               : surfaceDerivatives(p, cut.at_end ? p.u.back() : p.u.front(), on(p.v))[0];
    if (k > 0) length += norm(x - last);
    last = x;
  }
  return length;
}

}  // namespace

std::vector<StrapCut> strapCuts(const Garment& g, std::span<const std::string> names) {
  std::vector<StrapCut> cuts;
  for (std::size_t p = 0; p < g.patches.size(); ++p) {
    if (!names[p].substr(names[p].rfind(' ') + 1).starts_with("strap")) continue;
    bool sewn[4]{};
    for (const Seam& s : g.seams)
      for (const PatchEdge& e : {s.a, s.b})
        if (e.patch == static_cast<int>(p)) sewn[static_cast<int>(e.side)] = true;
    const bool along_u = sewn[0] && sewn[1], along_v = sewn[2] && sewn[3];
    const NurbsPatch& patch = g.patches[p];
    if (along_u == along_v || (along_v ? patch.v : patch.u).count() < 2 * kRows + 1) continue;
    for (const bool end : {false, true}) {
      cuts.push_back({static_cast<int>(p), along_v, end, 0});
      cuts.back().width_m = lengthOf(patch, cuts.back());
    }
  }
  return cuts;
}

std::vector<double> weightsBelow(const Garment& g, std::span<const StrapCut> cuts, bool own) {
  const std::vector<Grid> grids = gridsOf(g);
  std::vector<double> w(grids.empty() ? 0 : static_cast<std::size_t>(grids.back().at(0, grids.back().nv)), 0);
  const auto fill = [&](const Grid& grid, double value) {
    for (int k = 0; k < grid.nu * grid.nv; ++k) w[static_cast<std::size_t>(grid.first + k)] = value;
  };
  for (const StrapCut& cut : cuts)
    for (std::size_t p = 0; p < grids.size(); ++p)
      if (!own || g.layerOf(static_cast<int>(p)) == g.layerOf(cut.patch)) fill(grids[p], 1);
  for (const StrapCut& cut : cuts) fill(grids[static_cast<std::size_t>(cut.patch)], 0);
  for (const StrapCut& cut : cuts)
    forBeyond(grids[static_cast<std::size_t>(cut.patch)], cut, [&](int i) { w[static_cast<std::size_t>(i)] = 1; });
  return w;
}

std::vector<Vec3> strapPulls(const Shell& shell, std::span<const Vec3> q, std::span<const StrapCut> cuts,
                             ShellWork& work) {
  std::vector<Vec3> f(q.size()), pulls;
  shell.force(q, f, work, nullptr, {.membrane = true, .bending = true, .seams = false});
  const std::vector<Grid> grids = gridsOf(shell.garment());
  for (const StrapCut& cut : cuts) {
    Vec3 sum{};
    forBeyond(grids[static_cast<std::size_t>(cut.patch)], cut, [&](int i) { sum += f[static_cast<std::size_t>(i)]; });
    pulls.push_back(sum);
  }
  return pulls;
}

}  // namespace gambeson
