#include "tryon/stitching.hpp"

#include <Eigen/SparseCholesky>
#include <limits>

#include "core/error.hpp"

namespace gambeson {
namespace {

/// Mean of the normals over the area of a patch, at the middle points of 32 x 32 parts of its parameters.
Vec3 meanNormal(const NurbsPatch& patch) {
  constexpr int n = 32;
  Vec3 sum{};
  double area = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const auto at = [&](const KnotVector& k, int part) {
        return k.front() + (part + 0.5) / n * (k.back() - k.front());
      };
      const auto d = surfaceDerivatives(patch, at(patch.u, i), at(patch.v, j));
      const Vec3 a = cross(d[1], d[2]);
      sum += a;
      area += norm(a);
    }
  return sum / area;
}

}  // namespace

Garment unsewn(const Garment& garment) {
  Garment open = garment;
  open.seams.clear();
  open.weak_seams.clear();
  open.sewn_seams.clear();
  return open;
}

std::vector<Vec3> panelOffsets(const Garment& garment, double distance_m, double facing) {
  std::vector<Vec3> offsets;
  for (const NurbsPatch& patch : garment.patches) {
    const Vec3 mean = meanNormal(patch);
    offsets.push_back(norm(mean) < facing ? Vec3{} : distance_m * normalized(mean));
  }
  return offsets;
}

std::vector<Stitch> stitchesOf(const Garment& garment, const Cloth& cloth, const Surface& surface,
                               const StitchLaw& law) {
  std::vector<Vec3> X(static_cast<std::size_t>(surface.size()));
  surface.W.multiply<Vec3>(cloth.rest(), X);
  std::vector<Stitch> stitches;
  const auto join = [&](const PatchEdge& a, const PatchEdge& b) {
    const std::vector<int> from = edgeSamples(surface, a), to = edgeSamples(surface, b);
    for (std::size_t k = 0; k < from.size(); ++k) {
      double length = 0;
      if (k > 0) length += 0.5 * norm(X[from[k]] - X[from[k - 1]]);
      if (k + 1 < from.size()) length += 0.5 * norm(X[from[k + 1]] - X[from[k]]);
      int nearest = -1;
      double least = std::numeric_limits<double>::infinity();
      for (int t : to)
        if (const double d = norm2(X[t] - X[from[k]]); d < least) least = d, nearest = t;
      if (nearest != from[k])
        stitches.push_back({from[k], nearest, law.stiffness_N_per_m2 * length, law.damping_kg_per_m_s * length});
    }
  };
  for (const Seam& s : garment.seams) join(s.a, s.b);
  for (const WeakSeam& s : garment.weak_seams) join(s.a, s.b);
  return stitches;
}

std::vector<Vec3> sew(const FreeMap& sewn, std::span<const Vec3> q) {
  using Matrix = Eigen::SparseMatrix<double>;
  const SparseRows& T = sewn.T;
  const int rows = static_cast<int>(q.size()), columns = T.column_count;
  std::vector<Eigen::Triplet<double>> entries;
  for (int r = 0; r < rows; ++r)
    for (int k = T.offsets[r]; k < T.offsets[r + 1]; ++k) entries.emplace_back(r, T.columns[k], T.values[k]);
  Matrix t(rows, columns);
  t.setFromTriplets(entries.begin(), entries.end());
  Eigen::MatrixXd right(rows, 3);
  for (int r = 0; r < rows; ++r) right.row(r) << q[r].x, q[r].y, q[r].z;
  const Eigen::SimplicialLDLT<Matrix> factor(t.transpose() * t);
  if (factor.info() != Eigen::Success) throw RunError("the seams leave a control point without a place");
  const Eigen::MatrixXd p = factor.solve(t.transpose() * right);
  std::vector<Vec3> out;
  for (int i = 0; i < columns; ++i) out.push_back({p(i, 0), p(i, 1), p(i, 2)});
  return out;
}

}  // namespace gambeson
