#include "analysis/render/passes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "analysis/render/gl.hpp"
#include "analysis/render/shaders.hpp"

namespace gambeson {
namespace {

using Matrix = std::array<float, 16>;  ///< by columns

struct Box {
  Vec3 low{1e30, 1e30, 1e30}, high{-1e30, -1e30, -1e30};
  void add(const Vec3& p) {
    for (int i = 0; i < 3; ++i) low[i] = std::min(low[i], p[i]), high[i] = std::max(high[i], p[i]);
  }
};

Vec3 positionOf(const DrawVertex& v) { return {v.position[0], v.position[1], v.position[2]}; }

/// The orthographic matrix that maps the box, in coordinates along the rows r, onto the clip cube (z reversed: towards
/// the viewer is near).
Matrix orthographic(const Vec3 r[3], const Box& box) {
  Matrix m{};
  for (int i = 0; i < 3; ++i) {
    const double sign = i == 2 ? -1 : 1, scale = 2 / (box.high[i] - box.low[i]),
                 middle = 0.5 * (box.high[i] + box.low[i]);
    for (int j = 0; j < 3; ++j) m[static_cast<std::size_t>(4 * j + i)] = static_cast<float>(sign * scale * r[i][j]);
    m[static_cast<std::size_t>(12 + i)] = static_cast<float>(-sign * scale * middle);
  }
  m[15] = 1;
  return m;
}

/// Vertices and indices on the OpenGL side.
class Buffers {
 public:
  Buffers(const Gl& gl, const DrawList& list) : gl_(gl), count_(static_cast<GLsizei>(list.indices.size())) {
    gl.GenVertexArrays(1, &array_);
    gl.BindVertexArray(array_);
    gl.GenBuffers(2, buffers_);
    gl.BindBuffer(GL_ARRAY_BUFFER, buffers_[0]);
    gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(list.vertices.size() * sizeof(DrawVertex)),
                  list.vertices.data(), GL_STATIC_DRAW);
    gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers_[1]);
    gl.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(list.indices.size() * sizeof(std::uint32_t)),
                  list.indices.data(), GL_STATIC_DRAW);
    const std::size_t offsets[4] = {offsetof(DrawVertex, position), offsetof(DrawVertex, normal),
                                    offsetof(DrawVertex, color), offsetof(DrawVertex, map)};
    for (GLuint i = 0; i < 4; ++i) {
      gl.EnableVertexAttribArray(i);
      gl.VertexAttribPointer(i, 3, GL_FLOAT, GL_FALSE, sizeof(DrawVertex), reinterpret_cast<const void*>(offsets[i]));
    }
  }
  ~Buffers() {
    gl_.DeleteVertexArrays(1, &array_);
    gl_.DeleteBuffers(2, buffers_);
  }
  Buffers(const Buffers&) = delete;
  Buffers& operator=(const Buffers&) = delete;
  void draw() const {
    if (count_ == 0) return;
    gl_.BindVertexArray(array_);
    gl_.DrawElements(GL_TRIANGLES, count_, GL_UNSIGNED_INT, nullptr);
  }

 private:
  const Gl& gl_;
  GLsizei count_;
  GLuint array_ = 0, buffers_[2] = {};
};

/// A square of ground about the foot of the scene's middle; map and mapped carry the place on it for the grid. Seen
/// edge on it is a thin line instead.
struct Ground {
  DrawList list;
  Vec3 middle;
  double radius_m = 0;
  bool edge_on = false;
};

Ground groundOf(const PassInput& in, const Box& scene) {
  Ground ground;
  const Vec3 up = in.up_camera, centre = 0.5 * (scene.low + scene.high);
  ground.middle = centre + (*in.ground_m - dot(up, centre)) * up;
  ground.radius_m =
      std::max({scene.high.x - scene.low.x, 0.75 * (scene.high.y - scene.low.y), 0.75 * (scene.high.z - scene.low.z)});
  ground.edge_on = std::abs(up.z) < 1e-6;
  Vec3 a{1, 0, 0}, b = cross(up, a);
  Vec3 middle = ground.middle;
  if (ground.edge_on) {
    b = 1.2 / in.camera.pixels_per_m / ground.radius_m * up;
    middle = middle + (scene.low.z - middle.z) * Vec3{0, 0, 1};  // behind everything
    ground.middle = middle;
  }
  for (int k = 0; k < 4; ++k) {
    const double s = k == 0 || k == 3 ? -1 : 1, t = k < 2 ? -1 : 1;
    const Vec3 p = middle + ground.radius_m * (s * a + (ground.edge_on && t > 0 ? 0 : t) * b);
    DrawVertex v{};
    for (int i = 0; i < 3; ++i) v.position[i] = static_cast<float>(p[i]);
    // The grid is counted from the middle of the picture's ground.
    v.map = static_cast<float>(s * ground.radius_m), v.mapped = static_cast<float>(t * ground.radius_m);
    ground.list.vertices.push_back(v);
  }
  ground.list.indices = {0, 1, 2, 0, 2, 3};
  return ground;
}

std::vector<unsigned char> readBack(const Gl& gl, const Target& target) {
  std::vector<unsigned char> pixels(4 * static_cast<std::size_t>(target.width()) *
                                    static_cast<std::size_t>(target.height()));
  gl.BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer());
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl.ReadPixels(0, 0, target.width(), target.height(), GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
  return pixels;
}

void clear(const Gl& gl, const Target& target, float r, float g, float b, float a) {
  target.bind();
  gl.ClearColor(r, g, b, a);
  gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void texture(const Gl& gl, const ShaderProgram& program, const char* name, int unit, GLuint id) {
  gl.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  gl.BindTexture(GL_TEXTURE_2D, id);
  gl.Uniform1i(program.at(name), unit);
}

void uniform(const Gl& gl, GLint at, const Vec3& v) { gl.Uniform3f(at, float(v.x), float(v.y), float(v.z)); }

}  // namespace

Passes drawPasses(const PassInput& in, int width, int height) {
  Box scene;
  for (const auto& v : in.surfaces.vertices) scene.add(positionOf(v));
  Box depth = scene;
  for (const auto& v : in.arrows.vertices) depth.add(positionOf(v));
  if (!(depth.low.x <= depth.high.x)) depth.add({-1, -1, -1}), depth.add({1, 1, 1});
  if (!(scene.low.x <= scene.high.x)) scene = depth;
  const Vec3 size = scene.high - scene.low;
  const double extent = std::max({size.x, size.y, size.z, 1e-6});

  // The sun stands high on the left, before the scene, as in a studio: the same for every view.
  const Vec3 sun = normalized(Vec3{-0.45, 0.35, 0.62} + 0.45 * in.up_camera);
  const Vec3 side = normalized(cross({0, 1, 0}, sun)), top = cross(sun, side);
  Box lit;
  for (const auto& v : in.surfaces.vertices) {
    const Vec3 p = positionOf(v);
    lit.add({dot(side, p), dot(top, p), dot(sun, p)});
  }
  if (!(lit.low.x <= lit.high.x)) lit.add({-1, -1, -1}), lit.add({1, 1, 1});
  std::optional<Ground> ground;
  if (in.ground_m) {
    ground = groundOf(in, scene);
    for (const auto& v : ground->list.vertices) depth.add(positionOf(v));
  }
  for (int i = 0; i < 3; ++i) lit.low[i] -= 0.06 * extent, lit.high[i] += 0.06 * extent;
  const Vec3 sun_rows[3] = {side, top, sun};
  const Matrix S = orthographic(sun_rows, lit);

  const Vec3 camera_rows[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const double scale = in.camera.pixels_per_m, deep = 0.05 * extent;
  Box view;
  view.low = {-in.camera.center_x / scale, (in.camera.center_y - height) / scale, depth.low.z - deep};
  view.high = {(width - in.camera.center_x) / scale, in.camera.center_y / scale, depth.high.z + deep};
  const Matrix P = orthographic(camera_rows, view);

  const Gl& gl = openGl();
  GLuint colors = 0;
  gl.GenTextures(1, &colors);
  gl.BindTexture(GL_TEXTURE_2D, colors);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGB32F, 256, 1, 0, GL_RGB, GL_FLOAT, in.colors.data());
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    gl.TexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    gl.TexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);

  const Buffers surfaces(gl, in.surfaces), arrows(gl, in.arrows), legend(gl, in.legend);
  const std::string version = "#version 330 core\n";
  Passes out;
  out.width = width, out.height = height;
  gl.Enable(GL_DEPTH_TEST);

  // What the sun sees.
  constexpr int sun_size = 2048;
  const Target& sun_target = gl.target("sun", sun_size, sun_size, 0, 0, true);
  {
    const ShaderProgram& program = gl.program(shader::kSurfaceVertex, shader::kNothingFragment);
    clear(gl, sun_target, 0, 0, 0, 0);
    program.use();
    gl.UniformMatrix4fv(program.at("P"), 1, GL_FALSE, S.data());
    surfaces.draw();
  }
  gl.check("the shadow");

  // Normals and depth at the size of the picture, for occlusion and hidden arrows.
  const Target& normals = gl.target("normals", width, height, GL_RGBA32F, 0);
  {
    const ShaderProgram& program = gl.program(shader::kSurfaceVertex, shader::kNormalFragment);
    clear(gl, normals, 0, 0, 0, -1e9f);
    program.use();
    gl.UniformMatrix4fv(program.at("P"), 1, GL_FALSE, P.data());
    surfaces.draw();
  }
  gl.check("the depth");

  const double occlusion_radius = std::min(0.05 * extent, 60 / scale);
  {
    const Target& raw = gl.target("raw", width, height, GL_RGBA8, 0);
    const Target& smooth = gl.target("smooth", width, height, GL_RGBA8, 0);
    gl.Disable(GL_DEPTH_TEST);
    const ShaderProgram& occlusion = gl.program(shader::kScreenVertex, shader::kOcclusionFragment);
    const ShaderProgram& blur = gl.program(shader::kScreenVertex, shader::kBlurFragment);
    raw.bind();
    occlusion.use();
    texture(gl, occlusion, "normals", 0, normals.colorTexture());
    gl.Uniform1f(occlusion.at("metresPerPixel"), float(1 / scale));
    gl.Uniform1f(occlusion.at("radius"), float(occlusion_radius));
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    smooth.bind();
    blur.use();
    texture(gl, blur, "normals", 0, normals.colorTexture());
    texture(gl, blur, "occlusion", 1, raw.colorTexture());
    gl.Uniform1f(blur.at("radius"), float(occlusion_radius));
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    out.occlusion = readBack(gl, smooth);
    gl.Enable(GL_DEPTH_TEST);
  }
  gl.check("the occlusion");

  const Target& samples = gl.target("samples", 2 * width, 2 * height, GL_RGBA8, 4);
  const Target& resolved = gl.target("resolved", 2 * width, 2 * height, GL_RGBA8, 0);
  const auto sunlit = [&](const ShaderProgram& program) {
    program.use();
    gl.UniformMatrix4fv(program.at("P"), 1, GL_FALSE, P.data());
    gl.UniformMatrix4fv(program.at("S"), 1, GL_FALSE, S.data());
    texture(gl, program, "sunDepth", 0, sun_target.depthTexture());
    gl.Uniform1f(program.at("softness"), 0.018f);
  };
  clear(gl, samples, 0, 0, 0, 0);
  if (ground) {
    const ShaderProgram& program =
        gl.program(shader::kSurfaceVertex, version + shader::kSunlight + shader::kGroundFragment);
    const Buffers square(gl, ground->list);
    sunlit(program);
    uniform(gl, program.at("middle"), ground->middle);
    gl.Uniform1f(program.at("radius"), float(ground->radius_m));
    gl.Uniform1f(program.at("edgeOn"), ground->edge_on ? 1.0f : 0.0f);
    gl.DepthMask(GL_FALSE);
    square.draw();
    gl.DepthMask(GL_TRUE);
  }
  {
    const ShaderProgram& program =
        gl.program(shader::kSurfaceVertex, version + shader::kSunlight + shader::kSurfaceFragment);
    sunlit(program);
    texture(gl, program, "map", 1, colors);
    uniform(gl, program.at("up"), in.up_camera);
    uniform(gl, program.at("sun"), sun);
    gl.Uniform1f(program.at("bias"), float(0.006 * extent));
    surfaces.draw();
  }
  samples.resolveInto(resolved);
  gl.check("the surfaces");
  out.surfaces = readBack(gl, resolved);

  clear(gl, samples, 0, 0, 0, 0);
  if (!in.arrows.indices.empty() || !in.legend.indices.empty()) {
    const ShaderProgram& program = gl.program(shader::kSurfaceVertex, shader::kArrowFragment);
    program.use();
    gl.UniformMatrix4fv(program.at("P"), 1, GL_FALSE, P.data());
    texture(gl, program, "normals", 0, normals.colorTexture());
    gl.Uniform2f(program.at("normalsPerPixel"), 0.5f, 0.5f);
    uniform(gl, program.at("sun"), sun);
    gl.Uniform1f(program.at("soft"), float(2 * in.arrow_radius_m));
    gl.Uniform1f(program.at("legend"), 0);
    arrows.draw();
    gl.Clear(GL_DEPTH_BUFFER_BIT);
    gl.Uniform1f(program.at("legend"), 1);
    legend.draw();
  }
  samples.resolveInto(resolved);
  gl.check("the arrows");
  out.arrows = readBack(gl, resolved);
  gl.DeleteTextures(1, &colors);
  return out;
}

}  // namespace gambeson
