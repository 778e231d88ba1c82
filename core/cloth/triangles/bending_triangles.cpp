#include "core/cloth/triangles/bending_triangles.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/cloth/free_blocks.hpp"
#include "core/cloth/triangles/hinge_angle.hpp"
#include "core/cloth/triangles/lane_energies.hpp"

namespace gambeson {
namespace {

/// The edge of a triangle that a fold is, on its side 0 or 1.
std::size_t edgeAt(const BentTriangle& t, const FoldHinge& h, std::size_t side) {
  return static_cast<std::size_t>(std::find(t.corner.begin(), t.corner.end(), h.corner[2 + side]) - t.corner.begin());
}

/// Curvature (k11, k22, 2 k12) of an angle at each edge: 2/h n x n, with n/h the gradient of the coordinate of the
/// corner that the edge faces.
std::array<Vec3, 3> curvaturePerAngle(const MembraneTriangle& t) {
  const Vec2 g[3] = {{-t.g[0].x - t.g[1].x, -t.g[0].y - t.g[1].y}, t.g[0], t.g[1]};
  std::array<Vec3, 3> all;
  for (std::size_t i = 0; i < 3; ++i) {
    const double h = 1 / std::hypot(g[i].x, g[i].y);
    all[i] = 2 * h * Vec3{g[i].x * g[i].x, g[i].y * g[i].y, 2 * g[i].x * g[i].y};
  }
  return all;
}

/// The member of a block at one of its lanes; those beyond the last repeat it.
std::size_t memberOf(const std::vector<std::size_t>& members, int at) {
  return members[std::min(static_cast<std::size_t>(at), members.size() - 1)];
}

HingePoints cornersOf(const FoldHinge& h, std::span<const Vec3> q) {
  return {q[h.corner[0]], q[h.corner[1]], q[h.corner[2]], q[h.corner[3]]};
}

PointNumbers<double> numbersOf(const BlockLaw& law) {
  PointNumbers<double> numbers = numbersOf(law.point);
  leaveOut(law, numbers);
  return numbers;
}

}  // namespace

BendingTriangles::BendingTriangles(const std::vector<MembraneTriangle>& triangles, std::span<const FoldHinge> hinges,
                                   std::span<const BlockLaw> laws, std::span<const Fabric> fabrics,
                                   const TriangleKernels& kernels, int first_moment, long first_history)
    : bent_of_(triangles.size(), -1),
      laws_(laws.begin(), laws.end()),
      kernels_(&kernels),
      moment_of_(hinges.size(), -1) {
  for (BlockLaw& law : laws_) law.use.shears = false;  // that is the membrane's
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const MembraneTriangle& m = triangles[t];
    if (!bendTriangles(m.bending)) continue;
    bent_of_[t] = static_cast<int>(bent_.size());
    BentTriangle bent;
    bent.triangle = static_cast<int>(t);
    bent.corner = m.corner;
    bent.law = m.law;
    bent.area_m2 = m.area_m2;
    bent.per_angle = curvaturePerAngle(m);
    if (m.bending == BendingElements::midedge) bent.turn.fill(0);  // numbered below
    bent_.push_back(bent);
  }
  if (bent_.empty()) return;
  findEdges(hinges);
  findMasses(fabrics);
  std::map<int, std::vector<std::size_t>> of_law;
  for (std::size_t k = 0; k < bent_.size(); ++k) of_law[bent_[k].law].push_back(k);
  std::vector<std::vector<std::size_t>> members;
  for (const auto& [law, those] : of_law) members.push_back(those);
  packTriangles(members, first_history);
  packEdges(hinges, members, first_moment);
}

/// Numbers the unknowns: those of folds in their order, then those of the border in the order of the triangles.
void BendingTriangles::findEdges(std::span<const FoldHinge> hinges) {
  for (std::size_t k = 0; k < hinges.size(); ++k) {
    int turn = -1;
    for (std::size_t side = 0; side < 2; ++side) {
      const int bent = bent_of_[static_cast<std::size_t>(hinges[k].triangle[side])];
      if (bent < 0) continue;
      BentTriangle& t = bent_[static_cast<std::size_t>(bent)];
      const std::size_t edge = edgeAt(t, hinges[k], side);
      t.hinge[edge] = static_cast<int>(k);
      t.sense[edge] = side == 0 ? 1 : -1;
      t.rest += 0.5 * hinges[k].theta0 * t.per_angle[edge];
      if (t.turn[edge] >= 0 && turn < 0) turn = turning_++;
      t.turn[edge] = turn;
    }
  }
  int turns = turning_;
  for (BentTriangle& t : bent_)
    for (std::size_t i = 0; i < 3; ++i)
      if (t.hinge[i] < 0 && t.turn[i] >= 0) t.turn[i] = turns++;
  inner_mass_.resize(static_cast<std::size_t>(turns));
}

void BendingTriangles::findMasses(std::span<const Fabric> fabrics) {
  std::vector<double> height(inner_mass_.size()), sides(inner_mass_.size());
  for (const BentTriangle& t : bent_)
    for (std::size_t i = 0; i < 3; ++i) {
      if (t.turn[i] < 0) continue;
      const auto k = static_cast<std::size_t>(t.turn[i]);
      inner_mass_[k] += fabrics[static_cast<std::size_t>(t.law)].surfaceDensity() * t.area_m2 / 3;
      height[k] += 2 / (t.per_angle[i].x + t.per_angle[i].y);  // n is a unit vector
      ++sides[k];
    }
  for (std::size_t k = 0; k < inner_mass_.size(); ++k) {
    const double h = height[k] / sides[k];
    inner_mass_[k] *= 4 * h * h;
  }
}

void BendingTriangles::packTriangles(std::span<const std::vector<std::size_t>> of_law, long first_history) {
  const int lanes = kernels_->lanes;
  couple_at_.resize(bent_.size());
  history_at_.resize(bent_.size());
  for (const std::vector<std::size_t>& members : of_law) {
    BendingBlock& block = blocks_.emplace_back();
    const int count = static_cast<int>(members.size());
    block.groups = (count + lanes - 1) / lanes;
    block.law = laws_[static_cast<std::size_t>(bent_[members[0]].law)];
    block.history_first = first_history + history_;
    block.first_couple = couples_;
    block.angle.resize(static_cast<std::size_t>(3 * block.groups * lanes));
    block.rest.resize(static_cast<std::size_t>(kBendingDoubles * block.groups * lanes));
    const int size = block.law.use.historySize();
    for (int at = 0; at < block.groups * lanes; ++at) {
      const long group = at / lanes, lane = at % lanes;
      const std::size_t k = memberOf(members, at);
      const BentTriangle& t = bent_[k];
      double* rest = block.rest.data() + group * kBendingDoubles * lanes + lane;
      for (int i = 0; i < 3; ++i) {
        rest[i * lanes] = t.rest[i];
        for (std::size_t e = 0; e < 3; ++e) rest[(4 + 3 * static_cast<long>(e) + i) * lanes] = t.per_angle[e][i];
      }
      rest[3L * lanes] = at < count ? t.area_m2 : 0;
      if (at >= count) continue;
      for (std::size_t e = 0; e < 3; ++e)
        couple_at_[k][e] = static_cast<int>(couples_ + (3 * group + static_cast<long>(e)) * lanes + lane);
      history_at_[k] = block.history_first + group * size * lanes + lane;
    }
    couples_ += 3L * block.groups * lanes;
    history_ += static_cast<long>(block.groups) * size * lanes;
  }
}

void BendingTriangles::packEdges(std::span<const FoldHinge> hinges, std::span<const std::vector<std::size_t>> of_law,
                                 int first_moment) {
  const int lanes = kernels_->lanes;
  struct Edge {  // of one or two triangles
    int hinge = -1;
    std::array<std::array<int, 2>, 2> side{{{-1, 0}, {-1, 0}}};  ///< bent triangle and its edge
  };
  std::vector<Edge> of_kind[3];
  std::vector<Edge> folds(hinges.size());
  for (std::size_t k = 0; k < bent_.size(); ++k)
    for (std::size_t i = 0; i < 3; ++i) {
      const BentTriangle& t = bent_[k];
      const std::array<int, 2> at{static_cast<int>(k), static_cast<int>(i)};
      if (t.hinge[i] >= 0) {
        Edge& fold = folds[static_cast<std::size_t>(t.hinge[i])];
        fold.hinge = t.hinge[i];
        fold.side[t.sense[i] > 0 ? 0 : 1] = at;
      } else if (t.turn[i] >= 0) {
        of_kind[static_cast<int>(EdgeBlock::Kind::border)].push_back({-1, {at, at}});
      }
    }
  for (const Edge& fold : folds) {
    if (fold.hinge < 0) continue;
    const BentTriangle& t = bent_[static_cast<std::size_t>(fold.side[0][0])];
    const bool turns = t.turn[static_cast<std::size_t>(fold.side[0][1])] >= 0;
    of_kind[static_cast<int>(turns ? EdgeBlock::Kind::turning : EdgeBlock::Kind::still)].push_back(fold);
  }
  std::vector<std::array<int, 3>> angle_at(bent_.size(), {-1, -1, -1});
  for (const EdgeBlock::Kind kind : {EdgeBlock::Kind::turning, EdgeBlock::Kind::still, EdgeBlock::Kind::border}) {
    const std::vector<Edge>& members = of_kind[static_cast<int>(kind)];
    if (members.empty()) continue;
    EdgeBlock& block = edges_.emplace_back();
    block.kind = kind;
    block.count = static_cast<int>(members.size());
    block.groups = (block.count + lanes - 1) / lanes;
    block.first_angle = angles_;
    block.first_moment = first_moment + moments_;
    block.first_turn = kind == EdgeBlock::Kind::border ? turning_ : 0;
    const bool border = kind == EdgeBlock::Kind::border;
    if (!border) block.corners.resize(static_cast<std::size_t>(4 * block.groups * lanes));
    block.couple.resize(static_cast<std::size_t>(block.sides() * block.groups * lanes));
    for (int at = 0; at < block.groups * lanes; ++at) {
      const long group = at / lanes, lane = at % lanes;
      const Edge& edge = members[static_cast<std::size_t>(std::min(at, block.count - 1))];
      for (int side = 0; side < block.sides(); ++side) {
        const auto [bent, i] = edge.side[static_cast<std::size_t>(side)];
        const auto b = static_cast<std::size_t>(bent), e = static_cast<std::size_t>(i);
        block.couple[static_cast<std::size_t>((group * block.sides() + side) * lanes + lane)] = couple_at_[b][e];
        if (at < block.count)
          angle_at[b][e] = static_cast<int>(
              angles_ + (group * block.angles() + std::min(side, block.angles() - 1)) * lanes + lane);
      }
      if (border) continue;
      const auto hinge = static_cast<std::size_t>(edge.hinge);
      for (long i = 0; i < 4; ++i)
        block.corners[static_cast<std::size_t>((4 * group + i) * lanes + lane)] =
            hinges[hinge].corner[static_cast<std::size_t>(i)];
      if (at < block.count) moment_of_[hinge] = static_cast<int>(block.first_moment) + at;
    }
    angles_ += static_cast<long>(block.angles()) * block.groups * lanes;
    if (!border) moments_ += block.groups * lanes;
  }
  // Behind all angles those that stay 0.
  for (std::size_t k = 0; k < bent_.size(); ++k)
    for (int& at : angle_at[k])
      if (at < 0) at = static_cast<int>(angles_);
  angles_ += lanes;
  for (std::size_t b = 0; b < blocks_.size(); ++b)
    for (int at = 0; at < blocks_[b].groups * lanes; ++at)
      for (std::size_t e = 0; e < 3; ++e)
        blocks_[b].angle[static_cast<std::size_t>((3L * (at / lanes) + static_cast<long>(e)) * lanes + at % lanes)] =
            angle_at[memberOf(of_law[b], at)][e];
}

HistoryPlace BendingTriangles::historyOf(std::size_t bent) const {
  const int size = laws_[static_cast<std::size_t>(bent_[bent].law)].use.historySize();
  return {0,
          {},
          static_cast<std::size_t>(history_at_[bent]),
          static_cast<std::size_t>(size),
          static_cast<std::size_t>(kernels_->lanes)};
}

History<double> BendingTriangles::memoryOf(std::size_t bent, const ClothState& state) const {
  const HistoryPlace own = historyOf(bent);
  if (own.count == 0) return {};
  History<double> memory{state.history.empty() ? nullptr : state.history.data() + own.first, nullptr,
                         static_cast<long>(own.stride)};
  memory.elapsed_s = state.elapsed_s;
  return memory;
}

void BendingTriangles::force(const ClothState& state, const ClothForce& out, const ForceTerms& terms,
                             std::span<double> scratch, double* moments, ClothWork& work) const {
  if (bent_.empty()) return;
  const int lanes = kernels_->lanes;
  if (!terms.bending) {
    for (const EdgeBlock& block : edges_)
      if (block.kind != EdgeBlock::Kind::border)
        std::fill_n(moments + block.first_moment, block.groups * lanes, 0.0);
    std::fill(out.inner.begin(), out.inner.end(), 0.0);
    return;
  }
  const double* q = reinterpret_cast<const double*>(state.q.data());
  double *const angles = scratch.data(), *const couples = angles + angles_;
  std::fill_n(angles + angles_ - lanes, lanes, 0.0);
  for (const EdgeBlock& block : edges_)
    kernels_->bending->angles(block, q, state.inner.empty() ? nullptr : state.inner.data() + block.first_turn,
                              angles + block.first_angle, moments + block.first_moment);
  LaneEnergies energies(work, out.energy);
  for (const BendingBlock& block : blocks_) {
    BlockLaw law = withHistory(withTerms(block.law, terms), block.history_first, state, out);
    double* const energy = energies.start(block.groups * lanes, law);
    kernels_->bending->bend(block, law, angles, couples + block.first_couple, energy);
    energies.add(law);
  }
  for (const EdgeBlock& block : edges_)
    kernels_->bending->moments(block, couples, moments + block.first_moment,
                               out.inner.empty() ? nullptr : out.inner.data() + block.first_turn);
}

Vec3 BendingTriangles::changeOf(const BentTriangle& t, std::span<const FoldHinge> hinges,
                                const ClothState& state) const {
  Vec3 change = -t.rest;
  for (std::size_t i = 0; i < 3; ++i) {
    double angle = 0;
    if (t.hinge[i] >= 0)
      angle = 0.5 * foldAngle(cornersOf(hinges[static_cast<std::size_t>(t.hinge[i])], state.q), nullptr);
    if (t.turn[i] >= 0 && !state.inner.empty()) angle += t.sense[i] * state.inner[static_cast<std::size_t>(t.turn[i])];
    change += angle * t.per_angle[i];
  }
  return change;
}

std::vector<int> BendingTriangles::blocksOf(const BentTriangle& t, std::span<const FoldHinge> hinges,
                                            const FreeMap& map) const {
  std::vector<int> rows;
  const auto addPoint = [&](int point) { rows.push_back(map.T.columns[static_cast<std::size_t>(point)]); };
  for (const int point : t.corner) addPoint(point);
  for (std::size_t i = 0; i < 3; ++i) {
    if (t.hinge[i] >= 0)
      for (const int point : hinges[static_cast<std::size_t>(t.hinge[i])].corner) addPoint(point);
    if (t.turn[i] >= 0) rows.push_back(map.T.column_count + t.turn[i] / 3);
  }
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  return rows;
}

void BendingTriangles::addStiffness(std::span<const FoldHinge> hinges, const FreeMap& map, const ClothState& state,
                                    const ForceTerms& terms, BlockMatrix& K) const {
  if (!terms.bending) return;
  constexpr int voigt[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
  std::vector<double> moment(hinges.size());  // of each fold
  std::vector<std::vector<double>> rows(3);   // of dkappa, by the components of the blocks
  for (std::size_t k = 0; k < bent_.size(); ++k) {
    const BentTriangle& t = bent_[k];
    const Vec3 change = changeOf(t, hinges, state);
    const BlockLaw law = withTerms(laws_[static_cast<std::size_t>(t.law)], terms);
    const double curvature[3] = {change.x, change.y, change.z};
    Answer<double, 3> answer;
    evaluateBending<with_slope>(law.evaluated(), numbersOf(law), curvature, memoryOf(k, state), answer);
    const std::vector<int> blocks = blocksOf(t, hinges, map);
    for (std::vector<double>& row : rows) row.assign(3 * blocks.size(), 0.0);
    const auto add = [&](int block, int component, double slope, std::size_t edge) {
      const auto at = std::lower_bound(blocks.begin(), blocks.end(), block) - blocks.begin();
      for (int i = 0; i < 3; ++i)
        rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(3 * at + component)] += slope * t.per_angle[edge][i];
    };
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& d = t.per_angle[i];
      const double couple =
          t.area_m2 * (answer.resultant[0] * d.x + answer.resultant[1] * d.y + answer.resultant[2] * d.z);
      if (t.turn[i] >= 0) add(map.T.column_count + t.turn[i] / 3, t.turn[i] % 3, t.sense[i], i);
      if (t.hinge[i] < 0) continue;
      const FoldHinge& h = hinges[static_cast<std::size_t>(t.hinge[i])];
      moment[static_cast<std::size_t>(t.hinge[i])] += 0.5 * couple;
      HingePoints gradient;
      foldAngle(cornersOf(h, state.q), &gradient);
      for (std::size_t c = 0; c < 4; ++c)
        for (int d2 = 0; d2 < 3; ++d2)
          add(map.T.columns[static_cast<std::size_t>(h.corner[c])], d2, 0.5 * gradient[c][d2], i);
    }
    // A sum_ij C_ij dkappa_i dkappa_j.
    std::array<double, 9> block;
    for (std::size_t I = 0; I < blocks.size(); ++I)
      for (std::size_t J = I; J < blocks.size(); ++J) {
        for (std::size_t r = 0; r < 3; ++r)
          for (std::size_t c = 0; c < 3; ++c) {
            double sum = 0;
            for (std::size_t i = 0; i < 3; ++i)
              for (std::size_t j = 0; j < 3; ++j)
                sum += answer.slope[voigt[i][j]] * rows[i][3 * I + r] * rows[j][3 * J + c];
            block[3 * r + c] = t.area_m2 * sum;
          }
        K.add(blocks[I], blocks[J], block);
      }
  }
  std::array<std::array<double, 9>, 16> second;
  std::vector<std::array<double, 9>> of_fold(16);
  for (std::size_t k = 0; k < hinges.size(); ++k) {
    if (moment[k] == 0 || terms.definite) continue;
    foldAngleHessian(cornersOf(hinges[k], state.q), second);
    for (std::size_t i = 0; i < 16; ++i)
      for (std::size_t e = 0; e < 9; ++e) of_fold[i][e] = moment[k] * second[i][e];
    addSymmetrised(map, hinges[k].corner, of_fold, K);
  }
}

}  // namespace gambeson
