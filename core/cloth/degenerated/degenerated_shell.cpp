#include "core/cloth/degenerated/degenerated_shell.hpp"

#include <algorithm>
#include <cmath>

#include "core/cloth/degenerated/degenerated_tangent.hpp"
#include "core/cloth/degenerated/director_mounting.hpp"
#include "core/cloth/draft/fields.hpp"
#include "core/cloth/patches/bilinear.hpp"
#include "core/cloth/patches/cell_stress.hpp"
#include "core/error.hpp"
#include "core/material/fabric_law.hpp"
#include "core/math/parallel.hpp"

namespace gambeson {
namespace {

[[noreturn]] void refuse(const std::string& key, const std::string& why) { throw InputError({"", 0, key}, why); }

void checkFabricOfShell(const Fabric& f) {
  if (const std::string why = whatShellLacks(f); !why.empty()) refuse("model", why);
}

const NodalDraft& checkedForShell(const NodalDraft& draft, const DegeneratedOptions& o) {
  const Garment& g = draft.garment;
  checkBilinear(g, "a degenerated shell");
  checkFabricOfShell(g.fabric);
  for (const Fabric& f : g.other_fabrics) checkFabricOfShell(f);
  if (!(o.shear_factor > 0) || !std::isfinite(o.shear_factor)) refuse("shear_factor", "must be > 0");
  return draft;
}

/// Bent at rest by more than rounding, which a flat sheet is free of stress of.
bool isBent(const CornerVectors& rest) {
  double most = 0;
  for (std::size_t k = 1; k < 4; ++k) most = std::max(most, norm(rest[4 + k] - rest[4]));
  return most > 1e-6;
}

}  // namespace

std::string whatShellLacks(const Fabric& f) {
  return f.energy ? "a degenerated shell has laminas, and this fabric's law is an energy at a point"
         : f.tension_field ? "a degenerated shell carries pressure, and this fabric has a tension field"
                           : "";
}

DegeneratedShell::DegeneratedShell(const NodalDraft& draft, const DegeneratedOptions& options)
    : PatchCloth(checkedForShell(draft, options)),
      kernel_(options.rule),
      directors_(directorsOf(draft.garment)),
      of_points_(points()),
      of_directors_(static_cast<int>(directors_.rest.size())) {
  buildCells(options);
  buildMasses(options);
  for (std::size_t e = 0; e < cells_.size(); ++e)
    for (std::size_t k = 0; k < 4; ++k) {
      of_points_.add(cells_[e].corner[k], static_cast<long>(24 * e + 3 * k), 1);
      of_directors_.add(cells_[e].director[k], static_cast<long>(24 * e + 12 + 3 * k), 1);
    }
  of_points_.close();
  of_directors_.close();
  mounting_ = directorMounting(*this);
}

DegeneratedShell::~DegeneratedShell() = default;

void DegeneratedShell::buildCells(const DegeneratedOptions& options) {
  const ClothState start(rest());
  for (std::size_t p = 0; p < garment().patches.size(); ++p) {
    const NurbsPatch& patch = garment().patches[p];
    const int first = patches()[p].first_point;
    for (int c = 0; c < cellCount(patch); ++c) {
      ShellCell cell;
      cell.patch = static_cast<int>(p);
      const std::array<int, 4> corner = gambeson::cornersOf(patch, c);
      for (std::size_t k = 0; k < 4; ++k) {
        cell.corner[k] = first + corner[k];
        cell.director[k] = directors_.of_point[static_cast<std::size_t>(cell.corner[k])];
      }
      const Vec2 middle = middleOf(patch, c);
      const Fabric fabric = gambeson::fabricAt(garment(), cell.patch, middle);
      cell.law = shellLaw(fabric, options.shear_factor);
      cell.first_history = static_cast<long>(history_doubles_);
      history_doubles_ += kernel_.planePoints() * static_cast<std::size_t>(cell.law.historySize());
      const CornerVectors rest_corners = cornersOf(cell, start);
      cell.law.from_flat = cell.law.from_flat && isBent(rest_corners);
      kernel_.setRest(rest_corners, garment().weft[p], fibreAngleAt(garment(), cell.patch, middle), cell);
      double area = 0;
      for (const ShellPoint& point : cell.points) area += point.area_m2;
      cell.hold_Nm = 0.25 * cell.law.shear_N_per_m * area;
      cells_.push_back(cell);
    }
    first_cell_.push_back(static_cast<int>(cells_.size()));
  }
}

/// lambda ∫ rho N_A² over each cell, lambda so that their sum is its mass (eq. 2.82), by 2 x 2 points.
void DegeneratedShell::buildMasses(const DegeneratedOptions& options) {
  masses_.assign(static_cast<std::size_t>(points()), 0);
  inertias_.assign(directors_.rest.size(), 0);
  const ClothState start(rest());
  for (std::size_t e = 0; e < cells_.size(); ++e) {
    const ShellCell& cell = cells_[e];
    const NurbsPatch& patch = garment().patches[static_cast<std::size_t>(cell.patch)];
    const Vec2 middle = middleOf(patch, static_cast<int>(e) - firstCell(cell.patch));
    const double density = gambeson::surfaceDensityAt(garment(), cell.patch, middle);
    const CornerShares shares = squaredShares(cornersOf(cell, start));
    const double per_mass =
        options.rotary == RotaryInertia::exact ? cell.law.z2_m2 : std::max(cell.law.z2_m2, shares.area_m2 / 12);
    for (std::size_t k = 0; k < 4; ++k) {
      const double mass = density * shares.share[k] * shares.area_m2;
      masses_[static_cast<std::size_t>(cell.corner[k])] += mass;
      inertias_[static_cast<std::size_t>(cell.director[k])] += per_mass * mass;
    }
  }
}

CornerVectors DegeneratedShell::cornersOf(const ShellCell& cell, const ClothState& state) const {
  CornerVectors x;
  for (std::size_t k = 0; k < 4; ++k) {
    x[k] = state.q[static_cast<std::size_t>(cell.corner[k])];
    const auto d = static_cast<std::size_t>(cell.director[k]);
    x[4 + k] = state.inner.empty() ? directors_.rest[d]
                                   : Vec3{state.inner[3 * d], state.inner[3 * d + 1], state.inner[3 * d + 2]};
  }
  return x;
}

CellMemory DegeneratedShell::memoryOf(const ShellCell& cell, const ClothState& state, std::span<double> trial) const {
  return {state.history.empty() ? nullptr : state.history.data() + cell.first_history,
          trial.empty() ? nullptr : trial.data() + cell.first_history, state.elapsed_s};
}

std::vector<HistoryPlace> DegeneratedShell::historyPlaces() const {
  std::vector<HistoryPlace> places;
  for (std::size_t e = 0; e < cells_.size(); ++e) {
    const ShellCell& cell = cells_[e];
    const auto count = static_cast<std::size_t>(cell.law.historySize());
    const NurbsPatch& patch = garment().patches[static_cast<std::size_t>(cell.patch)];
    for (std::size_t i = 0; count > 0 && i < kernel_.planePoints(); ++i) {
      const Natural at = kernel_.table().points[i].at;
      places.push_back(
          {cell.patch,
           placeIn(patch, static_cast<int>(e) - firstCell(cell.patch), {0.5 * (1 + at.xi), 0.5 * (1 + at.eta)}),
           static_cast<std::size_t>(cell.first_history) + i * count, count});
    }
  }
  return places;
}

void DegeneratedShell::force(const ClothState& state, const ClothForce& out, ClothWork& work,
                             const ForceTerms& terms) const {
  const int n = static_cast<int>(cells_.size());
  work.slots.resize(24 * cells_.size());
  if (out.energy) {
    work.lane_energy.assign(cells_.size(), 0.0);
    work.lane_lost.assign(cells_.size(), 0.0);
  }
  forAll(Each::element, n, [&](int i) {
    const auto e = static_cast<std::size_t>(i);
    const CornerVectors now = cornersOf(cells_[e], state);
    CornerVectors gradient{};
    const ClothEnergy energy =
        kernel_.gradient(cells_[e], now, memoryOf(cells_[e], state, out.history), terms, gradient);
    for (std::size_t k = 0; k < 8; ++k) {
      // What turns a director: d x g.
      const Vec3 slot = k < 4 ? gradient[k] : cross(now[k], gradient[k]);
      for (int axis = 0; axis < 3; ++axis) work.slots[24 * e + 3 * k + static_cast<std::size_t>(axis)] = slot[axis];
    }
    if (!out.energy) return;
    work.lane_energy[e] = energy.stored;
    work.lane_lost[e] = energy.lost;
  });
  of_points_.negativeSum(work.slots.data(), out.points);
  if (!out.inner.empty())
    of_directors_.negativeSum(work.slots.data(), {reinterpret_cast<Vec3*>(out.inner.data()), directors_.rest.size()});
  if (!out.energy) return;
  *out.energy = {};
  for (const double e : work.lane_energy) out.energy->stored += e;
  for (const double e : work.lane_lost) out.energy->lost += e;
}

std::unique_ptr<ClothTangent> DegeneratedShell::tangent() const { return degeneratedTangent(*this); }

void DegeneratedShell::startInner(std::span<double> value) const {
  for (std::size_t k = 0; k < value.size(); ++k) value[k] = directors_.rest[k / 3][static_cast<int>(k % 3)];
}

void DegeneratedShell::innerMasses(std::span<double> mass) const {
  for (std::size_t k = 0; k < mass.size(); ++k) mass[k] = inertias_[k / 3];
}

void DegeneratedShell::advance(std::span<const double> value, std::span<const double> rate, double dt_s,
                               std::span<double> out) const {
  for (std::size_t k = 0; k < out.size(); k += 3) {
    const Vec3 d = turned({value[k], value[k + 1], value[k + 2]}, dt_s * Vec3{rate[k], rate[k + 1], rate[k + 2]});
    out[k] = d.x, out[k + 1] = d.y, out[k + 2] = d.z;
  }
}

void DegeneratedShell::dropIdle(std::span<const double> value, std::span<double> rate) const {
  for (std::size_t k = 0; k < rate.size(); k += 3) {
    const double about = rate[k] * value[k] + rate[k + 1] * value[k + 1] + rate[k + 2] * value[k + 2];
    for (std::size_t i = k; i < k + 3; ++i) rate[i] -= about * value[i];
  }
}

std::unique_ptr<StressView> DegeneratedShell::stress() const {
  return std::make_unique<CellStress>(*this, first_cell_, [this](const ClothState& state, int, int cell) {
    return stateIn(cells_[static_cast<std::size_t>(cell)], state, {0.5, 0.5});
  });
}

PointState DegeneratedShell::stateIn(const ShellCell& cell, const ClothState& state, Vec2 within, bool total) const {
  const NurbsPatch& patch = garment().patches[static_cast<std::size_t>(cell.patch)];
  const int own = static_cast<int>(&cell - cells_.data()) - firstCell(cell.patch);
  return kernel_.at(cell, cornersOf(cell, ClothState(rest())), cornersOf(cell, state), memoryOf(cell, state),
                    garment().weft[static_cast<std::size_t>(cell.patch)],
                    fibreAngleAt(garment(), cell.patch, middleOf(patch, own)), {2 * within.x - 1, 2 * within.y - 1},
                    total);
}

PointState DegeneratedShell::stateAt(const ClothState& state, int patch, Vec2 uv) const {
  const NurbsPatch& p = garment().patches[static_cast<std::size_t>(patch)];
  const int cell = cellsAt(p, uv).front();
  return stateIn(cells_[static_cast<std::size_t>(firstCell(patch) + cell)], state, withinCell(p, cell, uv));
}

double DegeneratedShell::bendAt(const ClothState& state, int patch, Vec2 uv) const {
  const NurbsPatch& p = garment().patches[static_cast<std::size_t>(patch)];
  const int cell = cellsAt(p, uv).front();
  const Vec3 k =
      stateIn(cells_[static_cast<std::size_t>(firstCell(patch) + cell)], state, withinCell(p, cell, uv), true)
          .curvature_change;
  return std::sqrt(k.x * k.x + k.y * k.y + 0.5 * k.z * k.z);
}

bool DegeneratedShell::springsAtRest(double length_m) const {
  for (const ShellCell& cell : cells_) {
    if (!cell.law.from_flat) continue;
    const Vec3 k = stateIn(cell, ClothState(rest()), {0.5, 0.5}, true).curvature_change;
    if (std::max({std::abs(k.x), std::abs(k.y), 0.5 * std::abs(k.z)}) * length_m > 1e-6) return true;
  }
  return false;
}

std::vector<std::pair<int, Vec2>> DegeneratedShell::lawPlaces() const { return cellMiddles(garment()); }

}  // namespace gambeson
