#include "core/cloth/shell/shell.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "core/cloth/draft/sewing.hpp"
#include "core/cloth/draft/whole_runs.hpp"
#include "core/cloth/patches/rest_frame.hpp"
#include "core/cloth/shell/shell_pack.hpp"
#include "core/error.hpp"
#include "core/math/parallel.hpp"

namespace gambeson {
namespace {

bool isRational(const NurbsPatch& p) {
  return std::any_of(p.weights.begin(), p.weights.end(), [&](double w) { return w != p.weights.front(); });
}

/// Whether two points a cell tell all quadratics on these knots apart: if and only if an inner knot is simple.
///
/// f = c (s - s1)(s - s2) is what vanishes at both points of a cell, s from 0 to its length h. On two cells of lengths
/// k and h that join with their slopes, f = d k^2/6 = c h^2/6 and f' = d k = - c h: only d = c = 0, and what joins them
/// is 0 as well. Where all inner knots are double (or there is none), the bubbles of the cells make up a function that
/// no point sees. It bends the sheet across, but pulls along it, and the stiffness of a tension there, do not see it.
bool twoPointsSeeAll(const KnotVector& k) {
  const std::vector<double> ends = breakpoints(k);
  return std::any_of(ends.begin() + 1, ends.end() - 1,
                     [&](double t) { return std::count(k.knots.begin(), k.knots.end(), t) == 1; });
}

const Fabric& fabricOfBlock(const Garment& garment, std::optional<int> fabric) {
  return fabric.value_or(0) == 0 ? garment.fabric : garment.other_fabrics[static_cast<std::size_t>(*fabric - 1)];
}

/// The cells of a block whose fabric's law is an energy at a point.
std::optional<PointCells> pointCells(const Garment& garment, const std::vector<int>& offsets, const BlockKind& kind,
                                     const std::vector<SheetCell>& cells, const ShellBlock& block) {
  if (!kind.fabric) return std::nullopt;  // validateFields lets no such fabric vary
  const Fabric& fabric = fabricOfBlock(garment, kind.fabric);
  if (!fabric.energy) return std::nullopt;
  if (kind.assumed) throw InputError({"", 0, "rule"}, "assumed strains are of fabrics with a law in closed form");
  BlockLayout layout{block.lanes, 0, {}};
  for (int group = 0; group < block.groups; ++group) layout.first_point.push_back(block.firstPoint(group));
  return PointCells(garment, offsets, cells, {block.gu, block.gv}, std::move(layout), fabric.energy,
                    hasRestCurvature(fabric));
}

/// Doubles that each point of a part remembers.
int historySize(const ShellPart& part) {
  return part.points ? static_cast<int>(part.points->energy().historySize()) : part.law.use.historySize();
}

/// The law of a block: where its fabric varies, what any of its points may need.
BlockLaw lawOfBlock(const Garment& garment, std::optional<int> fabric) {
  BlockLaw law = blockLaw(fabricOfBlock(garment, fabric));
  if (fabric) return law;
  law.general = true;
  for (const Fabric& other : garment.other_fabrics) {
    const BlockLaw more = blockLaw(other);
    law.use.kinds |= more.use.kinds;
    law.use.tension |= more.use.tension;
    law.use.jams |= more.use.jams;
    law.use.shears |= more.use.shears;
  }
  return law;
}

/// Cut cells in the order of their number of points, so that a group has equals.
void sortByPoints(std::vector<SheetCell>& cells) {
  std::stable_sort(cells.begin(), cells.end(),
                   [](const SheetCell& a, const SheetCell& b) { return a.points.size() < b.points.size(); });
}

}  // namespace

Shell::Shell(const Garment& garment, const KernelSet& kernels, int gauss_extra, CellRule rule)
    : garment_(garment), kernels_(&kernels), offsets_(controlOffsets(garment)), control_count_(offsets_.back()) {
  checkGarment(garment);
  for (const NurbsPatch& patch : garment.patches)
    if (patch.u.degree < 1 || patch.u.degree > 5 || patch.v.degree < 1 || patch.v.degree > 5)
      throw InputError({"", 0, "degree"}, "degrees of a shell patch must be 1 to 5");
  std::map<BlockKind, std::vector<SheetCell>> kinds;
  std::vector<SheetCell> all_cells = sheetCells(garment);
  const WholeRuns runs(garment, all_cells);
  for (SheetCell& cell : all_cells) {
    if (cell.cut && cell.points.empty()) continue;
    const NurbsPatch& patch = garment.patches[cell.patch];
    BlockKind kind{patch.u.degree,
                   patch.v.degree,
                   !cell.cut && isRational(patch),
                   cell.cut,
                   fabricOfPatch(garment, cell.patch),
                   false,
                   false,
                   false};
    if (kind.p == 2 && kind.q == 2 && !kind.scattered) {
      kind.assumed = rule == CellRule::assumed;
      // What trimming leaves of a patch may be as narrow as a cell anywhere.
      const bool fewer = rule != CellRule::full && !isTrimmed(garment, cell.patch) && !(kind.assumed && kind.rational);
      kind.fewer_u = fewer && twoPointsSeeAll(patch.u);
      kind.fewer_v = fewer && twoPointsSeeAll(patch.v);
      // Panels are trimmed all round, and would lock as thin cloth does under the full rule.
      if (rule == CellRule::automatic && isTrimmed(garment, cell.patch) && isPanel(garment, cell.patch)) {
        kind.fewer_u = runs.alongU(cell);
        kind.fewer_v = runs.alongV(cell);
      }
    }
    kinds[kind].push_back(std::move(cell));
  }
  const int L = kernels.lanes;
  gather_ = SlotGather(control_count_);
  for (auto& [kind, cells] : kinds) {
    if (kind.scattered) sortByPoints(cells);
    ShellPart part{packBlock(garment, offsets_, kind, cells, L, gauss_extra), lawOfBlock(garment, kind.fabric),
                   slot_count_, static_cast<int>(cells.size()), std::nullopt};
    const ShellBlock& b = part.block;
    part.points = pointCells(garment_, offsets_, kind, cells, b);
    const int nn = b.nodeCount();
    for (long at = 0; at < static_cast<long>(cells.size()); ++at)
      for (int k = 0; k < nn; ++k) {
        const long node = (at / L) * nn + k;
        gather_.add(b.nodes[node * L + at % L], part.first_slot + node * 3 * L + at % L, L);
      }
    for (const SheetCell& cell : cells)
      gauss_points_ += cell.cut ? static_cast<long>(cell.points.size()) : long{b.gu} * b.gv;
    slot_count_ += static_cast<long>(b.groups) * nn * 3 * L;
    parts_.push_back(std::move(part));
  }
  const bool remembers = std::any_of(parts_.begin(), parts_.end(), [](const ShellPart& part) {
    return part.points ? historySize(part) > 0 : part.law.use.remembers();
  });
  if (remembers) {
    auto part = parts_.begin();
    for (const auto& kind : kinds) {
      memory_.add(part->block, kind.second, historySize(*part));
      if (part->points) part->points->setHistory(part->block.history_first);
      ++part;
    }
  }

  // Springs along seams; where the map T holds the tangents together the angle cannot change, and no spring is needed.
  const FreeMap map = buildFreeMap(garment);
  std::vector<Vec3> Q, gradient;
  for (const NurbsPatch& p : garment.patches) Q.insert(Q.end(), p.points.begin(), p.points.end());
  WeakPoints weak = buildWeakSeams(garment);
  gaps_ = std::move(weak.gaps);
  std::vector<GapPoint> sewn = weakSewnRows(garment);
  std::move(sewn.begin(), sewn.end(), std::back_inserter(gaps_));
  std::vector<HingePoint> hinges = buildHinges(garment), sewn_hinges = buildSewnHinges(garment);
  std::move(weak.hinges.begin(), weak.hinges.end(), std::back_inserter(hinges));
  std::move(sewn_hinges.begin(), sewn_hinges.end(), std::back_inserter(hinges));
  for (HingePoint& h : hinges) {
    hingeAngle(h, Q, &gradient);
    std::map<int, Vec3> pulled;
    double size = 0, left = 0;
    for (std::size_t k = 0; k < h.columns.size(); ++k) {
      size += norm(gradient[k]);
      for (int e = map.T.offsets[h.columns[k]]; e < map.T.offsets[h.columns[k] + 1]; ++e)
        pulled[map.T.columns[e]] += map.T.values[e] * gradient[k];
    }
    for (const auto& entry : pulled) left += norm(entry.second);
    if (left > 1e-9 * size) hinges_.push_back(std::move(h));
  }
  hinge_slot_ = slot_count_;
  for (const HingePoint& h : hinges_) {
    hinge_offset_.push_back((slot_count_ - hinge_slot_) / 3);
    for (std::size_t k = 0; k < h.columns.size(); ++k)
      gather_.add(h.columns[k], slot_count_ + 3 * static_cast<long>(k), 1);
    slot_count_ += 3 * static_cast<long>(h.columns.size());
  }
  gap_slot_ = slot_count_;
  for (const GapPoint& point : gaps_) {
    gap_offset_.push_back((slot_count_ - gap_slot_) / 3);
    for (std::size_t k = 0; k < point.columns.size(); ++k)
      gather_.add(point.columns[k], slot_count_ + 3 * static_cast<long>(k), 1);
    slot_count_ += 3 * static_cast<long>(point.columns.size());
  }
  gather_.close();
}

void Shell::cellForces(const ClothState& state, const ClothForce& out, ClothWork& work, const ForceTerms& terms,
                       const StrainBox& within) const {
  work.slots.resize(slot_count_);
  const bool cells = terms.membrane || terms.bending;
  if (!cells) std::fill(work.slots.begin(), work.slots.begin() + hinge_slot_, 0.0);
  for (const ShellPart& part : parts_) {
    if (!cells) break;
    if (part.points) {
      part.points->force(state, out, terms, within, work.slots.data() + part.first_slot);
      continue;
    }
    BlockLaw law = withHistory(withTerms(part.law, terms), part.block.history_first, state, out);
    const std::size_t lanes = static_cast<std::size_t>(part.block.groups) * part.block.lanes;
    if (out.energy) work.lane_energy.assign(lanes, 0.0);
    if (out.energy && law.remembers()) work.lane_lost.assign(lanes, 0.0), law.lost = work.lane_lost.data();
    kernels_->force(part.block, law, reinterpret_cast<const double*>(state.q.data()),
                    work.slots.data() + part.first_slot, out.energy ? work.lane_energy.data() : nullptr);
    if (out.energy)
      for (double e : work.lane_energy) out.energy->stored += e;
    if (law.lost)
      for (double e : work.lane_lost) out.energy->lost += e;
  }
}

void Shell::force(std::span<const Vec3> q, std::span<Vec3> f, ClothWork& work, double* energy,
                  const ForceTerms& terms) const {
  ClothEnergy both;
  force(ClothState(q), {f, {}, {}, energy ? &both : nullptr}, work, terms);
  if (energy) *energy = both.stored;
}

void Shell::force(const ClothState& state, const ClothForce& out, ClothWork& work, const ForceTerms& terms,
                  const StrainBox& within) const {
  const std::span<const Vec3> q = state.q;
  if (out.energy) *out.energy = {};
  cellForces(state, out, work, terms, within);
  double* const energy = out.energy ? &out.energy->stored : nullptr;
  const int hinge_count = static_cast<int>(hinges_.size());
  std::vector<double> hinge_energy(energy ? hinge_count : 0);
  forAllWith<std::vector<Vec3>>(Each::element, 0, hinge_count, [&](std::vector<Vec3>& gradient, int i) {
    const HingePoint& h = hinges_[i];
    const double turn = terms.seams ? hingeAngle(h, q, &gradient) - h.theta0 : 0.0;
    for (std::size_t k = 0; k < h.columns.size(); ++k) {
      const Vec3 g = terms.seams ? (h.stiffness_length * turn) * gradient[k] : Vec3{};
      double* slot = work.slots.data() + hinge_slot_ + 3 * (hinge_offset_[i] + static_cast<long>(k));
      slot[0] = g.x;
      slot[1] = g.y;
      slot[2] = g.z;
    }
    if (energy) hinge_energy[i] = 0.5 * h.stiffness_length * turn * turn;
  });
  for (double e : hinge_energy) *energy += e;
  const int gap_count = static_cast<int>(gaps_.size());
  std::vector<double> gap_energy(energy ? gap_count : 0);
  forAll(Each::element, gap_count, [&](int i) {
    const GapPoint& point = gaps_[i];
    const Vec3 gap = terms.seams ? gapOf(point, q) : Vec3{};
    for (std::size_t k = 0; k < point.columns.size(); ++k) {
      const Vec3 g = (point.stiffness_N_per_m * point.row[k]) * gap;
      double* slot = work.slots.data() + gap_slot_ + 3 * (gap_offset_[i] + static_cast<long>(k));
      slot[0] = g.x;
      slot[1] = g.y;
      slot[2] = g.z;
    }
    if (energy) gap_energy[i] = 0.5 * point.stiffness_N_per_m * norm2(gap);
  });
  for (double e : gap_energy) *energy += e;
  gather_.negativeSum(work.slots.data(), out.points);
}

struct Shell::Frame {
  RestFrame G;
  std::array<Vec3, 6> rest{}, now{};  ///< derivatives in the parameters, as SurfaceBasis
};

namespace {

/// The rest surface has an area there, and the weft (where not null) does not stand across it.
bool isFramed(const std::array<Vec3, 6>& rest, const Vec3* weft) {
  const Vec3 normal = cross(rest[1], rest[2]);
  const double area = norm(normal);
  if (!(area > 1e-10 * std::max(norm2(rest[1]), norm2(rest[2])))) return false;
  if (!weft) return true;
  const Vec3 n = normal / area;
  return norm(*weft - dot(*weft, n) * n) > 1e-6 * norm(*weft);
}

/// A share of the way to the middle of the cell.
Vec2 towardsMiddle(const NurbsPatch& p, Vec2 uv, double share) {
  const auto moved = [&](const KnotVector& k, double t) {
    const auto span = static_cast<std::size_t>(findSpan(k, t));
    return t + share * (0.5 * (k.knots[span] + k.knots[span + 1]) - t);
  };
  return share > 0 ? Vec2{moved(p.u, uv.x), moved(p.v, uv.y)} : uv;
}

}  // namespace

std::array<std::array<Vec3, 6>, 2> Shell::derivativesAt(int patch, Vec2 uv, std::span<const Vec3> q) const {
  const SurfaceBasis basis = surfaceBasis(garment_.patches[patch], uv.x, uv.y);
  std::array<std::array<Vec3, 6>, 2> d{};
  for (std::size_t k = 0; k < basis.columns.size(); ++k)
    for (int m = 1; m < 6; ++m) {
      d[0][m] += basis.values[m][k] * garment_.patches[patch].points[basis.columns[k]];
      d[1][m] += basis.values[m][k] * q[offsets_[patch] + basis.columns[k]];
    }
  return d;
}

/// Where the rest surface has no frame (at a pole; at the corner of a patch whose edges run on there in one line, as on
/// a disc of nine points; where it stands across the weft) the frame is that beside it: a tenth of the way to the
/// middle of the cell, or in its middle.
Shell::Frame Shell::frameAt(int patch, Vec2 uv, std::span<const Vec3> q) const {
  const Vec3& weft = garment_.weft[patch];
  Frame frame;
  for (const double share : {0.0, 0.1, 1.0}) {
    const auto [rest, now] = derivativesAt(patch, towardsMiddle(garment_.patches[patch], uv, share), q);
    frame.rest = rest, frame.now = now;
    if (isFramed(rest, &weft)) break;
  }
  frame.G = restFrame(frame.rest[1], frame.rest[2], weft, fibreAngleAt(garment_, patch, uv));
  return frame;
}

PointState Shell::stateAt(int patch, Vec2 uv, const ClothState& at) const {
  const Frame frame = frameAt(patch, uv, at.q);
  const RestFrame& G = frame.G;
  const Vec3 e1 = G.G11 * frame.now[1] + G.G21 * frame.now[2], e2 = G.G12 * frame.now[1] + G.G22 * frame.now[2];
  const Fabric fabric = fabricAt(garment_, patch, uv);
  const auto bent = [&](const std::array<Vec3, 6>& d) { return curvature(G, d[1], d[2], d[3], d[4], d[5]); };
  Vec3 change = bent(frame.now);
  if (hasRestCurvature(fabric)) change -= bent(frame.rest);
  change.z *= 2;
  PointState state{{0.5 * (norm2(e1) - 1), 0.5 * (norm2(e2) - 1), dot(e1, e2)}, change, {}, {}};
  const NurbsPatch& p = garment_.patches[patch];
  History<double> remembered = memory_.nearest(patch, {findSpan(p.u, uv.x), findSpan(p.v, uv.y)}, uv, at.history);
  remembered.elapsed_s = at.elapsed_s;
  if (fabric.energy) {
    std::vector<double> history;
    for (std::size_t i = 0; i < fabric.energy->historySize(); ++i)
      history.push_back(remembered.before(static_cast<int>(i)));
    const SheetStrain strain{{state.strain.x, state.strain.y, state.strain.z}, {change.x, change.y, change.z}};
    const SheetAnswer a = fabric.energy->at(strain, SheetParts::resultants, history);
    state.n = {a.resultant[0], a.resultant[1], a.resultant[2]};
    state.m = {a.moment[0], a.moment[1], a.moment[2]};
    return state;
  }
  const double e[3] = {state.strain.x, state.strain.y, state.strain.z}, k[3] = {change.x, change.y, change.z};
  const PointAnswer<double> r = resultants(pointLaw(fabric), e, k, remembered);
  const double *n = r.membrane.resultant, *m = r.bending.resultant;
  state.n = {n[0], n[1], n[2]};
  state.m = {m[0], m[1], m[2]};
  return state;
}

PrincipalStress Shell::stressAt(int patch, Vec2 uv, std::span<const Vec3> q, Vec2 more_N_per_m) const {
  const auto [e, change, of_strain, m] = stateAt(patch, uv, q);
  const Vec3 n = of_strain + Vec3{more_N_per_m.x, more_N_per_m.y, 0};
  const double E11 = e.x, E22 = e.y, E12 = 0.5 * e.z, C11 = 2 * E11 + 1, C22 = 2 * E22 + 1, C12 = 2 * E12;
  // Principal values of F n Fᵀ / J are those of n C / J.
  const double J = std::sqrt(C11 * C22 - C12 * C12);
  const double trace = n.x * C11 + 2 * n.z * C12 + n.y * C22, det = (n.x * n.y - n.z * n.z) * (C11 * C22 - C12 * C12);
  const double root = std::sqrt(std::max(0.0, 0.25 * trace * trace - det));
  const double mean = 0.5 * (E11 + E22), radius = std::hypot(0.5 * (E11 - E22), E12);
  return {(0.5 * trace + root) / J, (0.5 * trace - root) / J, mean + radius, mean - radius};
}

std::optional<StrainBox> Shell::lawStrains(const ClothState& state) const {
  std::optional<StrainBox> all;
  for (const ShellPart& part : parts_) {
    if (!part.points) continue;
    if (!all) all = StrainBox::none();
    all->add(part.points->strains(state));
  }
  return all;
}

LawRange Shell::lawRange(const ClothState& state) const {
  LawRange all;
  for (const ShellPart& part : parts_) {
    if (!part.points) continue;
    all.add(part.points->range(state));
  }
  return all;
}

Vec3 Shell::curvatureAt(int patch, Vec2 uv, std::span<const Vec3> q) const {
  const Frame frame = frameAt(patch, uv, q);
  const auto& d = frame.now;
  return curvature(frame.G, d[1], d[2], d[3], d[4], d[5]);
}

double Shell::bendAt(int patch, Vec2 uv, std::span<const Vec3> q) const {
  const NurbsPatch& p = garment_.patches[patch];
  std::array<std::array<Vec3, 6>, 2> both{};
  for (const double share : {0.0, 0.1, 1.0})
    if (both = derivativesAt(patch, towardsMiddle(p, uv, share), q); isFramed(both[0], nullptr)) break;
  const auto& [rest, d] = both;
  const Vec3 k = curvature(restFrame(rest[1], rest[2], rest[1], 0), d[1], d[2], d[3], d[4], d[5]);
  return std::sqrt(k.x * k.x + k.y * k.y + 2 * k.z * k.z);
}

}  // namespace gambeson
