#include "view/gl_context.hpp"

#include <GL/osmesa.h>
#include <fmt/format.h>

#include <clocale>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "common/error.hpp"

namespace chute::view {
namespace {

struct OsmesaContext : GlContext {
  OSMesaContext context = nullptr;
  std::vector<std::uint8_t> buffer;
  int width, height;

  OsmesaContext(int w, int h)
      : buffer(4 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h)), width(w), height(h) {
    // clang-format off
    const int attributes[] = {OSMESA_FORMAT, OSMESA_RGBA,
                              OSMESA_DEPTH_BITS, 24,
                              OSMESA_PROFILE, OSMESA_CORE_PROFILE,
                              OSMESA_CONTEXT_MAJOR_VERSION, 3,
                              OSMESA_CONTEXT_MINOR_VERSION, 3,
                              0};
    // clang-format on
    context = OSMesaCreateContextAttribs(attributes, nullptr);
    if (!context) throw WorkError("cannot draw: OSMesa gives no OpenGL 3.3 context");
  }
  ~OsmesaContext() override { OSMesaDestroyContext(context); }

  void make_current() override {
    if (!OSMesaMakeCurrent(context, buffer.data(), GL_UNSIGNED_BYTE, width, height))
      throw WorkError(fmt::format("cannot draw: OSMesa refuses a picture of {} x {} pixels", width, height));
  }
};

}  // namespace

void pin_environment() {
  // llvmpipe's results depend on the width of its vectors in the last bit: the narrowest, which every machine
  // has.
  ::setenv("LP_NATIVE_VECTOR_WIDTH", "128", 1);
  std::setlocale(LC_ALL, "C");
}

std::unique_ptr<GlContext> make_osmesa_context(int width, int height) {
  pin_environment();
  auto context = std::make_unique<OsmesaContext>(width, height);
  context->make_current();
  return context;
}

}  // namespace chute::view
