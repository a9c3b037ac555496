/* The distribution's VTK finds its OpenGL functions through GLEW, and that GLEW asks GLX, which wants an X
 * server. Here OSMesa draws into memory and there is no server: these functions, exported by the executable,
 * come before libGL's in the dynamic linker's search and send the questions to OSMesa. They exist once per
 * executable (target chute_offscreen). With VTK 9.4, which chooses its window at run time, this file falls
 * away. */
#include <GL/osmesa.h>
#include <string.h>

typedef void (*Function)(void);

/* GLEW's initialisation gives up unless a display answers with a version of GLX and a list of extensions. */
void* glXGetCurrentDisplay(void) {
  static int display;
  return &display;
}

int glXQueryVersion(void* display, int* major, int* minor) {
  (void)display;
  *major = 1;
  *minor = 4;
  return 1;
}

const char* glXGetClientString(void* display, int name) {
  (void)display;
  (void)name;
  return "";
}

Function glXGetProcAddressARB(const unsigned char* bytes) {
  const char* name = (const char*)bytes;
  if (strcmp(name, "glXGetCurrentDisplay") == 0) return (Function)glXGetCurrentDisplay;
  if (strcmp(name, "glXQueryVersion") == 0) return (Function)glXQueryVersion;
  if (strcmp(name, "glXGetClientString") == 0) return (Function)glXGetClientString;
  if (strncmp(name, "glX", 3) == 0) return 0; /* OSMesa would answer with stubs that do nothing */
  return (Function)OSMesaGetProcAddress(name);
}

Function glXGetProcAddress(const unsigned char* name) { return glXGetProcAddressARB(name); }
