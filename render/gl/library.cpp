#include "gl/library.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <type_traits>

#include "common/error.hpp"

namespace chute::gl {
namespace {

/// The library's name is its binary interface's: another one would have other functions.
constexpr auto file = "libOSMesa.so.8";

Library load() {
  // Never unloaded: Mesa keeps threads and caches for as long as the program runs.
  void* handle = ::dlopen(file, RTLD_NOW | RTLD_LOCAL);
  if (!handle) throw WorkError(fmt::format("cannot draw: {}", ::dlerror()));
  const auto find = [&](auto& into, const char* name) {
    into = reinterpret_cast<std::remove_reference_t<decltype(into)>>(::dlsym(handle, name));
    if (!into) throw WorkError(fmt::format("cannot draw: {} lacks {}", file, name));
  };
  Library found;
  find(found.create_context, "OSMesaCreateContextAttribs");
  find(found.destroy_context, "OSMesaDestroyContext");
  find(found.make_current, "OSMesaMakeCurrent");
  find(found.current_context, "OSMesaGetCurrentContext");
  find(found.color_buffer, "OSMesaGetColorBuffer");
  find(found.address, "OSMesaGetProcAddress");
  return found;
}

}  // namespace

const Library& library() {
  static const Library loaded = load();
  return loaded;
}

}  // namespace chute::gl

void (*chute_gl_address(const char* name))(void) { return chute::gl::library().address(name); }
