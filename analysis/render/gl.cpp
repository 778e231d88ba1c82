#include "analysis/render/gl.hpp"

#include <dlfcn.h>
#include <malloc.h>
#include <unistd.h>

#include <type_traits>

#include "core/error.hpp"

namespace gambeson {
namespace {

/// The images of a picture take some 200 MB, which malloc would give back to the system after each picture and get anew
/// for the next, page by page: a quarter of the time of all. It keeps them from the first picture on.
void keepMemory() {
  constexpr int most_kept = 1 << 30;
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, most_kept);
}

/// What is called of OSMesa. It brings a compiler that takes some 50 ms of the processor to load, several times what a
/// command needs that draws nothing: it is loaded for the first picture, and stays.
struct Mesa {
  decltype(&OSMesaCreateContextAttribs) create;
  decltype(&OSMesaMakeCurrent) makeCurrent;
  decltype(&OSMesaDestroyContext) destroy;
  decltype(&OSMesaGetProcAddress) address;
};

const Mesa& mesa() {
  static const Mesa loaded = [] {
    const char* const name = "libOSMesa.so.8";
    void* const handle = dlopen(name, RTLD_NOW | RTLD_LOCAL);
    if (!handle) throw RunError(std::string("cannot draw: ") + dlerror() + " (Debian package libosmesa6)");
    const auto of = [&](auto& function, const char* symbol) {
      function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(handle, symbol));
      if (!function) throw RunError(std::string("cannot draw: ") + name + " lacks " + symbol);
    };
    Mesa out{};
    of(out.create, "OSMesaCreateContextAttribs");
    of(out.makeCurrent, "OSMesaMakeCurrent");
    of(out.destroy, "OSMesaDestroyContext");
    of(out.address, "OSMesaGetProcAddress");
    return out;
  }();
  return loaded;
}

}  // namespace

Gl::Gl() : small_(4 * 16 * 16) {
  const Mesa& osmesa = mesa();
  keepMemory();
  const int attributes[] = {OSMESA_FORMAT,
                            OSMESA_RGBA,
                            OSMESA_DEPTH_BITS,
                            0,
                            OSMESA_PROFILE,
                            OSMESA_CORE_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION,
                            3,
                            OSMESA_CONTEXT_MINOR_VERSION,
                            3,
                            0};
  context_ = osmesa.create(attributes, nullptr);
  if (!context_) throw RunError("cannot draw: OSMesa gives no OpenGL 3.3 core profile (Debian package libosmesa6)");
  if (!osmesa.makeCurrent(context_, small_.data(), GL_UNSIGNED_BYTE, 16, 16)) {
    osmesa.destroy(context_);
    throw RunError("cannot draw: OSMesa does not make its context current");
  }
  std::string missing;
#define GAMBESON_GL_LOAD(type, name)                                      \
  name = reinterpret_cast<PFNGL##type##PROC>(osmesa.address("gl" #name)); \
  if (!name) missing += " gl" #name;
  GAMBESON_GL(GAMBESON_GL_LOAD)
#undef GAMBESON_GL_LOAD
  if (!missing.empty()) {
    osmesa.destroy(context_);
    throw RunError("cannot draw: OSMesa lacks" + missing);
  }
}

Gl::~Gl() {
  targets_.clear();
  programs_.clear();
  mesa().makeCurrent(nullptr, nullptr, 0, 0, 0);
  mesa().destroy(context_);
}

void Gl::check(const char* what) const {
  if (const GLenum error = GetError(); error != GL_NO_ERROR)
    throw RunError("cannot draw: OpenGL error " + std::to_string(error) + " in " + what +
                   (error == GL_OUT_OF_MEMORY ? " (out of memory)" : ""));
}

const ShaderProgram& Gl::program(const std::string& vertex, const std::string& fragment) const {
  std::unique_ptr<ShaderProgram>& found = programs_[{vertex, fragment}];
  if (!found) found = std::make_unique<ShaderProgram>(*this, vertex, fragment);
  return *found;
}

const Target& Gl::target(const char* name, int width, int height, GLenum color, int samples, bool shadow_depth) const {
  std::unique_ptr<Target>& found = targets_[name];
  if (!found || found->width() != width || found->height() != height) {
    found.reset();  // before the next, which may be large
    found = std::make_unique<Target>(*this, width, height, color, samples, shadow_depth);
  }
  return *found;
}

const Gl& openGl() {
  struct Kept {
    pid_t process = getpid();
    Gl gl;
  };
  // Left to the end of the process: OSMesa's own threads are gone in a child, where nothing may wait for them.
  thread_local Kept* kept = nullptr;
  if (!kept || kept->process != getpid()) kept = new Kept;
  while (kept->gl.GetError() != GL_NO_ERROR) {  // of a picture that failed
  }
  return kept->gl;
}

ShaderProgram::ShaderProgram(const Gl& gl, const std::string& vertex, const std::string& fragment)
    : gl_(gl), id_(gl.CreateProgram()) {
  std::string log;
  const auto add = [&](GLenum kind, const std::string& source) {
    const GLuint shader = gl.CreateShader(kind);
    const char* text = source.c_str();
    gl.ShaderSource(shader, 1, &text, nullptr);
    gl.CompileShader(shader);
    GLint good = 0;
    gl.GetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (!good) {
      char buffer[2048] = {};
      gl.GetShaderInfoLog(shader, sizeof buffer, nullptr, buffer);
      log += buffer;
    }
    gl.AttachShader(id_, shader);
    gl.DeleteShader(shader);
  };
  add(GL_VERTEX_SHADER, vertex);
  add(GL_FRAGMENT_SHADER, fragment);
  gl.LinkProgram(id_);
  GLint good = 0;
  gl.GetProgramiv(id_, GL_LINK_STATUS, &good);
  if (!good) {
    char buffer[2048] = {};
    gl.GetProgramInfoLog(id_, sizeof buffer, nullptr, buffer);
    gl.DeleteProgram(id_);
    throw RunError("cannot draw: a shader does not build: " + log + buffer);
  }
}

Target::Target(const Gl& gl, int width, int height, GLenum color, int samples, bool shadow_depth)
    : gl_(gl), width_(width), height_(height), samples_(samples) {
  gl.GenFramebuffers(1, &framebuffer_);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  const auto texture = [&](GLenum format, GLenum kind, GLenum type, GLenum attachment) {
    GLuint id = 0;
    gl.GenTextures(1, &id);
    gl.BindTexture(GL_TEXTURE_2D, id);
    gl.TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format), width, height, 0, kind, type, nullptr);
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
      gl.TexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
      gl.TexParameteri(GL_TEXTURE_2D, filter, shadow_depth ? GL_LINEAR : GL_NEAREST);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, id, 0);
    return id;
  };
  const auto buffer = [&](GLenum format, GLenum attachment) {
    GLuint id = 0;
    gl.GenRenderbuffers(1, &id);
    gl.BindRenderbuffer(GL_RENDERBUFFER, id);
    gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, width, height);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, id);
    return id;
  };
  if (samples > 0) {
    if (color) color_ = buffer(color, GL_COLOR_ATTACHMENT0);
    depth_ = buffer(GL_DEPTH_COMPONENT32F, GL_DEPTH_ATTACHMENT);
  } else {
    if (color)
      color_ = texture(color, GL_RGBA, color == GL_RGBA32F ? GL_FLOAT : GL_UNSIGNED_BYTE, GL_COLOR_ATTACHMENT0);
    depth_ = texture(GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, GL_DEPTH_ATTACHMENT);
    if (shadow_depth) {
      gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
      gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    }
  }
  if (!color) {
    gl.DrawBuffer(GL_NONE);
    gl.ReadBuffer(GL_NONE);
  }
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw RunError("cannot draw: OpenGL gives no image of " + std::to_string(width) + " x " + std::to_string(height));
}

Target::~Target() {
  gl_.DeleteFramebuffers(1, &framebuffer_);
  if (samples_ > 0) {
    gl_.DeleteRenderbuffers(1, &color_);
    gl_.DeleteRenderbuffers(1, &depth_);
  } else {
    gl_.DeleteTextures(1, &color_);
    gl_.DeleteTextures(1, &depth_);
  }
}

void Target::bind() const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.Viewport(0, 0, width_, height_);
}

void Target::resolveInto(const Target& other) const {
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, other.framebuffer_);
  gl_.BlitFramebuffer(0, 0, width_, height_, 0, 0, other.width_, other.height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

}  // namespace gambeson
