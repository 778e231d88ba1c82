#include "human/body/skin.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/error.hpp"
#include "core/math/parallel.hpp"

/// How the skin follows the links. A vertex turns about each of its joints by its share of the joint's rotation since
/// the bind posture, distal joints first; then creases keep the two sides of a joint apart.
///
/// The inside of a fold: with psi = 1 - 2 share running from 0 on the plane to 1 a half-width away, a point at distance
/// s from the plane and r above the axis comes to
///   s' = s cos(psi theta/2) - r sin(psi theta/2)
/// from the bisecting plane, so the skin does not overtake itself where psi'(0) r theta/2 < 1: half-widths are chosen
/// above 1.25 r theta/2 for the bends that bodies make (hip 95, knee 110, elbow 115 degrees).
///
/// A crease: with the distance d of a point from the bisecting plane, counted into its own side,
///   d' = d                          for u = (d - h)/b - 1 >= 0,
///   d' = h + b / (1 - u + u²)       for u < 0,        h = S gap/2,  b = S (softness),
/// S growing from 0 at rest to 1 at a bend of 30 degrees. d -> d' is C² and strictly increasing, d' > h: a surface that
/// does not cross itself does not by being flattened either; at rest nothing moves.

namespace gambeson {
namespace {

constexpr double kSoftness = 0.005;    ///< b [m]: the flattening begins about this far off the plane
constexpr double kFullSine2 = 0.0670;  ///< sin²(15 degrees)

struct Quaternion {
  double w = 1;
  Vec3 v;
};

/// Of a rotation by less than 180 degrees (Shepperd's other cases are not met by joints of a body but kept for safety).
Quaternion quaternion(const Mat3& m) {
  const double trace = m.a.x + m.b.y + m.c.z;
  Quaternion q;
  if (trace > 0) {
    const double s = 2 * std::sqrt(1 + trace);
    q = {0.25 * s, {(m.b.z - m.c.y) / s, (m.c.x - m.a.z) / s, (m.a.y - m.b.x) / s}};
  } else if (m.a.x >= m.b.y && m.a.x >= m.c.z) {
    const double s = 2 * std::sqrt(std::max(0.0, 1 + m.a.x - m.b.y - m.c.z));
    q = {(m.b.z - m.c.y) / s, {0.25 * s, (m.b.x + m.a.y) / s, (m.c.x + m.a.z) / s}};
  } else if (m.b.y >= m.c.z) {
    const double s = 2 * std::sqrt(std::max(0.0, 1 + m.b.y - m.a.x - m.c.z));
    q = {(m.c.x - m.a.z) / s, {(m.b.x + m.a.y) / s, 0.25 * s, (m.c.y + m.b.z) / s}};
  } else {
    const double s = 2 * std::sqrt(std::max(0.0, 1 + m.c.z - m.a.x - m.b.y));
    q = {(m.a.y - m.b.x) / s, {(m.c.x + m.a.z) / s, (m.c.y + m.b.z) / s, 0.25 * s}};
  }
  if (q.w < 0) q = {-q.w, -q.v};
  return q;
}

/// The w-th part of a rotation, by normalised linear interpolation: exact at 0, 1/2 and 1.
Quaternion part(const Quaternion& q, double w) {
  const double r = 1 - w + w * q.w;
  const double n = 1 / std::sqrt(r * r + w * w * norm2(q.v));
  return {r * n, (w * n) * q.v};
}

Vec3 turned(const Quaternion& q, const Vec3& p) {
  const Vec3 t = 2 * cross(q.v, p);
  return p + q.w * t + cross(q.v, t);
}

/// Vertices of one run that are moved together, coordinate by coordinate, so that the loops become vector code.
constexpr int kBlock = 128;
struct Block {
  const SkinRun* run;
  int begin, end;
};

void bendBlock(const Skin& skin, const std::vector<Quaternion>& turn, const Pose& move, const Block& block,
               std::span<Vec3> x) {
  const SkinRun& run = *block.run;
  const int n = block.end - block.begin;
  double px[kBlock], py[kBlock], pz[kBlock];
  for (int i = 0; i < n; ++i) {
    const Vec3& p = skin.rest.vertices[block.begin + i];
    px[i] = p.x;
    py[i] = p.y;
    pz[i] = p.z;
  }
  const auto rigid = [&](const Pose& X) {
    const Mat3 R = X.rotation;
    const Vec3 o = X.origin;
#pragma omp simd
    for (int i = 0; i < n; ++i) {
      const double a = px[i], b = py[i], c = pz[i];
      px[i] = a * R.a.x + b * R.b.x + c * R.c.x + o.x;
      py[i] = a * R.a.y + b * R.b.y + c * R.c.y + o.y;
      pz[i] = a * R.a.z + b * R.b.z + c * R.c.z + o.z;
    }
  };
  Pose pending;  // turns of share 1, not yet done
  bool waiting = false;
  const double* share = run.share.data() + (block.begin - run.begin);
  for (std::size_t k = 0; k < run.bends.size(); ++k) {
    const Vec3 c = skin.bends[run.bends[k]].centre;
    const Quaternion q = turn[run.bends[k]];
    if (!run.partial[k]) {
      const Mat3 R{turned(q, {1, 0, 0}), turned(q, {0, 1, 0}), turned(q, {0, 0, 1})};
      pending = Pose{R, c - R * c} * pending;
      waiting = true;
      continue;
    }
    if (waiting) rigid(pending);
    pending = {};
    waiting = false;
    const double v2 = norm2(q.v);
#pragma omp simd
    for (int i = 0; i < n; ++i) {
      // part() and turned(), written out.
      const double w = share[i], r = 1 - w + w * q.w, s = 1 / std::sqrt(r * r + w * w * v2), qw = r * s, f = w * s;
      const double vx = f * q.v.x, vy = f * q.v.y, vz = f * q.v.z;
      const double a = px[i] - c.x, b = py[i] - c.y, d = pz[i] - c.z;
      const double tx = 2 * (vy * d - vz * b), ty = 2 * (vz * a - vx * d), tz = 2 * (vx * b - vy * a);
      px[i] += qw * tx + (vy * tz - vz * ty);
      py[i] += qw * ty + (vz * tx - vx * tz);
      pz[i] += qw * tz + (vx * ty - vy * tx);
    }
    share += run.end - run.begin;
  }
  rigid(move * pending);
  for (int i = 0; i < n; ++i) x[block.begin + i] = {px[i], py[i], pz[i]};
}

void blendLinearly(const Skin& skin, std::span<const Pose> X_WL, std::span<Vec3> x) {
  std::vector<Pose> move(X_WL.size());
  for (std::size_t l = 0; l < move.size(); ++l) move[l] = X_WL[l] * inverse(skin.bind[l]);
  const int n = static_cast<int>(x.size());
  forAll(Each::much, n, [&](int v) {
    Vec3 sum;
    for (int i = skin.first[v]; i < skin.first[v + 1]; ++i)
      sum += skin.weight[i] * (move[skin.link[i]] * skin.rest.vertices[v]);
    x[v] = sum;
  });
}

}  // namespace

void skinPositions(const Skin& skin, std::span<const Pose> X_WL, std::span<Vec3> x) {
  if (X_WL.size() != skin.bind.size() || x.size() != skin.rest.vertices.size())
    throw RunError("skinPositions: " + std::to_string(X_WL.size()) + " links and " + std::to_string(x.size()) +
                   " vertices instead of " + std::to_string(skin.bind.size()) + " and " +
                   std::to_string(skin.rest.vertices.size()));
  if (skin.bends.empty()) return blendLinearly(skin, X_WL, x);

  const int nb = static_cast<int>(skin.bends.size());
  std::vector<Quaternion> turn(nb);
  for (int b = 0; b < nb; ++b) {
    const SkinBend& bend = skin.bends[b];
    const Mat3 parent = X_WL[bend.parent].rotation * transpose(skin.bind[bend.parent].rotation),
               child = X_WL[bend.child].rotation * transpose(skin.bind[bend.child].rotation);
    turn[b] = quaternion(transpose(parent) * child);
  }
  const Pose move = X_WL[0] * inverse(skin.bind[0]);
  std::vector<Block> blocks;
  for (const SkinRun& run : skin.runs)
    for (int begin = run.begin; begin < run.end; begin += kBlock)
      blocks.push_back({&run, begin, std::min(begin + kBlock, run.end)});
  const int nblocks = static_cast<int>(blocks.size());
  forAll(Each::much, nblocks, [&](int i) { bendBlock(skin, turn, move, blocks[i], x); });

  for (const SkinCrease& crease : skin.creases) {
    const SkinBend& bend = skin.bends[crease.bend];
    const double bent = std::clamp(norm2(turn[crease.bend].v) / kFullSine2, 0.0, 1.0), S = bent * bent * (3 - 2 * bent);
    if (S == 0) continue;
    const Pose A = X_WL[bend.parent] * inverse(skin.bind[bend.parent]);
    const Vec3 normal = A.rotation * turned(part(turn[crease.bend], 0.5), bend.normal);
    const double level = dot(normal, A * bend.centre) + bend.offset_m, h = 0.5 * S * skin.crease_gap_m,
                 b = S * kSoftness;
    const int count = static_cast<int>(crease.vertex.size());
    forAll(Each::much, count, [&](int i) {
      Vec3& p = x[crease.vertex[i]];
      const double side = crease.side[i], d = side * (dot(normal, p) - level) - h, u = d / b - 1;
      if (u < 0) p += (crease.strength[i] * side * (b / (1 - u + u * u) - d)) * normal;
    });
  }
}

}  // namespace gambeson
