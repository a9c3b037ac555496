#include "gl/context.hpp"

#include <fmt/format.h>

#include <clocale>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "common/error.hpp"
#include "gl/library.hpp"

namespace chute::gl {
namespace {

void pin_environment() {
  // llvmpipe's results depend on the width of its vectors in the last bit: the narrowest, which every machine
  // has. Mesa reads this once.
  ::setenv("LP_NATIVE_VECTOR_WIDTH", "128", 1);
  std::setlocale(LC_ALL, "C");
}

}  // namespace

struct Context::Inside {
  OSMesaContext context = nullptr;
  std::vector<std::uint8_t> buffer;
  int width, height;
};

Context::Context(int width, int height, int depth_bits) : inside_(std::make_unique<Inside>()) {
  pin_environment();
  inside_->width = width, inside_->height = height;
  inside_->buffer.resize(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  // clang-format off
  const int attributes[] = {OSMESA_FORMAT, OSMESA_RGBA,
                            OSMESA_DEPTH_BITS, depth_bits,
                            OSMESA_PROFILE, OSMESA_CORE_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION, 3,
                            OSMESA_CONTEXT_MINOR_VERSION, 3,
                            0};
  // clang-format on
  inside_->context = library().create_context(attributes, nullptr);
  if (!inside_->context) throw WorkError("cannot draw: OSMesa gives no OpenGL 3.3 context");
  try {
    make_current();
  } catch (...) {
    library().destroy_context(inside_->context);
    throw;
  }
}

Context::~Context() { library().destroy_context(inside_->context); }

void Context::make_current() {
  auto& in = *inside_;
  if (!library().make_current(in.context, in.buffer.data(), GL_UNSIGNED_BYTE, in.width, in.height))
    throw WorkError(
        fmt::format("cannot draw: OSMesa refuses a picture of {} x {} pixels", in.width, in.height));
}

std::string Context::version() {
  const auto get = reinterpret_cast<const GLubyte* (*)(GLenum)>(function("glGetString"));
  const auto text = [&](GLenum what) {
    const auto* bytes = get(what);
    return std::string(bytes ? reinterpret_cast<const char*>(bytes) : "unknown");
  };
  const auto version = text(GL_VERSION);
  const auto mesa = version.find("Mesa");
  return (mesa == std::string::npos ? version : version.substr(mesa)) + ", " + text(GL_RENDERER);
}

struct KeepCurrent::Inside {
  OSMesaContext context = library().current_context();
  void* buffer = nullptr;
  GLint width = 0, height = 0;
};

KeepCurrent::KeepCurrent() : inside_(std::make_unique<Inside>()) {
  GLint format = 0;
  if (inside_->context)
    library().color_buffer(inside_->context, &inside_->width, &inside_->height, &format, &inside_->buffer);
}

KeepCurrent::~KeepCurrent() {
  if (inside_->context && inside_->buffer)
    library().make_current(inside_->context, inside_->buffer, GL_UNSIGNED_BYTE, inside_->width,
                           inside_->height);
  else
    library().make_current(nullptr, nullptr, 0, 0, 0);
}

Function function(const char* name) {
  const auto found = library().address(name);
  if (!found) throw WorkError(fmt::format("cannot draw: OSMesa lacks {}", name));
  return reinterpret_cast<Function>(found);
}

}  // namespace chute::gl
