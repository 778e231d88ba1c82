#pragma once
/// A broad phase: pairs whose boxes meet, by trees of boxes over faces and edges (a linear bounding volume hierarchy).
///
/// Any other broad phase has the same three functions and finds the same set of pairs: vertices whose box over the
/// step, grown by the margin, meets that of a face without them, and edges without a common vertex whose boxes meet;
/// not two of bodies (Mesh::bodies_from).

#include "gpu/finding/box_tree.hpp"
#include "gpu/finding/flat_mesh.hpp"
#include "gpu/finding/stage.hpp"
#include "gpu/finding/traverse.hpp"

namespace gambeson::gpu {

struct BoxVertices {
  const MovingPoint* point;
  float margin_m;
  FloatBox* box;
  GAMBESON_HD void operator()(int i) const { box[i] = boxOf(point[i], margin_m); }
};

template <class Device>
class Lbvh {
 public:
  using Queue = typename Device::Queue;

  /// The mesh is another's and outlives this.
  Lbvh(FlatMesh<Device>& mesh, float margin_m, int queries_per_group)
      : mesh_(mesh),
        margin_m_(margin_m),
        queries_per_group_(queries_per_group),
        vertex_box_(static_cast<std::size_t>(mesh.vertices)),
        faces_(mesh.cloth_faces),
        body_faces_(mesh.faces - mesh.cloth_faces),
        edges_(mesh.cloth_edges) {}

  /// Before both kinds of pairs.
  Stages<Device> common() {
    return {{"boxes", [this](Queue& queue) {
               queue.forEach(mesh_.vertices, BoxVertices{mesh_.point.data(), margin_m_, vertex_box_.data()});
             }}};
  }
  Stages<Device> pointTriangle(const List<Pair>& pairs) {
    Stages<Device> all = stages(faces_, mesh_.face, "faces", [this, pairs](Queue& queue) {
      traverse(queue, VerticesInFaces{mesh_.along_curve.data(), vertex_box_.data()}, mesh_.vertices, faces_, pairs);
    });
    if (body_faces_.leaves() == 0) return all;
    const Stages<Device> bodies = stages(body_faces_, mesh_.body_face, "bodies", [this, pairs](Queue& queue) {
      traverse(queue,
               VerticesInBodies{mesh_.along_curve.data(), vertex_box_.data(), mesh_.cloth_vertices, mesh_.cloth_faces},
               mesh_.vertices, body_faces_, pairs);
    });
    all.insert(all.end(), bodies.begin(), bodies.end());
    return all;
  }
  Stages<Device> edgeEdge(const List<Pair>& pairs) {
    return stages(edges_, mesh_.edge, "edges", [this, pairs](Queue& queue) {
      traverse(queue, EdgesInEdges{edges_.leaf(), edges_.leafBox()}, mesh_.cloth_edges, edges_, pairs);
      const int of_bodies = mesh_.edges - mesh_.cloth_edges;
      traverse(queue, BodyEdgesInCloth{mesh_.edge.data(), vertex_box_.data(), mesh_.cloth_edges}, of_bodies, edges_,
               pairs);
    });
  }

 private:
  template <class Tree, class Collect>
  Stages<Device> stages(Tree& tree, typename Device::template Buffer<int>& corners, const std::string& of,
                        Collect collect) {
    return {{"tree of " + of, [&](Queue& queue) { tree.build(queue, corners, vertex_box_, mesh_.cube); }, true},
            {"boxes of " + of, [&](Queue& queue) { tree.fit(queue, corners, vertex_box_); }},
            {"pairs of " + of, collect}};
  }
  /// Few enough to fill the device some six times over; 4 where there are not that many, as heavy queries then share.
  static int bestPerGroup(int count) { return count > 1000000 ? 16 : count > 200000 ? 8 : 4; }

  template <class Queries, class Tree>
  void traverse(Queue& queue, const Queries& queries, int count, const Tree& tree, const List<Pair>& pairs) {
    if (tree.leaves() == 0 || count == 0) return;
    const int per_group = queries_per_group_ > 0 ? queries_per_group_ : bestPerGroup(count);
    queue.forGroups((count + per_group - 1) / per_group,
                    Traverse<Queries>{queries, count, per_group, tree.node(), tree.leaf(), pairs});
  }

  FlatMesh<Device>& mesh_;
  float margin_m_;
  int queries_per_group_;
  typename Device::template Buffer<FloatBox> vertex_box_;
  BoxTree<Device, 3> faces_, body_faces_;  ///< of cloth, or all; of bodies
  BoxTree<Device, 2> edges_;
};

}  // namespace gambeson::gpu
