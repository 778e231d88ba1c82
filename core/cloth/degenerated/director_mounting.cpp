#include "core/cloth/degenerated/director_mounting.hpp"

#include <cmath>

#include "core/cloth/degenerated/degenerated_shell.hpp"
#include "core/cloth/patches/patch_mounting.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

/// Directors at rest may be off a plane of symmetry by so much: they are normals of parabolas through points.
constexpr double kOffPlane = 0.02;

[[noreturn]] void reject(const std::string& name, const std::string& reason) {
  throw InputError({"", 0, name}, reason);
}

class DirectorMounting : public Mounting {
 public:
  explicit DirectorMounting(const DegeneratedShell& cloth) : c_(cloth), points_(patchMounting(cloth.garment())) {}

  PlaceRow place(int patch, Vec2 uv) const override { return points_->place(patch, uv); }
  PlaceRow weft(int patch, Vec2 uv) const override { return points_->weft(patch, uv); }
  std::vector<int> edgePoints(const PatchEdge& edge, int rows) const override {
    return points_->edgePoints(edge, rows);
  }
  double edgeLength(const PatchEdge& edge) const override { return points_->edgeLength(edge); }
  std::vector<LinearConstraint> holdEdge(const PatchEdge& edge, std::span<const Vec3> directions,
                                         const Prescribed& motion) const override {
    return points_->holdEdge(edge, directions, motion);
  }
  std::vector<LinearConstraint> holdPlace(int patch, Vec2 uv, std::span<const Vec3> directions,
                                          const Prescribed& motion) const override {
    return points_->holdPlace(patch, uv, directions, motion);
  }
  std::vector<LinearConstraint> tieEdge(const PatchEdge& edge, const Vec3& direction) const override {
    return points_->tieEdge(edge, direction);
  }

  std::vector<LinearConstraint> clampEdge(const PatchEdge& edge) const override {
    std::vector<LinearConstraint> out;
    for (const int point : edgePoints(edge, 1))
      for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
        out.push_back(spin("clamp of " + edgeName(edge), point, axis, 0, -1));
    return out;
  }
  std::vector<LinearConstraint> turnEdge(const PatchEdge& edge, const Vec3& turn_rad, int program) const override {
    const std::string name = "turn of " + edgeName(edge);
    if (!std::isfinite(norm(turn_rad))) reject(name, "must be finite");
    if (program < 0) reject(name, "needs a program that says when it acts");
    std::vector<LinearConstraint> out;
    for (const int point : edgePoints(edge, 1))
      for (int axis = 0; axis < 3; ++axis) {
        Vec3 e{};
        e[axis] = 1;
        out.push_back(spin(name, point, e, turn_rad[axis], program));
      }
    return out;
  }
  std::vector<LinearConstraint> mirrorEdge(const PatchEdge& edge, const Vec3& normal) const override {
    const std::string name = "symmetry of " + edgeName(edge);
    checkSupport(name, std::span(&normal, 1), {});
    const std::vector<int> points = edgePoints(edge, 1);
    const Vec3 first = c_.rest()[static_cast<std::size_t>(points.front())];
    const double length = edgeLength(edge);
    for (const int p : points) {
      if (!(std::abs(dot(normal, c_.rest()[static_cast<std::size_t>(p)] - first)) <= 1e-6 * length))
        reject(name, "the edge does not lie in a plane with this normal");
      if (std::abs(dot(normal, c_.directors().rest[directorOf(p)])) > kOffPlane)
        reject(name, "the rest surface does not meet the plane at right angles");
    }
    std::vector<LinearConstraint> out = holdEdge(edge, std::span(&normal, 1), {});
    for (LinearConstraint& c : out) c.name = name;
    const Vec3 e = std::abs(normal.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 one = normalized(e - dot(e, normal) * normal), two = cross(normal, one);
    for (const int point : points)
      for (const Vec3& axis : {one, two}) out.push_back(spin(name, point, axis, 0, -1));
    return out;
  }

  std::vector<Vec3> edgeForce(const PatchEdge& edge, const Vec3& force_N_per_m) const override {
    return points_->edgeForce(edge, force_N_per_m);
  }
  std::vector<Vec3> surfaceForce(int patch, const Vec3& force_N_per_m2) const override {
    return points_->surfaceForce(patch, force_N_per_m2);
  }
  std::vector<Vec3> placeForce(int patch, Vec2 uv, const Vec3& force_N) const override {
    return points_->placeForce(patch, uv, force_N);
  }
  std::vector<Vec3> weightForce(const Vec3& gravity_m_per_s2) const override {
    return points_->weightForce(gravity_m_per_s2);
  }
  std::vector<FollowingLoad> pressure(int patch, double pressure_Pa) const override {
    return points_->pressure(patch, pressure_Pa);
  }
  std::vector<FollowingLoad> edgeMoment(const PatchEdge& edge, double moment_N) const override {
    const std::vector<int> points = edgePoints(edge, 1);
    FollowingLoad load;
    for (std::size_t i = 1; i < points.size(); ++i) {
      const Vec3 half =
          0.5 * moment_N *
          (c_.rest()[static_cast<std::size_t>(points[i])] - c_.rest()[static_cast<std::size_t>(points[i - 1])]);
      for (const int p : {points[i - 1], points[i]})
        for (int axis = 0; axis < 3; ++axis)
          load.inner.emplace_back(3 * static_cast<int>(directorOf(p)) + axis, half[axis]);
    }
    return {load};
  }

 private:
  std::size_t directorOf(int point) const {
    return static_cast<std::size_t>(c_.directors().of_point[static_cast<std::size_t>(point)]);
  }
  /// axis . spin = amount.
  LinearConstraint spin(const std::string& name, int point, const Vec3& axis, double amount, int program) const {
    LinearConstraint c;
    c.name = name;
    c.amount_m = amount;
    if (amount != 0) c.program = program;
    for (int k = 0; k < 3; ++k)
      if (axis[k] != 0) c.inner.emplace_back(3 * static_cast<int>(directorOf(point)) + k, axis[k]);
    return c;
  }

  const DegeneratedShell& c_;
  std::unique_ptr<const Mounting> points_;
};

}  // namespace

std::unique_ptr<const Mounting> directorMounting(const DegeneratedShell& cloth) {
  return std::make_unique<DirectorMounting>(cloth);
}

}  // namespace gambeson
