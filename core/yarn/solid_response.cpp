#include "core/yarn/solid_response.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/solid/contact_system.hpp"

namespace gambeson {
namespace {

using Column = std::vector<double>;

/// What a motion of all nodes meets in the state: the tangent of the yarns and of what presses.
class Linearised {
 public:
  Linearised(const SolidCell& cell, const SolidCellState& state, SolidCellWork& work, SolidContactMethod method)
      : cell_(cell),
        x_(state.x),
        system_(work.system),
        factor_(work.solver),
        held_(method != SolidContactMethod::penalty) {
    system_.setPrograms(cell.programs(state.load, state.load));
    std::vector<ContactMultipliers> multipliers = state.multipliers;
    if (!held_)
      for (ContactMultipliers& m : multipliers) m.pressure_Pa = 0;
    ContactSystem contact(system_, cell.contact(), work.solver, 1, state.x);
    const Column y = state.y.empty() ? contactStart(system_).y : state.y;
    for (const ContactPoint& p : contact.points(multipliers, y))
      if (p.pressure_Pa > 0) points_.push_back(p), points_.back().rubs = false;
    blocks_ = cell.contact().tangent(x_, points_);
    SolidWork scratch;
    K_ = cell.body().sparsity();
    cell.body().stiffness(x_, K_, scratch);
    if (!factor_.factorise(contact.tangentOf(points_, y), system_.size(), true, kSolidCellRaise))
      throw RunError("the tangent of the cell of solids is singular");
  }

  /// The forces on all nodes that follow where supports move by `moved`, the yarns staying in equilibrium.
  Column forces(const Column& moved) const {
    constexpr int kIterations = 200;
    constexpr double kSettled = 1e-10;
    const SparseRows &C = system_.dofs().C, &Ct = system_.dofs().Ct;
    Column x = moved, force(x.size()), r(C.column_count), dy(r.size()), back(x.size());
    std::vector<double> pressure(points_.size(), 0.0);
    double first = 0;
    for (int k = 0; k < kIterations; ++k) {
      multiply(K_, x, force);
      press(x, pressure, force);
      Ct.multiply<double>(force, r);
      const double size = norm(r);
      if (k == 0) first = size;
      if (size <= kSettled * first) return force;
      factor_.solve(r, dy);
      C.multiply<double>(dy, back);
      for (std::size_t i = 0; i < x.size(); ++i) x[i] -= back[i];
      if (!held_) continue;
      for (std::size_t p = 0; p < points_.size(); ++p)
        pressure[p] += cell_.contact().law().normal_Pa_per_m * gapRate(points_[p], x);
    }
    throw RunError("what touches in the cell of solids does not settle under a change of the load");
  }

 private:
  std::array<int, 5> nodesOf(const ContactPoint& p) const { return cell_.contact().nodesOf(p.side, p.node, p.facet); }

  double gapRate(const ContactPoint& p, const Column& x) const {
    const std::array<int, 5> nodes = nodesOf(p);
    double rate = 0;
    for (int i = 0; i < kProjectionSize; ++i) rate += p.over.gap_slope[i] * x[3 * nodes[i / 3] + i % 3];
    return rate;
  }

  /// Adds what touches: the tangent's forces and those of changed multipliers.
  void press(const Column& x, std::span<const double> pressure, Column& force) const {
    for (const ContactBlock& b : blocks_)
      for (int i = 0; i < kProjectionSize; ++i)
        for (int j = 0; j < kProjectionSize; ++j)
          force[3 * b.rows[i / 3] + i % 3] += b.values[kProjectionSize * i + j] * x[3 * b.columns[j / 3] + j % 3];
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const std::array<int, 5> nodes = nodesOf(points_[k]);
      for (int i = 0; i < kProjectionSize; ++i)
        force[3 * nodes[i / 3] + i % 3] += points_[k].area_m2 * pressure[k] * points_[k].over.gap_slope[i];
    }
  }

  const SolidCell& cell_;
  std::span<const Vec3> x_;
  SolidSystem& system_;
  TangentSolver& factor_;
  bool held_;
  std::vector<ContactPoint> points_;
  std::vector<ContactBlock> blocks_;
  BlockMatrix K_;
};

std::array<double, 9> tangentOf(const SolidCell& cell, const SolidCellState& state, SolidCellWork& work,
                                SolidContactMethod method) {
  const Linearised linear(cell, state, work, method);
  const std::array<FaceMotion, 4> motions = faceMotions(cell.yarns(), state.load);
  std::vector<Vec3> force(state.x.size());
  std::array<double, 9> D{};
  for (int e = 0; e < 3; ++e) {
    const std::vector<double> rates = cell.programRates(motions[e].dt_m);
    Column moved(3 * state.x.size(), 0.0);
    for (std::size_t k = 0; k < rates.size(); ++k) {
      const std::vector<double>& shift = work.system.dofs().shift[k];
      for (std::size_t i = 0; i < shift.size(); ++i) moved[i] += rates[k] * shift[i];
    }
    const Column f = linear.forces(moved);
    for (std::size_t i = 0; i < force.size(); ++i) force[i] = {f[3 * i], f[3 * i + 1], f[3 * i + 2]};
    const std::array<Vec3, 2> carried = cell.faceForces(force);
    for (int d = 0; d < 3; ++d)
      for (int g = 0; g < 2; ++g) D[3 * d + e] += dot(carried[g], motions[d].dt_m[g]) / cell.area_m2();
  }
  SolidWork scratch;
  cell.body().force(state.x, force, scratch);
  cell.contact().addForce(state.points, force);
  const std::array<Vec3, 2> carried = cell.faceForces(force);
  const auto second = faceCurvature(cell.yarns(), state.load);
  constexpr int pairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
  for (int v = 0; v < 6; ++v)
    for (int g = 0; g < 2; ++g) {
      const double turn = dot(carried[g], second[v][g]) / cell.area_m2();
      D[3 * pairs[v][0] + pairs[v][1]] += turn;
      if (v > 2) D[3 * pairs[v][1] + pairs[v][0]] += turn;
    }
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < i; ++j) D[3 * i + j] = D[3 * j + i] = 0.5 * (D[3 * i + j] + D[3 * j + i]);
  return D;
}

}  // namespace

CellResultants resultantsOf(const SolidCell& cell, const SolidCellState& state) {
  SolidWork work;
  std::vector<Vec3> force(state.x.size());
  const double stored = cell.body().force(state.x, force, work);
  cell.contact().addForce(state.points, force);
  const std::array<Vec3, 2> carried = cell.faceForces(force);
  const std::array<FaceMotion, 4> motions = faceMotions(cell.yarns(), state.load);
  std::array<double, 3> n{};
  for (int e = 0; e < 3; ++e)
    for (int g = 0; g < 2; ++g) n[e] += dot(carried[g], motions[e].dt_m[g]) / cell.area_m2();
  return {(stored + cell.contact().energy(state.points)) / cell.area_m2(), n[0], n[1], n[2], 0};
}

std::array<double, 3> stressOf(const SolidCell& cell, const CellResultants& n) {
  const double height = cell.height_m();
  return {n.n11 / height, n.n22 / height, n.n12 / height};
}

std::array<double, 9> membraneTangent(const SolidCell& cell, const SolidCellState& state, SolidCellWork& work,
                                      SolidContactMethod method) {
  if (std::any_of(state.points.begin(), state.points.end(), [](const ContactPoint& p) { return p.rubs; }))
    throw RunError("the tangent of a cell of solids is of yarns without friction");
  return tangentOf(cell, state, work, method);
}

SolidLoadReport freeAcross(const SolidCell& cell, SolidCellState& state, SolidCellWork& work, double tolerance,
                           const SolidLoadOptions& options, YarnDirection pulled, const SolidCellState* from) {
  constexpr int kIterations = 30;
  constexpr double kLongest = 0.02, kRounding = 1e-13;  // of the strain across
  const int free = 1 - pulled;
  const auto across = [&](CellLoad& load) -> double& { return free == along_warp ? load.e22 : load.e11; };
  SolidLoadReport report;
  report.reached = true;
  double slope = 0, before = NAN, changed = 0;
  for (int k = 0; k < kIterations; ++k) {
    const CellResultants n = resultantsOf(cell, state);
    const double carried = free == along_warp ? n.n22 : n.n11, along = free == along_warp ? n.n11 : n.n22;
    if (std::abs(carried) <= tolerance * (std::abs(along) + std::abs(n.n12))) return report;
    // What rubs is no part of the tangent: the secant is better.
    if (!from || std::isnan(before)) {
      slope = std::abs(tangentOf(cell, state, work, options.method)[4 * free]);
    } else if ((carried - before) * changed > 0) {
      slope = (carried - before) / changed;
    }
    if (std::abs(carried) <= kRounding * slope) return report;
    before = carried;
    CellLoad next = state.load;
    changed = -std::clamp(carried / slope, -kLongest, kLongest);
    across(next) += changed;
    if (from) state = *from;
    report.add(changeLoad(cell, next, state, work, options));
    if (!report.reached) return report;
  }
  report.reached = false;
  report.why = "the stress across does not vanish within the iterations";
  return report;
}

}  // namespace gambeson
