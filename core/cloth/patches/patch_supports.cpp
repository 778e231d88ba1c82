#include "core/cloth/patches/patch_supports.hpp"

#include <algorithm>
#include <cmath>

#include "core/cloth/draft/edge.hpp"
#include "core/cloth/draft/seams.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

[[noreturn]] void reject(const std::string& name, const std::string& reason) {
  throw InputError({"", 0, name}, reason);
}

/// The control points of an edge, in the patch's own order, that trimming leaves.
std::vector<int> keptRow(const Garment& garment, const PatchEdge& edge) {
  const EdgeColumns rows = edgeColumns(garment, {edge.patch, edge.side});
  const std::vector<bool> kept = keptControls(garment, edge);
  std::vector<int> out;
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (kept[i]) out.push_back(rows.edge[i]);
  return out;
}

/// Rest geometry across an edge at one of its points.
struct EdgeFrame {
  EdgeBasis basis;
  std::vector<double> across;  ///< row of x,c - k x,t, scaled so that it is about 1 on the row next to the edge
  Vec3 along, inward, normal;  ///< X,t; X,c; n (zero where the edge is degenerate)
  double k = 0;
};

EdgeFrame edgeFrame(const Garment& garment, const PatchEdge& edge, double t, const std::vector<Vec3>& Q) {
  EdgeFrame f;
  f.basis = edgeBasis(garment, edge, t);
  f.along = combine(f.basis.columns, f.basis.along, Q);
  f.inward = combine(f.basis.columns, f.basis.inward, Q);
  const Vec3 n = cross(f.along, f.inward);
  const bool regular = norm(n) > 1e-9 * (norm2(f.along) + norm2(f.inward));
  if (regular) f.normal = normalized(n);
  if (norm(f.along) > 0) f.k = dot(f.inward, f.along) / norm2(f.along);
  double scale = 0;
  for (double v : f.basis.inward) scale += 0.5 * std::abs(v);
  for (std::size_t i = 0; i < f.basis.columns.size(); ++i) {
    const double v = (f.basis.inward[i] - f.k * f.basis.along[i]) / scale;
    f.across.push_back(std::abs(v) > 1e-13 ? v : 0);
  }
  return f;
}

std::vector<EdgeFrame> edgeFrames(const Garment& garment, const PatchEdge& edge) {
  const std::vector<Vec3> Q = restControls(garment);
  std::vector<EdgeFrame> frames;
  for (double t : grevillePoints(alongKnots(garment.patches[edge.patch], edge.side)))
    frames.push_back(edgeFrame(garment, edge, t, Q));
  return frames;
}

double weightOf(const Garment& garment, const PatchEdge& edge, int control) {
  return garment.patches[edge.patch].weights[control - controlOffsets(garment)[edge.patch]];
}

/// Whether x,c is the same multiple of the differences q_inner - q_edge for all points of the edge: the two rows have
/// one ratio of weights.
bool rowsMatch(const Garment& garment, const PatchEdge& edge, const EdgeColumns& rows) {
  const double first = weightOf(garment, edge, rows.inner[0]) / weightOf(garment, edge, rows.edge[0]);
  for (std::size_t i = 1; i < rows.edge.size(); ++i) {
    const double ratio = weightOf(garment, edge, rows.inner[i]) / weightOf(garment, edge, rows.edge[i]);
    if (std::abs(ratio - first) > 1e-12 * first) return false;
  }
  return true;
}

/// X,c is normal to the edge all along, so that k = 0.
bool rightAngles(const std::vector<EdgeFrame>& frames) {
  return std::all_of(frames.begin(), frames.end(),
                     [](const EdgeFrame& f) { return std::abs(f.k) * norm(f.along) <= 1e-12 * norm(f.inward); });
}

/// d . (x,c - k x,t) keeps its rest value at every frame: point by point where that says the same, at the frames
/// otherwise. `direction(i)` is d at frame i, zero to leave the frame out.
template <class F>
void keepAcross(const Garment& garment, const PatchEdge& edge, const std::vector<EdgeFrame>& frames, bool constant,
                const std::string& name, F&& direction, std::vector<LinearConstraint>& out) {
  const EdgeColumns rows = edgeColumns(garment, {edge.patch, edge.side});
  const bool by_points = constant && rightAngles(frames) && rowsMatch(garment, edge, rows);
  const std::vector<bool> kept = keptControls(garment, edge);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Vec3 d = direction(i);
    if (!kept[i] || norm2(d) == 0) continue;
    LinearConstraint c = supportEquation(name, d, {});
    if (by_points) {
      c.terms = {{rows.inner[i], d}, {rows.edge[i], -d}};
    } else {
      for (std::size_t k = 0; k < frames[i].across.size(); ++k)
        if (frames[i].across[k] != 0) c.terms.emplace_back(frames[i].basis.columns[k], frames[i].across[k] * d);
    }
    out.push_back(std::move(c));
  }
}

}  // namespace

std::vector<LinearConstraint> supportEdge(const Garment& garment, const PatchEdge& edge,
                                          std::span<const Vec3> directions, const Prescribed& motion) {
  const std::string name = "support of " + edgeName(edge);
  checkEdge(garment, edge, name);
  checkSupport(name, directions, motion);
  std::vector<LinearConstraint> out;
  const std::vector<int> row = keptRow(garment, edge);
  for (const Vec3& d : directions) {
    for (int control : row) {
      out.push_back(supportEquation(name, d, motion));
      out.back().terms = {{control, d}};
    }
  }
  return out;
}

std::vector<LinearConstraint> supportPoint(const Garment& garment, int patch, Vec2 uv, std::span<const Vec3> directions,
                                           const Prescribed& motion) {
  const std::string name = "support of a point of patch " + std::to_string(patch);
  checkPoint(garment, patch, uv, name);
  checkSupport(name, directions, motion);
  const SurfaceBasis basis = surfaceBasis(garment.patches[patch], uv.x, uv.y);
  const int offset = controlOffsets(garment)[patch];
  std::vector<LinearConstraint> out;
  for (const Vec3& d : directions) {
    out.push_back(supportEquation(name, d, motion));
    for (std::size_t k = 0; k < basis.columns.size(); ++k)
      if (std::abs(basis.values[0][k]) > 1e-14)
        out.back().terms.emplace_back(offset + basis.columns[k], basis.values[0][k] * d);
  }
  return out;
}

std::vector<LinearConstraint> clampRotation(const Garment& garment, const PatchEdge& edge) {
  const std::string name = "clamp of " + edgeName(edge);
  checkEdge(garment, edge, name);
  const std::vector<EdgeFrame> frames = edgeFrames(garment, edge);
  const auto regular = [](const EdgeFrame& f) { return norm2(f.normal) > 0; };
  const auto first = std::find_if(frames.begin(), frames.end(), regular);
  if (first == frames.end()) reject(name, "the rest surface has no normal along the edge");
  const bool constant = std::all_of(frames.begin(), frames.end(), [&](const EdgeFrame& f) {
    return regular(f) && norm(f.normal - first->normal) <= 1e-12;
  });
  std::vector<LinearConstraint> out;
  keepAcross(
      garment, edge, frames, constant, name, [&](std::size_t i) { return constant ? first->normal : frames[i].normal; },
      out);
  return out;
}

std::vector<LinearConstraint> symmetryEdge(const Garment& garment, const PatchEdge& edge, const Vec3& normal) {
  const std::string name = "symmetry of " + edgeName(edge);
  checkEdge(garment, edge, name);
  checkSupport(name, std::span(&normal, 1), {});
  const std::vector<Vec3> Q = restControls(garment);
  const EdgeColumns rows = edgeColumns(garment, edge);
  double length = 0;
  for (std::size_t i = 1; i < rows.edge.size(); ++i) length += norm(Q[rows.edge[i]] - Q[rows.edge[i - 1]]);
  for (int control : rows.edge)
    if (!(std::abs(dot(normal, Q[control] - Q[rows.edge[0]])) <= 1e-6 * length))
      reject(name, "the edge does not lie in a plane with this normal");
  const std::vector<EdgeFrame> frames = edgeFrames(garment, edge);
  for (const EdgeFrame& f : frames)
    if (std::abs(dot(normal, f.normal)) > 1e-4)
      reject(name, "the rest surface does not meet the plane at right angles");

  std::vector<LinearConstraint> out = supportEdge(garment, edge, std::span(&normal, 1));
  for (LinearConstraint& c : out) c.name = name;
  const Vec3 e = std::abs(normal.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 first = normalized(e - dot(e, normal) * normal), second = cross(normal, first);
  for (const Vec3& d : {first, second})
    keepAcross(
        garment, edge, frames, true, name, [&](std::size_t) { return d; }, out);
  return out;
}

std::vector<LinearConstraint> tieEdge(const Garment& garment, const PatchEdge& edge, const Vec3& direction) {
  const std::string name = "tie of " + edgeName(edge);
  checkEdge(garment, edge, name);
  checkSupport(name, std::span(&direction, 1), {});
  const std::vector<int> row = keptRow(garment, edge);
  std::vector<LinearConstraint> out;
  for (std::size_t i = 1; i < row.size(); ++i) {
    out.push_back(supportEquation(name, direction, {}));
    out.back().terms = {{row[i], direction}, {row[0], -direction}};
  }
  return out;
}

}  // namespace gambeson
