#pragma once
/// A character as its file has it: a mesh, bones, and how much each bone has of each vertex; in the file's axes and
/// unit.

#include <filesystem>
#include <string>
#include <vector>

#include "core/contact/obstacle.hpp"

namespace gambeson {

struct RiggedBone {
  std::string name;
  int parent = -1;
  Vec3 head;  ///< the joint about which it turns, in the pose that the mesh is in
};

struct RiggedMesh {
  std::string file;
  double unit_m = 1;  ///< of the file
  TriangleMesh mesh;
  std::vector<RiggedBone> bones;  ///< parents first
  std::vector<int> first, bone;   ///< bones of vertex v: bone[first[v]] .. bone[first[v + 1] - 1]; none: no weight
  std::vector<double> weight;     ///< as `bone`, as the file has them
  std::vector<int> part;          ///< the bone that each vertex is counted to; empty: that of its largest weight
  std::vector<std::string> notes;

  int find(const std::string& name) const;  ///< bone; -1 where there is none
};

/// A skinned glTF or FBX file through assimp, all its skinned meshes. Throws InputError: unreadable, no bones, weights
/// that are not finite.
RiggedMesh readRiggedScene(const std::filesystem::path& file);

/// A sparse morph of MakeHuman's base mesh ("index dx dy dz" by line), added `amount` times.
struct MorphTarget {
  std::filesystem::path file;
  double amount = 1;
};

/// MakeHuman's base mesh (OBJ, quads) with its skeleton (.mhskel: joints as means of vertices) and weights (.mhw). Only
/// faces of the group `group` are kept, so that helpers and joint markers go.
struct MakeHumanFiles {
  std::filesystem::path mesh, skeleton, weights;
  std::vector<MorphTarget> targets;
  std::string group = "body";
};
RiggedMesh readMakeHuman(const MakeHumanFiles& files);

/// The body alone, fit to be a skin: vertices at the same place (within 1/200,000 of the whole's size, 10 um
/// of a body) are one, with the mean of their weights; of the
/// parts that hang together the one of the largest volume stays (eyes, brows and lashes go), closed and outward, and
/// the weights of each vertex sum to 1. Throws InputError where it is open, or a vertex has no weight. What was done
/// is told in the notes.
RiggedMesh bodyOf(const RiggedMesh& whole);

}  // namespace gambeson
