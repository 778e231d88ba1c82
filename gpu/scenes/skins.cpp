/// Detail of skins.hpp.
#include "gpu/scenes/skins.hpp"

#include <algorithm>

#include "gpu/scenes/turns.hpp"

namespace gambeson::gpu {
namespace {

constexpr double kLength_m = 0.6, kRadius_m = 0.05, kBand_m = 0.05;
constexpr double kJoint_m[2] = {0.4, 0.2};  ///< the distal one first

/// From 0 to 1 across a joint.
double shareAt(int bend, double z) {
  const double t = std::clamp((z - kJoint_m[bend]) / (2 * kBand_m) + 0.5, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace

Skin tubeSkin(int around, int along) {
  Skin skin;
  skin.bind.resize(3);
  skin.bind[1].origin = {0, 0, kJoint_m[1]};
  skin.bind[2] = {turnBy({0, 0, 1}, 0.3), {0, 0, kJoint_m[0]}};
  for (int k = 0; k < 2; ++k) {
    SkinBend bend;
    bend.parent = 1 - k, bend.child = 2 - k;
    bend.centre = {0.01 * k, 0.005, kJoint_m[k]};
    bend.normal = {0, 0, 1};
    bend.offset_m = 1e-3 * k;
    bend.crease = true;
    skin.bends.push_back(bend);
  }
  skin.crease_gap_m = 4e-3;
  skin.creases.resize(2);
  skin.creases[1].bend = 1;
  for (int j = 0; j < along; ++j) {
    const double z = kLength_m * j / (along - 1);
    for (int i = 0; i < around; ++i) {
      // Around a square whose corners are pulled in.
      const double turn = 4.0 * i / around, at = turn - std::floor(turn);
      const Vec3 side[4] = {{1, 2 * at - 1, 0}, {1 - 2 * at, 1, 0}, {-1, 1 - 2 * at, 0}, {2 * at - 1, -1, 0}};
      const int v = static_cast<int>(skin.rest.vertices.size());
      skin.rest.vertices.push_back(kRadius_m * normalized(side[std::min(3, static_cast<int>(turn))]) + Vec3{0, 0, z});
      for (int k = 0; k < 2; ++k)
        if (const double off = z - kJoint_m[k]; std::abs(off) < 0.04) {
          SkinCrease& c = skin.creases[k];
          c.vertex.push_back(v);
          c.side.push_back(off < 0 ? -1 : 1);
          c.strength.push_back(0.25 + 0.75 * (i % 4) / 3);
        }
    }
  }
  for (int j = 0; j + 1 < along; ++j)
    for (int i = 0; i < around; ++i) {
      const int a = i + around * j, b = (i + 1) % around + around * j;
      skin.rest.triangles.push_back({a, b, b + around});
      skin.rest.triangles.push_back({a, b + around, a + around});
    }
  // Rings of vertices that turn about the same bends.
  for (int j = 0; j < along; ++j) {
    const double z = kLength_m * j / (along - 1);
    SkinRun run;
    run.begin = around * j, run.end = around * (j + 1);
    for (int k = 0; k < 2; ++k) {
      const double share = shareAt(k, z);
      if (share == 0) continue;
      run.bends.push_back(k);
      run.partial.push_back(share < 1);
      if (share < 1)
        for (int i = 0; i < around; ++i) run.share.push_back(share * (1 - 1e-3 * (i % 3)));
    }
    const bool same = !skin.runs.empty() && skin.runs.back().bends == run.bends &&
                      skin.runs.back().partial == run.partial && run.share.empty();
    if (same)
      skin.runs.back().end = run.end;
    else
      skin.runs.push_back(run);
  }
  return skin;
}

Skin blendedTube(int around, int along) {
  Skin skin = tubeSkin(around, along);
  skin.bends.clear(), skin.runs.clear(), skin.creases.clear();
  skin.first = {0};
  for (const Vec3& p : skin.rest.vertices) {
    const double outer = shareAt(0, p.z), inner = shareAt(1, p.z);
    const double weight[3] = {1 - inner, inner - outer, outer};
    for (int l = 0; l < 3; ++l)
      if (weight[l] > 0) skin.link.push_back(l), skin.weight.push_back(weight[l]);
    skin.first.push_back(static_cast<int>(skin.link.size()));
  }
  return skin;
}

std::vector<Pose> tubePoses(const Skin& skin, int times) {
  std::vector<Pose> poses;
  for (int k = 0; k < times; ++k) {
    const double t = times > 1 ? static_cast<double>(k) / (times - 1) : 1;
    const Pose root{turnBy({0.2, 1, 0.1}, 0.2 * t), {0.1 * t, 0, 0.05 * t}};
    poses.push_back(root * skin.bind[0]);
    Pose above = root;
    for (int l = 1; l < 3; ++l) {
      // About the joint, away from where it is bound.
      const Vec3 joint = skin.bind[static_cast<std::size_t>(l)].origin;
      const Mat3 turn = turnBy({1, 0.2 * t, l == 1 ? 0.1 : -0.3}, 1.2 * t * (l == 1 ? 1 : -0.7));
      above = above * Pose{turn, joint - turn * joint};
      poses.push_back(above * skin.bind[static_cast<std::size_t>(l)]);
    }
  }
  return poses;
}

}  // namespace gambeson::gpu
