#pragma once
/// A broad phase: pairs whose boxes meet, by trees of boxes over faces and edges (a linear bounding volume hierarchy).
///
/// Any other broad phase has the same functions and finds the same set of pairs: vertices whose box over the
/// step, grown by the margin, meets that of a face without them, and edges without a common vertex whose boxes meet;
/// not two of bodies (Mesh::bodies_from). With Bounds::polytopes those of them whose polytopes meet too.

#include "gpu/finding/box_tree.hpp"
#include "gpu/finding/flat_mesh.hpp"
#include "gpu/finding/impact_search.hpp"
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
  Lbvh(const Mesh&, FlatMesh<Device>& mesh, float margin_m, const SearchOptions& options)
      : mesh_(mesh),
        margin_m_(margin_m),
        queries_per_group_(options.queries_per_group),
        vertex_box_(static_cast<std::size_t>(mesh.vertices)),
        vertex_dop_(options.bounds == Bounds::polytopes ? static_cast<std::size_t>(mesh.vertices) : 0),
        faces_(mesh.cloth_faces),
        body_faces_(mesh.faces - mesh.cloth_faces),
        edges_(mesh.cloth_edges) {}

  /// Before both kinds of pairs.
  Stages<Device> common() {
    return {{"boxes", [this](Queue& queue) {
               queue.forEach(mesh_.vertices, BoxVertices{mesh_.point.data(), margin_m_, vertex_box_.data()});
               if (vertex_dop_.size() > 0)
                 queue.forEach(mesh_.vertices, DopVertices{mesh_.point.data(), margin_m_, vertex_dop_.data()});
             }}};
  }
  Stages<Device> pointTriangle(const List<Pair>& pairs) {
    Stages<Device> all =
        stages(faces_, mesh_.face, "faces", [this, pairs](Queue& queue) { inFaces(queue, pairs, nullptr); });
    if (body_faces_.leaves() == 0) return all;
    const Stages<Device> bodies = stages(body_faces_, mesh_.body_face, "bodies",
                                         [this, pairs](Queue& queue) { inBodies(queue, pairs, nullptr); });
    all.insert(all.end(), bodies.begin(), bodies.end());
    return all;
  }
  Stages<Device> edgeEdge(const List<Pair>& pairs) {
    return stages(edges_, mesh_.edge, "edges", [this, pairs](Queue& queue) { inEdges(queue, pairs, nullptr); });
  }

  /// After a pass: whether a list of its own ran over. It has none.
  bool ranOver(Queue&) { return false; }

  BroadFacts facts(Queue& queue) {
    typename Device::template Buffer<Count> tally(1), nowhere(1);
    const List<Pair> pairs{nullptr, nowhere.data(), 0};
    inFaces(queue, pairs, tally.data());
    inBodies(queue, pairs, tally.data());
    inEdges(queue, pairs, tally.data());
    BroadFacts facts;
    facts.tests = queue.download(tally, 1)[0];
    facts.bytes = bytesOf(vertex_box_, vertex_dop_) + faces_.bytes() + body_faces_.bytes() + edges_.bytes();
    return facts;
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

  // tally: null where nothing is counted.
  void inFaces(Queue& queue, const List<Pair>& pairs, Count* tally) {
    traverse<true>(queue, VerticesInFaces{mesh_.along_curve.data(), vertex_box_.data()}, mesh_.vertices, faces_, pairs,
                   tally);
  }
  void inBodies(Queue& queue, const List<Pair>& pairs, Count* tally) {
    traverse<true>(
        queue, VerticesInBodies{mesh_.along_curve.data(), vertex_box_.data(), mesh_.cloth_vertices, mesh_.cloth_faces},
        mesh_.vertices, body_faces_, pairs, tally);
  }
  void inEdges(Queue& queue, const List<Pair>& pairs, Count* tally) {
    traverse<false>(queue, EdgesInEdges{edges_.leaf(), edges_.leafBox()}, mesh_.cloth_edges, edges_, pairs, tally);
    traverse<false>(queue, BodyEdgesInCloth{mesh_.edge.data(), vertex_box_.data(), mesh_.cloth_edges},
                    mesh_.edges - mesh_.cloth_edges, edges_, pairs, tally);
  }

  template <bool kOfVertices, class Queries, class Tree>
  void traverse(Queue& queue, const Queries& queries, int count, const Tree& tree, const List<Pair>& pairs,
                Count* tally) {
    if (tree.leaves() == 0 || count == 0) return;
    const int per_group = queries_per_group_ > 0 ? queries_per_group_ : bestPerGroup(count);
    const auto give = [&]<bool kTallied>(const auto& asked) {
      using Asked = std::remove_cvref_t<decltype(asked)>;
      queue.forGroups((count + per_group - 1) / per_group,
                      Traverse<Asked, 512, kTallied>{asked, count, per_group, tree.node(), tree.leaf(), pairs, tally});
    };
    if (tally != nullptr)
      give.template operator()<true>(queries);
    else if (vertex_dop_.size() > 0)
      give.template operator()<false>(WithPolytopes<Queries, kOfVertices>{queries, vertex_dop_.data()});
    else
      give.template operator()<false>(queries);
  }

  FlatMesh<Device>& mesh_;
  float margin_m_;
  int queries_per_group_;
  typename Device::template Buffer<FloatBox> vertex_box_;
  typename Device::template Buffer<FloatDop> vertex_dop_;  ///< of no vertex where boxes are enough
  BoxTree<Device, 3> faces_, body_faces_;                  ///< of cloth, or all; of bodies
  BoxTree<Device, 2> edges_;
};

}  // namespace gambeson::gpu
