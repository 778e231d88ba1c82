/// A tree that follows its triangles when it is asked for.
#include "core/contact/lazy_tree.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>

#include "core/math/parallel.hpp"
#include "unit/core/contact/mesh_shapes.hpp"

namespace gambeson {
namespace {

TEST(LazyTree, FollowsWhenAskedAndNotBefore) {
  TriangleMesh m = testing_shapes::sphere(1, 2);
  const LazyTree tree(m.vertices, m.triangles);
  LazyTree moved(m.vertices, m.triangles);
  const Box before = moved.at(m.vertices, m.triangles).bounds();
  for (Vec3& x : m.vertices) x += Vec3{3, 0, 0};
  EXPECT_EQ(moved.at(m.vertices, m.triangles).bounds(), before);  // nobody has said so
  moved.moved();
  EXPECT_EQ(moved.at(m.vertices, m.triangles).bounds(), (Box{before.lo + Vec3{3, 0, 0}, before.hi + Vec3{3, 0, 0}}));
  EXPECT_EQ(tree.at(m.vertices, m.triangles).bounds(), before);
}

TEST(LazyTree, ThreadsThatAskAtOnceAllSeeItFitted) {
  const int threads = omp_get_max_threads();
  omp_set_num_threads(4);
  TriangleMesh m = testing_shapes::sphere(1, 4);
  LazyTree tree(m.vertices, m.triangles);
  for (int round = 1; round <= 20; ++round) {
    for (Vec3& x : m.vertices) x += Vec3{1, 0, 0};
    tree.moved();
    const int wrong = countOf(Each::much, 64, [&](int) {
      int near = 0;  // triangles at the tip of the sphere, where it is now
      tree.at(m.vertices, m.triangles).within({round + 1.0, 0, 0}, 1e-3, [&](int) { ++near; });
      return near == 0;
    });
    EXPECT_EQ(wrong, 0);
  }
  omp_set_num_threads(threads);
}

}  // namespace
}  // namespace gambeson
