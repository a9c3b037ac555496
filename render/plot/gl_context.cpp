#include "plot/gl_context.hpp"

#include <cstdlib>
#include <mutex>

#include "common/error.hpp"

namespace chute::plot::gl {

Context::Context() {
  // Pixels must not depend on how wide the processor's vectors are; Mesa reads this once.
  static std::once_flag pinned;
  std::call_once(pinned, [] { ::setenv("LP_NATIVE_VECTOR_WIDTH", "128", 1); });

  before_ = OSMesaGetCurrentContext();
  if (before_) {
    GLint format = 0;
    OSMesaGetColorBuffer(before_, &before_width_, &before_height_, &format, &before_buffer_);
  }
  const int wanted[] = {OSMESA_FORMAT,
                        OSMESA_RGBA,
                        OSMESA_DEPTH_BITS,
                        0,
                        OSMESA_STENCIL_BITS,
                        0,
                        OSMESA_ACCUM_BITS,
                        0,
                        OSMESA_PROFILE,
                        OSMESA_CORE_PROFILE,
                        OSMESA_CONTEXT_MAJOR_VERSION,
                        3,
                        OSMESA_CONTEXT_MINOR_VERSION,
                        3,
                        0};
  context_ = OSMesaCreateContextAttribs(wanted, nullptr);
  if (!context_) throw WorkError("cannot draw: OSMesa gives no OpenGL 3.3 context");
  buffer_.resize(16 * 16 * 4);  // never drawn to: the raster has a framebuffer of its own
  if (!OSMesaMakeCurrent(context_, buffer_.data(), GL_UNSIGNED_BYTE, 16, 16)) {
    OSMesaDestroyContext(context_);
    throw WorkError("cannot draw: OSMesa cannot make its context current");
  }
#define CHUTE_GL_LOAD(type, name)                                  \
  call.name = reinterpret_cast<type>(OSMesaGetProcAddress(#name)); \
  if (!call.name) throw WorkError("cannot draw: OSMesa lacks " #name);
  CHUTE_GL_FUNCTIONS(CHUTE_GL_LOAD)
#undef CHUTE_GL_LOAD
}

Context::~Context() {
  if (before_ && before_buffer_)
    OSMesaMakeCurrent(before_, before_buffer_, GL_UNSIGNED_BYTE, before_width_, before_height_);
  else
    OSMesaMakeCurrent(nullptr, nullptr, 0, 0, 0);
  OSMesaDestroyContext(context_);
}

std::string Context::version() const {
  const auto text = [&](GLenum what) {
    const auto* bytes = call.glGetString(what);
    return std::string(bytes ? reinterpret_cast<const char*>(bytes) : "unknown");
  };
  const auto version = text(GL_VERSION);
  const auto mesa = version.find("Mesa");
  return (mesa == std::string::npos ? version : version.substr(mesa)) + ", " + text(GL_RENDERER);
}

}  // namespace chute::plot::gl
