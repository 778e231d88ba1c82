#include "core/cloth/draft/trim_map.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/cloth/draft/areas.hpp"
#include "core/cloth/draft/part_seam.hpp"
#include "core/cloth/draft/seams.hpp"
#include "core/cloth/draft/shared_points.hpp"
#include "core/error.hpp"
#include "core/nurbs/trim_arcs.hpp"

namespace gambeson {
namespace {

/// Coefficient i of a polynomial of degree `degree` in terms of the coefficients first .. first + degree. The B-spline
/// coefficient of t^m is its blossom at the inner knots, e_m(t_{i+1} .. t_{i+p}) / C(p, m).
std::vector<double> extrapolation(const KnotVector& knots, int i, int first, int degree) {
  const int p = knots.degree;
  const double origin = knots.knots[i + 1], scale = knots.knots[first + p + degree] - knots.knots[first + 1];
  const auto blossoms = [&](int j) {
    std::vector<double> e(p + 1, 0.0);
    e[0] = 1;
    for (int k = 1; k <= p; ++k) {
      const double t = (knots.knots[j + k] - origin) / scale;
      for (int m = k; m >= 1; --m) e[m] += t * e[m - 1];
    }
    double binomial = 1;
    for (int m = 1; m <= p; ++m) {
      binomial = binomial * (p - m + 1) / m;
      e[m] /= binomial;
    }
    return e;
  };
  Eigen::MatrixXd A(degree + 1, degree + 1);
  Eigen::VectorXd b(degree + 1);
  for (int j = 0; j <= degree; ++j) {
    const auto e = blossoms(first + j);
    for (int m = 0; m <= degree; ++m) A(m, j) = e[m];
  }
  const auto e = blossoms(i);
  for (int m = 0; m <= degree; ++m) b(m) = e[m];
  const Eigen::VectorXd x = A.fullPivLu().solve(b);
  return {x.data(), x.data() + x.size()};
}

class Followers {
 public:
  Followers(const NurbsPatch& patch, std::vector<char> used) : patch_(patch), used_(std::move(used)) {}

  /// Coefficients by control points of the patch; the nearest blocks at the same distance share.
  std::map<int, double> prior(int i, int j, int most) const {
    const int nu = patch_.u.count(), nv = patch_.v.count();
    for (int d = most; d >= 0; --d) {
      const int du = std::min(d, patch_.u.degree), dv = std::min(d, patch_.v.degree);
      const int reach_u = d > 0 ? patch_.u.degree : nu, reach_v = d > 0 ? patch_.v.degree : nv;
      std::vector<std::array<int, 2>> blocks;
      long nearest = -1;
      for (int b = std::max(0, j - dv - reach_v); b + dv < nv && b <= j + reach_v; ++b)
        for (int a = std::max(0, i - du - reach_u); a + du < nu && a <= i + reach_u; ++a) {
          const long x = 2 * (a - i) + du, y = 2 * (b - j) + dv, distance = x * x + y * y;
          if (nearest >= 0 && distance > nearest) continue;
          if (!isUsed(a, b, du, dv)) continue;
          if (distance != nearest) blocks.clear();
          nearest = distance;
          blocks.push_back({a, b});
        }
      if (blocks.empty()) continue;
      std::map<int, double> out;
      for (const auto& [a, b] : blocks) {
        const auto eu = extrapolation(patch_.u, i, a, du), ev = extrapolation(patch_.v, j, b, dv);
        for (int y = 0; y <= dv; ++y)
          for (int x = 0; x <= du; ++x) {
            const int at = patch_.index(a + x, b + y);
            out[at] += eu[x] * ev[y] * patch_.weights[at] / patch_.weights[patch_.index(i, j)] /
                       static_cast<double>(blocks.size());
          }
      }
      return out;
    }
    return {};
  }

  /// The least change of the coefficients after which they sum to 1 and reproduce the rest position; where the points
  /// at hand cannot, those around them join.
  bool correct(int i, int j, std::map<int, double>& c) const {
    int i0 = patch_.u.count(), i1 = 0, j0 = patch_.v.count(), j1 = 0;
    for (const auto& entry : c) {
      const int a = entry.first % patch_.u.count(), b = entry.first / patch_.u.count();
      i0 = std::min(i0, a), i1 = std::max(i1, a), j0 = std::min(j0, b), j1 = std::max(j1, b);
    }
    const Vec3 Q = patch_.points[patch_.index(i, j)];
    for (int ring = 0; ring <= 3; ++ring) {
      if (ring > 0)
        for (int b = std::max(0, j0 - ring); b <= std::min(patch_.v.count() - 1, j1 + ring); ++b)
          for (int a = std::max(0, i0 - ring); a <= std::min(patch_.u.count() - 1, i1 + ring); ++a)
            if (used_[patch_.index(a, b)]) c.try_emplace(patch_.index(a, b), 0.0);
      double size = 0;
      for (const auto& entry : c) size = std::max(size, norm(patch_.points[entry.first] - Q));
      Eigen::MatrixXd A(4, static_cast<long>(c.size()));
      Eigen::Vector4d left(1, 0, 0, 0);
      long k = 0;
      for (const auto& [at, e] : c) {
        const Vec3 r = (patch_.points[at] - Q) / size;
        A.col(k) << 1, r.x, r.y, r.z;
        left -= e * A.col(k++);
      }
      const Eigen::JacobiSVD<Eigen::MatrixXd> svd(A, Eigen::ComputeThinU | Eigen::ComputeThinV);
      Eigen::VectorXd change = Eigen::VectorXd::Zero(A.cols());
      for (long s = 0; s < svd.singularValues().size(); ++s)
        if (svd.singularValues()(s) > 1e-9 * svd.singularValues()(0))
          change += svd.matrixV().col(s) * (svd.matrixU().col(s).dot(left) / svd.singularValues()(s));
      if ((A * change - left).norm() > 1e-12) continue;
      k = 0;
      for (auto& entry : c) entry.second += change(k++);
      return true;
    }
    return false;
  }

 private:
  bool isUsed(int a, int b, int du, int dv) const {
    for (int y = 0; y <= dv; ++y)
      for (int x = 0; x <= du; ++x)
        if (!used_[patch_.index(a + x, b + y)]) return false;
    return true;
  }

  const NurbsPatch& patch_;
  std::vector<char> used_;
};

/// A follower of area A_I loads the point J that it follows by e_J^2 A_I: its stiffness grows alike, and by a negative
/// e_J it takes mass away. Above this part of A_J a lower degree is taken. Measured over 24 to 48 shifts of circles,
/// disks, squares and diamonds through a cell of 1/8, degrees 2 and 3: at 0.3 the stable step stays at that of the
/// untrimmed sheet, at 1 it falls to 0.39 of it, without a limit masses turn negative (square outline).
constexpr double kHeaviest = 0.3;

/// A seam needs its edges whole (or the part that is joined), and the control points that the map T or its springs act
/// through.
void checkSeams(const Garment& g, const std::vector<char>& used) {
  for (std::size_t s = 0; s < g.seams.size(); ++s)
    for (const bool second : {false, true}) {
      const PatchEdge &e = second ? g.seams[s].b : g.seams[s].a, &other = second ? g.seams[s].a : g.seams[s].b;
      const int patches = static_cast<int>(g.patches.size());
      if (std::min(e.patch, other.patch) < 0 || std::max(e.patch, other.patch) >= patches)
        continue;  // buildFreeMap refuses it
      const Trim& trim = g.trims[e.patch];
      if (trim.loops.empty()) continue;
      const InputError::Where where{"", 0, "trims[" + std::to_string(e.patch) + "]"};
      const std::string seam = "seams[" + std::to_string(s) + "]";
      const EdgePart part = second && g.seams[s].onPart() ? partOf(g, static_cast<int>(s)) : EdgePart{};
      const EdgeColumns columns = edgeColumns(g, e);
      std::vector<char> needed(columns.edge.size(), part.rows.empty());
      for (const auto& row : part.rows)
        for (const auto& entry : row) needed[entry.first] = 1;
      for (const auto& list : {columns.edge, columns.inner})
        for (std::size_t k = 0; k < list.size(); ++k)
          if (const int c = list[k]; needed[k] && !used[c])
            throw InputError(where, "leaves a control point that " + seam + " needs without support");
      const NurbsPatch& patch = g.patches[e.patch];
      const TrimBoundary b = trimBoundary(patch, trim);
      const bool along_v = e.side == Side::u0 || e.side == Side::u1, far = e.side == Side::u1 || e.side == Side::v1;
      const double side = along_v ? (far ? b.u1 : b.u0) : (far ? b.v1 : b.v0);
      const double inward = (far ? -1e-9 : 1e-9) * (along_v ? b.u1 - b.u0 : b.v1 - b.v0);
      std::vector<double> at = breakpoints(along_v ? patch.v : patch.u);
      for (const MonotoneArc& arc : b.arcs)
        if ((along_v ? arc.a.x : arc.a.y) == side) at.push_back(along_v ? arc.a.y : arc.a.x);
      std::sort(at.begin(), at.end());
      for (std::size_t k = 0; k + 1 < at.size(); ++k) {
        const double mid = 0.5 * (at[k] + at[k + 1]);
        const double fraction = (mid - at.front()) / (at.back() - at.front());
        const double sense = e.reversed ? 1 - fraction : fraction;
        if (at[k] < at[k + 1] && sense > part.from && sense < part.to &&
            b.winding(along_v ? Vec2{side + inward, mid} : Vec2{mid, side + inward}) <= 0)
          throw InputError(where, "cuts the edge of " + seam + "; a loop may not take a stretch of a joined edge");
      }
    }
}

}  // namespace

std::map<int, TrimFollower> trimFollowers(const Garment& garment) {
  std::map<int, TrimFollower> out;
  if (std::all_of(garment.trims.begin(), garment.trims.end(), [](const Trim& t) { return t.loops.empty(); }))
    return out;
  const std::vector<int> offsets = controlOffsets(garment);
  Garment whole = garment;
  whole.trims.clear();
  std::vector<double> kept = controlAreas(garment);
  const std::vector<double> all = controlAreas(whole);
  // A point that several patches share has what all of them keep.
  const std::vector<int> owners = sharedOwners(garment);
  for (std::size_t c = 0; c < kept.size(); ++c)
    if (owners[c] != static_cast<int>(c)) kept[owners[c]] += kept[c];
  for (std::size_t c = 0; c < kept.size(); ++c) kept[c] = kept[owners[c]];
  std::vector<char> used(kept.size(), 1);
  for (std::size_t p = 0; p < garment.patches.size(); ++p)
    if (!garment.trims[p].loops.empty())
      for (int c = offsets[p]; c < offsets[p + 1]; ++c)
        used[c] = kept[c] > 0 && kept[c] >= garment.trims[p].unused_fraction * all[c];
  checkSeams(garment, used);
  for (int p = 0; p < static_cast<int>(garment.patches.size()); ++p) {
    if (garment.trims[p].loops.empty()) continue;
    const NurbsPatch& patch = garment.patches[p];
    const Followers followers(patch, {used.begin() + offsets[p], used.begin() + offsets[p + 1]});
    for (int j = 0; j < patch.v.count(); ++j)
      for (int i = 0; i < patch.u.count(); ++i) {
        const int control = offsets[p] + patch.index(i, j);
        if (used[control]) continue;
        TrimFollower f;
        f.patch = p;
        f.supported = kept[control] > 0;
        // Without any support the point matters to nobody: a plane is enough.
        std::map<int, double> c;
        for (int d = f.supported ? std::max(patch.u.degree, patch.v.degree) : 1; d >= 1; --d) {
          c = followers.prior(i, j, d);
          double load = 0;
          for (const auto& [at, e] : c) load = std::max(load, e * e * kept[control] / kept[offsets[p] + at]);
          if (load <= kHeaviest) break;
        }
        const InputError::Where where{"", 0, "trims[" + std::to_string(p) + "]"};
        if (c.empty()) throw InputError(where, "leaves no control point of the patch with enough support");
        if (f.supported && !followers.correct(i, j, c))
          throw InputError(where, "control point (" + std::to_string(i) + ", " + std::to_string(j) +
                                      ") keeps too little support to be free, and the rest positions of its neighbours "
                                      "do not determine its own; refine the patch there");
        double sum = 0;
        for (const auto& entry : c) sum += entry.second;
        for (const auto& [at, e] : c)
          if (e != 0) f.of.push_back({offsets[p] + at, f.supported ? e : e / sum});
        out.emplace(control, std::move(f));
      }
  }
  return out;
}

}  // namespace gambeson
