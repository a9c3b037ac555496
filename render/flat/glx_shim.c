/* The distribution's VTK finds its OpenGL functions through GLEW, and that GLEW asks GLX, which wants an X
 * server; those of OpenGL 1.1 it takes straight from libGL. Here OSMesa draws into memory and there is no server: these
 * functions, exported by the executable, come before libGL's in the dynamic linker's search and send questions and
 * calls to OSMesa, which is loaded when something is drawn (gl/library.hpp). They exist once per executable
 * (target chute_offscreen). With VTK 9.4, which chooses its window at run time, this file falls away. */
#include <GL/gl.h>
#include <string.h>

typedef void (*Function)(void);
extern Function chute_gl_address(const char* name);

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
  return chute_gl_address(name);
}

Function glXGetProcAddress(const unsigned char* name) { return glXGetProcAddressARB(name); }

/* What the VTK library asks of libGL by name (nm -D --undefined-only libvtkRenderingOpenGL2-9.1.so.1). It calls on
 * several threads, each with a context of its own; the addresses are the same for all of them. */
#define TELL(name, parameters, arguments)              \
  void name parameters {                               \
    static _Atomic(Function) found;                    \
    Function call = found;                             \
    if (!call) found = call = chute_gl_address(#name); \
    ((void(*) parameters)call) arguments;              \
  }
#define ASK(type, name, parameters, arguments)         \
  type name parameters {                               \
    static _Atomic(Function) found;                    \
    Function call = found;                             \
    if (!call) found = call = chute_gl_address(#name); \
    return ((type(*) parameters)call)arguments;        \
  }
/* clang-format off */
TELL(glBindTexture, (GLenum target, GLuint texture), (target, texture))
TELL(glClear, (GLbitfield mask), (mask))
TELL(glClearColor, (GLfloat r, GLfloat g, GLfloat b, GLfloat a), (r, g, b, a))
TELL(glClearDepth, (GLdouble depth), (depth))
TELL(glClearStencil, (GLint s), (s))
TELL(glColorMask, (GLboolean r, GLboolean g, GLboolean b, GLboolean a), (r, g, b, a))
TELL(glCopyTexImage2D, (GLenum target, GLint level, GLenum format, GLint x, GLint y, GLsizei w, GLsizei h, GLint border), (target, level, format, x, y, w, h, border))
TELL(glCullFace, (GLenum mode), (mode))
TELL(glDeleteTextures, (GLsizei n, const GLuint* textures), (n, textures))
TELL(glDepthFunc, (GLenum func), (func))
TELL(glDepthMask, (GLboolean flag), (flag))
TELL(glDisable, (GLenum cap), (cap))
TELL(glDrawArrays, (GLenum mode, GLint first, GLsizei count), (mode, first, count))
TELL(glDrawElements, (GLenum mode, GLsizei count, GLenum type, const void* indices), (mode, count, type, indices))
TELL(glEnable, (GLenum cap), (cap))
TELL(glFinish, (void), ())
TELL(glFlush, (void), ())
TELL(glGenTextures, (GLsizei n, GLuint* textures), (n, textures))
TELL(glGetBooleanv, (GLenum name, GLboolean* to), (name, to))
TELL(glGetDoublev, (GLenum name, GLdouble* to), (name, to))
ASK(GLenum, glGetError, (void), ())
TELL(glGetFloatv, (GLenum name, GLfloat* to), (name, to))
TELL(glGetIntegerv, (GLenum name, GLint* to), (name, to))
ASK(const GLubyte*, glGetString, (GLenum name), (name))
TELL(glGetTexImage, (GLenum target, GLint level, GLenum format, GLenum type, void* to), (target, level, format, type, to))
TELL(glGetTexLevelParameteriv, (GLenum target, GLint level, GLenum name, GLint* to), (target, level, name, to))
ASK(GLboolean, glIsEnabled, (GLenum cap), (cap))
TELL(glLineWidth, (GLfloat width), (width))
TELL(glPixelStorei, (GLenum name, GLint value), (name, value))
TELL(glPointSize, (GLfloat size), (size))
TELL(glReadBuffer, (GLenum mode), (mode))
TELL(glReadPixels, (GLint x, GLint y, GLsizei w, GLsizei h, GLenum format, GLenum type, void* to), (x, y, w, h, format, type, to))
TELL(glScissor, (GLint x, GLint y, GLsizei w, GLsizei h), (x, y, w, h))
TELL(glTexImage1D, (GLenum target, GLint level, GLint inside, GLsizei w, GLint border, GLenum format, GLenum type, const void* from), (target, level, inside, w, border, format, type, from))
TELL(glTexImage2D, (GLenum target, GLint level, GLint inside, GLsizei w, GLsizei h, GLint border, GLenum format, GLenum type, const void* from), (target, level, inside, w, h, border, format, type, from))
TELL(glTexParameterf, (GLenum target, GLenum name, GLfloat value), (target, name, value))
TELL(glTexParameterfv, (GLenum target, GLenum name, const GLfloat* values), (target, name, values))
TELL(glTexParameteri, (GLenum target, GLenum name, GLint value), (target, name, value))
TELL(glViewport, (GLint x, GLint y, GLsizei w, GLsizei h), (x, y, w, h))
/* clang-format on */
