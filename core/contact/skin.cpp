#include "core/contact/skin.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/contact/skin_bend.hpp"
#include "core/error.hpp"
#include "core/math/parallel.hpp"

namespace gambeson {
namespace {

using namespace skin_bend;

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
    for (int i = 0; i < n; ++i) moveRigidly(R, o, px[i], py[i], pz[i]);
  };
  Pose pending;  // turns of share 1, not yet done
  bool waiting = false;
  const double* share = run.share.data() + (block.begin - run.begin);
  for (std::size_t k = 0; k < run.bends.size(); ++k) {
    const Vec3 c = skin.bends[run.bends[k]].centre;
    const Quaternion q = turn[run.bends[k]];
    if (!run.partial[k]) {
      pending = wholeTurn(q, c) * pending;
      waiting = true;
      continue;
    }
    if (waiting) rigid(pending);
    pending = {};
    waiting = false;
    const double v2 = norm2(q.v);
#pragma omp simd
    for (int i = 0; i < n; ++i) turnPartly(q, v2, c, share[i], px[i], py[i], pz[i]);
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
    turn[b] = turnOf(X_WL[bend.parent], skin.bind[bend.parent], X_WL[bend.child], skin.bind[bend.child]);
  }
  const Pose move = X_WL[0] * inverse(skin.bind[0]);
  std::vector<Block> blocks;
  for (const SkinRun& run : skin.runs)
    for (int begin = run.begin; begin < run.end; begin += kBlock)
      blocks.push_back({&run, begin, std::min(begin + kBlock, run.end)});
  const int nblocks = static_cast<int>(blocks.size());
  forAll(Each::much, nblocks, [&](int i) { bendBlock(skin, turn, move, blocks[i], x); });

  for (const SkinCrease& along : skin.creases) {
    const SkinBend& bend = skin.bends[along.bend];
    const Crease plane = creaseOf(turn[along.bend], X_WL[bend.parent], skin.bind[bend.parent], bend.centre, bend.normal,
                                  bend.offset_m, skin.crease_gap_m);
    if (!plane.folds) continue;
    const int count = static_cast<int>(along.vertex.size());
    forAll(Each::much, count, [&](int i) { crease(plane, along.side[i], along.strength[i], x[along.vertex[i]]); });
  }
}

}  // namespace gambeson
