#include <dlfcn.h>
#include <fmt/format.h>

#include "common/error.hpp"
#include "common/share_folder.hpp"
#include "flat/vtk_surface.hpp"
#include "gl/context.hpp"

namespace chute::flat {
namespace {

MakeVtkSurface* load() {
  // Never unloaded: VTK keeps what it made until the program ends.
  const auto file = module_folder() / "chute_flat_vtk.so";
  void* handle = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle) throw WorkError(fmt::format("cannot draw: {}", ::dlerror()));
  void* found = ::dlsym(handle, make_vtk_surface_name);
  if (!found)
    throw WorkError(fmt::format("cannot draw: {} is not of this chute, it lacks {}", file.string(),
                                make_vtk_surface_name));
  return reinterpret_cast<MakeVtkSurface*>(found);
}

class LoadedSurface : public Surface {
 public:
  LoadedSurface(int width, int height, const std::array<double, 4>& ground)
      : context_(width, height, 24), width_(width), height_(height) {
    static MakeVtkSurface* const make = load();
    inside_.reset(make(width, height, ground.data()));
  }
  ~LoadedSurface() override {
    context_.make_current();  // VTK lets go of its buffers and shaders while they exist
    inside_.reset();
  }
  LoadedSurface(const LoadedSurface&) = delete;
  LoadedSurface& operator=(const LoadedSurface&) = delete;

  void clip(const std::array<float, 4>& edges) override { inside_->clip(edges); }
  void draw(Corners& corners, image::Image& into) override {
    context_.make_current();
    if (into.width != width_ || into.height != height_) into = image::Image(width_, height_);
    inside_->draw(corners, into.rgba.data());
  }

 private:
  gl::Context context_;
  int width_, height_;
  std::unique_ptr<VtkSurface> inside_;
};

}  // namespace

std::unique_ptr<Surface> make_surface(int width, int height, const std::array<double, 4>& ground) {
  return std::make_unique<LoadedSurface>(width, height, ground);
}

}  // namespace chute::flat
