#pragma once
#include <GL/gl.h>
#include <GL/glext.h>

#include "gl/context.hpp"

/// The functions of OpenGL that plots use. Included by back-end sources only.
namespace chute::plot {

#define CHUTE_GL_FUNCTIONS(X)                                      \
  X(PFNGLCREATESHADERPROC, glCreateShader)                         \
  X(PFNGLSHADERSOURCEPROC, glShaderSource)                         \
  X(PFNGLCOMPILESHADERPROC, glCompileShader)                       \
  X(PFNGLGETSHADERIVPROC, glGetShaderiv)                           \
  X(PFNGLCREATEPROGRAMPROC, glCreateProgram)                       \
  X(PFNGLATTACHSHADERPROC, glAttachShader)                         \
  X(PFNGLBINDATTRIBLOCATIONPROC, glBindAttribLocation)             \
  X(PFNGLLINKPROGRAMPROC, glLinkProgram)                           \
  X(PFNGLGETPROGRAMIVPROC, glGetProgramiv)                         \
  X(PFNGLUSEPROGRAMPROC, glUseProgram)                             \
  X(PFNGLGETUNIFORMLOCATIONPROC, glGetUniformLocation)             \
  X(PFNGLUNIFORM2FPROC, glUniform2f)                               \
  X(PFNGLUNIFORM4FPROC, glUniform4f)                               \
  X(PFNGLGENVERTEXARRAYSPROC, glGenVertexArrays)                   \
  X(PFNGLBINDVERTEXARRAYPROC, glBindVertexArray)                   \
  X(PFNGLGENBUFFERSPROC, glGenBuffers)                             \
  X(PFNGLBINDBUFFERPROC, glBindBuffer)                             \
  X(PFNGLBUFFERDATAPROC, glBufferData)                             \
  X(PFNGLVERTEXATTRIBPOINTERPROC, glVertexAttribPointer)           \
  X(PFNGLVERTEXATTRIBDIVISORPROC, glVertexAttribDivisor)           \
  X(PFNGLENABLEVERTEXATTRIBARRAYPROC, glEnableVertexAttribArray)   \
  X(PFNGLDISABLEVERTEXATTRIBARRAYPROC, glDisableVertexAttribArray) \
  X(PFNGLVERTEXATTRIB2FPROC, glVertexAttrib2f)                     \
  X(PFNGLDRAWARRAYSINSTANCEDPROC, glDrawArraysInstanced)           \
  X(PFNGLGENFRAMEBUFFERSPROC, glGenFramebuffers)                   \
  X(PFNGLBINDFRAMEBUFFERPROC, glBindFramebuffer)                   \
  X(PFNGLGENRENDERBUFFERSPROC, glGenRenderbuffers)                 \
  X(PFNGLBINDRENDERBUFFERPROC, glBindRenderbuffer)                 \
  X(PFNGLRENDERBUFFERSTORAGEPROC, glRenderbufferStorage)           \
  X(PFNGLFRAMEBUFFERRENDERBUFFERPROC, glFramebufferRenderbuffer)   \
  X(PFNGLCHECKFRAMEBUFFERSTATUSPROC, glCheckFramebufferStatus)     \
  X(PFNGLBLENDFUNCPROC_, glBlendFunc)                              \
  X(PFNGLENABLEPROC_, glEnable)                                    \
  X(PFNGLDISABLEPROC_, glDisable)                                  \
  X(PFNGLVIEWPORTPROC_, glViewport)                                \
  X(PFNGLSCISSORPROC_, glScissor)                                  \
  X(PFNGLCLEARCOLORPROC_, glClearColor)                            \
  X(PFNGLCLEARPROC_, glClear)                                      \
  X(PFNGLCOLORMASKPROC_, glColorMask)                              \
  X(PFNGLSTENCILFUNCPROC_, glStencilFunc)                          \
  X(PFNGLSTENCILOPPROC_, glStencilOp)                              \
  X(PFNGLDRAWARRAYSPROC_, glDrawArrays)                            \
  X(PFNGLREADPIXELSPROC_, glReadPixels)                            \
  X(PFNGLPIXELSTOREIPROC_, glPixelStorei)                          \
  X(PFNGLGETERRORPROC_, glGetError)

// GL 1.x has no such types in Mesa's header; they are looked up like the rest, so that no other libGL answers
using PFNGLBLENDFUNCPROC_ = void (*)(GLenum, GLenum);
using PFNGLENABLEPROC_ = void (*)(GLenum);
using PFNGLDISABLEPROC_ = void (*)(GLenum);
using PFNGLVIEWPORTPROC_ = void (*)(GLint, GLint, GLsizei, GLsizei);
using PFNGLSCISSORPROC_ = void (*)(GLint, GLint, GLsizei, GLsizei);
using PFNGLCLEARCOLORPROC_ = void (*)(GLfloat, GLfloat, GLfloat, GLfloat);
using PFNGLCLEARPROC_ = void (*)(GLbitfield);
using PFNGLCOLORMASKPROC_ = void (*)(GLboolean, GLboolean, GLboolean, GLboolean);
using PFNGLSTENCILFUNCPROC_ = void (*)(GLenum, GLint, GLuint);
using PFNGLSTENCILOPPROC_ = void (*)(GLenum, GLenum, GLenum);
using PFNGLDRAWARRAYSPROC_ = void (*)(GLenum, GLint, GLsizei);
using PFNGLREADPIXELSPROC_ = void (*)(GLint, GLint, GLsizei, GLsizei, GLenum, GLenum, void*);
using PFNGLPIXELSTOREIPROC_ = void (*)(GLenum, GLint);
using PFNGLGETERRORPROC_ = GLenum (*)();

struct GlFunctions {
#define CHUTE_GL_MEMBER(type, name) type name = reinterpret_cast<type>(gl::function(#name));
  CHUTE_GL_FUNCTIONS(CHUTE_GL_MEMBER)
#undef CHUTE_GL_MEMBER
};

}  // namespace chute::plot
