#include "core/solid/solid_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"

namespace gambeson {
namespace {

/// Each node moves by itself.
FreeMap ownPoints(int nodes) {
  FreeMap map{identityRows(nodes), identityRows(nodes), std::vector<int>(nodes)};
  std::iota(map.home.begin(), map.home.end(), 0);
  return map;
}

double sizeOf(std::span<const Vec3> v) {
  double sum = 0;
  for (const Vec3& f : v) sum += norm2(f);
  return std::sqrt(sum);
}

std::span<const double> componentsOf(const std::vector<Vec3>& v) {
  return {reinterpret_cast<const double*>(v.data()), 3 * v.size()};
}

std::vector<Program> programsOf(const SolidSupports& supports) {
  if (supports.programs.empty()) return {{{0, 1}, {0, 1}}};
  checkPrograms(supports.programs);
  return supports.programs;
}

}  // namespace

LinearConstraint prescribed(int node, const Vec3& direction, double amount_m, int program) {
  return {{{node, direction}}, amount_m, program, fmt::format("node {}", node)};
}

SolidSystem::SolidSystem(const SolidBody& body, const SolidSupports& supports)
    : body_(body),
      forces_(supports.forces),
      programs_(programsOf(supports)),
      dofs_(buildDofMap(ownPoints(static_cast<int>(body.mesh().nodes.size())), supports.constraints,
                        static_cast<int>(programs_.size()))),
      reduction_(body.sparsity(), dofs_.C),
      K_(body.sparsity()),
      force_(body.mesh().nodes.size()) {
  const int nodes = static_cast<int>(force_.size()), programs = static_cast<int>(programs_.size());
  for (std::size_t k = 0; k < forces_.size(); ++k) {
    const auto reject = [&](const std::string& why) { throw InputError({"", 0, fmt::format("forces[{}]", k)}, why); };
    const NodeForce& f = forces_[k];
    if (f.node < 0 || f.node >= nodes) reject(fmt::format("node {} is not allowed: 0 to {}", f.node, nodes - 1));
    if (f.program < 0 || f.program >= programs)
      reject(fmt::format("program {} is not allowed: 0 to {}", f.program, programs - 1));
    if (!std::isfinite(norm2(f.force_N))) reject("must be finite");
  }
  Vec3 low = body.mesh().nodes.front(), high = low;
  for (const Vec3& x : body.mesh().nodes) {
    for (int d = 0; d < 3; ++d) low[d] = std::min(low[d], x[d]), high[d] = std::max(high[d], x[d]);
    reach_m_ = std::max(reach_m_, norm(x));
  }
  length_m_ = norm(high - low);
  reach_m_ = std::max(reach_m_, length_m_);
}

void SolidSystem::setPrograms(std::vector<Program> programs) {
  if (programs.size() != programs_.size())
    throw InputError({"", 0, "programs"}, fmt::format("{} given, {} expected", programs.size(), programs_.size()));
  checkPrograms(programs);
  programs_ = std::move(programs);
}

std::vector<double> SolidSystem::programValues(double t) const {
  std::vector<double> value;
  for (const Program& p : programs_) value.push_back(p.extended(t));
  return value;
}

std::vector<Vec3> SolidSystem::positions(std::span<const double> y, double t) const {
  std::vector<Vec3> x(force_.size());
  const std::span<double> u(reinterpret_cast<double*>(x.data()), 3 * x.size());
  dofs_.C.multiply<double>(y, u);
  const std::vector<double> value = programValues(t);
  for (std::size_t k = 0; k < value.size(); ++k)
    for (std::size_t i = 0; i < dofs_.shift[k].size(); ++i) u[i] += value[k] * dofs_.shift[k][i];
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += body_.mesh().nodes[i];
  return x;
}

double SolidSystem::balance(std::span<const Vec3> x, double t) {
  energy_J_ = body_.force(x, force_, work_);
  const double internal = sizeOf(force_);
  const std::vector<double> value = programValues(t);
  double external2 = 0;
  for (const NodeForce& f : forces_) {
    const Vec3 force = value[f.program] * f.force_N;
    force_[f.node] -= force;
    external2 += norm2(force);
  }
  return std::max(internal, std::sqrt(external2));
}

double SolidSystem::residual(std::span<const double> y, double t, std::span<double> g) {
  const double size = balance(positions(y, t), t);
  dofs_.Ct.multiply<double>(componentsOf(force_), g);
  return size;
}

void SolidSystem::stiffness(std::span<const double> y, double t, SymmetricMatrix& K, bool /*steepest*/) {
  body_.stiffness(positions(y, t), K_, work_);
  reduction_.reduce(K_, K);
}

void SolidSystem::change(std::span<const double> y, double t0, double t1, std::span<double> dg) {
  std::vector<double> difference = programValues(t1);
  const std::vector<double> before = programValues(t0);
  for (std::size_t k = 0; k < difference.size(); ++k) difference[k] -= before[k];
  std::vector<double> shift(3 * force_.size(), 0.0), force(shift.size());
  for (std::size_t k = 0; k < difference.size(); ++k)
    for (std::size_t i = 0; i < dofs_.shift[k].size(); ++i) shift[i] += difference[k] * dofs_.shift[k][i];
  body_.stiffness(positions(y, t0), K_, work_);
  multiply(K_, shift, force);
  for (const NodeForce& f : forces_)
    for (int d = 0; d < 3; ++d) force[3 * f.node + d] -= difference[f.program] * f.force_N[d];
  dofs_.Ct.multiply<double>(force, dg);
}

std::string SolidSystem::describe(std::span<const double> motion) const {
  std::vector<Vec3> u(force_.size());
  dofs_.C.multiply<double>(motion, {reinterpret_cast<double*>(u.data()), 3 * u.size()});
  std::size_t most = 0;
  for (std::size_t i = 0; i < u.size(); ++i)
    if (norm2(u[i]) > norm2(u[most])) most = i;
  const Vec3 way = normalized(u[most]), at = body_.mesh().nodes[most];
  return fmt::format("node {}, at ({:.4g}, {:.4g}, {:.4g}) m, moves along ({:.2g}, {:.2g}, {:.2g}) without resistance",
                     most, at.x, at.y, at.z, way.x, way.y, way.z);
}

void SolidSystem::mass(bool lumped, SymmetricMatrix& M) {
  body_.mass(lumped, K_);
  reduction_.reduce(K_, M);
}

void SolidSystem::damping(std::span<const double> /*y*/, double /*t*/, bool /*lumped*/, bool /*stiffness_part*/,
                          SymmetricMatrix& D) {
  D.values.assign(sparsity().rows.size(), 0.0);
}

std::vector<Vec3> SolidSystem::reactions(std::span<const double> y, double t) {
  balance(positions(y, t), t);
  return force_;
}

double SolidSystem::energy(std::span<const double> y, double t) {
  balance(positions(y, t), t);
  return energy_J_;
}

}  // namespace gambeson
