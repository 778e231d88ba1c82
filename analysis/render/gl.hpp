#pragma once
/// An OSMesa core profile, and the OpenGL functions that the renderer calls, loaded through it.

// The order matters: after gl.h, which osmesa.h brings, glcorearb.h leaves out the function types of OpenGL 1.
// clang-format off
#include <GL/glcorearb.h>
#include <GL/osmesa.h>
// clang-format on

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace gambeson {

// clang-format off
#define GAMBESON_GL(use)                                                                                              \
  use(ACTIVETEXTURE, ActiveTexture) use(ATTACHSHADER, AttachShader) use(BINDBUFFER, BindBuffer)                       \
  use(BINDFRAMEBUFFER, BindFramebuffer) use(BINDRENDERBUFFER, BindRenderbuffer) use(BINDTEXTURE, BindTexture)         \
  use(BINDVERTEXARRAY, BindVertexArray) use(BLENDFUNCSEPARATE, BlendFuncSeparate) use(BLITFRAMEBUFFER, BlitFramebuffer) \
  use(BUFFERDATA, BufferData) use(CHECKFRAMEBUFFERSTATUS, CheckFramebufferStatus) use(CLEAR, Clear)                   \
  use(CLEARCOLOR, ClearColor) use(COLORMASK, ColorMask) use(COMPILESHADER, CompileShader)                             \
  use(CREATEPROGRAM, CreateProgram) use(CREATESHADER, CreateShader) use(DELETEBUFFERS, DeleteBuffers)                 \
  use(DELETEFRAMEBUFFERS, DeleteFramebuffers) use(DELETEPROGRAM, DeleteProgram)                                       \
  use(DELETERENDERBUFFERS, DeleteRenderbuffers) use(DELETESHADER, DeleteShader) use(DELETETEXTURES, DeleteTextures)   \
  use(DELETEVERTEXARRAYS, DeleteVertexArrays) use(DEPTHFUNC, DepthFunc) use(DEPTHMASK, DepthMask) use(DISABLE, Disable) \
  use(DRAWARRAYS, DrawArrays) use(DRAWBUFFER, DrawBuffer) use(DRAWELEMENTS, DrawElements) use(ENABLE, Enable)         \
  use(ENABLEVERTEXATTRIBARRAY, EnableVertexAttribArray) use(FINISH, Finish)                                           \
  use(FRAMEBUFFERRENDERBUFFER, FramebufferRenderbuffer) use(FRAMEBUFFERTEXTURE2D, FramebufferTexture2D)               \
  use(GENBUFFERS, GenBuffers) use(GENFRAMEBUFFERS, GenFramebuffers) use(GENRENDERBUFFERS, GenRenderbuffers)           \
  use(GENTEXTURES, GenTextures) use(GENVERTEXARRAYS, GenVertexArrays) use(GETERROR, GetError)                         \
  use(GETPROGRAMINFOLOG, GetProgramInfoLog) use(GETPROGRAMIV, GetProgramiv) use(GETSHADERINFOLOG, GetShaderInfoLog)   \
  use(GETSHADERIV, GetShaderiv) use(GETUNIFORMLOCATION, GetUniformLocation) use(LINKPROGRAM, LinkProgram)             \
  use(PIXELSTOREI, PixelStorei) use(READBUFFER, ReadBuffer) use(READPIXELS, ReadPixels)                               \
  use(RENDERBUFFERSTORAGEMULTISAMPLE, RenderbufferStorageMultisample) use(SHADERSOURCE, ShaderSource)                 \
  use(TEXIMAGE2D, TexImage2D) use(TEXPARAMETERI, TexParameteri) use(UNIFORM1F, Uniform1f) use(UNIFORM1I, Uniform1i)   \
  use(UNIFORM2F, Uniform2f) use(UNIFORM3F, Uniform3f) use(UNIFORMMATRIX4FV, UniformMatrix4fv)                         \
  use(USEPROGRAM, UseProgram) use(VERTEXATTRIBPOINTER, VertexAttribPointer) use(VIEWPORT, Viewport)
// clang-format on

class ShaderProgram;
class Target;

/// A current context for the lifetime of this object; `gl.Clear(...)` calls glClear.
class Gl {
 public:
  Gl();
  ~Gl();
  Gl(const Gl&) = delete;
  Gl& operator=(const Gl&) = delete;

#define GAMBESON_GL_DECLARE(type, name) PFNGL##type##PROC name = nullptr;
  GAMBESON_GL(GAMBESON_GL_DECLARE)
#undef GAMBESON_GL_DECLARE

  /// Throws RunError where OpenGL reports an error since the last check.
  void check(const char* what) const;

  /// The program of these shaders, built when it is first asked for.
  const ShaderProgram& program(const std::string& vertex, const std::string& fragment) const;
  /// The target of that name (see Target for the rest), with what was last drawn into it. It is made anew where it was
  /// of another size; `color` and the rest are the same in each call for one name.
  const Target& target(const char* name, int width, int height, GLenum color, int samples,
                       bool shadow_depth = false) const;

 private:
  OSMesaContext context_ = nullptr;
  mutable std::map<std::pair<std::string, std::string>, std::unique_ptr<ShaderProgram>> programs_;
  mutable std::map<std::string, std::unique_ptr<Target>> targets_;
  std::vector<unsigned char> small_;  ///< OSMesa's own buffer, which nobody draws into
};

/// The context of this thread, current. It is made for the first picture and stays until the process ends, so that
/// later pictures find their shaders compiled and their images there, which OSMesa would fill with zeros first.
const Gl& openGl();

/// A program of one vertex and one fragment shader.
class ShaderProgram {
 public:
  ShaderProgram(const Gl& gl, const std::string& vertex, const std::string& fragment);
  ~ShaderProgram() { gl_.DeleteProgram(id_); }
  ShaderProgram(const ShaderProgram&) = delete;
  ShaderProgram& operator=(const ShaderProgram&) = delete;
  void use() const { gl_.UseProgram(id_); }
  GLint at(const char* name) const { return gl_.GetUniformLocation(id_, name); }

 private:
  const Gl& gl_;
  GLuint id_;
};

/// A framebuffer with one colour (or none) and one depth image: textures, or multisampled renderbuffers.
class Target {
 public:
  /// `color` is a sized format or 0. samples = 0 gives textures.
  Target(const Gl& gl, int width, int height, GLenum color, int samples, bool shadow_depth = false);
  ~Target();
  Target(const Target&) = delete;
  Target& operator=(const Target&) = delete;
  void bind() const;
  GLuint framebuffer() const { return framebuffer_; }
  GLuint colorTexture() const { return color_; }
  GLuint depthTexture() const { return depth_; }
  int width() const { return width_; }
  int height() const { return height_; }
  /// Resolves the samples of the colour into `other`, of the same size.
  void resolveInto(const Target& other) const;

 private:
  const Gl& gl_;
  int width_, height_, samples_;
  GLuint framebuffer_ = 0, color_ = 0, depth_ = 0;
};

}  // namespace gambeson
