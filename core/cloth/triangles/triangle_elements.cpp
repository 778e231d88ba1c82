#include "core/cloth/triangles/triangle_elements.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "core/cloth/tensile.hpp"
#include "core/cloth/triangles/hinge_angle.hpp"
#include "core/cloth/triangles/lane_energies.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

BlockLaw lawOfTriangles(const Fabric& fabric) {
  checkFabric(fabric);
  if (fabric.energy)
    throw InputError({"", 0, "fabric.law"},
                     "is an energy at a point, which triangles do not carry; allowed with it: \"model\": \"nurbs\"");
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
LawUse bendingUse(LawUse use) {
  use.shears = false;
  return use;
}
LawUse membraneUse(LawUse use) {
  use.kinds = 0;
  return use;
}

/// Elements in one block share it.
std::pair<int, bool> blockOf(const MembraneTriangle& t) { return {t.law, false}; }
std::pair<int, bool> blockOf(const FoldHinge& h) { return {h.law, h.seam}; }

}  // namespace

/// Packs those elements of each law that are `among` these, and of seams apart. `rest(element, real)`: their numbers,
/// `number` of each; those of copies that fill up a group have no area. `placed(block, k, at)`: element k is at `at` of
/// the block.
template <class Element, class Among, class Rest, class Placed>
std::vector<ElementBlock> packed(const std::vector<Element>& elements, std::span<const BlockLaw> laws, int lanes,
                                 int number, const Among& among, const Rest& rest, const Placed& placed) {
  constexpr int corners = static_cast<int>(std::tuple_size_v<decltype(Element{}.corner)>);
  std::map<std::pair<int, bool>, std::vector<int>> kinds;
  for (std::size_t k = 0; k < elements.size(); ++k)
    if (among(k)) kinds[blockOf(elements[k])].push_back(static_cast<int>(k));
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
  moment_.assign(hinges_.size(), -1);
  const auto among = [&](std::size_t k) { return isHinge(k); };
  const auto rest = [](const FoldHinge& h, bool real) {
    return std::vector{h.theta0, h.per_angle, real ? h.area_m2 : 0.0, h.d.x, h.d.y, h.d.z};
  };
  const auto place = [&](ElementBlock& block, std::size_t k, int at) {
    block.law.use = bendingUse(block.law.use);
    const int size = block.law.use.historySize();
    if (at == 0) {
      block.first = moments_;
      block.history_first = history_;
      history_ += static_cast<long>(block.groups) * size * lanes;
    }
    history_at_[k] = block.history_first + static_cast<long>(at / lanes) * size * lanes + at % lanes;
    moment_[k] = static_cast<int>(block.first) + at;
    moments_ = static_cast<int>(block.first) + block.groups * lanes;
  };
  hinge_blocks_ = packed(hinges_, laws_, lanes, kHingeDoubles, among, rest, place);
}

void TriangleElements::packTriangles() {
  const int lanes = kernels_->lanes;
  // The hinge that faces each corner.
  std::vector<std::array<int, 3>> facing(triangles_.size(), {moments_, moments_, moments_});
  for (std::size_t k = 0; k < hinges_.size(); ++k)
    for (std::size_t side = 0; side < 2; ++side) {
      if (moment_[k] < 0) continue;
      const auto t = static_cast<std::size_t>(hinges_[k].triangle[side]);
      const auto& corner = triangles_[t].corner;
      const auto at = std::find(corner.begin(), corner.end(), hinges_[k].corner[2 + side]) - corner.begin();
      facing[t][static_cast<std::size_t>(at)] = moment_[k];
    }
  const auto rest = [](const MembraneTriangle& t, bool real) {
    return std::vector{t.g[0].x, t.g[0].y, t.g[1].x, t.g[1].y, real ? t.area_m2 : 0.0};
  };
  std::vector<long> slot(triangles_.size());  // of the first corner
  const auto all = [](std::size_t) { return true; };
  shear_at_.resize(triangles_.size());
  const auto place = [&](ElementBlock& block, std::size_t k, int at) {
    block.law.use = membraneUse(block.law.use);
    const int size = block.law.use.historySize();
    if (at == 0) {
      block.history_first = history_;
      history_ += static_cast<long>(block.groups) * size * lanes;
      block.hinge.assign(static_cast<std::size_t>(3 * block.groups * lanes), moments_);
      block.first = slot_count_;
      slot_count_ += 9L * block.groups * lanes;
      block.membrane = membraneOf(triangles_[k]);
      if (block.membrane.elements == MembraneElements::springs)
        block.springs.assign(static_cast<std::size_t>(kSpringDoubles * block.groups * lanes), 0.0);
    }
    shear_at_[k] = block.history_first + static_cast<long>(at / lanes) * size * lanes + at % lanes;
    if (!block.springs.empty()) {
      const TriangleSprings s = springsOf(block.membrane, triangles_[k].g, triangles_[k].area_m2);
      const double own[kSpringDoubles] = {s.rest_m[0],
                                          s.rest_m[1],
                                          s.rest_m[2],
                                          s.stiffness_N_per_m[0],
                                          s.stiffness_N_per_m[1],
                                          s.stiffness_N_per_m[2],
                                          s.damping_Ns_per_m};
      for (int i = 0; i < kSpringDoubles; ++i)
        block.springs[static_cast<std::size_t>((at / lanes * kSpringDoubles + i) * lanes + at % lanes)] = own[i];
    }
    const long first = 3L * (at / lanes) * lanes + at % lanes;
    for (std::size_t i = 0; i < 3; ++i)
      block.hinge[static_cast<std::size_t>(first) + i * static_cast<std::size_t>(lanes)] = facing[k][i];
    slot[k] = block.first + 9L * (at / lanes) * lanes + at % lanes;
  };
  triangle_blocks_ = packed(triangles_, laws_, lanes, kMembraneDoubles, all, rest, place);
  for (std::size_t k = 0; k < triangles_.size(); ++k)
    for (int i = 0; i < 3; ++i)
      gather_.add(triangles_[k].corner[static_cast<std::size_t>(i)], slot[k] + 3L * i * lanes, lanes);
}

TriangleElements::TriangleElements(int points, std::vector<MembraneTriangle> triangles, std::vector<FoldHinge> hinges,
                                   std::span<const Fabric> fabrics, const TriangleKernels& kernels,
                                   std::span<const MembraneModel> membranes, std::span<const SeamSpring> seam_springs)
    : triangles_(std::move(triangles)), hinges_(std::move(hinges)), kernels_(&kernels), gather_(points) {
  for (const Fabric& f : fabrics) {
    const std::size_t k = laws_.size();
    laws_.push_back(lawOfTriangles(f));
    membranes_.push_back(
        triangleMembrane(membranes.empty() ? MembraneModel{} : membranes[k], f, laws_.back().point.section));
  }
  history_at_.resize(hinges_.size());
  packHinges();
  bending_ = BendingTriangles(triangles_, hinges_, laws_, fabrics, kernels, moments_, history_);
  moments_ += bending_.moments();
  history_ += bending_.historySize();
  for (std::size_t k = 0; k < hinges_.size(); ++k)
    if (moment_[k] < 0) moment_[k] = bending_.momentOf(k);
  packTriangles();
  packSprings();
  quadratic_ = QuadraticHinges(hinges_, triangles_, laws_, kernels, slot_count_, gather_);
  slot_count_ += quadratic_.slots();
  seam_springs_ = SeamSprings(seam_springs, triangles_, laws_, bending_, kernels.lanes, slot_count_, gather_);
  slot_count_ += seam_springs_.slots();
  gather_.close();
  hinges_of_.assign(triangles_.size(), {-1, -1, -1});
  for (std::size_t k = 0; k < hinges_.size(); ++k)
    for (const int t : hinges_[k].triangle)
      *std::find(hinges_of_[static_cast<std::size_t>(t)].begin(), hinges_of_[static_cast<std::size_t>(t)].end(), -1) =
          static_cast<int>(k);
}

void TriangleElements::packSprings() {
  std::vector<CrossedSpring> springs;
  for (const FoldHinge& h : hinges_) {
    if (bendingOf(h) != BendingElements::springs) continue;
    const BlockLaw& law = laws_[static_cast<std::size_t>(h.law)];
    if (law.use.remembers())
      throw InputError({"", 0, "bending_elements"},
                       "springs know no law that remembers; allowed with it: midedge, triangle, hinge");
    const MembraneTriangle& first = triangles_[static_cast<std::size_t>(h.triangle[0])];
    springs.push_back(crossedSpring(h, first, triangles_[static_cast<std::size_t>(h.triangle[1])], law.point.section.D,
                                    first.bending_spring_N_per_m));
  }
  springs_ = CrossedSprings(std::move(springs), *kernels_, slot_count_, gather_);
  slot_count_ += springs_.slots();
}

BlockLaw TriangleElements::lawOf(int index, const ForceTerms& terms) const {
  return withTerms(laws_[static_cast<std::size_t>(index)], terms);
}

HistoryPlace TriangleElements::historyOf(std::size_t hinge) const {
  if (!isHinge(hinge)) return {};
  const int size = bendingUse(laws_[static_cast<std::size_t>(hinges_[hinge].law)].use).historySize();
  return {0,
          {},
          static_cast<std::size_t>(history_at_[hinge]),
          static_cast<std::size_t>(size),
          static_cast<std::size_t>(kernels_->lanes)};
}

HistoryPlace TriangleElements::shearHistoryOf(std::size_t triangle) const {
  const int size = membraneUse(laws_[static_cast<std::size_t>(triangles_[triangle].law)].use).historySize();
  return {0,
          {},
          static_cast<std::size_t>(shear_at_[triangle]),
          static_cast<std::size_t>(size),
          static_cast<std::size_t>(kernels_->lanes)};
}

History<double> TriangleElements::memoryOf(std::size_t hinge, const ClothState& state) const {
  const HistoryPlace own = historyOf(hinge);
  if (own.count == 0) return {};
  History<double> memory{state.history.empty() ? nullptr : state.history.data() + own.first, nullptr,
                         static_cast<long>(own.stride)};
  memory.elapsed_s = state.elapsed_s;
  return memory;
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

Vec3 TriangleElements::curvatureOf(int triangle, const ClothState& state, bool rest) const {
  if (const int bent = bending_.bentOf(triangle); bent >= 0) {
    const BentTriangle& t = bending_.triangles()[static_cast<std::size_t>(bent)];
    return bending_.changeOf(t, hinges_, state) + (rest ? t.rest : Vec3{});
  }
  Vec3 sum{};
  for (const int k : hinges_of_[static_cast<std::size_t>(triangle)]) {
    if (k < 0) continue;
    const FoldHinge& h = hinges_[static_cast<std::size_t>(k)];
    const double length = h.per_angle * h.area_m2;
    sum += (0.5 * length * (curvature(k, state.q) / h.per_angle + (rest ? h.theta0 : 0))) * h.d;
  }
  return sum / triangles_[static_cast<std::size_t>(triangle)].area_m2;
}

TriangleElements::PointMemory TriangleElements::memoryAt(int triangle, const ClothState& state) const {
  PointMemory out{};
  const BlockLaw& law = laws_[static_cast<std::size_t>(triangles_[static_cast<std::size_t>(triangle)].law)];
  const auto of_bending = static_cast<std::size_t>(law.use.shearHistory());
  if (const HistoryPlace own = shearHistoryOf(static_cast<std::size_t>(triangle)); !state.history.empty())
    for (std::size_t i = 0; i < own.count; ++i) out[of_bending + i] = state.history[own.first + i * own.stride];
  if (const int bent = bending_.bentOf(triangle); bent >= 0) {
    const History<double> memory = bending_.memoryOf(static_cast<std::size_t>(bent), state);
    for (std::size_t i = 0; memory.committed && i < of_bending; ++i) out[i] = memory.before(static_cast<int>(i));
    return out;
  }
  double area = 0;
  for (const int h : hinges_of_[static_cast<std::size_t>(triangle)]) {
    if (h < 0) continue;
    const History<double> memory = memoryOf(static_cast<std::size_t>(h), state);
    if (!memory.committed) continue;
    const double part = hinges_[static_cast<std::size_t>(h)].area_m2;
    area += part;
    const std::size_t size = historyOf(static_cast<std::size_t>(h)).count;
    for (std::size_t i = 0; i < size; ++i) out[i] += part * memory.before(static_cast<int>(i));
  }
  for (std::size_t i = 0; i < of_bending; ++i) out[i] /= area > 0 ? area : 1;
  return out;
}

PointState TriangleElements::stateOf(int triangle, const ClothState& state) const {
  PointState s{strain(triangle, state.q), curvatureOf(triangle, state, false), {}, {}};
  const double e[3] = {s.strain.x, s.strain.y, s.strain.z},
               k[3] = {s.curvature_change.x, s.curvature_change.y, s.curvature_change.z};
  const PointMemory remembered = memoryAt(triangle, state);
  History<double> memory{remembered.data(), nullptr};
  memory.elapsed_s = state.elapsed_s;
  const MembraneTriangle& t = triangles_[static_cast<std::size_t>(triangle)];
  const BlockLaw& law = laws_[static_cast<std::size_t>(t.law)];
  PointAnswer<double> r = resultants(law.point, e, k, memory);
  if (membraneOf(t).elements != MembraneElements::continuum) stretch(t, law, s.strain, {}, r.membrane);
  const double *n = r.membrane.resultant, *m = r.bending.resultant;
  s.n = {n[0], n[1], n[2]};
  s.m = {m[0], m[1], m[2]};
  return s;
}

void TriangleElements::force(const ClothState& state, const ClothForce& out, ClothWork& work,
                             const ForceTerms& terms) const {
  // Behind the slots the edges' moments, some that stay 0, and what bent triangles work with.
  const int lanes = kernels_->lanes;
  const std::size_t list = static_cast<std::size_t>(slot_count_ + moments_ + lanes);
  work.slots.resize(list + bending_.scratchSize());
  double* const moments = work.slots.data() + slot_count_;
  std::fill_n(moments + moments_, lanes, 0.0);
  if (out.energy) *out.energy = {};
  const double* q = reinterpret_cast<const double*>(state.q.data());
  LaneEnergies energies(work, out.energy);
  for (const ElementBlock& block : hinge_blocks_) {
    if (!(block.seam ? terms.seams : terms.bending)) {
      std::fill_n(moments + block.first, block.groups * lanes, 0.0);
      continue;
    }
    ForceTerms of_hinges = terms;
    of_hinges.bending = true;
    BlockLaw law = withHistory(withTerms(block.law, of_hinges), block.history_first, state, out);
    double* const energy = energies.start(block.groups * lanes, law);
    kernels_->hinges(block, law, q, moments + block.first, energy);
    energies.add(law);
  }
  bending_.force(state, out, terms, std::span(work.slots).subspan(list), moments, work);
  springs_.force(state, out, terms.bending, work.slots.data(), work);
  quadratic_.force(state, out, terms, work.slots.data(), work);
  seam_springs_.force(state, out, terms, work.slots.data());
  for (const ElementBlock& block : triangle_blocks_) {
    BlockLaw law = withHistory(withTerms(block.law, terms), block.history_first, state, out);
    double* const energy = energies.start(block.groups * lanes, law);
    kernels_->triangles(block, law, q, moments, work.slots.data() + block.first, energy);
    energies.add(law);
  }
  gather_.negativeSum(work.slots.data(), out.points);
}

bool TriangleElements::damps() const {
  return std::any_of(membranes_.begin(), membranes_.end(), [](const TriangleMembrane& m) { return m.damps(); });
}

void TriangleElements::dampingForce(const ClothState& state, const ClothForce& out, ClothWork& work) const {
  work.slots.resize(static_cast<std::size_t>(slot_count_));
  if (out.energy) *out.energy = {};
  const double *q = reinterpret_cast<const double*>(state.q.data()),
               *v = reinterpret_cast<const double*>(state.v.data());
  // What bends with slots of its own has these behind those of the triangles, and damps nothing.
  const long bending = springs_.slots() + quadratic_.slots() + seam_springs_.slots();
  std::fill_n(work.slots.data() + slot_count_ - bending, bending, 0.0);
  for (const ElementBlock& block : triangle_blocks_) {
    double* const slots = work.slots.data() + block.first;
    if (!block.membrane.damps()) {
      std::fill_n(slots, 9L * block.groups * kernels_->lanes, 0.0);
      continue;
    }
    if (out.energy) work.lane_energy.assign(static_cast<std::size_t>(block.groups * kernels_->lanes), 0.0);
    kernels_->damping(block, q, v, slots, out.energy ? work.lane_energy.data() : nullptr);
    if (!out.energy) continue;
    for (const double taken : work.lane_energy) out.energy->power_W += taken;
  }
  gather_.negativeSum(work.slots.data(), out.points);
}

void TriangleElements::stretch(const MembraneTriangle& t, const BlockLaw& law, const Vec3& strain,
                               const History<double>& memory, Answer<double, 3>& answer) const {
  const TriangleMembrane& own = membraneOf(t);
  const double e[3] = {strain.x, strain.y, strain.z};
  if (!law.membrane || own.elements == MembraneElements::continuum)
    return evaluateMembrane<all_parts>(law.evaluated(), numbersOf(law), e, memory, answer);
  if (own.elements == MembraneElements::springs)
    springResultants(springsOf(own, t.g, t.area_m2), t.area_m2, e, answer);
  else
    baraffWitkin<all_parts>(own.threads, e, answer);
  if (law.use.jams) addJamming<all_parts>(law.point.jam_N_per_m, law.point.jam_s, e, answer);
}

namespace {

/// dE/dq_I = (g.x f1, g.y f2, g.y f1 + g.x f2) of each corner of a triangle.
struct StrainGradient {
  Vec2 g[3];
  Vec3 of[3][3];

  StrainGradient(const MembraneTriangle& t, const Vec3& weft, const Vec3& warp)
      : g{{-t.g[0].x - t.g[1].x, -t.g[0].y - t.g[1].y}, t.g[0], t.g[1]} {
    for (int I = 0; I < 3; ++I)
      of[I][0] = g[I].x * weft, of[I][1] = g[I].y * warp, of[I][2] = g[I].y * weft + g[I].x * warp;
  }

  /// Adds the part of a slope [N/m].
  void addSlope(double area_m2, const double* C, std::vector<std::array<double, 9>>& blocks) const {
    constexpr int at[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
    for (int I = 0; I < 3; ++I)
      for (int J = 0; J < 3; ++J)
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c)
            addOuter(blocks[static_cast<std::size_t>(3 * I + J)], area_m2 * C[at[r][c]], of[I][r], of[J][c]);
  }
};

}  // namespace

void TriangleElements::membraneDamping(int triangle, std::span<const Vec3> q,
                                       std::vector<std::array<double, 9>>& blocks) const {
  const MembraneTriangle& t = triangles_[static_cast<std::size_t>(triangle)];
  blocks.assign(9, {});
  const TriangleMembrane& own = membraneOf(t);
  if (!own.damps()) return;
  Vec3 f[2];
  const Vec3 strains = strain(triangle, q, &f[0], &f[1]);
  const double e[3] = {strains.x, strains.y, strains.z}, rate[3]{};
  Answer<double, 3> answer;
  if (own.elements == MembraneElements::springs)
    springDampingResultants(springsOf(own, t.g, t.area_m2), t.area_m2, e, rate, answer);
  else
    baraffWitkinDamping<all_parts>(own.threads, e, rate, answer);
  StrainGradient(t, f[0], f[1]).addSlope(t.area_m2, answer.slope, blocks);
}

void TriangleElements::membraneStiffness(int triangle, const ClothState& state, const ForceTerms& terms,
                                         std::vector<std::array<double, 9>>& blocks) const {
  const MembraneTriangle& t = triangles_[static_cast<std::size_t>(triangle)];
  Vec3 f[2];
  const Vec3 e = strain(triangle, state.q, &f[0], &f[1]);
  BlockLaw law = lawOf(t.law, terms);
  law.use = membraneUse(law.use);
  const HistoryPlace own = shearHistoryOf(static_cast<std::size_t>(triangle));
  History<double> memory;
  if (own.count > 0 && !state.history.empty())
    memory = {state.history.data() + own.first, nullptr, static_cast<long>(own.stride)};
  Answer<double, 3> answer;
  stretch(t, law, e, memory, answer);
  const double* n = answer.resultant;
  double tension[3];
  if (terms.definite) {
    tensilePart(n, tension);
    n = tension;
  }
  const StrainGradient gradient(t, f[0], f[1]);
  const Vec2* g = gradient.g;
  blocks.assign(9, {});
  gradient.addSlope(t.area_m2, answer.slope, blocks);
  for (int I = 0; I < 3; ++I)
    for (int J = 0; J < 3; ++J) {
      std::array<double, 9>& m = blocks[static_cast<std::size_t>(3 * I + J)];
      const double geometric =
          t.area_m2 * (n[0] * g[I].x * g[J].x + n[1] * g[I].y * g[J].y + n[2] * (g[I].x * g[J].y + g[I].y * g[J].x));
      for (std::size_t d = 0; d < 3; ++d) m[4 * d] += geometric;
    }
}

void TriangleElements::hingeStiffness(int hinge, const ClothState& state, const ForceTerms& terms,
                                      std::vector<std::array<double, 9>>& blocks) const {
  const FoldHinge& h = hinges_[static_cast<std::size_t>(hinge)];
  blocks.assign(16, {});
  if (!isHinge(static_cast<std::size_t>(hinge))) return;
  if (!(h.seam ? terms.seams : terms.bending)) return;
  const HingePoints x = cornersOf(h, state.q);
  HingePoints gradient;
  const double kappa = h.per_angle * (foldAngle(x, &gradient) - h.theta0);
  ForceTerms of_hinges = terms;
  of_hinges.bending = true;
  BlockLaw law = lawOf(h.law, of_hinges);
  law.use = bendingUse(law.use);
  const double change[3] = {kappa * h.d.x, kappa * h.d.y, kappa * h.d.z}, d[3] = {h.d.x, h.d.y, h.d.z};
  Answer<double, 3> answer;
  evaluateBending<with_slope>(law.evaluated(), numbersOf(law), change, memoryOf(static_cast<std::size_t>(hinge), state),
                              answer);
  double across[3]{};
  addProduct(answer.slope, d, across);
  const double slope = across[0] * d[0] + across[1] * d[1] + across[2] * d[2];
  const double moment = answer.resultant[0] * d[0] + answer.resultant[1] * d[1] + answer.resultant[2] * d[2];
  std::array<std::array<double, 9>, 16> second;
  if (terms.definite)
    second.fill({});
  else
    foldAngleHessian(x, second);
  for (std::size_t I = 0; I < 4; ++I)
    for (std::size_t J = 0; J < 4; ++J) {
      std::array<double, 9>& m = blocks[4 * I + J];
      for (std::size_t k = 0; k < 9; ++k) m[k] = h.area_m2 * h.per_angle * moment * second[4 * I + J][k];
      addOuter(m, h.area_m2 * h.per_angle * h.per_angle * slope, gradient[I], gradient[J]);
    }
}

}  // namespace gambeson
