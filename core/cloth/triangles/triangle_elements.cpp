#include "core/cloth/triangles/triangle_elements.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "core/cloth/triangles/hinge_angle.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

BlockLaw lawOfTriangles(const Fabric& fabric) {
  checkFabric(fabric);
  const BlockLaw law = blockLaw(fabric);
  const Section& s = law.point.section;
  for (int i = 0; i < 6; ++i)
    if (std::abs(s.B[static_cast<std::size_t>(i)]) > 1e-12 * std::sqrt(s.A[0] * s.D[0]))
      throw InputError(
          {"", 0, "fabric.plies"},
          "couple membrane and bending, which triangles cannot carry; allowed: plies that are symmetric about "
          "the middle, or \"model\": \"nurbs\"");
  return law;
}

PointNumbers<double> numbersOf(const BlockLaw& law) {
  PointNumbers<double> numbers = numbersOf(law.point);
  leaveOut(law, numbers);
  return numbers;
}

HingePoints cornersOf(const FoldHinge& h, std::span<const Vec3> q) {
  return {q[h.corner[0]], q[h.corner[1]], q[h.corner[2]], q[h.corner[3]]};
}

void addOuter(std::array<double, 9>& m, double scale, const Vec3& a, const Vec3& b) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m[static_cast<std::size_t>(3 * i + j)] += scale * a[i] * b[j];
}

/// What hinges have of a law, and what membranes have.
LawUse bendingOf(LawUse use) {
  use.shears = false;
  return use;
}
LawUse membraneOf(LawUse use) {
  use.kinds = 0;
  return use;
}

/// Elements in one block share it.
std::pair<int, bool> blockOf(const MembraneTriangle& t) { return {t.law, false}; }
std::pair<int, bool> blockOf(const FoldHinge& h) { return {h.law, h.seam}; }

}  // namespace

/// Packs the elements of each law, and of seams apart. `rest(element, real)`: their numbers, `number` of each; those of
/// copies that fill up a group have no area. `placed(block, k, at)`: element k is at `at` of the block.
template <class Element, class Rest, class Placed>
std::vector<ElementBlock> packed(const std::vector<Element>& elements, std::span<const BlockLaw> laws, int lanes,
                                 int number, const Rest& rest, const Placed& placed) {
  constexpr int corners = static_cast<int>(std::tuple_size_v<decltype(Element{}.corner)>);
  std::map<std::pair<int, bool>, std::vector<int>> kinds;
  for (std::size_t k = 0; k < elements.size(); ++k) kinds[blockOf(elements[k])].push_back(static_cast<int>(k));
  std::vector<ElementBlock> blocks;
  for (const auto& [kind, members] : kinds) {
    const int count = static_cast<int>(members.size());
    ElementBlock& block = blocks.emplace_back();
    block.groups = (count + lanes - 1) / lanes;
    block.law = laws[static_cast<std::size_t>(kind.first)];
    block.seam = kind.second;
    block.corners.resize(static_cast<std::size_t>(block.groups * corners * lanes));
    block.rest.resize(static_cast<std::size_t>(block.groups * number * lanes));
    for (int at = 0; at < block.groups * lanes; ++at) {
      const int group = at / lanes, lane = at % lanes;
      const auto k = static_cast<std::size_t>(members[static_cast<std::size_t>(std::min(at, count - 1))]);
      const std::vector<double> numbers = rest(elements[k], at < count);
      for (int i = 0; i < corners; ++i)
        block.corners[static_cast<std::size_t>((group * corners + i) * lanes + lane)] =
            elements[k].corner[static_cast<std::size_t>(i)];
      for (int i = 0; i < number; ++i)
        block.rest[static_cast<std::size_t>((group * number + i) * lanes + lane)] =
            numbers[static_cast<std::size_t>(i)];
      if (at < count) placed(block, k, at);
    }
  }
  return blocks;
}

void TriangleElements::packHinges() {
  const int lanes = kernels_->lanes;
  moment_.resize(hinges_.size());
  const auto rest = [](const FoldHinge& h, bool real) {
    return std::vector{h.theta0, h.per_angle, real ? h.area_m2 : 0.0, h.d.x, h.d.y, h.d.z};
  };
  hinge_blocks_ = packed(hinges_, laws_, lanes, kHingeDoubles, rest, [&](ElementBlock& block, std::size_t k, int at) {
    block.law.use = bendingOf(block.law.use);
    const int size = block.law.use.historySize();
    if (at == 0) {
      block.first = moments_;
      block.history_first = history_;
      history_ += static_cast<long>(block.groups) * size * lanes;
    }
    history_at_[k] = block.history_first + static_cast<long>(at / lanes) * size * lanes + at % lanes;
    moment_[k] = static_cast<int>(block.first) + at;
    moments_ = static_cast<int>(block.first) + block.groups * lanes;
  });
}

void TriangleElements::packTriangles() {
  const int lanes = kernels_->lanes;
  // The hinge that faces each corner.
  std::vector<std::array<int, 3>> facing(triangles_.size(), {moments_, moments_, moments_});
  for (std::size_t k = 0; k < hinges_.size(); ++k)
    for (std::size_t side = 0; side < 2; ++side) {
      const auto t = static_cast<std::size_t>(hinges_[k].triangle[side]);
      const auto& corner = triangles_[t].corner;
      const auto at = std::find(corner.begin(), corner.end(), hinges_[k].corner[2 + side]) - corner.begin();
      facing[t][static_cast<std::size_t>(at)] = moment_[k];
    }
  const auto rest = [](const MembraneTriangle& t, bool real) {
    return std::vector{t.g[0].x, t.g[0].y, t.g[1].x, t.g[1].y, real ? t.area_m2 : 0.0};
  };
  std::vector<long> slot(triangles_.size());  // of the first corner
  shear_at_.resize(triangles_.size());
  triangle_blocks_ =
      packed(triangles_, laws_, lanes, kMembraneDoubles, rest, [&](ElementBlock& block, std::size_t k, int at) {
        block.law.use = membraneOf(block.law.use);
        const int size = block.law.use.historySize();
        if (at == 0) {
          block.history_first = history_;
          history_ += static_cast<long>(block.groups) * size * lanes;
          block.hinge.assign(static_cast<std::size_t>(3 * block.groups * lanes), moments_);
          block.first = slot_count_;
          slot_count_ += 9L * block.groups * lanes;
        }
        shear_at_[k] = block.history_first + static_cast<long>(at / lanes) * size * lanes + at % lanes;
        const long first = 3L * (at / lanes) * lanes + at % lanes;
        for (std::size_t i = 0; i < 3; ++i)
          block.hinge[static_cast<std::size_t>(first) + i * static_cast<std::size_t>(lanes)] = facing[k][i];
        slot[k] = block.first + 9L * (at / lanes) * lanes + at % lanes;
      });
  for (std::size_t k = 0; k < triangles_.size(); ++k)
    for (int i = 0; i < 3; ++i)
      gather_.add(triangles_[k].corner[static_cast<std::size_t>(i)], slot[k] + 3L * i * lanes, lanes);
}

TriangleElements::TriangleElements(int points, std::vector<MembraneTriangle> triangles, std::vector<FoldHinge> hinges,
                                   std::span<const Fabric> fabrics, const TriangleKernels& kernels)
    : triangles_(std::move(triangles)), hinges_(std::move(hinges)), kernels_(&kernels), gather_(points) {
  for (const Fabric& f : fabrics) laws_.push_back(lawOfTriangles(f));
  history_at_.resize(hinges_.size());
  packHinges();
  packTriangles();
  gather_.close();
  hinges_of_.assign(triangles_.size(), {-1, -1, -1});
  for (std::size_t k = 0; k < hinges_.size(); ++k)
    for (const int t : hinges_[k].triangle)
      *std::find(hinges_of_[static_cast<std::size_t>(t)].begin(), hinges_of_[static_cast<std::size_t>(t)].end(), -1) =
          static_cast<int>(k);
}

BlockLaw TriangleElements::lawOf(int index, const ForceTerms& terms) const {
  return withTerms(laws_[static_cast<std::size_t>(index)], terms);
}

HistoryPlace TriangleElements::historyOf(std::size_t hinge) const {
  const int size = bendingOf(laws_[static_cast<std::size_t>(hinges_[hinge].law)].use).historySize();
  return {0,
          {},
          static_cast<std::size_t>(history_at_[hinge]),
          static_cast<std::size_t>(size),
          static_cast<std::size_t>(kernels_->lanes)};
}

HistoryPlace TriangleElements::shearHistoryOf(std::size_t triangle) const {
  const int size = membraneOf(laws_[static_cast<std::size_t>(triangles_[triangle].law)].use).historySize();
  return {0,
          {},
          static_cast<std::size_t>(shear_at_[triangle]),
          static_cast<std::size_t>(size),
          static_cast<std::size_t>(kernels_->lanes)};
}

History<double> TriangleElements::memoryOf(std::size_t hinge, std::span<const double> history) const {
  const HistoryPlace own = historyOf(hinge);
  if (history.empty() || own.count == 0) return {};
  return {history.data() + own.first, nullptr, static_cast<long>(own.stride)};
}

Vec3 TriangleElements::strain(int triangle, std::span<const Vec3> q, Vec3* weft, Vec3* warp) const {
  const MembraneTriangle& t = triangles_[static_cast<std::size_t>(triangle)];
  const Vec3 e1 = q[t.corner[1]] - q[t.corner[0]], e2 = q[t.corner[2]] - q[t.corner[0]];
  const Vec3 f1 = t.g[0].x * e1 + t.g[1].x * e2, f2 = t.g[0].y * e1 + t.g[1].y * e2;
  if (weft) *weft = f1;
  if (warp) *warp = f2;
  return {0.5 * (norm2(f1) - 1), 0.5 * (norm2(f2) - 1), dot(f1, f2)};
}

double TriangleElements::curvature(int hinge, std::span<const Vec3> q) const {
  const FoldHinge& h = hinges_[static_cast<std::size_t>(hinge)];
  return h.per_angle * (foldAngle(cornersOf(h, q), nullptr) - h.theta0);
}

Vec3 TriangleElements::curvatureOf(int triangle, std::span<const Vec3> q, bool rest) const {
  Vec3 sum{};
  for (const int k : hinges_of_[static_cast<std::size_t>(triangle)]) {
    if (k < 0) continue;
    const FoldHinge& h = hinges_[static_cast<std::size_t>(k)];
    const double length = h.per_angle * h.area_m2;
    sum += (0.5 * length * (curvature(k, q) / h.per_angle + (rest ? h.theta0 : 0))) * h.d;
  }
  return sum / triangles_[static_cast<std::size_t>(triangle)].area_m2;
}

PointState TriangleElements::stateOf(int triangle, const ClothState& state) const {
  PointState s{strain(triangle, state.q), curvatureOf(triangle, state.q, false), {}, {}};
  const double e[3] = {s.strain.x, s.strain.y, s.strain.z},
               k[3] = {s.curvature_change.x, s.curvature_change.y, s.curvature_change.z};
  std::array<double, kMostHistory + kShearHistory> mean{};
  double area = 0;
  for (const int h : hinges_of_[static_cast<std::size_t>(triangle)]) {
    if (h < 0) continue;
    const History<double> memory = memoryOf(static_cast<std::size_t>(h), state.history);
    if (!memory.committed) continue;
    const double part = hinges_[static_cast<std::size_t>(h)].area_m2;
    area += part;
    const std::size_t size = historyOf(static_cast<std::size_t>(h)).count;
    for (std::size_t i = 0; i < size; ++i) mean[i] += part * memory.before(static_cast<int>(i));
  }
  for (double& m : mean) m /= area > 0 ? area : 1;
  if (const HistoryPlace own = shearHistoryOf(static_cast<std::size_t>(triangle));
      own.count > 0 && !state.history.empty()) {
    const MembraneTriangle& t = triangles_[static_cast<std::size_t>(triangle)];
    const int first = laws_[static_cast<std::size_t>(t.law)].use.shearHistory();
    for (std::size_t i = 0; i < own.count; ++i)
      mean[static_cast<std::size_t>(first) + i] = state.history[own.first + i * own.stride];
  }
  const PointLaw& law = laws_[static_cast<std::size_t>(triangles_[static_cast<std::size_t>(triangle)].law)].point;
  const PointAnswer<double> r = resultants(law, e, k, {mean.data(), nullptr});
  const double *n = r.membrane.resultant, *m = r.bending.resultant;
  s.n = {n[0], n[1], n[2]};
  s.m = {m[0], m[1], m[2]};
  return s;
}

void TriangleElements::force(const ClothState& state, const ClothForce& out, ClothWork& work,
                             const ForceTerms& terms) const {
  // Behind the slots the hinges' moments, and a last one that stays 0.
  work.slots.resize(static_cast<std::size_t>(slot_count_ + moments_ + 1));
  double* const moments = work.slots.data() + slot_count_;
  moments[moments_] = 0;
  if (out.energy) *out.energy = {};
  const double* q = reinterpret_cast<const double*>(state.q.data());
  double* energies = nullptr;
  const auto startEnergies = [&](const ElementBlock& block, BlockLaw& law) {
    if (!out.energy) return;
    const auto lanes = static_cast<std::size_t>(block.groups * kernels_->lanes);
    work.lane_energy.assign(lanes, 0.0);
    energies = work.lane_energy.data();
    if (law.remembers()) work.lane_lost.assign(lanes, 0.0), law.lost = work.lane_lost.data();
  };
  const auto addEnergies = [&](const BlockLaw& law) {
    if (!out.energy) return;
    for (double e : work.lane_energy) out.energy->stored += e;
    if (law.lost)
      for (double e : work.lane_lost) out.energy->lost += e;
  };
  for (const ElementBlock& block : hinge_blocks_) {
    if (!terms.bending || (block.seam && !terms.seams)) {
      std::fill_n(moments + block.first, block.groups * kernels_->lanes, 0.0);
      continue;
    }
    BlockLaw law = withHistory(withTerms(block.law, terms), block.history_first, state, out);
    startEnergies(block, law);
    kernels_->hinges(block, law, q, moments + block.first, energies);
    addEnergies(law);
  }
  for (const ElementBlock& block : triangle_blocks_) {
    BlockLaw law = withHistory(withTerms(block.law, terms), block.history_first, state, out);
    startEnergies(block, law);
    kernels_->triangles(block, law, q, moments, work.slots.data() + block.first, energies);
    addEnergies(law);
  }
  gather_.negativeSum(work.slots.data(), out.points);
}

void TriangleElements::membraneStiffness(int triangle, const ClothState& state, const ForceTerms& terms,
                                         std::vector<std::array<double, 9>>& blocks) const {
  const MembraneTriangle& t = triangles_[static_cast<std::size_t>(triangle)];
  Vec3 f[2];
  const Vec3 e = strain(triangle, state.q, &f[0], &f[1]);
  BlockLaw law = lawOf(t.law, terms);
  law.use = membraneOf(law.use);
  const HistoryPlace own = shearHistoryOf(static_cast<std::size_t>(triangle));
  History<double> memory;
  if (own.count > 0 && !state.history.empty())
    memory = {state.history.data() + own.first, nullptr, static_cast<long>(own.stride)};
  const double strains[3] = {e.x, e.y, e.z};
  Answer<double, 3> answer;
  evaluateMembrane<with_slope>(law.evaluated(), numbersOf(law), strains, memory, answer);
  const double *n = answer.resultant, *C = answer.slope;
  const Vec2 g[3] = {{-t.g[0].x - t.g[1].x, -t.g[0].y - t.g[1].y}, t.g[0], t.g[1]};
  // dE/dq_I = (g.x f1, g.y f2, g.y f1 + g.x f2).
  Vec3 b[3][3];
  for (int I = 0; I < 3; ++I) b[I][0] = g[I].x * f[0], b[I][1] = g[I].y * f[1], b[I][2] = g[I].y * f[0] + g[I].x * f[1];
  blocks.assign(9, {});
  constexpr int at[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
  for (int I = 0; I < 3; ++I)
    for (int J = 0; J < 3; ++J) {
      std::array<double, 9>& m = blocks[static_cast<std::size_t>(3 * I + J)];
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) addOuter(m, t.area_m2 * C[at[r][c]], b[I][r], b[J][c]);
      const double geometric =
          t.area_m2 * (n[0] * g[I].x * g[J].x + n[1] * g[I].y * g[J].y + n[2] * (g[I].x * g[J].y + g[I].y * g[J].x));
      for (std::size_t d = 0; d < 3; ++d) m[4 * d] += geometric;
    }
}

void TriangleElements::hingeStiffness(int hinge, const ClothState& state, const ForceTerms& terms,
                                      std::vector<std::array<double, 9>>& blocks) const {
  const FoldHinge& h = hinges_[static_cast<std::size_t>(hinge)];
  blocks.assign(16, {});
  if (!(terms.bending && (terms.seams || !h.seam))) return;
  const HingePoints x = cornersOf(h, state.q);
  HingePoints gradient;
  const double kappa = h.per_angle * (foldAngle(x, &gradient) - h.theta0);
  BlockLaw law = lawOf(h.law, terms);
  law.use = bendingOf(law.use);
  const double change[3] = {kappa * h.d.x, kappa * h.d.y, kappa * h.d.z}, d[3] = {h.d.x, h.d.y, h.d.z};
  Answer<double, 3> answer;
  evaluateBending<with_slope>(law.evaluated(), numbersOf(law), change,
                              memoryOf(static_cast<std::size_t>(hinge), state.history), answer);
  double across[3]{};
  addProduct(answer.slope, d, across);
  const double slope = across[0] * d[0] + across[1] * d[1] + across[2] * d[2];
  const double moment = answer.resultant[0] * d[0] + answer.resultant[1] * d[1] + answer.resultant[2] * d[2];
  std::array<std::array<double, 9>, 16> second;
  foldAngleHessian(x, second);
  for (std::size_t I = 0; I < 4; ++I)
    for (std::size_t J = 0; J < 4; ++J) {
      std::array<double, 9>& m = blocks[4 * I + J];
      for (std::size_t k = 0; k < 9; ++k) m[k] = h.area_m2 * h.per_angle * moment * second[4 * I + J][k];
      addOuter(m, h.area_m2 * h.per_angle * h.per_angle * slope, gradient[I], gradient[J]);
    }
}

}  // namespace gambeson
