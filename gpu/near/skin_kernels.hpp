#pragma once
/// The skin at a window of times: what joints have turned by, what that does to each run of vertices and to creases,
/// then each vertex by itself.

#include "core/contact/skin_bend.hpp"
#include "gpu/near/uploaded.hpp"

namespace gambeson::gpu {

struct FlatBend {
  int parent, child;
  Vec3 centre, normal;
  double offset_m;
};
/// Vertices [begin, end) with bends [first_bend, last_bend), whose motions between bends with shares below 1 stand from
/// first_motion on.
struct FlatRun {
  int begin, end, first_bend, last_bend, first_motion, first_share;
};
struct RunBend {
  int bend;
  bool partial;
};
/// What moves a run before a bend with shares below 1, or after the last: turns of share 1, in one.
struct RunMotion {
  Pose pose;
  bool moves;
};
struct VertexCrease {
  int crease;
  double side, strength;
};

/// A skin by where its arrays lie.
struct SkinView {
  int links = 0, vertices = 0, bends = 0, runs = 0, creases = 0, motions = 0;
  double crease_gap_m = 0;
  const Vec3* rest = nullptr;
  const Pose* bind = nullptr;
  const FlatBend* bend = nullptr;
  const FlatRun* run = nullptr;
  const RunBend* run_bend = nullptr;
  const double* share = nullptr;
  const int* run_of_vertex = nullptr;
  const int* crease_bend = nullptr;
  const int* first_crease = nullptr;  ///< of each vertex
  const VertexCrease* vertex_crease = nullptr;
  // Without bends: links of each vertex.
  const int* first_link = nullptr;
  const int* link = nullptr;
  const double* weight = nullptr;
};
/// Of each time, one after the other.
struct SkinMotion {
  const Pose* poses;
  skin_bend::Quaternion* turn;
  RunMotion* motion;
  skin_bend::Crease* crease;
  Pose* move;  ///< of links, without bends
  Vec3* x;
};

/// Of each time and bend, or link where there are no bends.
struct TurnJoints {
  SkinView skin;
  SkinMotion of;
  GAMBESON_HD void operator()(int i) const {
    if (skin.bends == 0) {
      of.move[i] = skin_bend::composed(of.poses[i], skin_bend::inverted(skin.bind[i % skin.links]));
      return;
    }
    const Pose* poses = of.poses + i / skin.bends * skin.links;
    const FlatBend& b = skin.bend[i % skin.bends];
    of.turn[i] = skin_bend::turnOf(poses[b.parent], skin.bind[b.parent], poses[b.child], skin.bind[b.child]);
  }
};

/// Of each time, its runs and creases.
struct MoveRuns {
  SkinView skin;
  SkinMotion of;
  GAMBESON_HD void operator()(int i) const {
    const int each = skin.runs + skin.creases, time = i / each, k = i % each;
    const Pose* poses = of.poses + time * skin.links;
    const skin_bend::Quaternion* turn = of.turn + time * skin.bends;
    if (k >= skin.runs) {
      const int bend = skin.crease_bend[k - skin.runs];
      const FlatBend& b = skin.bend[bend];
      of.crease[time * skin.creases + k - skin.runs] = skin_bend::creaseOf(
          turn[bend], poses[b.parent], skin.bind[b.parent], b.centre, b.normal, b.offset_m, skin.crease_gap_m);
      return;
    }
    const FlatRun& run = skin.run[k];
    RunMotion* out = of.motion + time * skin.motions + run.first_motion;
    RunMotion pending{{}, false};
    for (int j = run.first_bend; j < run.last_bend; ++j) {
      const RunBend& b = skin.run_bend[j];
      if (b.partial) {
        *out++ = pending;
        pending = {{}, false};
      } else {
        pending = {skin_bend::composed(skin_bend::wholeTurn(turn[b.bend], skin.bend[b.bend].centre), pending.pose),
                   true};
      }
    }
    const Pose move = skin_bend::composed(poses[0], skin_bend::inverted(skin.bind[0]));
    *out = {skin_bend::composed(move, pending.pose), true};
  }
};

/// Of each time and vertex.
struct MoveVertices {
  SkinView skin;
  SkinMotion of;
  GAMBESON_HD void operator()(int i) const {
    const int time = i / skin.vertices, v = i % skin.vertices;
    Vec3 p = skin.rest[v];
    if (skin.bends == 0) {
      Vec3 sum;
      for (int k = skin.first_link[v]; k < skin.first_link[v + 1]; ++k)
        sum += skin.weight[k] * skin_bend::moved(of.move[time * skin.links + skin.link[k]], p);
      of.x[i] = sum;
      return;
    }
    const FlatRun& run = skin.run[skin.run_of_vertex[v]];
    const skin_bend::Quaternion* turn = of.turn + time * skin.bends;
    const RunMotion* motion = of.motion + time * skin.motions + run.first_motion;
    const double* share = skin.share + run.first_share + (v - run.begin);
    for (int j = run.first_bend; j < run.last_bend; ++j) {
      const RunBend& b = skin.run_bend[j];
      if (!b.partial) continue;
      if (motion->moves) skin_bend::moveRigidly(motion->pose.rotation, motion->pose.origin, p.x, p.y, p.z);
      ++motion;
      const skin_bend::Quaternion& q = turn[b.bend];
      skin_bend::turnPartly(q, norm2(q.v), skin.bend[b.bend].centre, *share, p.x, p.y, p.z);
      share += run.end - run.begin;
    }
    skin_bend::moveRigidly(motion->pose.rotation, motion->pose.origin, p.x, p.y, p.z);
    for (int k = skin.first_crease[v]; k < skin.first_crease[v + 1]; ++k) {
      const VertexCrease& c = skin.vertex_crease[k];
      const skin_bend::Crease& plane = of.crease[time * skin.creases + c.crease];
      if (plane.folds) skin_bend::crease(plane, c.side, c.strength, p);
    }
    of.x[i] = p;
  }
};

}  // namespace gambeson::gpu
