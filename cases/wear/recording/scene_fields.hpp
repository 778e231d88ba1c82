#pragma once
/// What a recording holds of the structs of a scene. Bindings name all members of a struct: one that gets another
/// member does not compile here until it is told whether that is recorded.

#include "cases/wear/recording/archive.hpp"
#include "cases/wear/recording/recorded_motion.hpp"
#include "human/body/bridged_folds.hpp"
#include "human/body/mesh_sequence.hpp"
#include "human/body/skin.hpp"

namespace gambeson {

// --- Geometry ---------------------------------------------------------------------------------------------------

template <class A, Of<Vec2> T>
void fields(A& a, T& v) {
  a.items(v.x, v.y);
}
template <class A, Of<Vec3> T>
void fields(A& a, T& v) {
  a.items(v.x, v.y, v.z);
}
template <class A, Of<Mat3> T>
void fields(A& a, T& m) {
  a.items(m.a, m.b, m.c);
}
template <class A, Of<Pose> T>
void fields(A& a, T& X) {
  a.items(X.rotation, X.origin);
}
template <class A, Of<Placement> T>
void fields(A& a, T& X) {
  a.items(X.rotation, X.origin, X.scale);
}
template <class A, Of<Ellipsoid> T>
void fields(A& a, T& e) {
  a("semi_axes", e.semi_axes);
}
template <class A, Of<TriangleMesh> T>
void fields(A& a, T& m) {
  auto& [vertices, triangles] = m;
  a("vertices", vertices)("triangles", triangles);
}

// --- The human ----------------------------------------------------------------------------------------------------

template <class A, Of<Joint> T>
void fields(A& a, T& j) {
  auto& [name, type, parent, child, X_PJ, axis, lower, upper, mimic_of, multiplier, offset] = j;
  a("name", name)("type", type)("parent", parent)("child", child)("X_PJ", X_PJ)("axis", axis)("lower", lower);
  a("upper", upper)("mimic_of", mimic_of)("mimic_multiplier", multiplier)("mimic_offset", offset);
}
template <class A, Of<Link> T>
void fields(A& a, T& l) {
  auto& [name, parent_joint, mass, center] = l;
  a("name", name)("parent_joint", parent_joint)("mass", mass)("center_of_mass", center);
}
template <class A, Of<Skeleton> T>
void fields(A& a, T& s) {
  auto& [name, links, joints] = s;
  a("name", name)("links", links)("joints", joints);
}
template <class A, Of<BodyShape> T>
void fields(A& a, T& s) {
  auto& [link, name, shape, X_LS] = s;
  a("link", link)("name", name)("shape", shape)("X_LS", X_LS);
}
template <class A, Of<SkinBend> T>
void fields(A& a, T& b) {
  auto& [parent, child, centre, normal, offset, crease] = b;
  a("parent", parent)("child", child)("centre", centre)("normal", normal)("offset", offset)("crease", crease);
}
template <class A, Of<SkinCrease> T>
void fields(A& a, T& c) {
  auto& [bend, vertex, side, strength] = c;
  a("bend", bend)("vertex", vertex)("side", side)("strength", strength);
}
template <class A, Of<SkinRun> T>
void fields(A& a, T& r) {
  auto& [begin, end, bends, partial, share] = r;
  a("begin", begin)("end", end)("bends", bends)("partial", partial)("share", share);
}
template <class A, Of<Skin> T>
void fields(A& a, T& s) {
  auto& [rest, bind, first, link, weight, segment, off, bends, runs, creases, gap] = s;
  a("rest", rest)("bind", bind)("first", first)("link", link)("weight", weight)("segment", segment)("off", off);
  a("bends", bends)("runs", runs)("creases", creases)("crease_gap", gap);
}
template <class A, Of<Human> T>
void fields(A& a, T& h) {
  auto& [skeleton, shapes, mass, stature, skin] = h;
  a("skeleton", skeleton)("shapes", shapes)("mass", mass)("stature", stature)("skin", skin);
}
template <class A, Of<BridgedFolds> T>
void fields(A& a, T& b) {
  auto& [begin, every, first, vertex, way] = b;
  a("begin", begin)("every", every)("first", first)("vertex", vertex)("way", way);
}
template <class A, Of<Posture> T>
void fields(A& a, T& p) {
  auto& [q, root] = p;
  a("q", q)("root", root);
}
template <class A, Of<Stairs> T>
void fields(A& a, T& s) {
  auto& [rise, tread, first_edge] = s;
  a("rise", rise)("tread", tread)("first_edge", first_edge);
}
template <class A, Of<Postures> T>
void fields(A& a, T& m) {
  auto& [duration, stairs, time, at] = m;
  a("duration", duration)("stairs", stairs)("time", time)("at", at);
}
template <class A, Of<FootReport> T>
void fields(A& a, T& f) {
  auto& [speed, speed_time, slip, penetration, penetration_time, hover, hover_time] = f;
  a("slip_speed", speed)("slip_time", speed_time)("slip", slip)("penetration", penetration);
  a("penetration_time", penetration_time)("hover", hover)("hover_time", hover_time);
}
template <class A, Of<Snapshots> T>
void fields(A& a, T& s) {
  auto& [rate, begin, triangles, frames] = s;
  a("rate", rate)("begin", begin)("triangles", triangles)("frames", frames);
}

// --- Garments -------------------------------------------------------------------------------------------------------

template <class A, Of<KnotVector> T>
void fields(A& a, T& k) {
  auto& [degree, knots] = k;
  a("degree", degree)("knots", knots);
}
template <class A, Of<NurbsPatch> T>
void fields(A& a, T& p) {
  auto& [u, v, points, weights] = p;
  a("u", u)("v", v)("points", points)("weights", weights);
}
template <class A, Of<NurbsCurve> T>
void fields(A& a, T& c) {
  auto& [knots, points, weights] = c;
  a("knots", knots)("points", points)("weights", weights);
}
template <class A, Of<Trim> T>
void fields(A& a, T& t) {
  auto& [loops, points_per_piece, unused_fraction] = t;
  a("loops", loops)("points_per_piece", points_per_piece)("unused_fraction", unused_fraction);
}
template <class A, Of<PatchEdge> T>
void fields(A& a, T& e) {
  auto& [patch, side, reversed] = e;
  a("patch", patch)("side", side)("reversed", reversed);
}
template <class A, Of<EdgePlace> T>
void fields(A& a, T& p) {
  auto& [patch, uv] = p;
  a("patch", patch)("uv", uv);
}
/// Supports of results are made of these, those on edges of panels of lines.
template <class A, Of<NamedEdge> T>
void fields(A& a, T& e) {
  auto& [name, edges, lines] = e;
  a("name", name)("edges", edges);
  if (a.has("lines")) a("lines", lines);  // recordings from before have none
}
template <class A, Of<Seam> T>
void fields(A& a, T& s) {
  auto& [edge_a, edge_b, kind, stiffness, first_cell] = s;
  a("a", edge_a)("b", edge_b)("kind", kind)("stiffness", stiffness)("first_cell", first_cell);
}
template <class A, Of<WeakSeam> T>
void fields(A& a, T& s) {
  auto& [edge_a, edge_b, kind, stiffness, factor] = s;
  a("a", edge_a)("b", edge_b)("kind", kind)("stiffness", stiffness)("factor", factor);
}
template <class A, Of<SewnPart> T>
void fields(A& a, T& p) {
  auto& [patch, curve, from, to] = p;
  a("patch", patch)("curve", curve)("from", from)("to", to);
}
template <class A, Of<SewnSeam> T>
void fields(A& a, T& s) {
  auto& [edge_a, edge_b, hold, stiffness, rest_angle, factor, rows, name] = s;
  a("a", edge_a)("b", edge_b)("hold", hold)("stiffness", stiffness)("rest_angle", rest_angle)("factor", factor);
  a("rows_per_cell", rows)("name", name);
}
/// Fabrics and fields are those of the case. Sewn seams tell which points patches share, and so where samples are.
template <class A, Of<Garment> T>
void fields(A& a, T& g) {
  auto& [name, patches, seams, weft, trims, fabric, others, of_case, weak_seams, garment_of_patch, patch_names, edges,
         placed, sewn_seams] = g;
  a("name", name)("patches", patches)("seams", seams)("weft", weft)("trims", trims)("weak_seams", weak_seams);
  a("layer", garment_of_patch)("patch_names", patch_names)("edges", edges)("placed", placed);
  if (a.has("sewn_seams")) a("sewn_seams", sewn_seams);  // recordings from before have none
}
template <class A, Of<MeshLine> T>
void fields(A& a, T& l) {
  auto& [name, patch, vertices] = l;
  a("name", name)("patch", patch)("vertices", vertices);
}
template <class A, Of<ClothMesh> T>
void fields(A& a, T& m) {
  auto& [vertices, patch_names, triangles, patch, uv, lines] = m;
  a("vertices", vertices)("patch_names", patch_names)("triangles", triangles)("patch", patch)("uv", uv);
  a("lines", lines);
}
/// Of a mesh from the start; its fabric, its membrane and its bending are those of the case, and no draft is behind it.
template <class A, Of<MeshDraft> T>
void fields(A& a, T& g) {
  // Ties are of meshes that drafts are cut into; those that are recorded come from files.
  auto& [mesh, rest, bending, bending_spring, fabrics, fabric, draft, range, grid, of_control, membrane, ties, springs,
         closed, sewn_seams] = g;
  static_cast<void>(ties), static_cast<void>(springs), static_cast<void>(closed), static_cast<void>(sewn_seams);
  a("mesh", mesh)("rest", rest);
}

}  // namespace gambeson
