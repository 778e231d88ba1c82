#include "core/cloth/patches/patch_mounting.hpp"

#include <algorithm>

#include "core/cloth/draft/edge.hpp"
#include "core/cloth/draft/fields.hpp"
#include "core/cloth/draft/seams.hpp"
#include "core/cloth/patches/rest_frame.hpp"
#include "core/cloth/patches/patch_loads.hpp"
#include "core/cloth/patches/patch_supports.hpp"
#include "core/cloth/surface.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

class PatchMounting : public Mounting {
 public:
  explicit PatchMounting(const Garment& garment) : g_(garment) {}

  PlaceRow place(int patch, Vec2 uv) const override {
    if (patch < 0 || patch >= static_cast<int>(g_.patches.size()))
      throw InputError({"", 0, "patch"}, "patch " + std::to_string(patch) + " does not exist");
    SurfaceBasis basis = surfaceBasis(g_.patches[static_cast<std::size_t>(patch)], uv.x, uv.y);
    const int first = controlOffsets(g_)[static_cast<std::size_t>(patch)];
    for (int& column : basis.columns) column += first;
    return {std::move(basis.columns), std::move(basis.values[0]), std::move(basis.values[1]),
            std::move(basis.values[2])};
  }
  /// Where the rest surface has no frame (a pole, a corner), that beside it, as the stress has it.
  PlaceRow weft(int patch, Vec2 uv) const override {
    const NurbsPatch& p = g_.patches[static_cast<std::size_t>(patch)];
    for (const double share : {0.0, 0.1}) try {
        const auto inside = [share](const KnotVector& knots, double t) {
          const auto span = static_cast<std::size_t>(findSpan(knots, t));
          return t + share * (0.5 * (knots.knots[span] + knots.knots[span + 1]) - t);
        };
        const Vec2 at{inside(p.u, uv.x), inside(p.v, uv.y)};
        PlaceRow row = place(patch, at);
        const std::array<Vec3, 6> rest = surfaceDerivatives(p, at.x, at.y);
        const RestFrame G = restFrame(rest[1], rest[2], g_.weft[static_cast<std::size_t>(patch)],
                                      fibreAngleAt(g_, patch, at));
        for (std::size_t k = 0; k < row.columns.size(); ++k) row.value[k] = G.G11 * row.d1[k] + G.G21 * row.d2[k];
        row.d1.clear();
        row.d2.clear();
        return row;
      } catch (const InputError&) {
        if (share > 0) throw;
      }
    return {};
  }
  std::vector<int> edgePoints(const PatchEdge& edge, int rows) const override {
    checkEdge(g_, edge, edgeName(edge));
    const NurbsPatch& patch = g_.patches[static_cast<std::size_t>(edge.patch)];
    const int first = controlOffsets(g_)[static_cast<std::size_t>(edge.patch)];
    const bool across_u = edge.side == Side::u0 || edge.side == Side::u1;
    const int inward = (across_u ? 1 : patch.u.count()) * (edge.side == Side::u0 || edge.side == Side::v0 ? 1 : -1);
    std::vector<int> points;
    for (int r = 0; r < std::min(rows, acrossKnots(patch, edge.side).count()); ++r)
      for (const int k : gridEdge(patch.u.count(), patch.v.count(), edge)) points.push_back(first + k + r * inward);
    return points;
  }
  double edgeLength(const PatchEdge& edge) const override {
    constexpr int kPieces = 64;
    const NurbsPatch& patch = g_.patches[static_cast<std::size_t>(edge.patch)];
    const KnotVector& knots = alongKnots(patch, edge.side);
    double length = 0;
    Vec3 last{};
    for (int k = 0; k <= kPieces; ++k) {
      const double s = static_cast<double>(k) / kPieces;
      const Vec2 at = edgeParameters(g_, edge, (1 - s) * knots.front() + s * knots.back());
      const Vec3 x = surfaceDerivatives(patch, at.x, at.y)[0];
      if (k > 0) length += norm(x - last);
      last = x;
    }
    return length;
  }
  std::vector<LinearConstraint> holdEdge(const PatchEdge& edge, std::span<const Vec3> directions,
                                         const Prescribed& motion) const override {
    return supportEdge(g_, edge, directions, motion);
  }
  std::vector<LinearConstraint> holdPlace(int patch, Vec2 uv, std::span<const Vec3> directions,
                                          const Prescribed& motion) const override {
    return supportPoint(g_, patch, uv, directions, motion);
  }
  std::vector<LinearConstraint> clampEdge(const PatchEdge& edge) const override { return clampRotation(g_, edge); }
  std::vector<LinearConstraint> mirrorEdge(const PatchEdge& edge, const Vec3& normal) const override {
    return symmetryEdge(g_, edge, normal);
  }
  std::vector<LinearConstraint> tieEdge(const PatchEdge& edge, const Vec3& direction) const override {
    return gambeson::tieEdge(g_, edge, direction);
  }
  std::vector<Vec3> edgeForce(const PatchEdge& edge, const Vec3& force_N_per_m) const override {
    return gambeson::edgeForce(g_, edge, force_N_per_m);
  }
  std::vector<Vec3> surfaceForce(int patch, const Vec3& force_N_per_m2) const override {
    return gambeson::surfaceForce(g_, patch, force_N_per_m2);
  }
  std::vector<Vec3> placeForce(int patch, Vec2 uv, const Vec3& force_N) const override {
    return pointForce(g_, patch, uv, force_N);
  }
  std::vector<Vec3> weightForce(const Vec3& gravity_m_per_s2) const override {
    return gambeson::weightForce(g_, gravity_m_per_s2);
  }
  std::vector<FollowingLoad> pressure(int patch, double pressure_Pa) const override {
    return pressureOn(g_, patch, pressure_Pa);
  }
  std::vector<FollowingLoad> edgeMoment(const PatchEdge& edge, double moment_N) const override {
    return edgeMomentOn(g_, edge, moment_N);
  }

 private:
  const Garment& g_;
};

}  // namespace

std::unique_ptr<const Mounting> patchMounting(const Garment& garment) {
  return std::make_unique<PatchMounting>(garment);
}

}  // namespace gambeson
