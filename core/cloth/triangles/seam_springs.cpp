#include "core/cloth/triangles/seam_springs.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/cloth/draft/hinge.hpp"
#include "core/cloth/free_blocks.hpp"

namespace gambeson {
namespace {

constexpr double kHeightsOfStill = 0.5, kHeightsOfTurning = 0.1;  // of a triangle: cloth that bends with the spring

/// A triangle at the edge of a seam, at rest and in the basis of its threads.
struct SeamSide {
  std::size_t apex = 0;          ///< the corner off the edge
  std::array<double, 3> into{};  ///< the derivative across the edge, into the triangle, by its corners [1/m]
  double height_m = 0, length_m = 0;
  Vec2 across;           ///< the unit vector of that direction
  bool forward = false;  ///< its corners run along the edge in the seam's sense
};

SeamSide sideOf(const MembraneTriangle& t, const std::array<int, 2>& edge) {
  const Vec2 g[3] = {{-t.g[0].x - t.g[1].x, -t.g[0].y - t.g[1].y}, t.g[0], t.g[1]};
  SeamSide side;
  while (t.corner[side.apex] == edge[0] || t.corner[side.apex] == edge[1]) ++side.apex;
  const Vec2& up = g[side.apex];
  const double slope = std::hypot(up.x, up.y);
  side.across = {up.x / slope, up.y / slope};
  for (std::size_t k = 0; k < 3; ++k) side.into[k] = side.across.x * g[k].x + side.across.y * g[k].y;
  side.height_m = 1 / slope;
  side.length_m = 2 * t.area_m2 * slope;
  side.forward = t.corner[(side.apex + 1) % 3] == edge[0];
  return side;
}

/// n . D n, n the direction tensor of a unit vector; D in Voigt's order 11 22 33 12 13 23.
double rigidityAlong(Vec2 n, std::span<const double, 6> D) {
  const double x = n.x * n.x, y = n.y * n.y, z = 2 * n.x * n.y;
  return x * (D[0] * x + D[3] * y + D[4] * z) + y * (D[3] * x + D[1] * y + D[5] * z) +
         z * (D[4] * x + D[5] * y + D[2] * z);
}

/// theta less what the seam would turn by at rest, and, where `gradient` is not null, by points.
double turnOf(const SeamHinge& h, const ClothState& state, std::vector<Vec3>* gradient) {
  double turn = hingeAngle(h.points, state.q, gradient) - h.points.theta0;
  for (std::size_t side = 0; side < 2; ++side)
    if (h.turn[side] >= 0 && !state.inner.empty())
      turn -= h.sense[side] * state.inner[static_cast<std::size_t>(h.turn[side])];
  return turn;
}

}  // namespace

SeamSprings::SeamSprings(std::span<const SeamSpring> springs, std::span<const MembraneTriangle> triangles,
                         std::span<const BlockLaw> laws, BendingTriangles& bending, int lanes, long first_slot,
                         SlotGather& gather)
    : first_slot_(first_slot) {
  for (const SeamSpring& s : springs) {
    SeamHinge hinge;
    std::map<int, std::array<double, 3>> row;  // along, into a, into b
    double compliance = 1 / s.stiffness_N, length = 0;
    std::array<double, 2> own{};  // of the sides' unknowns [N m]
    for (std::size_t which = 0; which < 2; ++which) {
      const MembraneTriangle& t = triangles[static_cast<std::size_t>(s.triangle[which])];
      const SeamSide side = sideOf(t, s.edge[which]);
      for (std::size_t k = 0; k < 3; ++k) row[t.corner[k]][1 + which] += side.into[k];
      row[s.edge[which][0]][0] -= 0.5;
      row[s.edge[which][1]][0] += 0.5;
      length += 0.5 * side.length_m;
      if (const int bent = bending.bentOf(s.triangle[which]); bent >= 0)
        hinge.turn[which] = bending.triangles()[static_cast<std::size_t>(bent)].turn[side.apex];
      // hingeAngle counts the fold to the other side where the triangle a lies to the left of the edge.
      hinge.sense[which] = side.forward == (which == 0) ? -1 : 1;
      const double rigidity = rigidityAlong(side.across, laws[static_cast<std::size_t>(t.law)].point.section.D);
      // Without bound where there is none.
      compliance +=
          (hinge.turn[which] < 0 ? kHeightsOfStill : kHeightsOfTurning) * side.height_m / std::max(rigidity, 0.0);
      own[which] = 2 * rigidity * side.length_m / side.height_m;  // A D (2/h)^2
    }
    if (!std::isfinite(compliance)) continue;
    for (const auto& [point, r] : row) {
      gather.add(point, first_slot_ + slots_, 1);
      slots_ += 3;
      hinge.points.columns.push_back(point);
      hinge.points.t.push_back(r[0]), hinge.points.a.push_back(r[1]), hinge.points.b.push_back(r[2]);
    }
    hinge.points.stiffness_length = length / compliance;
    hinge.points.theta0 = s.rest_angle_rad;
    for (std::size_t which = 0; which < 2; ++which)
      if (hinge.turn[which] >= 0)
        bending.makeHeavier(hinge.turn[which], 1 + hinge.points.stiffness_length / own[which]);
    hinges_.push_back(std::move(hinge));
  }
  slots_ = (slots_ + lanes - 1) / lanes * lanes;
}

void SeamSprings::force(const ClothState& state, const ClothForce& out, const ForceTerms& terms, double* slots) const {
  double* slot = slots + first_slot_;
  if (!terms.seams) return std::fill_n(slot, slots_, 0.0), void();
  std::vector<Vec3> gradient;
  for (const SeamHinge& h : hinges_) {
    const double turn = turnOf(h, state, &gradient), moment = h.points.stiffness_length * turn;
    for (const Vec3& g : gradient)
      for (int d = 0; d < 3; ++d) *slot++ = moment * g[d];
    for (std::size_t side = 0; side < 2; ++side)
      if (h.turn[side] >= 0 && !out.inner.empty())
        out.inner[static_cast<std::size_t>(h.turn[side])] += moment * h.sense[side];
    if (out.energy) out.energy->stored += 0.5 * moment * turn;
  }
}

std::vector<int> SeamSprings::blocksOf(const SeamHinge& hinge, const FreeMap& map) const {
  std::vector<int> rows = freePointsOf(map, hinge.points.columns);
  for (const int turn : hinge.turn)
    if (turn >= 0) rows.push_back(map.T.column_count + turn / 3);
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  return rows;
}

void SeamSprings::addStiffness(const FreeMap& map, const ClothState& state, const ForceTerms& terms,
                               BlockMatrix& K) const {
  if (!terms.seams) return;
  std::vector<std::array<double, 9>> blocks;
  std::vector<Vec3> gradient;
  for (const SeamHinge& h : hinges_) {
    // Of its points, at the angle that the inner unknowns leave.
    HingePoint left = h.points;
    left.theta0 = hingeAngle(h.points, state.q, &gradient) - turnOf(h, state, nullptr);
    hingeStiffness(left, state.q, blocks, terms.definite);
    addSymmetrised(map, left.columns, blocks, K);
    for (std::size_t side = 0; side < 2; ++side) {
      if (h.turn[side] < 0) continue;
      const double slope = -h.points.stiffness_length * h.sense[side];
      const int row = map.T.column_count + h.turn[side] / 3;
      const auto at = static_cast<std::size_t>(h.turn[side] % 3);
      for (std::size_t k = 0; k < gradient.size(); ++k) {
        std::array<double, 9> block{};
        for (int d = 0; d < 3; ++d) block[static_cast<std::size_t>(3 * d) + at] = slope * gradient[k][d];
        K.add(map.T.columns[static_cast<std::size_t>(h.points.columns[k])], row, block);
      }
      for (std::size_t other = 0; other < 2; ++other) {
        const int column = h.turn[other] < 0 ? -1 : map.T.column_count + h.turn[other] / 3;
        if (column < row) continue;
        std::array<double, 9> block{};
        block[3 * at + static_cast<std::size_t>(h.turn[other] % 3)] = -slope * h.sense[other];
        K.add(row, column, block);
      }
    }
  }
}

}  // namespace gambeson
