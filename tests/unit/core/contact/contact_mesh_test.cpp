#include "core/contact/contact_mesh.hpp"

#include <gtest/gtest.h>

namespace gambeson {
namespace {

/// Two triangles on a diagonal, and a third that stands on their common edge.
TEST(ContactMesh, NumbersEdgesOnceWithTheirFaces) {
  const std::vector<std::array<int, 3>> triangles{{0, 1, 2}, {0, 2, 3}, {4, 2, 0}};
  const ContactMesh m = contactMesh(6, triangles);
  ASSERT_EQ(m.edges.size(), 7u);  // 01 02 03 04 12 23 24
  EXPECT_EQ(m.edges[1], (std::array<int, 2>{0, 2}));
  EXPECT_EQ(std::vector<int>(m.edge_faces[1].begin(), m.edge_faces[1].end()), (std::vector<int>{0, 1, 2}));
  for (std::size_t e = 0; e < m.edges.size(); ++e) EXPECT_EQ(m.border(static_cast<int>(e)), e != 1) << e;
  for (int t = 0; t < 3; ++t)
    for (int k = 0; k < 3; ++k) {
      const auto& [v, w] = m.edges[m.face_edges[t][k]];
      const int a = triangles[t][k], b = triangles[t][(k + 1) % 3];
      EXPECT_EQ(v, std::min(a, b));
      EXPECT_EQ(w, std::max(a, b));
    }
  EXPECT_EQ(m.vertex_faces[2].size(), 3u);
  EXPECT_EQ(m.vertex_edges[4].size(), 2u);
  EXPECT_TRUE(m.vertex_faces[5].empty());  // a vertex without a triangle
}

}  // namespace
}  // namespace gambeson
