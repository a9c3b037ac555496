#pragma once
#include <memory>
#include <string>

/// OpenGL 3.3 core without a display: Mesa's software renderer, drawing into memory. Another way to a context
/// (EGL without a surface, which later Mesas have instead) changes this room only.
namespace chute::gl {

/// Current on the thread that made it, until another one is.
class Context {
 public:
  /// A buffer of `width` x `height` pixels with `depth_bits` of depth (0 or 24). What pixels depend on beside
  /// the data, the renderer's vector width and the C locale, is pinned first. WorkError if it cannot be had.
  Context(int width, int height, int depth_bits);
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  void make_current();
  /// "Mesa 22.3.6, llvmpipe (LLVM 15.0.6, 128 bits)". Of the current context.
  static std::string version();

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

/// Makes current again, when it goes, what was current when it came.
class KeepCurrent {
 public:
  KeepCurrent();
  ~KeepCurrent();
  KeepCurrent(const KeepCurrent&) = delete;
  KeepCurrent& operator=(const KeepCurrent&) = delete;

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

using Function = void (*)();
/// OpenGL's function of that name; WorkError if the library lacks it.
Function function(const char* name);

}  // namespace chute::gl
