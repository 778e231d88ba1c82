#pragma once
/// A contact mesh by where its arrays lie, on a host or a device.

#include <array>
#include <span>

#include "core/contact/contact_mesh.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

struct ListsView {
  const int* first = nullptr;
  const int* items = nullptr;

  GAMBESON_HD std::span<const int> operator[](int i) const {
    return {items + first[i], static_cast<std::size_t>(first[i + 1] - first[i])};
  }
};

struct ContactMeshView {
  int vertex_count = 0, triangle_count = 0, edge_count = 0;
  const std::array<int, 3>* triangles = nullptr;
  const std::array<int, 2>* edges = nullptr;
  const std::array<int, 3>* face_edges = nullptr;
  ListsView edge_faces, vertex_faces, vertex_edges;

  GAMBESON_HD bool border(int edge) const { return edge_faces[edge].size() == 1; }
};

inline ContactMeshView viewOf(const ContactMesh& m) {
  const auto lists = [](const Lists& l) { return ListsView{l.first.data(), l.items.data()}; };
  return {m.vertex_count,
          static_cast<int>(m.triangles.size()),
          static_cast<int>(m.edges.size()),
          m.triangles.data(),
          m.edges.data(),
          m.face_edges.data(),
          lists(m.edge_faces),
          lists(m.vertex_faces),
          lists(m.vertex_edges)};
}

}  // namespace gambeson
