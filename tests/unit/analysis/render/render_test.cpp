#include "analysis/render/render.hpp"

#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "analysis/render/camera.hpp"
#include "analysis/render/colormap.hpp"
#include "analysis/render/geometry.hpp"
#include "analysis/render/overlay.hpp"
#include "analysis/render/shapes.hpp"
#include "analysis/render/shot.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr Color kBlue{0.2f, 0.3f, 0.8f}, kGreen{0.1f, 0.7f, 0.2f}, kGrey{0.8f, 0.8f, 0.8f};

struct Rgb {
  int r, g, b;
};
Rgb at(const Image& image, int x, int y) {
  const unsigned char* p = &image.rgb[3 * (static_cast<std::size_t>(y) * image.width + x)];
  return {p[0], p[1], p[2]};
}
bool isRed(Rgb c) { return c.r > c.g + 40 && c.r > c.b + 40; }
bool isBlue(Rgb c) { return c.b > c.r + 40 && c.b > c.g + 20; }
bool isGreen(Rgb c) { return c.g > c.r + 30 && c.g > c.b + 30; }

RenderMesh sphere(const Vec3& center, double radius, Color color) {
  return meshOf(Ellipsoid{{radius, radius, radius}}, Placement{Mat3{}, center, 1}, color);
}

template <class Test>
double countWhere(const Image& image, Test test) {
  double n = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) n += test(at(image, x, y)) ? 1 : 0;
  return n;
}

/// Mean column of the pixels that pass; negative where none does.
template <class Test>
double meanColumn(const Image& image, Test test) {
  double n = 0, sum = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (test(at(image, x, y))) n += 1, sum += x;
  return n > 0 ? sum / n : -1;
}

Scene focused(double half) {
  Scene scene;
  scene.view = View::front;
  scene.focus = {Vec3{-half, -half, -half}, Vec3{half, half, half}};
  return scene;
}

RenderMesh square(double half, std::vector<double> scalars) {
  RenderMesh mesh;
  mesh.vertices = {{0, -half, -half}, {0, half, -half}, {0, half, half}, {0, -half, half}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.scalars = std::move(scalars);
  mesh.color = kGrey;
  return mesh;
}

TEST(Render, OutlineOfASphereCoversPiRSquared) {
  // Orthographic: the focus cube of half 0.5 m fills 0.96 of the smaller side, so r = 0.3 m is 0.3 * 0.96 * 400 pixels.
  Scene scene = focused(0.5);
  scene.meshes = {sphere({0, 0, 0}, 0.3, kBlue)};
  const Image image = render(scene, 400, 500);
  const double r = 0.3 * 0.96 * 400;
  EXPECT_NEAR(countWhere(image, isBlue) / (kPi * r * r), 1, 0.01);
}

TEST(Render, EllipsoidIsPlacedScaledAndTurned) {
  // Semi-axes 0.1, 0.2, 0.4 turned by 90 degrees about x: 0.4 lies along y; the placement's scale halves it.
  const RenderMesh mesh =
      meshOf(Ellipsoid{{0.1, 0.2, 0.4}}, Placement{rotationAbout({1, 0, 0}, kPi / 2), {1, 2, 3}, 0.5}, kGrey);
  Vec3 low{9, 9, 9}, high{-9, -9, -9};
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], mesh.vertices[i][k]);
      high[k] = std::max(high[k], mesh.vertices[i][k]);
      EXPECT_NEAR(norm(mesh.normals[i]), 1, 1e-12);
    }
  EXPECT_NEAR(high.y - low.y, 0.4, 1e-12);
  EXPECT_NEAR(high.x - low.x, 0.1, 1e-3);
  EXPECT_NEAR(0.5 * (high.z + low.z), 3, 1e-12);
  // Volume by the divergence theorem, 4/3 pi a b c of the halved axes: triangles point outwards and leave no gap.
  double volume = 0;
  for (const auto& t : mesh.triangles)
    volume += dot(mesh.vertices[t[0]] - Vec3{1, 2, 3},
                  cross(mesh.vertices[t[1]] - Vec3{1, 2, 3}, mesh.vertices[t[2]] - Vec3{1, 2, 3})) /
              6;
  EXPECT_NEAR(volume / (4.0 / 3 * kPi * 0.05 * 0.1 * 0.2), 1, 5e-3);
}

TEST(Render, ViewsLookFromWhereTheirNamesSay) {
  // Green before the body (+x), blue on its left (+y), red above it (+z).
  Scene scene = focused(0.7);
  scene.meshes = {sphere({0.4, 0, 0}, 0.1, kGreen), sphere({0, 0.4, 0}, 0.1, kBlue),
                  sphere({0, 0, 0.4}, 0.1, {0.9f, 0.1f, 0.1f})};
  const auto columns = [&](View view) {
    scene.view = view;
    const Image image = render(scene, 200, 200);
    return std::array<double, 3>{meanColumn(image, isGreen), meanColumn(image, isBlue), meanColumn(image, isRed)};
  };
  const auto left = columns(View::left), right = columns(View::right), front = columns(View::front),
             back = columns(View::back);
  EXPECT_LT(left[0], 70);  // from the body's left, its front is on the viewer's left
  EXPECT_GT(right[0], 130);
  EXPECT_GT(front[1], 130);  // face to face, its left is on the viewer's right
  EXPECT_LT(back[1], 70);
  const auto top = columns(View::top);
  EXPECT_LT(top[1], 70);  // front up, left on the left
  EXPECT_NEAR(top[0], 99.5, 2);
  EXPECT_GT(columns(View::front_left)[1], 110);
  EXPECT_LT(columns(View::back_left)[1], 90);
  scene.view = View::front;
  const Image image = render(scene, 200, 200);
  EXPECT_TRUE(isRed(at(image, 100, 100 - static_cast<int>(0.4 / 1.4 * 0.96 * 200))));  // up is up
}

TEST(Render, AxesOfEveryViewAreRightHandedWhateverUpIs) {
  for (const Vec3 up : {Vec3{0, 0, 1}, Vec3{0, 1, 0}, Vec3{1, 0, 0}, Vec3{0.3, -2, 0.4}})
    for (const auto& name : viewNames()) {
      const CameraAxes a = axesOf(*viewByName(name), up);
      EXPECT_NEAR(norm(a.up), 1, 1e-12) << name;
      EXPECT_NEAR(norm(a.towards), 1, 1e-12) << name;
      EXPECT_NEAR(norm(cross(a.right, a.up) - a.towards), 0, 1e-12) << name;
    }
  EXPECT_FALSE(viewByName("sideways"));
}

/// A free viewpoint turns about `up`: 90 degrees are the body's left, and what is named is among them to the last bit.
TEST(Render, ViewpointsTurnFromTheFrontToTheLeft) {
  const Vec3 up{0, 0, 1};
  const auto near = [](const Vec3& a, const Vec3& b) { EXPECT_LT(norm(a - b), 1e-12); };
  EXPECT_EQ(axesOf(Viewpoint{90, 0}, up).towards.y, axesOf(View::left, up).towards.y);
  EXPECT_EQ(axesOf(View::left, up).towards.x, 0);
  near(axesOf(Viewpoint{0, 0}, up).towards, {1, 0, 0});
  near(axesOf(Viewpoint{30, 0}, up).towards, {std::sqrt(0.75), 0.5, 0});
  near(axesOf(Viewpoint{0, 30}, up).towards, {std::sqrt(0.75), 0, 0.5});
  near(axesOf(Viewpoint{0, 30}, up).up, {-0.5, 0, std::sqrt(0.75)});
  near(axesOf(View::top, up).up, {1, 0, 0});  // the front is up in the picture
}

/// The same camera draws another scene in the same place; twice the zoom is twice the size about the middle.
TEST(Render, ACameraStaysWhileTheSceneMoves) {
  Scene scene;
  scene.view = View::front;
  scene.meshes.push_back({{{0, -1, -1}, {0, 1, -1}, {0, 0, 1}}, {{0, 1, 2}}, {}, {0.1f, 0.2f, 0.9f}, false, {}});
  Shot shot{scene.view};
  const Camera camera = fitted(scene, shot, 200, 200);
  const Image image = render(scene, shot, camera, 200, 200);
  EXPECT_EQ(image.rgb, render(scene, 200, 200).rgb);
  scene.meshes[0].vertices[2].z = 0;  // the fit would be another
  const Image lower = render(scene, shot, camera, 200, 200);
  EXPECT_TRUE(isBlue(at(lower, 100, 150)));
  EXPECT_FALSE(isBlue(at(lower, 100, 60)));
  shot.zoom = 2;
  EXPECT_DOUBLE_EQ(fitted(scene, shot, 200, 200).pixels_per_m,
                   2 * fitted(scene, Shot{scene.view}, 200, 200).pixels_per_m);
}

/// What a colour of its own means stands in the legend, as a square of the colour.
TEST(Render, ANoteShowsItsColour) {
  Scene scene;
  scene.title = "A garment";
  const auto magenta = [](Rgb c) { return c.r > 200 && c.g < 60 && c.b > 100; };
  Shot shot{scene.view};
  EXPECT_EQ(countWhere(render(scene, shot, fitted(scene, shot, 640, 480), 640, 480), magenta), 0);
  shot.note = ColorNote{{1, 0, 0.58f}, "inside the body by more than 0.2 mm"};
  EXPECT_GT(countWhere(render(scene, shot, fitted(scene, shot, 640, 480), 640, 480), magenta), 60);
  EXPECT_GT(countWhere(render(scene, shot, fitted(scene, shot, 300, 480), 300, 480), magenta), 30);
}

TEST(Render, NearerSurfaceHidesTheFartherOne) {
  Scene scene = focused(0.5);
  scene.meshes = {sphere({-0.3, 0, 0}, 0.15, kGreen), sphere({0.3, 0, 0}, 0.2, kBlue)};
  EXPECT_TRUE(isBlue(at(render(scene, 200, 200), 100, 100)));
  scene.view = View::back;
  EXPECT_TRUE(isGreen(at(render(scene, 200, 200), 100, 100)));
}

TEST(Render, BarEndsHaveTheColoursOfTheMap) {
  Scene scene = focused(0.5);
  scene.meshes = {square(0.4, {0, 10, 10, 0})};
  scene.bar = ColorBar{"Stress [N/m]", 0, 10};
  const int w = 600, h = 700;
  const Image image = render(scene, w, h);
  const Overlay o = layOut(scene, Shot{scene.view}, loadFonts(w, h), w, h);
  const ColorTable table = makeColorTable();
  const int y = static_cast<int>(0.5 * (o.bar.top + o.bar.bottom));
  const auto same = [](Rgb got, Color want) {
    EXPECT_NEAR(got.r, 255 * want.r, 3);
    EXPECT_NEAR(got.g, 255 * want.g, 3);
    EXPECT_NEAR(got.b, 255 * want.b, 3);
  };
  same(at(image, static_cast<int>(o.bar.left) + 1, y), table.front());
  same(at(image, static_cast<int>(o.bar.right) - 2, y), table.back());
  // Nothing lies beyond: no pointed ends.
  EXPECT_GT(at(image, static_cast<int>(o.bar.right + 6 * o.unit), y).b, 200);
  scene.meshes[0].scalars = {0, 11, 11, 0};
  same(at(render(scene, w, h), static_cast<int>(o.bar.right + 6 * o.unit), y), table.back());
}

TEST(Render, FieldRunsThroughTheMapAndNanShowsThePlainColour) {
  Scene scene = focused(0.5);
  scene.meshes = {square(0.45, {0, 10, 10, 0})};
  scene.bar = ColorBar{"", 0, 10};
  const Image image = render(scene, 600, 700);
  const Rgb low = at(image, 100, 290), high = at(image, 510, 290);
  EXPECT_GT(low.b, low.g + 20);    // violet
  EXPECT_GT(high.g, high.b + 80);  // yellow
  scene.meshes[0].scalars = {NAN, NAN, NAN, NAN};
  const Rgb plain = at(render(scene, 600, 700), 300, 290);
  EXPECT_NEAR(plain.r, plain.b, 12);  // the grey of the mesh
}

TEST(Render, ArrowsShowAndShineThroughWhatHidesThem) {
  Scene scene = focused(0.5);
  scene.meshes = {sphere({0, 0, 0}, 0.25, kGrey)};
  scene.arrows = {{{0.4, -0.4, 0.35}, {0.4, 0.4, 0.35}, Arrow{}.color}};
  const double free = countWhere(render(scene, 300, 300), isRed);
  EXPECT_GT(free, 400);
  scene.arrows = {{{0, -0.2, 0}, {0, 0.2, 0}, Arrow{}.color}};  // inside the sphere
  const Rgb hidden = at(render(scene, 300, 300), 140, 150);
  scene.arrows.clear();
  const Rgb bare = at(render(scene, 300, 300), 140, 150);
  EXPECT_GT((hidden.r - hidden.g) - (bare.r - bare.g), 25);  // faintly red
  EXPECT_LT(hidden.r - hidden.g, 130);                       // but not as if before it
}

TEST(Render, LegendArrowHasTheTrueLength) {
  Scene scene = focused(0.5);
  scene.arrow_legend = "10 N";
  scene.arrow_legend_length_m = 0.2;
  const int w = 600, h = 700;
  const Overlay o = layOut(scene, Shot{scene.view}, loadFonts(w, h), w, h);
  const Image image = render(scene, w, h);
  int first = w, last = 0;
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x)
      if (isRed(at(image, x, y))) first = std::min(first, x), last = std::max(last, x);
  EXPECT_NEAR(last + 1 - first, 0.2 * fitCamera(scene, scene.view, o.free).pixels_per_m, 4);
}

/// In pictures of 320 and 480 pixels this heading lay over legend and bar: it gives way there, and stands in a larger
/// one.
TEST(Render, TextsOfSmallPicturesDoNotLieOverEachOther) {
  Scene scene = focused(0.5);
  scene.title = "A shirt with long sleeves and a long name on a man who stands";
  scene.subtitle = "Largest stretch of the fabric at 0.20 s, seen from the front left";
  scene.bar = ColorBar{"Largest stretch of the fabric [%]; here up to 38", 0, 10};
  scene.arrow_legend = "10 N";
  scene.arrow_legend_length_m = 0.2;
  Shot shot{scene.view};
  shot.note = ColorNote{{1, 0, 1}, "inside the body by more than 0.2 mm"};
  for (const auto& [w, h] : {std::pair(320, 240), std::pair(480, 360), std::pair(1280, 960)}) {
    const Overlay o = layOut(scene, shot, loadFonts(w, h), w, h);
    EXPECT_TRUE(o.wide);
    EXPECT_LE(o.block_title.bottom, o.legend.top) << w;
    EXPECT_LE(o.legend.bottom, o.bar.top) << w;
    EXPECT_EQ(o.title.empty(), w < 1000) << w;
  }
}

TEST(Render, TextsStandOnTheirPlaces) {
  Scene scene = focused(0.5);
  const Image bare = render(scene, 400, 400);
  scene.title = "Shorts";
  const Image titled = render(scene, 400, 400);
  double changed_above = 0, changed_below = 0;
  for (int y = 0; y < 400; ++y)
    for (int x = 0; x < 400; ++x)
      if (std::abs(at(bare, x, y).g - at(titled, x, y).g) > 60) (y < 100 ? changed_above : changed_below) += 1;
  EXPECT_GT(changed_above, 100);
  EXPECT_EQ(changed_below, 0);
}

TEST(Render, BoundaryEdgesAreDarker) {
  Scene scene = focused(0.5);
  scene.meshes = {square(0.4, {})};
  const auto dark = [](Rgb c) { return c.r < 160; };
  EXPECT_EQ(countWhere(render(scene, 300, 300), dark), 0);
  scene.meshes[0].edges = true;
  EXPECT_GT(countWhere(render(scene, 300, 300), dark), 300);
}

TEST(Render, SmoothNormalsOfASphereAreRadial) {
  RenderMesh mesh = sphere({0, 0, 0}, 1, kGrey);
  const auto exact = mesh.normals;
  const auto computed = smoothNormals(mesh);
  for (std::size_t i = 0; i < exact.size(); ++i) EXPECT_LT(norm(computed[i] - exact[i]), 2e-3);
}

TEST(Render, SameBitsTwice) {
  Scene scene = focused(0.5);
  scene.meshes = {sphere({0, 0, 0}, 0.3, kBlue)};
  scene.title = "Twice";
  scene.ground_m = -0.3;
  scene.view = View::front_left;
  EXPECT_EQ(render(scene, 200, 200).rgb, render(scene, 200, 200).rgb);
}

TEST(Render, GroundLiesBelowAndTakesAShadow) {
  Scene scene = focused(0.5);
  scene.view = View::front_left;
  scene.meshes = {sphere({0, 0, -0.2}, 0.2, kBlue)};
  const Image bare = render(scene, 300, 300);
  scene.ground_m = -0.4;
  const Image grounded = render(scene, 300, 300);
  double darker = 0;
  for (int y = 0; y < 300; ++y)
    for (int x = 0; x < 300; ++x) darker += at(bare, x, y).g - at(grounded, x, y).g > 15 ? 1 : 0;
  EXPECT_GT(darker, 200);
  EXPECT_LT(darker, 0.4 * 300 * 300);  // a shadow, not a night
}

TEST(Render, RefusesWhatItCannotDraw) {
  Scene good = focused(0.5);
  EXPECT_THROW(render(good, 8, 200), RunError);
  EXPECT_THROW(render(good, 200, 9000), RunError);
  Scene scene = good;
  scene.meshes = {sphere({0, 0, 0}, 0.3, kBlue)};
  scene.meshes[0].vertices[7].y = NAN;
  EXPECT_THROW(render(scene, 100, 100), RunError);
  scene = good;
  scene.meshes = {square(0.4, {1, 2})};
  EXPECT_THROW(render(scene, 100, 100), RunError);
  scene.meshes = {square(0.4, {})};
  scene.meshes[0].triangles[0][1] = 4;
  EXPECT_THROW(render(scene, 100, 100), RunError);
  scene = good;
  scene.bar = ColorBar{"", 1, NAN};
  EXPECT_THROW(render(scene, 400, 400), RunError);
  scene.bar = ColorBar{"", 1, 0};
  EXPECT_THROW(render(scene, 400, 400), RunError);
  scene.bar = ColorBar{"", 0, 0};
  EXPECT_NO_THROW(render(scene, 400, 400));
  scene = good;
  scene.arrows = {{{0, 0, 0}, {0, 0, std::numeric_limits<double>::infinity()}, {}}};
  EXPECT_THROW(render(scene, 100, 100), RunError);
  scene = good;
  scene.up = {0, 0, 0};
  EXPECT_THROW(render(scene, 100, 100), RunError);
}

/// Texts that leave the scene no room are left out, the heading first.
TEST(Render, ASmallPictureIsDrawnWithoutItsTexts) {
  Scene scene = focused(0.5);
  scene.meshes = {sphere({0, 0, 0}, 0.4, kBlue)};
  scene.title = "A title of some length that does not fit into a small picture at all";
  scene.subtitle = "And what stands below it";
  scene.bar = ColorBar{"Stress in the fabric: largest pull [N/m]; here up to 12", 0, 10};
  for (const auto& [w, h] : {std::pair{64, 64}, {64, 400}, {400, 64}, {200, 200}, {16, 16}}) {
    const Image image = render(scene, w, h);
    EXPECT_EQ(image.rgb.size(), 3u * static_cast<unsigned>(w * h));
    EXPECT_GT(countWhere(image, isBlue), 0) << w << " x " << h;
  }
  scene.title = std::string(3000, 'x');
  EXPECT_GT(countWhere(render(scene, 640, 480), isBlue), 0);
}

/// Beyond two million pixels a picture is drawn in strips, which show what one picture of half the size does.
TEST(Render, ALargePictureIsDrawnInStrips) {
  Scene scene = focused(0.5);
  scene.view = View::front_left;
  scene.meshes = {sphere({0, 0, 0.1}, 0.3, kBlue), sphere({0.2, 0.1, -0.2}, 0.2, kGreen)};
  scene.arrows = {{{0, 0.4, 0.4}, {0, 0, 0.4}, {0.8f, 0.1f, 0.1f}}};
  scene.ground_m = -0.4;
  constexpr int w = 820, h = 700;
  const Image small = render(scene, w, h), large = render(scene, 2 * w, 2 * h);
  ASSERT_GT(4 * w * h, 2100000);
  double worst_row = 0;
  for (int y = 0; y < h; ++y) {
    double sum = 0;
    for (int x = 0; x < w; ++x) {
      const Rgb a = at(small, x, y), b = at(large, 2 * x, 2 * y), c = at(large, 2 * x + 1, 2 * y + 1);
      sum += std::abs(a.r - (b.r + c.r) / 2) + std::abs(a.g - (b.g + c.g) / 2) + std::abs(a.b - (b.b + c.b) / 2);
    }
    worst_row = std::max(worst_row, sum / (3 * w));
  }
  EXPECT_LT(worst_row, 6);  // of 255; a strip in a wrong place is some 30 off
}

TEST(Render, PicturesBeforeLeaveNoTrace) {
  // Context, shaders and images are kept from picture to picture.
  Scene scene = focused(0.5);
  scene.meshes = {sphere({0, 0, 0}, 0.3, kBlue)};
  Scene full = focused(0.3);
  full.meshes = {sphere({0, 0.1, 0}, 0.4, kGreen), square(0.3, {0, 1, 2, 3})};
  full.bar = ColorBar{"Stress [Pa]", 0, 3};
  full.ground_m = -0.4;
  full.arrows = {Arrow{{0.5, 0, 0}, {0.5, 0.2, 0.1}}};
  const Image first = render(scene, 160, 120), other = render(full, 160, 120);
  EXPECT_NE(first.rgb, other.rgb);
  EXPECT_EQ(render(scene, 160, 120).rgb, first.rgb) << "what arrows were drawn before stays in an image";
  render(full, 200, 300);
  EXPECT_EQ(render(scene, 160, 120).rgb, first.rgb);
  EXPECT_EQ(render(full, 160, 120).rgb, other.rgb);
}

TEST(Render, SaysWhichPackageHasTheFont) {
  try {
    findFont(FontWeight::regular, {"/nonexistent"});
    FAIL();
  } catch (const RunError& e) {
    EXPECT_NE(std::string(e.what()).find("fonts-dejavu-core"), std::string::npos);
  }
}

TEST(Render, WrapsTexts) {
  const Font font(findFont(FontWeight::regular, fontFolders()), 20);
  const double w = font.width("male 50th percentile");
  EXPECT_EQ(font.wrap("male 50th percentile \u00b7 t = 1 s", 1.2 * w),
            (std::vector<std::string>{"male 50th percentile", "t = 1 s"}));
  EXPECT_EQ(font.wrap("a \u00b7 b", w), std::vector<std::string>{"a \u00b7 b"});
  EXPECT_EQ(font.wrap("male 50th percentile", 0.7 * w).size(), 2u);
  EXPECT_TRUE(font.wrap("", w).empty());
}

TEST(ColorMap, StepsAreEvenInOklabAndInsideSrgb) {
  // sRGB to OKLab (Ottosson 2020), the inverse of what makes the table.
  const ColorTable table = makeColorTable();
  const auto oklab = [](Color c) {
    const double r = linearOfSrgb(c.r), g = linearOfSrgb(c.g), b = linearOfSrgb(c.b);
    const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
    const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
    const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
    return Vec3{0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
                1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
                0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
  };
  double least = 1, most = 0;
  for (std::size_t i = 1; i < table.size(); ++i) {
    const Vec3 a = oklab(table[i - 1]), b = oklab(table[i]);
    EXPECT_GT(b.x, a.x);  // ever lighter
    least = std::min(least, norm(b - a)), most = std::max(most, norm(b - a));
  }
  // A clamped colour would break the even steps.
  EXPECT_LT(most / least, 1.01);
}

TEST(Png, RoundTripsAndIsWrittenWhole) {
  Image image;
  image.width = 3, image.height = 2;
  for (int i = 0; i < 18; ++i) image.rgb.push_back(static_cast<unsigned char>(13 * i));
  const auto file = std::filesystem::temp_directory_path() / "gambeson_png_test.png";
  writePng(image, file);
  png_image reader{};
  reader.version = PNG_IMAGE_VERSION;
  ASSERT_TRUE(png_image_begin_read_from_file(&reader, file.c_str()));
  reader.format = PNG_FORMAT_RGB;
  std::vector<unsigned char> back(PNG_IMAGE_SIZE(reader));
  ASSERT_TRUE(png_image_finish_read(&reader, nullptr, back.data(), 0, nullptr));
  EXPECT_EQ(back, image.rgb);
  EXPECT_EQ(reader.width, 3u);
  std::filesystem::remove(file);
}

TEST(Png, ThrowsWhereItCannotWrite) {
  Image image;
  image.width = image.height = 1;
  image.rgb = {1, 2, 3};
  EXPECT_THROW(writePng(image, "/nonexistent/folder/picture.png"), RunError);
  EXPECT_FALSE(std::filesystem::exists("/nonexistent"));
}

}  // namespace
}  // namespace gambeson
