/// Snapshots of a surface: through the frames, continuous in velocity, at rest at both ends.

#include "human/body/mesh_sequence.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "unit/human/files/files.hpp"

namespace gambeson {
namespace {

using test::Folder;

/// A tetrahedron whose corners go around, corner k by its own way.
Vec3 corner(int k, double t) {
  const double a = 2 * t + 0.7 * k;
  return Vec3{k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0, k == 3 ? 1.0 : 0.0} +
         0.1 * Vec3{std::sin(a), std::cos(a), std::sin(2 * a)};
}

/// Corners written once for each face, as many programs do.
std::string frame(double t, bool turned = false) {
  const std::array<std::array<int, 3>, 4> faces{{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  std::string v, f;
  int n = 0;
  for (auto face : faces) {
    if (turned) std::swap(face[1], face[2]);
    for (const int k : face) {
      const Vec3 x = corner(k, t);
      v += fmt::format("v {:.9f} {:.9f} {:.9f}\n", x.x, x.y, x.z);
      ++n;
    }
    f += fmt::format("f {} {} {}\n", n - 2, n - 1, n);
  }
  return v + f;
}

/// Frames of 1 s.
MeshSequence written(const Folder& folder, int frames, SequenceOptions o = {}, bool turned = false) {
  o.folder = folder.path;
  if (o.rate_Hz == SequenceOptions{}.rate_Hz) o.rate_Hz = frames - 1;
  for (int i = 0; i < frames; ++i)
    folder.write("body_" + std::to_string(i) + ".obj", frame(static_cast<double>(i) / (frames - 1), turned));
  return MeshSequence(o);
}

TEST(MeshSequence, GoesThroughItsFramesInTheOrderOfTheirNumbers) {
  const Folder folder;
  const MeshSequence s = written(folder, 12);
  EXPECT_EQ(s.frames(), 12);
  EXPECT_EQ(s.triangles().size(), 4u);
  std::vector<Vec3> x(4);
  ASSERT_EQ(s.first().vertices.size(), 4u);
  for (int i = 0; i < 12; ++i) {
    s.at(i / 11.0, x);
    for (int k = 0; k < 4; ++k) EXPECT_LT(norm(x[k] - corner(std::array{0, 2, 1, 3}[k], i / 11.0)), 1e-6) << i;
  }
  for (const double t : {-1.0, 0.0}) {
    s.at(t, x);
    EXPECT_EQ(x, s.first().vertices);
  }
}

/// The error of a cubic with central differences at its ends falls with the third power of the frame time at least
/// (away from the ends, where it starts and stops).
TEST(MeshSequence, ConvergesToTheMotionThatWasSampled) {
  const auto error = [](int frames) {
    const Folder folder;
    const MeshSequence s = written(folder, frames);
    std::vector<Vec3> x(4);
    double worst = 0;
    for (int i = 0; i <= 300; ++i) {
      const double t = 0.25 + 0.5 * i / 300;
      s.at(t, x);
      for (int k = 0; k < 4; ++k) worst = std::max(worst, norm(x[k] - corner(std::array{0, 2, 1, 3}[k], t)));
    }
    return worst;
  };
  const double coarse = error(9), fine = error(17);
  EXPECT_GT(std::log2(coarse / fine), 2.7) << coarse << " " << fine;
}

TEST(MeshSequence, HasContinuousVelocityAndRestsAtItsEnds) {
  const Folder folder;
  const MeshSequence s = written(folder, 6);
  const auto velocity = [&](double t) {
    constexpr double h = 1e-5;
    std::vector<Vec3> a(4), b(4);
    s.at(t - h, a);
    s.at(t + h, b);
    return (b[1] - a[1]) / (2 * h);
  };
  for (int i = 0; i <= 5; ++i) {
    const double t = i / 5.0;
    EXPECT_LT(norm(velocity(t + 2e-5) - velocity(t - 2e-5)), 2e-3) << i;  // acceleration times 4e-5 s, and rounding
  }
  EXPECT_LT(norm(velocity(0)), 1e-3);
  EXPECT_LT(norm(velocity(1)), 1e-3);
  EXPECT_GT(norm(velocity(0.5)), 0.1);
}

TEST(MeshSequence, IsScaledTurnedAndOutward) {
  const Folder folder;
  SequenceOptions o;
  o.scale = 0.01;
  o.forward = "z", o.up = "y";
  o.begin_s = -2, o.rate_Hz = 5;
  const MeshSequence s = written(folder, 3, o, true);  // inside out in its files
  EXPECT_NEAR(s.end_s(), -1.6, 1e-12);
  const TriangleMesh m = s.first();
  double volume = 0;
  for (const auto& t : m.triangles) volume += dot(m.vertices[t[0]], cross(m.vertices[t[1]], m.vertices[t[2]])) / 6;
  EXPECT_GT(volume, 0.05e-6);
  const Vec3 x = 0.01 * corner(0, 0);
  EXPECT_LT(norm(m.vertices[0] - Vec3{x.z, x.x, x.y}), 1e-8);
}

/// Corners that meet in one frame alone stay apart.
TEST(MeshSequence, WeldsWhatIsAtOnePlaceInAllFrames) {
  const Folder folder;
  const auto two = [&](double apart) {
    return fmt::format("v 0 0 0\nv 1 0 0\nv 0 1 0\nv {} 0 0\nv 1 0 0\nv 0 0 -1\nf 1 2 3\nf 4 5 6\n", apart);
  };
  folder.write("0.obj", two(0));
  folder.write("1.obj", two(0.1));
  SequenceOptions o;
  o.folder = folder.path;
  EXPECT_EQ(MeshSequence(o).first().vertices.size(), 5u);
}

TEST(MeshSequence, SaysWhatIsWrong) {
  const auto refused = [](const Folder& folder, const std::filesystem::path& at, const std::string& words,
                          SequenceOptions o = {}) {
    o.folder = folder.path;
    test::expectRefused([&](auto) { MeshSequence{o}; }, at, 0, words);
  };
  const Folder folder;
  refused(folder, folder.path, "folder: holds 0 meshes");
  folder.write("a1.obj", frame(0));
  folder.write("notes.txt", "x");
  refused(folder, folder.path, "holds 1 meshes (.obj, .ply, .stl, .gltf, .glb); a sequence needs at least two frames");
  const auto second = folder.write("a2.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  refused(folder, second, "has 3 vertices and 1 triangles, the first frame (a1.obj) 12 and 4");
  folder.write("a2.obj", test::replaced(frame(1), "f 1 2 3", "f 1 3 2"));
  refused(folder, second, "its faces hang together in another way");
  folder.write("a2.obj", test::replaced(frame(1), "v ", "v nan "));
  refused(folder, second, "");
  folder.write("a2.obj", frame(1));
  SequenceOptions o;
  o.up = "z";
  refused(folder, folder.path, "forward: is missing", o);
  o.forward = "w";
  refused(folder, folder.path, "forward: 'w' is not allowed", o);
  o.forward = "-z";
  refused(folder, folder.path, "up: must be across", o);
  o = {};
  o.rate_Hz = 0;
  refused(folder, folder.path, "rate: 0 is not allowed", o);
  o = {};
  o.folder = folder.path / "none";
  test::expectRefused([&](auto) { MeshSequence{o}; }, o.folder, 0, "folder: cannot be opened");
}

}  // namespace
}  // namespace gambeson
