#include "core/cloth/springs/spring_net.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/cloth/draft/fields.hpp"
#include "core/cloth/draft/seams.hpp"
#include "core/cloth/patches/bilinear.hpp"
#include "core/error.hpp"
#include "core/material/fabric_law.hpp"

namespace gambeson {
namespace {

constexpr double kCurvature_per_m = 100;  ///< at which flexion springs store what the fabric does
/// k_b of a strip over B of its line. Two strips lie over each cell; and over chords that keep their length, of the
/// curvature k, the arc of the same ends and length is flatter, k² 3/4.
constexpr double kStripShare = 2.0 / 3, kFlatter = 0.75;

[[noreturn]] void refuse(const std::string& key, const std::string& why) { throw InputError({"", 0, key}, why); }

void checkForSprings(const Garment& g) {
  checkBilinear(g, "springs");
  const auto checkLaw = [](const Fabric& f) {
    if (const std::string why = whatSpringsLack(f); !why.empty()) refuse("model", why);
  };
  checkLaw(g.fabric);
  for (const Fabric& f : g.other_fabrics) checkLaw(f);
}

/// e . A e of a strain or curvature in Voigt's form.
double form(const Voigt& A, const Vec3& e) {
  return A[0] * e.x * e.x + A[1] * e.y * e.y + A[2] * e.z * e.z +
         2 * (A[3] * e.x * e.y + A[4] * e.x * e.z + A[5] * e.y * e.z);
}
/// Of a stretch of 1 along a direction, and of a shear of 1 between it and the one across.
Vec3 along(const Vec2& d) { return {d.x * d.x, d.y * d.y, 2 * d.x * d.y}; }
Vec3 shearAcross(const Vec2& d) { return {-d.x * d.y, d.x * d.y, d.x * d.x - d.y * d.y}; }

/// B of a law along a direction [N m]: what stores as much at kCurvature_per_m.
double rigidityAlong(const PointLaw& law, const Vec2& d) {
  const Vec3 k = kCurvature_per_m * along(d);
  const double none[3] = {}, bent[3] = {k.x, k.y, k.z};
  PointAnswer<double> answer;
  evaluateLaws<with_energy>(lawUse(law), numbersOf(law), none, bent, {}, answer);
  return 2 * answer.energy / (kCurvature_per_m * kCurvature_per_m);
}

/// Flexion springs over two cells of length a and width b, of cloth of this rigidity [N m].
double flexionOf(double rigidity, double a, double b) {
  const double turn = std::min(2 * std::asin(std::min(1.0, 0.5 * a * kCurvature_per_m)), 0.5 * std::numbers::pi);
  const double curvature = 2 * std::sin(0.5 * turn) / a, shorter = 2 * a * (1 - std::cos(0.5 * turn));
  return rigidity * curvature * curvature * a * b / (shorter * shorter);
}

double size(const Vec2& v) { return std::hypot(v.x, v.y); }

/// One cell of a patch, before its springs are shared out.
struct Cell {
  Vec2 u, v;              ///< its sides at rest, along (weft, warp) [m]; of no length at a pole
  double ku = 0, kv = 0;  ///< structural springs along them
  double fu = 0, fv = 0;  ///< flexion
  double bu = 0, bv = 0;  ///< k_b of strips that buckle
  double diagonal = 0;
};

Cell cellOf(const Garment& g, int patch, const std::array<Vec3, 4>& x, const Vec2& middle, const SpringNumbers& n) {
  const Vec3 su = 0.5 * (x[1] - x[0] + x[3] - x[2]), sv = 0.5 * (x[2] - x[0] + x[3] - x[1]);
  const Vec3 normal = normalized(cross(su, sv)), weft = g.weft[static_cast<std::size_t>(patch)];
  const Vec3 e1 = normalized(weft - dot(weft, normal) * normal), e2 = cross(normal, e1);
  Cell c{{dot(su, e1), dot(su, e2)}, {dot(sv, e1), dot(sv, e2)}};
  const double a = size(c.u), b = size(c.v);
  const PointLaw law = pointLaw(fabricAt(g, patch, middle));
  const Voigt& A = law.section.A;
  const Vec2 du{c.u.x / a, c.u.y / a}, dv{c.v.x / b, c.v.y / b};
  const double shear = form(A, shearAcross(du));
  c.diagonal = n.shear_N_per_m > 0 ? n.shear_N_per_m : shear * (a * a + b * b) / (2 * a * b);
  const double sum2 = a * a + b * b;
  const bool strips = n.flexion == Flexion::buckling;
  const auto line = [&](const Vec2& d, double length, double width, double& structural, double& flexion,
                        double& rigidity) {
    const double stiff = rigidityAlong(law, d);
    flexion = n.flexion_N_per_m > 0 || strips ? n.flexion_N_per_m : flexionOf(stiff, length, width);
    const double diagonals = 2 * c.diagonal * length * length * length / (width * sum2),
                 bent = strips ? 0 : 4 * flexion;
    structural =
        n.structural_N_per_m > 0 ? n.structural_N_per_m : (form(A, along(d)) - diagonals) * width / length - bent;
    if (!(structural > 0))
      refuse("springs",
             "cells are too long: shear springs alone are stiffer along them than the fabric; give "
             "structural springs, or make cells as wide as they are long");
    if (!strips) return;
    rigidity = kStripShare * (n.rigidity_Nm > 0 ? n.rigidity_Nm : stiff) * width;
    if (!(rigidity > 0)) refuse("springs.rigidity", "strips need one: this fabric has none along them");
    if (!(flexion > 0)) flexion = 0.25 * structural;
  };
  line(du, a, b, c.ku, c.fu, c.bu);
  line(dv, b, a, c.kv, c.fv, c.bv);
  return c;
}

/// Springs between points of a garment, which lines on both sides of them have a part in.
class Springs {
 public:
  Springs(const std::vector<Vec3>& rest, SpringNet& net) : rest_(rest), net_(net) {}
  void add(int a, int b, double stiffness) {
    if (const double length = between(a, b); length > 0 && stiffness > 0)
      net_.springs.push_back({{a, b}, length, stiffness});
  }
  /// Over two cells. `rigidity_Nm2`: k_b of a strip; 0: Hooke's spring.
  void addFlexion(int a, int b, double stiffness, double rigidity_Nm2) {
    const std::size_t before = net_.springs.size();
    add(a, b, stiffness);
    if (net_.springs.size() == before) return;
    PointSpring& spring = net_.springs.back();
    spring.bends = true;
    if (!(rigidity_Nm2 > 0)) return;
    spring.strip = static_cast<int>(net_.strips.size());
    net_.strips.emplace_back(rigidity_Nm2, spring.rest_m, stiffness);
  }

 private:
  double between(int a, int b) const {
    return norm(rest_[static_cast<std::size_t>(b)] - rest_[static_cast<std::size_t>(a)]);
  }

  const std::vector<Vec3>& rest_;
  SpringNet& net_;
};

SpringCell summed(const Cell& c) {
  SpringCell out;
  const Vec2 sum{c.u.x + c.v.x, c.u.y + c.v.y}, difference{c.u.x - c.v.x, c.u.y - c.v.y};
  const auto twice = [](const Vec2& v) { return Vec2{2 * v.x, 2 * v.y}; };
  out.lines = {{{c.u, c.ku},
                {c.v, c.kv},
                {twice(c.u), c.fu, c.bu},
                {twice(c.v), c.fv, c.bv},
                {sum, c.diagonal},
                {difference, c.diagonal}}};
  out.area_m2 = std::abs(c.u.x * c.v.y - c.u.y * c.v.x);
  return out;
}

void addPatch(const Garment& g, int patch, int first, const std::vector<Vec3>& rest, const SpringNumbers& numbers,
              SpringNet& net) {
  const NurbsPatch& p = g.patches[static_cast<std::size_t>(patch)];
  const int nu = p.u.count(), nv = p.v.count();
  std::vector<Cell> cells;
  const auto at = [&](int i, int j) { return first + p.index(i, j); };
  for (int j = 0; j + 1 < nv; ++j)
    for (int i = 0; i + 1 < nu; ++i) {
      const auto x = [&](int k, int l) { return p.points[static_cast<std::size_t>(p.index(k, l))]; };
      const auto mid = [](const KnotVector& k, int c) {
        return 0.5 * (k.knots[static_cast<std::size_t>(c) + 1] + k.knots[static_cast<std::size_t>(c) + 2]);
      };
      cells.push_back(
          cellOf(g, patch, {x(i, j), x(i + 1, j), x(i, j + 1), x(i + 1, j + 1)}, {mid(p.u, i), mid(p.v, j)}, numbers));
      net.cells.push_back(summed(cells.back()));
    }
  net.first_cell.push_back(static_cast<int>(net.cells.size()));
  const auto cell = [&](int i, int j) -> const Cell& { return cells[static_cast<std::size_t>(i + (nu - 1) * j)]; };
  // Half of each line's stiffness is that of the cells on either side.
  const auto both = [](int line, int lines, const auto& of) {
    double sum = 0;
    for (int side = std::max(0, line - 1); side <= std::min(line, lines - 2); ++side) sum += 0.5 * of(side);
    return sum;
  };
  Springs springs(rest, net);
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i) {
      if (i + 1 < nu) springs.add(at(i, j), at(i + 1, j), both(j, nv, [&](int l) { return cell(i, l).ku; }));
      if (j + 1 < nv) springs.add(at(i, j), at(i, j + 1), both(i, nu, [&](int k) { return cell(k, j).kv; }));
      if (i + 1 < nu && j + 1 < nv) {
        springs.add(at(i, j), at(i + 1, j + 1), cell(i, j).diagonal);
        springs.add(at(i + 1, j), at(i, j + 1), cell(i, j).diagonal);
      }
      const auto along_u = [&](double Cell::*of) {
        return both(j, nv, [&](int l) { return 0.5 * (cell(i, l).*of + cell(i + 1, l).*of); });
      };
      const auto along_v = [&](double Cell::*of) {
        return both(i, nu, [&](int k) { return 0.5 * (cell(k, j).*of + cell(k, j + 1).*of); });
      };
      if (i + 2 < nu) springs.addFlexion(at(i, j), at(i + 2, j), along_u(&Cell::fu), along_u(&Cell::bu));
      if (j + 2 < nv) springs.addFlexion(at(i, j), at(i, j + 2), along_v(&Cell::fv), along_v(&Cell::bv));
    }
}

/// Whether cloth bends across a seam.
bool runsOn(const Seam& seam) { return seam.kind == SeamKind::G1 || seam.stiffness_N > 0; }

/// Flexion springs over a seam.
void addSeam(const Garment& g, const Seam& seam, const std::vector<Vec3>& rest, SpringNet& net) {
  const EdgeColumns a = edgeColumns(g, seam.a), b = edgeColumns(g, seam.b);
  const int from = std::max(0, seam.first_cell);  // of b
  const auto across = [&](const PatchEdge& edge, int k) -> const SpringCell::Line& {
    const NurbsPatch& p = g.patches[static_cast<std::size_t>(edge.patch)];
    const int nu = p.u.count() - 1, nv = p.v.count() - 1;
    const bool along_v = edge.side == Side::u0 || edge.side == Side::u1;
    const int count = along_v ? nv : nu, at = edge.reversed ? count - 1 - k : k;
    const int i = along_v ? (edge.side == Side::u0 ? 0 : nu - 1) : at;
    const int j = along_v ? at : (edge.side == Side::v0 ? 0 : nv - 1);
    const int cell = net.first_cell[static_cast<std::size_t>(edge.patch)] + i + nu * j;
    return net.cells[static_cast<std::size_t>(cell)].lines[along_v ? 2 : 3];
  };
  const int points = static_cast<int>(a.edge.size());
  Springs springs(rest, net);
  for (int k = 0; k < points; ++k) {
    double stiffness = 0, rigidity = 0;
    for (int c = std::max(0, k - 1); c <= std::min(k, points - 2); ++c) {
      const SpringCell::Line &first = across(seam.a, c), &second = across(seam.b, from + c);
      stiffness += 0.25 * (first.stiffness_N_per_m + second.stiffness_N_per_m);
      rigidity += 0.25 * (first.rigidity_Nm2 + second.rigidity_Nm2);
    }
    springs.addFlexion(a.inner[static_cast<std::size_t>(k)], b.inner[static_cast<std::size_t>(from + k)], stiffness,
                       rigidity);
  }
}

}  // namespace

std::string whatSpringsLack(const Fabric& fabric) {
  const LawUse use = lawUse(fabric);
  const Section section = pointLaw(fabric).section;
  const bool coupled = std::any_of(section.B.begin(), section.B.end(), [](double b) { return b != 0; });
  return fabric.energy ? "springs have numbers for their law, and this fabric's is an energy at a point"
         : (use.kinds & BendingLaws::remembering) ? "springs remember nothing, and this fabric's bending does"
         : use.shears                           ? "springs have no friction in shear, and this fabric has"
         : use.tension ? "springs carry pressure as they carry tension, and this fabric has a tension field"
         : coupled     ? "springs do not couple stretch and bending, and this laminate does"
                       : "";
}

SpringNet springNet(const Garment& garment, const SpringNumbers& numbers) {
  checkForSprings(garment);
  SpringNet net;
  std::vector<Vec3> rest;
  for (const NurbsPatch& p : garment.patches) rest.insert(rest.end(), p.points.begin(), p.points.end());
  const std::vector<int> offsets = controlOffsets(garment);
  for (int p = 0; p < static_cast<int>(garment.patches.size()); ++p)
    addPatch(garment, p, offsets[static_cast<std::size_t>(p)], rest, numbers, net);
  for (const Seam& seam : garment.seams)
    if (runsOn(seam)) addSeam(garment, seam, rest, net);
  return net;
}

Vec3 resultantsOf(const SpringCell& cell, const Vec3& strain) {
  Vec3 n{};
  for (const SpringCell::Line& line : cell.lines) {
    if (line.rigidity_Nm2 > 0) continue;
    const double length2 = line.way.x * line.way.x + line.way.y * line.way.y;
    const double longer2 = 2 * (strain.x * line.way.x * line.way.x + strain.y * line.way.y * line.way.y +
                                strain.z * line.way.x * line.way.y);
    const double pull = line.stiffness_N_per_m * (1 - std::sqrt(length2 / (length2 + longer2))) / cell.area_m2;
    n += pull * Vec3{line.way.x * line.way.x, line.way.y * line.way.y, line.way.x * line.way.y};
  }
  return n;
}

Vec3 momentsOf(const SpringCell& cell, const Vec3& curvature) {
  Vec3 m{};
  for (const SpringCell::Line& line : {cell.lines[2], cell.lines[3]}) {
    const double length = 0.5 * size(line.way), dx = 0.5 * line.way.x / length, dy = 0.5 * line.way.y / length;
    const double bent = curvature.x * dx * dx + curvature.y * dy * dy + curvature.z * dx * dy;
    if (line.rigidity_Nm2 > 0) {
      m += 2 * kFlatter * line.rigidity_Nm2 * length * bent / cell.area_m2 * Vec3{dx * dx, dy * dy, dx * dy};
      continue;
    }
    const double half = std::clamp(0.5 * length * bent, -std::numbers::sqrt2 / 2, std::numbers::sqrt2 / 2);
    const double cosine = std::sqrt(1 - half * half), shorter = 2 * length * (1 - cosine);
    const double moment = line.stiffness_N_per_m * shorter * length * length * half / cosine / cell.area_m2;
    m += moment * Vec3{dx * dx, dy * dy, dx * dy};
  }
  return m;
}

}  // namespace gambeson
