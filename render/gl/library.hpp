#pragma once
#include <GL/osmesa.h>

/// OSMesa, loaded when something is drawn for the first time. It brings LLVM along, whose loading takes a tenth of
/// a second: programs that do not draw (check, info, run) do not pay for it. Seen by the .cpp files of this room only.
namespace chute::gl {

struct Library {
  decltype(&OSMesaCreateContextAttribs) create_context;
  decltype(&OSMesaDestroyContext) destroy_context;
  decltype(&OSMesaMakeCurrent) make_current;
  decltype(&OSMesaGetCurrentContext) current_context;
  decltype(&OSMesaGetColorBuffer) color_buffer;
  decltype(&OSMesaGetProcAddress) address;
};

/// WorkError if it is not there or lacks a function.
const Library& library();

}  // namespace chute::gl

/// For the shim in C that answers VTK's questions for OpenGL functions: null if the library does not know the name.
extern "C" void (*chute_gl_address(const char* name))(void);
