#include "core/solid/solid_contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "core/math/parallel.hpp"

namespace gambeson {
namespace {

[[noreturn]] void reject(const char* key, double value, const char* allowed) {
  throw InputError({"", 0, key}, fmt::format("{} is not allowed: {}", value, allowed));
}

void checkLaw(const SolidContactLaw& law) {
  if (!(law.normal_Pa_per_m > 0) || !std::isfinite(law.normal_Pa_per_m))
    reject("normal_Pa_per_m", law.normal_Pa_per_m, "> 0");
  if (!(law.friction >= 0) || !std::isfinite(law.friction)) reject("friction", law.friction, ">= 0");
  if (law.friction > 0 && (!(law.tangential_Pa_per_m > 0) || !std::isfinite(law.tangential_Pa_per_m)))
    reject("tangential_Pa_per_m", law.tangential_Pa_per_m, "> 0");
  if (!(law.touch.reach_m > 0) || !std::isfinite(law.touch.reach_m)) reject("reach_m", law.touch.reach_m, "> 0");
  if (!(law.touch.groove_rad > 0 && law.touch.groove_rad < std::numbers::pi))
    reject("groove_rad", law.touch.groove_rad, "0 to pi, both excluded");
  if (!(law.touch.keep >= 0 && law.touch.keep <= 1)) reject("keep", law.touch.keep, "0 to 1");
}

void checkSide(const ContactSide& side, int nodes) {
  const auto refuse = [](const std::string& key, const std::string& why) { throw InputError({"", 0, key}, why); };
  if (side.areas_m2.size() != side.nodes.size())
    refuse("areas_m2", fmt::format("{} given, {} expected", side.areas_m2.size(), side.nodes.size()));
  checkFacets(side.surface.facets(), nodes);
  const std::vector<int>& masters = side.surface.nodes();
  for (std::size_t k = 0; k < side.nodes.size(); ++k) {
    const int node = side.nodes[k];
    if (node < 0 || node >= nodes) refuse("nodes", fmt::format("{} is not allowed: 0 to {}", node, nodes - 1));
    if (std::binary_search(masters.begin(), masters.end(), node))
      refuse("nodes", fmt::format("{} is a corner of the facets that it must not pass", node));
    if (!(side.areas_m2[k] > 0) || !std::isfinite(side.areas_m2[k]))
      refuse("areas_m2", fmt::format("{} is not allowed: > 0", side.areas_m2[k]));
  }
}

void addForces(const std::array<int, 5>& nodes, double factor, const ProjectionSlope& slope, std::span<Vec3> f) {
  for (int k = 0; k < 5; ++k) f[nodes[k]] += factor * Vec3{slope[3 * k], slope[3 * k + 1], slope[3 * k + 2]};
}

void addProduct(double factor, const ProjectionSlope& row, const ProjectionSlope& column, ProjectionMatrix& K) {
  for (int i = 0; i < kProjectionSize; ++i)
    for (int j = 0; j < kProjectionSize; ++j) K[kProjectionSize * i + j] += factor * row[i] * column[j];
}

}  // namespace

double sizeOfTraction(const Vec2& t, const std::array<double, 3>& M) {
  const double det = M[0] * M[1] - M[2] * M[2];
  return std::sqrt((M[1] * t.x * t.x + M[0] * t.y * t.y - 2 * M[2] * t.x * t.y) / det);
}

ContactSide contactSide(std::span<const Facet> of_nodes, const FacetSurface& against, std::span<const Vec3> rest,
                        double share) {
  ContactSide side;
  side.nodes = FacetSurface({of_nodes.begin(), of_nodes.end()}, static_cast<int>(rest.size())).nodes();
  const std::vector<double> area = nodeAreas(of_nodes, rest);
  for (const int node : side.nodes) side.areas_m2.push_back(share * area[node]);
  side.surface = against;
  return side;
}

std::vector<int> matchTouches(std::span<const FacetTouch> touches, std::span<const ContactMultipliers> multipliers) {
  std::vector<int> of(touches.size(), -1);
  std::vector<char> taken(multipliers.size(), 0);
  for (std::size_t t = 0; t < touches.size(); ++t)
    for (std::size_t m = 0; m < multipliers.size(); ++m)
      if (multipliers[m].facet == touches[t].facet) of[t] = static_cast<int>(m), taken[m] = 1;
  std::size_t next = 0;
  for (int& m : of) {
    if (m >= 0) continue;
    while (next < multipliers.size() && taken[next]) ++next;
    if (next < multipliers.size()) m = static_cast<int>(next++);
  }
  return of;
}

SolidContact::SolidContact(std::vector<ContactSide> sides, const SolidContactLaw& law, std::vector<Vec3> rest)
    : sides_(std::move(sides)), law_(law), rest_(std::move(rest)), first_slave_{0} {
  checkLaw(law_);
  for (const ContactSide& side : sides_) {
    checkSide(side, static_cast<int>(rest_.size()));
    first_slave_.push_back(first_slave_.back() + static_cast<int>(side.nodes.size()));
  }
}

std::array<int, 5> SolidContact::nodesOf(int side, int node, int facet) const {
  const Facet& f = sides_[side].surface.facets()[facet];
  return {node, f[0], f[1], f[2], f[3]};
}

void SolidContact::rub(std::span<const Vec3> x, std::span<const Vec3> start, ContactPoint& p,
                       const ContactMultipliers* multipliers) const {
  p.bound_Pa = law_.friction * (law_.bound == FrictionBound::coupled ? p.pressure_Pa : p.multiplier_Pa);
  if (!(p.bound_Pa > 0)) return;
  p.rubs = true;
  p.rub_facet = multipliers ? multipliers->rub_facet : p.facet;
  const FacetCorners now = cornersOf(p.side, p.rub_facet, x), before = cornersOf(p.side, p.rub_facet, start);
  const std::optional<Vec2> local = projectOnFacet(now, x[p.node], kFacetReach),
                            local0 = projectOnFacet(before, start[p.node], kFacetReach);
  if (!local || !local0) {
    p.pressure_Pa = std::numeric_limits<double>::quiet_NaN();
    return;
  }
  p.rub_over = projectionOf(now, x[p.node], *local);
  const std::array<Vec3, 2> T = facetTangents(cornersOf(p.side, p.rub_facet, rest_), *local0);
  p.metric_m2 = {norm2(T[0]), norm2(T[1]), dot(T[0], T[1])};
  const Vec2 slid{local->x - local0->x, local->y - local0->y};
  if (multipliers) p.multiplier_N_per_m = multipliers->traction_N_per_m;
  const std::array<double, 3>& M = p.metric_m2;
  p.trial_N_per_m = {p.multiplier_N_per_m.x + law_.tangential_Pa_per_m * (M[0] * slid.x + M[2] * slid.y),
                     p.multiplier_N_per_m.y + law_.tangential_Pa_per_m * (M[2] * slid.x + M[1] * slid.y)};
  p.trial_Pa = sizeOfTraction(p.trial_N_per_m, p.metric_m2);
  p.slips = p.trial_Pa > p.bound_Pa;
  const double kept = p.slips ? p.bound_Pa / p.trial_Pa : 1;
  p.traction_N_per_m = {kept * p.trial_N_per_m.x, kept * p.trial_N_per_m.y};
}

std::vector<ContactPoint> SolidContact::points(std::span<const Vec3> x, std::span<const Vec3> start,
                                               std::span<const ContactMultipliers> multipliers, bool all) const {
  std::vector<FacetSurface::Spheres> spheres;
  for (const ContactSide& side : sides_) spheres.push_back(side.surface.spheres(x));
  std::vector<std::vector<ContactMultipliers>> of_slave(first_slave_.back());
  for (const ContactMultipliers& m : multipliers) of_slave[first_slave_[m.side] + m.slave].push_back(m);
  std::vector<std::vector<ContactPoint>> found(of_slave.size());
  for (int s = 0; s < static_cast<int>(sides_.size()); ++s) {
    const ContactSide& side = sides_[s];
    forAll(Each::much, static_cast<int>(side.nodes.size()), [&](int slave) {
      const int node = side.nodes[slave];
      const std::vector<ContactMultipliers>& own = of_slave[first_slave_[s] + slave];
      std::vector<int> held;
      for (const ContactMultipliers& m : own) held.push_back(m.facet);
      const std::vector<FacetTouch> touches = side.surface.touching(x, spheres[s], x[node], law_.touch, held);
      const std::vector<int> match = matchTouches(touches, own);
      for (std::size_t t = 0; t < touches.size(); ++t) {
        const ContactMultipliers* m = match[t] >= 0 ? &own[match[t]] : nullptr;
        ContactPoint p;
        p.side = s, p.slave = slave, p.node = node, p.facet = touches[t].facet;
        p.area_m2 = side.areas_m2[slave];
        p.known = m != nullptr;
        p.multiplier_Pa = m ? m->pressure_Pa : 0;
        p.pressure_Pa = std::max(0.0, p.multiplier_Pa + law_.normal_Pa_per_m * touches[t].gap_m);
        if (law_.friction > 0 && (p.pressure_Pa > 0 || p.multiplier_Pa > 0)) rub(x, start, p, m);
        if (!all && p.pressure_Pa == 0 && !p.rubs) continue;
        p.over = projectionOf(side.surface.corners(p.facet, x), x[node], touches[t].local);
        found[first_slave_[s] + slave].push_back(p);
      }
    });
  }
  std::vector<ContactPoint> points;
  for (const std::vector<ContactPoint>& list : found) points.insert(points.end(), list.begin(), list.end());
  return points;
}

void SolidContact::addForce(std::span<const ContactPoint> points, std::span<Vec3> f) const {
  for (const ContactPoint& p : points) {
    addForces(nodesOf(p.side, p.node, p.facet), p.area_m2 * p.pressure_Pa, p.over.gap_slope, f);
    if (!p.rubs) continue;
    const std::array<int, 5> nodes = nodesOf(p.side, p.node, p.rub_facet);
    addForces(nodes, p.area_m2 * p.traction_N_per_m.x, p.rub_over.local_slope[0], f);
    addForces(nodes, p.area_m2 * p.traction_N_per_m.y, p.rub_over.local_slope[1], f);
  }
}

double SolidContact::energy(std::span<const ContactPoint> points) const {
  double sum = 0;
  for (const ContactPoint& p : points)
    sum += p.area_m2 * (p.pressure_Pa * p.pressure_Pa - p.multiplier_Pa * p.multiplier_Pa) / (2 * law_.normal_Pa_per_m);
  return sum;
}

double SolidContact::lost(std::span<const ContactPoint> points) const {
  double sum = 0;
  for (const ContactPoint& p : points)
    if (p.rubs && p.slips) sum += p.area_m2 * p.bound_Pa * (p.trial_Pa - p.bound_Pa) / law_.tangential_Pa_per_m;
  return sum;
}

double SolidContact::held(std::span<const ContactPoint> points) const {
  double sum = 0;
  for (const ContactPoint& p : points)
    if (p.rubs) sum += p.area_m2 * p.tractionSize() * p.tractionSize() / (2 * law_.tangential_Pa_per_m);
  return sum;
}

std::vector<ContactBlock> SolidContact::tangent(std::span<const Vec3> x, std::span<const ContactPoint> points) const {
  std::vector<ContactBlock> blocks;
  for (const ContactPoint& p : points) {
    const std::array<int, 5> pushed = nodesOf(p.side, p.node, p.facet);
    if (p.pressure_Pa > 0) {
      ContactBlock& b = blocks.emplace_back(ContactBlock{pushed, pushed});
      addProduct(p.area_m2 * law_.normal_Pa_per_m, p.over.gap_slope, p.over.gap_slope, b.values);
      addGapCurvature(cornersOf(p.side, p.facet, x), x[p.node], p.over, p.area_m2 * p.pressure_Pa, b.values);
    }
    if (!p.rubs) continue;
    const std::array<int, 5> rubbed = nodesOf(p.side, p.node, p.rub_facet);
    ContactBlock& b = blocks.emplace_back(ContactBlock{rubbed, rubbed});
    const double M[2][2] = {{p.metric_m2[0], p.metric_m2[2]}, {p.metric_m2[2], p.metric_m2[1]}};
    const double way[2] = {p.trial_N_per_m.x / p.trial_Pa, p.trial_N_per_m.y / p.trial_Pa};
    for (int a = 0; a < 2; ++a)
      for (int c = 0; c < 2; ++c) {
        const double slope = p.slips ? p.bound_Pa / p.trial_Pa * (M[a][c] - way[a] * way[c]) : M[a][c];
        addProduct(p.area_m2 * law_.tangential_Pa_per_m * slope, p.rub_over.local_slope[a], p.rub_over.local_slope[c],
                   b.values);
      }
    addLocalCurvature(cornersOf(p.side, p.rub_facet, x), x[p.node], p.rub_over,
                      {p.area_m2 * p.traction_N_per_m.x, p.area_m2 * p.traction_N_per_m.y}, b.values);
    if (law_.bound == FrictionBound::coupled && p.slips) {
      ContactBlock& mixed = blocks.emplace_back(ContactBlock{rubbed, pushed});
      for (int a = 0; a < 2; ++a)
        addProduct(p.area_m2 * law_.friction * law_.normal_Pa_per_m * way[a], p.rub_over.local_slope[a],
                   p.over.gap_slope, mixed.values);
    }
  }
  return blocks;
}

std::vector<ContactMultipliers> SolidContact::augmented(std::span<const ContactPoint> points) const {
  std::vector<ContactMultipliers> multipliers;
  for (const ContactPoint& p : points) {
    if (!(p.pressure_Pa > 0)) continue;
    ContactMultipliers m{p.side, p.slave, p.facet, p.rubs ? p.rub_facet : p.facet, p.pressure_Pa, {}};
    if (p.rubs) {
      const double bound = law_.friction * p.pressure_Pa;
      const double kept = p.trial_Pa > bound ? bound / p.trial_Pa : 1;
      m.traction_N_per_m = {kept * p.trial_N_per_m.x, kept * p.trial_N_per_m.y};
    }
    multipliers.push_back(m);
  }
  return multipliers;
}

int SolidContact::moveOn(std::span<const Vec3> x, std::vector<ContactMultipliers>& multipliers, bool share) const {
  std::vector<FacetSurface::Spheres> spheres;
  for (const ContactSide& side : sides_) spheres.push_back(side.surface.spheres(x));
  std::vector<std::vector<ContactMultipliers>> of_slave(first_slave_.back());
  for (const ContactMultipliers& m : multipliers) of_slave[first_slave_[m.side] + m.slave].push_back(m);
  std::vector<char> changed(of_slave.size(), 0);
  forAll(Each::much, static_cast<int>(of_slave.size()), [&](int k) {
    std::vector<ContactMultipliers>& own = of_slave[k];
    if (own.empty()) return;
    const ContactSide& side = sides_[own[0].side];
    const int foremost = own[0].facet;
    const auto touches = side.surface.touching(x, spheres[own[0].side], x[side.nodes[own[0].slave]], law_.touch,
                                               {&foremost, 1}, HeldFacet::goes_on);
    const auto on = [&](int facet) {
      return std::find_if(own.begin(), own.end(), [&](const ContactMultipliers& m) { return m.facet == facet; });
    };
    for (std::size_t t = 0; t < touches.size(); ++t) {
      const int facet = touches[t].facet;
      if (t == 0 && facet != foremost) {
        changed[k] = 1;
        if (const auto other = on(facet); other != own.end()) {
          other->pressure_Pa += own[0].pressure_Pa;
          own.erase(own.begin());
        } else {
          own[0].facet = facet;
        }
      } else if (share && on(facet) == own.end()) {
        changed[k] = 1;
        own.push_back({own[0].side, own[0].slave, facet, facet, 0, {}});
      }
    }
    for (; !share && own.size() > 1; own.pop_back()) {
      changed[k] = 1;
      own[0].pressure_Pa += own.back().pressure_Pa;
    }
  });
  multipliers.clear();
  for (const std::vector<ContactMultipliers>& own : of_slave)
    multipliers.insert(multipliers.end(), own.begin(), own.end());
  return static_cast<int>(std::count(changed.begin(), changed.end(), 1));
}

std::vector<ContactMultipliers> SolidContact::settled(std::span<const Vec3> x,
                                                      std::vector<ContactMultipliers> multipliers) const {
  for (ContactMultipliers& m : multipliers) {
    if (m.rub_facet == m.facet) continue;
    const Vec3& p = x[sides_[m.side].nodes[m.slave]];
    const auto frame = [&](int facet) {
      const std::optional<Vec2> local = projectOnFacet(cornersOf(m.side, facet, x), p, kFacetReach);
      assert(local);  // the node rubbed there
      return facetTangents(cornersOf(m.side, facet, rest_), *local);
    };
    const std::array<Vec3, 2> from = frame(m.rub_facet), to = frame(m.facet);
    const double a = norm2(from[0]), c = norm2(from[1]), b = dot(from[0], from[1]), det = a * c - b * b;
    const Vec2 t = m.traction_N_per_m;
    const Vec3 traction = ((c * t.x - b * t.y) / det) * from[0] + ((a * t.y - b * t.x) / det) * from[1];
    m.traction_N_per_m = {dot(traction, to[0]), dot(traction, to[1])};
    m.rub_facet = m.facet;
  }
  return multipliers;
}

}  // namespace gambeson
