#include "core/cloth/triangles/triangle_membrane.hpp"

#include <Eigen/Dense>
#include <cmath>

#include "core/error.hpp"
#include "core/material/laws/spring.hpp"

namespace gambeson {
namespace {

/// The inverse of a symmetric matrix in the order of Voigt.
Voigt inverseOf(const Voigt& A) {
  Eigen::Matrix3d m;
  m << A[0], A[3], A[4], A[3], A[1], A[5], A[4], A[5], A[2];
  const Eigen::Matrix3d s = m.inverse();
  return {s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(0, 2), s(1, 2)};
}

/// What an edge does to strains: d(l^2) = 2 t . de.
std::array<double, 3> tensorOf(const Vec2& d) { return {d.x * d.x, d.y * d.y, d.x * d.y}; }

double length2(const std::array<double, 3>& t, const double* e) {
  return t[0] * (1 + 2 * e[0]) + t[1] * (1 + 2 * e[1]) + 2 * t[2] * e[2];
}

/// Adds an edge's part to n and slope.
void addEdge(const std::array<double, 3>& t, double per_length, double slope, Answer<double, 3>& out) {
  constexpr int row[6] = {0, 1, 2, 0, 0, 1}, column[6] = {0, 1, 2, 1, 2, 2};
  for (std::size_t i = 0; i < 3; ++i) out.resultant[i] += per_length * t[i];
  for (int i = 0; i < 6; ++i)
    out.slope[i] += slope * t[static_cast<std::size_t>(row[i])] * t[static_cast<std::size_t>(column[i])];
}

void clear(Answer<double, 3>& out) {
  for (double& n : out.resultant) n = 0;
  for (double& s : out.slope) s = 0;
}

}  // namespace

TriangleMembrane triangleMembrane(const MembraneModel& model, const Fabric& fabric, const Section& section) {
  TriangleMembrane m;
  m.elements = model.elements;
  if (model.elements == MembraneElements::continuum) return m;
  if (fabric.tension_field)
    throw InputError({"", 0, "fabric.tension_field"},
                     "relaxes the fabric's own membrane; allowed: with membrane_elements \"continuum\"");
  const Voigt S = inverseOf(section.A);
  const auto given = [](double number, double of_fabric) { return number > 0 ? number : of_fabric; };
  if (model.elements == MembraneElements::springs) {
    m.compliance = S;
    m.spring_N_per_m = 0.5 * model.spring_N_per_m;
    m.spring_damping_Ns_per_m = 0.5 * model.stretch_damping_Ns_per_m;
  } else {
    m.threads = {given(model.weft_N_per_m, 1 / S[0]), given(model.warp_N_per_m, 1 / S[1]),
                 given(model.shear_N_per_m, 1 / S[2]), model.stretch_damping_Ns_per_m, model.shear_damping_Ns_per_m};
  }
  return m;
}

TriangleSprings springsOf(const TriangleMembrane& membrane, const std::array<Vec2, 2>& g, double area_m2) {
  // Columns of the inverse of (g[0]; g[1]) are the corners 1 and 2 from corner 0.
  const double det = g[0].x * g[1].y - g[0].y * g[1].x;
  const Vec2 one{g[1].y / det, -g[1].x / det}, two{-g[0].y / det, g[0].x / det};
  TriangleSprings s;
  s.edge = {one, two, Vec2{two.x - one.x, two.y - one.y}};
  s.damping_Ns_per_m = membrane.spring_damping_Ns_per_m;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::array<double, 3> t = tensorOf(s.edge[k]);
    const double l2 = t[0] + t[1];
    s.rest_m[k] = std::sqrt(l2);
    const Voigt& S = membrane.compliance;
    const double soft = (S[0] * t[0] * t[0] + S[1] * t[1] * t[1] + S[2] * t[2] * t[2] +
                         2 * (S[3] * t[0] * t[1] + S[4] * t[0] * t[2] + S[5] * t[1] * t[2])) /
                        (l2 * l2);
    s.stiffness_N_per_m[k] = membrane.spring_N_per_m > 0 ? membrane.spring_N_per_m : area_m2 / (soft * l2);
  }
  return s;
}

void springResultants(const TriangleSprings& springs, double area_m2, const double* e, Answer<double, 3>& out) {
  clear(out);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::array<double, 3> t = tensorOf(springs.edge[k]);
    const double l2 = length2(t, e);
    const SpringAnswer<double> s = linearSpring<all_parts>(springs.stiffness_N_per_m[k], springs.rest_m[k], l2);
    out.energy += s.energy / area_m2;
    addEdge(t, s.per_length / area_m2, (s.along - s.across) / (l2 * area_m2), out);
  }
}

void springDampingResultants(const TriangleSprings& springs, double area_m2, const double* e, const double* rate,
                             Answer<double, 3>& out) {
  clear(out);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::array<double, 3> t = tensorOf(springs.edge[k]);
    const double l2 = length2(t, e), along = t[0] * rate[0] + t[1] * rate[1] + t[2] * rate[2];
    const double per_length = springDamping(springs.damping_Ns_per_m, l2, along);
    out.energy += per_length * along / area_m2;
    addEdge(t, per_length / area_m2, springDamping(springs.damping_Ns_per_m, l2, 1.0) / area_m2, out);
  }
}

}  // namespace gambeson
