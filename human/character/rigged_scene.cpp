/// Detail of rigged_mesh.hpp: skinned characters through assimp. A bone's offset matrix takes the mesh's space to the
/// bone's in the pose of binding, so its inverse has the bone's joint where the mesh is.

#include <assimp/postprocess.h>
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <optional>

#include "core/error.hpp"
#include "core/io/apart.hpp"
#include "human/character/rigged_mesh.hpp"
#include "human/files/scene_import.hpp"

namespace gambeson {
namespace {

constexpr double cm = 0.01;

Vec3 originOf(const aiMatrix4x4& m) { return {m.a4, m.b4, m.c4}; }

struct Reader {
  RiggedMesh out;
  std::map<std::string, aiMatrix4x4> bound;                     ///< bone -> its frame in the mesh's space
  std::map<std::string, aiMatrix4x4> placed;                    ///< node -> its frame in the scene
  std::vector<std::vector<std::pair<std::string, double>>> of;  ///< bones of each vertex

  [[noreturn]] void fail(const std::string& key, const std::string& reason) const {
    throw InputError({out.file, 0, key}, reason);
  }

  void take(const aiMesh& mesh) {
    const std::string name = fmt::format("mesh '{}'", mesh.mName.C_Str());
    const int first = static_cast<int>(out.mesh.vertices.size());
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const aiVector3D& p = mesh.mVertices[i];
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        fail(name, fmt::format("vertex {} has a coordinate that is not finite", i));
      out.mesh.vertices.push_back({p.x, p.y, p.z});
    }
    of.resize(out.mesh.vertices.size());
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
      const aiFace& face = mesh.mFaces[i];
      if (face.mNumIndices != 3) continue;  // points and lines
      std::array<int, 3> t{};
      for (int k = 0; k < 3; ++k) {
        if (face.mIndices[k] >= mesh.mNumVertices)
          fail(name, fmt::format("face {} names vertex {} of {}", i, face.mIndices[k], mesh.mNumVertices));
        t[k] = first + static_cast<int>(face.mIndices[k]);
      }
      out.mesh.triangles.push_back(t);
    }
    for (unsigned b = 0; b < mesh.mNumBones; ++b) {
      const aiBone& bone = *mesh.mBones[b];
      aiMatrix4x4 frame = bone.mOffsetMatrix;
      const float size = frame.Determinant();
      if (!std::isfinite(size) || size == 0)
        fail(fmt::format("bone '{}'", bone.mName.C_Str()), "its inverse bind matrix has no inverse");
      bound.emplace(bone.mName.C_Str(), frame.Inverse());
      for (unsigned i = 0; i < bone.mNumWeights; ++i) {
        const aiVertexWeight& w = bone.mWeights[i];
        if (w.mVertexId >= mesh.mNumVertices)
          fail(fmt::format("bone '{}'", bone.mName.C_Str()),
               fmt::format("has a weight of vertex {} of {}", w.mVertexId, mesh.mNumVertices));
        if (!(w.mWeight >= 0 && w.mWeight <= 1.001F))
          fail(fmt::format("bone '{}'", bone.mName.C_Str()),
               fmt::format("weight {} of vertex {} is not within 0 to 1", w.mWeight, w.mVertexId));
        if (w.mWeight > 0)
          of[static_cast<std::size_t>(first) + w.mVertexId].emplace_back(bone.mName.C_Str(), w.mWeight);
      }
    }
  }

  void walk(const aiNode& node, const aiMatrix4x4& parent, int parent_bone) {
    const aiMatrix4x4 frame = parent * node.mTransformation;
    placed[node.mName.C_Str()] = frame;
    const int me = static_cast<int>(out.bones.size());
    out.bones.push_back({node.mName.C_Str(), parent_bone, {}});
    for (unsigned i = 0; i < node.mNumChildren; ++i) walk(*node.mChildren[i], frame, me);
  }

  /// Bones without weights have no offset matrix: they stand to the others as in the scene.
  void placeBones() {
    std::optional<aiMatrix4x4> to_mesh;
    for (const auto& [name, frame] : bound)
      if (const auto node = placed.find(name); node != placed.end() && !to_mesh) {
        aiMatrix4x4 back = node->second;
        to_mesh = frame * back.Inverse();
      }
    if (!to_mesh) fail("bones", "none of the bones that have weights stands in the hierarchy");
    for (RiggedBone& b : out.bones) {
      const auto at = bound.find(b.name);
      b.head = originOf(at != bound.end() ? at->second : *to_mesh * placed.at(b.name));
    }
  }

  void weigh() {
    std::map<std::string, int> number;
    for (std::size_t b = 0; b < out.bones.size(); ++b) number.emplace(out.bones[b].name, static_cast<int>(b));
    out.first = {0};
    for (const auto& list : of) {
      for (const auto& [name, w] : list) {
        const auto b = number.find(name);
        if (b == number.end()) fail(fmt::format("bone '{}'", name), "has weights but no place in the hierarchy");
        out.bone.push_back(b->second);
        out.weight.push_back(w);
      }
      out.first.push_back(static_cast<int>(out.bone.size()));
    }
  }
};

}  // namespace

int RiggedMesh::find(const std::string& name) const {
  for (std::size_t b = 0; b < bones.size(); ++b)
    if (bones[b].name == name) return static_cast<int>(b);
  return -1;
}

namespace {

RiggedMesh importRigged(const std::filesystem::path& file) {
  Reader r;
  r.out.file = file.string();
  Assimp::Importer importer;
  importScene(importer, file);
  const aiScene& scene = processScene(importer, aiProcess_Triangulate | aiProcess_SortByPType, file);
  std::string left_out;
  for (unsigned k = 0; k < scene.mNumMeshes; ++k)
    if (scene.mMeshes[k]->HasBones())
      r.take(*scene.mMeshes[k]);
    else
      left_out += std::string(left_out.empty() ? "" : ", ") + "'" + scene.mMeshes[k]->mName.C_Str() + "'";
  if (r.out.mesh.triangles.empty())
    r.fail("", "has no skeleton: none of its meshes is bound to bones (" +
                   (left_out.empty() ? std::string("it has no mesh") : left_out) + ")");
  if (!left_out.empty()) r.out.notes.push_back("meshes without bones were left out: " + left_out);
  if (extensionOf(file) == ".fbx") {
    r.out.unit_m = cm;
    if (double in_cm = 1; scene.mMetaData && scene.mMetaData->Get("UnitScaleFactor", in_cm)) r.out.unit_m = cm * in_cm;
  }
  r.walk(*scene.mRootNode, {}, -1);
  r.placeBones();
  r.weigh();
  if (r.out.bone.empty()) r.fail("", "has no weights: no vertex is bound to a bone");
  return std::move(r.out);
}

}  // namespace

RiggedMesh readRiggedScene(const std::filesystem::path& file) {
  const std::string extension = extensionOf(file);
  if (extension != ".gltf" && extension != ".glb" && extension != ".fbx")
    throw InputError({file.string(), 0, ""},
                     "characters are read from .gltf, .glb and .fbx, or from MakeHuman's .obj with \"skeleton\" and "
                     "\"weights\"");
  BytesIn in = readApart(file, limitsFor(file), [&](BytesOut& out) {
    const RiggedMesh m = importRigged(file);
    out.put(m.unit_m);
    out.put(m.mesh.vertices), out.put(m.mesh.triangles);
    out.put(m.bones.size());
    for (const RiggedBone& b : m.bones) out.put(b.name), out.put(b.parent), out.put(b.head);
    out.put(m.first), out.put(m.bone), out.put(m.weight), out.put(m.notes);
  });
  RiggedMesh m;
  m.file = file.string();
  in.get(m.unit_m);
  in.get(m.mesh.vertices), in.get(m.mesh.triangles);
  std::size_t bones = 0;
  in.get(bones);
  for (std::size_t b = 0; b < bones; ++b) {
    RiggedBone& bone = m.bones.emplace_back();
    in.get(bone.name), in.get(bone.parent), in.get(bone.head);
  }
  in.get(m.first), in.get(m.bone), in.get(m.weight), in.get(m.notes);
  return m;
}

}  // namespace gambeson
